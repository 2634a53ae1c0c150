// SPDX-License-Identifier: Apache-2.0
in vec4 line_colour;
in vec2 across;  // pixels from the middle, at the sides
out vec4 colour;

void main() {
  colour = vec4(line_colour.rgb, line_colour.a * clamp(across.y - abs(across.x), 0.0, 1.0));
}
