// SPDX-License-Identifier: Apache-2.0
// PLY files. Assimp reads them too, but hangs on and crashes with files that are cut short.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "pdsm/format/error.h"
#include "scene/format_fault.h"
#include "scene/geometry_import.h"
#include "scene/one_line.h"
#include "scene/ply_header.h"
#include "scene/ply_values.h"
#include "scene/triangulate.h"

namespace pdsm {
namespace {

/// What a corner number that no file has is read as.
constexpr std::uint32_t kBadIndex = ~std::uint32_t{0};

/// Reads the rows of a file, ASCII or binary, and keeps vertex positions and faces.
template <typename Values>
class PlyBody {
 public:
  PlyBody(Values values, LeftOut& left_out) : values_(values), left_out_(left_out) {}

  Mesh read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements) {
      // Rows of nothing, however many.
      if (element.properties.empty()) continue;
      check_room(element);
      row_ = 0;
      try {
        if (element.name == "vertex")
          read_vertices(element);
        else if (element.name == "face")
          read_faces(element);
        else
          for (; row_ < element.count; ++row_) skip_row(element);
      } catch (const FormatFault& fault) {
        throw FormatFault(fmt::format("{} {}: {}", one_line(element.name), row_, fault.what()));
      }
    }
    return make_mesh();
  }

 private:
  /// Refuses a count that the file has no bytes for, before anything is allocated.
  void check_room(const PlyElement& element) const {
    std::size_t row = 0;
    for (const PlyProperty& property : element.properties) {
      row += Values::least_size(property.count_type.value_or(property.type));
    }
    if (element.count > values_.left() / row) {
      throw FormatFault(fmt::format("ends before its {} rows of {}", element.count, one_line(element.name)));
    }
  }

  void skip(const PlyProperty& property) {
    const std::uint64_t count = property.count_type ? list_size(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) values_.next(property.type);
  }

  void skip_row(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) skip(property);
  }

  std::uint64_t list_size(const PlyProperty& property) {
    const double size = values_.next(*property.count_type);
    const auto room = static_cast<double>(values_.left() / Values::least_size(property.type));
    if (!(size >= 0 && size <= room)) throw FormatFault("a list longer than the file");
    return static_cast<std::uint64_t>(size);
  }

  void read_vertices(const PlyElement& element) {
    positions_.reserve(element.count);
    for (; row_ < element.count; ++row_) {
      glm::vec3 position(0);
      for (const PlyProperty& property : element.properties) {
        const bool is_axis = property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
        if (!is_axis || property.count_type)
          skip(property);
        else
          position[property.name[0] - 'x'] = static_cast<float>(values_.next(property.type));
      }
      positions_.push_back(position);
    }
  }

  void read_faces(const PlyElement& element) {
    first_corner_.reserve(element.count + 1);
    for (; row_ < element.count; ++row_) {
      for (const PlyProperty& property : element.properties) {
        const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
        if (is_corners && property.count_type)
          read_corners(property);
        else
          skip(property);
      }
    }
  }

  void read_corners(const PlyProperty& property) {
    const std::uint64_t size = list_size(property);
    first_corner_.push_back(corners_.size());
    for (std::uint64_t i = 0; i < size; ++i) {
      const double index = values_.next(property.type);
      const bool good = index >= 0 && index < kBadIndex && index == std::floor(index);
      corners_.push_back(good ? static_cast<std::uint32_t>(index) : kBadIndex);
    }
  }

  /// Faces may come before the vertices that they name, so they are cut into triangles last.
  Mesh make_mesh() {
    Mesh mesh;
    mesh.triangles.reserve(first_corner_.size());
    first_corner_.push_back(corners_.size());
    for (std::size_t face = 0; face + 1 < first_corner_.size(); ++face) {
      const std::span<const std::uint32_t> polygon(corners_.data() + first_corner_[face],
                                                   first_corner_[face + 1] - first_corner_[face]);
      if (polygon.size() < 3) continue;
      const bool good = std::ranges::all_of(polygon, [&](std::uint32_t i) { return i < positions_.size(); });
      if (good)
        triangulate(positions_, polygon, mesh.triangles);
      else
        left_out_.bad_index += polygon.size() - 2;
    }
    mesh.positions = std::move(positions_);
    return mesh;
  }

  Values values_;
  LeftOut& left_out_;
  std::uint64_t row_ = 0;
  std::vector<glm::vec3> positions_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> first_corner_;
};

Mesh read_mesh(std::string_view bytes, LeftOut& left_out) {
  const PlyHeader header = parse_ply_header(bytes);
  const std::string_view body = bytes.substr(header.size);
  if (header.format == PlyFormat::ascii) return PlyBody(AsciiPlyValues(body), left_out).read(header);
  return PlyBody(BinaryPlyValues(body, header.format), left_out).read(header);
}

}  // namespace

ImportedFile import_ply(const std::filesystem::path& name, const std::string& bytes) {
  PartCollector parts(name.filename().string());
  try {
    LeftOut left_out;
    const Mesh mesh = read_mesh(bytes, left_out);
    parts.add_left_out(left_out);
    parts.add({}, parts.clean(mesh, {}), glm::dmat4(1.0), std::nullopt);
  } catch (const FormatFault& fault) {
    throw Error(Failure::input, name.string(), fault.what());
  }
  return parts.take();
}

}  // namespace pdsm
