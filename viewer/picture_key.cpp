// SPDX-License-Identifier: Apache-2.0
#include "picture_key.h"

namespace pdsm {

PictureKey still_key(const Session& session, const Settings& settings, const FrameView& view,
                     const FrameState& state, bool with_object) {
  PictureKey key;
  key.settings.mode = settings.mode;
  key.settings.filter = settings.filter;
  key.settings.layout = settings.layout;
  key.settings.normal_offset = settings.normal_offset;
  key.settings.use_footprint = settings.use_footprint;
  key.settings.object = with_object;
  key.object = with_object ? state.object : glm::mat4(1);
  key.lights = session.lights();
  key.stage_version = session.stage_version();
  key.map_version = session.map_version();
  key.truth_version = state.truth_version;
  key.world_to_clip = state.world_to_clip;
  key.width = view.width;
  key.height = view.height;
  return key;
}

PictureKey picture_key(const Session& session, const Settings& settings, const FrameView& view,
                       const FrameState& state) {
  PictureKey key = still_key(session, settings, view, state, false);
  key.settings = settings;
  key.object = state.object;
  key.seconds = settings.particles ? view.seconds : 0;
  key.light = view.light;
  if (view.probe) {
    key.probe = {static_cast<double>(view.probe->texel[0]), static_cast<double>(view.probe->texel[1]),
                 view.probe->point_depth};
  }
  return key;
}

}  // namespace pdsm
