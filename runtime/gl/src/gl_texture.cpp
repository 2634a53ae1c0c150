// SPDX-License-Identifier: Apache-2.0
#include "gl_texture.h"

#include <string>
#include <utility>
#include <vector>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

struct PixelFormat {
  GLint internal;
  GLenum format;
};

PixelFormat pixel_format(std::uint32_t channels) {
  if (channels == 1) return {GL_R32UI, GL_RED_INTEGER};
  if (channels == 2) return {GL_RG32UI, GL_RG_INTEGER};
  return {GL_RGBA32UI, GL_RGBA_INTEGER};
}

/// Sets the pixel store to plain rows from client memory, and back again.
class PlainRows {
 public:
  explicit PlainRows(const GlFunctions& gl) : gl_(gl) {
    for (std::size_t n = 0; n < kNames.size(); ++n) saved_[n] = gl.get(kNames[n]);
    unpack_buffer_ = gl.get(GL_PIXEL_UNPACK_BUFFER_BINDING);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const GLenum name : kNames) gl.PixelStorei(name, name == GL_UNPACK_ALIGNMENT ? 4 : 0);
  }
  ~PlainRows() {
    for (std::size_t n = 0; n < kNames.size(); ++n) gl_.PixelStorei(kNames[n], saved_[n]);
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack_buffer_));
  }
  PlainRows(const PlainRows&) = delete;
  PlainRows& operator=(const PlainRows&) = delete;

 private:
  static constexpr std::array<GLenum, 4> kNames{GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH,
                                                GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS};
  const GlFunctions& gl_;
  std::array<GLint, 4> saved_{};
  GLint unpack_buffer_ = 0;
};

}  // namespace

GlName::GlName(std::shared_ptr<const GlFunctions> gl, Kind kind) : gl_(std::move(gl)), kind_(kind) {
  if (kind_ == Kind::texture)
    gl_->GenTextures(1, &name_);
  else
    gl_->GenBuffers(1, &name_);
}

GlName::~GlName() {
  if (kind_ == Kind::texture)
    gl_->DeleteTextures(1, &name_);
  else
    gl_->DeleteBuffers(1, &name_);
}

std::unique_ptr<GlName> upload_texture(const std::shared_ptr<const GlFunctions>& gl, const Texture& texture) {
  while (gl->GetError() != GL_NO_ERROR) {  // of others, before
  }
  const GLint bound = gl->get(GL_TEXTURE_BINDING_2D);
  auto uploaded = std::make_unique<GlName>(gl, GlName::Kind::texture);
  gl->BindTexture(GL_TEXTURE_2D, uploaded->name());
  const PixelFormat format = pixel_format(texture.channels);
  {
    const PlainRows plain(*gl);
    gl->TexImage2D(GL_TEXTURE_2D, 0, format.internal, static_cast<GLsizei>(texture.width),
                   static_cast<GLsizei>(texture.height), 0, format.format, GL_UNSIGNED_INT,
                   texture.words.data());
  }
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl->TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl->BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  if (gl->GetError() != GL_NO_ERROR)
    throw Error(Failure::resource, "OpenGL",
                "a texture of " + std::to_string(texture.width) + " x " + std::to_string(texture.height) +
                    " texels, " + std::to_string(texture.bytes()) + " bytes, was refused");
  return uploaded;
}

}  // namespace pdsm
