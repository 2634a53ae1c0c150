// SPDX-License-Identifier: Apache-2.0
#include "programs.h"

#include <initializer_list>
#include <string_view>

#include "shader_texts.h"

namespace pdsm {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

/// Puts shader texts together.
class Assembly {
 public:
  explicit Assembly(const std::string& shadow_text) : shadows_(shadow_text) {}

  /// With the frame's uniforms alone.
  [[nodiscard]] std::string plain(std::string_view body) const {
    return kVersion + std::string(shaders::frame_glsl) + std::string(body);
  }
  /// With the picture's depth too.
  [[nodiscard]] std::string deep(std::string_view body) const {
    return plain(std::string(shaders::depth_glsl) + std::string(body));
  }
  /// With maps and lights, and what `more` has; `mode` is what SURFACE_MODE shall be.
  [[nodiscard]] std::string lit(std::initializer_list<std::string_view> more, int mode = 0) const {
    std::string text = kVersion + shadows_ + "#define SURFACE_MODE " + std::to_string(mode) + "\n";
    text.append(shaders::frame_glsl).append(shaders::lights_glsl);
    for (const std::string_view part : more) text.append(part);
    return text;
  }
  /// Of pixels.
  [[nodiscard]] ShaderProgram shade(const std::string& name, int mode) const {
    return {name, plain(shaders::full_screen_vert),
            lit({shaders::surfaces_glsl, shaders::shading_glsl, shaders::shade_frag}, mode)};
  }
  /// Of meshes.
  [[nodiscard]] ShaderProgram object(const std::string& name, int mode) const {
    return {name, plain(shaders::surface_vert), lit({shaders::shading_glsl, shaders::object_frag}, mode)};
  }

 private:
  std::string shadows_;
};

/// Points samplers at their units for good.
void assign_units(const ShaderProgram& program) {
  program.use();
  program.set("surface_position", kPositionUnit);
  program.set("surface_normal", kNormalUnit);
  program.set("surface_colour", kColourUnit);
  program.set("depth", kDepthUnit);
  program.set("picture", kPictureUnit);
  program.set("fog", kFogUnit);
  program.set("truth", kTruthUnit);
  program.set("error", kErrorUnit);
  program.set("heat", kHeatUnit);
}

}  // namespace

Programs make_programs(const std::string& shadow_text) {
  const Assembly text(shadow_text);
  const std::string full_screen = text.plain(shaders::full_screen_vert);
  Programs programs;
  programs.surface = {"surface", text.plain(shaders::surface_vert), text.plain(shaders::surface_frag)};
  programs.shaded = text.shade("shaded", 0);
  programs.visibility = text.shade("visibility", 1);
  programs.truth = text.shade("truth", 2);
  programs.error = text.shade("error", 3);
  programs.object_shaded = text.object("object shaded", 0);
  programs.object_visibility = text.object("object visibility", 1);
  programs.capture = {"capture", full_screen, text.lit({shaders::surfaces_glsl, shaders::capture_frag})};
  programs.line = {"line", text.plain(shaders::line_vert), text.plain(shaders::line_frag)};
  programs.slice = {"slice", text.plain(shaders::slice_vert), text.lit({shaders::slice_frag})};
  programs.particle = {"particle", text.lit({shaders::particle_vert}), text.deep(shaders::particle_frag)};
  programs.fog = {"fog", full_screen, text.lit({shaders::depth_glsl, shaders::fog_frag})};
  programs.fog_composite = {"fog composite", full_screen, text.deep(shaders::fog_composite_frag)};
  programs.smooth = {"smooth", full_screen, text.plain(shaders::smooth_frag)};
  programs.copy = {"copy", full_screen, text.plain(shaders::copy_frag)};
  for (const ShaderProgram* program :
       {&programs.shaded, &programs.visibility, &programs.truth, &programs.error, &programs.capture,
        &programs.slice, &programs.particle, &programs.fog, &programs.fog_composite, &programs.smooth,
        &programs.copy}) {
    assign_units(*program);
  }
  return programs;
}

}  // namespace pdsm
