// SPDX-License-Identifier: MIT
//
// What Godot calls when it loads the extension.

#include "classes.h"

static void initialize(void *user, gd_level level)
{
    (void)user;
    if (level == GD_LEVEL_SCENE) {
        gd_class_register(&gd_navmesh_class);
        gd_class_register(&gd_soup_class);
    }
}

static void deinitialize(void *user, gd_level level)
{
    (void)user;
    if (level == GD_LEVEL_SCENE) {
        gd_class_unregister(&gd_soup_class);
        gd_class_unregister(&gd_navmesh_class);
    }
}

#if defined(_WIN32)
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

EXPORTED gd_bool talus_godot_init(gd_get_proc_address *get, void *library, gd_initialization *initialization);

EXPORTED gd_bool talus_godot_init(gd_get_proc_address *get, void *library, gd_initialization *initialization)
{
    if (!gd_engine_find(get, library)) {
        return 0;
    }
    *initialization =
        (gd_initialization){ .minimum_level = GD_LEVEL_SCENE, .initialize = initialize, .deinitialize = deinitialize };
    return 1;
}
