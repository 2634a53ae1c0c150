// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene.h"

/// What a sweep bakes: settings around the one that a bake of the light would have. All functions are pure.
namespace pdsm {

/// One bake of a sweep. Whatever it does not name is as in the sweep's own BakeOptions.
struct TradeoffSetting {
  std::uint32_t samples = 256;
  std::uint32_t width = 512, height = 512;  ///< texels of the map
  double map_scale = 1;                     ///< texels of a sample map by texels of the map, along each axis
  Walk walk = Walk::exact;
  double epsilon = 0.02;
  double light_scale = 1;  ///< of the light's width and height, radius or angle

  friend bool operator==(const TradeoffSetting&, const TradeoffSetting&) = default;
};

/// A setting that has a name of its own: "default", a preset.
struct NamedSetting {
  std::string name;
  TradeoffSetting setting;
};

/// How many settings a sweep has, and how far they reach.
enum class Effort {
  quick,   ///< as normal, but nothing that traces more rays than the centre
  normal,  ///< steps of 4 in samples and 2 in resolution, up to 4 and 2 times the centre's
  full     ///< steps of 2 in samples, more values of epsilon
};

/// What of a setting a sweep varies.
enum class Factor { samples, resolution, map_scale, walk, epsilon, light_scale };
inline constexpr Factor kFactors[] = {Factor::samples, Factor::resolution, Factor::map_scale,
                                      Factor::walk,    Factor::epsilon,    Factor::light_scale};

/// Settings that differ in epsilon alone: they are fits of the same functions, so that one lossless bake is
/// the oracle of all.
struct SettingGroup {
  std::vector<TradeoffSetting> settings;
};

/// What a sweep measures, cheap groups before dear ones, but the centre's first.
struct SweepPlan {
  TradeoffSetting centre;
  std::vector<NamedSetting> named;  ///< the centre as "default", then presets; all of them are in `groups`
  std::vector<SettingGroup> groups;

  [[nodiscard]] std::size_t setting_count() const;
};

/// A star around `centre`, one factor at a time, a grid of samples, resolution and epsilon, and `presets`.
/// What a bake does not take (0 samples, 20000 texels, a light larger than `largest_scale`) is left out; no
/// setting comes twice.
[[nodiscard]] SweepPlan plan_sweep(const TradeoffSetting& centre, const std::vector<NamedSetting>& presets,
                                   Effort effort,
                                   double largest_scale = std::numeric_limits<double>::infinity());

/// What a light's size can be multiplied by: a distant one has a greatest angle.
[[nodiscard]] double largest_light_scale(const Light& light);

/// The setting of a bake by `options`.
[[nodiscard]] TradeoffSetting setting_of(const BakeOptions& options);

/// `base` with what the setting says.
[[nodiscard]] BakeOptions options_of(const TradeoffSetting& setting, BakeOptions base);

/// `light` with its width and height, radius or angle times `scale`.
[[nodiscard]] Light scaled_light(Light light, double scale);

/// Whether the settings are equal but for, perhaps, `factor`.
[[nodiscard]] bool same_but_for(Factor factor, const TradeoffSetting& a, const TradeoffSetting& b);

/// The factor as a number to plot: resolution is the edge of a square of as many texels, walk 0 or 1.
[[nodiscard]] double factor_value(Factor factor, const TradeoffSetting& setting);

/// In words: "samples", "map resolution", ...
[[nodiscard]] const char* factor_name(Factor factor);

/// A name for files and the journal that two settings share only if they are equal.
[[nodiscard]] std::string setting_key(const TradeoffSetting& setting);

/// What the setting's bakes cost, in rays to trace and texels to fit; for guesses of the time left.
[[nodiscard]] double setting_cost(const TradeoffSetting& setting);

}  // namespace pdsm
