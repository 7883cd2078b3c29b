// SPDX-License-Identifier: MIT
//
// The editable half-edge mesh under a million random edits, against a plain model: a list of faces, searched from end
// to end, that knows from the faces alone what must be refused.

#include "talus_test.h"

#include <talus/halfedge.h>

#include <string.h>

enum { MODEL_VERTICES = 24, MODEL_FACES = 512, MODEL_CORNERS = 6 };

typedef struct model_face {
    uint32_t count, vertices[MODEL_CORNERS], index;
} model_face;

typedef struct model {
    model_face faces[MODEL_FACES];
    uint32_t face_count;
    bool live[4 * MODEL_VERTICES];
    uint32_t vertex_count;
    uint32_t fan_refusals; ///< faces refused for a closed fan beside another one
} model;

static bool runs_along(const model_face *face, uint32_t from, uint32_t to)
{
    for (uint32_t i = 0; i < face->count; i++) {
        if (face->vertices[i] == from && face->vertices[(i + 1) % face->count] == to) {
            return true;
        }
    }
    return false;
}

static uint32_t faces_along(const model *m, uint32_t from, uint32_t to)
{
    uint32_t count = 0;
    for (uint32_t f = 0; f < m->face_count; f++) {
        count += runs_along(&m->faces[f], from, to);
    }
    return count;
}

// Whether the fans at a vertex are fine: any number of open ones, or one closed one and nothing else. Each face at the
// vertex leads from one neighbour (before) to another (after); the fans are the chains of these steps.
static bool fans_are_manifold(const model *m, uint32_t vertex)
{
    uint32_t next[4 * MODEL_VERTICES], steps = 0;
    memset(next, 0xff, sizeof next);
    for (uint32_t f = 0; f < m->face_count; f++) {
        const model_face *face = &m->faces[f];
        for (uint32_t i = 0; i < face->count; i++) {
            if (face->vertices[i] == vertex) {
                next[face->vertices[(i + face->count - 1) % face->count]] = face->vertices[(i + 1) % face->count];
                steps++;
            }
        }
    }
    for (uint32_t start = 0; start < 4 * MODEL_VERTICES; start++) {
        uint32_t at = start, length = 0;
        while (next[at] != UINT32_MAX && length <= steps) {
            at = next[at];
            length++;
            if (at == start) {
                return length == steps; // a closed fan must be all there is
            }
        }
    }
    return true;
}

static tl_result model_add(model *m, const uint32_t *vertices, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (vertices[i] >= 4 * MODEL_VERTICES || !m->live[vertices[i]]) {
            return TL_ERR_STALE;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            if (vertices[i] == vertices[j]) {
                return TL_ERR_DEGENERATE;
            }
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = vertices[i], b = vertices[(i + 1) % count];
        if (faces_along(m, a, b) > 0) {
            return faces_along(m, b, a) > 0 ? TL_ERR_NON_MANIFOLD : TL_ERR_WINDING;
        }
    }
    model_face *face = &m->faces[m->face_count++];
    face->count = count;
    memcpy(face->vertices, vertices, count * sizeof *vertices);
    for (uint32_t i = 0; i < count; i++) {
        if (!fans_are_manifold(m, vertices[i])) {
            m->face_count--;
            m->fan_refusals++;
            return TL_ERR_NON_MANIFOLD;
        }
    }
    return TL_OK;
}

