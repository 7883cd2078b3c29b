// SPDX-License-Identifier: MIT
//
// talus polygonize --compare: all methods side by side.

#ifndef TALUS_CLI_POLYGONIZE_COMPARE_H
#define TALUS_CLI_POLYGONIZE_COMPARE_H

#include "cli/shared/command.h"
#include "cli/shared/json_out.h"
#include "io/text/contour_text.h"

/// The names of the methods, by tl_partition_method; NULL ends them.
extern const char *const tl_partition_method_names[];

/// Divides one set by each method and prints a table, or appends an object to `sets` when that is not NULL. `proven`
/// asks for a check of each mesh; *is_right becomes false when one is faulty. def->method does not matter.
tl_exit tl_polygonize_compare(tl_cli *cli, const char *input, const tl_contour_text *text, const tl_polygon_def *def,
                              bool proven, json_t *sets, bool *is_right);

#endif
