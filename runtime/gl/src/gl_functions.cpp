// SPDX-License-Identifier: Apache-2.0
#include "gl_functions.h"

#include <string_view>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

template <typename Function>
void load_one(const GlSymbolLoader& load, const char* name, Function& function) {
  function = reinterpret_cast<Function>(load(name));
  if (function == nullptr) throw Error(Failure::resource, "OpenGL", std::string(name) + " is missing");
}

/// "OpenGL ES 3.2 ..." or "4.5 (Core Profile) ...": the driver's own words, for the message.
std::string version_text(const GlFunctions& gl) {
  const GLubyte* text = gl.GetString(GL_VERSION);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "no context";
}

void check_version(const GlFunctions& gl) {
  const std::string text = version_text(gl);
  const bool embedded = text.rfind("OpenGL ES", 0) == 0;
  // Contexts before 3.0 do not know these names: they leave the 0 that stands there.
  const GLint version = 10 * gl.get(GL_MAJOR_VERSION) + gl.get(GL_MINOR_VERSION);
  while (gl.GetError() != GL_NO_ERROR && version == 0) {
  }
  if (version < (embedded ? 30 : 33))
    throw Error(Failure::resource, "OpenGL", "3.3 or ES 3.0 is needed, this is " + text);
}

}  // namespace

GlFunctions load_gl_functions(const GlSymbolLoader& load) {
  GlFunctions gl;
#define PDSM_LOAD(type, name) load_one(load, "gl" #name, gl.name);
  PDSM_GL_FUNCTIONS(PDSM_LOAD)
#undef PDSM_LOAD
  check_version(gl);
  return gl;
}

}  // namespace pdsm
