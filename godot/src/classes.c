// SPDX-License-Identifier: MIT
//
// A call comes with Variants (from a script without types, the editor, a scene that is loaded) or with the values
// themselves; the first kind is turned into the second.

#include "classes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void ptrcall(void *user, void *node, const void *const *arguments, void *result)
{
    const gd_method *method = user;
    if (method->result != GD_NIL) {
        gd_end(result, method->result); // the caller's is a whole value, which is replaced
    }
    method->run(node, method, arguments, result);
}

// Whether a Variant is of the type that is wanted; a whole number does where a float is.
static bool fits(gd_type found, gd_type wanted)
{
    return found == wanted || (found == GD_INT && wanted == GD_FLOAT);
}

static bool check_arguments(const gd_method *method, const void *const *arguments, int64_t count, gd_call_error *error)
{
    if (count != method->argument_count) {
        error->error = count > method->argument_count ? GD_CALL_TOO_MANY_ARGUMENTS : GD_CALL_TOO_FEW_ARGUMENTS;
        error->expected = (int32_t)method->argument_count;
        return false;
    }
    for (int32_t i = 0; i < (int32_t)count; i++) {
        if (!fits(gd.variant_get_type(arguments[i]), method->arguments[i])) {
            error->error = GD_CALL_INVALID_ARGUMENT;
            error->argument = i;
            error->expected = (int32_t)method->arguments[i];
            return false;
        }
    }
    return true;
}

static void value_of_variant(gd_value *value, gd_type wanted, const void *variant)
{
    void *from;
    memcpy(&from, &variant, sizeof from); // it is not changed, but the function's type does not say so
    if (gd.variant_get_type(variant) == wanted) {
        gd.get_variant_to_type_constructor(wanted)(value, from);
    } else {
        gd_value whole;
        gd.get_variant_to_type_constructor(GD_INT)(&whole, from);
        value->real = (double)whole.integer;
    }
}

static void call(void *user, void *node, const void *const *arguments, int64_t count, void *result,
                 gd_call_error *error)
{
    const gd_method *method = user;
    error->error = GD_CALL_OK;
    if (!check_arguments(method, arguments, count, error)) {
        return;
    }
    gd_value values[GD_MAX_ARGUMENTS], out;
    const void *pointers[GD_MAX_ARGUMENTS] = { NULL };
    for (uint32_t i = 0; i < method->argument_count; i++) {
        value_of_variant(&values[i], method->arguments[i], arguments[i]);
        pointers[i] = &values[i];
    }
    method->run(node, method, pointers, &out);
    for (uint32_t i = 0; i < method->argument_count; i++) {
        gd_end(&values[i], method->arguments[i]);
    }
    if (method->result != GD_NIL) {
        gd.get_variant_from_type_constructor(method->result)(result, &out);
        gd_end(&out, method->result);
    }
}

void gd_get_float(void *node, const gd_method *method, const void *const *arguments, void *result)
{
    (void)arguments;
    float value;
    memcpy(&value, (const char *)node + method->offset, sizeof value);
    *(double *)result = (double)value;
}

void gd_set_float(void *node, const gd_method *method, const void *const *arguments, void *result)
{
    (void)result;
    const float value = (float)*(const double *)arguments[0];
    memcpy((char *)node + method->offset, &value, sizeof value);
}

static void *create_instance(void *user)
{
    const gd_class *class = user;
    void *node = calloc(1, class->size);
    if (node == NULL) {
        return NULL;
    }
    class->begin(node);
    gd_value parent, name;
    gd_name_make(&parent, class->parent);
    gd_name_make(&name, class->name);
    void *object = gd.classdb_construct_object(&parent);
    gd.object_set_instance(object, &name, node);
    gd_end(&parent, GD_STRING_NAME);
    gd_end(&name, GD_STRING_NAME);
    return object;
}

static void free_instance(void *user, void *node)
{
    if (node != NULL) {
        ((const gd_class *)user)->end(node);
        free(node);
    }
}

// The engine copies what it is given, so one name serves both fields that are of no use here.
typedef struct info {
    gd_value name, none, text;
    gd_property_info raw;
} info;

static void info_make(info *made, gd_type type, const char *name)
{
    gd_name_make(&made->name, name);
    gd_name_make(&made->none, "");
    gd_string_make(&made->text, "");
    made->raw = (gd_property_info){ .type = type,
                                    .name = &made->name,
                                    .class_name = &made->none,
                                    .hint_string = &made->text,
                                    .usage = GD_PROPERTY_USAGE_DEFAULT };
}

