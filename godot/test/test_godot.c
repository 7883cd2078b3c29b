// SPDX-License-Identifier: MIT
//
// Loads the extension as Godot does, and calls its nodes as scripts do: with Variants and with plain values. It ends
// with 1 at the first answer that is wrong, and when anything of the engine's was not given back.
//
//   test_godot LIBRARY

#include "fake_engine.h"

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned checks;

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        checks++;                                                                                                      \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                    \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

typedef gd_bool entry_fn(gd_get_proc_address *get, void *library, gd_initialization *initialization);

// A floor 20 m square, and a wall 3 m high with a passage around its end at z = 6; fronts are clockwise, as in Godot.
static const tl_vec3 corners[] = {
    { -10, 0, -10 }, { -10, 0, 10 }, { 10, 0, 10 },    { 10, 0, -10 }, { 0, 0, -10 },  { 0, 0, 6 },
    { 0, 3, 6 },     { 0, 3, -10 },  { 0.5f, 0, -10 }, { 0.5f, 0, 6 }, { 0.5f, 3, 6 }, { 0.5f, 3, -10 },
};
static const unsigned char triangles[][3] = { { 0, 2, 1 },  { 0, 3, 2 },  { 4, 6, 5 },  { 4, 7, 6 },  { 8, 10, 11 },
                                              { 8, 9, 10 }, { 5, 10, 9 }, { 5, 6, 10 }, { 7, 10, 6 }, { 7, 11, 10 } };
enum { POINTS = 3 * sizeof triangles / sizeof triangles[0] };

static fake_variant level(void)
{
    tl_vec3 faces[POINTS];
    for (size_t i = 0; i < POINTS; i++) {
        faces[i] = corners[triangles[i / 3][i % 3]];
    }
    return fake_array(faces, POINTS);
}

static fake_variant vector(float x, float y, float z)
{
    return (fake_variant){ .type = GD_VECTOR3, .as.vector = { x, y, z } };
}

static fake_variant number(double value)
{
    return (fake_variant){ .type = GD_FLOAT, .as.real = value };
}

// A node with its class.
typedef struct node {
    fake_class *class;
    fake_object *object;
} node;

static node make(const char *name)
{
    node made = { .class = fake_find_class(name) };
    CHECK(made.class != NULL);
    made.object = made.class->info.create_instance(made.class->info.class_user);
    CHECK(made.object != NULL && made.object->instance != NULL && strcmp(made.object->class_name, name) == 0);
    return made;
}

static void end(node *old)
{
    old->class->info.free_instance(old->class->info.class_user, old->object->instance);
    free(old->object);
    engine.alive--;
}

// A call with Variants; the caller ends the result.
static fake_variant call(const node *of, const char *name, const fake_variant *arguments, int64_t count,
                         gd_call_error *error)
{
    const fake_method *method = fake_find_method(of->class, name);
    CHECK(method != NULL);
    const void *pointers[4] = { NULL };
    for (int64_t i = 0; i < count; i++) {
        pointers[i] = &arguments[i];
    }
    fake_variant result = { 0 };
    method->call(method->user, of->object->instance, pointers, count, &result, error);
    CHECK(result.type == (error->error == GD_CALL_OK ? method->result : GD_NIL));
    return result;
}

static fake_variant ask(const node *of, const char *name, const fake_variant *arguments, int64_t count)
{
    gd_call_error error = { 0 };
    fake_variant result = call(of, name, arguments, count, &error);
    CHECK(error.error == GD_CALL_OK);
    return result;
}

static void check_text(const node *of, const char *name, const fake_variant *argument, int64_t count, const char *part)
{
    fake_variant text = ask(of, name, argument, count);
    if (part[0] == '\0' ? fake_text(&text)[0] != '\0' : strstr(fake_text(&text), part) == NULL) {
        fprintf(stderr, "%s() says '%s' instead of '%s'\n", name, fake_text(&text), part);
        exit(1);
    }
    checks++;
    fake_end(&text);
}

