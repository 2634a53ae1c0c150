// SPDX-License-Identifier: Apache-2.0
#include "evaluate/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "evaluate/colour.h"
#include "evaluate/framing.h"
#include "evaluate/heat_map.h"
#include "evaluate/studio.h"
#include "evaluate/volume_picture.h"
#include "pdsm/runtime/look_up.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

/// A light ready to shade with.
class Illumination {
 public:
  Illumination(const Scene& scene, const PictureLight& source, const Focus& focus,
               const RenderOptions& options, const glm::vec3& colour)
      : truth_samples_(options.truth_samples), studio_(make_studio_light(*source.light, focus, colour)) {
    if (source.map != nullptr) look_up_.emplace(*source.map);
    if (options.source != ShadowSource::map) {
      rays_ = std::make_unique<ShadowRays>(scene, *source.light, source.near_depth);
    }
  }

  /// Light that would arrive from all sides without casters.
  [[nodiscard]] glm::vec3 unshadowed(const glm::dvec3& p) const {
    const glm::dvec3& centre = studio_.points[4];
    return studio_.colour *
           irradiance(studio_, p, glm::vec3(studio_.distant ? centre : glm::normalize(centre - p)));
  }
  /// Light that would arrive on a surface without casters.
  [[nodiscard]] glm::vec3 unshadowed(const SurfacePoint& point) const {
    return studio_.colour * irradiance(studio_, point.position, point.normal);
  }
  /// Of red, green and blue.
  [[nodiscard]] glm::vec3 map_attenuation(const glm::dvec3& p) const {
    const auto [red, green, blue] = look_up_->at({p.x, p.y, p.z}, Filter::bilinear).rgb;
    return {red, green, blue};
  }
  [[nodiscard]] glm::vec3 true_attenuation(const glm::dvec3& p) const {
    // One seed for all points: what error there is varies as smoothly as the scene, and is no noise.
    const auto [red, green, blue] = rays_->rgb(p, truth_samples_, 0);
    return glm::vec3(glm::dvec3(red, green, blue));
  }

 private:
  std::uint32_t truth_samples_;
  StudioLight studio_;
  std::optional<PenumbraLookUp> look_up_;
  std::unique_ptr<ShadowRays> rays_;
};

/// What one viewing ray adds to its pixel.
struct Sample {
  glm::vec3 light{0};
  float difference = std::numeric_limits<float>::quiet_NaN();
  float shade = 0;
};

std::vector<Light> lights_of(std::span<const PictureLight> sources) {
  std::vector<Light> lights;
  for (const PictureLight& source : sources) lights.push_back(*source.light);
  return lights;
}

