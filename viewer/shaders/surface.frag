// SPDX-License-Identifier: Apache-2.0
// What there is of the nearest surface in each pixel; it is shaded once a pixel from this.
uniform vec3 base_colour;
in vec3 world_position;
in vec3 world_normal;
layout(location = 0) out vec4 position;  // w: 1, where there is a surface
layout(location = 1) out vec4 normal;    // unit, towards the eye
layout(location = 2) out vec4 colour;    // linear RGB

void main() {
  vec3 unit = normalize(world_normal);
  position = vec4(world_position, 1.0);
  normal = vec4(dot(unit, world_position - eye.xyz) > 0.0 ? -unit : unit, 0.0);
  colour = vec4(base_colour, 1.0);
}
