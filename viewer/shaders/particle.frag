// SPDX-License-Identifier: Apache-2.0
uniform float size;
in vec2 on_point;
in vec3 point_colour;
in float view_distance;
out vec4 colour;

void main() {
  float room = view_depth(ivec2(gl_FragCoord.xy)) - view_distance;
  float soft = clamp(room / size, 0.0, 1.0);
  float body = max(0.0, 1.0 - dot(on_point, on_point));
  float alpha = 0.55 * body * body * soft;
  vec3 shown = display_values(film_curve(point_colour));
  // Mostly added light, so that points in the dark hardly show.
  colour = vec4(shown * alpha, 0.1 * alpha);
}
