// SPDX-License-Identifier: Apache-2.0
#include <Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "bytes.h"
#include "deep_exr_headers.h"
#include "deep_exr_parts.h"
#include "mapped_file.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "vertex_bits.h"

namespace pdsm {
namespace {

/// Bytes in memory as OpenEXR reads them. Running past the end is an exception.
class BytesStream : public Imf::IStream {
 public:
  BytesStream(std::span<const std::byte> bytes, const char* name) : Imf::IStream(name), bytes_(bytes) {}

  bool read(char destination[], int count) override {
    const auto wanted = static_cast<std::uint64_t>(std::max(count, 0));
    if (position_ > bytes_.size() || wanted > bytes_.size() - position_)
      throw Iex::InputExc("the file ends too early");
    if (wanted > 0) std::memcpy(destination, bytes_.data() + position_, wanted);
    position_ += wanted;
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t position_ = 0;
};

/// One reading of one file; members are what the steps share.
class DeepImporter {
 public:
  DeepImporter(std::span<const std::byte> bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  PenumbraMap import();

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& reason) const {
    throw Error(Failure::input, path_ + ":" + field, reason);
  }
  [[nodiscard]] PenumbraMap read_shell(const Imf::MultiPartInputFile& file) const;
  void check_part(const Imf::MultiPartInputFile& file, int part, const std::string& type,
                  const FunctionImage& image, std::initializer_list<const char*> channels) const;
  void check_total(const std::vector<std::uint32_t>& counts, int part) const;
  void read_functions(Imf::MultiPartInputFile& file, int part, FunctionImage& image) const;
  void add_row(const std::vector<FunctionVertex>& vertices, const std::uint32_t* counts, std::uint32_t y,
               FunctionImage& image) const;
  void read_domain_ends(Imf::MultiPartInputFile& file, int part, FunctionImage& image) const;

  std::span<const std::byte> bytes_;
  std::string path_;
  VertexCoding coding_;
};

std::string part_field(int part) {
  return "part " + std::to_string(part);
}

/// Everything but the functions, checked as a map file is.
PenumbraMap DeepImporter::read_shell(const Imf::MultiPartInputFile& file) const {
  const auto* attribute =
      file.parts() > 0 ? file.header(0).findTypedAttribute<Imf::StringAttribute>(kShellAttribute) : nullptr;
  if (attribute == nullptr) fail(kShellAttribute, "missing: not exported from a penumbra map");
  const auto shell = from_hex(attribute->value());
  if (!shell) fail(kShellAttribute, "not hexadecimal");
  return read_map(*shell, path_ + ":" + kShellAttribute);
}

void DeepImporter::check_part(const Imf::MultiPartInputFile& file, int part, const std::string& type,
                              const FunctionImage& image, std::initializer_list<const char*> channels) const {
  if (part >= file.parts()) fail(part_field(part), "missing");
  const Imf::Header& header = file.header(part);
  if (!header.hasType() || header.type() != type) fail(part_field(part), "expected type " + type);
  const Imath::Box2i& window = header.dataWindow();
  if (window.min != Imath::V2i(0, 0) || std::int64_t{window.max.x} + 1 != image.width ||
      std::int64_t{window.max.y} + 1 != image.height)
    fail(part_field(part), "expected a data window of the image's size");
  if (header.lineOrder() != Imf::INCREASING_Y) fail(part_field(part), "expected increasing y");
  for (const char* name : channels) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (channel == nullptr || channel->type != Imf::UINT || channel->xSampling != 1 ||
        channel->ySampling != 1)
      fail(part_field(part), std::string("expected a uint channel ") + name);
  }
}

/// Refuses sample counts that the file can't hold, before their samples are allocated.
void DeepImporter::check_total(const std::vector<std::uint32_t>& counts, int part) const {
  std::uint64_t total = 0;
  for (std::uint32_t count : counts) total += count;
  std::uint64_t bytes = 0, most = 0;
  if (!checked_multiply(total, 3 * sizeof(std::uint32_t), bytes) ||
      !checked_multiply(bytes_.size(), kMaxExpansion, most) || bytes > most ||
      bytes > ReadLimits{}.decoded_bytes)
    fail(part_field(part), "more samples than the file can hold");
}

/// Appends one row's functions to the blocks. Rows come from below, so each block gets its texels in order.
void DeepImporter::add_row(const std::vector<FunctionVertex>& vertices, const std::uint32_t* counts,
                           std::uint32_t y, FunctionImage& image) const {
  const std::uint32_t stride = coding_.words_per_vertex();
  auto vertex = vertices.begin();
  for (std::uint32_t x = 0; x < image.width; ++x) {
    const TexelInBlock texel = find_texel(image, x, y);
    FunctionBlock& block = image.blocks[texel.block];
    for (std::uint32_t n = 0; n < counts[x]; ++n, ++vertex) {
      if (vertex->depth > coding_.depth_max() || vertex->begin > coding_.value_max ||
          vertex->end > coding_.value_max)
        fail("y " + std::to_string(y), "a code out of range");
      block.words.resize(block.words.size() + stride);
      store_vertex(coding_, *vertex, &block.words[block.words.size() - stride]);
    }
    const std::size_t vertex_count = block.words.size() / stride;
    if (vertex_count > UINT32_MAX) fail("y " + std::to_string(y), "too many vertices in a block");
    block.first[texel.texel + 1] = static_cast<std::uint32_t>(vertex_count);
  }
}

/// Reads one row of samples at a time; the last row of the file is row 0 of the image.
void DeepImporter::read_functions(Imf::MultiPartInputFile& file, int part_index, FunctionImage& image) const {
  Imf::DeepScanLineInputPart part(file, part_index);
  const std::size_t width = image.width;
  std::vector<std::uint32_t> counts(width * image.height);
  std::array<std::vector<char*>, 3> pointers;
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()),
                                           sizeof(std::uint32_t), sizeof(std::uint32_t) * width));
  const std::array names{kDepthChannel, kBeginChannel, kEndChannel};
  for (std::size_t n = 0; n < names.size(); ++n) {
    pointers[n].resize(width);
    buffer.insert(names[n], Imf::DeepSlice(Imf::UINT, reinterpret_cast<char*>(pointers[n].data()),
                                           sizeof(char*), 0, sizeof(FunctionVertex)));
  }
  part.setFrameBuffer(buffer);
  part.readPixelSampleCounts(0, static_cast<int>(image.height) - 1);
  check_total(counts, part_index);

  std::vector<FunctionVertex> vertices;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const std::uint32_t row = image.height - 1 - y;
    const std::uint32_t* row_counts = counts.data() + row * width;
    std::uint64_t total = 0;
    for (std::size_t x = 0; x < width; ++x) total += row_counts[x];
    // One to spare: pointers go behind the last vertex, and a row may have none.
    vertices.assign(total + 1, {});
    auto* sample = reinterpret_cast<char*>(vertices.data());
    for (std::size_t x = 0; x < width; sample += row_counts[x++] * sizeof(FunctionVertex)) {
      pointers[0][x] = sample + offsetof(FunctionVertex, depth);
      pointers[1][x] = sample + offsetof(FunctionVertex, begin);
      pointers[2][x] = sample + offsetof(FunctionVertex, end);
    }
    part.readPixels(static_cast<int>(row));
    add_row(vertices, row_counts, y, image);
  }
}

