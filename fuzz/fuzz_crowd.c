// SPDX-License-Identifier: MIT
//
// A crowd through whatever may happen to it: the input is a program of single bytes, which adds and removes agents,
// sends them, forms groups, takes tiles and links away and puts them back, saves and restores, and steps. After each
// step everybody is on the mesh and finite; a crowd that was restored from a saved state has its hash, and takes the
// same step; one that was restored from a damaged state is safe to step.

#include "fuzz/holed_floor.h"

#include <math.h>
#include <talus/nav_crowd.h>

enum { MAX_AGENTS = 24, MAX_LINKS = 4, MAX_STEPS = 400, MAX_TILES = 16, GROUP_AGENTS = 6 };

static tl_nav_tiles tiles;

typedef struct scene_under_fuzz {
    fuzz_bytes bytes;
    tl_navmesh *navmesh;
    bool has_tile[MAX_TILES];
    tl_nav_ref links[MAX_LINKS];
    uint32_t link_count;
    tl_nav_crowd *crowd, *twin;
    tl_nav_agent agents[MAX_AGENTS];
    bool is_fixed[MAX_AGENTS];
    uint32_t agent_count, steps;
    void *saved;
} scene_under_fuzz;

// 3 x 3 tiles.
static void bake_floor(void)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.agent_radius = 0.25f;
    def.tile_size = 28;
    holed_floor_bake(&def, &tiles);
    require(tiles.tile_count <= MAX_TILES);
}

static bool place_from(scene_under_fuzz *f, tl_nav_location *place)
{
    const float x = (float)next_byte(&f->bytes) * 0.08f, z = (float)next_byte(&f->bytes) * 0.08f;
    return tl_navmesh_find_nearest(f->navmesh, NULL, tl_vec3_make(x, 0, z), tl_vec3_make(3, 2, 3), place) == TL_OK;
}

static void add_agent(scene_under_fuzz *f)
{
    const uint8_t kind = next_byte(&f->bytes);
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.position = tl_vec3_make((float)next_byte(&f->bytes) * 0.08f, 0.0f, (float)next_byte(&f->bytes) * 0.08f);
    def.radius = kind % 4 == 0 ? 0.5f : 0.25f;
    def.max_speed = 0.5f * (float)(kind / 4 % 8);
    def.is_fixed = kind >= 224;
    tl_nav_agent agent;
    const tl_result result = tl_nav_crowd_add(f->crowd, f->navmesh, &def, &agent, NULL);
    require(result == TL_OK || result == TL_NOT_FOUND || (result == TL_ERR_LIMIT && f->agent_count == MAX_AGENTS));
    if (result == TL_OK) {
        f->is_fixed[f->agent_count] = def.is_fixed;
        f->agents[f->agent_count++] = agent;
    }
}

static void remove_agent(scene_under_fuzz *f, uint32_t i)
{
    require(tl_nav_crowd_remove(f->crowd, f->agents[i]) == TL_OK);
    require(tl_nav_crowd_remove(f->crowd, f->agents[i]) == TL_ERR_STALE);
    f->agents[i] = f->agents[--f->agent_count];
    f->is_fixed[i] = f->is_fixed[f->agent_count];
}

static void send_agent(scene_under_fuzz *f, uint32_t i)
{
    tl_nav_location goal;
    if (f->is_fixed[i]) {
        const tl_vec3 at = tl_vec3_make((float)next_byte(&f->bytes) * 0.08f, 0.0f, (float)next_byte(&f->bytes) * 0.08f);
        require(tl_nav_crowd_set_motion(f->crowd, f->agents[i], at, tl_vec3_make(1, 0, 0)) == TL_OK);
    } else if (place_from(f, &goal)) {
        const tl_result result = tl_nav_crowd_set_goal(f->crowd, f->agents[i], &goal);
        require(result == TL_OK || result == TL_ERR_ARGUMENT); // it follows
    }
}

