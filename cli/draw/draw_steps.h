// SPDX-License-Identifier: MIT
//
// One contour divided step by step, a panel a step, as "Convex Polygon Generation" (Critterai) explains it: potential
// partitions, the chosen one, the triangle that it cuts off; then shared edges, the chosen one, the merged polygon.

#ifndef TALUS_CLI_DRAW_STEPS_H
#define TALUS_CLI_DRAW_STEPS_H

#include "io/files/io_error.h"

#include <talus/polygon.h>

/// A contour that is worth a look: of up to 32 vertices the one with most, else the smallest of the others.
/// UINT32_MAX when the set has no contour with area.
uint32_t draw_steps_telling_contour(const tl_contour_set *set);

typedef struct draw_steps_options {
    tl_polygon_step_kind kind;   ///< cuts or merges
    uint32_t contour;            ///< in the set
    uint32_t max_verts_per_poly; ///< as in tl_polygon_def
    uint32_t panel_size;         ///< pixels
    const char *name;            ///< of the file, for the title
} draw_steps_options;

enum { DRAW_STEPS_SUMMARY = 192 };

/// Writes the picture; when there are more steps than panels, evenly chosen ones, each with its number. `summary_out`
/// says what is in it. Errors: TL_ERR_EMPTY (a contour without area), TL_ERR_MEMORY, TL_ERR_CANCELLED, TL_ERR_IO.
tl_result draw_steps_write(const tl_contour_set *set, const draw_steps_options *options, const char *path,
                           const tl_host *host, char summary_out[DRAW_STEPS_SUMMARY], tl_io_error *error_out);

#endif
