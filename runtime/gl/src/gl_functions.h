// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GL/glcorearb.h>

#include <string>

#include "pdsm/runtime/shadow_textures.h"

namespace pdsm {

/// Every GL function that the library calls, by the name after "gl": result, name, parameters.
#define PDSM_GL_FUNCTIONS(F)                    \
  F(ACTIVETEXTURE, ActiveTexture)               \
  F(BINDBUFFER, BindBuffer)                     \
  F(BINDBUFFERBASE, BindBufferBase)             \
  F(BINDTEXTURE, BindTexture)                   \
  F(BUFFERDATA, BufferData)                     \
  F(DELETEBUFFERS, DeleteBuffers)               \
  F(DELETETEXTURES, DeleteTextures)             \
  F(GENBUFFERS, GenBuffers)                     \
  F(GENTEXTURES, GenTextures)                   \
  F(GETERROR, GetError)                         \
  F(GETINTEGERV, GetIntegerv)                   \
  F(GETSTRING, GetString)                       \
  F(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex) \
  F(GETUNIFORMLOCATION, GetUniformLocation)     \
  F(PIXELSTOREI, PixelStorei)                   \
  F(TEXIMAGE2D, TexImage2D)                     \
  F(TEXPARAMETERI, TexParameteri)               \
  F(UNIFORM1I, Uniform1i)                       \
  F(UNIFORMBLOCKBINDING, UniformBlockBinding)   \
  F(USEPROGRAM, UseProgram)

struct GlFunctions {
#define PDSM_DECLARE(type, name) PFNGL##type##PROC name = nullptr;
  PDSM_GL_FUNCTIONS(PDSM_DECLARE)
#undef PDSM_DECLARE

  /// An integer of the context's state.
  [[nodiscard]] GLint get(GLenum name) const {
    GLint value = 0;
    GetIntegerv(name, &value);
    return value;
  }
};

/// Loads all; throws Error (resource) that names the first that is missing, or the version when the context
/// is older than OpenGL 3.3 or OpenGL ES 3.0.
[[nodiscard]] GlFunctions load_gl_functions(const GlSymbolLoader& load);

}  // namespace pdsm
