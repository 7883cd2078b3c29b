// SPDX-License-Identifier: MIT
//
// A stand-in for Godot: as much of the engine as the extension talks to. It counts what it hands out, refuses what the
// engine would refuse, and keeps what was registered, to be called as a script would.

#ifndef TALUS_GODOT_FAKE_ENGINE_H
#define TALUS_GODOT_FAKE_ENGINE_H

#include "gdextension.h"

#include <stdbool.h>
#include <stddef.h>
#include <talus/vec.h>

/// A Variant: 24 bytes in the engine, too.
typedef struct fake_variant {
    gd_type type;
    uint32_t unused;
    union {
        gd_bool boolean;
        int64_t integer;
        double real;
        float vector[3];
        void *pointer;
        void *pointers[2];
    } as;
} fake_variant;

typedef struct fake_method {
    char name[32], arguments[2][32];
    void *user;
    gd_method_call_fn *call;
    gd_method_ptrcall_fn *ptrcall;
    gd_type result, argument_types[2];
    uint32_t argument_count;
} fake_method;

typedef struct fake_property {
    char name[32], getter[32], setter[32];
    gd_type type;
} fake_property;

typedef struct fake_class {
    char name[32], parent[32];
    gd_class_info info;
    fake_method methods[32];
    uint32_t method_count;
    fake_property properties[16];
    uint32_t property_count;
} fake_class;

typedef struct fake_object {
    char class_name[32];
    void *instance;
} fake_object;

typedef struct fake_engine {
    fake_class classes[4];
    uint32_t class_count;
    int64_t alive;          ///< strings, names, arrays and dictionaries that were made and not ended
    uint32_t errors;        ///< printed by the extension
    size_t vector_size;     ///< bytes: 12, or 24 in an engine of doubles
    const char *without;    ///< a function that this engine lacks, or NULL
    int64_t resize_refused; ///< arrays of so many elements find no memory; 0: none
} fake_engine;

extern fake_engine engine;

gd_get_proc_address fake_get_proc_address;

fake_class *fake_find_class(const char *name);
fake_method *fake_find_method(const fake_class *class, const char *name);

/// An array of points as a PackedVector3Array in a Variant.
fake_variant fake_array(const tl_vec3 *points, size_t count);
size_t fake_array_size(const fake_variant *array);
tl_vec3 fake_array_at(const fake_variant *array, size_t index);
/// The text of a String.
const char *fake_text(const fake_variant *string);
/// The entry of a Dictionary, or NULL.
const fake_variant *fake_entry(const fake_variant *dictionary, const char *key);
size_t fake_entry_count(const fake_variant *dictionary);
void fake_end(fake_variant *variant);

#endif
