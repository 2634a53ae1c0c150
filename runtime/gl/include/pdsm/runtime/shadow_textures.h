// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "pdsm/runtime/map_textures.h"

/// Penumbra maps on the GPU through OpenGL 3.3 or OpenGL ES 3.0. Depends on no window library and links no
/// GL: symbols come from a callback. All calls need the context that was current at construction, on its
/// thread.
namespace pdsm {

/// Address of a GL function by its name, null when there is none: glfwGetProcAddress, eglGetProcAddress.
using GlSymbolLoader = std::function<void*(const char* name)>;

/// What a program is compiled for.
enum class ShaderScope {
  any_maps,   ///< every set of maps in the same layout
  these_maps  ///< what the maps of the last upload have in common: faster; has to be compiled anew when the
              ///< text changes after another upload
};

/// A set of maps in two textures and a uniform buffer, which it owns and deletes.
///
///     pdsm::ShadowTextures shadows([](const char* name) { return (void*)glfwGetProcAddress(name); });
///     shadows.upload(maps);                            // after loading, and again when a map has changed
///     shadows.bind(program);                           // before drawing, each frame
///
/// and in the shader, after shadows.shader_text(): pdsm_visibility(map, position, normal).
class ShadowTextures {
 public:
  /// Loads symbols and reads the limits. Throws Error (resource) when a symbol is missing, which names it, or
  /// when the context is older than OpenGL 3.3 or OpenGL ES 3.0.
  explicit ShadowTextures(const GlSymbolLoader& load);
  ~ShadowTextures();
  ShadowTextures(ShadowTextures&&) noexcept;
  ShadowTextures& operator=(ShadowTextures&&) noexcept;

  /// Uploads maps in place of all that were there; map n of the span is map n in the shader. `origin`: see
  /// make_map_textures. The maps may be destroyed afterwards. Settings of maps that were there stay as set.
  /// Throws Error (resource) when a limit of the GL is exceeded or it is out of memory; then what was there
  /// stays. Leaves bindings of GL as they were.
  void upload(std::span<const PenumbraMap* const> maps, TextureLayout layout = TextureLayout::two_level,
              const std::array<double, 3>& origin = {0, 0, 0});

  /// Changes how map `map` (< map_count()) is looked up; takes effect at the next bind().
  void set_look_up(std::uint32_t map, const LookUpSettings& settings);

  /// Binds the textures to texture units `first_unit` and `first_unit` + 1 and the tables to uniform buffer
  /// binding `block_binding`, and points the linked `program` at them. These three bindings stay; the active
  /// texture unit and the program in use are restored. Inputs that the program does not use are left out.
  void bind(std::uint32_t program, std::uint32_t first_unit = 0, std::uint32_t block_binding = 0);

  /// pdsm.glsl, for after the #version line; with the lines that choose the layout of the last upload() and,
  /// for these_maps, shader_constants().
  [[nodiscard]] std::string shader_text(ShaderScope scope = ShaderScope::any_maps) const;

  [[nodiscard]] std::uint32_t map_count() const;
  [[nodiscard]] std::uint64_t texture_bytes() const;  ///< of both textures
  [[nodiscard]] const TextureLimits& limits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pdsm
