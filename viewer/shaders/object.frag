// SPDX-License-Identifier: Apache-2.0
// Shades what moves, over the surfaces that do not.
uniform vec3 base_colour;
in vec3 world_position;
in vec3 world_normal;
out vec4 colour;

void main() {
  vec3 unit = normalize(world_normal);
  vec3 normal = dot(unit, world_position - eye.xyz) > 0.0 ? -unit : unit;
  colour = vec4(display_colour(world_position, normal, base_colour), 1.0);
}
