// SPDX-License-Identifier: Apache-2.0
// Penumbra deep shadow maps in a shader: which fraction of an area light does a point see?
//
//   float pdsm_visibility(int map, vec3 position, vec3 normal)
//   vec3 pdsm_visibility_rgb(int map, vec3 position, vec3 normal)      where casters colour the light
//
// Include it after the #version line (330, 450 or 300 es; any stage). The C++ library pdsm::runtime packs the
// inputs (make_map_textures), pdsm::runtime_gl uploads and binds them (ShadowTextures).
//
// Define before it, if wanted:
//   PDSM_FIXED_DEPTH   the textures have the layout of the thesis, not the two-level one
//   PDSM_ONLY_FILTER   0 (nearest) or 1 (bilinear): the filter of all maps, whatever their settings say
//   PDSM_INPUTS        PDSM_DECLARE_INPUTS declares the inputs, in another binding model or language
//
// The text keeps to what C, GLSL and HLSL share. C++ compiles it too (runtime/src/shader_functions.h): the
// look-up on the CPU and the tests run the very lines that run here. HLSL takes it after the macros of
// tests/shader/hlsl_macros.h.
//
// How a function is stored: vertices d_0 < d_1 < ... in depth codes, each with two values.
//
//        end |        /|
//            |       / |     piece n: from depth(n), exclusive, to depth(n + 1), inclusive
//      begin |      o  o-----
//            +------+--+-----> depth code
//
// A vertex takes 1, 2 or 3 words (form):   1: depth 16 | begin 8 | end 8   (lowest bits first)
//                                          2: depth 32, begin 16 | end 16
//                                          3: depth 32, begin 32, end 32
#ifndef PDSM_GLSL
#define PDSM_GLSL

#ifndef PDSM_REAL
#define PDSM_REAL float
#endif
#ifdef GL_ES
precision highp float;
precision highp int;
#endif

// Flags of PdsmMap and PdsmView.
#define PDSM_BILINEAR 1u
#define PDSM_LAYERS_ADD 2u
#define PDSM_COLOUR 4u
#define PDSM_ORTHOGRAPHIC 1u
#define PDSM_DEPTH_32 2u

// Depth in code space: decoded(whole) < z <= decoded(whole + 1), fraction in (0, 1] of that step. Comparisons
// with vertices are then among integers, and a jump is hit exactly.
struct PdsmDepth {
  uint whole;
  PDSM_REAL fraction;
};

// The vertices of one function.
struct PdsmFunction {
  uint first;  // address of the first vertex
  uint count;  // vertices; 0: the function is 0
  uint form;   // words a vertex
};

// The two texels of an axis between whose centres a position lies, clamped to the image, and how far it is
// from the first to the second.
struct PdsmBetween {
  uint low;
  uint high;
  PDSM_REAL share;
};

// Where a point meets a view.
struct PdsmPlace {
  bool inside;  // within the window, in front of the light
  bool lit;     // at near or before, where every function is 0
  PDSM_REAL u;  // texels of level 0 from the window's corner
  PDSM_REAL v;
  PDSM_REAL texels_per_metre;  // at the point's depth
  PdsmDepth depth;
};

#ifndef __cplusplus

// ---- Inputs, and how they are fetched ------------------------------------------------------------------------

struct PdsmMap {
  uint first_view;
  uint view_count;
  uint flags;
  float normal_offset;  // texels
};

struct PdsmView {
  vec4 rows[3];  // world (x, y, z, 1) to texels from the window's corner, x and y, both times reach; to depth
  vec4 depth;    // near, depth codes per metre, largest code
  vec4 scale;    // value_max; texels per unit of the window
  uvec4 image;   // width, height, planes (see pdsm_look_up), levels
  uvec4 place;   // two-level: corner in pdsm_index, first word in pdsm_vertices, bits of a count
                 // fixed depth: corner in pdsm_vertices, slabs in a row
  uint flags;
  uint form;
  uint row_bits;  // log2 of pdsm_vertices' width
  uint slabs;     // fixed depth: slabs of vertices, one RGBA texel each
};

#ifdef PDSM_INPUTS
PDSM_DECLARE_INPUTS
#else
layout(std140) uniform PdsmTables {
  PdsmMap pdsm_maps[64];
  PdsmView pdsm_views[96];
};
uniform highp usampler2D pdsm_index;
uniform highp usampler2D pdsm_vertices;
#endif

