// SPDX-License-Identifier: Apache-2.0
// What games use in place of a penumbra map, over one depth map seen from the light's centre: a hard shadow
// map, PCF over 4 x 4 texels, and PCSS with 16 blocker taps and 32 filter taps.
// Paper: Fernando, "Percentage-Closer Soft Shadows", 2005.
uniform highp sampler2D depth_map;
uniform vec4 light_rows[3];   // world to texels times depth, and depth
uniform float map_size;       // texels
uniform float light_texels;   // edge of the light in texels of a map at depth 1
uniform float near_depth;     // metres; nothing casts before
uniform float bias;           // metres

vec3 light_place(vec3 p) {
  vec3 q = vec3(dot(light_rows[0], vec4(p, 1.0)), dot(light_rows[1], vec4(p, 1.0)), dot(light_rows[2], vec4(p, 1.0)));
  return vec3(q.xy / q.z, q.z);
}
float depth_at(ivec2 texel) {
  return texelFetch(depth_map, clamp(texel, ivec2(0), ivec2(int(map_size) - 1)), 0).x;
}
float lit(ivec2 texel, float z) { return depth_at(texel) < z - bias ? 0.0 : 1.0; }

float hard(vec3 p) {
  vec3 place = light_place(p);
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(map_size)))) return 1.0;
  return lit(ivec2(place.xy), place.z);
}

float pcf(vec3 p) {
  vec3 place = light_place(p);
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(map_size)))) return 1.0;
  ivec2 corner = ivec2(place.xy - 1.5);
  float sum = 0.0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) sum += lit(corner + ivec2(x, y), place.z);
  return sum / 16.0;
}

// On a disk of radius 1: 16 of the blocker search, 32 of the filter.
uniform vec2 taps[48];

float pcss(vec3 p) {
  vec3 place = light_place(p);
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(map_size)))) return 1.0;
  float search = 0.5 * light_texels * (1.0 / near_depth - 1.0 / place.z);
  float depth_sum = 0.0, blockers = 0.0;
  for (int n = 0; n < 16; ++n) {
    float depth = depth_at(ivec2(place.xy + search * taps[n]));
    if (depth < place.z - bias) {
      depth_sum += depth;
      blockers += 1.0;
    }
  }
  if (blockers == 0.0) return 1.0;
  float blocker = depth_sum / blockers;
  float radius = max(0.5 * light_texels * (1.0 / blocker - 1.0 / place.z), 0.5);
  float sum = 0.0;
  for (int n = 16; n < 48; ++n) sum += lit(ivec2(place.xy + radius * taps[n]), place.z);
  return sum / 32.0;
}