static void check_properties(void)
{
    node navmesh = make("TalusNavmesh3D");
    CHECK(navmesh.class->property_count == 6);
    for (uint32_t i = 0; i < navmesh.class->property_count; i++) {
        const fake_property *property = &navmesh.class->properties[i];
        CHECK(property->type == GD_FLOAT && fake_find_method(navmesh.class, property->setter) != NULL);
        fake_variant before = ask(&navmesh, property->getter, NULL, 0);
        CHECK(before.as.real > 0);
        fake_variant value = number(before.as.real * 0.5);
        fake_variant nothing = ask(&navmesh, property->setter, &value, 1);
        CHECK(nothing.type == GD_NIL);
        fake_variant after = ask(&navmesh, property->getter, NULL, 0);
        CHECK(after.as.real == before.as.real * 0.5);
        // Each has a place of its own: the others are as they were.
        for (uint32_t j = i + 1; j < navmesh.class->property_count; j++) {
            CHECK(ask(&navmesh, navmesh.class->properties[j].getter, NULL, 0).as.real > 0.15);
        }
        ask(&navmesh, property->setter, &(fake_variant){ .type = GD_INT, .as.integer = 3 },
            1); // a script's whole number
        CHECK(ask(&navmesh, property->getter, NULL, 0).as.real == 3);
        ask(&navmesh, property->setter, &before, 1);
    }
    end(&navmesh);
}

static void check_paths(void)
{
    node navmesh = make("TalusNavmesh3D");
    fake_variant faces = level(), radius = number(0.4);
    const fake_variant ends[2] = { vector(-5, 0, -5), vector(5, 0, -5) };
    fake_variant path = ask(&navmesh, "find_path", ends, 2);
    CHECK(fake_array_size(&path) == 0 && !ask(&navmesh, "is_baked", NULL, 0).as.boolean);
    fake_end(&path);
    check_text(&navmesh, "get_status", NULL, 0, "not baked");
    ask(&navmesh, "set_agent_radius", &radius, 1);
    check_text(&navmesh, "bake", &faces, 1, "");
    CHECK(ask(&navmesh, "is_baked", NULL, 0).as.boolean);

    path = ask(&navmesh, "find_path", ends, 2);
    CHECK(fake_array_size(&path) >= 4);
    float length = 0, farthest = 0;
    for (size_t i = 0; i < fake_array_size(&path); i++) {
        const tl_vec3 point = fake_array_at(&path, i);
        length += i > 0 ? tl_distance(point, fake_array_at(&path, i - 1)) : 0;
        farthest = tl_maxf(farthest, point.z);
    }
    CHECK(length > 24.4f && length < 27.0f && farthest > 6.3f); // around the wall's end
    check_text(&navmesh, "get_status", NULL, 0, "complete");

    // The same with plain values: the result is a whole value before, and is replaced.
    const fake_method *method = fake_find_method(navmesh.class, "find_path");
    const void *const arguments[] = { &ends[0].as, &ends[1].as };
    fake_variant again = fake_array(NULL, 0);
    method->ptrcall(method->user, navmesh.object->instance, arguments, &again.as);
    CHECK(fake_array_size(&again) == fake_array_size(&path));
    fake_end(&again);

    engine.resize_refused = (int64_t)fake_array_size(&path);
    fake_end(&path);
    path = ask(&navmesh, "find_path", ends, 2);
    CHECK(fake_array_size(&path) == 0);
    fake_end(&path);
    engine.resize_refused = 0;
    check_text(&navmesh, "get_status", NULL, 0, "out of memory");

    const fake_variant away[2] = { ends[0], vector(50, 0, 0) };
    path = ask(&navmesh, "find_path", away, 2);
    CHECK(fake_array_size(&path) == 0);
    fake_end(&path);
    check_text(&navmesh, "get_status", NULL, 0, "no floor near the goal");
    const fake_variant nan_ends[2] = { vector(NAN, 0, 0), ends[1] };
    path = ask(&navmesh, "find_path", nan_ends, 2);
    CHECK(fake_array_size(&path) == 0);
    fake_end(&path);
    check_text(&navmesh, "get_status", NULL, 0, "NaN");

    // What is wrong is named, and a bake that fails leaves no old navmesh behind.
    fake_variant cell = number(-1);
    ask(&navmesh, "set_cell_size", &cell, 1);
    check_text(&navmesh, "bake", &faces, 1, "cell_size: ");
    CHECK(!ask(&navmesh, "is_baked", NULL, 0).as.boolean);
    fake_variant odd = fake_array(corners, 4);
    check_text(&navmesh, "bake", &odd, 1, "three points");
    fake_end(&odd);
    fake_end(&faces);
    end(&navmesh);
}