#ifndef PDSM_FETCH
#define PDSM_FETCH(texture_, x_, y_) texelFetch(texture_, ivec2(x_, y_), 0)
#endif

uvec4 pdsm_index_texel(uint x, uint y) {
  return PDSM_FETCH(pdsm_index, int(x), int(y));
}

uvec4 pdsm_vertex_texel(uint x, uint y) {
  return PDSM_FETCH(pdsm_vertices, int(x), int(y));
}

#endif  // __cplusplus

// ---- From points to places --------------------------------------------------------------------------------

#ifndef PDSM_FUNCTIONS_ONLY  // the look-up on the CPU goes its own, more exact way from points to depths

// ---- What a program may be compiled for ----------------------------------------------------------------------
// Where all maps have something in common, a constant in its place leaves code out of the program (the library's
// shader_constants() writes these lines). Without them, the program takes every set.

uint pdsm_form(uint view) {
#ifdef PDSM_ONLY_FORM
  return PDSM_ONLY_FORM;
#else
  return pdsm_views[view].form;
#endif
}
uint pdsm_plane_count(uint view) {
#ifdef PDSM_ONE_PLANE
  return 1u;
#else
  return pdsm_views[view].image[2];
#endif
}
uint pdsm_channel_count(uint map) {
#ifdef PDSM_GREY
  return 1u;
#else
  return (pdsm_maps[map].flags & PDSM_COLOUR) != 0u ? 3u : 1u;
#endif
}
uint pdsm_level_count(uint view) {
#ifdef PDSM_ONE_LEVEL
  return 1u;
#else
  return pdsm_views[view].image[3];
#endif
}
uint pdsm_view_count(uint map) {
#ifdef PDSM_ONE_VIEW
  return 1u;
#else
  return pdsm_maps[map].view_count;
#endif
}
bool pdsm_is_orthographic(uint view) {
#ifdef PDSM_PERSPECTIVE
  return false;
#else
  return (pdsm_views[view].flags & PDSM_ORTHOGRAPHIC) != 0u;
#endif
}
bool pdsm_is_bilinear(uint map) {
#ifdef PDSM_ONLY_FILTER
  return PDSM_ONLY_FILTER != 0;
#else
  return (pdsm_maps[map].flags & PDSM_BILINEAR) != 0u;
#endif
}

// Row `row` of a view, applied to a world point.
PDSM_REAL pdsm_row(uint view, int row, PDSM_REAL x, PDSM_REAL y, PDSM_REAL z) {
  return pdsm_views[view].rows[row][0] * x + pdsm_views[view].rows[row][1] * y + pdsm_views[view].rows[row][2] * z +
         pdsm_views[view].rows[row][3];
}

// What a view's rectangle of unit distance grows by up to a depth: everything lateral is per reach.
PDSM_REAL pdsm_reach(uint view, PDSM_REAL depth) {
  return pdsm_is_orthographic(view) ? PDSM_REAL(1.0) : depth;
}

// Code space of a depth z > near; behind far the largest code and fraction 1.
PdsmDepth pdsm_encode_depth(uint view, PDSM_REAL z) {
  PdsmDepth depth;
  PDSM_REAL code = (z - pdsm_views[view].depth[0]) * pdsm_views[view].depth[1];
  if (code > pdsm_views[view].depth[2]) {
    depth.whole = (pdsm_views[view].flags & PDSM_DEPTH_32) != 0u ? 0xFFFFFFFFu : 0xFFFFu;
    depth.fraction = PDSM_REAL(1.0);
  } else {
    PDSM_REAL above = max(ceil(code), PDSM_REAL(1.0));
    depth.whole = uint(above) - 1u;
    depth.fraction = PDSM_REAL(1.0) - (above - code);
  }
  return depth;
}

// The place of a world point in a view.
PdsmPlace pdsm_place(uint view, PDSM_REAL x, PDSM_REAL y, PDSM_REAL z) {
  PDSM_REAL depth = pdsm_row(view, 2, x, y, z);
  PDSM_REAL reach = pdsm_reach(view, depth);
  PdsmPlace place;
  place.u = pdsm_row(view, 0, x, y, z) / reach;
  place.v = pdsm_row(view, 1, x, y, z) / reach;
  place.texels_per_metre = pdsm_views[view].scale[1] / reach;
  place.inside = reach > PDSM_REAL(0.0) && place.u >= PDSM_REAL(0.0) && place.v >= PDSM_REAL(0.0) &&
                 place.u <= PDSM_REAL(pdsm_views[view].image[0]) && place.v <= PDSM_REAL(pdsm_views[view].image[1]);
  place.lit = depth <= pdsm_views[view].depth[0];
  place.depth.whole = 0u;
  place.depth.fraction = PDSM_REAL(0.0);
  if (place.inside && !place.lit) place.depth = pdsm_encode_depth(view, depth);
  return place;
}

