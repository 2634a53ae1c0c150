// SPDX-License-Identifier: Apache-2.0
#include "part/facts_record.h"

#include <bit>
#include <cmath>

#include "bytes.h"
#include "invariants.h"
#include "part/part_layout.h"

namespace pdsm {
namespace {

/// Views that a light may have.
constexpr std::uint32_t kMostViews = 6;
constexpr std::uint32_t kMostChannels = 3;

/// Bits of FactsRecord::flags.
enum FactFlag : std::uint32_t {
  kWindowFitted = 1,
  kNearFitted = 2,
  kFarFitted = 4,
  kNothingCasts = 8,
  kHasShadows = 16,
  kIsProjected = 32,
  kShiftLaw = 64,
  kHasCutouts = 128,
  kHasEmission = 256,
  kHasBlockKeys = 512,
  kHasTranslucency = 1024,
  kCastsBeforeNear = 2048,
  kHasVolumes = 4096,
  kHasCurves = 8192,
  kAllFlags = 16383
};

std::uint32_t flags_of(const BakeFacts& facts) {
  const auto bit = [](bool set, FactFlag flag) { return set ? static_cast<std::uint32_t>(flag) : 0U; };
  return bit(facts.fitted.window_fitted, kWindowFitted) | bit(facts.fitted.near_fitted, kNearFitted) |
         bit(facts.fitted.far_fitted, kFarFitted) | bit(facts.fitted.nothing_casts, kNothingCasts) |
         bit(facts.has_shadows, kHasShadows) | bit(facts.is_projected, kIsProjected) |
         bit(facts.shift_law, kShiftLaw) | bit(facts.has_cutouts, kHasCutouts) |
         bit(facts.has_emission, kHasEmission) | bit(facts.has_block_keys, kHasBlockKeys) |
         bit(facts.has_translucency, kHasTranslucency) | bit(facts.has_volumes, kHasVolumes) |
         bit(facts.has_curves, kHasCurves) | bit(facts.fitted.casts_before_near, kCastsBeforeNear);
}

void set_flags(std::uint32_t flags, BakeFacts& facts) {
  facts.fitted.window_fitted = (flags & kWindowFitted) != 0;
  facts.fitted.near_fitted = (flags & kNearFitted) != 0;
  facts.fitted.far_fitted = (flags & kFarFitted) != 0;
  facts.fitted.nothing_casts = (flags & kNothingCasts) != 0;
  facts.fitted.casts_before_near = (flags & kCastsBeforeNear) != 0;
  facts.has_shadows = (flags & kHasShadows) != 0;
  facts.is_projected = (flags & kIsProjected) != 0;
  facts.shift_law = (flags & kShiftLaw) != 0;
  facts.has_cutouts = (flags & kHasCutouts) != 0;
  facts.has_emission = (flags & kHasEmission) != 0;
  facts.has_translucency = (flags & kHasTranslucency) != 0;
  facts.has_curves = (flags & kHasCurves) != 0;
  facts.has_volumes = (flags & kHasVolumes) != 0;
  facts.has_block_keys = (flags & kHasBlockKeys) != 0;
}

bool is_sound(const FactsRecord& record) {
  for (const double x : {record.receivers_outside, record.epsilon, record.depth_tolerance, record.bias}) {
    if (!std::isfinite(x) || x < 0) return false;
  }
  // Infinite where no slope is limited.
  if (std::isnan(record.slope_limit_from) || record.slope_limit_from < 0) return false;
  return record.projection <= static_cast<std::uint32_t>(Projection::orthographic) &&
         record.walk <= static_cast<std::uint32_t>(Walk::exact) &&
         (record.channels == 1 || record.channels == kMostChannels) &&
         record.receivers <= static_cast<std::uint32_t>(Receivers::surfaces) && record.flags <= kAllFlags;
}

BakeFacts facts_of(const FactsRecord& record) {
  BakeFacts facts;
  View& view = facts.fitted.view;
  view.world_to_view = {record.rotation, record.translation};
  view.projection = static_cast<Projection>(record.projection);
  view.window = record.window;
  view.near_depth = record.near_depth;
  view.far_depth = record.far_depth;
  view.width = record.width;
  view.height = record.height;
  facts.fitted.receivers_outside = record.receivers_outside;
  facts.channels = record.channels;
  facts.coding = {record.depth_bits, record.value_bits, record.value_max};
  facts.mip_levels = record.mip_levels;
  facts.mip_levels_asked = record.mip_levels_asked;
  facts.map_width = record.map_width;
  facts.map_height = record.map_height;
  facts.epsilon = record.epsilon;
  facts.depth_tolerance = record.depth_tolerance;
  facts.bias = record.bias;
  facts.slope_limit_from = record.slope_limit_from;
  facts.walk = static_cast<Walk>(record.walk);
  facts.receivers = static_cast<Receivers>(record.receivers);
  facts.dropped_triangles = record.dropped_triangles;
  set_flags(record.flags, facts);
  return facts;
}

/// Whether a map of this view and these levels can be.
bool makes_a_map(const BakeFacts& facts) {
  const View& view = facts.fitted.view;
  if (check_coding(facts.coding) || check_view(view, facts.coding)) return false;
  const auto most = static_cast<std::uint32_t>(std::bit_width(std::min(view.width, view.height)) - 1);
  return facts.mip_levels <= std::min(most, kMostMipLevels);
}

/// Of the channels and views after the first. All have its levels, its coding and its ends; the channels of a
/// view have that view.
bool read_more(std::uint32_t count, ByteReader& reader, MapFacts& facts) {
  const BakeFacts first = facts.front();
  if (count >= kMostViews * first.channels || (count + 1) % first.channels != 0) return false;
  for (std::uint32_t n = 1; n <= count; ++n) {
    const auto record = reader.value<FactsRecord>();
    if (!reader.ok() || !is_sound(record)) return false;
    if ((record.samples | record.isa_bytes | record.description_bytes | record.more_records) != 0)
      return false;
    const BakeFacts& next = facts.emplace_back(facts_of(record));
    const bool is_kin = next.coding == first.coding && next.mip_levels == first.mip_levels &&
                        next.receivers == first.receivers && next.channels == first.channels &&
                        (n % first.channels == 0 || next.fitted.view == facts[n - 1].fitted.view);
    if (!is_kin || !makes_a_map(next)) return false;
  }
  return true;
}

bool read_samples(std::uint32_t count, ByteReader& reader, std::vector<LightSample>& samples) {
  if (std::uint64_t{count} * sizeof(FactsSample) > reader.remaining()) return false;
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto record = reader.value<FactsSample>();
    const LightSample& sample =
        samples.emplace_back(LightSample{record.position, record.jitter, record.weight});
    if (record.reserved != 0 || check_sample(sample)) return false;
  }
  return true;
}

bool read_text(std::uint32_t size, ByteReader& reader, std::string& text) {
  if (size > reader.remaining()) return false;
  text.resize(size);
  reader.array(std::span(text.data(), text.size()));
  return reader.ok();
}

FactsRecord record_of(const BakeFacts& facts) {
  const View& view = facts.fitted.view;
  FactsRecord record;
  record.rotation = view.world_to_view.rotation;
  record.translation = view.world_to_view.translation;
  record.window = view.window;
  record.near_depth = view.near_depth;
  record.far_depth = view.far_depth;
  record.receivers_outside = facts.fitted.receivers_outside;
  record.epsilon = facts.epsilon;
  record.depth_tolerance = facts.depth_tolerance;
  record.bias = facts.bias;
  record.slope_limit_from = facts.slope_limit_from;
  record.dropped_triangles = facts.dropped_triangles;
  record.projection = static_cast<std::uint32_t>(view.projection);
  record.width = view.width;
  record.height = view.height;
  record.mip_levels = facts.mip_levels;
  record.mip_levels_asked = facts.mip_levels_asked;
  record.depth_bits = facts.coding.depth_bits;
  record.value_bits = facts.coding.value_bits;
  record.channels = facts.channels;
  record.value_max = facts.coding.value_max;
  record.map_width = facts.map_width;
  record.map_height = facts.map_height;
  record.walk = static_cast<std::uint32_t>(facts.walk);
  record.receivers = static_cast<std::uint32_t>(facts.receivers);
  record.flags = flags_of(facts);
  return record;
}

}  // namespace

