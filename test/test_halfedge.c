// SPDX-License-Identifier: MIT
//
// The editable half-edge mesh: a million random edits against a plain model; each slip of the text's structure shown on
// a literal transcription of it, and absent here; refusals that change nothing; memory that runs out.

#include "talus_test.h"

#include "half_edge_text.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/halfedge.h>
#include <talus/hull.h>

#include <string.h>

// ---- a model: a list of faces, searched from end to end

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
            return TL_ERR_INDEX;
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

static void model_compare(const model *m, const tl_halfedge *mesh)
{
    TEST_RESULT(tl_halfedge_check(mesh), TL_OK);
    TEST_CHECK(mesh->face_count == m->face_count && mesh->vertex_count == m->vertex_count);
    uint32_t half_edges = 0, boundary = 0;
    for (uint32_t f = 0; f < m->face_count; f++) {
        const model_face *face = &m->faces[f];
        uint32_t loop[MODEL_CORNERS], shift = 0;
        TEST_CHECK(tl_halfedge_face_vertices(mesh, face->index, loop, MODEL_CORNERS) == face->count);
        while (shift < face->count && loop[shift] != face->vertices[0]) {
            shift++;
        }
        for (uint32_t i = 0; i < face->count; i++) {
            uint32_t a = face->vertices[i], b = face->vertices[(i + 1) % face->count];
            TEST_CHECK(loop[(i + shift) % face->count] == a);
            uint32_t edge = tl_halfedge_find_edge(mesh, a, b);
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
        in_rings += tl_halfedge_vertex_edges(mesh, v, NULL, 0);
    }
    for (uint32_t e = tl_halfedge_next_boundary_loop(mesh, 0); e != TL_HALFEDGE_NONE;
         e = tl_halfedge_next_boundary_loop(mesh, e + 1)) {
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

static void edit_add_face(model *m, tl_halfedge *mesh, test_random *random, edit_counts *seen)
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
        uint32_t e = tl_halfedge_next_boundary_loop(mesh, test_random_below(random, mesh->edge_end));
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
    tl_result result = tl_halfedge_add_face(mesh, vertices, count, &face);
    TEST_RESULT(result, expected);
    seen->results[result]++;
    if (result == TL_OK) {
        TEST_CHECK(tl_halfedge_is_face(mesh, face));
        m->faces[m->face_count - 1].index = face;
    }
}

static void edit_remove_face(model *m, tl_halfedge *mesh, test_random *random, edit_counts *seen)
{
    if (m->face_count == 0 || test_random_below(random, 10) == 0) {
        uint32_t index = test_random_below(random, 2 * MODEL_FACES);
        if (!tl_halfedge_is_face(mesh, index)) {
            TEST_RESULT(tl_halfedge_remove_face(mesh, index), TL_ERR_INDEX);
            seen->refused_removals++;
        }
        return;
    }
    uint32_t i = test_random_below(random, m->face_count);
    TEST_RESULT(tl_halfedge_remove_face(mesh, m->faces[i].index), TL_OK);
    m->faces[i] = m->faces[--m->face_count];
    seen->removed_faces++;
}

static void edit_vertices(model *m, tl_halfedge *mesh, test_random *random, edit_counts *seen)
{
    uint32_t v = test_random_below(random, MODEL_VERTICES);
    if (m->vertex_count < MODEL_VERTICES && test_random_below(random, 3) != 0) {
        uint32_t index;
        TEST_RESULT(tl_halfedge_add_vertex(mesh, tl_vec3_make(0, 0, 0), &index), TL_OK);
        TEST_CHECK(index < MODEL_VERTICES && !m->live[index]);
        m->live[index] = true;
        m->vertex_count++;
        return;
    }
    TEST_RESULT(tl_halfedge_remove_vertex(mesh, v), m->live[v] ? TL_OK : TL_ERR_INDEX);
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
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, &memory.allocator);
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
                uint32_t ring[64], count = tl_halfedge_vertex_edges(&mesh, v, ring, 64), open = 0;
                for (uint32_t k = 0; k < count; k++) {
                    open += mesh.edges[ring[k]].face == TL_HALFEDGE_NONE;
                }
                closed_fans += count > 0 && open == 0;
            }
        }
        if (i % 100000 == 99999) {
            tl_halfedge_clear(&mesh);
            fan_refusals += m.fan_refusals;
            memset(&m, 0, sizeof m);
            seen.cleared++;
        }
    }
    // The pools follow the peak: what 24 vertices can carry, not what a million edits brought.
    TEST_CHECK(mesh.vertex_capacity <= 32 && mesh.edge_capacity <= 1024 && mesh.face_capacity <= 512);
    TEST_CHECK(seen.results[TL_OK] > 100000 && seen.results[TL_ERR_WINDING] > 10000 &&
               seen.results[TL_ERR_NON_MANIFOLD] > 10000 && seen.results[TL_ERR_INDEX] > 10000 &&
               seen.results[TL_ERR_DEGENERATE] > 10000);
    print_message("%u closed fans seen, %u refused beside others\n", closed_fans, fan_refusals);
    TEST_CHECK(closed_fans > 1000 && fan_refusals > 1000);
    TEST_CHECK(seen.removed_faces > 100000 && seen.removed_vertices > 10000 && seen.refused_removals > 10000);
    tl_halfedge_free(&mesh);
    TEST_CHECK(memory.live_blocks == 0);
}

