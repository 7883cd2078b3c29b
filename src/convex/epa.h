// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_CONVEX_EPA_H
#define TALUS_SRC_CONVEX_EPA_H

#include "convex/gjk.h"

typedef struct tl_epa {
    tl_vec3d normal; // unit, of A - B: B moves along it to part
    double depth;    // of the cores
    double upper, lower;
    tl_vec3d on_a, on_b; // witnesses, A's frame
    tl_convex_status status;
    uint32_t iterations;
} tl_epa;

// The depth of two cores that overlap, from the simplex that GJK ended with.
void tl_epa_run(tl_pair *pair, const tl_gjk *gjk, tl_epa *epa);

#endif
