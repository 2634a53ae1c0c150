// SPDX-License-Identifier: Apache-2.0
// How a point of a surface looks. SURFACE_MODE: 0 shaded by maps, 1 visibility, 2 shaded by truth, 3 error.
uniform float dim;
#if SURFACE_MODE == 2
uniform sampler2DArray truth;  // attenuation, a layer a light, pixel by pixel
#elif SURFACE_MODE == 3
uniform sampler2D error;  // |map - truth| of each pixel; < 0: none
uniform sampler2D heat;
uniform float error_top;
#endif

vec3 visibility(int light, vec3 position, vec3 normal) {
#if SURFACE_MODE == 2
  return vec3(1.0 - texelFetch(truth, ivec3(gl_FragCoord.xy, light), 0).r);
#else
  return map_visibility_rgb(light, position, normal);
#endif
}

vec3 shaded(vec3 position, vec3 normal, vec3 base_colour) {
  vec3 arriving = ambient(normal);
  for (int i = 0; i < light_count.x; ++i) {
    arriving += viewer_lights[i].colour.rgb * irradiance(i, position, normal) * visibility(i, position, normal);
  }
  return mix(base_colour * arriving, background(normalize(position - eye.xyz)), faded(position));
}

// Lights weigh as they are bright at the focus, each channel by itself: fully lit is white.
vec3 plain_visibility(vec3 position, vec3 normal) {
  vec3 sum = vec3(0.0);
  vec3 all = vec3(0.0);
  for (int i = 0; i < light_count.x; ++i) {
    vec3 weight = viewer_lights[i].colour.rgb * irradiance_around(i, focus.xyz);
    sum += weight * visibility(i, position, normal);
    all += weight;
  }
  return sum / max(all, vec3(1e-30));
}

#if SURFACE_MODE == 3
vec3 error_colour(vec3 position, vec3 normal) {
  float shade = 0.35 + 0.65 * abs(dot(normal, normalize(position - eye.xyz)));
  float value = texelFetch(error, ivec2(gl_FragCoord.xy), 0).r;
  if (value < 0.0) return vec3(0.16, 0.17, 0.19) * shade;
  float share = value / error_top;
  vec3 hot = texture(heat, vec2(clamp(share, 0.0, 1.0), 0.5)).rgb;
  return hot + 0.16 * shade * max(0.0, 1.0 - share);
}
#endif

vec3 display_colour(vec3 position, vec3 normal, vec3 base_colour) {
#if SURFACE_MODE == 1
  return plain_visibility(position, normal);
#elif SURFACE_MODE == 3
  return error_colour(position, normal);
#else
  return dim * display_values(film_curve(shaded(position, normal, base_colour)));
#endif
}
