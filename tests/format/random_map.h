// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "pdsm/format/penumbra_map.h"

/// Random but valid maps, the same for the same seed on every machine.
namespace pdsm::testing {

/// mt19937_64 is specified bit for bit; the standard's distributions are not, so they are not used.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 .. bound - 1
  std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
  /// [low, high)
  double real(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  bool chance(double probability) { return real(0, 1) < probability; }

 private:
  std::mt19937_64 engine_;
};

/// What a random map is to be like.
struct MapShape {
  VertexCoding coding;
  std::uint32_t width = 7, height = 13;
  std::uint32_t views = 1, layers = 1, channels = 1, levels = 1;
  std::uint32_t samples = 5;
  std::uint32_t most_vertices = 12;  ///< of a function
  double empty_share = 0.4;          ///< of texels without vertices
  bool domain_end = true;
  bool block_keys = false;
  Projection projection = Projection::perspective;
};

/// Strictly increasing depths, values within range, the last piece constant.
[[nodiscard]] std::vector<FunctionVertex> random_function(Random& random, const VertexCoding& coding,
                                                          std::uint32_t vertex_count);

/// A rigid motion that turns by any angles.
[[nodiscard]] RigidTransform random_motion(Random& random);

/// A block that holds the given functions, without domain ends.
[[nodiscard]] FunctionBlock make_block(const VertexCoding& coding,
                                       const std::vector<std::vector<FunctionVertex>>& functions);

[[nodiscard]] PenumbraMap random_map(std::uint64_t seed, const MapShape& shape = {});

/// The map of one channel that a map of three holds.
[[nodiscard]] PenumbraMap channel_of(const PenumbraMap& map, std::uint32_t channel);

/// A shape drawn at random: all codings, sizes up to 80 texels, several views, layers, channels and levels.
[[nodiscard]] MapShape random_shape(std::uint64_t seed);

/// Every coding that a file may have.
[[nodiscard]] std::vector<VertexCoding> all_codings();

[[nodiscard]] std::string name_of(const VertexCoding& coding);

}  // namespace pdsm::testing
