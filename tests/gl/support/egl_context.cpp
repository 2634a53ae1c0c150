// SPDX-License-Identifier: Apache-2.0
#include "egl_context.h"

#include <epoxy/egl.h>

#include <array>
#include <stdexcept>
#include <string>

namespace pdsm::testing {

struct EglContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

EglContext::EglContext(GlApi api) : handles_(std::make_unique<Handles>()) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string("EGL: ") + what + " failed");
  };
  handles_->display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  require(handles_->display != EGL_NO_DISPLAY, "eglGetPlatformDisplay");
  require(eglInitialize(handles_->display, nullptr, nullptr), "eglInitialize");
  const bool embedded = api == GlApi::es_30;
  require(eglBindAPI(embedded ? EGL_OPENGL_ES_API : EGL_OPENGL_API), "eglBindAPI");
  const EGLint major = api == GlApi::core_45 ? 4 : 3;
  const EGLint minor = api == GlApi::core_45 ? 5 : embedded ? 0 : 3;
  const std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor,
                                      EGL_NONE};
  handles_->context = eglCreateContext(handles_->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version.data());
  require(handles_->context != EGL_NO_CONTEXT, "eglCreateContext");
  require(eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context),
          "eglMakeCurrent");
}

EglContext::~EglContext() {
  eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(handles_->display, handles_->context);
}

GlSymbolLoader EglContext::loader() {
  return [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); };
}

}  // namespace pdsm::testing
