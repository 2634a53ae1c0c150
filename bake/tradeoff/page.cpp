// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tradeoff/html.h"
#include "tradeoff/page_style.h"

namespace pdsm {
namespace {

double megabytes(std::uint64_t bytes) {
  return 1e-6 * static_cast<double>(bytes);
}

std::string heading(const PageContents& c) {
  const std::string name = std::filesystem::path(c.scene.source).filename().string();
  return fmt::format(
      "<h1>Light “{}” of {}: error, time and size</h1>\n"
      "<p class=\"lead\">{} bakes, each measured against ray-traced truth at the same {} points ({} on "
      "surfaces, "
      "the others in free space).</p>\n",
      html_text(c.sweep.light.name), html_text(name), c.sweep.measurements.size(), c.sweep.points,
      c.sweep.surface_points);
}

std::string facts(const PageContents& c) {
  const Measurement& m = c.sweep.measurements.front();
  const auto fact = [](const std::string& value, const char* what) {
    return fmt::format("<li><b>{}</b><span>{}</span></li>\n", value, what);
  };
  std::string html =
      fmt::format("<h2>The default</h2>\n<p>{}, {} walk.</p>\n<ul class=\"facts\">\n",
                  setting_text(m.setting), m.setting.walk == Walk::exact ? "exact" : "midpoint");
  html += fact(fmt::format("{:.4f}", m.error.mean_abs_error), "mean abs error");
  html += fact(fmt::format("{:.4f}, {:.4f}", m.error.surface_error, m.error.free_error),
               "on surfaces, in free space");
  html += fact(fmt::format("{:.2f} s", m.seconds), "bake, without loading") +
          fact(fmt::format("{:.2f} s", m.cpu_seconds), "processor time of that");
  html += fact(fmt::format("{:.3f} MB", megabytes(m.file_bytes)), "file");
  html += fact(fmt::format("{:.3f} MB", megabytes(m.gpu_bytes)), "on the GPU");
  return html + "</ul>\n";
}

std::string better_cell(const Measurement& mine, const Measurement& best) {
  if (&mine == &best) return "<td class=\"text\">nothing measured is better</td>";
  return fmt::format("<td class=\"text\">{:.4f}: {}<br>{:.2f} s, {:.3f} MB</td>", best.error.mean_abs_error,
                     setting_text(best.setting), best.cpu_seconds, megabytes(best.file_bytes));
}

std::string named_table(const PageContents& c) {
  std::string html =
      "<h2>Where the named settings stand</h2>\n<div class=\"wide\"><table class=\"wrap\">\n<thead><tr><th "
      "class=\"text\">name"
      "</th><th class=\"text\">setting</th><th>mean "
      "abs<br>error</th><th>processor<br>seconds</th><th>file,<br>MB</th>"
      "<th class=\"text\">least error for no more time</th><th class=\"text\">least error for no more "
      "bytes</th>"
      "</tr></thead>\n<tbody>\n";
  for (const NamedStanding& standing : named_standings(c.sweep)) {
    const Measurement& m = *standing.measured;
    html += fmt::format(
        "<tr><td class=\"text\"><b>{}</b></td><td class=\"text\">{}</td><td>{:.4f}</td><td>{:.2f}"
        "</td><td>{:.3f}</td>{}{}</tr>\n",
        html_text(standing.name), setting_text(m.setting), m.error.mean_abs_error, m.cpu_seconds,
        megabytes(m.file_bytes), better_cell(m, *standing.best_in_time),
        better_cell(m, *standing.best_in_file));
  }
  return html + "</tbody></table></div>\n";
}

std::string plot_figure(const DrawnPlot& plot, const char* caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                     inline_image(plot.svg, "image/svg+xml", plot.title), caption);
}

std::string plots(const PageContents& c) {
  const std::vector<DrawnPlot>& p = c.plots;
  std::string html =
      "<h2>Error against time and size</h2>\n<p>A point is a bake. The line is the Pareto front: "
      "nothing measured is better than a point on it in both respects. Circles are settings that have a "
      "name. "
      "Other sizes of the light are left out: they are other scenes.</p>\n";
  html +=
      plot_figure(p.at(0), "Mean abs error against the processor seconds of the bake, all threads together.");
  html += plot_figure(p.at(1), "Mean abs error against the bytes of the file.");
  html += plot_figure(p.at(2), "Mean abs error against the bytes that the functions take in textures.");
  html +=
      "<h2>What each setting does</h2>\n<p>One setting moved, all others as in the default, which is 1 on "
      "the "
      "vertical axes. Sample maps follow the map’s resolution, except where their own is moved. "
      "With the size of the light, the truth changes too.</p>\n";
  return html + plot_figure(p.at(3), "Error, seconds and bytes of the file by the default’s, logarithmic.");
}

std::string detail_figure(const DetailPicture& picture) {
  std::string html = "<figure>" + inline_png(picture.shadow, picture.name);
  if (!picture.measurement) {
    return html + "<figcaption><b>truth</b><br>shadow rays</figcaption></figure>\n";
  }
  const Measurement& m = *picture.measurement;
  html += inline_png(picture.difference, picture.name + ": |map - truth|");
  return html + fmt::format(
                    "<figcaption><b>{}</b><br>{}<br>{:.4f} in this picture, {:.4f} in all; {:.2f} s, "
                    "{:.3f} MB</figcaption></figure>\n",
                    html_text(picture.name), setting_text(m.setting), picture.mean_difference,
                    m.error.mean_abs_error, m.cpu_seconds, megabytes(m.file_bytes));
}

std::string pictures(const PageContents& c) {
  std::string html = fmt::format(
      "<h2>The same detail</h2>\n<p>The part of the picture in which the default errs most, drawn by several "
      "maps. "
      "Below each: |map − truth|, black 0, pale yellow {:g} and more; the number is its mean over the "
      "picture.</p>\n<div class=\"pictures\">\n",
      c.details.scale_top);
  html +=
      "<figure>" + inline_png(c.details.overview, "The whole, with the detail framed") +
      "<figcaption><b>the whole</b><br>by the default’s map; the frame is the detail</figcaption></figure>\n";
  for (const DetailPicture& picture : c.details.pictures) html += detail_figure(picture);
  return html + "</div>\n";
}

std::string promise(const PageContents& c) {
  const TubeCheck total = total_tube(c.sweep);
  return fmt::format(
      "<h2>The promise of the fit</h2>\n<p>Every function has to stay in its tube: within ε of what V takes "
      "on "
      "within δ of any depth. Each function of each bake was checked against a bake of the same samples "
      "without loss. <span class=\"{}\">{} of {} functions left their tube; the least distance from a wall "
      "was "
      "{:.2g}.</span></p>\n",
      total.outside == 0 ? "held" : "broken", total.outside, total.functions, total.worst_margin);
}

std::string table_row(const Measurement& m, const Standing& standing) {
  const TradeoffSetting& s = m.setting;
  const bool front = standing.on_time_front || standing.on_file_front;
  const char* row = !standing.name.empty() ? "named" : front ? "front" : "";
  std::string html = fmt::format(
      "<tr class=\"{}\"><td class=\"text\">{}</td><td>{}</td><td>{} × {}</td><td>{}</td><td "
      "class=\"text\">{}</td>"
      "<td>{}</td><td>{}</td>",
      row, html_text(standing.name), s.samples, s.width, s.height, s.map_scale,
      s.walk == Walk::exact ? "exact" : "midpoint", s.epsilon, s.light_scale);
  html += fmt::format("<td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.3f}</td>",
                      m.error.mean_abs_error, m.error.surface_error, m.error.free_error, m.error.rms_error,
                      m.error.p99_error);
  html += fmt::format(
      "<td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.3f}</td><td>{:.3f}</td>", m.seconds,
      m.cpu_seconds, 1e-6 * static_cast<double>(m.rays), 1e-6 * static_cast<double>(m.events),
      megabytes(m.file_bytes), megabytes(m.gpu_bytes));
  return html + fmt::format("<td class=\"text\">{}{}</td><td class=\"{}\">{}</td></tr>\n",
                            standing.on_time_front ? "time " : "", standing.on_file_front ? "size" : "",
                            m.tube.outside == 0 ? "held" : "broken", m.tube.outside);
}

std::string table(const PageContents& c) {
  std::string html =
      "<h2>All bakes</h2>\n<div class=\"wide\"><table>\n<thead><tr><th "
      "class=\"text\">name</th><th>samples</th>"
      "<th>texels</th><th>sample<br>maps ×</th><th class=\"text\">walk</th><th>ε</th><th>light ×</th>"
      "<th>mean abs<br>error</th><th>on<br>surfaces</th><th>in free<br>space</th><th>rms</th><th>p99</th>"
      "<th>seconds</th><th>processor<br>seconds</th><th>rays, M</th><th>events, "
      "M</th><th>file,<br>MB</th><th>GPU,<br>MB</th>"
      "<th class=\"text\">front</th><th>outside<br>the tube</th></tr></thead>\n<tbody>\n";
  for (std::size_t n = 0; n < c.sweep.measurements.size(); ++n)
    html += table_row(c.sweep.measurements[n], c.standings[n]);
  return html + "</tbody></table></div>\n";
}

std::string method(const PageContents& c) {
  return fmt::format(
      "<h2>How it was measured</h2>\n<ul>\n"
      "<li>An error is look-up (bilinear) minus truth; its mean is the sum of magnitudes over all points "
      "divided by "
      "the number of points in true shadow ({}), so that false shadow counts in full and lit points dilute "
      "nothing.</li>\n"
      "<li>The truth has {} shadow rays a point; its own standard error is {:.5f} (rms).</li>\n"
      "<li>Seconds are of BVH, bake and writing the file; processor seconds are of all threads together, "
      "which other work on the machine hardly changes.</li>\n"
      "<li>For other sizes of the light, the window stays that of the light at its own size.</li>\n"
      "<li><code>tradeoff.csv</code> and <code>tradeoff.json</code> hold all numbers, <code>plots/</code> "
      "the "
      "scripts of the plots.</li>\n</ul>\n",
      c.sweep.measurements.front().error.shadowed_points, c.options.verify.samples,
      c.sweep.measurements.front().error.truth_standard_error);
}

}  // namespace

std::string make_page(const PageContents& contents) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += fmt::format("<title>Trade-offs of light “{}”</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                      html_text(contents.sweep.light.name), kPageStyle);
  html += heading(contents) + facts(contents) + named_table(contents) + plots(contents) + pictures(contents) +
          promise(contents);
  html += table(contents) + method(contents);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace pdsm
