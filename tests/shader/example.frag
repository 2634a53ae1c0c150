// SPDX-License-Identifier: Apache-2.0
// More lights than four, each with a colour of its own.
uniform vec3 colours[12];
uniform int light_count;
in vec3 position;
in vec3 normal;
out vec4 colour;
void main() {
  float footprint = length(dFdx(position)) + length(dFdy(position));
  vec3 sum = vec3(pdsm_attenuation(0, position));
  for (int i = 0; i < light_count; ++i) {
    sum += colours[i] * pdsm_visibility(i, position, normal, footprint);
  }
  colour = vec4(sum, 1.0);
}
