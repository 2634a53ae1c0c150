// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace pdsm {

/// XXH3-128 over values. Lists are preceded by their length, so that no two inputs run into the same bytes.
class KeyHash {
 public:
  KeyHash() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
  }

  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T value) { add_bytes(&value, sizeof value); }
  void add(const std::string& text) { add(std::span(text)); }
  /// Of types without padding.
  template <typename T, std::size_t extent>
  void add(std::span<T, extent> values) {
    add(std::uint64_t{values.size()});
    add_bytes(values.data(), values.size_bytes());
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }

  /// The greater half first.
  [[nodiscard]] std::array<std::uint64_t, 2> digest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return {hash.high64, hash.low64};
  }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };

  void add_bytes(const void* data, std::size_t size) { XXH3_128bits_update(state_.get(), data, size); }

  std::unique_ptr<XXH3_state_t, Free> state_;
};

}  // namespace pdsm