// ---- meshes to try things on

static void from_hull(tl_halfedge *mesh, text_mesh *text, uint32_t count, float size, bool triangulate)
{
    tl_vec3 points[600];
    test_random random = { 11 };
    shape_make(SHAPE_SPHERE, &random, points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(points[i], size);
    }
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    TEST_RESULT(tl_hull_build(points, count, &def, &hull, NULL), TL_OK);
    const tl_hull_half_edge *h = tl_hull_half_edges(hull);
    uint32_t unused;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TEST_RESULT(tl_halfedge_add_vertex(mesh, tl_hull_vertices(hull)[v], &unused), TL_OK);
        if (text != NULL) {
            text_add_vert(text, tl_hull_vertices(hull)[v]);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_faces(hull)[f];
        uint32_t loop[600];
        for (uint32_t k = 0; k < face.count; k++) {
            loop[k] = h[face.first + k].origin;
        }
        for (uint32_t k = 1; triangulate && k + 1 < face.count; k++) {
            TEST_RESULT(tl_halfedge_add_triangle(mesh, loop[0], loop[k], loop[k + 1], NULL), TL_OK);
            if (text != NULL) {
                text_add_face(text, (int)loop[0], (int)loop[k], (int)loop[k + 1]);
            }
        }
        if (!triangulate) {
            TEST_RESULT(tl_halfedge_add_face(mesh, loop, face.count, NULL), TL_OK);
        }
    }
    tl_blob_free(hull, NULL);
}

static bool is_farthest(const tl_halfedge *mesh, tl_vec3 d, uint32_t vertex)
{
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        if (tl_halfedge_is_vertex(mesh, v) && mesh->vertices[v].edge != TL_HALFEDGE_NONE &&
            tl_compare_along(d, mesh->vertices[v].position, mesh->vertices[vertex].position) > 0) {
            return false;
        }
    }
    return true;
}

static text_mesh text;

static void test_text_index_slip(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 200, 1.0f, true);
    test_random random = { 2 };
    uint32_t text_wrong = 0, text_mended_wrong = 0;
    for (int i = 0; i < 1000; i++) {
        tl_vec3 d = test_random_direction(&random);
        text_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, 0, 1e-6f, true));
        text_mended_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, 0, 1e-6f, false));
        TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_support(&mesh, d, 0)));
    }
    TEST_CHECK(text_wrong > 900 && text_mended_wrong < 10);
    tl_halfedge_free(&mesh);
}

static void test_text_absolute_epsilon(void **state)
{
    (void)state;
    static const float sizes[] = { 1e-4f, 1e-3f, 1e-15f, 1e15f };
    for (int s = 0; s < 4; s++) {
        tl_halfedge mesh;
        tl_halfedge_init(&mesh, NULL);
        text_init(&text);
        from_hull(&mesh, &text, 200, sizes[s], true);
        test_random random = { 3 };
        uint32_t text_wrong = 0;
        for (int i = 0; i < 1000; i++) {
            tl_vec3 d = test_random_direction(&random);
            uint32_t start = test_random_below(&random, mesh.vertex_end);
            text_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, (int)start, 1e-5f, false));
            TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_support(&mesh, d, start)));
        }
        TEST_CHECK(s >= 3 || text_wrong > 50);
        tl_halfedge_free(&mesh);
    }
}