class Renderer {
 public:
  Renderer(const Scene& scene, std::span<const PictureLight> lights, const RenderOptions& options)
      : options_(options),
        picture_(scene),
        volumes_(scene),
        framing_(find_framing(scene, picture_, lights_of(lights), options.camera)),
        rays_(framing_.camera, options.width, options.height) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const glm::vec3 colour = studio_colour(i, lights.size());
      lights_.push_back(std::make_unique<Illumination>(scene, lights[i], framing_.focus, options, colour));
    }
  }

  void render_row(std::uint32_t y, Picture& picture) const {
    for (std::uint32_t x = 0; x < options_.width; ++x) render_pixel(x, y, picture);
  }

 private:
  void render_pixel(std::uint32_t x, std::uint32_t y, Picture& picture) const {
    const std::uint32_t n = options_.supersample;
    glm::vec3 linear(0), display(0);
    float difference = 0, shade = 0, on_surface = 0;
    for (std::uint32_t i = 0; i < n * n; ++i) {
      const Sample sample = trace(x + (i % n + 0.5) / n, y + (static_cast<double>(i / n) + 0.5) / n);
      linear += sample.light;
      display += display_values(film_curve(sample.light));
      shade += sample.shade;
      if (std::isnan(sample.difference)) continue;
      difference += sample.difference;
      ++on_surface;
    }
    const auto count = static_cast<float>(n * n);
    picture.linear.at(x, y) = linear / count;
    picture.display.at(x, y) = display / count;
    const std::size_t pixel = std::size_t{y} * options_.width + x;
    picture.shade[pixel] = shade / count;
    if (!picture.difference.empty()) picture.difference[pixel] = difference / on_surface;  // NaN for 0 / 0
  }

  [[nodiscard]] Sample trace(double x, double y) const {
    const glm::dvec3 direction = rays_.direction(x, y);
    const std::optional<SurfacePoint> point = picture_.trace(framing_.camera.eye, direction);
    Sample sample{studio_background(direction)};
    double distance = std::numeric_limits<double>::infinity();
    if (point) {
      sample = shade(*point);
      sample.light =
          glm::mix(sample.light, studio_background(direction), studio_fade(framing_.focus, point->position));
      distance = glm::length(point->position - framing_.camera.eye);
    }
    sample.light = volumes_.over(framing_.camera.eye, direction, distance, sample.light,
                                 [this](const glm::dvec3& p) { return arriving(p); });
    return sample;
  }

  /// Light that arrives in a volume.
  [[nodiscard]] glm::vec3 arriving(const glm::dvec3& p) const {
    glm::vec3 sum = 0.5F * (kStudioBounce + kStudioSky);
    for (const auto& light : lights_) {
      const glm::vec3 v =
          options_.source == ShadowSource::truth ? light->true_attenuation(p) : light->map_attenuation(p);
      sum += light->unshadowed(p) * (1.0F - v);
    }
    return sum;
  }

  [[nodiscard]] Sample shade(const SurfacePoint& point) const {
    Sample sample;
    glm::vec3 arriving = glm::mix(kStudioBounce, kStudioSky, 0.5F + 0.5F * point.normal.y);
    for (const auto& light : lights_) {
      const glm::vec3 full = light->unshadowed(point);
      // A surface that is turned away from a light is dark without any shadow.
      if (full == glm::vec3(0)) continue;
      const glm::vec3 v = attenuation(*light, point.position, sample);
      arriving += full * (1.0F - v);
      sample.shade += full.y / kStudioKeyStrength;
    }
    sample.shade = std::clamp(0.25F + 0.75F * sample.shade, 0.0F, 1.0F);
    sample.light = point.colour * arriving;
    return sample;
  }

  /// V to shade with; keeps the difference that is farthest from 0 over the lights and channels.
  [[nodiscard]] glm::vec3 attenuation(const Illumination& light, const glm::dvec3& p, Sample& sample) const {
    if (options_.source == ShadowSource::truth) return light.true_attenuation(p);
    const glm::vec3 by_map = light.map_attenuation(p);
    if (options_.source == ShadowSource::map) return by_map;
    const glm::vec3 difference = by_map - light.true_attenuation(p);
    for (int channel = 0; channel < 3; ++channel)
      if (!(std::abs(difference[channel]) <= std::abs(sample.difference)))
        sample.difference = difference[channel];
    return by_map;
  }

  RenderOptions options_;
  PictureScene picture_;
  VolumePicture volumes_;
  Framing framing_;
  CameraRays rays_;
  std::vector<std::unique_ptr<Illumination>> lights_;
};

}  // namespace

Picture render(const Scene& scene, std::span<const PictureLight> lights, const RenderOptions& options) {
  const Renderer renderer(scene, lights, options);
  const std::size_t pixels = std::size_t{options.width} * options.height;
  Picture picture{RgbImage(options.width, options.height), RgbImage(options.width, options.height), {}, {}};
  picture.shade.resize(pixels);
  if (options.source == ShadowSource::difference) picture.difference.resize(pixels);
  const auto rows = static_cast<std::int64_t>(options.height);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::int64_t y = 0; y < rows; ++y) renderer.render_row(static_cast<std::uint32_t>(y), picture);
  return picture;
}

DifferenceSummary summarise_difference(std::span<const float> difference) {
  DifferenceSummary summary;
  double sum = 0, squares = 0;
  for (const float value : difference) {
    if (std::isnan(value)) continue;
    const double d = std::abs(static_cast<double>(value));
    ++summary.pixels;
    sum += d;
    squares += d * d;
    summary.max = std::max(summary.max, d);
  }
  const auto pixels = static_cast<double>(std::max<std::uint64_t>(1, summary.pixels));
  summary.mean_abs = sum / pixels;
  summary.rms = std::sqrt(squares / pixels);
  return summary;
}

RgbImage draw_difference(const Picture& picture) {
  std::vector<float> magnitude(picture.difference.size());
  std::transform(picture.difference.begin(), picture.difference.end(), magnitude.begin(),
                 [](float d) { return std::isnan(d) ? -1.0F : std::abs(d); });
  const DifferenceSummary summary = summarise_difference(picture.difference);
  const std::string title = fmt::format("|map - truth|  mean {:.4f}  rms {:.4f}  max {:.3f}",
                                        summary.mean_abs, summary.rms, summary.max);
  return draw_heat_map(picture.linear.width, picture.linear.height, magnitude, picture.shade, title);
}

}  // namespace pdsm
