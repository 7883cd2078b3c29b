// SPDX-License-Identifier: MIT
//
// Any contours, as many and as tangled as the bytes say: the bake succeeds or names an error, and what it bakes passes
// the validator. The second half of the inputs is read as text.

#include "io/text/contour_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/polygon.h>

enum { MAX_VERTICES = 512, MAX_CONTOURS = 64 };

static void build_and_check(const tl_contour_set *set, uint32_t cap, uint32_t merge_height)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = cap % 64 < 3 ? 0 : cap % 64;
    def.merge_height = merge_height;
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    if (tl_polygon_mesh_bake(set, &def, &mesh, &report) != TL_OK) {
        abort();
    }
    tl_polygon_check_report check;
    if (tl_polygon_mesh_check(&mesh, set, NULL, &check) != TL_OK) {
        // Contours that lie upon each other may claim an edge more than twice; one of the claims stays without a link.
        for (uint32_t fault = 0; fault < TL_POLYGON_FAULT_COUNT; fault++) {
            if (check.counts[fault] > 0 && (fault != TL_POLYGON_FAULT_LINK || report.non_manifold_edges == 0)) {
                fprintf(stderr, "%s: %s %llu\n", tl_polygon_fault_text((tl_polygon_fault)fault), check.base.element,
                        (unsigned long long)check.base.element_index);
                abort();
            }
        }
    }
    tl_polygon_mesh_free(&mesh);
}

static void from_bytes(const uint8_t *data, size_t size)
{
    static tl_contour_vertex vertices[MAX_VERTICES];
    static tl_contour contours[MAX_CONTOURS];
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.contours = contours;
    set.cell_size = set.cell_height = 1.0f;
    uint32_t shift = data[1] % 22;
    set.width = set.height = 255 << shift;
    set.border_size = data[2] & 1;
    for (size_t at = 4; at + 3 <= size && set.vertex_count < MAX_VERTICES; at += 3) {
        // The third byte: height, border flag, and whether a new contour begins.
        if ((set.contour_count == 0 || data[at + 2] >= 0xf0) && set.contour_count < MAX_CONTOURS) {
            tl_contour contour = { set.vertex_count, 0, set.contour_count + 1, 63 };
            contours[set.contour_count++] = contour;
        }
        tl_contour_vertex v = { (int32_t)data[at] << shift, data[at + 2] & 7, (int32_t)data[at + 1] << shift,
                                data[at + 2] & 8 ? TL_CONTOUR_BORDER_VERTEX : 0 };
        vertices[set.vertex_count++] = v;
        contours[set.contour_count - 1].vertex_count++;
    }
    build_and_check(&set, data[0], data[3] & 7);
}

static void from_text(const uint8_t *data, size_t size)
{
    tl_text_reader reader;
    memset(&reader, 0, sizeof reader);
    reader.bytes = (const char *)data;
    reader.size = size;
    tl_contour_text text;
    while (!tl_text_reader_at_end(&reader) && tl_contour_text_read(&reader, &text, NULL) == TL_OK) {
        build_and_check(&text.set, text.max_verts_per_poly, 2);
        tl_contour_text_free(&text);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 4 && memcmp(data, "nav", 3) != 0) {
        from_bytes(data, size);
    } else {
        from_text(data, size);
    }
    return 0;
}
