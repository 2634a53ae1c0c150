// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pdsm {
namespace {

constexpr std::uint32_t kMostSamples = 65536, kMostTexels = 16384;
/// What fitting and coding a texel takes, in rays.
constexpr double kRaysPerTexel = 40;

/// Values of a sweep; those of samples, resolution and light as multiples of the centre's.
struct SweepValues {
  std::vector<double> samples, resolution, grid_epsilon, star_epsilon, map_scale, light;
};

SweepValues values_of(Effort effort) {
  switch (effort) {
    case Effort::full:
      return {{1.0 / 64, 1.0 / 16, 0.125, 0.25, 0.5, 1, 2, 4},
              {0.125, 0.25, 0.5, 1, 2},
              {0.002, 0.005, 0.01, 0.02, 0.05},
              {0, 0.1, 0.2},
              {0.25, 0.5, 2, 4},
              {0.25, 0.5, 1.5, 2, 3}};
    case Effort::quick:
    case Effort::normal:
      break;
  }
  return {{1.0 / 16, 0.25, 1, 4}, {0.25, 0.5, 1, 2}, {0.005, 0.01, 0.02, 0.05}, {0, 0.1},
          {0.25, 0.5, 2},         {0.25, 0.5, 2}};
}

std::uint32_t times(std::uint32_t count, double factor) {
  return static_cast<std::uint32_t>(std::lround(count * factor));
}

TradeoffSetting with(Factor factor, double value, TradeoffSetting setting) {
  switch (factor) {
    case Factor::samples:
      setting.samples = times(setting.samples, value);
      break;
    case Factor::resolution:
      setting.width = times(setting.width, value);
      setting.height = times(setting.height, value);
      break;
    case Factor::map_scale:
      setting.map_scale = value;
      break;
    case Factor::walk:
      setting.walk = value == 0 ? Walk::midpoint : Walk::exact;
      break;
    case Factor::epsilon:
      setting.epsilon = value;
      break;
    case Factor::light_scale:
      setting.light_scale = value;
      break;
  }
  return setting;
}

bool can_be_baked(const TradeoffSetting& s) {
  const auto is_size = [](double texels) { return texels >= 1 && texels <= kMostTexels; };
  return s.samples >= 1 && s.samples <= kMostSamples && is_size(s.width) && is_size(s.height) &&
         is_size(s.width * s.map_scale) && is_size(s.height * s.map_scale);
}

/// Rays of all sample maps.
double ray_count(const TradeoffSetting& s) {
  return static_cast<double>(s.width) * s.height * s.samples * s.map_scale * s.map_scale;
}

/// Makes a plan of settings of up to `most_rays` each.
class PlanMaker {
 public:
  PlanMaker(const TradeoffSetting& centre, double most_rays, double largest_scale)
      : most_rays_(most_rays), largest_scale_(largest_scale) {
    plan_.centre = centre;
  }

  void add_named(const NamedSetting& named) {
    if (add(named.setting)) plan_.named.push_back(named);
  }

  void add_star(const SweepValues& values) {
    add_along(Factor::samples, values.samples);
    add_along(Factor::resolution, values.resolution);
    add_along(Factor::map_scale, values.map_scale);
    add_along(Factor::walk, {0, 1});
    add_along(Factor::epsilon, values.star_epsilon);
    add_along(Factor::light_scale, values.light);
  }

  void add_grid(const SweepValues& values) {
    for (const double samples : values.samples) {
      for (const double resolution : values.resolution) {
        for (const double epsilon : values.grid_epsilon) {
          const TradeoffSetting sampled = with(Factor::samples, samples, plan_.centre);
          (void)add(with(Factor::epsilon, epsilon, with(Factor::resolution, resolution, sampled)));
        }
      }
    }
  }

  /// Cheap groups first, but for the centre's.
  SweepPlan take() {
    std::stable_sort(plan_.groups.begin() + 1, plan_.groups.end(), [](const auto& a, const auto& b) {
      return setting_cost(a.settings.front()) < setting_cost(b.settings.front());
    });
    return std::move(plan_);
  }

 private:
  void add_along(Factor factor, const std::vector<double>& values) {
    for (const double value : values) (void)add(with(factor, value, plan_.centre));
  }

  /// Adds a setting to the group of its like, once. Whether it may be in the plan.
  bool add(const TradeoffSetting& setting) {
    if (!can_be_baked(setting) || ray_count(setting) > most_rays_) return false;
    if (setting.light_scale > largest_scale_) return false;
    const auto is_of = [&](const SettingGroup& group) {
      return same_but_for(Factor::epsilon, group.settings.front(), setting);
    };
    auto group = std::find_if(plan_.groups.begin(), plan_.groups.end(), is_of);
    if (group == plan_.groups.end()) group = plan_.groups.insert(group, SettingGroup{});
    auto& settings = group->settings;
    if (std::find(settings.begin(), settings.end(), setting) == settings.end()) settings.push_back(setting);
    return true;
  }

