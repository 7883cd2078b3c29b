// SPDX-License-Identifier: MIT
#include "fake_engine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fake_engine engine = { .vector_size = 12 };

// Strings and names are pointers to their text, arrays two words of which the second counts, dictionaries one pointer.
typedef struct array {
    size_t count;
    unsigned char *bytes;
} array;

typedef struct dictionary {
    size_t count;
    char keys[16][32];
    fake_variant values[16];
} dictionary;

static void fail(const char *what)
{
    fprintf(stderr, "the extension broke a rule of the engine: %s\n", what);
    exit(1);
}

static void *take(size_t size)
{
    void *block = calloc(1, size);
    if (block == NULL) {
        fail("out of memory");
    }
    engine.alive++;
    return block;
}

static void give(void *block)
{
    if (block != NULL) {
        engine.alive--;
        free(block);
    }
}

static char *text_copy(const char *text)
{
    char *copy = take(strlen(text) + 1);
    strcpy(copy, text);
    return copy;
}

static size_t storage_of(gd_type type)
{
    switch (type) {
    case GD_BOOL:
        return sizeof(gd_bool);
    case GD_INT:
        return sizeof(int64_t);
    case GD_FLOAT:
        return sizeof(double);
    case GD_VECTOR3:
        return 12;
    case GD_PACKED_VECTOR3_ARRAY:
        return 2 * sizeof(void *);
    case GD_STRING:
    case GD_STRING_NAME:
    case GD_DICTIONARY:
        return sizeof(void *);
    case GD_NIL:
        break;
    }
    fail("an unknown type");
    return 0;
}

static array *array_of(const void *base)
{
    array *found;
    memcpy(&found, (const char *)base + sizeof(void *), sizeof found);
    return found;
}

static void copy_value(void *to, const void *from, gd_type type)
{
    if (type == GD_STRING || type == GD_STRING_NAME) {
        char *copy = text_copy(*(char *const *)from);
        memcpy(to, &copy, sizeof copy);
    } else if (type == GD_PACKED_VECTOR3_ARRAY) {
        const array *old = array_of(from);
        array *copy = take(sizeof *copy);
        copy->count = old->count;
        copy->bytes = malloc(old->count * engine.vector_size + 1);
        if (old->count > 0) {
            memcpy(copy->bytes, old->bytes, old->count * engine.vector_size);
        }
        memset(to, 0, sizeof(void *));
        memcpy((char *)to + sizeof(void *), &copy, sizeof copy);
    } else if (type == GD_DICTIONARY) {
        const dictionary *old = *(dictionary *const *)from;
        dictionary *copy = take(sizeof *copy);
        *copy = *old;
        for (size_t i = 0; i < copy->count; i++) {
            copy_value(&copy->values[i].as, &old->values[i].as, old->values[i].type);
        }
        memcpy(to, &copy, sizeof copy);
    } else {
        memcpy(to, from, storage_of(type));
    }
}

static void end_value(void *at, gd_type type)
{
    if (type == GD_STRING || type == GD_STRING_NAME) {
        give(*(void **)at);
    } else if (type == GD_PACKED_VECTOR3_ARRAY) {
        array *old = array_of(at);
        free(old->bytes);
        give(old);
    } else if (type == GD_DICTIONARY) {
        dictionary *old = *(dictionary **)at;
        for (size_t i = 0; i < old->count; i++) {
            end_value(&old->values[i].as, old->values[i].type);
        }
        give(old);
    }
    memset(at, 0xdd, type == GD_NIL ? 0 : storage_of(type)); // whoever uses it again is found out
}

// ---------------------------------------------------------------------------------------------------------
// What the engine hands out.

static void print_error(const char *text, const char *function, const char *file, int32_t line, gd_bool in_editor)
{
    (void)function, (void)file, (void)line, (void)in_editor;
    if (strstr(text, "talus") == NULL) {
        fail("an error that does not say whose it is");
    }
    engine.errors++;
}

static gd_type variant_get_type(const void *variant)
{
    return ((const fake_variant *)variant)->type;
}