static void info_end(info *made)
{
    gd_end(&made->name, GD_STRING_NAME);
    gd_end(&made->none, GD_STRING_NAME);
    gd_end(&made->text, GD_STRING);
}

static void register_method(const void *class_name, const gd_method *method)
{
    info result, arguments[GD_MAX_ARGUMENTS];
    gd_property_info raw[GD_MAX_ARGUMENTS];
    int metadata[GD_MAX_ARGUMENTS] = { 0 };
    gd_value name;
    gd_name_make(&name, method->name);
    info_make(&result, method->result, "");
    for (uint32_t i = 0; i < method->argument_count; i++) {
        info_make(&arguments[i], method->arguments[i], method->names[i]);
        raw[i] = arguments[i].raw;
    }
    gd_method_info told = { .name = &name,
                            .call = call,
                            .ptrcall = ptrcall,
                            .flags = GD_METHOD_NORMAL,
                            .has_result = method->result != GD_NIL,
                            .result = &result.raw,
                            .argument_count = method->argument_count,
                            .arguments = raw,
                            .argument_metadata = metadata };
    memcpy(&told.method_user, &method, sizeof method);
    gd.classdb_register_extension_class_method(gd.library, class_name, &told);
    for (uint32_t i = 0; i < method->argument_count; i++) {
        info_end(&arguments[i]);
    }
    info_end(&result);
    gd_end(&name, GD_STRING_NAME);
}

void gd_class_register(const gd_class *class)
{
    gd_value name, parent;
    gd_name_make(&name, class->name);
    gd_name_make(&parent, class->parent);
    gd_class_info told = { .is_exposed = 1, .create_instance = create_instance, .free_instance = free_instance };
    memcpy(&told.class_user, &class, sizeof class);
    gd.classdb_register_extension_class2(gd.library, &name, &parent, &told);
    for (uint32_t i = 0; i < class->method_count; i++) {
        register_method(&name, &class->methods[i]);
    }
    for (uint32_t i = 0; i < class->property_count; i++) {
        info property;
        gd_value getter, setter;
        info_make(&property, GD_FLOAT, class->properties[i].name);
        gd_name_make(&getter, class->properties[i].getter);
        gd_name_make(&setter, class->properties[i].setter);
        gd.classdb_register_extension_class_property(gd.library, &name, &property.raw, &setter, &getter);
        gd_end(&getter, GD_STRING_NAME);
        gd_end(&setter, GD_STRING_NAME);
        info_end(&property);
    }
    gd_end(&name, GD_STRING_NAME);
    gd_end(&parent, GD_STRING_NAME);
}

void gd_class_unregister(const gd_class *class)
{
    gd_value name;
    gd_name_make(&name, class->name);
    gd.classdb_unregister_extension_class(gd.library, &name);
    gd_end(&name, GD_STRING_NAME);
}

const char *gd_faces_of(const void *array, gd_faces *faces)
{
    memset(faces, 0, sizeof *faces);
    const int64_t count = gd_array_size(array);
    if (count % 3 != 0) {
        return "faces: three points each are needed, as Mesh.get_faces() gives them";
    }
    if (count > (int64_t)TL_MAX_MESH_VERTICES) {
        return "faces: too many for one level";
    }
    const uint32_t points = (uint32_t)count;
    faces->indices = malloc(points > 0 ? points * sizeof *faces->indices : 1);
    if (faces->indices == NULL) {
        return "out of memory";
    }
    for (uint32_t i = 0; i < points; i += 3) {
        faces->indices[i] = i;
        faces->indices[i + 1] = i + 2;
        faces->indices[i + 2] = i + 1;
    }
    faces->view = (tl_mesh_view){ .vertices = gd_array_points(array),
                                  .vertex_count = points,
                                  .indices = faces->indices,
                                  .triangle_count = points / 3 };
    return NULL;
}

void gd_failure_make(void *string, tl_result result, const tl_report *report)
{
    char text[512], element[96] = "";
    if (report->field != NULL) {
        snprintf(element, sizeof element, "%s: ", report->field);
    } else if (report->element != NULL && report->element_index != TL_NO_ELEMENT) {
        snprintf(element, sizeof element, "%s %llu: ", report->element, (unsigned long long)report->element_index);
    }
    snprintf(text, sizeof text, "%s%s%s%s", element, tl_result_text(result), report->advice != NULL ? "; " : "",
             report->advice != NULL ? report->advice : "");
    gd_string_make(string, text);
}