static void change_group(scene_under_fuzz *f, uint32_t i)
{
    tl_nav_group_def def = tl_default_nav_group_def();
    def.formation = (tl_nav_formation)(next_byte(&f->bytes) % TL_NAV_FORMATION_SLOTS);
    tl_nav_group group = tl_nav_crowd_group_of(f->crowd, f->agents[i]);
    if (group == TL_NAV_NO_GROUP) {
        const uint32_t rest = f->agent_count - i;
        const uint32_t count = 1 + next_byte(&f->bytes) % (rest < GROUP_AGENTS ? rest : GROUP_AGENTS);
        const tl_result result = tl_nav_crowd_add_group(f->crowd, &def, f->agents + i, count, &group, NULL);
        require(result == TL_OK || result == TL_ERR_ARGUMENT || result == TL_ERR_LIMIT);
    } else if (next_byte(&f->bytes) % 2 == 0) {
        require(tl_nav_crowd_set_formation(f->crowd, group, &def, NULL) == TL_OK);
    } else {
        require(tl_nav_crowd_remove_group(f->crowd, group) == TL_OK);
    }
}

static void toggle_tile(scene_under_fuzz *f, uint32_t i)
{
    const tl_nav_tile *tile = tiles.tiles[i];
    if (f->has_tile[i]) {
        require(tl_navmesh_remove_tile(f->navmesh, tile->tile_x, tile->tile_z) == TL_OK);
    } else {
        require(tl_navmesh_add_tile(f->navmesh, tile, TL_NAV_TILE_BORROWED) == TL_OK);
    }
    f->has_tile[i] = !f->has_tile[i];
}

static void change_links(scene_under_fuzz *f)
{
    if (f->link_count == MAX_LINKS) {
        require(tl_navmesh_remove_offmesh(f->navmesh, f->links[--f->link_count]) == TL_OK);
        return;
    }
    tl_nav_location ends[2];
    if (place_from(f, &ends[0]) && place_from(f, &ends[1])) {
        tl_nav_offmesh link = tl_default_nav_offmesh();
        link.start = ends[0].point;
        link.end = ends[1].point;
        link.both_ways = next_byte(&f->bytes) % 2 == 0;
        require(tl_navmesh_add_offmesh(f->navmesh, &link, &f->links[f->link_count], NULL) == TL_OK);
        f->link_count++;
    }
}

