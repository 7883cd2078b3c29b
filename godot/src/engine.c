// SPDX-License-Identifier: MIT
//
// Godot gives its functions by name. Vectors are three floats, but in builds of the engine with doubles: these are
// refused, by the distance of two vectors in an array.

#include "engine.h"

#include <stddef.h>
#include <string.h>

gd_engine gd;

// Of PackedVector3Array.size() and resize(); they change only when the methods' signatures do.
#define GD_HASH_SIZE   3173160232
#define GD_HASH_RESIZE 848867239

static void complain(const char *text)
{
    if (gd.print_error != NULL) {
        gd.print_error(text, __func__, __FILE__, __LINE__, 1);
    }
}

static gd_builtin_method *array_method(const char *name, int64_t hash)
{
    gd_value word;
    gd_name_make(&word, name);
    gd_builtin_method *method = gd.variant_get_ptr_builtin_method(GD_PACKED_VECTOR3_ARRAY, &word, hash);
    gd_end(&word, GD_STRING_NAME);
    return method;
}

static bool has_floats(void)
{
    gd_value array;
    const tl_vec3 points[2] = { { 1, 2, 3 }, { 4, 5, 6 } };
    gd_make(&array, GD_PACKED_VECTOR3_ARRAY);
    const int64_t count = 2;
    const void *const arguments[] = { &count };
    int64_t result = 0;
    gd.array_resize(&array, arguments, &result, 1);
    const char *first = gd.packed_vector3_array_operator_index(&array, 0);
    const char *second = gd.packed_vector3_array_operator_index(&array, 1);
    const bool floats = first != NULL && second != NULL && second - first == (ptrdiff_t)sizeof points[0];
    gd_end(&array, GD_PACKED_VECTOR3_ARRAY);
    return floats;
}

bool gd_engine_find(gd_get_proc_address *get, void *library)
{
    memset(&gd, 0, sizeof gd);
    gd.library = library;
    bool found = true;
#define GD_FIND(name)                                                                                                  \
    gd.name = (gd_##name##_fn *)get(#name);                                                                            \
    found = found && gd.name != NULL;
    GD_FUNCTIONS(GD_FIND)
#undef GD_FIND
    if (found) {
        gd.array_size = array_method("size", GD_HASH_SIZE);
        gd.array_resize = array_method("resize", GD_HASH_RESIZE);
        found = gd.array_size != NULL && gd.array_resize != NULL;
    }
    if (!found) {
        complain("talus: this version of Godot lacks a function that the extension needs; use 4.2 or newer");
        return false;
    }
    if (!has_floats()) {
        complain(
            "talus: this build of Godot has vectors of doubles (precision=double), which the extension does not serve");
        return false;
    }
    return true;
}

void gd_name_make(gd_value *name, const char *text)
{
    gd.string_name_new_with_latin1_chars(name, text, 0);
}

void gd_make(gd_value *value, gd_type type)
{
    gd.variant_get_ptr_constructor(type, 0)(value, NULL);
}

void gd_end(void *value, gd_type type)
{
    if (type == GD_STRING || type == GD_STRING_NAME || type == GD_DICTIONARY || type == GD_PACKED_VECTOR3_ARRAY) {
        gd.variant_get_ptr_destructor(type)(value);
    }
}

void gd_string_make(void *string, const char *text)
{
    gd.string_new_with_utf8_chars(string, text);
}

int64_t gd_array_size(const void *array)
{
    int64_t size = 0;
    gd_value *base;
    memcpy(&base, &array, sizeof base); // the method does not change it, but its type does not say so
    gd.array_size(base, NULL, &size, 0);
    return size;
}

bool gd_array_make(void *array, const tl_vec3 *points, uint32_t count)
{
    gd_make(array, GD_PACKED_VECTOR3_ARRAY);
    if (count == 0) {
        return true;
    }
    const int64_t size = count;
    const void *const arguments[] = { &size };
    int64_t result = 0;
    gd.array_resize(array, arguments, &result, 1);
    if (gd_array_size(array) != size) {
        return false;
    }
    memcpy(gd.packed_vector3_array_operator_index(array, 0), points, count * sizeof *points);
    return true;
}

const tl_vec3 *gd_array_points(const void *array)
{
    return gd_array_size(array) > 0 ? gd.packed_vector3_array_operator_index_const(array, 0) : NULL;
}

void gd_dictionary_set(void *dictionary, const char *key, gd_type type, gd_value *value)
{
    gd_value string, variant;
    gd_string_make(&string, key);
    gd.get_variant_from_type_constructor(GD_STRING)(&variant, &string);
    gd_end(&string, GD_STRING);
    void *place = gd.dictionary_operator_index(dictionary, &variant);
    gd.variant_destroy(&variant);
    gd.variant_destroy(place);
    gd.get_variant_from_type_constructor(type)(place, value);
}
