// SPDX-License-Identifier: MIT
//
// The engine's functions by name, and its values: strings, arrays and dictionaries are the engine's, and are made and
// ended by it.

#ifndef TALUS_GODOT_ENGINE_H
#define TALUS_GODOT_ENGINE_H

#include "gdextension.h"

#include <stdbool.h>
#include <talus/talus.h>

// Each has the type gd_NAME_fn.
#define GD_FUNCTIONS(X)                                                                                                \
    X(print_error)                                                                                                     \
    X(variant_get_type)                                                                                                \
    X(variant_destroy)                                                                                                 \
    X(get_variant_from_type_constructor)                                                                               \
    X(get_variant_to_type_constructor)                                                                                 \
    X(variant_get_ptr_builtin_method)                                                                                  \
    X(variant_get_ptr_constructor)                                                                                     \
    X(variant_get_ptr_destructor)                                                                                      \
    X(string_new_with_utf8_chars)                                                                                      \
    X(string_name_new_with_latin1_chars)                                                                               \
    X(packed_vector3_array_operator_index)                                                                             \
    X(packed_vector3_array_operator_index_const)                                                                       \
    X(dictionary_operator_index)                                                                                       \
    X(object_set_instance)                                                                                             \
    X(classdb_construct_object)                                                                                        \
    X(classdb_register_extension_class2)                                                                               \
    X(classdb_register_extension_class_method)                                                                         \
    X(classdb_register_extension_class_property)                                                                       \
    X(classdb_unregister_extension_class)

typedef struct gd_engine {
#define GD_MEMBER(name) gd_##name##_fn *name;
    GD_FUNCTIONS(GD_MEMBER)
#undef GD_MEMBER
    void *library;
    gd_builtin_method *array_size, *array_resize;
} gd_engine;

extern gd_engine gd;

/// Room for any value of the engine, or a Variant, on any machine.
typedef union gd_value {
    uint64_t words[5];
    gd_bool boolean;
    int64_t integer;
    double real;
    tl_vec3 vector;
} gd_value;

/// Finds all functions. False: the engine is older than 4.2, or has vectors of doubles; it was told so.
bool gd_engine_find(gd_get_proc_address *get, void *library);

void gd_name_make(gd_value *name, const char *text);
void gd_make(gd_value *value, gd_type type);
/// Ends a value; those without memory of their own may be given too.
void gd_end(void *value, gd_type type);

void gd_string_make(void *string, const char *text);

int64_t gd_array_size(const void *array);
/// An array of points; false: there is no memory for it, and it is empty.
bool gd_array_make(void *array, const tl_vec3 *points, uint32_t count);
/// The points of an array, in one block; NULL when it is empty.
const tl_vec3 *gd_array_points(const void *array);

void gd_dictionary_set(void *dictionary, const char *key, gd_type type, gd_value *value);

#endif