void DeepImporter::read_domain_ends(Imf::MultiPartInputFile& file, int part_index,
                                    FunctionImage& image) const {
  Imf::InputPart part(file, part_index);
  std::vector<std::uint32_t> row(image.width);
  Imf::FrameBuffer buffer;
  buffer.insert(kDomainEndChannel,
                Imf::Slice(Imf::UINT, reinterpret_cast<char*>(row.data()), sizeof(std::uint32_t), 0));
  part.setFrameBuffer(buffer);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    part.readPixels(static_cast<int>(image.height - 1 - y));
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const TexelInBlock texel = find_texel(image, x, y);
      auto& ends = image.blocks[texel.block].domain_end;
      if (!ends.empty()) ends[texel.texel] = row[x];
    }
  }
}

PenumbraMap DeepImporter::import() {
  if (const auto fault = find_exr_header_fault(bytes_)) fail(fault->field, fault->reason);
  BytesStream stream(bytes_, path_.c_str());
  Imf::MultiPartInputFile file(stream, 0, false);
  PenumbraMap map = read_shell(file);
  coding_ = map.coding;
  int part = 0;
  for (FunctionImage& image : map.images) {
    check_part(file, part, Imf::DEEPSCANLINE, image, {kDepthChannel, kBeginChannel, kEndChannel});
    for (const FunctionBlock& block : image.blocks)
      if (!block.words.empty()) fail(kShellAttribute, "functions that are not empty");
    read_functions(file, part++, image);
    if (!has_domain_end(image)) continue;
    check_part(file, part, Imf::SCANLINEIMAGE, image, {kDomainEndChannel});
    read_domain_ends(file, part++, image);
  }
  if (part != file.parts()) fail(part_field(part), "not a part of the map");
  if (const std::string fault = find_invariant_fault(map); !fault.empty()) fail("map", fault);
  return map;
}

}  // namespace

PenumbraMap import_deep_exr(const std::filesystem::path& path) {
  const MappedFile file(path);
  try {
    return DeepImporter(file.bytes(), path.string()).import();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(Failure::input, path.string() + ":exr", error.what());
  }
}

}  // namespace pdsm
