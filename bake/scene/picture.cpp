// SPDX-License-Identifier: Apache-2.0
#include "scene/picture.h"

#include <fmt/format.h>

#include <limits>
#include <memory>

#include "scene/format_fault.h"

// Pictures alone that models are textured with; files are read through FileSource only.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace pdsm {
namespace {

static_assert(STBI_MAX_DIMENSIONS == kMostPictureTexels);

struct FreePicture {
  void operator()(stbi_uc* picture) const { stbi_image_free(picture); }
};

[[noreturn]] void refuse() {
  const char* const reason = stbi_failure_reason();
  throw FormatFault(fmt::format("is not a PNG, JPEG or TGA picture that can be read ({})",
                                reason != nullptr ? reason : "unknown fault"));
}

}  // namespace

Picture read_picture(std::string_view bytes, std::uint32_t channels) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw FormatFault("is larger than 2 GiB");
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  int width = 0, height = 0, file_channels = 0;
  const std::unique_ptr<stbi_uc, FreePicture> values(stbi_load_from_memory(
      data, static_cast<int>(bytes.size()), &width, &height, &file_channels, static_cast<int>(channels)));
  if (!values) refuse();
  Picture picture{static_cast<std::uint32_t>(width),
                  static_cast<std::uint32_t>(height),
                  channels,
                  static_cast<std::uint32_t>(file_channels),
                  {}};
  const std::size_t count = std::size_t{picture.width} * picture.height * channels;
  picture.values.assign(values.get(), values.get() + count);
  return picture;
}

}  // namespace pdsm
