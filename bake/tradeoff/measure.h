// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "evaluate/probed_truth.h"
#include "pdsm/bake/bake.h"
#include "tradeoff/measurement.h"

namespace pdsm {

/// What the measurements of a sweep have in common.
struct MeasureInput {
  const Scene& scene;
  Light light;                 ///< at its own size
  BakeOptions options;         ///< what no setting names
  VerifyOptions verify;        ///< points and shadow rays
  TradeoffSetting centre;      ///< decides where the points are
  std::filesystem::path maps;  ///< folder that maps are written to, and where those to keep stay
  /// The metadata that goes into a map's file.
  std::function<std::string(const Light&, const BakeOptions&, const BakedMap&)> metadata;
};

/// Measures settings at the same points, which are those that `pdsm verify` would take for a map of the
/// centre. For other sizes of the light the window stays, so that texels are as large, and the truth at the
/// points is traced anew.
class Measurer {
 public:
  /// Chooses the points. Throws as bake() does.
  explicit Measurer(MeasureInput input);

  /// Bakes, writes and measures the settings of one group, and checks all their functions. Keeps the files of
  /// those in `keep` as file_of() says. Throws as bake() does, Error (resource) when a map can't be written.
  [[nodiscard]] std::vector<Measurement> measure(std::span<const TradeoffSetting> group,
                                                 std::span<const TradeoffSetting> keep,
                                                 const BakeCallbacks& callbacks);

  /// Bakes and writes one map, to be kept.
  void bake_to_keep(const TradeoffSetting& setting, const BakeCallbacks& callbacks);

  [[nodiscard]] std::filesystem::path file_of(const TradeoffSetting& setting) const;
  /// The light of a setting: its size, and the window of the centre's.
  [[nodiscard]] Light light_of(const TradeoffSetting& setting) const;
  [[nodiscard]] const ProbedTruth& truth_of(double light_scale);

 private:
  struct Baked {
    BakedMap map;
    Measurement measurement;
  };
  [[nodiscard]] Baked bake_one(const TradeoffSetting& setting, const BakeCallbacks& callbacks);

  MeasureInput input_;
  std::map<double, ProbedTruth> truths_;  ///< by light scale
};

}  // namespace pdsm
