// SPDX-License-Identifier: Apache-2.0
uniform sampler2D picture;
in vec2 on_screen;
out vec4 colour;

void main() {
  colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
