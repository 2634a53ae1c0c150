// SPDX-License-Identifier: Apache-2.0
// How deep the picture is, with all that moves.
uniform sampler2D depth;

// Along the view, metres.
float view_depth(ivec2 pixel) {
  float stored = texelFetch(depth, clamp(pixel, ivec2(0), textureSize(depth, 0) - 1), 0).r;
  return 1.0 / (clip_to_world * vec4(0.0, 0.0, 2.0 * stored - 1.0, 1.0)).w;
}
