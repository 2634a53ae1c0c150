// SPDX-License-Identifier: Apache-2.0
#include "zstd_stream.h"

#include <zstd.h>

#include <algorithm>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Residuals are noise to a match finder: short matches cost more than the literals that they replace
/// (minimum 4 instead of 7: 1.7% larger), and levels above search longer for 0.1%.
constexpr int kLevel = 15;
constexpr int kMinMatch = 7;

/// What a writer uses at most, and a reader grants at most: a frame can't ask for more memory than that.
constexpr int kWriterWindowLog = 20;
constexpr int kReaderWindowLog = 23;

/// First growth step of a decoded buffer; it doubles from here.
constexpr std::uint64_t kFirstGrowth = 64 << 10;

struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
struct FreeDecompressor {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

std::size_t checked(std::size_t code) {
  if (ZSTD_isError(code)) throw Error(Failure::resource, "zstd", ZSTD_getErrorName(code));
  return code;
}

std::unique_ptr<ZSTD_CCtx, FreeCompressor> make_compressor(std::uint64_t size) {
  std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
  if (!context) throw Error(Failure::resource, "zstd", "out of memory");
  checked(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel));
  checked(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_minMatch, kMinMatch));
  checked(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, kWriterWindowLog));
  checked(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_contentSizeFlag, 0));
  checked(ZSTD_CCtx_setPledgedSrcSize(context.get(), size));
  return context;
}

}  // namespace

std::vector<std::byte> compress_parts(std::span<const std::vector<std::byte>> parts) {
  std::uint64_t size = 0;
  for (const auto& part : parts) size += part.size();
  const auto context = make_compressor(size);

  // Each part is flushed into blocks of its own, because a block has one entropy table.
  std::vector<std::byte> stored(ZSTD_compressBound(size) + parts.size() * 16);
  ZSTD_outBuffer output{stored.data(), stored.size(), 0};
  for (const auto& part : parts) {
    ZSTD_inBuffer input{part.data(), part.size(), 0};
    while (checked(ZSTD_compressStream2(context.get(), &output, &input, ZSTD_e_flush)) != 0) {
    }
  }
  ZSTD_inBuffer nothing{nullptr, 0, 0};
  while (checked(ZSTD_compressStream2(context.get(), &output, &nothing, ZSTD_e_end)) != 0) {
  }
  stored.resize(output.pos);
  return stored;
}

struct ZstdReader::Stream {
  std::unique_ptr<ZSTD_DCtx, FreeDecompressor> context{ZSTD_createDCtx()};
  ZSTD_inBuffer input{nullptr, 0, 0};
  bool ended = false;

  /// Decompresses to `output` until it is full, the frame ends, or nothing moves any more.
  bool fill(ZSTD_outBuffer& output) {
    while (output.pos < output.size && !ended) {
      const std::size_t before_in = input.pos, before_out = output.pos;
      const std::size_t code = ZSTD_decompressStream(context.get(), &output, &input);
      if (ZSTD_isError(code)) return false;
      ended = code == 0;
      if (!ended && input.pos == before_in && output.pos == before_out) return false;
    }
    return output.pos == output.size;
  }
};

ZstdReader::ZstdReader(std::span<const std::byte> stored) : stream_(std::make_unique<Stream>()) {
  if (!stream_->context) throw Error(Failure::resource, "zstd", "out of memory");
  checked(ZSTD_DCtx_setParameter(stream_->context.get(), ZSTD_d_windowLogMax, kReaderWindowLog));
  stream_->input = {stored.data(), stored.size(), 0};
}

ZstdReader::~ZstdReader() = default;

bool ZstdReader::read(std::span<std::byte> bytes) {
  ZSTD_outBuffer output{bytes.data(), bytes.size(), 0};
  return stream_->fill(output);
}

bool ZstdReader::append(std::vector<std::byte>& bytes, std::uint64_t count) {
  std::uint64_t step = kFirstGrowth;
  while (count > 0) {
    const std::uint64_t now = std::min(count, step);
    const std::size_t old_size = bytes.size();
    bytes.resize(old_size + now);
    if (!read(std::span(bytes).subspan(old_size))) return false;
    count -= now;
    step *= 2;
  }
  return true;
}

bool ZstdReader::at_end() {
  std::byte extra{};
  ZSTD_outBuffer output{&extra, 1, 0};
  if (!stream_->ended && stream_->fill(output)) return false;
  return stream_->ended && output.pos == 0 && stream_->input.pos == stream_->input.size;
}

}  // namespace pdsm
