// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 tint;
layout(location = 2) in vec2 side;  // -1 or 1 at the sides; half the width, pixels
out vec4 line_colour;
out vec2 across;

void main() {
  line_colour = tint;
  across = vec2(side.x * side.y, side.y);
  gl_Position = clip;
}