static void check_rays(void)
{
    node soup = make("TalusSoup3D");
    fake_variant faces = level();
    const fake_variant through[2] = { vector(-5, 1, 0), vector(5, 1, 0) },
                       beside[2] = { vector(-5, 1, 8), vector(5, 1, 8) };
    fake_variant hit = ask(&soup, "cast_ray", through, 2);
    CHECK(fake_entry_count(&hit) == 0);
    fake_end(&hit);
    check_text(&soup, "bake", &faces, 1, "");
    hit = ask(&soup, "cast_ray", through, 2);
    CHECK(fake_entry_count(&hit) == 4);
    const float *position = fake_entry(&hit, "position")->as.vector, *normal = fake_entry(&hit, "normal")->as.vector;
    CHECK(position[0] == 0 && position[1] == 1 && position[2] == 0 && normal[0] == -1 && normal[1] == 0 &&
          normal[2] == 0);
    CHECK(!fake_entry(&hit, "back")->as.boolean);
    CHECK(fake_entry(&hit, "face_index")->as.integer == 2 || fake_entry(&hit, "face_index")->as.integer == 3);
    fake_end(&hit);
    hit = ask(&soup, "cast_ray", beside, 2);
    CHECK(fake_entry_count(&hit) == 0);
    fake_end(&hit);
    CHECK(!ask(&soup, "can_see", through, 2).as.boolean && ask(&soup, "can_see", beside, 2).as.boolean);
    const fake_variant up[2] = { vector(5, -1, 5), vector(5, 1, 5) };
    hit = ask(&soup, "cast_ray", up, 2);
    CHECK(fake_entry(&hit, "back")->as.boolean && fake_entry(&hit, "normal")->as.vector[1] == 1);
    fake_end(&hit);

    tl_vec3 broken[3] = { { 0, 0, 0 }, { NAN, 0, 0 }, { 0, 0, 1 } };
    fake_variant wrong = fake_array(broken, 3), nothing = fake_array(NULL, 0);
    check_text(&soup, "bake", &wrong, 1, "vertex 1: ");
    check_text(&soup, "bake", &nothing, 1, "no ");
    CHECK(!ask(&soup, "is_baked", NULL, 0).as.boolean);
    fake_end(&wrong);
    fake_end(&nothing);
    fake_end(&faces);
    end(&soup);
}

static void check_calls(void)
{
    node soup = make("TalusSoup3D");
    gd_call_error error = { 0 };
    const fake_variant ends[3] = { vector(0, 0, 0), number(1), number(1) };
    call(&soup, "cast_ray", ends, 1, &error);
    CHECK(error.error == GD_CALL_TOO_FEW_ARGUMENTS && error.expected == 2);
    call(&soup, "cast_ray", ends, 3, &error);
    CHECK(error.error == GD_CALL_TOO_MANY_ARGUMENTS && error.expected == 2);
    call(&soup, "cast_ray", ends, 2, &error);
    CHECK(error.error == GD_CALL_INVALID_ARGUMENT && error.argument == 1 && error.expected == GD_VECTOR3);
    end(&soup);
}

int main(int count, char **words)
{
    void *library = count > 1 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (library == NULL) {
        fprintf(stderr, "test_godot LIBRARY: %s\n", count > 1 ? dlerror() : "which?");
        return 2;
    }
    entry_fn *entry;
    void *symbol = dlsym(library, "talus_godot_init");
    CHECK(symbol != NULL && dlsym(library, "tl_soup_bake") == NULL);
    memcpy(&entry, &symbol, sizeof entry);

    gd_initialization initialization = { 0 };
    engine.without = "classdb_register_extension_class2";
    CHECK(!entry(fake_get_proc_address, &engine, &initialization) && engine.errors == 1);
    engine.without = NULL;
    engine.vector_size = 24;
    CHECK(!entry(fake_get_proc_address, &engine, &initialization) && engine.errors == 2);
    engine.vector_size = 12;
    CHECK(entry(fake_get_proc_address, &engine, &initialization) && initialization.minimum_level == GD_LEVEL_SCENE);
    for (gd_level i = GD_LEVEL_SCENE; i <= GD_LEVEL_EDITOR; i++) {
        initialization.initialize(initialization.user, i);
    }
    CHECK(engine.class_count == 2 && engine.alive == 0);
    for (uint32_t i = 0; i < engine.class_count; i++) {
        CHECK(strcmp(engine.classes[i].parent, "Node3D") == 0);
    }
    check_properties();
    check_paths();
    check_rays();
    check_calls();
    for (int i = GD_LEVEL_EDITOR; i >= GD_LEVEL_SCENE; i--) {
        initialization.deinitialize(initialization.user, (gd_level)i);
    }
    CHECK(engine.class_count == 0 && engine.errors == 2);
    if (engine.alive != 0) {
        fprintf(stderr, "%lld values of the engine were not given back\n", (long long)engine.alive);
        return 1;
    }
    dlclose(library);
    printf("%u checks of the extension for Godot\n", checks);
    return 0;
}
