// SPDX-License-Identifier: Apache-2.0
// Joining of equal positions, and closedness.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "pdsm/bake/scene.h"
#include "scene/mesh_cleanup.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::uint64_t hash_position(const glm::vec3& p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Adding 0 makes -0 and 0, which are equal, hash alike.
    hash = (hash ^ std::bit_cast<std::uint32_t>(p[axis] + 0.0F)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32;
  }
  return hash;
}

/// Numbers distinct positions 0, 1, ... in order of arrival; a hash table with linear probing.
class PositionIndex {
 public:
  explicit PositionIndex(std::size_t capacity)
      : slots_(std::bit_ceil(capacity * 2 + 1), kNone), mask_(slots_.size() - 1) {}

  std::uint32_t index_of(const glm::vec3& p) {
    for (std::uint64_t slot = hash_position(p) & mask_;; slot = (slot + 1) & mask_) {
      if (slots_[slot] == kNone) {
        slots_[slot] = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(p);
        return slots_[slot];
      }
      if (positions_[slots_[slot]] == p) return slots_[slot];
    }
  }

  std::vector<glm::vec3> take_positions() { return std::move(positions_); }

 private:
  std::vector<std::uint32_t> slots_;
  std::uint64_t mask_;
  std::vector<glm::vec3> positions_;
};

bool all_in_range(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  return std::ranges::all_of(mesh.triangles,
                             [&](const glm::uvec3& t) { return t.x < count && t.y < count && t.z < count; });
}

/// Calls visit(from, to) for the three edges of each triangle that has three different corners.
template <typename Visit>
void visit_edges(const Mesh& mesh, Visit&& visit) {
  for (const glm::uvec3& t : mesh.triangles) {
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    visit(t.x, t.y);
    visit(t.y, t.z);
    visit(t.z, t.x);
  }
}

/// The edges of a mesh, each filed under its lower corner as 2 * upper corner + (runs upwards).
struct EdgeTable {
  std::vector<std::size_t> first;  ///< corner count + 1 offsets
  std::vector<std::uint64_t> edges;
};

EdgeTable make_edge_table(const Mesh& mesh) {
  EdgeTable table;
  table.first.assign(mesh.positions.size() + 1, 0);
  visit_edges(mesh,
              [&](std::uint32_t a, std::uint32_t b) { ++table.first[std::min(a, b) + std::size_t{1}]; });
  for (std::size_t i = 1; i < table.first.size(); ++i) table.first[i] += table.first[i - 1];
  table.edges.resize(table.first.back());
  std::vector<std::size_t> next(table.first.begin(), table.first.end() - 1);
  visit_edges(mesh, [&](std::uint32_t a, std::uint32_t b) {
    table.edges[next[std::min(a, b)]++] = std::uint64_t{std::max(a, b)} * 2 + (a < b ? 1 : 0);
  });
  return table;
}

/// Whether the edges filed under one corner are pairs of opposite direction, each pair once. Sorts them:
/// of two equal pairs the downward edges then come first, and do not pair.
bool is_paired(std::vector<std::uint64_t>::iterator begin, std::vector<std::uint64_t>::iterator end) {
  if ((end - begin) % 2 != 0) return false;
  std::sort(begin, end);
  for (auto edge = begin; edge != end; edge += 2) {
    const std::uint64_t downwards = edge[0], upwards = edge[1];
    if (downwards % 2 != 0 || upwards != downwards + 1) return false;
  }
  return true;
}

}  // namespace

Mesh weld(const Mesh& mesh) {
  PositionIndex index(mesh.positions.size());
  std::vector<std::uint32_t> joined(mesh.positions.size(), kNone);
  Mesh welded;
  welded.closed = mesh.closed;
  welded.triangles.reserve(mesh.triangles.size());
  for (glm::uvec3 t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& to = joined[t[corner]];
      if (to == kNone) to = index.index_of(mesh.positions[t[corner]]);
      t[corner] = to;
    }
    welded.triangles.push_back(t);
  }
  welded.positions = index.take_positions();
  return welded;
}

bool is_closed(const Mesh& mesh) {
  if (mesh.triangles.empty() || !all_in_range(mesh)) return false;
  EdgeTable table = make_edge_table(weld(mesh));
  for (std::size_t i = 0; i + 1 < table.first.size(); ++i) {
    const auto begin = table.edges.begin();
    const auto from = static_cast<std::ptrdiff_t>(table.first[i]);
    const auto to = static_cast<std::ptrdiff_t>(table.first[i + 1]);
    if (!is_paired(begin + from, begin + to)) return false;
  }
  return !table.edges.empty();
}

}  // namespace pdsm
