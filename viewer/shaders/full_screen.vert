// SPDX-License-Identifier: Apache-2.0
// One triangle that covers the picture, at the far plane.
out vec2 on_screen;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  on_screen = corner;
  gl_Position = vec4(corner, 1.0, 1.0);
}
