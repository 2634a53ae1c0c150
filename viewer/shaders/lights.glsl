// SPDX-License-Identifier: Apache-2.0
// The lights that are on, and what arrives of them.
struct ViewerLight {
  vec4 colour;     // linear RGB; w: number of its map, -1 without one
  vec4 direction;  // unit; 0 of a light that shines to all sides. w = 1: against it, too
  vec4 points[9];  // equal areas of the emitter; [4] is the centre. w = 0: unit vectors to a distant light
};
layout(std140) uniform ViewerLights {
  ivec4 light_count;
  ViewerLight viewer_lights[64];
};

vec3 way_to_light(vec4 point, vec3 position) {
  return point.xyz - point.w * position;
}

// Distance times the cosine at the light.
float facing(int light, vec3 to_light) {
  vec3 direction = viewer_lights[light].direction.xyz;
  if (direction == vec3(0.0)) return length(to_light);
  float ahead = -dot(direction, to_light);
  return viewer_lights[light].direction.w > 0.0 ? abs(ahead) : max(ahead, 0.0);
}

// As irradiance() in bake/evaluate/studio.h.
float irradiance(int light, vec3 position, vec3 normal) {
  float sum = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec3 to_light = way_to_light(viewer_lights[light].points[i], position);
    float squared = max(dot(to_light, to_light), 1e-30);
    float at_surface = max(dot(normal, to_light), 0.0);
    sum += at_surface * facing(light, to_light) / (squared * squared);
  }
  return sum / 9.0;
}

// What arrives at a point that faces every way: fog, particles.
float irradiance_around(int light, vec3 position) {
  vec3 to_light = way_to_light(viewer_lights[light].points[4], position);
  float squared = max(dot(to_light, to_light), 1e-30);
  return facing(light, to_light) / (squared * sqrt(squared));
}

// Metres between pixels.
float footprint_at(vec3 position) {
  return viewport.w * viewport.z * distance(position, eye.xyz);
}

float map_visibility(int light, vec3 position, vec3 normal) {
  int map = int(viewer_lights[light].colour.w);
  return map < 0 ? 1.0 : pdsm_visibility(map, position, normal, footprint_at(position));
}

// The same for red, green and blue.
vec3 map_visibility_rgb(int light, vec3 position, vec3 normal) {
  int map = int(viewer_lights[light].colour.w);
  return map < 0 ? vec3(1.0) : pdsm_visibility_rgb(map, position, normal, footprint_at(position));
}
