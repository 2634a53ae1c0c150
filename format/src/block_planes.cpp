// SPDX-License-Identifier: Apache-2.0
#include "block_planes.h"

#include <algorithm>
#include <array>

#include "block_codec.h"
#include "bytes.h"
#include "vertex_bits.h"
#include "zstd_stream.h"

namespace pdsm {
namespace {

/// What is coded. Each stream has statistics of its own and is split into byte planes of its own.
enum Stream : std::uint32_t {
  kCounts,      ///< vertices of each function
  kDomainEnds,  ///< of each texel
  kFirstDepth,  ///< of each function that has vertices
  kNextDepth,   ///< of all other vertices
  kFirstBegin,
  kNextBegin,
  kEnd,  ///< of all vertices but the last of a function, whose end is its begin
  kStreamCount
};

/// Head of the decompressed stream; all sizes follow from it.
struct PlanesHeader {
  std::uint32_t vertex_count;
  std::uint32_t function_count;  ///< functions that have vertices
  std::uint32_t has_domain_end;
};

constexpr std::uint32_t kCountBits = 32;

std::uint32_t stream_bits(const VertexCoding& coding, std::uint32_t stream) {
  if (stream == kCounts) return kCountBits;
  return stream <= kNextDepth ? coding.depth_bits : coding.value_bits;
}

std::uint64_t stream_length(const PlanesHeader& header, std::uint64_t texel_count, std::uint32_t stream) {
  switch (stream) {
    case kCounts:
      return texel_count;
    case kDomainEnds:
      return header.has_domain_end != 0 ? texel_count : 0;
    case kFirstDepth:
    case kFirstBegin:
      return header.function_count;
    default:
      return header.vertex_count - header.function_count;
  }
}

/// (value - predicted) modulo 2^bits, folded so that small differences of both signs are small numbers.
std::uint32_t fold(std::uint32_t value, std::uint32_t predicted, std::uint32_t bits) {
  const std::uint32_t shift = 32 - bits;
  const auto difference = static_cast<std::int32_t>((value - predicted) << shift) >> shift;
  const auto folded =
      (static_cast<std::uint32_t>(difference) << 1) ^ static_cast<std::uint32_t>(difference >> 31);
  return (folded << shift) >> shift;
}

std::uint32_t unfold(std::uint32_t folded, std::uint32_t predicted, std::uint32_t bits) {
  const std::uint32_t shift = 32 - bits;
  const std::uint32_t difference = (folded >> 1) ^ (0U - (folded & 1));
  return ((predicted + difference) << shift) >> shift;
}

/// Turns values into residuals.
class Encoder {
 public:
  explicit Encoder(const VertexCoding& coding) : coding_(coding) {}

  void code(Stream stream, std::uint32_t predicted, std::uint32_t& value) {
    streams_[stream].push_back(fold(value, predicted, stream_bits(coding_, stream)));
  }
  FunctionVertex start(const std::uint32_t* words) const { return load_vertex(coding_, words); }
  void finish(const FunctionVertex&, std::uint32_t*) const {}

  /// Byte planes, lowest byte first, of all streams.
  [[nodiscard]] std::vector<std::vector<std::byte>> planes() const {
    std::vector<std::vector<std::byte>> planes;
    for (std::uint32_t stream = 0; stream < kStreamCount; ++stream) {
      for (std::uint32_t shift = 0; shift < stream_bits(coding_, stream); shift += 8) {
        auto& plane = planes.emplace_back();
        plane.reserve(streams_[stream].size());
        for (std::uint32_t value : streams_[stream]) plane.push_back(static_cast<std::byte>(value >> shift));
      }
    }
    return planes;
  }

 private:
  VertexCoding coding_;
  std::array<std::vector<std::uint32_t>, kStreamCount> streams_;
};

/// Turns residuals into values. The caller has seen to it that the planes are as long as it will ask for.
class Decoder {
 public:
  Decoder(const VertexCoding& coding, const PlanesHeader& header, std::uint64_t texel_count,
          std::span<const std::byte> planes)
      : coding_(coding) {
    for (std::uint32_t stream = 0; stream < kStreamCount; ++stream) {
      lengths_[stream] = stream_length(header, texel_count, stream);
      cursors_[stream] = planes.data();
      planes = planes.subspan(lengths_[stream] * (stream_bits(coding, stream) / 8));
    }
  }

