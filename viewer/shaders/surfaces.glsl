// SPDX-License-Identifier: Apache-2.0
// The surfaces of a picture, pixel by pixel; see surface.frag.
uniform sampler2D surface_position;
uniform sampler2D surface_normal;
uniform sampler2D surface_colour;
