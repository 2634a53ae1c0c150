// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace pdsm {
namespace {

std::vector<TradeoffSetting> all_of(const SweepPlan& plan) {
  std::vector<TradeoffSetting> all;
  for (const SettingGroup& group : plan.groups)
    all.insert(all.end(), group.settings.begin(), group.settings.end());
  return all;
}

class EveryEffort : public ::testing::TestWithParam<Effort> {};

TEST_P(EveryEffort, MovesEveryFactorAloneAndNamesTheDefault) {
  const TradeoffSetting centre = setting_of(BakeOptions{});
  const SweepPlan plan = plan_sweep(centre, {}, GetParam());
  const std::vector<TradeoffSetting> all = all_of(plan);
  EXPECT_EQ(all.size(), plan.setting_count());
  EXPECT_EQ(all.front(), centre) << "the centre is measured first";
  EXPECT_EQ(plan.named.front().name, "default");
  for (const Factor factor : kFactors) {
    std::set<double> values;
    for (const TradeoffSetting& setting : all) {
      if (same_but_for(factor, centre, setting)) values.insert(factor_value(factor, setting));
    }
    EXPECT_GE(values.size(), factor == Factor::walk ? 2U : 3U) << factor_name(factor);
  }
}

TEST_P(EveryEffort, HasNoSettingTwiceAndNoneThatCantBeBaked) {
  for (const TradeoffSetting& centre :
       {setting_of(BakeOptions{}), TradeoffSetting{3, 2, 5}, TradeoffSetting{65536, 16384, 9000}}) {
    const SweepPlan plan = plan_sweep(centre, {}, GetParam());
    std::set<std::string> keys;
    for (const TradeoffSetting& s : all_of(plan)) {
      EXPECT_TRUE(keys.insert(setting_key(s)).second) << setting_key(s);
      const BakeOptions options = options_of(s, {});
      EXPECT_TRUE(options.samples >= 1 && options.samples <= 65536) << options.samples;
      for (const std::uint32_t texels :
           {options.width, options.height, options.map_width, options.map_height})
        EXPECT_TRUE(texels >= 1 && texels <= 16384) << texels;
    }
  }
}

// What shares an oracle bake may differ in epsilon alone, and cheap groups come before dear ones.
TEST_P(EveryEffort, GroupsDifferInEpsilonAlone) {
  const SweepPlan plan = plan_sweep(setting_of(BakeOptions{}), {}, GetParam());
  for (std::size_t g = 0; g < plan.groups.size(); ++g) {
    const auto& settings = plan.groups[g].settings;
    for (const TradeoffSetting& s : settings) EXPECT_TRUE(same_but_for(Factor::epsilon, settings.front(), s));
    for (std::size_t other = 0; other < g; ++other)
      EXPECT_FALSE(same_but_for(Factor::epsilon, plan.groups[other].settings.front(), settings.front()));
    if (g < 2) continue;
    EXPECT_LE(setting_cost(plan.groups[g - 1].settings.front()), setting_cost(settings.front()));
  }
}

INSTANTIATE_TEST_SUITE_P(Efforts, EveryEffort,
                         ::testing::Values(Effort::quick, Effort::normal, Effort::full));

TEST(SweepPlan, HasThePresets) {
  TradeoffSetting centre, dear;
  dear.samples = 1024;
  dear.width = dear.height = 2048;
  const std::vector<NamedSetting> presets{{"game", centre}, {"final", dear}};
  const SweepPlan plan = plan_sweep(centre, presets, Effort::normal);
  ASSERT_EQ(plan.named.size(), 3U);
  const std::vector<TradeoffSetting> all = all_of(plan);
  for (const NamedSetting& named : plan.named)
    EXPECT_NE(std::find(all.begin(), all.end(), named.setting), all.end()) << named.name;
  const SweepPlan quick = plan_sweep(centre, presets, Effort::quick);
  ASSERT_EQ(quick.named.size(), 2U);
  EXPECT_EQ(quick.named[1].name, "game");
}

TEST(TradeoffSetting, SurvivesItsOptions) {
  TradeoffSetting setting{100, 300, 200, 0.5, Walk::midpoint, 0.01, 1};
  EXPECT_EQ(setting_of(options_of(setting, {})), setting);
  EXPECT_EQ(options_of(setting, {}).map_width, 150U);
  EXPECT_EQ(options_of(setting, {}).map_height, 100U);
}

TEST(TradeoffSetting, ScalesLights) {
  Light light;
  light.shape = RectLight{2, 3};
  EXPECT_EQ(half_extents(scaled_light(light, 0.5)), (std::array<double, 2>{0.5, 0.75}));
  light.shape = DiskLight{2};
  EXPECT_EQ(half_extents(scaled_light(light, 2)), (std::array<double, 2>{4, 4}));
  light.shape = DistantLight{3};
  EXPECT_EQ(std::get<DistantLight>(scaled_light(light, 2).shape).angle, 6);
  EXPECT_EQ(largest_light_scale(light), 30);
}

TEST(SweepPlan, LeavesOutLightsThatAreTooLarge) {
  const auto largest = [](const SweepPlan& plan) {
    double scale = 0;
    for (const SettingGroup& group : plan.groups) scale = std::max(scale, group.settings.front().light_scale);
    return scale;
  };
  const TradeoffSetting centre = setting_of(BakeOptions{});
  EXPECT_GT(largest(plan_sweep(centre, {}, Effort::normal)), 1);
  EXPECT_EQ(largest(plan_sweep(centre, {}, Effort::normal, 1)), 1);
}

}  // namespace
}  // namespace pdsm