static void variant_destroy(void *variant)
{
    fake_variant *old = variant;
    if (old->type != GD_NIL) {
        end_value(&old->as, old->type);
        old->type = GD_NIL;
    }
}

#define FOR_EACH_TYPE(X)                                                                                               \
    X(GD_BOOL)                                                                                                         \
    X(GD_INT)                                                                                                          \
    X(GD_FLOAT)                                                                                                        \
    X(GD_STRING)                                                                                                       \
    X(GD_VECTOR3)                                                                                                      \
    X(GD_DICTIONARY)                                                                                                   \
    X(GD_PACKED_VECTOR3_ARRAY)

#define DEFINE(type_name)                                                                                              \
    static void from_##type_name(void *variant, void *value)                                                           \
    {                                                                                                                  \
        memset(variant, 0, sizeof(fake_variant));                                                                      \
        ((fake_variant *)variant)->type = type_name;                                                                   \
        copy_value(&((fake_variant *)variant)->as, value, type_name);                                                  \
    }                                                                                                                  \
    static void to_##type_name(void *value, void *variant)                                                             \
    {                                                                                                                  \
        if (((fake_variant *)variant)->type != type_name) {                                                            \
            fail("a Variant is read as what it is not");                                                               \
        }                                                                                                              \
        copy_value(value, &((fake_variant *)variant)->as, type_name);                                                  \
    }
FOR_EACH_TYPE(DEFINE)

static gd_variant_from_type *get_variant_from_type_constructor(gd_type type)
{
    switch (type) {
#define CASE(type_name)                                                                                                \
    case type_name:                                                                                                    \
        return from_##type_name;
        FOR_EACH_TYPE(CASE)
#undef CASE
    default:
        fail("no such type");
        return NULL;
    }
}

static gd_type_from_variant *get_variant_to_type_constructor(gd_type type)
{
    switch (type) {
#define CASE(type_name)                                                                                                \
    case type_name:                                                                                                    \
        return to_##type_name;
        FOR_EACH_TYPE(CASE)
#undef CASE
    default:
        fail("no such type");
        return NULL;
    }
}

static void array_size(void *base, const void *const *arguments, void *result, int count)
{
    (void)arguments;
    if (count != 0) {
        fail("size() takes nothing");
    }
    *(int64_t *)result = (int64_t)array_of(base)->count;
}

static void array_resize(void *base, const void *const *arguments, void *result, int count)
{
    if (count != 1) {
        fail("resize() takes a number");
    }
    array *resized = array_of(base);
    const int64_t size = *(const int64_t *)arguments[0];
    *(int64_t *)result = 0;
    if (size == engine.resize_refused) {
        *(int64_t *)result = 6; // ERR_OUT_OF_MEMORY
        return;
    }
    resized->bytes = realloc(resized->bytes, (size_t)size * engine.vector_size + 1);
    memset(resized->bytes, 0, (size_t)size * engine.vector_size);
    resized->count = (size_t)size;
}

static gd_builtin_method *variant_get_ptr_builtin_method(gd_type type, const void *name, int64_t hash)
{
    const char *text = *(char *const *)name;
    if (type == GD_PACKED_VECTOR3_ARRAY && strcmp(text, "size") == 0 && hash == 3173160232) {
        return array_size;
    }
    if (type == GD_PACKED_VECTOR3_ARRAY && strcmp(text, "resize") == 0 && hash == 848867239) {
        return array_resize;
    }
    return NULL;
}

static void construct_array(void *base, const void *const *arguments)
{
    (void)arguments;
    array *made = take(sizeof *made);
    memset(base, 0, sizeof(void *));
    memcpy((char *)base + sizeof(void *), &made, sizeof made);
}

static void construct_dictionary(void *base, const void *const *arguments)
{
    (void)arguments;
    *(dictionary **)base = take(sizeof(dictionary));
}

static gd_constructor *variant_get_ptr_constructor(gd_type type, int32_t which)
{
    if (which != 0 || (type != GD_PACKED_VECTOR3_ARRAY && type != GD_DICTIONARY)) {
        fail("no such constructor here");
    }
    return type == GD_DICTIONARY ? construct_dictionary : construct_array;
}

