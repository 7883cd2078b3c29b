// SPDX-License-Identifier: MIT
//
// A world larger than memory, as Python holds it. Points are doubles of the level's own coordinates, in and out.
// world.py sees to it that one thread at a time is in these functions, but for load_run, which may run beside them all.

#ifndef TALUS_PYTHON_WORLD_H
#define TALUS_PYTHON_WORLD_H

#include "binding.h"

#define BINDING_WORLD "talus.world"

typedef struct binding_load binding_load;

typedef struct binding_world {
    tl_nav_world *world;
    tl_nav_query *query;   ///< NULL until it is needed
    tl_nav_router *router; ///< the same
    binding_load *loads;   ///< that the world has not taken back
    PyObject *file;        ///< Python's, which holds the descriptor open
    int descriptor;
    PyThread_type_lock seeking; ///< Windows alone: a descriptor has one place
} binding_world;

binding_world *binding_world_of(PyObject *capsule);

extern PyMethodDef binding_world_methods[];
extern PyMethodDef binding_world_query_methods[];

#endif
