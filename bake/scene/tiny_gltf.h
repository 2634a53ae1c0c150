// SPDX-License-Identifier: Apache-2.0
#pragma once

// tinygltf under a namespace of our own, built from its header (tiny_gltf.cpp). libdraco, which comes with
// Assimp, exports another version of tinygltf's classes under their own names: linked as a library, which
// of the two runs would depend on the order of libraries, and the wrong one corrupts memory.
#define tinygltf pdsm_tinygltf
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
// Files are read through FileSource only.
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>