#define DEFINE_END(type_name)                                                                                          \
    static void end_##type_name(void *base)                                                                            \
    {                                                                                                                  \
        end_value(base, type_name);                                                                                    \
    }
DEFINE_END(GD_STRING)
DEFINE_END(GD_STRING_NAME)
DEFINE_END(GD_DICTIONARY)
DEFINE_END(GD_PACKED_VECTOR3_ARRAY)

static gd_destructor *variant_get_ptr_destructor(gd_type type)
{
    switch (type) {
    case GD_STRING:
        return end_GD_STRING;
    case GD_STRING_NAME:
        return end_GD_STRING_NAME;
    case GD_DICTIONARY:
        return end_GD_DICTIONARY;
    case GD_PACKED_VECTOR3_ARRAY:
        return end_GD_PACKED_VECTOR3_ARRAY;
    default:
        return NULL; // as in the engine: plain values have none
    }
}

static void string_new_with_utf8_chars(void *string, const char *text)
{
    *(char **)string = text_copy(text);
}

static void string_name_new_with_latin1_chars(void *name, const char *text, gd_bool is_static)
{
    (void)is_static;
    *(char **)name = text_copy(text);
}

static void *packed_vector3_array_operator_index(void *base, int64_t index)
{
    array *found = array_of(base);
    return index >= 0 && (size_t)index < found->count ? found->bytes + (size_t)index * engine.vector_size : NULL;
}

static void *packed_vector3_array_operator_index_const(const void *base, int64_t index)
{
    array *found = array_of(base);
    return index >= 0 && (size_t)index < found->count ? found->bytes + (size_t)index * engine.vector_size : NULL;
}

static void *dictionary_operator_index(void *base, const void *key)
{
    dictionary *found = *(dictionary **)base;
    const fake_variant *word = key;
    if (word->type != GD_STRING) {
        fail("keys are Strings here");
    }
    for (size_t i = 0; i < found->count; i++) {
        if (strcmp(found->keys[i], word->as.pointer) == 0) {
            return &found->values[i];
        }
    }
    snprintf(found->keys[found->count], sizeof found->keys[0], "%s", (char *)word->as.pointer);
    return &found->values[found->count++];
}

static void *classdb_construct_object(const void *class_name)
{
    fake_object *object = take(sizeof *object);
    snprintf(object->class_name, sizeof object->class_name, "%s", *(char *const *)class_name);
    return object;
}

static void object_set_instance(void *object, const void *class_name, void *instance)
{
    snprintf(((fake_object *)object)->class_name, sizeof((fake_object *)object)->class_name, "%s",
             *(char *const *)class_name);
    ((fake_object *)object)->instance = instance;
}

static void keep(char *to, const void *name)
{
    snprintf(to, 32, "%s", *(char *const *)name);
}

static void classdb_register_extension_class2(void *library, const void *name, const void *parent,
                                              const gd_class_info *info)
{
    if (library != &engine || info->create_instance == NULL || info->free_instance == NULL || !info->is_exposed) {
        fail("a class that nobody can make");
    }
    fake_class *class = &engine.classes[engine.class_count++];
    memset(class, 0, sizeof *class);
    keep(class->name, name);
    keep(class->parent, parent);
    class->info = *info;
}

static void classdb_register_extension_class_method(void *library, const void *class_name, const gd_method_info *info)
{
    (void)library;
    fake_class *class = fake_find_class(*(char *const *)class_name);
    if (class == NULL || info->call == NULL || info->ptrcall == NULL) {
        fail("a method of nothing");
        return;
    }
    fake_method *method = &class->methods[class->method_count++];
    keep(method->name, info->name);
    method->user = info->method_user;
    method->call = info->call;
    method->ptrcall = info->ptrcall;
    method->result = info->has_result ? info->result->type : GD_NIL;
    method->argument_count = info->argument_count;
    for (uint32_t i = 0; i < info->argument_count; i++) {
        keep(method->arguments[i], info->arguments[i].name);
        method->argument_types[i] = info->arguments[i].type;
    }
}

