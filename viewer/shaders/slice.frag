// SPDX-License-Identifier: Apache-2.0
// Attenuation of one map on a plane, where its window is.
uniform int map;
uniform mat4 world_to_view;
uniform vec4 window;     // slopes, or metres when orthographic
uniform vec2 depths;     // near, far
uniform float slope;     // 1: the window is in slopes, 0: in metres
uniform float opacity;
uniform float contours;  // 1: draw lines at 1/4, 1/2, 3/4
uniform sampler2D heat;
in vec3 world_position;
out vec4 colour;

float contour(float value, float level) {
  float change = fwidth(value);
  // Where all of them crowd there is nothing to tell apart.
  return (1.0 - smoothstep(0.4, 1.4, abs(value - level) / max(change, 1e-5))) * smoothstep(0.2, 0.05, change);
}

void main() {
  vec3 p = (world_to_view * vec4(world_position, 1.0)).xyz;
  float reach = mix(1.0, p.z, slope);
  bool inside = p.z >= 0.0 && p.z <= depths.y * 1.0001 && all(greaterThanEqual(p.xy, window.xy * reach)) &&
                all(lessThanEqual(p.xy, window.zw * reach));
  float value = pdsm_attenuation(map, world_position);
  float line = contours * max(max(contour(value, 0.25), contour(value, 0.5)), contour(value, 0.75));
  if (!inside) discard;
  // Lit air stays clear, so that the shadows stand in the scene as bodies.
  float alpha = opacity * mix(0.16, 0.93, smoothstep(0.0, 0.2, value));
  vec3 hot = mix(texture(heat, vec2(clamp(value, 0.0, 1.0), 0.5)).rgb, vec3(1.0), 0.45 * line);
  colour = vec4(hot, alpha);
}
