// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pdsm {
namespace {

/// Distinct for the colour-blind too (Okabe, Ito, "Color Universal Design", 2008), coarse to fine.
constexpr const char* kColours[] = {"#E69F00", "#56B4E9", "#009E73", "#D55E00", "#CC79A7", "#0072B2"};
constexpr std::size_t kColourCount = std::size(kColours);

constexpr const char* kTerminal =
    "set terminal svg size {},{} dynamic font 'sans-serif,13' background '#ffffff'\n"
    "set encoding utf8\n"
    "set border 3 lc rgb '#666666'\n"
    "set tics nomirror textcolor rgb '#333333'\n"
    "set grid lc rgb '#e4e4e4' lt 1\n";

/// An error of 0 has no place on a logarithmic axis; it is shown here.
constexpr double kLeastError = 1e-6;

/// What a plot of error has along x.
struct CostAxis {
  const char* stem;
  const char* label;
  double unit;  ///< of one unit of the axis
  bool Standing::*front;
  double (*cost)(const Measurement&);
};

constexpr CostAxis kCostAxes[] = {
    {"error-time", "processor seconds of the bake", 1, &Standing::on_time_front,
     [](const Measurement& m) { return m.cpu_seconds; }},
    {"error-file", "file, MB", 1e6, &Standing::on_file_front,
     [](const Measurement& m) { return static_cast<double>(m.file_bytes); }},
    {"error-gpu", "on the GPU, MB", 1e6, &Standing::on_gpu_front,
     [](const Measurement& m) { return static_cast<double>(m.gpu_bytes); }},
};

/// Lines "x y text" of the measurements of the light's own size that `choose` accepts.
template <typename Choose>
std::string points_of(const Sweep& sweep, const std::vector<Standing>& standings, const CostAxis& axis,
                      Choose&& choose) {
  std::vector<std::pair<double, std::string>> lines;
  for (std::size_t n = 0; n < sweep.measurements.size(); ++n) {
    const Measurement& m = sweep.measurements[n];
    if (m.setting.light_scale != 1 || !choose(n)) continue;
    const double x = axis.cost(m) / axis.unit;
    lines.emplace_back(x, fmt::format("{:.6g} {:.6g} \"{}\"\n", x,
                                      std::max(m.error.mean_abs_error, kLeastError), standings[n].name));
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const auto& line : lines) text += line.second;
  return text;
}

std::string data_block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << EOD\n{}EOD\n", name, lines);
}

/// Edges of the maps of a sweep, in texels of a square of as many.
std::map<double, std::string> resolutions_of(const Sweep& sweep) {
  std::map<double, std::string> names;
  for (const Measurement& m : sweep.measurements) {
    if (m.setting.light_scale != 1) continue;
    names[factor_value(Factor::resolution, m.setting)] =
        fmt::format("{} x {}", m.setting.width, m.setting.height);
  }
  return names;
}

/// Range and ticks of a logarithmic axis ("x", "y") that holds `values`, with room beside them: round numbers
/// (1, 2, 5 times a power of ten), of which at least two are within.
std::string log_axis(const char* axis, const std::vector<double>& values) {
  constexpr double kRoom = 1.15;
  double low = values.front(), high = values.front();
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  low /= kRoom;
  high *= kRoom;
  std::string ticks;
  for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step * power < low || step * power > high) continue;
      ticks += fmt::format("{}'{:g}' {:g}", ticks.empty() ? "" : ", ", step * power, step * power);
    }
  }
  return fmt::format("set {0}range [{1:g}:{2:g}]\nset {0}tics ({3})\n", axis, low, high, ticks);
}

/// The axes of an error plot, around all that it shows.
std::string axes_of(const Sweep& sweep, const CostAxis& axis) {
  std::vector<double> costs, errors;
  for (const Measurement& m : sweep.measurements) {
    if (m.setting.light_scale != 1) continue;
    costs.push_back(axis.cost(m) / axis.unit);
    errors.push_back(std::max(m.error.mean_abs_error, kLeastError));
  }
  return log_axis("x", costs) + log_axis("y", errors);
}