static void classdb_register_extension_class_property(void *library, const void *class_name,
                                                      const gd_property_info *info, const void *setter,
                                                      const void *getter)
{
    (void)library;
    fake_class *class = fake_find_class(*(char *const *)class_name);
    if (class == NULL || info->usage != GD_PROPERTY_USAGE_DEFAULT) {
        fail("a property of nothing");
        return;
    }
    fake_property *property = &class->properties[class->property_count++];
    keep(property->name, info->name);
    keep(property->setter, setter);
    keep(property->getter, getter);
    property->type = info->type;
}

static void classdb_unregister_extension_class(void *library, const void *name)
{
    (void)library;
    fake_class *class = fake_find_class(*(char *const *)name);
    if (class == NULL || class != &engine.classes[engine.class_count - 1]) {
        fail("classes are taken out in the order opposite to that of their registration");
    }
    engine.class_count--;
}

gd_function *fake_get_proc_address(const char *name)
{
    if (engine.without != NULL && strcmp(name, engine.without) == 0) {
        return NULL;
    }
    static const struct {
        const char *name;
        gd_function *function;
    } functions[] = {
#define ROW(name) { #name, (gd_function *)name }
        ROW(print_error),
        ROW(variant_get_type),
        ROW(variant_destroy),
        ROW(get_variant_from_type_constructor),
        ROW(get_variant_to_type_constructor),
        ROW(variant_get_ptr_builtin_method),
        ROW(variant_get_ptr_constructor),
        ROW(variant_get_ptr_destructor),
        ROW(string_new_with_utf8_chars),
        ROW(string_name_new_with_latin1_chars),
        ROW(packed_vector3_array_operator_index),
        ROW(packed_vector3_array_operator_index_const),
        ROW(dictionary_operator_index),
        ROW(object_set_instance),
        ROW(classdb_construct_object),
        ROW(classdb_register_extension_class2),
        ROW(classdb_register_extension_class_method),
        ROW(classdb_register_extension_class_property),
        ROW(classdb_unregister_extension_class),
    };
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if (strcmp(functions[i].name, name) == 0) {
            return functions[i].function;
        }
    }
    return NULL;
}

// ---------------------------------------------------------------------------------------------------------
// What the test asks.

fake_class *fake_find_class(const char *name)
{
    for (uint32_t i = 0; i < engine.class_count; i++) {
        if (strcmp(engine.classes[i].name, name) == 0) {
            return &engine.classes[i];
        }
    }
    return NULL;
}

fake_method *fake_find_method(const fake_class *class, const char *name)
{
    for (uint32_t i = 0; i < class->method_count; i++) {
        if (strcmp(class->methods[i].name, name) == 0) {
            return (fake_method *)&class->methods[i];
        }
    }
    return NULL;
}

fake_variant fake_array(const tl_vec3 *points, size_t count)
{
    fake_variant variant = { .type = GD_PACKED_VECTOR3_ARRAY };
    construct_array(&variant.as, NULL);
    const int64_t size = (int64_t)count;
    const void *const arguments[] = { &size };
    int64_t result;
    array_resize(&variant.as, arguments, &result, 1);
    for (size_t i = 0; i < count; i++) {
        memcpy(array_of(&variant.as)->bytes + i * engine.vector_size, &points[i], sizeof points[i]);
    }
    return variant;
}

size_t fake_array_size(const fake_variant *variant)
{
    return array_of(&variant->as)->count;
}

tl_vec3 fake_array_at(const fake_variant *variant, size_t index)
{
    tl_vec3 point;
    memcpy(&point, array_of(&variant->as)->bytes + index * engine.vector_size, sizeof point);
    return point;
}

const char *fake_text(const fake_variant *string)
{
    return string->as.pointer;
}

const fake_variant *fake_entry(const fake_variant *variant, const char *key)
{
    const dictionary *found = variant->as.pointer;
    for (size_t i = 0; i < found->count; i++) {
        if (strcmp(found->keys[i], key) == 0) {
            return &found->values[i];
        }
    }
    return NULL;
}

size_t fake_entry_count(const fake_variant *variant)
{
    return ((const dictionary *)variant->as.pointer)->count;
}

void fake_end(fake_variant *variant)
{
    variant_destroy(variant);
}
