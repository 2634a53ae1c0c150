// SPDX-License-Identifier: Apache-2.0
// The small fog picture over the scene: nine of its pixels, those that lie as deep as the pixel itself.
uniform sampler2D fog;
uniform int shrink;
in vec2 on_screen;
out vec4 colour;

void main() {
  float here = view_depth(ivec2(gl_FragCoord.xy));
  vec2 place = gl_FragCoord.xy / float(shrink) - 0.5;
  ivec2 nearest = ivec2(floor(place + 0.5));
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      ivec2 texel = clamp(nearest + ivec2(x, y), ivec2(0), textureSize(fog, 0) - 1);
      vec2 away = (vec2(nearest + ivec2(x, y)) - place) / 1.5;
      float apart = abs(view_depth(texel * shrink + shrink / 2) - here) / here;
      float weight = max(0.0, 1.0 - dot(away, away)) / (1e-3 + apart * apart * 400.0) + 1e-6;
      sum += weight * texelFetch(fog, texel, 0);
      weights += weight;
    }
  }
  colour = sum / weights;
}
