// SPDX-License-Identifier: Apache-2.0
float4 main(float3 position : POSITION, float3 normal : NORMAL) : SV_Target {
  return float4(pdsm_visibility(0, position, normal), 0.0, 0.0, 1.0);
}
