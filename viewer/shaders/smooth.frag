// SPDX-License-Identifier: Apache-2.0
// Takes the steps off edges: where brightness changes abruptly, a pixel is averaged along the edge.
uniform sampler2D picture;
in vec2 on_screen;
out vec4 colour;

float brightness(vec2 place) {
  return dot(texture(picture, place).rgb, vec3(0.30, 0.59, 0.11));
}

void main() {
  vec2 pixel = 1.0 / viewport.xy;
  vec2 place = gl_FragCoord.xy * pixel;
  float left = brightness(place - vec2(pixel.x, 0.0));
  float right = brightness(place + vec2(pixel.x, 0.0));
  float below = brightness(place - vec2(0.0, pixel.y));
  float above = brightness(place + vec2(0.0, pixel.y));
  vec2 slope = vec2(right - left, above - below);
  vec3 here = texture(picture, place).rgb;
  float steepness = length(slope);
  float edge = smoothstep(0.06, 0.16, steepness);
  vec2 along = vec2(-slope.y, slope.x) / max(steepness, 1e-6) * pixel;
  vec3 near = texture(picture, place + 0.6 * along).rgb + texture(picture, place - 0.6 * along).rgb;
  vec3 far = texture(picture, place + 1.7 * along).rgb + texture(picture, place - 1.7 * along).rgb;
  colour = vec4(mix(here, 0.28 * near + 0.12 * far + 0.20 * here, edge), 1.0);
}
