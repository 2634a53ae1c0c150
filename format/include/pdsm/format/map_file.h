// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pdsm/format/penumbra_map.h"

/// Reading and writing of penumbra map files. FORMAT.md beside this folder is the byte-level
/// specification; its section numbers are quoted in the code.
namespace pdsm {

inline constexpr std::uint32_t kFormatMajor = 1;  ///< readers refuse another major version
inline constexpr std::uint32_t kFormatMinor = 0;

enum class Compression { none, zstd };

struct WriteOptions {
  Compression compression = Compression::zstd;  ///< of each block
};

/// What a hostile or broken file may make the reader allocate at most, in bytes.
struct ReadLimits {
  std::uint64_t decoded_bytes = std::uint64_t{8} << 30;
};

/// A fault of a file: a stable number (FORMAT.md section 8), the byte offset where it was seen, and what
/// was expected there.
struct FileFault {
  int number = 0;
  std::uint64_t offset = 0;
  std::string expected;
};

/// What one chunk of a file takes.
struct ChunkSummary {
  std::string type;         ///< four letters
  std::uint32_t image = 0;  ///< that a BLCK chunk is of; else 0
  std::uint64_t stored_bytes = 0, decoded_bytes = 0;
};

/// Encodes one block as the payload of a BLCK chunk, without file or table. Pure; any thread.
struct EncodedBlock {
  std::uint32_t encoding = 0;  ///< FORMAT.md section 6
  std::uint64_t decoded_bytes = 0;
  std::uint64_t texels = 0, vertices = 0;  ///< functions, and the vertices of all of them
  std::vector<std::byte> bytes;
};
[[nodiscard]] EncodedBlock encode_block(const VertexCoding& coding, std::uint32_t block_width,
                                        std::uint32_t block_height, const FunctionBlock& block,
                                        const WriteOptions& options = {});

/// Inverse of encode_block for blocks that it made. Throws Error (input) on any other bytes.
[[nodiscard]] FunctionBlock decode_block(const VertexCoding& coding, std::uint32_t block_width,
                                         std::uint32_t block_height, const EncodedBlock& block);

/// Writes `map` to `path` as a whole or not at all: a temporary file in the same folder is written,
/// synced and renamed. Throws Error (resource) and leaves an old file untouched on any failure.
/// Asserts the invariants of penumbra_map.h. The bytes depend on `map` and `options` alone.
/// Returns the number of bytes written.
std::uint64_t write_map(const PenumbraMap& map, const std::filesystem::path& path,
                        const WriteOptions& options = {});

/// The same, of a map whose blocks are encoded already: `map.images[n].blocks` are empty and
/// `blocks[n][b]` holds block b of image n.
std::uint64_t write_encoded_map(const PenumbraMap& map, std::span<const std::vector<EncodedBlock>> blocks,
                                const std::filesystem::path& path);

/// The number of bytes that write_encoded_map would write.
[[nodiscard]] std::uint64_t encoded_map_bytes(const PenumbraMap& map,
                                              std::span<const std::vector<EncodedBlock>> blocks);

/// Reads a file of any origin: safe on any bytes, allocates at most `limits` (and once more what its largest
/// block takes, while that is decompressed), and little before the data has been seen to be there.
/// The file is mapped: it must not be cut while this runs, which AtomicFile never does.
/// Throws Error (input) "path:offset N: fault F: expected ...".
[[nodiscard]] PenumbraMap read_map(const std::filesystem::path& path, const ReadLimits& limits = {});

/// The same from bytes in memory; `name` stands for the path in messages.
[[nodiscard]] PenumbraMap read_map(std::span<const std::byte> bytes, const std::string& name,
                                   const ReadLimits& limits = {});

/// The metadata of a file whose header, table and checksums hold, without a look into its blocks: far cheaper
/// than reading it. Nothing where there is no such file. Safe on any bytes.
[[nodiscard]] std::optional<std::string> read_metadata(const std::filesystem::path& path,
                                                       const ReadLimits& limits = {});

/// The same bytes as write_map writes.
[[nodiscard]] std::vector<std::byte> serialize_map(const PenumbraMap& map, const WriteOptions& options = {});

/// Full validation: all faults that can be told apart without trusting broken parts, in file order;
/// empty for a good file. Never throws on content.
[[nodiscard]] std::vector<FileFault> check_map(std::span<const std::byte> bytes,
                                               const ReadLimits& limits = {});

/// The chunks of a file that read_map accepts, in file order.
[[nodiscard]] std::vector<ChunkSummary> list_chunks(std::span<const std::byte> bytes);

/// Invariants of penumbra_map.h that the file can't guarantee by form: sizes add up, depths of a function
/// increase strictly, codes within range, last vertex constant, finite views. Empty when all hold,
/// otherwise the first that does not.
[[nodiscard]] std::string find_invariant_fault(const PenumbraMap& map);

}  // namespace pdsm