  void code(Stream stream, std::uint32_t predicted, std::uint32_t& value) {
    const std::uint32_t bits = stream_bits(coding_, stream);
    const std::byte* cursor = cursors_[stream]++;
    std::uint32_t folded = 0;
    for (std::uint32_t shift = 0; shift < bits; shift += 8, cursor += lengths_[stream])
      folded |= static_cast<std::uint32_t>(*cursor) << shift;
    value = unfold(folded, predicted, bits);
  }
  FunctionVertex start(const std::uint32_t*) const { return {}; }
  void finish(const FunctionVertex& vertex, std::uint32_t* words) const {
    store_vertex(coding_, vertex, words);
  }

 private:
  VertexCoding coding_;
  std::array<std::uint64_t, kStreamCount> lengths_{};
  std::array<const std::byte*, kStreamCount> cursors_{};
};

/// The packed vertices of one function.
struct PackedFunction {
  const std::uint32_t* words = nullptr;
  std::uint32_t count = 0;
};

/// Vertex `n` of a function of `count` matches this one of a neighbour's of `neighbour_count`: the first
/// the first, the last the last, those between in proportion.
std::uint32_t match_vertex(std::uint32_t n, std::uint32_t count, std::uint32_t neighbour_count) {
  if (count <= 1) return 0;
  const std::uint64_t pieces = count - 1;
  return static_cast<std::uint32_t>((std::uint64_t{n} * (neighbour_count - 1) * 2 + pieces) / (pieces * 2));
}

/// One function, predicted from a neighbour's: the same law for both directions.
template <typename Coder>
void code_function(Coder& coder, const VertexCoding& coding, const PackedFunction& neighbour,
                   std::uint32_t* words, std::uint32_t count) {
  const std::uint32_t stride = coding.words_per_vertex();
  FunctionVertex before;
  for (std::uint32_t n = 0; n < count; ++n, words += stride) {
    FunctionVertex guess = before;
    if (neighbour.count > 0) {
      const std::uint32_t match = match_vertex(n, count, neighbour.count);
      guess = load_vertex(coding, neighbour.words + std::size_t{match} * stride);
    }
    // A vertex lies behind the one before; a piece mostly begins where that one's ended.
    guess.depth = std::max(guess.depth, before.depth);
    if (n > 0) guess.begin = before.end;

    FunctionVertex vertex = coder.start(words);
    coder.code(n == 0 ? kFirstDepth : kNextDepth, guess.depth, vertex.depth);
    coder.code(n == 0 ? kFirstBegin : kNextBegin, guess.begin, vertex.begin);
    if (n + 1 < count) {
      coder.code(kEnd, guess.end, vertex.end);
    } else {
      vertex.end = vertex.begin;
    }
    coder.finish(vertex, words);
    before = vertex;
  }
}

/// The neighbour to predict a function from: left or below, the one with as many vertices if any.
PackedFunction pick_neighbour(const VertexCoding& coding, std::uint32_t width, const FunctionBlock& block,
                              std::uint32_t texel) {
  const auto& first = block.first;
  const auto count_of = [&](std::uint32_t t) { return first[t + 1] - first[t]; };
  const std::uint32_t count = count_of(texel);
  const std::uint32_t left = texel % width > 0 ? texel - 1 : texel;
  const std::uint32_t below = texel >= width ? texel - width : texel;
  std::uint32_t chosen = texel;
  if (below != texel && count_of(below) > 0) chosen = below;
  if (left != texel && count_of(left) > 0 &&
      (chosen == texel || count_of(below) != count || count_of(left) == count))
    chosen = left;
  if (chosen == texel) return {};
  return {block.words.data() + std::size_t{first[chosen]} * coding.words_per_vertex(), count_of(chosen)};
}

/// Domain ends, each predicted by continuing the plane through its three neighbours.
template <typename Coder>
void code_domain_ends(Coder& coder, std::uint32_t width, std::vector<std::uint32_t>& ends) {
  for (std::size_t texel = 0; texel < ends.size(); ++texel) {
    const bool has_left = texel % width > 0, has_below = texel >= width;
    std::uint32_t guess = 0;
    if (has_left && has_below)
      guess = ends[texel - 1] + ends[texel - width] - ends[texel - width - 1];
    else if (has_left)
      guess = ends[texel - 1];
    else if (has_below)
      guess = ends[texel - width];
    coder.code(kDomainEnds, guess, ends[texel]);
  }
}

template <typename Coder>
void code_functions(Coder& coder, const VertexCoding& coding, std::uint32_t width, FunctionBlock& block) {
  for (std::uint32_t texel = 0; texel + 1 < block.first.size(); ++texel) {
    const std::uint32_t count = block.first[texel + 1] - block.first[texel];
    if (count == 0) continue;
    std::uint32_t* words = block.words.data() + std::size_t{block.first[texel]} * coding.words_per_vertex();
    code_function(coder, coding, pick_neighbour(coding, width, block, texel), words, count);
  }
}

/// Function offsets from coded counts; false where these don't add up to what the header says.
bool decode_counts(Decoder& decoder, const PlanesHeader& header, std::vector<std::uint32_t>& first) {
  std::uint64_t vertex_count = 0;
  std::uint32_t function_count = 0;
  first[0] = 0;
  for (std::size_t texel = 0; texel + 1 < first.size(); ++texel) {
    std::uint32_t count = 0;
    decoder.code(kCounts, 0, count);
    vertex_count += count;
    function_count += count > 0 ? 1 : 0;
    if (vertex_count > header.vertex_count) return false;
    first[texel + 1] = static_cast<std::uint32_t>(vertex_count);
  }
  return vertex_count == header.vertex_count && function_count == header.function_count;
}

}  // namespace

std::vector<std::byte> compress_block(const VertexCoding& coding, std::uint32_t width,
                                      const FunctionBlock& block) {
  Encoder encoder(coding);
  FunctionBlock copy = block;
  std::uint32_t function_count = 0;
  for (std::size_t texel = 0; texel + 1 < copy.first.size(); ++texel) {
    std::uint32_t count = copy.first[texel + 1] - copy.first[texel];
    function_count += count > 0 ? 1 : 0;
    encoder.code(kCounts, 0, count);
  }
  code_domain_ends(encoder, width, copy.domain_end);
  code_functions(encoder, coding, width, copy);

  auto parts = encoder.planes();
  std::vector<std::byte> head;
  append_value(head, PlanesHeader{copy.first.back(), function_count, copy.domain_end.empty() ? 0U : 1U});
  parts.insert(parts.begin(), std::move(head));
  return compress_parts(parts);
}

bool decompress_block(const VertexCoding& coding, std::uint32_t width, std::uint32_t height,
                      std::span<const std::byte> stored, std::uint64_t raw_size, FunctionBlock& block) {
  ZstdReader reader(stored);
  PlanesHeader header{};
  if (!reader.read(std::as_writable_bytes(std::span(&header, 1)))) return false;
  const std::uint64_t texel_count = std::uint64_t{width} * height;
  const bool has_domain_end = header.has_domain_end == 1;
  if (header.has_domain_end > 1 || header.function_count > texel_count ||
      header.function_count > header.vertex_count ||
      raw_size != raw_block_size(coding, texel_count, header.vertex_count, has_domain_end))
    return false;

  // All planes are there before anything of the block is allocated.
  std::uint64_t plane_bytes = 0;
  for (std::uint32_t stream = 0; stream < kStreamCount; ++stream)
    plane_bytes += stream_length(header, texel_count, stream) * (stream_bits(coding, stream) / 8);
  std::vector<std::byte> planes;
  if (!reader.append(planes, plane_bytes) || !reader.at_end()) return false;

  Decoder decoder(coding, header, texel_count, planes);
  block.first.resize(texel_count + 1);
  if (!decode_counts(decoder, header, block.first)) return false;
  block.domain_end.resize(has_domain_end ? texel_count : 0);
  block.words.resize(std::size_t{header.vertex_count} * coding.words_per_vertex());
  code_domain_ends(decoder, width, block.domain_end);
  code_functions(decoder, coding, width, block);
  return true;
}

}  // namespace pdsm
