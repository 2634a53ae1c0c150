// SPDX-License-Identifier: Apache-2.0
in vec3 position;
out float visibility;
void main() {
  visibility = pdsm_visibility(0, position, vec3(0.0));
  gl_Position = vec4(position, 1.0);
}