// The place of a world point that is moved along its normal by `offset` texels first.
PdsmPlace pdsm_place_receiver(uint view, PDSM_REAL x, PDSM_REAL y, PDSM_REAL z, PDSM_REAL normal_x,
                              PDSM_REAL normal_y, PDSM_REAL normal_z, PDSM_REAL offset) {
  PDSM_REAL metres = PDSM_REAL(0.0);
  if (offset > PDSM_REAL(0.0)) {
    PDSM_REAL reach = pdsm_reach(view, pdsm_row(view, 2, x, y, z));
    metres = offset * max(reach, PDSM_REAL(0.0)) / pdsm_views[view].scale[1];
  }
  return pdsm_place(view, x + metres * normal_x, y + metres * normal_y, z + metres * normal_z);
}

#endif  // PDSM_FUNCTIONS_ONLY

// ---- Filters: results are weighted, never depths ------------------------------------------------------------

// One axis: `position` in texels from the border, texel centres at n + 1/2.
PdsmBetween pdsm_between(PDSM_REAL position, uint size) {
  PdsmBetween between;
  PDSM_REAL last = PDSM_REAL(size - 1u);
  PDSM_REAL shifted = min(max(position - PDSM_REAL(0.5), PDSM_REAL(0.0)), last);
  between.low = uint(shifted);
  between.high = min(between.low + 1u, size - 1u);
  between.share = shifted - PDSM_REAL(between.low);
  return between;
}

// The texel of an axis that holds `position`; the far border belongs to the last one.
uint pdsm_holding(PDSM_REAL position, uint size) {
  return uint(min(max(position, PDSM_REAL(0.0)), PDSM_REAL(size - 1u)));
}

PDSM_REAL pdsm_mix(PDSM_REAL from, PDSM_REAL to, PDSM_REAL share) {
  return from + (to - from) * share;
}

// How bright red, green and blue are together (Rec. 709), exactly the same if they are.
PDSM_REAL pdsm_grey(PDSM_REAL red, PDSM_REAL green, PDSM_REAL blue) {
  return green + PDSM_REAL(0.2126) * (red - green) + PDSM_REAL(0.0722) * (blue - green);
}

// Mip level for a footprint in texels, 0 .. levels - 1. Bilinear look-ups in texels of width w weigh an area with a
// box of width w convolved with a tent of half width w: variance w^2/12 + w^2/6 along each axis. A pixel is a box of
// width k, variance k^2/12. They match for
//
//   w = k / sqrt(3)
PDSM_REAL pdsm_level(PDSM_REAL texels, uint levels) {
  PDSM_REAL width = texels * PDSM_REAL(0.57735026919);
  return min(log2(max(width, PDSM_REAL(1.0))), PDSM_REAL(levels - 1u));
}

// ---- One function of depth ---------------------------------------------------------------------------------

// The line of a piece at a depth, as a real-valued code.
PDSM_REAL pdsm_piece(uint depth, uint next_depth, uint begin, uint end, PdsmDepth z) {
  PDSM_REAL share = (PDSM_REAL(z.whole - depth) + z.fraction) / PDSM_REAL(next_depth - depth);
  return PDSM_REAL(begin) + (PDSM_REAL(end) - PDSM_REAL(begin)) * share;
}

#ifndef PDSM_FIXED_DEPTH

#ifndef PDSM_FUNCTIONS_ONLY

// Word `n` of the vertex texture.
uint pdsm_word(uint view, uint n) {
  uint bits = pdsm_views[view].row_bits;
  return pdsm_vertex_texel(n & ((1u << bits) - 1u), n >> bits)[0];
}

