// SPDX-License-Identifier: MIT
//
// Jump links, the audit, why a point is not walkable, and sight.

#include "js_navmesh.h"

#include <stdlib.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// Jump links.

/// Slot: nine fields of the def; then the result, the report, and where the links are.
tl_nav_links *TL_JS_FULL_EXPORT(js_links_find)(const tl_js_navmesh *self, const tl_soup *soup)
{
    tl_nav_links_def def = tl_default_nav_links_def();
    float *const floats[] = { &def.spacing,   &def.max_drop, &def.max_jump,  &def.jump_height,
                              &def.max_speed, &def.gravity,  &def.max_climb, &def.min_gain };
    for (uint32_t i = 0; i < 8; i++) {
        *floats[i] = tl_js_f32(i);
    }
    def.max_nodes = tl_js_u32(8);
    def.host = *tl_js_host();
    tl_nav_links *links;
    tl_nav_links_report report;
    memset(&report, 0, sizeof report);
    const tl_result result = tl_nav_links_find(&def, self->navmesh, soup, &links, &report);
    tl_js_report = report.base;
    uint32_t at = tl_js_put(tl_js_put(0, result), report.ledge_count);
    at = tl_js_put(tl_js_put(tl_js_put(at, report.sample_count), report.no_landing), report.too_fast);
    for (uint32_t kind = 0; kind < TL_NAV_LINK_KINDS; kind++) {
        const tl_nav_links_count *c = &report.kinds[kind];
        at = tl_js_put(tl_js_put(at, c->tried), c->blocked);
        at = tl_js_put(tl_js_put(at, c->useless), c->kept);
    }
    return links;
}

/// Slot: how many links, where, and the blob's size.
tl_result TL_JS_EXPORT(js_links_info)(const tl_nav_links *links, uint32_t size)
{
    const tl_result result = tl_nav_links_check(links, size, &tl_js_report);
    if (result == TL_OK) {
        const uint32_t at = tl_js_put(0, links->link_count);
        tl_js_put(tl_js_put_pointer(at, tl_nav_links_array(links)), (double)links->blob.size);
    }
    return result;
}

/// A set of links from JavaScript's: 'links' has `count` of them, whose agent is the navmesh's. To be freed with
/// js_free. NULL: out of memory.
tl_nav_links *TL_JS_FULL_EXPORT(js_links_make)(const tl_js_navmesh *self, const tl_nav_jump_link *links, uint32_t count)
{
    const size_t head = (sizeof(tl_nav_links) + 63) / 64 * 64;
    const size_t size = (head + count * sizeof *links + 63) / 64 * 64;
    tl_nav_links *set = aligned_alloc(64, size);
    if (set == NULL) {
        return NULL;
    }
    memset(set, 0, size);
    set->blob.magic = TL_NAV_LINKS_MAGIC;
    set->blob.version = TL_NAV_LINKS_VERSION;
    set->blob.size = size;
    set->link_count = count;
    for (uint32_t i = 0; i < count; i++) {
        set->kind_counts[links[i].kind % TL_NAV_LINK_KINDS]++;
    }
    set->agent_radius = self->def.agent_radius;
    set->agent_height = self->def.agent_height;
    set->agent_max_climb = self->def.agent_max_climb;
    set->links = head;
    memcpy((char *)set + head, links, count * sizeof *links);
    return set;
}

/// Adds a copy of the links, by the prototype in the slot, and keeps it for the file.
tl_result TL_JS_EXPORT(js_links_add)(tl_js_navmesh *self, const tl_nav_links *links, uint32_t size)
{
    tl_result result = tl_nav_links_check(links, size, &tl_js_report);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_links *copy = aligned_alloc(64, (size_t)links->blob.size);
    if (copy == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(copy, links, (size_t)links->blob.size);
    const tl_nav_offmesh prototype = tl_js_offmesh(0);
    result = tl_nav_links_add(copy, &prototype, self->navmesh);
    if (result == TL_OK) {
        free(self->links);
        self->links = copy;
    } else {
        free(copy);
    }
    return result;
}

/// Slot: kind, both ways, apex, start, end, t; then the point.
void TL_JS_EXPORT(js_link_point)(void)
{
    tl_nav_jump_link link;
    memset(&link, 0, sizeof link);
    link.kind = (uint8_t)tl_js_u32(0);
    link.both_ways = (uint8_t)tl_js_u32(1);
    link.apex = tl_js_f32(2);
    link.start = tl_js_vec3(3);
    link.end = tl_js_vec3(6);
    tl_js_put_vec3(0, tl_nav_jump_link_point(&link, tl_js_f32(9)));
}

// ---------------------------------------------------------------------------------------------------------
// The audit.

static tl_nav_audit audit;

/// Slot: paths, seed, probe radius, smallest missing area; then what it did. Areas and volumes are the input's. The
/// findings stand until js_audit_end.
tl_result TL_JS_FULL_EXPORT(js_audit_run)(const tl_js_navmesh *self, const tl_soup *soup)
{
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.nav = self->def;
    def.path_count = tl_js_u32(0);
    def.seed = tl_js_u64(1);
    def.probe_radius = tl_js_f32(2);
    def.min_missing_area = tl_js_f32(3);
    def.areas = tl_js_input.areas;
    def.volumes = tl_js_input.volumes;
    def.volume_count = tl_js_input.volume_count;
    def.pruned = self->removed;
    def.host = *tl_js_host();
    const tl_result result = tl_nav_audit_run(&def, self->navmesh, soup, &audit, &tl_js_report);
    const double numbers[] = { audit.finding_count,         (double)audit.probe.radius,
                               (double)audit.probe.step,    (double)audit.probe.height,
                               (double)audit.probe.surface, (double)audit.probe.gap,
                               (double)audit.path_count,    audit.path_metres,
                               (double)audit.polygon_count, (double)audit.portal_count,
                               (double)audit.step_count,    (double)audit.contradictions,
                               (double)audit.floor_samples, (double)audit.sample_spacing,
                               audit.missing_area };
    memcpy(tl_js_slot, numbers, sizeof numbers);
    return result;
}

/// Slot: one finding.
void TL_JS_FULL_EXPORT(js_audit_finding)(uint32_t index)
{
    const tl_nav_finding *f = &audit.findings[index];
    uint32_t at = tl_js_put(tl_js_put(0, f->kind), f->triangle);
    at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_u64(at, f->polygon), f->point), f->contact);
    at = tl_js_put_aabb(tl_js_put(tl_js_put(at, (double)f->depth), f->count), f->bounds);
    tl_js_put(at, (double)f->area);
}

