// SPDX-License-Identifier: Apache-2.0
#include "trace/embree_scene.h"

#include <array>

#include "pdsm/format/error.h"
#include "trace/cutout_holes.h"

namespace pdsm {
namespace {

struct IsaName {
  const char* name;
  bool supported;
};

std::array<IsaName, 5> known_isas() {
  __builtin_cpu_init();
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl");
  return {{{"avx512", avx512},
           {"avx2", __builtin_cpu_supports("avx2") != 0},
           {"avx", __builtin_cpu_supports("avx") != 0},
           {"sse4.2", __builtin_cpu_supports("sse4.2") != 0},
           {"sse2", true}}};
}

void throw_embree_error(void*, RTCError code, const char* message) {
  throw Error(Failure::resource, "embree", std::string(message) + " (" + std::to_string(code) + ")");
}

unsigned mask_of(const LightSpaceMesh& mesh) {
  const unsigned caster = !mesh.casts                    ? 0
                          : mesh.is_translucent_caster() ? kTranslucentMask
                          : mesh.is_cutout_caster()      ? kCutoutMask
                                                         : kCasterMask;
  return caster | (mesh.receives ? kReceiverMask : 0U);
}

RTCGeometry make_geometry(RTCDevice device, TracedMesh& traced) {
  const LightSpaceMesh& mesh = traced.mesh;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                             sizeof(glm::vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(glm::uvec3), mesh.triangles.size());
  rtcSetGeometryMask(geometry, mask_of(mesh));
  rtcSetGeometryUserData(geometry, &traced);
  if (mesh.casts && mesh.has_holes()) rtcSetGeometryIntersectFilterFunction(geometry, pass_through_holes);
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry make_geometry(RTCDevice device, const LightSpaceCurves& curves) {
  RTCGeometry geometry =
      rtcNewGeometry(device, curves.shape == CurveShape::round ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                               : RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, curves.points.data(), 0,
                             sizeof(glm::vec4), curves.points.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(), 0,
                             sizeof(std::uint32_t), curves.segments.size());
  rtcSetGeometryMask(geometry, kCutoutMask);
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  // Without the robust flag rays slip through the shared edges of a closed mesh.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

}  // namespace

std::string choose_isa(const std::string& wanted) {
  for (const IsaName& isa : known_isas()) {
    if (wanted.empty() && isa.supported) return isa.name;
    if (wanted != isa.name) continue;
    if (isa.supported) return wanted;
    throw Error(Failure::usage, "--isa", "this machine has no " + wanted);
  }
  throw Error(Failure::usage, "--isa", "must be one of sse2, sse4.2, avx, avx2, avx512, not " + wanted);
}

EmbreeScene::EmbreeScene(const LightSpaceScene& scene, const std::string& isa, unsigned threads)
    : geometry_(scene), traced_(traced_meshes(scene)) {
  const std::string config = "isa=" + isa + ",threads=" + std::to_string(threads);
  device_ = rtcNewDevice(config.c_str());
  if (device_ == nullptr) throw Error(Failure::resource, "embree", "no device for " + config);
  rtcSetDeviceErrorFunction(device_, throw_embree_error, nullptr);
  scene_ = new_scene(device_);
  if (scene.has_cutouts() || !scene.curves.empty()) cutouts_ = new_scene(device_);
  if (scene.has_translucency()) translucent_ = new_scene(device_);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const LightSpaceMesh& mesh = scene.meshes[i];
    if (mesh.triangles.empty()) continue;
    RTCGeometry geometry = make_geometry(device_, traced_[i]);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(i));
    if (mesh.is_cutout_caster()) rtcAttachGeometryByID(cutouts_, geometry, static_cast<unsigned>(i));
    if (mesh.is_translucent_caster()) rtcAttachGeometryByID(translucent_, geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  for (std::size_t i = 0; i < scene.curves.size(); ++i) {
    RTCGeometry geometry = make_geometry(device_, scene.curves[i]);
    const auto id = static_cast<unsigned>(scene.meshes.size() + i);
    rtcAttachGeometryByID(scene_, geometry, id);
    rtcAttachGeometryByID(cutouts_, geometry, id);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_);
  if (cutouts_ != nullptr) rtcCommitScene(cutouts_);
  if (translucent_ != nullptr) rtcCommitScene(translucent_);
}

EmbreeScene::~EmbreeScene() {
  if (translucent_ != nullptr) rtcReleaseScene(translucent_);
  if (cutouts_ != nullptr) rtcReleaseScene(cutouts_);
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

}  // namespace pdsm
