// SPDX-License-Identifier: MIT
//
// Line against triangle, each passage through a surface counted once.

#ifndef TALUS_SRC_SOUP_LINE_TRIANGLE_H
#define TALUS_SRC_SOUP_LINE_TRIANGLE_H

#include <talus/vec.h>

/// Whether the line crosses a triangle once it is moved aside by an infinitesimal step, so that it meets no edge. Only
/// triangles that the line touches can be crossed.
bool tl_moved_line_crosses(tl_vec3 origin, tl_vec3 direction, const tl_vec3 corners[3]);

#endif