static void model_compare(const model *m, const tl_halfedge_mesh *mesh)
{
    TEST_RESULT(tl_halfedge_mesh_check(mesh, NULL), TL_OK);
    TEST_CHECK(mesh->face_count == m->face_count && mesh->vertex_count == m->vertex_count);
    uint32_t half_edges = 0, boundary = 0;
    for (uint32_t f = 0; f < m->face_count; f++) {
        const model_face *face = &m->faces[f];
        uint32_t loop[MODEL_CORNERS], shift = 0;
        TEST_CHECK(tl_halfedge_mesh_face_vertices(mesh, face->index, loop, MODEL_CORNERS) == face->count);
        while (shift < face->count && loop[shift] != face->vertices[0]) {
            shift++;
        }
        for (uint32_t i = 0; i < face->count; i++) {
            uint32_t a = face->vertices[i], b = face->vertices[(i + 1) % face->count];
            TEST_CHECK(loop[(i + shift) % face->count] == a);
            uint32_t edge = tl_halfedge_mesh_find_edge(mesh, a, b);
            TEST_CHECK(edge != TL_HALFEDGE_NONE && mesh->edges[edge].face == face->index);
            bool open = faces_along(m, b, a) == 0;
            TEST_CHECK((mesh->edges[tl_halfedge_twin(edge)].face == TL_HALFEDGE_NONE) == open);
            half_edges += open ? 2 : 1;
            boundary += open;
        }
    }
    TEST_CHECK(mesh->half_edge_count == half_edges && mesh->boundary_count == boundary);
    // Rings hold as many edges as the model finds; loops of holes hold all boundary half-edges.
    uint32_t in_rings = 0, in_holes = 0;
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        in_rings += tl_halfedge_mesh_vertex_edges(mesh, v, NULL, 0);
    }
    for (uint32_t e = tl_halfedge_mesh_next_boundary_loop(mesh, 0); e != TL_HALFEDGE_NONE;
         e = tl_halfedge_mesh_next_boundary_loop(mesh, e + 1)) {
        uint32_t at = e;
        do {
            in_holes++;
            at = mesh->edges[at].next;
        } while (at != e);
    }
    TEST_CHECK(in_rings == half_edges && in_holes == boundary);
}

typedef struct edit_counts {
    uint32_t results[TL_RESULT_COUNT];
    uint32_t removed_faces, removed_vertices, refused_removals, cleared;
} edit_counts;

static void edit_add_face(model *m, tl_halfedge_mesh *mesh, test_random *random, edit_counts *seen)
{
    uint32_t vertices[MODEL_CORNERS], count = 3;
    if (test_random_below(random, 3) == 0) {
        count += test_random_below(random, MODEL_CORNERS - 2);
    }
    for (uint32_t i = 0; i < count; i++) {
        vertices[i] = test_random_below(random, MODEL_VERTICES);
    }
    // Half of the faces grow from an open edge, so that fans close and holes are filled.
    if (mesh->boundary_count > 0 && test_random_below(random, 4) != 0) {
        uint32_t e = tl_halfedge_mesh_next_boundary_loop(mesh, test_random_below(random, mesh->edge_end));
        if (e != TL_HALFEDGE_NONE) {
            for (uint32_t steps = test_random_below(random, 5); steps > 0; steps--) {
                e = mesh->edges[e].next;
            }
            vertices[0] = tl_halfedge_origin(mesh, e);
            vertices[1] = tl_halfedge_target(mesh, e);
            if (test_random_below(random, 2)) {
                vertices[2] = tl_halfedge_target(mesh, mesh->edges[e].next);
            }
        }
    }
    uint32_t face = TL_HALFEDGE_NONE;
    tl_result expected = model_add(m, vertices, count);
    tl_result result = tl_halfedge_mesh_add_face(mesh, vertices, count, &face);
    TEST_RESULT(result, expected);
    seen->results[result]++;
    if (result == TL_OK) {
        TEST_CHECK(tl_halfedge_is_face(mesh, face));
        m->faces[m->face_count - 1].index = face;
    }
}

static void edit_remove_face(model *m, tl_halfedge_mesh *mesh, test_random *random, edit_counts *seen)
{
    if (m->face_count == 0 || test_random_below(random, 10) == 0) {
        uint32_t index = test_random_below(random, 2 * MODEL_FACES);
        if (!tl_halfedge_is_face(mesh, index)) {
            TEST_RESULT(tl_halfedge_mesh_remove_face(mesh, index), TL_ERR_STALE);
            seen->refused_removals++;
        }
        return;
    }
    uint32_t i = test_random_below(random, m->face_count);
    TEST_RESULT(tl_halfedge_mesh_remove_face(mesh, m->faces[i].index), TL_OK);
    m->faces[i] = m->faces[--m->face_count];
    seen->removed_faces++;
}

