// SPDX-License-Identifier: MIT
//
// A key that is not known is an error: a misspelt "repeat" would be a guard who stands still.

#include "cli/crowd/crowd_scenario.h"

#include "io/files/file_map.h"
#include "io/text/json_place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SCENARIO_MIB = 64 };

// What the getters need to know.
typedef struct scenario_reader {
    tl_json_reader json;
    const tl_pack_frame *frame;
} scenario_reader;

// Leaves `value` as it is where the key is not there.
static void take_number(scenario_reader *r, const tl_json_place *at, const char *key, double low, double high,
                        float *value)
{
    const json_t *given = json_object_get(at->value, key);
    if (given == NULL) {
        return;
    }
    const double number = json_is_number(given) ? json_number_value(given) : (double)NAN;
    if (!(number >= low && number <= high)) {
        char what[96];
        snprintf(what, sizeof(what), "is no number from %g to %g", low, high);
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, key, what);
        return;
    }
    *value = (float)number;
}

static bool point_of(const scenario_reader *r, const json_t *value, tl_vec3 *point)
{
    double n[3];
    for (size_t i = 0; i < 3; ++i) {
        const json_t *number = json_array_get(value, i);
        n[i] = json_is_number(number) ? json_number_value(number) : (double)NAN;
    }
    *point = tl_pack_place_in(r->frame, n);
    return json_array_size(value) == 3 && isfinite(point->x) && isfinite(point->y) && isfinite(point->z);
}

static void take_point(scenario_reader *r, const tl_json_place *at, const char *key, tl_vec3 *point)
{
    if (!point_of(r, json_object_get(at->value, key), point)) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, key, "is no place; give [x, y, z]");
    }
}

static void take_goals(scenario_reader *r, const tl_json_place *at, tl_crowd_group *group)
{
    tl_json_place list;
    const size_t count = tl_json_list(&r->json, at, "goals", &list);
    if (r->json.result == TL_OK && (count == 0 || count > 1000000)) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "goals", "holds no place; give [[x, y, z], ...]");
    }
    if (r->json.result != TL_OK) {
        return;
    }
    group->goals = calloc(count, sizeof(*group->goals));
    if (group->goals == NULL) {
        tl_json_fail(&r->json, TL_ERR_MEMORY, at, "goals", "is too long for the memory");
        return;
    }
    group->goal_count = (uint32_t)count;
    for (size_t i = 0; i < count; ++i) {
        if (!point_of(r, json_array_get(list.value, i), &group->goals[i])) {
            const tl_json_place goal = { at, "goals", i, NULL };
            tl_json_fail(&r->json, TL_ERR_FORMAT, &goal, NULL, "is no place; give [x, y, z]");
            return;
        }
    }
}

static void take_slots(scenario_reader *r, const tl_json_place *at, tl_crowd_group *group)
{
    tl_json_place list;
    const size_t count = tl_json_list(&r->json, at, "formation", &list);
    if (r->json.result == TL_OK && count + 1 != group->count) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "formation", "has not one slot for each agent but the first");
    }
    if (r->json.result != TL_OK || count == 0) {
        return;
    }
    group->slots = calloc(count, sizeof(*group->slots));
    if (group->slots == NULL) {
        tl_json_fail(&r->json, TL_ERR_MEMORY, at, "formation", "is too long for the memory");
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        const json_t *slot = json_array_get(list.value, i);
        const json_t *forward = json_array_get(slot, 0), *left = json_array_get(slot, 1);
        const double f = json_is_number(forward) ? json_number_value(forward) : (double)NAN;
        const double l = json_is_number(left) ? json_number_value(left) : (double)NAN;
        if (json_array_size(slot) != 2 || !(fabs(f) <= 1000.0) || !(fabs(l) <= 1000.0)) {
            const tl_json_place place = { at, "formation", i, NULL };
            tl_json_fail(&r->json, TL_ERR_FORMAT, &place, NULL, "is no slot; give [forward, left], up to 1000 m");
            return;
        }
        group->slots[i].forward = (float)f;
        group->slots[i].left = (float)l;
    }
}

static void take_formation(scenario_reader *r, const tl_json_place *at, tl_crowd_group *group)
{
    const json_t *given = json_object_get(at->value, "formation");
    group->form = tl_default_nav_group_def();
    group->form.spacing = 4.0f * group->radius;
    take_number(r, at, "apart", 0.01, 1000.0, &group->form.spacing);
    group->is_formed = given != NULL;
    if (given == NULL) {
        if (json_object_get(at->value, "apart") != NULL) {
            tl_json_fail(&r->json, TL_ERR_FORMAT, at, "apart", "is given without a formation");
        }
        return;
    }
    if (json_is_array(given)) {
        group->form.formation = TL_NAV_FORMATION_SLOTS;
        take_slots(r, at, group);
        return;
    }
    const char *name = tl_json_string(&r->json, at, "formation");
    for (uint32_t k = 0; name != NULL && k < TL_NAV_FORMATION_SLOTS; ++k) {
        if (strcmp(name, tl_nav_formation_name((tl_nav_formation)k)) == 0) {
            group->form.formation = (tl_nav_formation)k;
            return;
        }
    }
    tl_json_fail(&r->json, TL_ERR_FORMAT, at, "formation",
                 "is none of loose, line, column, wedge and ring, and no list of slots");
}

