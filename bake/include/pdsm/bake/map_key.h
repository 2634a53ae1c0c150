// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pdsm/bake/bake.h"

namespace pdsm {

/// This library's version.
extern const char* const kToolVersion;

/// What can be told of a map before it is baked.
struct MapKey {
  /// A hash, 32 hexadecimal digits, of all that the bytes of the map depend on: tool version, file format,
  /// ISA, the light, the options that matter (not threads, memory and tile), the fitted view, and the
  /// triangles that the light can see, in light space. With equal keys, bake() gives equal blocks and equal
  /// reports, but for times, memory, `receivers_outside` and warnings. What lies outside of the hull of the
  /// light and its window has no part in it, unless the view is fitted to it.
  std::string key;
  FittedView fitted;                  ///< as BakedMap has it
  std::vector<std::string> warnings;  ///< that the bake's report would have
};

/// Takes as long as a bake's first steps: no ray is traced and no BVH is built. Throws as bake() does, but
/// `options.isa` need not be one of this machine's; empty: the best of this machine. `version` is for the
/// key that another version would have recorded. Pure; any thread.
[[nodiscard]] MapKey map_key(const Scene& scene, const Light& light, const BakeOptions& options,
                             const std::string& version = kToolVersion);

/// The key in the metadata of a map file whose header, table and checksums hold; nothing where there is no
/// such file, or it tells no key. Cheap: blocks are not decoded. Safe on any bytes.
[[nodiscard]] std::optional<std::string> recorded_key(const std::filesystem::path& path);

}  // namespace pdsm
