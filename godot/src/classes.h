// SPDX-License-Identifier: MIT
//
// Classes as tables: their methods and properties. Registered, called and ended by classes.c.

#ifndef TALUS_GODOT_CLASSES_H
#define TALUS_GODOT_CLASSES_H

#include "engine.h"

#include <stddef.h>

#define GD_MAX_ARGUMENTS 2

typedef struct gd_method gd_method;

/// A method's work: `arguments` point to values of its types; `result` has room for one, which it makes.
typedef void gd_method_fn(void *node, const gd_method *method, const void *const *arguments, void *result);

struct gd_method {
    const char *name;
    gd_method_fn *run;
    gd_type result; ///< GD_NIL: none
    uint32_t argument_count;
    gd_type arguments[GD_MAX_ARGUMENTS];
    const char *names[GD_MAX_ARGUMENTS];
    size_t offset; ///< of a property: where it lies in the node
};

/// A float of a node that scenes store and the editor shows.
typedef struct gd_property {
    const char *name, *getter, *setter;
} gd_property;

typedef struct gd_class {
    const char *name, *parent;
    size_t size; ///< of a node, bytes
    void (*begin)(void *node);
    void (*end)(void *node);
    const gd_method *methods;
    uint32_t method_count;
    const gd_property *properties;
    uint32_t property_count;
} gd_class;

void gd_class_register(const gd_class *class);
void gd_class_unregister(const gd_class *class);

/// The getter and the setter of a property.
gd_method_fn gd_get_float, gd_set_float;

#define GD_COUNT(array) ((uint32_t)(sizeof(array) / sizeof(array)[0]))

extern const gd_class gd_navmesh_class, gd_soup_class;

/// A level's triangles as the library takes them. Godot's fronts are clockwise, the library's counter-clockwise.
typedef struct gd_faces {
    tl_mesh_view view;
    uint32_t *indices; ///< freed by the caller
} gd_faces;

/// The faces of an array, three points each. NULL, or a sentence that says what is wrong.
const char *gd_faces_of(const void *array, gd_faces *faces);

/// Makes the String for a failure: where, what, and what to do.
void gd_failure_make(void *string, tl_result result, const tl_report *report);

#endif