// The head of a vertex is the word that holds its depth.
uint pdsm_head(uint view, PdsmFunction f, uint n) {
  return pdsm_word(view, f.first + n * f.form);
}
uint pdsm_depth(PdsmFunction f, uint head) {
  return f.form == 1u ? head & 0xFFFFu : head;
}
uint pdsm_begin(uint view, PdsmFunction f, uint n, uint head) {
  if (f.form == 1u) return (head >> 16) & 0xFFu;
  uint word = pdsm_word(view, f.first + n * f.form + 1u);
  return f.form == 2u ? word & 0xFFFFu : word;
}
uint pdsm_end(uint view, PdsmFunction f, uint n, uint head) {
  if (f.form == 1u) return head >> 24;
  uint word = pdsm_word(view, f.first + n * f.form + f.form - 1u);
  return f.form == 2u ? word >> 16 : word;
}

// The function of a texel of an image whose corner is (corner_x, corner_y) in the index texture.
PdsmFunction pdsm_function(uint view, uint corner_x, uint corner_y, uint x, uint y) {
  uvec4 entry = pdsm_index_texel(corner_x + x, corner_y + y);
  uint count_bits = pdsm_views[view].place[3];
  PdsmFunction f;
  f.form = pdsm_form(view);
  // Packed in one word, or the count in the second and count_bits = 0.
  f.count = (entry[0] & ((1u << count_bits) - 1u)) | entry[1];
  f.first = pdsm_views[view].place[2] + (entry[0] >> count_bits) * f.form;
  return f;
}

#endif  // PDSM_FUNCTIONS_ONLY

// A function's value at a depth, as a real-valued code: binary search.
PDSM_REAL pdsm_evaluate(uint view, PdsmFunction f, PdsmDepth z) {
  if (f.count == 0u) return PDSM_REAL(0.0);
  uint head = pdsm_head(view, f, 0u);
  uint depth = pdsm_depth(f, head);
  if (depth > z.whole) return PDSM_REAL(0.0);

  // The piece that holds z is the last one that begins before it: vertex `piece` is at `depth` <= z.whole, and
  // vertex piece + count, if there is one, at next_depth > z.whole.
  uint piece = 0u;
  uint next_depth = 0u;
  uint count = f.count;
  while (count > 1u) {
    uint half_count = count / 2u;
    uint middle = pdsm_head(view, f, piece + half_count);
    uint middle_depth = pdsm_depth(f, middle);
    if (middle_depth <= z.whole) {
      piece += half_count;
      count -= half_count;
      head = middle;
      depth = middle_depth;
    } else {
      count = half_count;
      next_depth = middle_depth;
    }
  }
  uint begin = pdsm_begin(view, f, piece, head);
  if (piece + 1u == f.count) return PDSM_REAL(begin);
  return pdsm_piece(depth, next_depth, begin, pdsm_end(view, f, piece, head), z);
}

#endif  // PDSM_FIXED_DEPTH

#ifndef PDSM_FUNCTIONS_ONLY

// Corner of level `level` beside level 0, relative to it: level 1 to the right of level 0, the others below it,
// one upon the other.
uint pdsm_level_x(uint view, uint level) {
  return level == 0u ? 0u : pdsm_views[view].image[0];
}
uint pdsm_level_y(uint view, uint level) {
  uint height = pdsm_views[view].image[1];
  return level == 0u ? 0u : height - (height >> (level - 1u));
}

#ifndef PDSM_FIXED_DEPTH

// The function of texel (x, y) of an image at z; see pdsm_function.
PDSM_REAL pdsm_texel(uint view, uint corner_x, uint corner_y, uint x, uint y, PdsmDepth z) {
  return pdsm_evaluate(view, pdsm_function(view, corner_x, corner_y, x, y), z);
}

#else

// Vertex `lane` of a slab's texel.
uint pdsm_slab_depth(uint form, uvec4 slab, uint lane) {
  return form == 1u ? slab[lane] & 0xFFFFu : slab[lane * form];
}
uint pdsm_slab_begin(uint form, uvec4 slab, uint lane) {
  if (form == 1u) return (slab[lane] >> 16) & 0xFFu;
  return form == 2u ? slab[lane * 2u + 1u] & 0xFFFFu : slab[1];
}
uint pdsm_slab_end(uint form, uvec4 slab, uint lane) {
  if (form == 1u) return slab[lane] >> 24;
  return form == 2u ? slab[lane * 2u + 1u] >> 16 : slab[2];
}

