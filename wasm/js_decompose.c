// SPDX-License-Identifier: MIT
//
// Decomposition of the input's mesh into convex parts. What a bake made is kept until JavaScript has taken its hulls.

#include "js_mesh.h"

static tl_decomposition body;

/// Slot: tolerance, relative tolerance, max parts, max vertices, thickness, solid, max cells; then the number of parts,
/// tolerance, cell, degenerate triangles, cuts, parts before merging, parts over the tolerance.
tl_result TL_JS_FULL_EXPORT(js_decompose)(void)
{
    tl_decompose_def def = tl_default_decompose_def();
    def.tolerance = tl_js_f32(0);
    def.relative_tolerance = tl_js_f32(1);
    def.max_parts = tl_js_u32(2);
    def.max_vertices = tl_js_u32(3);
    def.thickness = tl_js_f32(4);
    def.solid = (tl_solid_rule)tl_js_u32(5);
    def.max_cells = tl_js_u32(6);
    def.host = *tl_js_host();
    tl_decompose_report report;
    const tl_result result = tl_decomposition_bake(&tl_js_input.mesh, &def, &body, &report);
    tl_js_report = report.base;
    uint32_t at = tl_js_put(0, body.part_count);
    at = tl_js_put(tl_js_put(at, (double)report.tolerance), (double)report.cell);
    at = tl_js_put(tl_js_put(at, report.degenerate_triangles), report.cut_count);
    tl_js_put(tl_js_put(at, report.parts_before_merging), report.parts_over_tolerance);
    return result;
}

/// A part's hull, which is the caller's then. Slot: its concavity, metres outside.
tl_hull *TL_JS_FULL_EXPORT(js_decompose_take)(uint32_t index)
{
    tl_convex_part *part = &body.parts[index];
    tl_hull *hull = part->hull;
    part->hull = NULL;
    tl_js_put(tl_js_put(0, part->concavity), part->max_outside);
    return hull;
}

/// Frees what was not taken.
void TL_JS_FULL_EXPORT(js_decompose_end)(void)
{
    tl_decomposition_free(&body);
}
