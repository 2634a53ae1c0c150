// SPDX-License-Identifier: Apache-2.0
// Soft points that drift through a box, each lit at its centre. Positions are a function of time alone.
uniform float spread;  // half edge of the box, metres
uniform float size;    // metres
out vec2 on_point;
out vec3 point_colour;
out float view_distance;

uint hash(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

float unit(uint seed) {
  return float(hash(seed) >> 8) / 16777216.0;
}

vec3 drifting(uint id, float seconds) {
  vec3 start = vec3(unit(4u * id), unit(4u * id + 1u), unit(4u * id + 2u));
  vec3 phase = 6.2832 * start.yzx;
  vec3 drift = vec3(0.010, 0.018, 0.006) * (0.5 + start.zxy) * seconds;
  vec3 sway = 0.012 * sin(phase + seconds * (0.4 + 0.5 * start));
  return 2.0 * fract(start + drift + sway) - 1.0;
}

void main() {
  uint id = uint(gl_InstanceID);
  vec3 in_box = drifting(id, fade.z);
  vec3 centre = focus.xyz + spread * in_box * vec3(1.0, 0.8, 1.0);
  vec3 arriving = 0.06 * sky.rgb;
  for (int i = 0; i < light_count.x; ++i) {
    arriving += 0.4 * viewer_lights[i].colour.rgb * irradiance_around(i, centre) * map_visibility(i, centre, vec3(0.0));
  }
  // Points come and go at the faces of the box.
  vec3 inside = smoothstep(vec3(1.0), vec3(0.8), abs(in_box));
  point_colour = vec3(1.0, 0.88, 0.66) * arriving * inside.x * inside.y * inside.z;

  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec4 clip = world_to_clip * vec4(centre, 1.0);
  float radius = max(size * (0.5 + unit(4u * id + 3u)), 1.1 * viewport.z * clip.w);
  clip.xy += corner * radius / viewport.z * 2.0 / viewport.xy;
  on_point = corner;
  view_distance = clip.w;
  gl_Position = clip;
}
