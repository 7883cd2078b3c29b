// SPDX-License-Identifier: MIT
//
// The one place where cgltf is compiled.

#define CGLTF_IMPLEMENTATION
#include "io/mesh/gltf_parser.h"
