// SPDX-License-Identifier: Apache-2.0
// Single scattering in a slab of fog, a ray a pixel of a small picture: premultiplied display colour, opacity.
uniform vec3 fog_low;
uniform vec3 fog_high;
uniform float density;  // of extinction at the floor, 1 / metre
uniform int shrink;     // pixels of the picture a pixel of this one, along each axis
in vec2 on_screen;
out vec4 colour;

const int kSteps = 16;

// Distance along the ray at which it enters and leaves the slab.
vec2 crossing(vec3 direction) {
  vec3 a = (fog_low - eye.xyz) / direction;
  vec3 b = (fog_high - eye.xyz) / direction;
  vec3 enter = min(a, b);
  vec3 leave = max(a, b);
  return vec2(max(max(max(enter.x, enter.y), enter.z), 0.0), min(min(leave.x, leave.y), leave.z));
}

vec3 scattered(vec3 position) {
  vec3 arriving = 0.05 * sky.rgb;
  for (int i = 0; i < light_count.x; ++i) {
    arriving +=
        0.42 * viewer_lights[i].colour.rgb * irradiance_around(i, position) * map_visibility_rgb(i, position, vec3(0.0));
  }
  return arriving;
}

// Thin towards the top and the sides, so that no edge of the slab shows.
float thickness(vec3 position) {
  vec3 in_box = (position - fog_low) / (fog_high - fog_low);
  float aside = smoothstep(0.5, 0.28, length(in_box.xz - 0.5));
  float up = clamp(1.0 - in_box.y, 0.0, 1.0);
  return density * aside * up * up * (3.0 - 2.0 * up);
}

void main() {
  vec3 direction = view_direction(on_screen);
  vec4 ahead = world_to_clip * vec4(eye.xyz + direction, 1.0);
  vec2 ends = crossing(direction);
  ends.y = min(ends.y, view_depth(ivec2(gl_FragCoord.xy) * shrink + shrink / 2) / ahead.w);
  float stride = max(ends.y - ends.x, 0.0) / float(kSteps);

  // Neighbours start at other offsets: what would be bands is fine grain, which the composition averages.
  float offset = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 light = vec3(0.0);
  float through = 1.0;
  for (int i = 0; i < kSteps; ++i) {
    vec3 position = eye.xyz + direction * (ends.x + stride * (float(i) + offset));
    float passed = exp(-thickness(position) * stride);
    light += through * (1.0 - passed) * scattered(position);
    through *= passed;
  }
  float opacity = 1.0 - through;
  colour = vec4(display_values(film_curve(light / max(opacity, 1e-4))) * opacity, opacity);
}
