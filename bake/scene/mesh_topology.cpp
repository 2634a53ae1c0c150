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

template <typename Vector>
std::uint64_t hash_vector(const Vector& p, std::uint64_t hash) {
  for (int axis = 0; axis < Vector::length(); ++axis) {
    // Adding 0 makes -0 and 0, which are equal, hash alike.
    hash = (hash ^ std::bit_cast<std::uint32_t>(p[axis] + 0.0F)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32;
  }
  return hash;
}

std::uint64_t hash_of(const glm::vec3& position) {
  return hash_vector(position, 0);
}

/// A position of a mesh with a mask: where two parts of the mask meet, it is there twice.
struct MaskedPosition {
  glm::vec3 position{0};
  glm::vec2 place{0};

  bool operator==(const MaskedPosition& other) const {
    return position == other.position && place == other.place;
  }
};

std::uint64_t hash_of(const MaskedPosition& p) {
  return hash_vector(p.place, hash_vector(p.position, 0));
}

/// Numbers distinct keys 0, 1, ... in order of arrival; a hash table with linear probing.
template <typename Key>
class KeyIndex {
 public:
  explicit KeyIndex(std::size_t capacity)
      : slots_(std::bit_ceil(capacity * 2 + 1), kNone), slot_bits_(slots_.size() - 1) {}

  std::uint32_t index_of(const Key& key) {
    for (std::uint64_t slot = hash_of(key) & slot_bits_;; slot = (slot + 1) & slot_bits_) {
      if (slots_[slot] == kNone) {
        slots_[slot] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        return slots_[slot];
      }
      if (keys_[slots_[slot]] == key) return slots_[slot];
    }
  }

  std::vector<Key> take_keys() { return std::move(keys_); }

 private:
  std::vector<std::uint32_t> slots_;
  std::uint64_t slot_bits_;
  std::vector<Key> keys_;
};

/// Renumbers the triangles' corners, and tells the distinct keys that they use, in order. `key_of(n)`: of
/// corner n.
template <typename Key, typename KeyOf>
std::vector<Key> join_corners(std::size_t corners, KeyOf&& key_of, std::vector<glm::uvec3>& triangles) {
  KeyIndex<Key> index(corners);
  std::vector<std::uint32_t> joined(corners, kNone);
  for (glm::uvec3& t : triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& to = joined[t[corner]];
      if (to == kNone) to = index.index_of(key_of(t[corner]));
      t[corner] = to;
    }
  }
  return index.take_keys();
}

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
  Mesh welded;
  welded.closed = mesh.closed;
  welded.triangles = mesh.triangles;
  const std::size_t corners = mesh.positions.size();
  if (!mesh.mask) {
    welded.positions = join_corners<glm::vec3>(
        corners, [&](std::uint32_t n) { return mesh.positions[n]; }, welded.triangles);
    return welded;
  }
  welded.mask = mesh.mask;
  const auto masked = [&](std::uint32_t n) { return MaskedPosition{mesh.positions[n], mesh.mask_places[n]}; };
  for (const MaskedPosition& p : join_corners<MaskedPosition>(corners, masked, welded.triangles)) {
    welded.positions.push_back(p.position);
    welded.mask_places.push_back(p.place);
  }
  return welded;
}

bool is_closed(const Mesh& mesh) {
  if (mesh.mask || mesh.triangles.empty() || !all_in_range(mesh)) return false;
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