static void test_text_remove_vertex_reads_cleared_links(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 50, 1.0f, true);
    uint32_t degree = tl_halfedge_vertex_edges(&mesh, 7, NULL, 0), faces = mesh.face_count;
    text_remove_vert(&text, 7);
    TEST_CHECK(text.bad_reads > 0 && text.num_faces > faces - degree);
    TEST_RESULT(tl_halfedge_remove_vertex(&mesh, 7), TL_OK);
    TEST_CHECK(mesh.face_count == faces - degree && mesh.boundary_count == degree);
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    TEST_RESULT(tl_halfedge_remove_vertex(&mesh, 7), TL_ERR_INDEX);
    tl_halfedge_free(&mesh);
}

static void test_text_live_edges_lose_their_vertex(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 50, 1.0f, true);
    text_remove_face(&text, 3);
    uint32_t lost = 0;
    for (int e = 0; e < text.edge_size; e++) {
        lost += text.edges[e + 1].active && text.edges[e + 1].vert < 0;
    }
    TEST_CHECK(lost == 3);
    TEST_RESULT(tl_halfedge_remove_face(&mesh, 3), TL_OK);
    for (uint32_t e = 0; e < mesh.edge_end; e++) {
        TEST_CHECK(!tl_halfedge_is_edge(&mesh, e) || tl_halfedge_is_vertex(&mesh, mesh.edges[e].vertex));
    }
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    tl_halfedge_free(&mesh);
}

static void test_text_boundary_has_no_next(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    text_init(&text);
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        tl_vec3 p = tl_vec3_make((float)(i & 1), 0, (float)(i >> 1));
        tl_halfedge_add_vertex(&mesh, p, &v[i]);
        text_add_vert(&text, p);
    }
    text_add_face(&text, 0, 1, 2);
    text_add_face(&text, 2, 1, 3);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 2, 1, 3, NULL), TL_OK);
    // The text's walk around vertex 1 runs off the boundary; here it meets all three edges.
    int e = text.verts[1 + 1].edge, steps = 0;
    do {
        e = text_edge_at(&text, text_edge_at(&text, e)->twin)->next;
        steps++;
    } while (e >= 0 && e != text.verts[1 + 1].edge);
    TEST_CHECK(e < 0);
    TEST_CHECK(tl_halfedge_vertex_edges(&mesh, 1, NULL, 0) == 3 && tl_halfedge_vertex_edges(&mesh, 0, NULL, 0) == 2);
    uint32_t hole = tl_halfedge_next_boundary_loop(&mesh, 0), length = 0, at = hole;
    do {
        length++;
        at = mesh.edges[at].next;
    } while (at != hole);
    TEST_CHECK(length == 4 && mesh.boundary_count == 4);
    tl_halfedge_free(&mesh);
}

static void test_text_boundary_count_is_not_cleared(void **state)
{
    (void)state;
    text_init(&text);
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    for (int round = 0; round < 2; round++) {
        uint32_t v;
        for (int i = 0; i < 3; i++) {
            tl_vec3 p = tl_vec3_make((float)i, (float)(i * i), 0);
            tl_halfedge_add_vertex(&mesh, p, &v);
            text_add_vert(&text, p);
        }
        text_add_face(&text, 0, 1, 2);
        TEST_RESULT(tl_halfedge_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
        TEST_CHECK(mesh.boundary_count == 3 && text.num_boundary_edges == (round == 0 ? 3u : 6u));
        text_clear(&text);
        tl_halfedge_clear(&mesh);
        TEST_CHECK(mesh.boundary_count == 0);
    }
    tl_halfedge_free(&mesh);
}

static void test_text_start_vertex_without_edges(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    text_init(&text);
    uint32_t isolated, removed;
    TEST_RESULT(tl_halfedge_add_vertex(&mesh, tl_vec3_make(0, 100, 0), &isolated), TL_OK);
    text_add_vert(&text, tl_vec3_make(0, 100, 0));
    // Vertices 1 .. are the hull's; in the transcription their indices would be off by one, so it gets one triangle.
    text_add_vert(&text, tl_vec3_make(1, 0, 0));
    text_add_vert(&text, tl_vec3_make(0, 0, 1));
    text_add_vert(&text, tl_vec3_make(0, 1, 0));
    text_add_face(&text, 1, 2, 3);
    text_support(&text, tl_vec3_make(0, 1, 0), 0, 1e-6f, false);
    TEST_CHECK(text.bad_reads > 0);

    tl_vec3 corners[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        tl_halfedge_add_vertex(&mesh, corners[i], &v[i]);
    }
    tl_halfedge_add_vertex(&mesh, tl_vec3_make(0, 50, 0), &removed);
    tl_halfedge_remove_vertex(&mesh, removed);
    // Without faces all vertices count.
    TEST_CHECK(tl_halfedge_support(&mesh, tl_vec3_make(0, 1, 0), 3) == isolated);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, v[0], v[2], v[1], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, v[0], v[1], v[3], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, v[0], v[3], v[2], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, v[1], v[2], v[3], NULL), TL_OK);
    const uint32_t hints[] = { isolated, removed, v[0], 77, TL_HALFEDGE_NONE };
    for (int i = 0; i < 5; i++) {
        TEST_CHECK(tl_halfedge_support(&mesh, tl_vec3_make(0, 1, 0), hints[i]) == v[2]);
    }
    tl_halfedge empty;
    tl_halfedge_init(&empty, NULL);
    TEST_CHECK(tl_halfedge_support(&empty, tl_vec3_make(0, 1, 0), 0) == TL_HALFEDGE_NONE);
    tl_halfedge_free(&empty);
    tl_halfedge_free(&mesh);
}