static void take_group(scenario_reader *r, const tl_json_place *at, tl_crowd_group *group)
{
    static const char *const known[] = { "name",   "count",  "at",    "goals",    "start",     "repeat", "spacing",
                                         "radius", "height", "speed", "priority", "formation", "apart",  NULL };
    if (!tl_json_keys_are_known(&r->json, at, known)) {
        return;
    }
    const tl_nav_agent_def def = tl_default_nav_agent_def();
    group->radius = def.radius;
    group->height = def.height;
    group->speed = def.max_speed;
    group->priority = def.priority;
    const char *name = tl_json_string(&r->json, at, "name");
    snprintf(group->name, sizeof(group->name), "%s", name != NULL ? name : "");
    const size_t count = tl_json_size(&r->json, at, "count", 1);
    if (r->json.result == TL_OK && (count == 0 || count > TL_NAV_CROWD_MAX_AGENTS)) {
        tl_json_fail(&r->json, TL_ERR_LIMIT, at, "count", "is 0, or more than a crowd holds");
    }
    group->count = (uint32_t)count;
    group->repeat = tl_json_bool(&r->json, at, "repeat");
    take_point(r, at, "at", &group->at);
    take_goals(r, at, group);
    take_number(r, at, "start", 0.0, 1e6, &group->start);
    take_number(r, at, "radius", 0.01, 1000.0, &group->radius);
    take_number(r, at, "height", 0.01, 1000.0, &group->height);
    take_number(r, at, "speed", 0.0, 1000.0, &group->speed);
    take_number(r, at, "priority", 0.0, 1.0, &group->priority);
    group->spacing = 3.0f * group->radius;
    take_number(r, at, "spacing", 0.01, 1000.0, &group->spacing);
    take_formation(r, at, group);
}

static void take_vehicle(scenario_reader *r, const tl_json_place *at, tl_crowd_vehicle *vehicle)
{
    static const char *const known[] = { "from", "to", "start", "speed", "radius", "height", NULL };
    if (!tl_json_keys_are_known(&r->json, at, known)) {
        return;
    }
    vehicle->speed = 4.0f;
    vehicle->radius = 1.0f;
    vehicle->height = 1.5f;
    take_point(r, at, "from", &vehicle->from);
    take_point(r, at, "to", &vehicle->to);
    take_number(r, at, "start", 0.0, 1e6, &vehicle->start);
    take_number(r, at, "speed", 0.0, 1000.0, &vehicle->speed);
    take_number(r, at, "radius", 0.01, 1000.0, &vehicle->radius);
    take_number(r, at, "height", 0.01, 1000.0, &vehicle->height);
}

static void take_size(scenario_reader *r, const tl_json_place *at, float size[2])
{
    const json_t *given = json_object_get(at->value, "size");
    for (size_t i = 0; i < 2; ++i) {
        const json_t *number = json_array_get(given, i);
        const double n = json_is_number(number) ? json_number_value(number) : (double)NAN;
        if (!(n >= 0.01 && n <= 1000.0) || json_array_size(given) != 2) {
            tl_json_fail(&r->json, TL_ERR_FORMAT, at, "size", "is no size; give [x, z] from 0.01 to 1000, or a radius");
            return;
        }
        size[i] = (float)n;
    }
}

// A box is turned and tilted, a pillar lies where it has another end.
static void take_pose(scenario_reader *r, const tl_json_place *at, tl_crowd_obstacle *obstacle)
{
    take_number(r, at, "turn", -360.0, 360.0, &obstacle->turn);
    take_number(r, at, "tilt", -90.0, 90.0, &obstacle->tilt);
    take_number(r, at, "height", 0.01, 1000.0, &obstacle->height);
    obstacle->is_capsule = json_object_get(at->value, "to") != NULL;
    if (obstacle->is_capsule) {
        take_point(r, at, "to", &obstacle->to);
    }
    if (obstacle->is_capsule && obstacle->radius == 0.0f) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "to", "is given without a radius");
    }
    if (obstacle->tilt != 0.0f && obstacle->radius > 0.0f) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "tilt", "is for boxes; where a pillar leans give its other end, to");
    }
}

