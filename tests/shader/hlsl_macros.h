// SPDX-License-Identifier: Apache-2.0
// What pdsm.glsl needs to be HLSL.
#define vec3 float3
#define vec4 float4
#define uvec4 uint4
#define PDSM_INPUTS
#define PDSM_FETCH(texture_, x_, y_) texture_.Load(int3(x_, y_, 0))
#define PDSM_DECLARE_INPUTS                   \
  cbuffer PdsmTables : register(b0) {         \
    PdsmMap pdsm_maps[64];                    \
    PdsmView pdsm_views[96];                  \
  };                                          \
  Texture2D<uint4> pdsm_index : register(t0); \
  Texture2D<uint4> pdsm_vertices : register(t1);