static void test_text_reused_twin_and_second_face(void **state)
{
    (void)state;
    // The text accepts a second face on the same directed edge and destroys the first one's loop.
    text_init(&text);
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    uint32_t v;
    for (int i = 0; i < 6; i++) {
        tl_vec3 p = tl_vec3_make((float)i, (float)(i * i), (float)(i % 2));
        tl_halfedge_add_vertex(&mesh, p, &v);
        text_add_vert(&text, p);
    }
    int first = text_add_face(&text, 0, 1, 2);
    text_add_face(&text, 0, 1, 3);
    int e = text.faces[first + 1].edge;
    for (int i = 0; i < 3; i++) {
        e = text.edges[e + 1].next;
    }
    TEST_CHECK(e != text.faces[first + 1].edge);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 0, 1, 3, NULL), TL_ERR_WINDING);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 1, 0, 3, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 0, 1, 4, NULL), TL_ERR_NON_MANIFOLD);
    TEST_CHECK(mesh.face_count == 2 && mesh.half_edge_count == 10);
    // A twin whose edge was freed keeps the text's stale vertex when it is used again.
    text_init(&text);
    for (int i = 0; i < 6; i++) {
        text_add_vert(&text, tl_vec3_make((float)i, 0, 0));
    }
    text_remove_face(&text, text_add_face(&text, 0, 1, 2));
    text_add_face(&text, 3, 4, 5);
    uint32_t stale = 0;
    for (int i = 0; i < text.map_size; i++) {
        stale += text.edges[text.map[i].edge + 1].vert != text.map[i].v1;
    }
    TEST_CHECK(stale > 0);
    TEST_RESULT(tl_halfedge_remove_face(&mesh, 0), TL_OK);
    TEST_RESULT(tl_halfedge_remove_face(&mesh, 0), TL_ERR_INDEX);
    TEST_RESULT(tl_halfedge_add_triangle(&mesh, 3, 4, 5, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    tl_halfedge_free(&mesh);
}

static void test_support_on_flat_faces(void **state)
{
    (void)state;
    // A cube whose faces are grids of triangles: most vertices lie within flat faces or on straight edges, where a
    // climb against the face's normal finds nothing but level neighbours.
    enum { SIDE = 5 };
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    static uint32_t at[SIDE][SIDE][SIDE];
    for (int x = 0; x < SIDE; x++) {
        for (int y = 0; y < SIDE; y++) {
            for (int z = 0; z < SIDE; z++) {
                if (x % (SIDE - 1) == 0 || y % (SIDE - 1) == 0 || z % (SIDE - 1) == 0) {
                    tl_halfedge_add_vertex(&mesh, tl_vec3_make((float)x, (float)y, (float)z), &at[x][y][z]);
                }
            }
        }
    }
    for (int side = 0; side < 6; side++) {
        int axis = side / 2, level = side % 2 ? SIDE - 1 : 0;
        for (int i = 0; i + 1 < SIDE; i++) {
            for (int j = 0; j + 1 < SIDE; j++) {
                uint32_t quad[4];
                for (int k = 0; k < 4; k++) {
                    int u = i + (k == 1 || k == 2), w = j + (k >= 2), c[3];
                    c[axis] = level;
                    c[(axis + 1) % 3] = u;
                    c[(axis + 2) % 3] = w;
                    quad[side % 2 ? k : 3 - k] = at[c[0]][c[1]][c[2]];
                }
                if ((i + j) % 2) {
                    TEST_RESULT(tl_halfedge_add_face(&mesh, quad, 4, NULL), TL_OK);
                } else {
                    TEST_RESULT(tl_halfedge_add_triangle(&mesh, quad[0], quad[1], quad[2], NULL), TL_OK);
                    TEST_RESULT(tl_halfedge_add_triangle(&mesh, quad[0], quad[2], quad[3], NULL), TL_OK);
                }
            }
        }
    }
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    TEST_CHECK(mesh.boundary_count == 0);
    TEST_CHECK((int64_t)mesh.vertex_count - mesh.half_edge_count / 2 + mesh.face_count == 2);
    test_random random = { 4 };
    for (uint32_t hint = 0; hint < mesh.vertex_end; hint++) {
        for (int i = 0; i < 40; i++) {
            tl_vec3 d = test_random_direction(&random);
            if (i % 2 == 0) {
                d = tl_vec3_make(rintf(d.x), rintf(d.y), rintf(d.z));
            }
            TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_support(&mesh, d, hint)));
        }
    }
    tl_halfedge_free(&mesh);
}