  SweepPlan plan_;
  double most_rays_, largest_scale_;
};

}  // namespace

std::size_t SweepPlan::setting_count() const {
  std::size_t count = 0;
  for (const SettingGroup& group : groups) count += group.settings.size();
  return count;
}

double largest_light_scale(const Light& light) {
  const auto* sun = std::get_if<DistantLight>(&light.shape);
  return sun == nullptr ? std::numeric_limits<double>::infinity() : kMostDistantAngle / sun->angle;
}

SweepPlan plan_sweep(const TradeoffSetting& centre, const std::vector<NamedSetting>& presets, Effort effort,
                     double largest_scale) {
  const double most_rays =
      effort == Effort::quick ? ray_count(centre) : std::numeric_limits<double>::infinity();
  PlanMaker maker(centre, most_rays, largest_scale);
  maker.add_named({"default", centre});
  for (const NamedSetting& preset : presets) maker.add_named(preset);
  maker.add_star(values_of(effort));
  maker.add_grid(values_of(effort));
  return maker.take();
}

TradeoffSetting setting_of(const BakeOptions& options) {
  TradeoffSetting setting;
  setting.samples = options.samples;
  setting.width = options.width;
  setting.height = options.height;
  if (options.map_width > 0) setting.map_scale = static_cast<double>(options.map_width) / options.width;
  setting.walk = options.walk;
  setting.epsilon = options.epsilon;
  return setting;
}

BakeOptions options_of(const TradeoffSetting& setting, BakeOptions base) {
  base.samples = setting.samples;
  base.width = setting.width;
  base.height = setting.height;
  base.map_width = times(setting.width, setting.map_scale);
  base.map_height = times(setting.height, setting.map_scale);
  base.walk = setting.walk;
  base.epsilon = setting.epsilon;
  return base;
}

Light scaled_light(Light light, double scale) {
  if (const auto* emitter = std::get_if<MeshLight>(&light.shape)) {
    auto mesh = std::make_shared<Mesh>(*emitter->mesh);
    for (glm::vec3& p : mesh->positions) p *= static_cast<float>(scale);
    light.shape = MeshLight{std::move(mesh)};
  } else if (auto* rect = std::get_if<RectLight>(&light.shape)) {
    rect->width *= scale;
    rect->height *= scale;
  } else if (auto* sun = std::get_if<DistantLight>(&light.shape)) {
    sun->angle *= scale;
  } else if (auto* sphere = std::get_if<SphereLight>(&light.shape)) {
    sphere->radius *= scale;
  } else {
    std::get<DiskLight>(light.shape).radius *= scale;
  }
  return light;
}

bool same_but_for(Factor factor, const TradeoffSetting& a, const TradeoffSetting& b) {
  TradeoffSetting moved = a;
  switch (factor) {
    case Factor::samples:
      moved.samples = b.samples;
      break;
    case Factor::resolution:
      moved.width = b.width;
      moved.height = b.height;
      break;
    case Factor::map_scale:
      moved.map_scale = b.map_scale;
      break;
    case Factor::walk:
      moved.walk = b.walk;
      break;
    case Factor::epsilon:
      moved.epsilon = b.epsilon;
      break;
    case Factor::light_scale:
      moved.light_scale = b.light_scale;
      break;
  }
  return moved == b;
}

double factor_value(Factor factor, const TradeoffSetting& setting) {
  switch (factor) {
    case Factor::samples:
      return setting.samples;
    case Factor::resolution:
      return std::sqrt(static_cast<double>(setting.width) * setting.height);
    case Factor::map_scale:
      return setting.map_scale;
    case Factor::walk:
      return setting.walk == Walk::exact ? 1 : 0;
    case Factor::epsilon:
      return setting.epsilon;
    case Factor::light_scale:
      break;
  }
  return setting.light_scale;
}

const char* factor_name(Factor factor) {
  switch (factor) {
    case Factor::samples:
      return "samples";
    case Factor::resolution:
      return "resolution";
    case Factor::map_scale:
      return "map resolution";
    case Factor::walk:
      return "walk";
    case Factor::epsilon:
      return "epsilon";
    case Factor::light_scale:
      break;
  }
  return "light size";
}

std::string setting_key(const TradeoffSetting& s) {
  return fmt::format("n{}-r{}x{}-m{}-{}-e{}-l{}", s.samples, s.width, s.height, s.map_scale,
                     s.walk == Walk::exact ? "exact" : "midpoint", s.epsilon, s.light_scale);
}

double setting_cost(const TradeoffSetting& s) {
  return ray_count(s) + kRaysPerTexel * s.width * s.height;
}

}  // namespace pdsm
