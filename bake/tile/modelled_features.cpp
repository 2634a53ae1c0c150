// SPDX-License-Identifier: Apache-2.0
#include "tile/modelled_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pdsm {
namespace {

/// Levels of a full mip chain within blocks.
constexpr std::uint32_t kAllLevels = 6;

std::string counted(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

/// The list under construction.
class FeatureList {
 public:
  void modelled(const char* feature, const std::string& reason) {
    list_.push_back({feature, true, reason, {}});
  }
  void left_out(const char* feature, const std::string& reason, const std::string& saved = {}) {
    list_.push_back({feature, false, reason, saved});
  }
  /// A feature whose reason is the same either way.
  void either(bool is_modelled, const char* feature, const std::string& reason_for,
              const std::string& reason_against, const std::string& saved = {}) {
    if (is_modelled)
      modelled(feature, reason_for);
    else
      left_out(feature, reason_against, saved);
  }
  [[nodiscard]] std::vector<ModelledFeature> release() { return std::move(list_); }

 private:
  std::vector<ModelledFeature> list_;
};

/// What vertices of another coding would take more.
std::string vertex_bytes(const VertexCoding& coding, const VertexCoding& other, std::uint64_t pieces) {
  const std::uint64_t words = other.words_per_vertex() - coding.words_per_vertex();
  return counted(4 * words * pieces, "bytes of vertices");
}

/// Of all views and channels.
std::uint64_t count_texels(const MapFacts& map) {
  std::uint64_t texels = 0;
  for (const BakeFacts& facts : map)
    texels += std::uint64_t{facts.fitted.view.width} * facts.fitted.view.height;
  return texels;
}

std::size_t count_views(const MapFacts& map) {
  return map.size() / map.front().channels;
}

/// What holds of a map: what is modelled in one view or channel is modelled.
BakeFacts sum_up(const MapFacts& map) {
  BakeFacts sum = map.front();
  for (const BakeFacts& facts : map) {
    sum.has_shadows = sum.has_shadows || facts.has_shadows;
    sum.is_projected = sum.is_projected && (facts.is_projected || !facts.has_shadows);
    sum.shift_law = sum.shift_law && facts.shift_law;
    sum.has_cutouts = sum.has_cutouts || facts.has_cutouts;
    sum.has_curves = sum.has_curves || facts.has_curves;
    sum.has_translucency = sum.has_translucency || facts.has_translucency;
    sum.slope_limit_from = std::min(sum.slope_limit_from, facts.slope_limit_from);
  }
  return sum;
}

/// How visibility was found. Numbers are of the map, not of the tiles: the file must not depend on those.
void list_visibility(const BakeFacts& facts, std::uint64_t texels, bool is_one_of_several,
                     const BlockCounts& done, FeatureList& list) {
  const std::uint64_t samples = facts.samples.size();
  const bool casts = facts.has_shadows, parallel = facts.fitted.view.projection == Projection::orthographic;
  list.either(casts, "shadow maps", "casters lie between light and window",
              "no caster lies between light and window", counted(samples, "shadow maps"));
  if (casts)
    list.either(!facts.is_projected, "tracing of shadow maps",
                parallel ? "the light is distant: triangles are projected only for lights with a place"
                         : "light samples lie out of the light's plane, or triangles are many or close to "
                           "the light",
                "triangles are projected into them", counted(samples, "traced maps"));
  if (facts.has_emission)
    list.modelled("emission", "the light has a picture: samples lie where it is bright, by luminance");
  if (casts && facts.has_cutouts)
    list.modelled("cutouts", facts.is_projected
                                 ? "casters have holes: they are traced, and all others projected"
                                 : "casters have holes");
  if (casts && facts.has_curves) list.modelled("curves", "casters are curves: they are traced");
  if (casts && (facts.shift_law || is_one_of_several))
    list.left_out("rays that nothing can darken", "no caster reaches them from anywhere on the light",
                  counted(done.undarkened_texels * samples, "walks of ") + std::to_string(texels * samples));
  if (casts)
    list.either(
        std::isfinite(facts.slope_limit_from), "bias of slopes before receivers",
        fmt::format("receivers lie close behind slopes that add more than {:.3g} m", facts.slope_limit_from),
        "hardly any receiver lies so close behind a slope", counted(samples, "maps of second rays"));
  list.either(!facts.shift_law, "general scan conversion", "light samples lie out of the light's plane",
              parallel ? "the light's rays are parallel: one walk serves all rays"
                       : "all light samples lie in the light's plane: one walk serves all rays",
              counted((texels - 1) * samples, "conversions of a ray"));
  if (casts && facts.has_translucency)
    list.modelled("translucency", "casters let a part of the light through: their layers are traced");
  else if (!casts || !facts.has_volumes)
    list.left_out("transmittance", "all casters are opaque: events are counted in integers",
                  counted(samples, "transmittance functions a map texel"));
  if (casts && facts.has_volumes)
    list.modelled("volumes", "densities take light away: the rays of maps march through them");
  else
    list.left_out("volumes", "the scene has none", counted(samples, "marched maps"));
}

void list_faces(const MapFacts& map, FeatureList& list) {
  list.either(count_views(map) > 1, "faces", "the light shines to more sides than one view sees",
              "one view holds the window", counted(5 * count_texels(map), "texels"));
}

/// Where functions are exact.
void list_domain(const BakeFacts& facts, FeatureList& list) {
  const FittedView& fitted = facts.fitted;
  list.either(facts.receivers != Receivers::all, "domain ends",
              "functions end at the last receiver on each ray",
              "--receivers all asks for functions exact to far");
  list.either(facts.receivers == Receivers::surfaces, "surfaces alone",
              "--receivers surfaces leaves free space out", "anything may receive in free space");
  list.either(fitted.window_fitted, "fitted window", "fitted to casters and receivers", "given by the scene");
  list.either(fitted.near_fitted, "fitted near", "nearest caster in the hull of light and window",
              "given by the scene");
  list.either(fitted.far_fitted, "fitted far", "last receiver in the window", "given by the scene");
}

void list_levels(const BakeFacts& facts, FeatureList& list) {
  std::uint64_t texels = 0;
  for (std::uint32_t level = 1; level <= kAllLevels; ++level)
    texels += std::uint64_t{facts.fitted.view.width >> level} * (facts.fitted.view.height >> level);
  list.either(facts.mip_levels > 0, "mip levels",
              "look-ups of up to " + std::to_string(1U << facts.mip_levels) +
                  " texels across find their mean: levels up to " + std::to_string(facts.mip_levels),
              facts.mip_levels_asked > 0 ? "the map is one texel across" : "not asked for by --mip-levels",
              counted(texels, "functions"));
}

/// How functions are stored.
void list_coding(const BakeFacts& facts, const BlockCounts& done, FeatureList& list) {
  const VertexCoding& coding = facts.coding;
  VertexCoding deep = coding, fine = coding;
  deep.depth_bits = 32;
  fine.value_bits = 16;
  list.either(facts.channels > 1, "colour", "the light or casters are coloured: red, green and blue",
              "the light and all casters are grey: one channel",
              counted(2 * 4 * coding.words_per_vertex() * done.pieces, "bytes of vertices"));
  list.either(coding.depth_bits == 32, "depths of 32 bits", "the depth tolerance needs 32 bits",
              "the depth tolerance needs 16 bits", vertex_bytes(coding, deep, done.pieces));
  list.either(coding.value_bits > 8, "values beyond 8 bits",
              "epsilon needs " + std::to_string(coding.value_bits) + " bits", "epsilon needs 8 bits",
              vertex_bytes(coding, fine, done.pieces));
}

}  // namespace

std::vector<ModelledFeature> list_modelled_features(const MapFacts& map, const BlockCounts& done) {
  const BakeFacts facts = sum_up(map);
  FeatureList list;
  list_visibility(facts, count_texels(map), count_views(map) > 1, done, list);
  list_faces(map, list);
  list_domain(facts, list);
  list_levels(facts, list);
  list_coding(facts, done, list);
  return list.release();
}

}  // namespace pdsm
