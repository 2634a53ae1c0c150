// SPDX-License-Identifier: Apache-2.0
// A parallelogram.
uniform vec3 corner;
uniform vec3 edge_a;
uniform vec3 edge_b;
out vec3 world_position;

void main() {
  world_position = corner + float(gl_VertexID & 1) * edge_a + float(gl_VertexID >> 1) * edge_b;
  gl_Position = world_to_clip * vec4(world_position, 1.0);
}
