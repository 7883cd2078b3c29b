// SPDX-License-Identifier: MIT
//
// From metres to voxels.

#include "nav_bake/input/lattice_map.h"

#include "base/exact_floats.h"

tl_lattice_map tl_lattice_map_make(const tl_nav_lattice *lattice, float cell_size, float cell_height)
{
    tl_lattice_map map = { (double)lattice->origin.x, (double)lattice->origin.y, (double)lattice->origin.z,
                           1.0 / (double)cell_size,   1.0 / (double)cell_height, (double)lattice->first_x,
                           (double)lattice->first_z };
    return map;
}
