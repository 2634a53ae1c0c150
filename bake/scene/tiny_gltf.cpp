// SPDX-License-Identifier: Apache-2.0
// The one place where tinygltf's own code is compiled.
#include <algorithm>
#include <cassert>
#include <fstream>
#include <sstream>

// The header has a second namespace of its own.
#define dlib pdsm_tinygltf_dlib
#define TINYGLTF_IMPLEMENTATION
#include "scene/tiny_gltf.h"
