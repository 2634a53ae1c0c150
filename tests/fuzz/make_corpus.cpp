// SPDX-License-Identifier: Apache-2.0
// Wrote the binary files of corpus/ (make_corpus tests/fuzz/corpus); the text files there are by hand.
#include <zstd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "file_bytes.h"
#include "golden_map.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/map_file.h"
#include "random_map.h"

namespace pdsm::testing {
namespace {

namespace fs = std::filesystem;

void save(const fs::path& path, const void* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

template <typename T>
std::string raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

PenumbraMap small_map(const VertexCoding& coding, Projection projection, std::uint32_t levels) {
  MapShape shape;
  shape.coding = coding;
  shape.projection = projection;
  shape.width = 4;
  shape.height = 3;
  shape.levels = levels;
  shape.samples = 1;
  shape.most_vertices = 4;
  return random_map(levels, shape);
}

/// A zstd frame that holds `content` as it is, so that a fuzzer changes the planes and not a Huffman code.
Bytes stored_frame(const Bytes& content) {
  // Magic; neither size nor checksum; window 2^20; one last block that is raw.
  const std::uint32_t head = 1U | static_cast<std::uint32_t>(content.size()) << 3;
  Bytes frame{std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F},
              std::byte{0xFD}, std::byte{0},    std::byte{0x50}};
  for (const int shift : {0, 8, 16}) frame.push_back(static_cast<std::byte>(head >> shift & 0xFF));
  frame.insert(frame.end(), content.begin(), content.end());
  return frame;
}

Bytes stored_bytes(const Bytes& file, std::size_t chunk) {
  const auto first = file.begin() + get<std::int64_t>(file, entry_at(chunk) + kOffsetIn);
  return Bytes(first, first + get<std::int64_t>(file, entry_at(chunk) + kStoredIn));
}

/// The file with all planes as they are, in frames that do not compress.
Bytes with_open_planes(Bytes file) {
  for (std::size_t chunk = 0; chunk < chunk_count(file); ++chunk) {
    constexpr std::uint32_t kPlanes = 2;
    if (get<std::uint32_t>(file, entry_at(chunk) + kEncodingIn) != kPlanes) continue;
    const Bytes stored = stored_bytes(file, chunk);
    Bytes planes(std::size_t{1} << 20);
    const std::size_t size = ZSTD_decompress(planes.data(), planes.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
    planes.resize(size);
    file = replace_chunk(file, chunk, stored_frame(planes));
  }
  return file;
}

void save_map(const fs::path& folder, const std::string& name, const PenumbraMap& map) {
  const Bytes plain = serialize_map(map, {Compression::none}), packed = serialize_map(map);
  const Bytes open = with_open_planes(packed);
  if (read_map(open, name) != map) throw std::runtime_error("the open planes are another map");
  save(folder / "map" / (name + "-raw.pdsm"), plain.data(), plain.size());
  save(folder / "map" / (name + "-zstd.pdsm"), packed.data(), packed.size());
  save(folder / "map" / (name + "-planes.pdsm"), open.data(), open.size());
  export_deep_exr(map, folder / "deep_exr" / (name + ".exr"));
}

/// A square of two triangles.
constexpr float kCorners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
constexpr std::uint16_t kTriangles[] = {0, 1, 2, 0, 2, 3};

std::string big(std::string bytes) {
  return {bytes.rbegin(), bytes.rend()};
}

void save_ply(const fs::path& path, bool is_big) {
  const auto in_order = [&](const std::string& bytes) { return is_big ? big(bytes) : bytes; };
  std::string ply = std::string("ply\nformat ") + (is_big ? "binary_big_endian" : "binary_little_endian") +
                    " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 2\nproperty list uchar ushort vertex_index\nend_header\n";
  for (const float corner : kCorners) ply += in_order(raw(corner));
  for (std::size_t n = 0; n < std::size(kTriangles); ++n)
    ply += (n % 3 == 0 ? "\3" : "") + in_order(raw(kTriangles[n]));
  save(path, ply.data(), ply.size());
}

void save_glb(const fs::path& path) {
  std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":60}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string buffer;
  for (const float corner : kCorners) buffer += raw(corner);
  for (const std::uint16_t index : kTriangles) buffer += raw(index);
  const auto chunk = [](const char* type, const std::string& bytes) {
    return raw(static_cast<std::uint32_t>(bytes.size())) + std::string(type, 4) + bytes;
  };
  const std::string chunks = chunk("JSON", json) + chunk("BIN\0", buffer);
  const std::string glb =
      "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
  save(path, glb.data(), glb.size());
}

void make(const fs::path& folder) {
  save_map(folder, "golden", golden_map());
  save_map(folder, "levels", small_map({16, 8, 255}, Projection::perspective, 2));
  save_map(folder, "wide", small_map({32, 32, 0xFFFFFFFF}, Projection::orthographic, 1));
  save_ply(folder / "ply" / "little.ply", false);
  save_ply(folder / "ply" / "big.ply", true);
  save_glb(folder / "gltf" / "square.glb");
}

}  // namespace
}  // namespace pdsm::testing

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  pdsm::testing::make(argv[1]);
}
