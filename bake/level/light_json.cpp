// SPDX-License-Identifier: Apache-2.0
#include "level/light_json.h"

namespace pdsm {

nlohmann::ordered_json light_json(const Light& light) {
  const RigidTransform frame = light_frame(light);
  const auto& r = frame.rotation;
  nlohmann::ordered_json json{{"name", light.name}};
  if (const auto* rect = std::get_if<RectLight>(&light.shape)) {
    json["type"] = "rect";
    json["width"] = rect->width;
    json["height"] = rect->height;
  } else if (const auto* sun = std::get_if<DistantLight>(&light.shape)) {
    json["type"] = "distant";
    json["angle"] = sun->angle;
  } else if (const auto* sphere = std::get_if<SphereLight>(&light.shape)) {
    json["type"] = "sphere";
    json["radius"] = sphere->radius;
  } else if (std::holds_alternative<MeshLight>(light.shape)) {
    const auto [x, y, z] = half_box(light);
    json["type"] = "mesh";
    json["size"] = {2 * x, 2 * y, 2 * z};
  } else {
    json["type"] = "disk";
    json["radius"] = std::get<DiskLight>(light.shape).radius;
  }
  if (light.two_sided) json["two_sided"] = true;
  if (view_count(light) > 2) json["faces"] = view_count(light);
  if (!is_distant(light)) json["position"] = {light.position.x, light.position.y, light.position.z};
  json["direction"] = {r[6], r[7], r[8]};
  json["up"] = {r[3], r[4], r[5]};
  return json;
}

}  // namespace pdsm
