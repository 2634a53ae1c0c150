// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "deep_exr_parts.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

/// A file for OpenEXR, whose own stream forgets failures in its destructor: they are kept here.
class CheckedStream : public Imf::OStream {
 public:
  explicit CheckedStream(const std::filesystem::path& path)
      : Imf::OStream(path.c_str()), file_(path, std::ios::binary | std::ios::trunc) {}

  void write(const char bytes[], int count) override {
    file_.write(bytes, count);
    check();
  }
  uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(file_.tellp())); }
  void seekp(uint64_t position) override {
    file_.seekp(static_cast<std::streamoff>(position));
    check();
  }
  /// False where any byte did not get out.
  [[nodiscard]] bool close() {
    file_.close();
    return !file_.fail();
  }

 private:
  void check() const {
    if (file_.fail()) throw std::ios_base::failure("a write failed");
  }
  std::ofstream file_;
};

Imath::Box2i image_window(std::uint32_t width, std::uint32_t height) {
  return {Imath::V2i(0, 0), Imath::V2i(static_cast<int>(width) - 1, static_cast<int>(height) - 1)};
}

/// OpenEXR multiplies row vectors, so its matrix is the transpose.
Imath::M44f camera_matrix(const RigidTransform& transform) {
  const auto& r = transform.rotation;
  const auto& t = transform.translation;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(r[0]), f(r[3]), f(r[6]), 0, f(r[1]), f(r[4]), f(r[7]), 0,
          f(r[2]), f(r[5]), f(r[8]), 0, f(t[0]), f(t[1]), f(t[2]), 1};
}

/// What deep and domain part of an image have in common. The display window is one for all parts, as
/// OpenEXR wants it.
Imf::Header make_header(const PenumbraMap& map, const FunctionImage& image) {
  Imf::Header header(image_window(map.views[0].width, map.views[0].height),
                     image_window(image.width, image.height));
  header.setName(part_name(map, image));
  header.compression() = Imf::ZIPS_COMPRESSION;
  Imf::addWorldToCamera(header, camera_matrix(map.views[image.view].world_to_view));
  return header;
}

std::vector<Imf::Header> make_headers(const PenumbraMap& map) {
  std::vector<Imf::Header> headers;
  for (const FunctionImage& image : map.images) {
    Imf::Header& deep = headers.emplace_back(make_header(map, image));
    deep.setType(Imf::DEEPSCANLINE);
    deep.channels().insert("A", Imf::Channel(Imf::FLOAT));
    deep.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    for (const char* name : {kDepthChannel, kBeginChannel, kEndChannel})
      deep.channels().insert(name, Imf::Channel(Imf::UINT));
    if (!has_domain_end(image)) continue;
    Imf::Header& domain = headers.emplace_back(make_header(map, image));
    domain.setName(part_name(map, image) + ".domain");
    domain.setType(Imf::SCANLINEIMAGE);
    domain.channels().insert(kDomainEndChannel, Imf::Channel(Imf::UINT));
  }
  const std::string shell = to_hex(serialize_map(make_shell(map)));
  headers.front().insert(kShellAttribute, Imf::StringAttribute(shell));
  headers.front().insert("comments", Imf::StringAttribute(map.metadata));
  return headers;
}

/// Alpha of a deep sample, so that compositing the samples in front of a depth gives the attenuation just
/// behind the last of them, as long as it rises. For viewing: the codes are what is read back.
class AlphaOfVertices {
 public:
  float next(double attenuation) {
    const double rise = attenuation - covered_;
    if (rise <= 0) return 0;
    const double alpha = rise / (1 - covered_);
    covered_ = attenuation;
    return static_cast<float>(alpha);
  }

 private:
  double covered_ = 0;
};

/// One row of deep samples, in the layout that OpenEXR wants: for each channel a pointer for each pixel.
class DeepRow {
 public:
  DeepRow(const PenumbraMap& map, const FunctionImage& image) : map_(map), image_(image) {
    counts_.resize(image.width);
    for (auto& pointers : code_pointers_) pointers.resize(image.width);
    for (auto& pointers : float_pointers_) pointers.resize(image.width);
  }

