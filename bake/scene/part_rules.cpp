// SPDX-License-Identifier: Apache-2.0
#include "scene/part_rules.h"

#include <fnmatch.h>

#include <algorithm>
#include <optional>

#include "pdsm/format/error.h"
#include "scene/json_document.h"

namespace pdsm {
namespace {

bool fits(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

struct PartRule {
  std::optional<std::string> node, material;
  std::optional<bool> casts, receives;
  std::optional<double> opacity;
  std::optional<glm::dvec3> transmission;

  [[nodiscard]] bool fits_part(const PartNames& names) const {
    const auto fits_node = [this](const std::string& name) { return fits(*node, name); };
    return (!node || std::ranges::any_of(names.nodes, fits_node)) &&
           (!material || fits(*material, names.material));
  }
};

std::optional<std::string> read_pattern(const JsonFields& fields, const char* key) {
  if (!fields.has(key)) return {};
  const std::string pattern = fields.text(key);
  if (pattern.empty() || pattern.find('\0') != std::string::npos)
    fields.refuse(key, "must be a name, or a pattern of one");
  return pattern;
}

std::optional<bool> read_switch(const JsonFields& fields, const char* key) {
  if (!fields.has(key)) return {};
  return fields.boolean(key);
}

PartRule read_rule(const JsonFields& fields) {
  fields.allow_only({"node", "material", "casts", "receives", "opacity", "transmission"});
  PartRule rule{read_pattern(fields, "node"),
                read_pattern(fields, "material"),
                read_switch(fields, "casts"),
                read_switch(fields, "receives"),
                {},
                {}};
  if (!rule.node && !rule.material) fields.refuse("node", "or material must tell what the rule is for");
  if (fields.has("opacity")) rule.opacity = fields.share("opacity");
  if (fields.has("transmission")) rule.transmission = fields.colour("transmission");
  if (!rule.casts && !rule.receives && !rule.opacity && !rule.transmission)
    fields.refuse("casts", "or receives, opacity or transmission must be there");
  return rule;
}

}  // namespace

void apply_part_rules(const JsonFields& fields, const std::vector<PartNames>& names,
                      std::vector<Geometry>& parts) {
  if (!fields.has("parts")) return;
  const nlohmann::json& rules = fields.array("parts");
  for (std::size_t r = 0; r < rules.size(); ++r) {
    const std::string path = join_path(fields.path_of("parts"), r);
    const PartRule rule = read_rule(JsonFields(rules[r], fields.file(), path));
    bool any = false;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (!rule.fits_part(names[p])) continue;
      any = true;
      parts[p].casts = rule.casts.value_or(parts[p].casts);
      parts[p].receives = rule.receives.value_or(parts[p].receives);
      parts[p].transmission = rule.transmission.value_or(parts[p].transmission);
      parts[p].opacity = rule.opacity.value_or(parts[p].opacity);
    }
    if (!any) throw Error(Failure::input, fields.file() + ":" + path, "fits no part of the file");
  }
}

}  // namespace pdsm
