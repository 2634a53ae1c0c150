// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/pictures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "evaluate/colour.h"
#include "evaluate/framing.h"
#include "evaluate/heat_map.h"
#include "evaluate/render.h"
#include "pdsm/format/map_file.h"
#include "tradeoff/detail_points.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// Edges of the overview by those of the detail.
constexpr std::uint32_t kZoom = 6;
/// Pixels of the picture in which the detail is searched.
constexpr std::uint32_t kSearchWidth = 192, kSearchHeight = 144;
constexpr std::uint32_t kSearchTruthSamples = 64, kDetailTruthSamples = 256;

/// A rectangle of the search picture, in its pixels.
struct Frame {
  std::uint32_t x = 0, y = 0;
  static constexpr std::uint32_t width = kSearchWidth / kZoom, height = kSearchHeight / kZoom;
};

double sum_within(const std::vector<float>& difference, const Frame& frame) {
  double sum = 0;
  for (std::uint32_t y = frame.y; y < frame.y + Frame::height; ++y) {
    for (std::uint32_t x = frame.x; x < frame.x + Frame::width; ++x)
      sum += std::max(0.0F, difference[std::size_t{y} * kSearchWidth + x]);
  }
  return sum;
}

/// The frame with the largest sum of differences, on a grid of quarter frames.
Frame worst_frame(const std::vector<float>& difference) {
  Frame worst;
  double most = -1;
  Frame frame;
  for (frame.y = 0; frame.y + Frame::height <= kSearchHeight; frame.y += Frame::height / 4) {
    for (frame.x = 0; frame.x + Frame::width <= kSearchWidth; frame.x += Frame::width / 4) {
      const double sum = sum_within(difference, frame);
      if (sum <= most) continue;
      most = sum;
      worst = frame;
    }
  }
  return worst;
}

/// `camera` turned to the frame, its field of view narrowed to it.
Camera narrow(const Camera& camera, const Frame& frame) {
  const CameraRays rays(camera, kSearchWidth, kSearchHeight);
  const double half = camera.fov * std::numbers::pi / 360;
  Camera narrowed = camera;
  narrowed.target = camera.eye + rays.direction(frame.x + Frame::width / 2.0, frame.y + Frame::height / 2.0);
  narrowed.fov = std::atan(std::tan(half) / kZoom) * 360 / std::numbers::pi;
  return narrowed;
}

/// Outlines the frame in the overview, whose pixels are `scale` to one of the search picture.
void outline(RgbImage& image, const Frame& frame, std::uint32_t scale) {
  const glm::vec3 colour(1.0F, 0.75F, 0.1F);
  const std::uint32_t x0 = frame.x * scale, x1 = (frame.x + Frame::width) * scale - 1;
  const std::uint32_t y0 = frame.y * scale, y1 = (frame.y + Frame::height) * scale - 1;
  for (std::uint32_t thick = 0; thick < 2; ++thick) {
    for (std::uint32_t x = x0; x <= x1; ++x) image.at(x, y0 + thick) = image.at(x, y1 - thick) = colour;
    for (std::uint32_t y = y0; y <= y1; ++y) image.at(x0 + thick, y) = image.at(x1 - thick, y) = colour;
  }
}

RgbImage draw_heat(const std::vector<float>& difference, double top) {
  RgbImage image(kDetailWidth, kDetailHeight);
  for (std::size_t n = 0; n < difference.size(); ++n)
    image.pixels[n] = heat_colour(std::clamp(difference[n] / top, 0.0, 1.0));
  return image;
}

double mean_of_seen(const std::vector<float>& difference) {
  double sum = 0, seen = 0;
  for (const float d : difference) {
    sum += std::max(0.0F, d);
    seen += d >= 0 ? 1 : 0;
  }
  return sum / std::max(1.0, seen);
}

/// Draws all pictures of one sweep.
class DetailDrawing {
 public:
  DetailDrawing(const Scene& scene, const Sweep& sweep, const fs::path& folder,
                const SweepCallbacks& callbacks)
      : scene_(scene), sweep_(sweep), folder_(folder), callbacks_(callbacks) {}