static void test_memory_runs_out(void **state)
{
    (void)state;
    for (uint64_t k = 1; k < 40; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_halfedge mesh;
        tl_halfedge_init(&mesh, &memory.allocator);
        uint32_t v, failures = 0;
        // A strip of triangles; whatever fails leaves what was there.
        for (uint32_t i = 0; i < 3000; i++) {
            uint32_t before = mesh.vertex_count;
            tl_result result = tl_halfedge_add_vertex(&mesh, tl_vec3_make((float)i, 0, 0), &v);
            TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && mesh.vertex_count == before));
            if (result == TL_OK && v >= 2) {
                uint32_t faces = mesh.face_count;
                bool odd = v % 2 != 0;
                // After a failed face the next may touch others by a vertex only: still manifold.
                result = tl_halfedge_add_triangle(&mesh, odd ? v - 1 : v - 2, odd ? v - 2 : v - 1, v, NULL);
                TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
                TEST_CHECK(mesh.face_count == faces + (result == TL_OK));
            }
            failures += result != TL_OK;
        }
        memory.fail_at = 0;
        TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
        TEST_CHECK(failures > 0 || k > 15);
        memory.fail_at = 1;
        memory.calls = 0;
        TEST_RESULT(tl_halfedge_check(&mesh), TL_ERR_MEMORY);
        tl_halfedge_free(&mesh);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
}

static void test_check_sees_damage(void **state)
{
    (void)state;
    tl_halfedge mesh;
    tl_halfedge_init(&mesh, NULL);
    from_hull(&mesh, NULL, 40, 1.0f, false);
    tl_halfedge_remove_face(&mesh, 5);
    tl_halfedge_remove_vertex(&mesh, 9);
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    test_random random = { 8 };
    uint32_t found = 0;
    for (int i = 0; i < 3000; i++) {
        uint32_t *words = i % 3 == 0 ? (uint32_t *)(void *)&mesh.edges[test_random_below(&random, mesh.edge_end)]
                          : i % 3 == 1
                              ? (uint32_t *)(void *)&mesh.faces[test_random_below(&random, mesh.face_end)]
                              : (uint32_t *)(void *)&mesh.vertices[test_random_below(&random, mesh.vertex_end)] + 3;
        uint32_t *word = &words[test_random_below(&random, i % 3 == 0 ? 4 : 2)];
        uint32_t kept = *word;
        *word = i % 2 ? test_random_below(&random, 90) : (uint32_t)test_random_u64(&random);
        found += *word != kept && tl_halfedge_check(&mesh) == TL_ERR_CORRUPT;
        *word = kept;
    }
    // What is not seen is another edge of the same face or vertex, which is no damage, and fields of free entries.
    TEST_CHECK(found > 2500);
    TEST_RESULT(tl_halfedge_check(&mesh), TL_OK);
    tl_halfedge_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_million_edits),
        cmocka_unit_test(test_text_index_slip),
        cmocka_unit_test(test_text_absolute_epsilon),
        cmocka_unit_test(test_text_remove_vertex_reads_cleared_links),
        cmocka_unit_test(test_text_live_edges_lose_their_vertex),
        cmocka_unit_test(test_text_boundary_has_no_next),
        cmocka_unit_test(test_text_boundary_count_is_not_cleared),
        cmocka_unit_test(test_text_start_vertex_without_edges),
        cmocka_unit_test(test_text_reused_twin_and_second_face),
        cmocka_unit_test(test_support_on_flat_faces),
        cmocka_unit_test(test_memory_runs_out),
        cmocka_unit_test(test_check_sees_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
