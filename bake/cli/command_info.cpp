// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/streams.h"
#include "evaluate/map_statistics.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string map;
  bool json = false;
};

Json view_json(const View& view, const VertexCoding& coding) {
  return {{"projection", view.projection == Projection::perspective ? "perspective" : "orthographic"},
          {"width", view.width},
          {"height", view.height},
          {"window", view.window},
          {"near", view.near_depth},
          {"far", view.far_depth},
          {"depth_step", depth_step(view, coding)},
          {"world_to_view",
           {{"rotation", view.world_to_view.rotation}, {"translation", view.world_to_view.translation}}}};
}

Json coding_json(const PenumbraMap& map) {
  const VertexCoding& coding = map.coding;
  return {{"depth_bits", coding.depth_bits},
          {"value_bits", coding.value_bits},
          {"channels", map.channels},
          {"value_max", coding.value_max}};
}

/// Bytes by type of chunk, in the order of first appearance.
Json bytes_json(const std::vector<std::byte>& bytes) {
  Json parts = Json::object();
  for (const ChunkSummary& chunk : list_chunks(bytes)) {
    Json& part = parts[chunk.type];
    if (part.is_null()) part = {{"chunks", 0}, {"stored", 0}, {"decoded", 0}};
    part["chunks"] = part["chunks"].get<std::uint64_t>() + 1;
    part["stored"] = part["stored"].get<std::uint64_t>() + chunk.stored_bytes;
    part["decoded"] = part["decoded"].get<std::uint64_t>() + chunk.decoded_bytes;
  }
  return {{"file", bytes.size()}, {"parts", parts}};
}

Json functions_json(const MapStatistics& statistics) {
  return {{"texels", statistics.texels},
          {"empty_texels", statistics.empty_texels},
          {"pieces", statistics.pieces},
          {"longest", statistics.longest}};
}

/// Functions and bytes by mip level; the blocks' own bytes alone.
Json levels_json(const PenumbraMap& map, const std::vector<std::byte>& bytes) {
  Json levels = Json::array();
  for (const FunctionImage& image : map.images) {
    if (image.level < levels.size()) continue;
    Json& level = levels.emplace_back(functions_json(level_statistics(map, image.level)));
    level["stored"] = level["decoded"] = std::uint64_t{0};
  }
  for (const ChunkSummary& chunk : list_chunks(bytes)) {
    if (chunk.type != "BLCK") continue;
    Json& level = levels[map.images[chunk.image].level];
    level["stored"] = level["stored"].get<std::uint64_t>() + chunk.stored_bytes;
    level["decoded"] = level["decoded"].get<std::uint64_t>() + chunk.decoded_bytes;
  }
  return levels;
}

Json info_json(const PenumbraMap& map, const std::vector<std::byte>& bytes) {
  Json json;
  json["views"] = Json::array();
  for (const View& view : map.views) json["views"].push_back(view_json(view, map.coding));
  json["layers"] = map.layers;
  json["layer_rule"] = map.layer_rule == LayerRule::maximum ? "maximum" : "clamped_sum";
  json["images"] = map.images.size();
  json["coding"] = coding_json(map);
  json["samples"] = map.samples.size();
  json["functions"] = functions_json(map_statistics(map));
  json["levels"] = levels_json(map, bytes);
  json["bytes"] = bytes_json(bytes);
  json["metadata"] = metadata_of(map);
  return json;
}

std::string views_text(const PenumbraMap& map) {
  std::string text;
  for (const View& view : map.views) {
    const auto& w = view.window;
    text += fmt::format(
        "view       {} {} x {}\n"
        "  window   [{:.6g}, {:.6g}, {:.6g}, {:.6g}]\n"
        "  depth    {:.6g} .. {:.6g} m, step {:.3g} m\n",
        view.projection == Projection::perspective ? "perspective" : "orthographic", view.width, view.height,
        w[0], w[1], w[2], w[3], view.near_depth, view.far_depth, depth_step(view, map.coding));
  }
  return text;
}

