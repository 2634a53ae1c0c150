// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "camera_control.h"
#include "fog.h"
#include "frame_targets.h"
#include "function_probe.h"
#include "light_set.h"
#include "line_batch.h"
#include "moving_object.h"
#include "particles.h"
#include "pdsm/runtime/shadow_textures.h"
#include "picture_key.h"
#include "programs.h"
#include "scene_meshes.h"
#include "session.h"
#include "settings.h"
#include "slice.h"
#include "truth_overlay.h"

namespace pdsm {

/// Draws frames into its own targets. Needs a current context for as long as it lives.
class SceneRenderer {
 public:
  /// Throws Error (resource) when the GL is too old.
  SceneRenderer();

  /// Takes over scene and maps when they are others now. Throws Error (resource) when they do not fit the GL;
  /// maps then stay as they were.
  void synchronize(const Session& session, const Settings& settings);

  /// Draws a frame into the targets' output. The same frame drawn again gets smoother edges, up to
  /// kMostPictures times; then it costs nothing.
  void draw(const Session& session, const Settings& settings, const FrameView& view);
  static constexpr int kMostPictures = 16;

  [[nodiscard]] FrameTargets& targets() { return targets_; }
  [[nodiscard]] TruthOverlay& truth() { return truth_; }
  [[nodiscard]] std::uint64_t texture_bytes() const { return shadows_.texture_bytes(); }

 private:
  [[nodiscard]] FrameState frame_state() const;
  void begin_frame(const Session& session, const Settings& settings, const FrameView& view);
  void upload_frame(const Session& session, const Settings& settings, const FrameView& view);
  void bind_maps(const Settings& settings);
  void draw_surfaces(const Settings& settings);
  void draw_still(const Session& session, const Settings& settings, const FrameView& view);
  void draw_picture(const Session& session, const Settings& settings, const FrameView& view);
  void update_truth(const Session& session, const Settings& settings, const FrameView& view);
  [[nodiscard]] double near_depth(const Session& session, std::size_t light);
  [[nodiscard]] const ShaderProgram& shading_program(Mode mode) const;
  void draw_lines(const Session& session, const Settings& settings, const FrameView& view);
  void draw_slice(const Session& session, const Settings& settings, const FrameView& view);
  void draw_air(const Session& session, const Settings& settings);

  ShadowTextures shadows_;
  Programs programs_;
  SceneMeshes meshes_;
  MovingObject object_;
  Particles particles_;
  Fog fog_;
  Slice slice_;
  LineBatch lines_;
  FrameTargets targets_;
  TruthOverlay truth_;
  LightBlock light_block_;
  GlBuffer frame_block_;
  GlTexture heat_;

  std::uint64_t stage_version_ = 0, map_version_ = 0;
  std::optional<TextureLayout> asked_layout_, layout_;  // tried last; of the programs and maps that are shown
  std::map<std::size_t, double> fitted_near_;           // metres, of lights without a map

  PictureKey key_, still_key_;
  int pictures_ = 0;  // that were averaged for key_

  // Of the frame that is being drawn.
  std::vector<ShownLight> shown_;
  CameraMatrices matrices_;  // moved by less than a pixel from picture to picture
  glm::mat4 object_motion_{1};
  glm::vec3 eye_{0};
};

}  // namespace pdsm