// The function of a texel at z: all vertices in order, until one lies behind z. Unused ones repeat the last.
PDSM_REAL pdsm_texel(uint view, uint corner_x, uint corner_y, uint x, uint y, PdsmDepth z) {
  uint form = pdsm_form(view);
  uint lanes = form == 1u ? 4u : form == 2u ? 2u : 1u;
    uint slab_width = pdsm_views[view].image[0] + (pdsm_level_count(view) > 1u ? pdsm_views[view].image[0] >> 1 : 0u);
  uint slab_height = pdsm_views[view].image[1] * pdsm_views[view].image[2];
  uint across = pdsm_views[view].place[2];
  uint depth = 0u;
  uint begin = 0u;
  uint end = 0u;
  for (uint s = 0u; s < pdsm_views[view].slabs; ++s) {
    uvec4 slab = pdsm_vertex_texel(corner_x + (s % across) * slab_width + x, corner_y + (s / across) * slab_height + y);
    for (uint lane = 0u; lane < lanes; ++lane) {
      uint next_depth = pdsm_slab_depth(form, slab, lane);
      if (next_depth > z.whole) {
        if (s + lane == 0u) return PDSM_REAL(0.0);
        return pdsm_piece(depth, next_depth, begin, end, z);
      }
      depth = next_depth;
      begin = pdsm_slab_begin(form, slab, lane);
      end = pdsm_slab_end(form, slab, lane);
    }
  }
  return PDSM_REAL(begin);
}

#endif  // PDSM_FIXED_DEPTH

// ---- Levels, planes, views ------------------------------------------------------------------------------------

// One plane and level of a view, filtered.
PDSM_REAL pdsm_filter(uint view, uint plane, uint level, bool bilinear, PdsmPlace place) {
  uint width = max(pdsm_views[view].image[0] >> level, 1u);
  uint height = max(pdsm_views[view].image[1] >> level, 1u);
  uint corner_x = pdsm_views[view].place[0] + pdsm_level_x(view, level);
  uint corner_y = pdsm_views[view].place[1] + plane * pdsm_views[view].image[1] + pdsm_level_y(view, level);
  PDSM_REAL shrink = PDSM_REAL(1.0) / PDSM_REAL(1u << level);
  PDSM_REAL u = place.u * shrink;
  PDSM_REAL v = place.v * shrink;
  if (!bilinear) {
    return pdsm_texel(view, corner_x, corner_y, pdsm_holding(u, width), pdsm_holding(v, height), place.depth);
  }
  PdsmBetween x = pdsm_between(u, width);
  PdsmBetween y = pdsm_between(v, height);
  PDSM_REAL v00 = pdsm_texel(view, corner_x, corner_y, x.low, y.low, place.depth);
  PDSM_REAL v10 = pdsm_texel(view, corner_x, corner_y, x.high, y.low, place.depth);
  PDSM_REAL v01 = pdsm_texel(view, corner_x, corner_y, x.low, y.high, place.depth);
  PDSM_REAL v11 = pdsm_texel(view, corner_x, corner_y, x.high, y.high, place.depth);
  return pdsm_mix(pdsm_mix(v00, v10, x.share), pdsm_mix(v01, v11, x.share), y.share);
}

// Attenuation of one channel at a place within a view: levels blended, layers combined. Planes are the channels of
// layer 0, then those of layer 1, ...
PDSM_REAL pdsm_look_up(uint view, uint map, uint channel, PdsmPlace place, PDSM_REAL footprint) {
  if (place.lit) return PDSM_REAL(0.0);
  bool bilinear = pdsm_is_bilinear(map);
  bool add = (pdsm_maps[map].flags & PDSM_LAYERS_ADD) != 0u;
  PDSM_REAL level = pdsm_level(footprint * place.texels_per_metre, pdsm_level_count(view));
  uint fine = uint(level);
  PDSM_REAL share = level - PDSM_REAL(fine);
  PDSM_REAL total = PDSM_REAL(0.0);
  for (uint plane = channel; plane < pdsm_plane_count(view); plane += pdsm_channel_count(map)) {
    PDSM_REAL value = pdsm_filter(view, plane, fine, bilinear, place);
    if (share > PDSM_REAL(0.0)) {
      value = pdsm_mix(value, pdsm_filter(view, plane, fine + 1u, bilinear, place), share);
    }
    total = add ? min(total + value, pdsm_views[view].scale[0]) : max(total, value);
  }
  return total / pdsm_views[view].scale[0];  // a division, so that umbra is 1 to the last bit
}

