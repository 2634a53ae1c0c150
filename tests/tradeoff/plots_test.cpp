// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plots.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "markup.h"
#include "pdsm/format/error.h"
#include "tradeoff/gnuplot.h"

namespace pdsm {
namespace {

/// A sweep that was never baked: errors fall, costs rise.
Sweep made_up_sweep() {
  Sweep sweep;
  sweep.plan = plan_sweep(setting_of(BakeOptions{}), {}, Effort::normal);
  for (const SettingGroup& group : sweep.plan.groups) {
    for (const TradeoffSetting& setting : group.settings) {
      Measurement m;
      m.setting = setting;
      m.seconds = m.cpu_seconds = 1e-8 * setting_cost(setting);
      m.error.mean_abs_error = 0.2 / setting.samples + setting.epsilon / 4;
      m.file_bytes = 1000 + setting.width * setting.height;
      m.gpu_bytes = 4 * m.file_bytes;
      sweep.measurements.push_back(m);
    }
  }
  return sweep;
}

TEST(Plots, AreWellFormedAndSelfContained) {
  const Sweep sweep = made_up_sweep();
  const std::vector<Plot> plots = make_plots(sweep, find_standings(sweep));
  ASSERT_EQ(plots.size(), 4U);
  for (const Plot& plot : plots) {
    const std::string svg = run_gnuplot(plot.script);
    EXPECT_EQ(find_markup_fault(svg, {}), "") << plot.stem;
    EXPECT_EQ(find_outside_reference(svg), "") << plot.stem;
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << plot.stem;
    EXPECT_NE(svg.find("default") != std::string::npos, plot.stem == "factors") << plot.stem;
  }
}

TEST(Plots, TakeAnErrorOfZero) {
  Sweep sweep = made_up_sweep();
  for (Measurement& m : sweep.measurements) m.error.mean_abs_error = 0;
  for (const Plot& plot : make_plots(sweep, find_standings(sweep)))
    EXPECT_EQ(find_markup_fault(run_gnuplot(plot.script), {}), "") << plot.stem;
}

Failure failure_of(const std::string& script, std::string& what) {
  try {
    (void)run_gnuplot(script);
  } catch (const Error& error) {
    what = error.what();
    return error.failure();
  }
  return Failure::usage;
}

TEST(Gnuplot, SaysWhatItDoesNotUnderstand) {
  std::string what;
  EXPECT_EQ(failure_of("plot nonsense\n", what), Failure::resource);
  EXPECT_EQ(what.rfind("gnuplot: ", 0), 0U) << what;
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
}

TEST(Gnuplot, IsMissedWhenItIsNotInThePath) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string what;
  const Failure failure = failure_of("", what);
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(failure, Failure::resource);
  EXPECT_NE(what.find("PATH"), std::string::npos) << what;
}

}  // namespace
}  // namespace pdsm
