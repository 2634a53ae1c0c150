// SPDX-License-Identifier: Apache-2.0
// The shadow pass alone: visibility of every pixel of a picture, from its world position, by several
// techniques in turns in one run. glFinish and a wall clock: timer queries can't be trusted on software GL.
// usage: bench_shadow_pass SCENE MAP [EDGE = 1024] [RUNS = 15] [eye x,y,z target x,y,z is the default
// camera's]
#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "../count_argument.h"
#include "egl_context.h"
#include "evaluate/framing.h"
#include "evaluate/picture_scene.h"
#include "gl_program.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "shadow_pass_text.h"

namespace {

using namespace pdsm;
using testing::FloatTarget;
using testing::GlProgram;

constexpr const char* kVersion = "#version 330\n";

/// A texture of floats, nearest.
class FloatTexture {
 public:
  FloatTexture(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
               const std::vector<float>& texels)
      : bytes_(texels.size() * sizeof(float)) {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexImage2D(GL_TEXTURE_2D, 0, channels == 1 ? GL_R32F : GL_RGBA32F, static_cast<GLsizei>(width),
                 static_cast<GLsizei>(height), 0, channels == 1 ? GL_RED : GL_RGBA, GL_FLOAT, texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  }
  ~FloatTexture() { glDeleteTextures(1, &name_); }
  FloatTexture(const FloatTexture&) = delete;
  FloatTexture& operator=(const FloatTexture&) = delete;

  void bind(const GlProgram& program, const char* uniform, GLint unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, name_);
    glUseProgram(program.name());
    glUniform1i(program.uniform(uniform), unit);
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  GLuint name_ = 0;
  std::uint64_t bytes_;
};

/// World positions of a picture's pixels; w = 1 where a surface lies within the map's window.
struct Positions {
  std::vector<float> texels;
  double covered = 0;  ///< share of the pixels
};

Positions find_positions(const PictureScene& picture, const Camera& camera, const View& view,
                         std::uint32_t edge) {
  const CameraRays rays(camera, edge, edge);
  Positions positions;
  positions.texels.resize(std::size_t{4} * edge * edge);
  std::uint64_t covered = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : covered)
  for (std::uint32_t y = 0; y < edge; ++y) {
    for (std::uint32_t x = 0; x < edge; ++x) {
      const auto point = picture.trace(camera.eye, rays.direction(x + 0.5, y + 0.5));
      if (!point) continue;
      const glm::dvec3 q = apply(view.world_to_view, point->position);
      const double u = q.x / q.z, v = q.y / q.z;
      const auto& w = view.window;
      if (q.z <= 0 || u < w[0] || u > w[2] || v < w[1] || v > w[3]) continue;
      float* texel = positions.texels.data() + std::size_t{4} * (std::size_t{y} * edge + x);
      for (int a = 0; a < 3; ++a) texel[a] = static_cast<float>(point->position[a]);
      texel[3] = 1;
      ++covered;
    }
  }
  positions.covered = static_cast<double>(covered) / (static_cast<double>(edge) * edge);
  return positions;
}

/// Depths of the first surface from the light's centre, one a PDSM texel.
std::vector<float> find_depths(const PictureScene& picture, const View& view) {
  const RigidTransform to_world = inverse(view.world_to_view);
  const glm::dvec3 centre = apply(to_world, glm::dvec3(0));
  std::vector<float> depths(std::size_t{view.width} * view.height);
#pragma omp parallel for schedule(dynamic)
  for (std::uint32_t j = 0; j < view.height; ++j) {
    for (std::uint32_t i = 0; i < view.width; ++i) {
      const glm::dvec3 slope(view.window[0] + (i + 0.5) / view.width * (view.window[2] - view.window[0]),
                             view.window[1] + (j + 0.5) / view.height * (view.window[3] - view.window[1]), 1);
      const auto point = picture.trace(centre, apply(to_world, slope) - centre);
      depths[std::size_t{j} * view.width + i] =
          point ? static_cast<float>(apply(view.world_to_view, point->position).z) : 1e30F;
    }
  }
  return depths;
}

/// The default view, from higher up, at the distance from which the map's window about fills the picture.
Camera camera_over_window(const Scene& scene, const PictureScene& picture, const View& view) {
  Camera camera = find_framing(scene, picture, scene.lights).camera;
  const glm::dvec3 from = glm::normalize(glm::normalize(camera.eye - camera.target) + glm::dvec3(0, 1, 0));
  const double extent = (view.window[3] - view.window[1]) * view.far_depth;
  camera.eye = camera.target + from * (0.8 * extent / (2 * std::tan(glm::radians(camera.fov) / 2)));
  return camera;
}

/// A technique, ready to run.
struct Technique {
  std::string name;
  std::unique_ptr<GlProgram> program;
  std::uint64_t bytes = 0;
  ShadowTextures* shadows = nullptr;     ///< to bind before, for ours
  const FloatTexture* depths = nullptr;  ///< for the others
  Filter filter = Filter::bilinear;
  std::vector<double> seconds;
};

std::unique_ptr<GlProgram> make_program(const std::string& text, const std::string& expression) {
  return std::make_unique<GlProgram>(testing::target_vertex_shader(kVersion), kVersion + text + R"(
uniform highp sampler2D positions;
out float visibility;
void main() {
  vec4 p = texelFetch(positions, ivec2(gl_FragCoord.xy), 0);
  visibility = p.w > 0.0 ? )" + expression + R"( : 1.0;
}
)");
}

/// Uniforms of classic.glsl.
void set_classic(const GlProgram& program, const View& view, double light_edge) {
  glUseProgram(program.name());
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  std::array<float, 12> rows{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < 4; ++n) {
      const auto entry = [&](std::size_t row) { return n < 3 ? r[3 * row + n] : t[row]; };
      const double scale = view.width / (view.window[2] - view.window[0]);
      rows[4 * axis + n] =
          static_cast<float>(axis == 2 ? entry(2) : (entry(axis) - view.window[axis] * entry(2)) * scale);
    }
  }
  glUniform4fv(program.uniform("light_rows"), 3, rows.data());
  glUniform1f(program.uniform("map_size"), static_cast<float>(view.width));
  const double scale = view.width / (view.window[2] - view.window[0]);
  glUniform1f(program.uniform("light_texels"), static_cast<float>(light_edge * scale));
  glUniform1f(program.uniform("near_depth"), static_cast<float>(view.near_depth));
  glUniform1f(program.uniform("bias"), 0.02F);
  // Vogel's spirals: as even as Poisson disks.
  std::array<float, 96> taps{};
  for (int n = 0; n < 48; ++n) {
    const int index = n < 16 ? n : n - 16, count = n < 16 ? 16 : 32;
    const double radius = std::sqrt((index + 0.5) / count), angle = 2.39996323 * index;
    taps[static_cast<std::size_t>(2 * n)] = static_cast<float>(radius * std::cos(angle));
    taps[static_cast<std::size_t>(2 * n + 1)] = static_cast<float>(radius * std::sin(angle));
  }
  glUniform2fv(program.uniform("taps"), 48, taps.data());
}