  DetailPictures run() {
    fs::create_directories(folder_);
    find_detail();
    draw_truth();
    std::vector<std::vector<float>> differences;
    const DetailPoints seen(scene_, sweep_.light, sweep_.near_depth, camera_, kDetailWidth, kDetailHeight,
                            kDetailTruthSamples);
    for (const KeptMap& kept : sweep_.kept) differences.push_back(draw_map(kept, seen));
    draw_differences(differences);
    return std::move(result_);
  }

 private:
  void find_detail() {
    const Camera whole = find_framing(scene_, PictureScene(scene_), {&sweep_.light, 1}).camera;
    const PenumbraMap map = read_map(sweep_.kept.front().file);
    const DetailPoints seen(scene_, sweep_.light, sweep_.near_depth, whole, kSearchWidth, kSearchHeight,
                            kSearchTruthSamples);
    const Frame frame = worst_frame(seen.differences(map));
    camera_ = narrow(whole, frame);
    stop_if_cancelled(callbacks_);

    constexpr std::uint32_t kOverviewScale = 3;
    Picture overview =
        draw(whole, kOverviewScale * kSearchWidth, kOverviewScale * kSearchHeight, ShadowSource::map, &map);
    outline(overview.display, frame, kOverviewScale);
    result_.overview = folder_ / "overview.png";
    write_png(overview.display, result_.overview);
  }

  [[nodiscard]] Picture draw(const Camera& camera, std::uint32_t width, std::uint32_t height,
                             ShadowSource source, const PenumbraMap* map) const {
    stop_if_cancelled(callbacks_);
    const PictureLight light{&sweep_.light, map, sweep_.near_depth};
    RenderOptions options;
    options.camera = camera;
    options.width = width;
    options.height = height;
    options.source = source;
    return render(scene_, std::span(&light, 1), options);
  }

  void draw_truth() {
    DetailPicture picture;
    picture.name = "truth";
    picture.shadow = folder_ / "truth.png";
    const Picture drawn = draw(camera_, kDetailWidth, kDetailHeight, ShadowSource::truth, nullptr);
    write_png(drawn.display, picture.shadow);
    result_.pictures.push_back(picture);
  }

  /// Draws the detail by a map; |map - truth| of its pixels.
  std::vector<float> draw_map(const KeptMap& kept, const DetailPoints& seen) {
    if (callbacks_.progress) callbacks_.progress({"picture of " + kept.name, 1});
    const PenumbraMap map = read_map(kept.file);
    DetailPicture picture;
    picture.name = kept.name;
    picture.measurement = kept.measurement;
    std::string stem = kept.name;
    std::replace(stem.begin(), stem.end(), ' ', '-');
    picture.shadow = folder_ / (stem + ".png");
    picture.difference = folder_ / (stem + "-difference.png");
    write_png(draw(camera_, kDetailWidth, kDetailHeight, ShadowSource::map, &map).display, picture.shadow);
    std::vector<float> differences = seen.differences(map);
    picture.mean_difference = mean_of_seen(differences);
    result_.pictures.push_back(picture);
    return differences;
  }

  /// All in one scale.
  void draw_differences(const std::vector<std::vector<float>>& differences) {
    std::vector<float> all;
    for (const auto& difference : differences) {
      std::copy_if(difference.begin(), difference.end(), std::back_inserter(all),
                   [](float d) { return d > 0; });
    }
    result_.scale_top = heat_map_top(all);
    for (std::size_t n = 0; n < differences.size(); ++n)
      write_png(draw_heat(differences[n], result_.scale_top), result_.pictures[n + 1].difference);
  }

  const Scene& scene_;
  const Sweep& sweep_;
  const fs::path& folder_;
  const SweepCallbacks& callbacks_;
  Camera camera_;
  DetailPictures result_;
};

}  // namespace

DetailPictures draw_details(const Scene& scene, const Sweep& sweep, const fs::path& folder,
                            const SweepCallbacks& callbacks) {
  return DetailDrawing(scene, sweep, folder, callbacks).run();
}

}  // namespace pdsm
