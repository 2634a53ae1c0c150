// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/shadow_textures.h"

#include <cassert>
#include <utility>
#include <vector>

#include "gl_functions.h"
#include "gl_texture.h"

namespace pdsm {

struct ShadowTextures::State {
  explicit State(const GlSymbolLoader& load)
      : gl(std::make_shared<const GlFunctions>(load_gl_functions(load))), tables(gl, GlName::Kind::buffer) {
    limits.texture_size = static_cast<std::uint32_t>(gl->get(GL_MAX_TEXTURE_SIZE));
  }

  /// Copies the tables to the buffer; its binding is left as it was.
  void write_tables() {
    const GLint bound = gl->get(GL_UNIFORM_BUFFER_BINDING);
    gl->BindBuffer(GL_UNIFORM_BUFFER, tables.name());
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof(ShaderTables), &contents, GL_DYNAMIC_DRAW);
    gl->BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(bound));
    tables_changed = false;
  }

  void bind_texture(GLuint program, const char* uniform, std::uint32_t unit, const GlName& texture) const {
    gl->ActiveTexture(GL_TEXTURE0 + unit);
    gl->BindTexture(GL_TEXTURE_2D, texture.name());
    const GLint location = gl->GetUniformLocation(program, uniform);
    if (location >= 0) gl->Uniform1i(location, static_cast<GLint>(unit));
  }

  std::shared_ptr<const GlFunctions> gl;
  TextureLimits limits;
  GlName tables;
  std::unique_ptr<GlName> index, vertices;
  ShaderTables contents;
  bool tables_changed = true;
  std::vector<LookUpSettings> settings;  ///< one a map
  TextureLayout layout = TextureLayout::two_level;
  std::string constants;  ///< shader_constants() of the maps
  std::uint64_t texture_bytes = 0;
};

ShadowTextures::ShadowTextures(const GlSymbolLoader& load) : state_(std::make_unique<State>(load)) {
  upload({});
}
ShadowTextures::~ShadowTextures() = default;
ShadowTextures::ShadowTextures(ShadowTextures&&) noexcept = default;
ShadowTextures& ShadowTextures::operator=(ShadowTextures&&) noexcept = default;

void ShadowTextures::upload(std::span<const PenumbraMap* const> maps, TextureLayout layout,
                            const std::array<double, 3>& origin) {
  const MapTextures packed = make_map_textures(maps, layout, state_->limits, origin);
  std::string constants = shader_constants(packed);
  auto index = upload_texture(state_->gl, packed.index);
  auto vertices = upload_texture(state_->gl, packed.vertices);

  // Nothing can fail from here on.
  state_->index = std::move(index);
  state_->vertices = std::move(vertices);
  state_->contents = packed.tables;
  state_->layout = layout;
  state_->constants = std::move(constants);
  state_->texture_bytes = packed.bytes();
  state_->settings.resize(maps.size());
  for (std::uint32_t n = 0; n < state_->settings.size(); ++n)
    pdsm::set_look_up(state_->contents, n, state_->settings[n]);
  state_->tables_changed = true;
}

void ShadowTextures::set_look_up(std::uint32_t map, const LookUpSettings& settings) {
  assert(map < map_count());
  state_->settings[map] = settings;
  pdsm::set_look_up(state_->contents, map, settings);
  state_->tables_changed = true;
}

void ShadowTextures::bind(std::uint32_t program, std::uint32_t first_unit, std::uint32_t block_binding) {
  const GlFunctions& gl = *state_->gl;
  if (state_->tables_changed) state_->write_tables();
  const GLint active = gl.get(GL_ACTIVE_TEXTURE), used = gl.get(GL_CURRENT_PROGRAM);
  gl.UseProgram(program);
  state_->bind_texture(program, "pdsm_index", first_unit, *state_->index);
  state_->bind_texture(program, "pdsm_vertices", first_unit + 1, *state_->vertices);
  gl.UseProgram(static_cast<GLuint>(used));
  gl.ActiveTexture(static_cast<GLenum>(active));

  const GLuint block = gl.GetUniformBlockIndex(program, "PdsmTables");
  if (block != GL_INVALID_INDEX) gl.UniformBlockBinding(program, block, block_binding);
  const GLint generic = gl.get(GL_UNIFORM_BUFFER_BINDING);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, block_binding, state_->tables.name());
  gl.BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(generic));
}

std::string ShadowTextures::shader_text(ShaderScope scope) const {
  std::string lines = state_->layout == TextureLayout::fixed_depth ? "#define PDSM_FIXED_DEPTH\n" : "";
  if (scope == ShaderScope::these_maps) lines += state_->constants;
  return lines + std::string(pdsm::shader_text());
}

std::uint32_t ShadowTextures::map_count() const {
  return static_cast<std::uint32_t>(state_->settings.size());
}
std::uint64_t ShadowTextures::texture_bytes() const {
  return state_->texture_bytes;
}
const TextureLimits& ShadowTextures::limits() const {
  return state_->limits;
}

}  // namespace pdsm