  [[nodiscard]] Imf::DeepFrameBuffer frame_buffer() {
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts_.data()), sizeof(std::uint32_t), 0));
    const std::array code_names{kDepthChannel, kBeginChannel, kEndChannel};
    for (std::size_t n = 0; n < code_names.size(); ++n)
      buffer.insert(code_names[n],
                    Imf::DeepSlice(Imf::UINT, reinterpret_cast<char*>(code_pointers_[n].data()),
                                   sizeof(void*), 0, sizeof(std::uint32_t)));
    const std::array float_names{"Z", "A"};
    for (std::size_t n = 0; n < float_names.size(); ++n)
      buffer.insert(float_names[n],
                    Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(float_pointers_[n].data()),
                                   sizeof(void*), 0, sizeof(float)));
    return buffer;
  }

  void fill(std::uint32_t y) {
    for (auto& values : codes_) values.clear();
    for (auto& values : floats_) values.clear();
    for (std::uint32_t x = 0; x < image_.width; ++x) {
      const TexelInBlock texel = find_texel(image_, x, y);
      const auto function = unpack_function(map_.coding, image_.blocks[texel.block], texel.texel);
      counts_[x] = static_cast<std::uint32_t>(function.size());
      add(function);
    }
    point();
  }

 private:
  void add(const std::vector<FunctionVertex>& function) {
    AlphaOfVertices alpha;
    for (const FunctionVertex& vertex : function) {
      codes_[0].push_back(vertex.depth);
      codes_[1].push_back(vertex.begin);
      codes_[2].push_back(vertex.end);
      floats_[0].push_back(
          static_cast<float>(decode_depth(map_.views[image_.view], map_.coding, vertex.depth)));
      floats_[1].push_back(alpha.next(static_cast<double>(vertex.begin) / map_.coding.value_max));
    }
  }

  /// Points each pixel at its samples, once these no longer move.
  void point() {
    std::size_t first = 0;
    for (std::uint32_t x = 0; x < image_.width; first += counts_[x++]) {
      for (std::size_t n = 0; n < codes_.size(); ++n) code_pointers_[n][x] = codes_[n].data() + first;
      for (std::size_t n = 0; n < floats_.size(); ++n) float_pointers_[n][x] = floats_[n].data() + first;
    }
  }

  const PenumbraMap& map_;
  const FunctionImage& image_;
  std::vector<std::uint32_t> counts_;
  std::array<std::vector<std::uint32_t>, 3> codes_;
  std::array<std::vector<float>, 2> floats_;
  std::array<std::vector<const std::uint32_t*>, 3> code_pointers_;
  std::array<std::vector<const float*>, 2> float_pointers_;
};

/// Row 0 of the file is the uppermost, the last of the image.
void write_functions(Imf::MultiPartOutputFile& file, int part_index, const PenumbraMap& map,
                     const FunctionImage& image) {
  Imf::DeepScanLineOutputPart part(file, part_index);
  DeepRow row(map, image);
  part.setFrameBuffer(row.frame_buffer());
  for (std::uint32_t y = image.height; y-- > 0;) {
    row.fill(y);
    part.writePixels(1);
  }
}

void write_domain_ends(Imf::MultiPartOutputFile& file, int part_index, const FunctionImage& image) {
  Imf::OutputPart part(file, part_index);
  std::vector<std::uint32_t> row(image.width);
  Imf::FrameBuffer buffer;
  buffer.insert(kDomainEndChannel,
                Imf::Slice(Imf::UINT, reinterpret_cast<char*>(row.data()), sizeof(std::uint32_t), 0));
  part.setFrameBuffer(buffer);
  for (std::uint32_t y = image.height; y-- > 0;) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const TexelInBlock texel = find_texel(image, x, y);
      const auto& ends = image.blocks[texel.block].domain_end;
      row[x] = ends.empty() ? 0 : ends[texel.texel];
    }
    part.writePixels(1);
  }
}

void write_parts(const PenumbraMap& map, CheckedStream& stream) {
  const std::vector<Imf::Header> headers = make_headers(map);
  Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
  int part = 0;
  for (const FunctionImage& image : map.images) {
    write_functions(file, part++, map, image);
    if (has_domain_end(image)) write_domain_ends(file, part++, image);
  }
}

}  // namespace

void export_deep_exr(const PenumbraMap& map, const std::filesystem::path& path) {
  AtomicFile file(path);
  try {
    CheckedStream stream(file.temporary());
    write_parts(map, stream);
    if (!stream.close()) throw std::ios_base::failure("a write failed");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(Failure::resource, path.string(), std::string("cannot write: ") + error.what());
  }
  file.commit();
}

}  // namespace pdsm