std::vector<std::byte> encode_facts(const DescribedFacts& described) {
  const BakeFacts& facts = described.facts.front();
  const auto size = [](const auto& all) { return static_cast<std::uint32_t>(all.size()); };
  FactsRecord record = record_of(facts);
  record.more_records = size(described.facts) - 1;
  record.samples = size(facts.samples);
  record.isa_bytes = size(facts.isa);
  record.description_bytes = size(described.description);
  std::vector<std::byte> bytes;
  append_value(bytes, record);
  for (std::size_t n = 1; n < described.facts.size(); ++n) append_value(bytes, record_of(described.facts[n]));
  for (const LightSample& sample : facts.samples)
    append_value(bytes, FactsSample{sample.position, sample.jitter, sample.weight, 0});
  append_array<char>(bytes, facts.isa);
  append_array<char>(bytes, described.description);
  return bytes;
}

std::optional<DescribedFacts> decode_facts(std::span<const std::byte> payload) {
  ByteReader reader(payload);
  const auto record = reader.value<FactsRecord>();
  if (!reader.ok() || !is_sound(record)) return {};
  DescribedFacts described{{facts_of(record)}, {}};
  if (!makes_a_map(described.facts.front()) || !read_more(record.more_records, reader, described.facts))
    return {};
  BakeFacts& first = described.facts.front();
  const bool whole =
      read_samples(record.samples, reader, first.samples) && read_text(record.isa_bytes, reader, first.isa) &&
      read_text(record.description_bytes, reader, described.description) && reader.remaining() == 0;
  if (!whole || first.samples.empty() || check_metadata(described.description)) return {};
  return described;
}

}  // namespace pdsm
