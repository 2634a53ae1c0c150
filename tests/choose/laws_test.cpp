// SPDX-License-Identifier: Apache-2.0
#include "choose/laws.h"

#include <gtest/gtest.h>

#include "known_laws.h"

namespace pdsm {
namespace {

const Settings kBase{64, 256, 256, 0.01};
const std::vector<Settings> kElsewhere{
    {1024, 512, 2048, 0.003}, {64, 16, 16, 0.1}, {4096, 8192, 8192, 0.001, 2}};
/// Bytes of trials are whole: of some 10^5, powers from ratios of 4 and less are carried over 2^10.
constexpr double kWholeBytes = 1e-3;

TEST(Laws, AStarTellsThemEverywhere) {
  // The star determines each part; only rounding is left.
  const KnownLaws known;
  const Laws laws(known.star(kBase));
  for (const Settings& s : kElsewhere) {
    EXPECT_NEAR(laws.error(s), known.error(s), 1e-9 * known.error(s)) << settings_text(s);
    EXPECT_NEAR(laws.bytes(s), KnownLaws::bytes(s), kWholeBytes * KnownLaws::bytes(s)) << settings_text(s);
    EXPECT_NEAR(laws.seconds(s), KnownLaws::seconds(s), 1e-9 * KnownLaws::seconds(s)) << settings_text(s);
  }
}

TEST(Laws, PartsAddUp) {
  const Laws laws(KnownLaws().star(kBase));
  for (const Settings& s : kElsewhere) {
    const double penumbra = std::hypot(laws.sampling_error(s.samples), laws.fit_error(s.epsilon));
    EXPECT_DOUBLE_EQ(laws.error(s), laws.resolution_error(s.edge(), s.maps_per_texel) + penumbra);
  }
}

TEST(Laws, AnAnchorIsMet) {
  // A scene whose resolution part falls slower than the star told: the power is corrected too, so that the
  // next step is right at once.
  KnownLaws known, slower;
  known.sampling = slower.sampling = 0.02;
  Laws laws(known.star(kBase));
  slower.resolution_power = 0.6;
  slower.resolution = 2 * std::pow(256, -0.2);
  const Settings far{64, 1536, 1536, 0.01}, farther{256, 4000, 4000, 0.01};
  laws.anchor(slower.trial(far), Laws::Points::same);
  EXPECT_NEAR(laws.error(far), slower.error(far), 1e-12);
  EXPECT_NEAR(laws.bytes(far), KnownLaws::bytes(far), 1);
  EXPECT_NEAR(laws.error(farther), slower.error(farther), 1e-9);
}

TEST(Laws, OtherPointsAreTrustedLess) {
  KnownLaws known, slower;
  known.sampling = slower.sampling = 0.02;
  Laws laws(known.star(kBase));
  slower.resolution_power = 0.6;
  slower.resolution = 2 * std::pow(256, -0.2);
  const Settings far{64, 1536, 1536, 0.01};
  laws.anchor(slower.trial(far), Laws::Points::others);
  EXPECT_NEAR(laws.error(far), slower.error(far), 1e-12);
  // Half-way between the powers 0.8 and 0.6.
  EXPECT_NEAR(laws.resolution_error(4 * 1536) / laws.resolution_error(1536), std::pow(4, -0.7), 1e-9);
}

TEST(Laws, WhereResolutionIsNotTheLargestPartAllAreScaled) {
  KnownLaws known;
  known.resolution = 1e-3;
  Laws laws(known.star(kBase));
  const double fit = laws.fit_error(0.02), sampling = laws.sampling_error(64);
  Settings more = kBase;
  more.samples *= 2;
  Trial trial = known.trial(more);
  trial.error.mean_abs_error *= 1.5;
  laws.anchor(trial, Laws::Points::others);
  EXPECT_NEAR(laws.fit_error(0.02), 1.5 * fit, 1e-12);
  EXPECT_NEAR(laws.sampling_error(64), 1.5 * sampling, 1e-12);
}

TEST(Laws, ANoiselessSceneHasNoError) {
  // Nothing casts a shadow: all trials are perfect, of the same bytes.
  KnownLaws none{0, 0, 0, 0.8};
  const Laws laws(none.star(kBase));
  for (const Settings& s : kElsewhere) EXPECT_EQ(laws.error(s), 0) << settings_text(s);
}

TEST(Laws, LosslessFitsHaveFiniteBytes) {
  const Laws laws(KnownLaws().star(kBase));
  const Settings lossless{64, 256, 256, 0};
  EXPECT_TRUE(std::isfinite(laws.bytes(lossless)));
  EXPECT_GT(laws.bytes(lossless), laws.bytes(kBase));
}

TEST(Laws, OneTrialIsMetToo) {
  const Trial only = KnownLaws().trial(kBase);
  const Laws laws(only);
  EXPECT_NEAR(laws.error(kBase), only.mean_abs_error(), 1e-12);
  EXPECT_NEAR(laws.bytes(kBase), static_cast<double>(only.bytes), 1e-6);
  EXPECT_NEAR(laws.seconds(kBase), only.seconds_bake, 1e-12);
}

}  // namespace
}  // namespace pdsm