// Fraction of a channel of the light of map `map` that is blocked at a point: the first view whose window holds it
// tells.
PDSM_REAL pdsm_channel_at(uint map, uint channel, PDSM_REAL x, PDSM_REAL y, PDSM_REAL z,
                          PDSM_REAL normal_x, PDSM_REAL normal_y, PDSM_REAL normal_z, PDSM_REAL footprint) {
  uint first = pdsm_maps[map].first_view;
  uint last = first + pdsm_view_count(map);
  for (uint view = first; view < last; ++view) {
    PdsmPlace place = pdsm_place_receiver(view, x, y, z, normal_x, normal_y, normal_z, pdsm_maps[map].normal_offset);
    if (place.inside) return pdsm_look_up(view, map, channel, place, footprint);
  }
  return PDSM_REAL(0.0);
}

// Fraction of the light that is blocked at a point; of three channels how bright they are together.
PDSM_REAL pdsm_attenuation_at(uint map, PDSM_REAL x, PDSM_REAL y, PDSM_REAL z, PDSM_REAL normal_x,
                              PDSM_REAL normal_y, PDSM_REAL normal_z, PDSM_REAL footprint) {
  PDSM_REAL red = pdsm_channel_at(map, 0u, x, y, z, normal_x, normal_y, normal_z, footprint);
  if (pdsm_channel_count(map) == 1u) return red;
  PDSM_REAL green = pdsm_channel_at(map, 1u, x, y, z, normal_x, normal_y, normal_z, footprint);
  return pdsm_grey(red, green, pdsm_channel_at(map, 2u, x, y, z, normal_x, normal_y, normal_z, footprint));
}

#endif  // PDSM_FUNCTIONS_ONLY

#ifndef __cplusplus

// ---- What to call ------------------------------------------------------------------------------------------------

// Fraction of the light of map `map` that is blocked at a world position: 0 lit .. 1 umbra; outside the map's
// window 0. `footprint`: metres between the positions of neighbouring pixels, for maps with mip levels; 0 asks the
// finest.
float pdsm_attenuation(int map, vec3 position, float footprint) {
  return pdsm_attenuation_at(uint(map), position.x, position.y, position.z, 0.0, 0.0, 0.0, footprint);
}
float pdsm_attenuation(int map, vec3 position) {
  return pdsm_attenuation(map, position, 0.0);
}

// Fraction of the light that arrives. The position is moved along the normal (unit length) by the map's
// normal_offset first; fog and particles pass vec3(0.0).
float pdsm_visibility(int map, vec3 position, vec3 normal, float footprint) {
  return 1.0 - pdsm_attenuation_at(uint(map), position.x, position.y, position.z, normal.x, normal.y, normal.z,
                                   footprint);
}
float pdsm_visibility(int map, vec3 position, vec3 normal) {
  return pdsm_visibility(map, position, normal, 0.0);
}

// The same for red, green and blue, which differ behind what colours the light.
vec3 pdsm_attenuation_rgb(int map, vec3 position, float footprint) {
  uint m = uint(map);
  float red = pdsm_channel_at(m, 0u, position.x, position.y, position.z, 0.0, 0.0, 0.0, footprint);
  if (pdsm_channel_count(m) == 1u) return vec3(red, red, red);
  return vec3(red, pdsm_channel_at(m, 1u, position.x, position.y, position.z, 0.0, 0.0, 0.0, footprint),
              pdsm_channel_at(m, 2u, position.x, position.y, position.z, 0.0, 0.0, 0.0, footprint));
}
vec3 pdsm_attenuation_rgb(int map, vec3 position) {
  return pdsm_attenuation_rgb(map, position, 0.0);
}
vec3 pdsm_visibility_rgb(int map, vec3 position, vec3 normal, float footprint) {
  uint m = uint(map);
  float red = 1.0 - pdsm_channel_at(m, 0u, position.x, position.y, position.z, normal.x, normal.y, normal.z, footprint);
  if (pdsm_channel_count(m) == 1u) return vec3(red, red, red);
  return vec3(
      red, 1.0 - pdsm_channel_at(m, 1u, position.x, position.y, position.z, normal.x, normal.y, normal.z, footprint),
      1.0 - pdsm_channel_at(m, 2u, position.x, position.y, position.z, normal.x, normal.y, normal.z, footprint));
}
vec3 pdsm_visibility_rgb(int map, vec3 position, vec3 normal) {
  return pdsm_visibility_rgb(map, position, normal, 0.0);
}

#endif  // __cplusplus
#endif  // PDSM_GLSL
