// SPDX-License-Identifier: Apache-2.0
#include "scene_renderer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "evaluate/colour.h"
#include "frame_block.h"
#include "gizmo.h"
#include "pdsm/bake/view_fit.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// heat_colour() as a row of texels.
GlTexture make_heat_texture() {
  constexpr int kTexels = 256;
  std::array<glm::vec3, kTexels> texels;
  for (int i = 0; i < kTexels; ++i) texels[static_cast<std::size_t>(i)] = heat_colour(i / (kTexels - 1.0));
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, kTexels, 1, 0, GL_RGB, GL_FLOAT, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return texture;
}

bool wants_truth(Mode mode) {
  return mode == Mode::truth || mode == Mode::error;
}

/// Without a map, what the baker would take; it depends on the geometry alone.
double fitted_near(const Scene& scene, std::size_t number) {
  const Light& light = scene.lights[number];
  try {
    return fit_view(scene, light, 64, 64).view.near_depth;
  } catch (const Error&) {
    // No map can be baked of this light; it shines all the same.
    return light.near_depth.value_or(0);
  }
}

/// How much of the scene's own look is left in this mode, beside what is drawn over it.
float dimming(Mode mode) {
  if (mode == Mode::error) return 0.3F;
  return mode == Mode::slice ? 0.5F : 1.0F;
}

}  // namespace

SceneRenderer::SceneRenderer()
    : shadows_([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }),
      frame_block_(GlBuffer::make()),
      heat_(make_heat_texture()) {
  glBindBuffer(GL_UNIFORM_BUFFER, frame_block_.name());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameBlock), nullptr, GL_DYNAMIC_DRAW);
}

void SceneRenderer::synchronize(const Session& session, const Settings& settings) {
  if (!session.stage()) return;
  const bool new_stage = session.stage_version() != stage_version_;
  if (new_stage) {
    meshes_ = SceneMeshes(*session.stage());
    stage_version_ = session.stage_version();
    fitted_near_.clear();
  }
  if (!new_stage && asked_layout_ == settings.layout && session.map_version() == map_version_) return;
  // What does not fit is not tried again before something changes.
  asked_layout_ = settings.layout;
  map_version_ = session.map_version();
  std::vector<const PenumbraMap*> maps;
  for (const LoadedMap& loaded : session.library().maps()) maps.push_back(&loaded.map);
  const glm::dvec3& origin = session.stage()->origin();
  shadows_.upload(maps, settings.layout, {origin.x, origin.y, origin.z});
  if (layout_ != settings.layout) programs_ = make_programs(shadows_.shader_text());
  layout_ = settings.layout;
}

FrameState SceneRenderer::frame_state() const {
  return {matrices_.world_to_clip, object_motion_, truth_.version()};
}

