// SPDX-License-Identifier: Apache-2.0
// Shades each pixel of the surfaces, and what is behind them.
in vec2 on_screen;
out vec4 colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 position = texelFetch(surface_position, pixel, 0);
  vec3 normal = texelFetch(surface_normal, pixel, 0).xyz;
  vec3 base_colour = texelFetch(surface_colour, pixel, 0).rgb;
  if (position.w == 0.0) {
    colour = vec4(dim * display_values(film_curve(background(view_direction(on_screen)))), 1.0);
  } else {
    colour = vec4(display_colour(position.xyz, normal, base_colour), 1.0);
  }
}
