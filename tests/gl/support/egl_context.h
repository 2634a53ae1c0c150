// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "pdsm/runtime/shadow_textures.h"

namespace pdsm::testing {

enum class GlApi { core_33, core_45, es_30 };

/// A context without any window (EGL surfaceless), current on this thread while it lives. Throws
/// std::runtime_error when there is none: a test that can't have its GL fails, it is not skipped.
class EglContext {
 public:
  explicit EglContext(GlApi api);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// eglGetProcAddress.
  [[nodiscard]] static GlSymbolLoader loader();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace pdsm::testing