static void take_obstacle(scenario_reader *r, const tl_json_place *at, tl_crowd_obstacle *obstacle)
{
    static const char *const known[] = {
        "at", "size", "radius", "to", "turn", "tilt", "height", "from", "until", NULL
    };
    if (!tl_json_keys_are_known(&r->json, at, known)) {
        return;
    }
    obstacle->height = 2.0f;
    obstacle->until = INFINITY;
    take_point(r, at, "at", &obstacle->at);
    if (json_object_get(at->value, "radius") == NULL) {
        take_size(r, at, obstacle->size);
    } else if (json_object_get(at->value, "size") != NULL) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "radius", "is given beside a size; leave one out");
    }
    take_number(r, at, "radius", 0.01, 1000.0, &obstacle->radius);
    take_pose(r, at, obstacle);
    take_number(r, at, "from", 0.0, 1e6, &obstacle->from);
    take_number(r, at, "until", 0.0, 1e6, &obstacle->until);
    if (r->json.result == TL_OK && !(obstacle->from < obstacle->until)) {
        tl_json_fail(&r->json, TL_ERR_FORMAT, at, "until", "is not after from");
    }
}

// Room for the items of a list; NULL and 0 for none. False: out of memory.
static bool make_room(scenario_reader *r, const tl_json_place *root, const char *key, size_t size, void **items,
                      tl_json_place *list, uint32_t *count)
{
    const size_t length = tl_json_list(&r->json, root, key, list);
    *count = 0;
    *items = length > 0 ? calloc(length, size) : NULL;
    if (length > TL_NAV_CROWD_MAX_AGENTS || (length > 0 && *items == NULL)) {
        tl_json_fail(&r->json, TL_ERR_LIMIT, root, key, "is longer than a crowd holds");
        return false;
    }
    *count = (uint32_t)length;
    return r->json.result == TL_OK;
}

static void take_scenario(scenario_reader *r, const tl_json_place *root, tl_crowd_scenario *s)
{
    static const char *const known[] = { "seconds", "step", "groups", "vehicles", "obstacles", NULL };
    tl_json_place list, item;
    void *items;
    if (!tl_json_keys_are_known(&r->json, root, known)) {
        return;
    }
    take_number(r, root, "seconds", 0.001, 1e6, &s->seconds);
    take_number(r, root, "step", 0.001, 1.0, &s->step);
    bool good = make_room(r, root, "groups", sizeof(*s->groups), &items, &list, &s->group_count);
    s->groups = items;
    uint64_t agents = 0;
    for (uint32_t i = 0; good && i < s->group_count && tl_json_item(&r->json, &list, i, &item); ++i) {
        take_group(r, &item, &s->groups[i]);
        agents += s->groups[i].count;
    }
    good = good && make_room(r, root, "vehicles", sizeof(*s->vehicles), &items, &list, &s->vehicle_count);
    s->vehicles = good ? items : NULL;
    s->vehicle_count = good ? s->vehicle_count : 0;
    for (uint32_t i = 0; good && i < s->vehicle_count && tl_json_item(&r->json, &list, i, &item); ++i) {
        take_vehicle(r, &item, &s->vehicles[i]);
    }
    good = good && make_room(r, root, "obstacles", sizeof(*s->obstacles), &items, &list, &s->obstacle_count);
    s->obstacles = good ? items : NULL;
    s->obstacle_count = good ? s->obstacle_count : 0;
    for (uint32_t i = 0; good && i < s->obstacle_count && tl_json_item(&r->json, &list, i, &item); ++i) {
        take_obstacle(r, &item, &s->obstacles[i]);
    }
    if (r->json.result == TL_OK && (agents == 0 || agents + s->vehicle_count > TL_NAV_CROWD_MAX_AGENTS)) {
        tl_json_fail(&r->json, agents == 0 ? TL_ERR_FORMAT : TL_ERR_LIMIT, root, "groups",
                     agents == 0 ? "is empty or missing" : "has more agents than a crowd holds");
    }
    s->agent_count = (uint32_t)agents;
}

tl_result tl_crowd_scenario_read(const char *path, const tl_pack_frame *frame, tl_crowd_scenario *scenario_out,
                                 tl_io_error *error_out)
{
    memset(scenario_out, 0, sizeof(*scenario_out));
    scenario_out->seconds = 60.0f;
    scenario_out->step = 0.05f;
    tl_file_map map;
    const tl_result result = tl_file_read(path, (uint64_t)SCENARIO_MIB << 20, &map, error_out);
    if (result != TL_OK) {
        return result;
    }
    scenario_reader reader = { { TL_OK, path, error_out, "see talus crowd --help" }, frame };
    tl_json_place root;
    if (tl_json_load(&reader.json, map.bytes, map.size, &root) == TL_OK) {
        take_scenario(&reader, &root, scenario_out);
        json_decref(root.value);
    }
    tl_file_map_close(&map);
    return reader.json.result;
}

void tl_crowd_scenario_free(tl_crowd_scenario *scenario)
{
    for (uint32_t i = 0; i < scenario->group_count; ++i) {
        free(scenario->groups[i].goals);
        free(scenario->groups[i].slots);
    }
    free(scenario->groups);
    free(scenario->vehicles);
    free(scenario->obstacles);
    memset(scenario, 0, sizeof(*scenario));
}