static bool is_whole(tl_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void check_agents(const scene_under_fuzz *f)
{
    require(tl_nav_crowd_count(f->crowd) == f->agent_count);
    for (uint32_t i = 0; i < f->agent_count; i++) {
        tl_nav_agent_state state;
        require(tl_nav_crowd_agent(f->crowd, f->agents[i], &state) == TL_OK);
        require(is_whole(state.position) && is_whole(state.velocity) && is_whole(state.wanted));
        require((state.status == TL_NAV_AGENT_FIXED) == f->is_fixed[i]);
        if (state.status == TL_NAV_AGENT_FIXED || state.status == TL_NAV_AGENT_ON_LINK ||
            state.status == TL_NAV_AGENT_OFF_MESH) {
            continue;
        }
        tl_vec3 on;
        require(tl_navmesh_closest_point(f->navmesh, state.polygon, state.position, &on, NULL) == TL_OK);
        require(hypotf(on.x - state.position.x, on.z - state.position.z) < 1e-4f);
        require(fabsf(on.y - state.position.y) < 1e-3f);
    }
}

static void step_crowd(scene_under_fuzz *f)
{
    if (f->steps++ < MAX_STEPS) {
        const float dt = 0.01f * (float)(1 + next_byte(&f->bytes) % 100);
        require(tl_nav_crowd_step(f->crowd, f->navmesh, dt, NULL) == TL_OK);
        check_agents(f);
    }
}

static void restore_twin(scene_under_fuzz *f)
{
    const size_t size = tl_nav_crowd_state_size(f->crowd);
    require(tl_nav_crowd_save(f->crowd, f->saved, size) == TL_OK);
    require(tl_nav_crowd_restore(f->twin, f->saved, size, NULL) == TL_OK);
    require(tl_nav_crowd_hash(f->twin) == tl_nav_crowd_hash(f->crowd));
    require(tl_nav_crowd_step(f->crowd, f->navmesh, 0.05f, NULL) == TL_OK);
    require(tl_nav_crowd_step(f->twin, f->navmesh, 0.05f, NULL) == TL_OK);
    require(tl_nav_crowd_hash(f->twin) == tl_nav_crowd_hash(f->crowd));
    check_agents(f);
}

static void restore_damaged(scene_under_fuzz *f)
{
    const size_t size = tl_nav_crowd_state_size(f->crowd);
    require(tl_nav_crowd_save(f->crowd, f->saved, size) == TL_OK);
    const uint8_t count = (uint8_t)(1 + next_byte(&f->bytes) % 4);
    for (uint8_t i = 0; i < count; i++) {
        const size_t word = ((size_t)next_byte(&f->bytes) | (size_t)next_byte(&f->bytes) << 8) % (size / 4);
        uint32_t value;
        memcpy(&value, (const uint8_t *)f->saved + 4 * word, sizeof value);
        value ^= (uint32_t)next_byte(&f->bytes) << 8 * (next_byte(&f->bytes) % 4);
        memcpy((uint8_t *)f->saved + 4 * word, &value, sizeof value);
    }
    const uint64_t before = tl_nav_crowd_hash(f->twin);
    if (tl_nav_crowd_restore(f->twin, f->saved, size, NULL) == TL_OK) {
        for (uint32_t i = 0; i < 3; i++) {
            require(tl_nav_crowd_step(f->twin, f->navmesh, 0.1f, NULL) == TL_OK);
        }
    } else {
        require(tl_nav_crowd_hash(f->twin) == before);
    }
}

static void run_op(scene_under_fuzz *f)
{
    const uint8_t op = next_byte(&f->bytes);
    const uint32_t agent = f->agent_count > 0 ? op / 12u % f->agent_count : 0;
    switch (op % 12) {
    case 0:
    case 1:
        add_agent(f);
        break;
    case 2:
        if (f->agent_count > 0) {
            remove_agent(f, agent);
        }
        break;
    case 3:
    case 4:
        if (f->agent_count > 0) {
            send_agent(f, agent);
        }
        break;
    case 5:
        if (f->agent_count > 0) {
            change_group(f, agent);
        }
        break;
    case 6:
        toggle_tile(f, op / 12u % tiles.tile_count);
        break;
    case 7:
        change_links(f);
        break;
    case 8:
        restore_twin(f);
        break;
    case 9:
        restore_damaged(f);
        break;
    default:
        step_crowd(f);
        break;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (tiles.tile_count == 0) {
        bake_floor();
    }
    scene_under_fuzz f;
    memset(&f, 0, sizeof f);
    f.bytes = (fuzz_bytes){ data, size };
    require(tl_navmesh_create(NULL, &f.navmesh) == TL_OK);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        toggle_tile(&f, i);
    }
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = MAX_AGENTS;
    def.max_path = 6;
    def.max_nodes = 64;
    def.max_groups = 3;
    def.max_members = 16;
    def.paths_per_step = 3;
    require(tl_nav_crowd_create(&def, &f.crowd, NULL) == TL_OK && tl_nav_crowd_create(&def, &f.twin, NULL) == TL_OK);
    f.saved = aligned_alloc(64, (tl_nav_crowd_state_size(f.crowd) + 63) / 64 * 64);
    require(f.saved != NULL);
    while (f.bytes.size > 0) {
        run_op(&f);
    }
    tl_nav_crowd_destroy(f.crowd);
    tl_nav_crowd_destroy(f.twin);
    tl_navmesh_destroy(f.navmesh);
    free(f.saved);
    return 0;
}
