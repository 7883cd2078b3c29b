// SPDX-License-Identifier: MIT
//
// Convex parts: of what a level encloses, of its surface alone, and of few vertices.

#include "golden.h"

void golden_decompositions(const tl_mesh_view *view)
{
    static const struct {
        const char *part;
        float tolerance;
        tl_solid_rule solid;
        uint32_t max_vertices, max_parts;
    } KINDS[] = { { "enclosed", 5.0f, TL_SOLID_ENCLOSED, 256, 0 },
                  { "surface", 9.0f, TL_SOLID_SURFACE, 0, 0 },
                  { "few", 5.5f, TL_SOLID_ENCLOSED, 12, 5 } };
    for (int i = 0; i < 3; i++) {
        tl_decompose_def def = tl_default_decompose_def();
        def.tolerance = KINDS[i].tolerance;
        def.solid = KINDS[i].solid;
        def.max_vertices = KINDS[i].max_vertices;
        def.max_parts = KINDS[i].max_parts;
        def.max_cells = 1u << 12;
        tl_decomposition body;
        MUST(tl_decomposition_bake(view, &def, &body, NULL));
        digest d = digest_begin();
        d.found = body.part_count;
        for (uint32_t k = 0; k < body.part_count; k++) {
            digest_blob(&d, body.parts[k].hull);
            digest_f64(&d, body.parts[k].concavity);
            digest_f64(&d, body.parts[k].max_outside);
        }
        digest_print(&d, "decompose", KINDS[i].part);
        tl_decomposition_free(&body);
    }
}
