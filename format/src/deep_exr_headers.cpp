// SPDX-License-Identifier: Apache-2.0
#include "deep_exr_headers.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bytes.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kExrMagic = 20000630, kMultiPartFlag = 0x1000;

/// Attribute types whose values always take the same bytes.
constexpr std::array<std::pair<std::string_view, std::size_t>, 24> kFixedSizes{{{"box2f", 16},
                                                                                {"box2i", 16},
                                                                                {"chromaticities", 32},
                                                                                {"compression", 1},
                                                                                {"deepImageState", 1},
                                                                                {"double", 8},
                                                                                {"envmap", 1},
                                                                                {"float", 4},
                                                                                {"int", 4},
                                                                                {"keycode", 28},
                                                                                {"lineOrder", 1},
                                                                                {"m33d", 72},
                                                                                {"m33f", 36},
                                                                                {"m44d", 128},
                                                                                {"m44f", 64},
                                                                                {"rational", 8},
                                                                                {"tiledesc", 9},
                                                                                {"timecode", 8},
                                                                                {"v2d", 16},
                                                                                {"v2f", 8},
                                                                                {"v2i", 8},
                                                                                {"v3d", 24},
                                                                                {"v3f", 12},
                                                                                {"v3i", 12}}};

/// The zero-terminated text at `reader`, skipped; empty optional where it does not end.
std::optional<std::string> take_name(ByteReader& reader) {
  std::string name;
  while (reader.remaining() > 0) {
    const auto letter = reader.value<char>();
    if (letter == '\0') return name;
    name += letter;
  }
  return std::nullopt;
}

/// Channels until one without a name; each has a name and 16 bytes.
bool is_channel_list(ByteReader value) {
  for (;;) {
    const auto name = take_name(value);
    if (!name) return false;
    if (name->empty()) return value.remaining() == 0;
    value.skip(16);
  }
}

bool is_preview(ByteReader value) {
  const std::uint64_t width = value.value<std::uint32_t>(), height = value.value<std::uint32_t>();
  std::uint64_t bytes = 0;
  return value.ok() && checked_multiply(width * height, 4, bytes) && bytes == value.remaining();
}

bool is_string_vector(ByteReader value) {
  while (value.ok() && value.remaining() > 0) value.skip(value.value<std::uint32_t>());
  return value.ok();
}

/// Begins with its size unpacked.
bool is_id_manifest(ByteReader value) {
  const std::uint64_t unpacked = value.value<std::uint32_t>();
  return value.ok() && unpacked <= value.remaining() * kMaxExpansion;
}

/// Whether a value of `type` takes the bytes of `value`, all of them. Others, and types that OpenEXR does not
/// know, it takes as long as they say.
bool fits_type(std::string_view type, std::span<const std::byte> value) {
  const auto fixed = std::find_if(kFixedSizes.begin(), kFixedSizes.end(),
                                  [&](const auto& known) { return known.first == type; });
  if (fixed != kFixedSizes.end()) return value.size() == fixed->second;
  if (type == "chlist") return is_channel_list(ByteReader(value));
  if (type == "preview") return is_preview(ByteReader(value));
  if (type == "stringvector") return is_string_vector(ByteReader(value));
  if (type == "floatvector") return value.size() % sizeof(float) == 0;
  if (type == "idmanifest") return is_id_manifest(ByteReader(value));
  return true;
}

/// Skips one header. Whether it has attributes (one without ends the headers of a multi-part file); empty
/// where one is at fault.
std::optional<bool> skip_header(ByteReader& reader, std::span<const std::byte> bytes) {
  for (bool any = false;; any = true) {
    const auto name = take_name(reader);
    if (!name) return std::nullopt;
    if (name->empty()) return any;
    const auto type = take_name(reader);
    const auto size = reader.value<std::uint32_t>();
    if (!type || !reader.ok() || size > reader.remaining()) return std::nullopt;
    if (!fits_type(*type, bytes.subspan(reader.position(), size))) return std::nullopt;
    reader.skip(size);
  }
}

}  // namespace

std::optional<ExrHeaderFault> find_exr_header_fault(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  if (reader.value<std::uint32_t>() != kExrMagic) return ExrHeaderFault{"magic", "not an OpenEXR file"};
  const bool is_multi_part = (reader.value<std::uint32_t>() & kMultiPartFlag) != 0;
  auto more = skip_header(reader, bytes);
  while (more && *more && is_multi_part) more = skip_header(reader, bytes);
  if (!more) return ExrHeaderFault{"header", "an attribute ends behind the file, or not where its type ends"};
  return std::nullopt;
}

}  // namespace pdsm
