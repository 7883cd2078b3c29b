// SPDX-License-Identifier: MIT
//
// Holds the declarations of gdextension.h against the engine's own header, where there is one: sizes, places, numbers.

#include "gdextension.h"

#include <stddef.h>
#include <stdio.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include GDEXTENSION_HEADER
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#define SAME(ours, theirs)                _Static_assert((ours) == (theirs), #ours " is not " #theirs)
#define PLACE(ours, field, theirs, other) SAME(offsetof(ours, field), offsetof(theirs, other))

SAME((int)GD_BOOL, (int)GDEXTENSION_VARIANT_TYPE_BOOL);
SAME((int)GD_INT, (int)GDEXTENSION_VARIANT_TYPE_INT);
SAME((int)GD_FLOAT, (int)GDEXTENSION_VARIANT_TYPE_FLOAT);
SAME((int)GD_STRING, (int)GDEXTENSION_VARIANT_TYPE_STRING);
SAME((int)GD_VECTOR3, (int)GDEXTENSION_VARIANT_TYPE_VECTOR3);
SAME((int)GD_STRING_NAME, (int)GDEXTENSION_VARIANT_TYPE_STRING_NAME);
SAME((int)GD_DICTIONARY, (int)GDEXTENSION_VARIANT_TYPE_DICTIONARY);
SAME((int)GD_PACKED_VECTOR3_ARRAY, (int)GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY);
SAME((int)GD_CALL_INVALID_ARGUMENT, (int)GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT);
SAME((int)GD_CALL_TOO_MANY_ARGUMENTS, (int)GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS);
SAME((int)GD_CALL_TOO_FEW_ARGUMENTS, (int)GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS);
SAME((int)GD_LEVEL_SCENE, (int)GDEXTENSION_INITIALIZATION_SCENE);
SAME((int)GD_METHOD_NORMAL, (int)GDEXTENSION_METHOD_FLAG_NORMAL);
SAME(sizeof(gd_call_error), sizeof(GDExtensionCallError));
PLACE(gd_call_error, expected, GDExtensionCallError, expected);
SAME(sizeof(gd_initialization), sizeof(GDExtensionInitialization));
PLACE(gd_initialization, initialize, GDExtensionInitialization, initialize);
PLACE(gd_initialization, deinitialize, GDExtensionInitialization, deinitialize);
SAME(sizeof(gd_property_info), sizeof(GDExtensionPropertyInfo));
PLACE(gd_property_info, class_name, GDExtensionPropertyInfo, class_name);
PLACE(gd_property_info, hint_string, GDExtensionPropertyInfo, hint_string);
PLACE(gd_property_info, usage, GDExtensionPropertyInfo, usage);
SAME(sizeof(gd_class_info), sizeof(GDExtensionClassCreationInfo2));
PLACE(gd_class_info, is_exposed, GDExtensionClassCreationInfo2, is_exposed);
PLACE(gd_class_info, notification, GDExtensionClassCreationInfo2, notification_func);
PLACE(gd_class_info, create_instance, GDExtensionClassCreationInfo2, create_instance_func);
PLACE(gd_class_info, free_instance, GDExtensionClassCreationInfo2, free_instance_func);
PLACE(gd_class_info, class_user, GDExtensionClassCreationInfo2, class_userdata);
SAME(sizeof(gd_method_info), sizeof(GDExtensionClassMethodInfo));
PLACE(gd_method_info, method_user, GDExtensionClassMethodInfo, method_userdata);
PLACE(gd_method_info, ptrcall, GDExtensionClassMethodInfo, ptrcall_func);
PLACE(gd_method_info, has_result, GDExtensionClassMethodInfo, has_return_value);
PLACE(gd_method_info, result, GDExtensionClassMethodInfo, return_value_info);
PLACE(gd_method_info, argument_count, GDExtensionClassMethodInfo, argument_count);
PLACE(gd_method_info, arguments, GDExtensionClassMethodInfo, arguments_info);
PLACE(gd_method_info, argument_metadata, GDExtensionClassMethodInfo, arguments_metadata);
PLACE(gd_method_info, defaults, GDExtensionClassMethodInfo, default_arguments);

// Signatures: each function of ours is assigned to theirs through arguments of the same number and order.
static void assign(void)
{
    gd_method_call_fn *call = NULL;
    gd_method_ptrcall_fn *ptrcall = NULL;
    GDExtensionClassMethodPtrCall their_ptrcall = ptrcall;
    gd_create_instance_fn *create = NULL;
    GDExtensionClassCreateInstance their_create = create;
    gd_free_instance_fn *release = NULL;
    GDExtensionClassFreeInstance their_release = release;
    gd_constructor *constructor = NULL;
    GDExtensionPtrConstructor their_constructor = constructor;
    gd_builtin_method *method = NULL;
    GDExtensionPtrBuiltInMethod their_method = method;
    gd_object_set_instance_fn *set = NULL;
    GDExtensionInterfaceObjectSetInstance their_set = set;
    gd_print_error_fn *print = NULL;
    GDExtensionInterfacePrintError their_print = print;
    gd_string_name_new_with_latin1_chars_fn *name = NULL;
    GDExtensionInterfaceStringNameNewWithLatin1Chars their_name = name;
    gd_packed_vector3_array_operator_index_fn *index = NULL;
    GDExtensionInterfacePackedVector3ArrayOperatorIndex their_index = index;
    gd_dictionary_operator_index_fn *entry = NULL;
    GDExtensionInterfaceDictionaryOperatorIndex their_entry = entry;
    (void)call, (void)their_ptrcall, (void)their_create, (void)their_release, (void)their_constructor,
        (void)their_method;
    (void)their_set, (void)their_print, (void)their_name, (void)their_index, (void)their_entry;
}

int main(void)
{
    assign();
    puts("gdextension.h is as the engine's header");
    return 0;
}
