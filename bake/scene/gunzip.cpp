// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "pdsm/format/error.h"
#include "scene/file_source.h"

namespace pdsm {
namespace {

/// Owns zlib's state for one gzip stream.
class Inflater {
 public:
  Inflater() {
    // 16 more than the window's bits asks for the gzip wrapping.
    if (inflateInit2(&stream_, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

constexpr std::size_t kMaxStep = std::numeric_limits<uInt>::max();

uInt step(std::size_t size) {
  return static_cast<uInt>(std::min(size, kMaxStep));
}

}  // namespace

std::string gunzip(const std::string& packed, const std::string& name, std::uint64_t limit) {
  const auto refuse = [&](const char* reason) { throw Error(Failure::input, name, reason); };
  Inflater inflater;
  z_stream& stream = inflater.stream();
  std::string unpacked(std::min<std::uint64_t>(limit, packed.size() * 4 + 1024), '\0');
  std::size_t used = 0, made = 0;
  for (;;) {
    if (made == unpacked.size()) {
      if (made >= limit) refuse("unpacks to more than the size allowed");
      unpacked.resize(std::min<std::uint64_t>(limit, made * 2));
    }
    // zlib wants a pointer to non-const, which it does not write through.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + used));
    stream.avail_in = step(packed.size() - used);
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data() + made);
    stream.avail_out = step(unpacked.size() - made);
    const uInt in = stream.avail_in, out = stream.avail_out;
    const int status = inflate(&stream, Z_NO_FLUSH);
    used += in - stream.avail_in;
    made += out - stream.avail_out;
    if (status == Z_STREAM_END) {
      if (used == packed.size()) break;
      // gzip files may be several streams in a row.
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR || (status == Z_OK && used == packed.size() && stream.avail_out > 0)) {
      refuse("gzip data is cut short");
    } else if (status != Z_OK) {
      refuse("is not valid gzip data");
    }
  }
  unpacked.resize(made);
  return unpacked;
}

}  // namespace pdsm