void SceneRenderer::draw(const Session& session, const Settings& settings, const FrameView& view) {
  targets_.resize(view.width, view.height);
  if (!session.stage() || !layout_) {
    targets_.begin_still();
    glClearColor(0.10F, 0.11F, 0.13F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    targets_.begin_picture();
    targets_.output_picture(nullptr);
    return;
  }
  begin_frame(session, settings, view);
  if (wants_truth(settings.mode)) update_truth(session, settings, view);
  const PictureKey key = picture_key(session, settings, view, frame_state());
  const bool is_same = key == key_;
  key_ = key;
  if (!is_same) pictures_ = 0;
  // The truth is of the pixels' middles alone.
  const bool can_add = settings.antialias && !wants_truth(settings.mode);
  if (pictures_ < (can_add ? kMostPictures : 1)) {
    matrices_.world_to_clip = sub_pixel_shift(pictures_, view.width, view.height) * matrices_.world_to_clip;
    upload_frame(session, settings, view);
    draw_picture(session, settings, view);
    if (can_add) targets_.add_to_mean(programs_.copy, pictures_);
    ++pictures_;
  }
  if (pictures_ == 1) {
    targets_.output_picture(settings.antialias ? &programs_.smooth : nullptr);
  } else {
    targets_.output_mean(programs_.copy);
  }
}

void SceneRenderer::begin_frame(const Session& session, const Settings& settings, const FrameView& view) {
  const Stage& stage = *session.stage();
  matrices_ = camera_matrices(view.camera, stage.origin(), stage.reach(), view.width, view.height);
  eye_ = stage.local(view.camera.eye);
  object_motion_ = settings.object ? object_motion(stage, settings, view.seconds) : glm::mat4(1);
  shown_ = shown_lights(stage, session.library(), session.lights());
  for (ShownLight& light : shown_) {
    if (light.map >= static_cast<int>(shadows_.map_count())) light.map = -1;
  }
  glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

void SceneRenderer::upload_frame(const Session& session, const Settings& settings, const FrameView& view) {
  const Stage& stage = *session.stage();
  light_block_.update(shown_, stage);
  const FrameBlock block = make_frame_block(matrices_, eye_, stage.focus(), view.width, view.height,
                                            settings.use_footprint, view.seconds);
  glBindBuffer(GL_UNIFORM_BUFFER, frame_block_.name());
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof(block), &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_block_.name());
  bind_maps(settings);
  glActiveTexture(GL_TEXTURE0 + kHeatUnit);
  glBindTexture(GL_TEXTURE_2D, heat_.name());
}

void SceneRenderer::bind_maps(const Settings& settings) {
  for (std::uint32_t map = 0; map < shadows_.map_count(); ++map) {
    shadows_.set_look_up(map, {settings.filter, settings.normal_offset});
  }
  for (const ShaderProgram* program :
       {&programs_.shaded, &programs_.visibility, &programs_.object_shaded, &programs_.object_visibility,
        &programs_.capture, &programs_.slice, &programs_.particle, &programs_.fog}) {
    shadows_.bind(program->name(), kMapUnit, kTablesBinding);
  }
}

void SceneRenderer::draw_surfaces(const Settings& settings) {
  still_key_ = {};
  targets_.begin_surfaces();
  glEnable(GL_DEPTH_TEST);
  programs_.surface.use();
  // The truth is of all surfaces; else what moves is drawn later, over the still.
  if (settings.object && wants_truth(settings.mode)) object_.draw(programs_.surface, object_motion_);
  meshes_.draw(programs_.surface, eye_);
  glDisable(GL_DEPTH_TEST);
  targets_.begin_still();
}

void SceneRenderer::draw_still(const Session& session, const Settings& settings, const FrameView& view) {
  const bool with_object = settings.object && wants_truth(settings.mode);
  const PictureKey key = still_key(session, settings, view, frame_state(), with_object);
  if (key == still_key_) return;
  draw_surfaces(settings);
  const ShaderProgram& program = shading_program(settings.mode);
  program.use();
  program.set("dim", dimming(settings.mode));
  program.set("error_top", truth_.error_top());
  targets_.fill();
  still_key_ = key;
}

void SceneRenderer::draw_picture(const Session& session, const Settings& settings, const FrameView& view) {
  draw_still(session, settings, view);
  targets_.begin_picture();
  glEnable(GL_DEPTH_TEST);
  if (settings.object && !wants_truth(settings.mode)) {
    const ShaderProgram& program =
        settings.mode == Mode::visibility ? programs_.object_visibility : programs_.object_shaded;
    program.use();
    program.set("dim", dimming(settings.mode));
    object_.draw(program, object_motion_);
  }
  draw_lines(session, settings, view);
  if (settings.mode == Mode::slice) draw_slice(session, settings, view);
  glDisable(GL_DEPTH_TEST);
  draw_air(session, settings);
}

const ShaderProgram& SceneRenderer::shading_program(Mode mode) const {
  if (mode == Mode::visibility) return programs_.visibility;
  if (!wants_truth(mode) || !truth_.is_ready()) return programs_.shaded;
  truth_.bind();
  return mode == Mode::truth ? programs_.truth : programs_.error;
}

void SceneRenderer::draw_lines(const Session& session, const Settings& settings, const FrameView& view) {
  const Stage& stage = *session.stage();
  lines_.begin(glm::mat4(matrices_.world_to_clip), view.width, view.height);
  for (std::size_t i = 0; i < stage.scene().lights.size(); ++i) {
    if (settings.gizmos) add_light_gizmo(lines_, stage, stage.scene().lights[i], session.lights()[i].on);
    const LoadedMap* map = session.library().of_light(i);
    if (!settings.frustum || map == nullptr) continue;
    for (const View& map_view : map->map.views) add_frustum(lines_, stage, map_view);
  }
  if (view.probe) add_probe_ray(lines_, stage, *view.probe);
  lines_.draw(programs_.line);
}

void SceneRenderer::draw_slice(const Session& session, const Settings& settings, const FrameView& view) {
  const LoadedMap* map = session.library().of_light(view.light);
  if (map == nullptr) return;
  const auto index = static_cast<int>(map - session.library().maps().data());
  if (index < static_cast<int>(shadows_.map_count())) {
    slice_.draw(programs_.slice, *session.stage(), map->map, index, settings);
  }
}

void SceneRenderer::draw_air(const Session& session, const Settings& settings) {
  if (settings.mode != Mode::shaded && settings.mode != Mode::function) return;
  targets_.begin_air();
  const Stage& stage = *session.stage();
  if (settings.fog) fog_.draw(programs_, targets_, stage, settings);
  if (settings.particles) particles_.draw(programs_.particle, stage.focus());
}

double SceneRenderer::near_depth(const Session& session, std::size_t light) {
  const LoadedMap* map = session.library().of_light(light);
  if (map != nullptr) return map->map.views.front().near_depth;
  const auto known = fitted_near_.find(light);
  if (known != fitted_near_.end()) return known->second;
  return fitted_near_[light] = fitted_near(session.stage()->scene(), light);
}

void SceneRenderer::update_truth(const Session& session, const Settings& settings, const FrameView& view) {
  std::vector<TruthLight> lights;
  for (const ShownLight& shown : shown_) lights.push_back({shown.light, near_depth(session, shown.light)});
  const TruthKey key{session.stage_version(), view.width,      view.height, matrices_.world_to_clip,
                     object_motion_,          settings.object, lights,      settings.truth_samples};
  const LookUpKey look_ups{session.map_version(), static_cast<int>(settings.filter),
                           static_cast<int>(settings.layout), settings.normal_offset, settings.use_footprint};
  truth_.update(session.stage(), key, look_ups, view.truth_at_once, [&] {
    upload_frame(session, settings, view);
    draw_surfaces(settings);
    return capture_surfaces(programs_.capture, targets_, static_cast<int>(shown_.size()));
  });
}

}  // namespace pdsm