double run(Technique& technique, const FloatTexture& positions) {
  if (technique.shadows != nullptr) {
    technique.shadows->set_look_up(0, {technique.filter, 0});
    technique.shadows->bind(technique.program->name());
  }
  positions.bind(*technique.program, "positions", 3);
  if (technique.depths != nullptr) technique.depths->bind(*technique.program, "depth_map", 2);
  glFinish();
  const double start = omp_get_wtime();
  testing::draw_target();
  glFinish();
  return omp_get_wtime() - start;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Mean of what is in the bound target: so that nobody can leave the work out, and to compare the techniques.
double mean_of_target(std::uint32_t edge) {
  std::vector<float> values(std::size_t{edge} * edge);
  glReadPixels(0, 0, static_cast<GLsizei>(edge), static_cast<GLsizei>(edge), GL_RED, GL_FLOAT, values.data());
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

int measure(const std::string& scene_path, const std::string& map_path, std::uint32_t edge, int runs) {
  const Scene scene = read_scene(scene_path);
  const PenumbraMap map = read_map(map_path);
  // The classic techniques look from a point.
  if (is_distant(scene.lights.front()))
    throw Error(Failure::usage, "SCENE", "the first light must not be distant");
  const PenumbraMap* const maps[] = {&map};
  const View& view = map.views[0];
  const PictureScene picture(scene);
  const Camera camera = camera_over_window(scene, picture, view);
  const Positions positions = find_positions(picture, camera, view, edge);

  const testing::EglContext context(testing::GlApi::core_33);
  ShadowTextures two_level(testing::EglContext::loader()), fixed_depth(testing::EglContext::loader());
  two_level.upload(maps, TextureLayout::two_level);
  fixed_depth.upload(maps, TextureLayout::fixed_depth);
  const FloatTexture depth_map(view.width, view.height, 1, find_depths(picture, view));

  std::vector<Technique> techniques;
  const auto classic = [&](const char* name, const char* expression) {
    Technique& added = techniques.emplace_back();
    added.name = name;
    added.program = make_program(kClassicText, expression);
    added.bytes = depth_map.bytes();
    set_classic(*added.program, view, 2 * half_extents(scene.lights.front())[0]);
    added.depths = &depth_map;
  };
  const auto ours = [&](const char* name, ShadowTextures& shadows, Filter filter,
                        ShaderScope scope = ShaderScope::these_maps) {
    Technique& added = techniques.emplace_back();
    added.name = name;
    const std::string define =
        filter == Filter::bilinear ? "#define PDSM_ONLY_FILTER 1\n" : "#define PDSM_ONLY_FILTER 0\n";
    const std::string text =
        scope == ShaderScope::these_maps ? define + shadows.shader_text(scope) : shadows.shader_text(scope);
    added.program = make_program(text, "pdsm_visibility(0, p.xyz, vec3(0.0))");
    added.bytes = shadows.texture_bytes();
    added.shadows = &shadows;
    added.filter = filter;
  };
  classic("hard shadow map", "hard(p.xyz)");
  classic("PCF 4 x 4", "pcf(p.xyz)");
  classic("PCSS 16 + 32", "pcss(p.xyz)");
  ours("fixed depth, nearest", fixed_depth, Filter::nearest);
  ours("fixed depth, bilinear", fixed_depth, Filter::bilinear);
  ours("two-level, nearest", two_level, Filter::nearest);
  ours("two-level, bilinear", two_level, Filter::bilinear);
  ours("two-level, bilinear, program for any maps", two_level, Filter::bilinear, ShaderScope::any_maps);

  const FloatTexture position_texture(edge, edge, 4, positions.texels);
  const FloatTarget target(edge, edge, GL_R32F);
  for (int n = 0; n <= runs; ++n) {
    for (Technique& technique : techniques) {
      const double seconds = run(technique, position_texture);
      if (n > 0) technique.seconds.push_back(seconds);  // the first run compiles
    }
  }
  fmt::print("{} x {} pixels, {:.0f}% covered, median of {} runs\n", edge, edge, 100 * positions.covered,
             runs);
  fmt::print("technique,milliseconds,over_pcss,over_fixed_depth,texture_bytes,mean_visibility\n");
  const double pcss = median(techniques[2].seconds), fixed = median(techniques[4].seconds);
  for (Technique& technique : techniques) {
    run(technique, position_texture);
    const double seconds = median(technique.seconds);
    fmt::print("{},{:.2f},{:.3f},{:.3f},{},{:.4f}\n", technique.name, 1e3 * seconds, seconds / pcss,
               seconds / fixed, technique.bytes, mean_of_target(edge));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    fmt::print(stderr, "usage: bench_shadow_pass SCENE MAP [EDGE] [RUNS]\n");
    return 2;
  }
  try {
    const std::uint32_t edge = pdsm::bench::count_argument(argc, argv, 3, 1024),
                        runs = pdsm::bench::count_argument(argc, argv, 4, 15);
    return measure(argv[1], argv[2], edge, static_cast<int>(runs));
  } catch (const pdsm::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.failure());
  }
}
