// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
uniform mat4 model;
out vec3 world_position;
out vec3 world_normal;

void main() {
  vec4 world = model * vec4(position, 1.0);
  world_position = world.xyz;
  world_normal = mat3(model) * normal.xyz;
  gl_Position = world_to_clip * world;
}
