// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "pdsm/bake/scene.h"
#include "scene/file_source.h"
#include "scene/gltf_texture_places.h"
#include "scene/tiny_gltf.h"

namespace pdsm {

/// A texture as a material uses it.
struct GltfTexture {
  std::string name;   ///< of its image, for messages
  std::string bytes;  ///< of its image, as in its file
  std::array<MaskWrap, 2> wrap{};
  GltfTexturePlaces places;

  /// Whether both lie on surfaces the same way.
  [[nodiscard]] bool lies_as(const GltfTexture& other) const {
    return wrap == other.wrap && places == other.places;
  }
};

/// The textures of a glTF file, whose images lie in buffers, in the text, or in files beside it.
class GltfTextures {
 public:
  /// Borrows all but the name, which is the file's.
  GltfTextures(FileSource& files, std::filesystem::path name, const tinygltf::Model& model)
      : files_(files), name_(std::move(name)), model_(model) {}

  /// Throws FormatFault for what does not exist or is none.
  [[nodiscard]] GltfTexture read(const tinygltf::TextureInfo& use) const;

 private:
  [[nodiscard]] std::string image_bytes(const tinygltf::Image& image) const;

  FileSource& files_;
  const std::filesystem::path name_;
  const tinygltf::Model& model_;
};

/// Keeps the bytes of an image within the file's own text, to be read when a material asks for it: an image
/// loader for tinygltf.
bool keep_image_bytes(tinygltf::Image* image, int index, std::string* fault, std::string* warning, int width,
                      int height, const unsigned char* bytes, int size, void* unused);

}  // namespace pdsm
