// SPDX-License-Identifier: Apache-2.0
// What all programs know of the frame, and the look of bake/evaluate/studio.h and colour.h. Positions are in metres
// from the origin that the maps were uploaded with.
layout(std140) uniform ViewerFrame {
  mat4 world_to_clip;
  mat4 clip_to_world;
  vec4 eye;
  vec4 focus;     // centre, radius
  vec4 viewport;  // width, height (pixels), metres of a pixel at 1 m, 1 when footprints choose levels
  vec4 sky;
  vec4 bounce;
  vec4 horizon;
  vec4 zenith;  // w: direction.y at which the background is all zenith
  vec4 fade;    // begin, end (radii of the focus), seconds
};

vec3 film_curve(vec3 light) {
  const float contrast = 1.22;
  float middle = pow(0.86, contrast);
  float top = pow(5.0, contrast);
  vec3 x = pow(max(light, vec3(0.0)), vec3(contrast));
  return min(vec3(1.0), x / (x + middle) * ((top + middle) / top));
}

vec3 display_values(vec3 light) {
  vec3 x = clamp(light, 0.0, 1.0);
  return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

vec3 background(vec3 direction) {
  return mix(horizon.rgb, zenith.rgb, smoothstep(0.0, zenith.w, direction.y));
}

float faded(vec3 position) {
  return smoothstep(fade.x, fade.y, distance(position, focus.xyz) / focus.w);
}

vec3 ambient(vec3 normal) {
  return mix(bounce.rgb, sky.rgb, 0.5 + 0.5 * normal.y);
}

// Direction from the eye through a place of clip space.
vec3 view_direction(vec2 on_screen) {
  vec4 far = clip_to_world * vec4(on_screen, 1.0, 1.0);
  return normalize(far.xyz / far.w - eye.xyz);
}
