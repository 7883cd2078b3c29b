// SPDX-License-Identifier: MIT
//
// Runs of floors around which the ground is plain: all eight neighbours are there, and lie in memory as they do in a
// picture. Sweeps that look at neighbours are loops over arrays there, without links, and compilers vectorize them;
// in rooms and on open ground that is most floors.

#ifndef TALUS_SRC_NAV_BAKE_PLAIN_RUNS_H
#define TALUS_SRC_NAV_BAKE_PLAIN_RUNS_H

#include <talus/nav_bake.h>

/// The floors first .. first + count - 1, of one row. Of each floor i, i - stride and i + stride lie beside it on x,
/// i + before and i + after on z, and those four have their neighbours on the other axis likewise: i + before - stride
/// lies in direction 3 from i - stride and in direction 0 from i + before. The stride is how many floors the columns
/// have.
typedef struct tl_plain_run {
    uint32_t first, count;
    int32_t before, after;
    uint32_t stride;
} tl_plain_run;

typedef struct tl_plain_runs {
    tl_plain_run *runs; ///< [capacity] ascending
    uint32_t count;
    uint32_t capacity;
    const tl_allocator *allocator;
} tl_plain_runs;

/// Finds the runs among the floors [begin, end) of whole rows that are long enough to gain by. A compact heightfield
/// without steps has none.
tl_result tl_plain_runs_find(const tl_nav_compact *compact, uint32_t begin, uint32_t end, const tl_allocator *allocator,
                             tl_plain_runs *runs_out);
void tl_plain_runs_free(tl_plain_runs *runs);

#endif