Plot error_plot(const Sweep& sweep, const std::vector<Standing>& standings, const CostAxis& axis) {
  std::string script = fmt::format(fmt::runtime(kTerminal), 760, 470);
  script += "set logscale xy\nset key outside right top Left reverse samplen 1 title 'texels' left\n";
  script += fmt::format("set xlabel '{}'\nset ylabel 'mean abs error'\n", axis.label);
  script += axes_of(sweep, axis);
  script += data_block(
      "front", points_of(sweep, standings, axis, [&](std::size_t n) { return standings[n].*axis.front; }));
  script += data_block(
      "named", points_of(sweep, standings, axis, [&](std::size_t n) { return !standings[n].name.empty(); }));
  std::string plots = "plot $front using 1:2 with lines lc rgb '#999999' lw 2 title 'front'";
  std::size_t index = 0;
  for (const auto& [edge, name] : resolutions_of(sweep)) {
    const std::string block = fmt::format("r{}", index);
    script += data_block(block, points_of(sweep, standings, axis, [&, at = edge](std::size_t n) {
                           return factor_value(Factor::resolution, sweep.measurements[n].setting) == at;
                         }));
    plots += fmt::format(", ${} using 1:2 with points pt 7 ps 0.6 lc rgb '{}' title '{}'", block,
                         kColours[index++ % kColourCount], name);
  }
  plots +=
      ", $named using 1:2 with points pt 6 ps 1.6 lw 2 lc rgb '#000000' notitle"
      ", $named using 1:2:3 with labels left offset 1,0.7 font ',14' notitle\n";
  return {axis.stem, fmt::format("Mean abs error against {}, both logarithmic", axis.label), script + plots};
}

std::string tick_of(Factor factor, const TradeoffSetting& s) {
  switch (factor) {
    case Factor::samples:
      return std::to_string(s.samples);
    case Factor::resolution:
      return s.width == s.height ? fmt::format("{}²", s.width) : fmt::format("{}x{}", s.width, s.height);
    case Factor::map_scale:
      return fmt::format("{} x", s.map_scale);
    case Factor::walk:
      return s.walk == Walk::exact ? "exact" : "midpoint";
    case Factor::epsilon:
      return fmt::format("{}", s.epsilon);
    case Factor::light_scale:
      break;
  }
  return fmt::format("{} x", s.light_scale);
}

/// The centre and what differs from it in `factor` alone, by rising value.
std::vector<const Measurement*> along(const Sweep& sweep, Factor factor) {
  std::vector<const Measurement*> found;
  for (const Measurement& m : sweep.measurements) {
    if (same_but_for(factor, sweep.plan.centre, m.setting)) found.push_back(&m);
  }
  std::sort(found.begin(), found.end(), [factor](const Measurement* a, const Measurement* b) {
    return factor_value(factor, a->setting) < factor_value(factor, b->setting);
  });
  return found;
}

/// Lines `position tick error seconds bytes`, the last three by the centre's.
std::string ratios_along(const Sweep& sweep, Factor factor) {
  const Measurement& centre = sweep.measurements.front();
  const auto ratio = [](double value, double to) { return to > 0 ? value / to : 1; };
  std::string text;
  int position = 0;
  for (const Measurement* m : along(sweep, factor)) {
    text += fmt::format("{} \"{}\" {:.5g} {:.5g} {:.5g}\n", position++, tick_of(factor, m->setting),
                        ratio(m->error.mean_abs_error, centre.error.mean_abs_error),
                        ratio(m->cpu_seconds, centre.cpu_seconds),
                        ratio(static_cast<double>(m->file_bytes), static_cast<double>(centre.file_bytes)));
  }
  return text;
}

Plot factor_plot(const Sweep& sweep) {
  std::string script = fmt::format(fmt::runtime(kTerminal), 980, 620);
  for (const Factor factor : kFactors)
    script += data_block(fmt::format("f{}", static_cast<int>(factor)), ratios_along(sweep, factor));
  script +=
      "set multiplot layout 2,3 margins 0.05,0.98,0.07,0.88 spacing 0.06,0.16\n"
      "set logscale y\nset format y '%g'\nset offsets 0.3,0.3,0,0\nset ytics (0.05, 0.1, 0.2, 0.5, 1, 2, 5, "
      "10, 20, 50, 100)\n"
      "set arrow 1 from graph 0,first 1 to graph 1,first 1 nohead lc rgb '#999999' back\n";
  for (const Factor factor : kFactors) {
    const std::string block = fmt::format("$f{}", static_cast<int>(factor));
    script += fmt::format("set title '{}' offset 0,-0.6\n", factor_name(factor));
    script += factor == Factor::samples
                  ? "set key at screen 0.5,0.985 center top horizontal maxrows 1 samplen 2 font ',14'\n"
                  : "unset key\n";
    script += fmt::format(
        "plot {0} using 1:3:xtic(2) with linespoints pt 7 ps 0.7 lw 2 lc rgb '#D55E00' title 'error', "
        "{0} using 1:4 with linespoints pt 5 ps 0.6 lw 2 lc rgb '#0072B2' title 'seconds', "
        "{0} using 1:5 with linespoints pt 9 ps 0.7 lw 2 lc rgb '#009E73' title 'file'\n",
        block);
  }
  script += "unset multiplot\n";
  return {"factors", "What each setting alone changes: error, seconds and bytes by the default's", script};
}

}  // namespace

std::vector<Plot> make_plots(const Sweep& sweep, const std::vector<Standing>& standings) {
  std::vector<Plot> plots;
  for (const CostAxis& axis : kCostAxes) plots.push_back(error_plot(sweep, standings, axis));
  plots.push_back(factor_plot(sweep));
  return plots;
}

}  // namespace pdsm