void TL_JS_FULL_EXPORT(js_audit_end)(void)
{
    tl_nav_audit_free(&audit);
}

// ---------------------------------------------------------------------------------------------------------
// Why.

/// Slot: the point; then the answer: head, needed def, reasons.
tl_result TL_JS_FULL_EXPORT(js_why)(const tl_js_navmesh *self)
{
    tl_nav_def def = self->def;
    def.host = *tl_js_host();
    const tl_nav_pruning pruning = { self->removed, tl_js_pruned_area(self) };
    tl_nav_why_answer a;
    const tl_result result = tl_nav_why(&def, &tl_js_input, self->navmesh, &pruning, tl_js_vec3(0), &a, &tl_js_report);
    uint32_t at = tl_js_put_vec3(tl_js_put(0, a.walkable), a.floor);
    at = tl_js_put(tl_js_put(at, a.proven), a.reason_count);
    at = tl_js_put(tl_js_put(tl_js_put(at, a.tile_x), a.tile_z), a.bake_count);
    at = tl_js_put(tl_js_put(tl_js_put(at, a.apart), (double)a.island_area), (double)a.largest_island_area);
    at = tl_js_put_nav_def(at, &a.needed);
    for (uint32_t i = 0; i < a.reason_count; i++) {
        const tl_nav_reason *r = &a.reasons[i];
        at = tl_js_put(at, r->cause);
        at = tl_js_put_pointer(tl_js_put_pointer(at, tl_nav_cause_name(r->cause)), tl_nav_cause_text(r->cause));
        at = tl_js_put_pointer(tl_js_put_pointer(at, r->stage), r->parameter);
        at = tl_js_put(tl_js_put(tl_js_put(at, (double)r->value), (double)r->needed), (double)r->measured);
        at = tl_js_put(at, r->triangle);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Sight.

/// Slot: the result, then the number of pairs.
tl_nav_pvs *TL_JS_FULL_EXPORT(js_sight_bake)(const tl_js_navmesh *self, const tl_soup *soup, float eye_height,
                                             float max_distance)
{
    tl_nav_pvs_def def = tl_default_nav_pvs_def();
    def.eye_height = eye_height;
    def.max_distance = max_distance;
    def.host = *tl_js_host();
    tl_nav_pvs *pvs;
    const tl_result result = tl_nav_pvs_bake(&def, self->navmesh, soup, &pvs, &tl_js_report);
    tl_js_put(tl_js_put(0, result), pvs != NULL ? (double)pvs->pair_count : 0.0);
    return pvs;
}

/// Slot: two references; then whether they see each other.
tl_result TL_JS_EXPORT(js_sight_sees)(const tl_nav_pvs *pvs, const tl_js_navmesh *self)
{
    bool seen;
    const tl_result result = tl_nav_pvs_sees(pvs, self->navmesh, tl_js_u64(0), tl_js_u64(1), &seen);
    tl_js_put(0, seen);
    return result;
}

/// Slot: a reference; then how many it sees, and where they are.
tl_result TL_JS_EXPORT(js_sight_from)(const tl_nav_pvs *pvs, const tl_js_navmesh *self)
{
    const tl_nav_ref from = tl_js_u64(0);
    uint32_t count = pvs->polygon_count;
    tl_nav_ref *refs = tl_js_buffer_room(count * sizeof *refs);
    const tl_result result =
        refs == NULL ? TL_ERR_MEMORY : tl_nav_pvs_seen_from(pvs, self->navmesh, from, refs, count, &count);
    tl_js_put_pointer(tl_js_put(0, count), refs);
    return result;
}