static void edit_vertices(model *m, tl_halfedge_mesh *mesh, test_random *random, edit_counts *seen)
{
    uint32_t v = test_random_below(random, MODEL_VERTICES);
    if (m->vertex_count < MODEL_VERTICES && test_random_below(random, 3) != 0) {
        uint32_t index;
        TEST_RESULT(tl_halfedge_mesh_add_vertex(mesh, tl_vec3_make(0, 0, 0), &index), TL_OK);
        TEST_CHECK(index < MODEL_VERTICES && !m->live[index]);
        m->live[index] = true;
        m->vertex_count++;
        return;
    }
    TEST_RESULT(tl_halfedge_mesh_remove_vertex(mesh, v), m->live[v] ? TL_OK : TL_ERR_STALE);
    if (!m->live[v]) {
        seen->refused_removals++;
        return;
    }
    m->live[v] = false;
    m->vertex_count--;
    seen->removed_vertices++;
    for (uint32_t f = m->face_count; f-- > 0;) {
        bool has = false;
        for (uint32_t i = 0; i < m->faces[f].count; i++) {
            has = has || m->faces[f].vertices[i] == v;
        }
        if (has) {
            m->faces[f] = m->faces[--m->face_count];
        }
    }
}

static void test_a_million_edits(void **state)
{
    (void)state;
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, &memory.allocator);
    static model m;
    memset(&m, 0, sizeof m);
    edit_counts seen;
    memset(&seen, 0, sizeof seen);
    test_random random = { 1 };
    uint32_t closed_fans = 0, fan_refusals = 0;
    for (uint32_t i = 0; i < 1000000; i++) {
        uint32_t kind = test_random_below(&random, 100);
        if (kind < 60) {
            edit_add_face(&m, &mesh, &random, &seen);
        } else if (kind < 90) {
            edit_remove_face(&m, &mesh, &random, &seen);
        } else {
            edit_vertices(&m, &mesh, &random, &seen);
        }
        if (i % 250 == 249) {
            model_compare(&m, &mesh);
            for (uint32_t v = 0; v < mesh.vertex_end; v++) {
                uint32_t ring[64], count = tl_halfedge_mesh_vertex_edges(&mesh, v, ring, 64), open = 0;
                for (uint32_t k = 0; k < count; k++) {
                    open += mesh.edges[ring[k]].face == TL_HALFEDGE_NONE;
                }
                closed_fans += count > 0 && open == 0;
            }
        }
        if (i % 100000 == 99999) {
            tl_halfedge_mesh_clear(&mesh);
            fan_refusals += m.fan_refusals;
            memset(&m, 0, sizeof m);
            seen.cleared++;
        }
    }
    // The pools follow the peak: what 24 vertices can carry, not what a million edits brought.
    TEST_CHECK(mesh.vertex_capacity <= 32 && mesh.edge_capacity <= 1024 && mesh.face_capacity <= 512);
    TEST_CHECK(seen.results[TL_OK] > 100000 && seen.results[TL_ERR_WINDING] > 10000 &&
               seen.results[TL_ERR_NON_MANIFOLD] > 10000 && seen.results[TL_ERR_STALE] > 10000 &&
               seen.results[TL_ERR_DEGENERATE] > 10000);
    print_message("%u closed fans seen, %u refused beside others\n", closed_fans, fan_refusals);
    TEST_CHECK(closed_fans > 1000 && fan_refusals > 1000);
    TEST_CHECK(seen.removed_faces > 100000 && seen.removed_vertices > 10000 && seen.refused_removals > 10000);
    tl_halfedge_mesh_destroy(&mesh);
    TEST_CHECK(memory.live_blocks == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_million_edits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
