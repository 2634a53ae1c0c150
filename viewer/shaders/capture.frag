// SPDX-License-Identifier: Apache-2.0
// What the map of one light says on the surfaces, for comparing with the truth.
uniform int light;
in vec2 on_screen;
out vec2 look_up;  // attenuation, -1 without a map; 1 when the light shines on the surface

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 position = texelFetch(surface_position, pixel, 0).xyz;
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  bool has_map = viewer_lights[light].colour.w >= 0.0;
  look_up.x = has_map ? 1.0 - map_visibility(light, position, normal) : -1.0;
  look_up.y = irradiance(light, position, normal) > 0.0 ? 1.0 : 0.0;
}
