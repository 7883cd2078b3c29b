// SPDX-License-Identifier: MIT
//
// What is used of Godot's C interface for extensions, as gdextension_interface.h of 4.2 publishes it and all later
// versions keep it: types, and the functions that the engine hands out by name. test/published_header.c holds the
// structs against the engine's own header.

#ifndef TALUS_GODOT_GDEXTENSION_H
#define TALUS_GODOT_GDEXTENSION_H

#include <stdint.h>

typedef enum gd_type {
    GD_NIL = 0,
    GD_BOOL = 1,
    GD_INT = 2,
    GD_FLOAT = 3,
    GD_STRING = 4,
    GD_VECTOR3 = 9,
    GD_STRING_NAME = 21,
    GD_DICTIONARY = 27,
    GD_PACKED_VECTOR3_ARRAY = 36
} gd_type;

typedef uint8_t gd_bool;
typedef void gd_function(void); ///< what gd_get_proc_address gives, to be cast to the function's own type
typedef gd_function *gd_get_proc_address(const char *name);

typedef enum gd_call_error_kind {
    GD_CALL_OK,
    GD_CALL_INVALID_METHOD,
    GD_CALL_INVALID_ARGUMENT,
    GD_CALL_TOO_MANY_ARGUMENTS,
    GD_CALL_TOO_FEW_ARGUMENTS
} gd_call_error_kind;

typedef struct gd_call_error {
    gd_call_error_kind error;
    int32_t argument; ///< which
    int32_t expected; ///< a gd_type, or a number of arguments
} gd_call_error;

typedef enum gd_level { GD_LEVEL_CORE, GD_LEVEL_SERVERS, GD_LEVEL_SCENE, GD_LEVEL_EDITOR } gd_level;

/// What the entry function fills in.
typedef struct gd_initialization {
    gd_level minimum_level;
    void *user;
    void (*initialize)(void *user, gd_level level);
    void (*deinitialize)(void *user, gd_level level);
} gd_initialization;

typedef struct gd_property_info {
    gd_type type;
    void *name;       ///< StringName
    void *class_name; ///< StringName
    uint32_t hint;
    void *hint_string; ///< String
    uint32_t usage;
} gd_property_info;

#define GD_PROPERTY_USAGE_DEFAULT 6u ///< stored with the scene, shown in the editor
#define GD_METHOD_NORMAL          1u

typedef void *gd_create_instance_fn(void *class_user);
typedef void gd_free_instance_fn(void *class_user, void *instance);

/// GDExtensionClassCreationInfo2. Functions that are not used are void pointers.
typedef struct gd_class_info {
    gd_bool is_virtual, is_abstract, is_exposed;
    void *set, *get, *get_property_list, *free_property_list, *property_can_revert, *property_get_revert;
    void *validate_property, *notification, *to_string, *reference, *unreference;
    gd_create_instance_fn *create_instance;
    gd_free_instance_fn *free_instance;
    void *recreate_instance, *get_virtual, *get_virtual_call_data, *call_virtual_with_data, *get_rid;
    void *class_user;
} gd_class_info;

/// A call with Variants.
typedef void gd_method_call_fn(void *method_user, void *instance, const void *const *arguments, int64_t count,
                               void *result, gd_call_error *error);
/// A call with values of the types that the method was registered with.
typedef void gd_method_ptrcall_fn(void *method_user, void *instance, const void *const *arguments, void *result);

typedef struct gd_method_info {
    void *name; ///< StringName
    void *method_user;
    gd_method_call_fn *call;
    gd_method_ptrcall_fn *ptrcall;
    uint32_t flags;
    gd_bool has_result;
    gd_property_info *result;
    int result_metadata;
    uint32_t argument_count;
    gd_property_info *arguments;
    int *argument_metadata;
    uint32_t default_count;
    void **defaults;
} gd_method_info;

typedef void gd_constructor(void *base, const void *const *arguments);
typedef void gd_destructor(void *base);
typedef void gd_builtin_method(void *base, const void *const *arguments, void *result, int count);
typedef void gd_variant_from_type(void *variant, void *value);
typedef void gd_type_from_variant(void *value, void *variant);

typedef void gd_print_error_fn(const char *description, const char *function, const char *file, int32_t line,
                               gd_bool in_editor);
typedef gd_type gd_variant_get_type_fn(const void *variant);
typedef void gd_variant_destroy_fn(void *variant);
typedef gd_variant_from_type *gd_get_variant_from_type_constructor_fn(gd_type type);
typedef gd_type_from_variant *gd_get_variant_to_type_constructor_fn(gd_type type);
typedef gd_builtin_method *gd_variant_get_ptr_builtin_method_fn(gd_type type, const void *name, int64_t hash);
typedef gd_constructor *gd_variant_get_ptr_constructor_fn(gd_type type, int32_t which);
typedef gd_destructor *gd_variant_get_ptr_destructor_fn(gd_type type);
typedef void gd_string_new_with_utf8_chars_fn(void *string, const char *text);
typedef void gd_string_name_new_with_latin1_chars_fn(void *name, const char *text, gd_bool is_static);
typedef void *gd_packed_vector3_array_operator_index_fn(void *array, int64_t index);
typedef void *gd_packed_vector3_array_operator_index_const_fn(const void *array, int64_t index);
typedef void *gd_dictionary_operator_index_fn(void *dictionary, const void *key);
typedef void gd_object_set_instance_fn(void *object, const void *class_name, void *instance);
typedef void *gd_classdb_construct_object_fn(const void *class_name);
typedef void gd_classdb_register_extension_class2_fn(void *library, const void *name, const void *parent,
                                                     const gd_class_info *info);
typedef void gd_classdb_register_extension_class_method_fn(void *library, const void *class_name,
                                                           const gd_method_info *info);
typedef void gd_classdb_register_extension_class_property_fn(void *library, const void *class_name,
                                                             const gd_property_info *info, const void *setter,
                                                             const void *getter);
typedef void gd_classdb_unregister_extension_class_fn(void *library, const void *name);

#endif