std::string functions_text(const PenumbraMap& map) {
  const MapStatistics s = map_statistics(map);
  const double texels = static_cast<double>(std::max<std::uint64_t>(1, s.texels));
  return fmt::format(
      "coding     depth {} bits, attenuation {} bits (0..{}), {}\n"
      "samples    {}\n"
      "texels     {}, {} empty ({:.1f}%)\n"
      "functions  {} pieces, longest {}\n",
      map.coding.depth_bits, map.coding.value_bits, map.coding.value_max,
      map.channels == 1 ? "1 channel" : "3 channels", map.samples.size(), s.texels, s.empty_texels,
      100 * static_cast<double>(s.empty_texels) / texels, s.pieces, s.longest);
}

std::string bytes_text(const Json& bytes) {
  std::string text = fmt::format("bytes      {}\n", bytes["file"].get<std::uint64_t>());
  for (const auto& [type, part] : bytes["parts"].items()) {
    text += fmt::format("  {:<8} {} ({} decoded, {} chunks)\n", type, part["stored"].get<std::uint64_t>(),
                        part["decoded"].get<std::uint64_t>(), part["chunks"].get<std::uint64_t>());
  }
  return text;
}

/// Nothing for a map of one level: all that could be said is said.
std::string levels_text(const Json& levels) {
  std::string text;
  for (std::size_t n = 0; levels.size() > 1 && n < levels.size(); ++n) {
    const auto number = [&](const char* key) { return levels[n][key].get<std::uint64_t>(); };
    text += fmt::format("  level {:<2} {} bytes ({} decoded), {} texels, {} pieces, longest {}\n", n,
                        number("stored"), number("decoded"), number("texels"), number("pieces"),
                        number("longest"));
  }
  return text;
}

/// Value of any type as text; strings without quotes.
std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// What the metadata tells of the bake, as far as it does: it may come from elsewhere.
std::string metadata_text(const Json& metadata) {
  std::string text;
  for (const char* key :
       {"light", "options", "epsilon", "depth_tolerance", "bias", "achieved", "isa", "tool", "key"}) {
    if (!metadata.is_object() || !metadata.contains(key)) continue;
    text += fmt::format("{:<10} ", key);
    const Json& value = metadata[key];
    if (value.is_object()) {
      for (const auto& [name, entry] : value.items()) text += name + " " + plain(entry) + "  ";
      text.resize(text.size() - (value.empty() ? 0 : 2));
    } else {
      text += plain(value);
    }
    text += '\n';
  }
  return text;
}

std::string modelled_text(const Json& metadata) {
  std::string text;
  if (!metadata.is_object() || !metadata.contains("modelled") || !metadata["modelled"].is_array())
    return text;
  for (const Json& feature : metadata["modelled"]) {
    if (!feature.is_object()) continue;
    const bool modelled = feature.value("modelled", Json(false)) == Json(true);
    const std::string saved = plain(feature.value("saved", Json("")));
    text += fmt::format("{} {}: {}{}\n", modelled ? "modelled  " : "left out  ",
                        plain(feature.value("feature", Json(""))), plain(feature.value("reason", Json(""))),
                        saved.empty() ? "" : " (saves " + saved + ")");
  }
  return text;
}

std::string info_text(const std::string& name, const PenumbraMap& map, const std::vector<std::byte>& bytes) {
  const Json metadata = metadata_of(map);
  return name + "\n" + views_text(map) + functions_text(map) + metadata_text(metadata) +
         modelled_text(metadata) + bytes_text(bytes_json(bytes)) + levels_text(levels_json(map, bytes));
}

int run_info(const InfoOptions& options) {
  const std::vector<std::byte> bytes = read_bytes(options.map);
  const PenumbraMap map = read_map(bytes, options.map);
  write_result(options.json ? info_json(map, bytes).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                            : info_text(options.map, map, bytes));
  return kExitOk;
}

}  // namespace

void add_info_command(CommandLine& line) {
  auto options = std::make_shared<InfoOptions>();
  Options takes = line.add_command("info", "What is in a map, and what it was made of",
                                   [options] { return run_info(*options); });
  takes.file("FILE", options->map, "Map");
  takes.flag("--json", options->json, "Print JSON");
}

}  // namespace pdsm
