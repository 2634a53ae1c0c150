// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "gl_functions.h"
#include "pdsm/runtime/map_textures.h"

namespace pdsm {

/// A GL texture or buffer that is deleted with its owner.
class GlName {
 public:
  enum class Kind { texture, buffer };
  GlName(std::shared_ptr<const GlFunctions> gl, Kind kind);
  ~GlName();
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  std::shared_ptr<const GlFunctions> gl_;
  Kind kind_;
  GLuint name_ = 0;
};

/// Uploads a texture of unsigned integers, nearest, one level. Leaves the binding of the active unit and the
/// pixel store as they were. Throws Error (resource) when GL refuses it.
[[nodiscard]] std::unique_ptr<GlName> upload_texture(const std::shared_ptr<const GlFunctions>& gl,
                                                     const Texture& texture);

}  // namespace pdsm
