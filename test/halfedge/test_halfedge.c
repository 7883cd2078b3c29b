// SPDX-License-Identifier: MIT
//
// The editable half-edge mesh: each slip of the text's structure shown on a literal transcription of it, and absent
// here; support on flat faces; damage that the check sees; memory that runs out.

#include "talus_test.h"

#include "half_edge_text.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/halfedge.h>
#include <talus/hull.h>

#include <string.h>

static void from_hull(tl_halfedge_mesh *mesh, text_mesh *text, uint32_t count, float size, bool triangulate)
{
    tl_vec3 points[600];
    test_random random = { 11 };
    shape_make(SHAPE_SPHERE, &random, points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(points[i], size);
    }
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, &def, &hull, NULL), TL_OK);
    if (!triangulate) {
        TEST_RESULT(tl_hull_to_halfedge(hull, mesh), TL_OK);
        tl_blob_free(hull);
        return;
    }
    uint32_t unused;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TEST_RESULT(tl_halfedge_mesh_add_vertex(mesh, tl_hull_vertices(hull)[v], &unused), TL_OK);
        if (text != NULL) {
            text_add_vert(text, tl_hull_vertices(hull)[v]);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t k = 1; k + 1 < face.count; k++) {
            uint32_t a = tl_hull_edge_origin(hull, face.first), b = tl_hull_edge_origin(hull, face.first + k);
            uint32_t c = tl_hull_edge_origin(hull, face.first + k + 1);
            TEST_RESULT(tl_halfedge_mesh_add_triangle(mesh, a, b, c, NULL), TL_OK);
            if (text != NULL) {
                text_add_face(text, (int)a, (int)b, (int)c);
            }
        }
    }
    tl_blob_free(hull);
}

static bool is_farthest(const tl_halfedge_mesh *mesh, tl_vec3 d, uint32_t vertex)
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
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 200, 1.0f, true);
    test_random random = { 2 };
    uint32_t text_wrong = 0, text_mended_wrong = 0;
    for (int i = 0; i < 1000; i++) {
        tl_vec3 d = test_random_direction(&random);
        text_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, 0, 1e-6f, true));
        text_mended_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, 0, 1e-6f, false));
        TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_mesh_support(&mesh, d, 0)));
    }
    TEST_CHECK(text_wrong > 900 && text_mended_wrong < 10);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_absolute_epsilon(void **state)
{
    (void)state;
    static const float sizes[] = { 1e-4f, 1e-3f, 1e-15f, 1e15f };
    for (int s = 0; s < 4; s++) {
        tl_halfedge_mesh mesh;
        tl_halfedge_mesh_init(&mesh, NULL);
        text_init(&text);
        from_hull(&mesh, &text, 200, sizes[s], true);
        test_random random = { 3 };
        uint32_t text_wrong = 0;
        for (int i = 0; i < 1000; i++) {
            tl_vec3 d = test_random_direction(&random);
            uint32_t start = test_random_below(&random, mesh.vertex_end);
            text_wrong += !is_farthest(&mesh, d, (uint32_t)text_support(&text, d, (int)start, 1e-5f, false));
            TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_mesh_support(&mesh, d, start)));
        }
        TEST_CHECK(s >= 3 || text_wrong > 50);
        tl_halfedge_mesh_destroy(&mesh);
    }
}

static void test_text_remove_vertex_reads_cleared_links(void **state)
{
    (void)state;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 50, 1.0f, true);
    uint32_t degree = tl_halfedge_mesh_vertex_edges(&mesh, 7, NULL, 0), faces = mesh.face_count;
    text_remove_vert(&text, 7);
    TEST_CHECK(text.bad_reads > 0 && text.num_faces > faces - degree);
    TEST_RESULT(tl_halfedge_mesh_remove_vertex(&mesh, 7), TL_OK);
    TEST_CHECK(mesh.face_count == faces - degree && mesh.boundary_count == degree);
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_remove_vertex(&mesh, 7), TL_ERR_STALE);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_live_edges_lose_their_vertex(void **state)
{
    (void)state;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    text_init(&text);
    from_hull(&mesh, &text, 50, 1.0f, true);
    text_remove_face(&text, 3);
    uint32_t lost = 0;
    for (int e = 0; e < text.edge_size; e++) {
        lost += text.edges[e + 1].active && text.edges[e + 1].vert < 0;
    }
    TEST_CHECK(lost == 3);
    TEST_RESULT(tl_halfedge_mesh_remove_face(&mesh, 3), TL_OK);
    for (uint32_t e = 0; e < mesh.edge_end; e++) {
        TEST_CHECK(!tl_halfedge_is_edge(&mesh, e) || tl_halfedge_is_vertex(&mesh, mesh.edges[e].vertex));
    }
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_boundary_has_no_next(void **state)
{
    (void)state;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    text_init(&text);
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        tl_vec3 p = tl_vec3_make((float)(i & 1), 0, (float)(i >> 1));
        tl_halfedge_mesh_add_vertex(&mesh, p, &v[i]);
        text_add_vert(&text, p);
    }
    text_add_face(&text, 0, 1, 2);
    text_add_face(&text, 2, 1, 3);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 2, 1, 3, NULL), TL_OK);
    // The text's walk around vertex 1 runs off the boundary; here it meets all three edges.
    int e = text.verts[1 + 1].edge, steps = 0;
    do {
        e = text_edge_at(&text, text_edge_at(&text, e)->twin)->next;
        steps++;
    } while (e >= 0 && e != text.verts[1 + 1].edge);
    TEST_CHECK(e < 0);
    TEST_CHECK(tl_halfedge_mesh_vertex_edges(&mesh, 1, NULL, 0) == 3 &&
               tl_halfedge_mesh_vertex_edges(&mesh, 0, NULL, 0) == 2);
    uint32_t hole = tl_halfedge_mesh_next_boundary_loop(&mesh, 0), length = 0, at = hole;
    do {
        length++;
        at = mesh.edges[at].next;
    } while (at != hole);
    TEST_CHECK(length == 4 && mesh.boundary_count == 4);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_boundary_count_is_not_cleared(void **state)
{
    (void)state;
    text_init(&text);
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    for (int round = 0; round < 2; round++) {
        uint32_t v;
        for (int i = 0; i < 3; i++) {
            tl_vec3 p = tl_vec3_make((float)i, (float)(i * i), 0);
            tl_halfedge_mesh_add_vertex(&mesh, p, &v);
            text_add_vert(&text, p);
        }
        text_add_face(&text, 0, 1, 2);
        TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
        TEST_CHECK(mesh.boundary_count == 3 && text.num_boundary_edges == (round == 0 ? 3u : 6u));
        text_clear(&text);
        tl_halfedge_mesh_clear(&mesh);
        TEST_CHECK(mesh.boundary_count == 0);
    }
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_start_vertex_without_edges(void **state)
{
    (void)state;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    text_init(&text);
    uint32_t isolated, removed;
    TEST_RESULT(tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make(0, 100, 0), &isolated), TL_OK);
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
        tl_halfedge_mesh_add_vertex(&mesh, corners[i], &v[i]);
    }
    tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make(0, 50, 0), &removed);
    tl_halfedge_mesh_remove_vertex(&mesh, removed);
    // Without faces all vertices count.
    TEST_CHECK(tl_halfedge_mesh_support(&mesh, tl_vec3_make(0, 1, 0), 3) == isolated);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, v[0], v[2], v[1], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, v[0], v[1], v[3], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, v[0], v[3], v[2], NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, v[1], v[2], v[3], NULL), TL_OK);
    const uint32_t hints[] = { isolated, removed, v[0], 77, TL_HALFEDGE_NONE };
    for (int i = 0; i < 5; i++) {
        TEST_CHECK(tl_halfedge_mesh_support(&mesh, tl_vec3_make(0, 1, 0), hints[i]) == v[2]);
    }
    tl_halfedge_mesh empty;
    tl_halfedge_mesh_init(&empty, NULL);
    TEST_CHECK(tl_halfedge_mesh_support(&empty, tl_vec3_make(0, 1, 0), 0) == TL_HALFEDGE_NONE);
    tl_halfedge_mesh_destroy(&empty);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_text_reused_twin_and_second_face(void **state)
{
    (void)state;
    // The text accepts a second face on the same directed edge and destroys the first one's loop.
    text_init(&text);
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    uint32_t v;
    for (int i = 0; i < 6; i++) {
        tl_vec3 p = tl_vec3_make((float)i, (float)(i * i), (float)(i % 2));
        tl_halfedge_mesh_add_vertex(&mesh, p, &v);
        text_add_vert(&text, p);
    }
    int first = text_add_face(&text, 0, 1, 2);
    text_add_face(&text, 0, 1, 3);
    int e = text.faces[first + 1].edge;
    for (int i = 0; i < 3; i++) {
        e = text.edges[e + 1].next;
    }
    TEST_CHECK(e != text.faces[first + 1].edge);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 0, 1, 2, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 0, 1, 3, NULL), TL_ERR_WINDING);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 1, 0, 3, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 0, 1, 4, NULL), TL_ERR_NON_MANIFOLD);
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
    TEST_RESULT(tl_halfedge_mesh_remove_face(&mesh, 0), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_remove_face(&mesh, 0), TL_ERR_STALE);
    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, 3, 4, 5, NULL), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    tl_halfedge_mesh_destroy(&mesh);
}

// A drum, whose two large faces have more corners than a new face remembers the edges of.
static void test_rings_of_large_faces(void **state)
{
    (void)state;
    enum { RING = 150 };
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    uint32_t lower[RING], upper[RING], turned[RING], list[RING], v;
    for (uint32_t i = 0; i < RING; i++) {
        tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make((float)i, 0.0f, 0.0f), &lower[i]);
    }
    for (uint32_t i = 0; i < RING; i++) {
        tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make((float)i, 1.0f, 0.0f), &upper[i]);
        turned[RING - 1 - i] = upper[i];
    }
    TEST_RESULT(tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make(0.0f, 2.0f, 0.0f), &v), TL_OK);
    uint32_t bottom, top;
    TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, lower, RING, &bottom), TL_OK);
    for (uint32_t i = 0; i < RING; i += 2) {
        uint32_t j = (i + 1) % RING, side[4] = { lower[j], lower[i], upper[i], upper[j] };
        TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, side, 4, NULL), TL_OK);
    }
    // Every second side is there: half of the lid's edges are found, half are new.
    TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, upper, RING, NULL), TL_ERR_WINDING);
    TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, turned, RING, &top), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    TEST_CHECK(mesh.boundary_count == 2 * RING && tl_halfedge_mesh_face_vertices(&mesh, top, NULL, 0) == RING);
    for (uint32_t i = 1; i < RING; i += 2) {
        uint32_t j = (i + 1) % RING, side[4] = { lower[j], lower[i], upper[i], upper[j] };
        TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, side, 4, NULL), TL_OK);
    }
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    TEST_CHECK(mesh.boundary_count == 0 && mesh.half_edge_count == 6 * RING);
    TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, turned, RING, NULL), TL_ERR_NON_MANIFOLD);
    // Around each vertex: three neighbours and three faces, each of which has it.
    for (uint32_t i = 0; i < RING; i++) {
        uint32_t faces[3], around[3];
        TEST_CHECK(tl_halfedge_mesh_vertex_neighbours(&mesh, lower[i], around, 3) == 3);
        TEST_CHECK(tl_halfedge_mesh_vertex_faces(&mesh, lower[i], faces, 3) == 3);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t edge = tl_halfedge_mesh_find_edge(&mesh, lower[i], around[k]);
            TEST_CHECK(edge != TL_HALFEDGE_NONE && tl_halfedge_left_face(&mesh, edge) == faces[k]);
            TEST_CHECK(tl_halfedge_prev(&mesh, tl_halfedge_next(&mesh, edge)) == edge);
            TEST_CHECK(around[k] == upper[i] || faces[k] == bottom ||
                       tl_halfedge_left_face(&mesh, tl_halfedge_twin(edge)) == bottom);
        }
    }
    TEST_RESULT(tl_halfedge_mesh_remove_face(&mesh, top), TL_OK);
    TEST_CHECK(tl_halfedge_mesh_vertex_faces(&mesh, upper[7], list, 1) == 2);
    TEST_CHECK(tl_halfedge_mesh_vertex_neighbours(&mesh, upper[7], list, RING) == 3);
    TEST_CHECK(tl_halfedge_mesh_vertex_faces(&mesh, v, list, RING) == 0);
    TEST_CHECK(tl_halfedge_mesh_vertex_neighbours(&mesh, v, list, RING) == 0);
    TEST_CHECK(tl_halfedge_mesh_vertex_faces(&mesh, 100000, list, RING) == 0);
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_a_hull_can_be_edited(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        tl_vec3 points[200];
        test_random random = { (uint64_t)kind };
        shape_make((shape_kind)kind, &random, points, 200);
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 200, NULL, &hull, NULL), TL_OK);
        uint64_t failures = 0;
        for (uint64_t k = 1;; k++) {
            test_allocator memory;
            test_allocator_init(&memory, k);
            tl_halfedge_mesh mesh;
            tl_halfedge_mesh_init(&mesh, &memory.allocator);
            tl_result result = tl_hull_to_halfedge(hull, &mesh);
            if (result != TL_OK) {
                TEST_RESULT(result, TL_ERR_MEMORY);
                TEST_CHECK(mesh.vertex_count == 0 && mesh.half_edge_count == 0);
                tl_halfedge_mesh_destroy(&mesh);
                TEST_CHECK(memory.live_blocks == 0);
                failures++;
                continue;
            }
            memory.fail_at = 0;
            TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
            TEST_CHECK(mesh.boundary_count == 0 && mesh.half_edge_count == hull->half_edge_count);
            for (uint32_t e = 0; e < hull->half_edge_count; e++) {
                const tl_hull_half_edge h = tl_hull_edge_at(hull, e);
                uint32_t edge = tl_halfedge_mesh_find_edge(&mesh, h.origin, tl_hull_edge_origin(hull, h.next));
                TEST_CHECK(edge != TL_HALFEDGE_NONE && tl_halfedge_left_face(&mesh, edge) == h.face);
            }
            for (int i = 0; i < 50; i++) {
                tl_vec3 d = test_random_direction(&random);
                uint32_t a = tl_halfedge_mesh_support(&mesh, d, 0), b = tl_hull_support(hull, d, TL_NO_VERTEX);
                TEST_CHECK(tl_compare_along(d, mesh.vertices[a].position, tl_hull_vertices(hull)[b]) == 0);
            }
            // Without its first corner it is open there, and still a mesh.
            uint32_t degree = tl_halfedge_mesh_vertex_edges(&mesh, 0, NULL, 0);
            TEST_RESULT(tl_halfedge_mesh_remove_vertex(&mesh, 0), TL_OK);
            TEST_CHECK(mesh.face_count == hull->face_count - degree && mesh.boundary_count >= 3);
            TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
            tl_halfedge_mesh_destroy(&mesh);
            TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
            break;
        }
        TEST_CHECK(failures >= 4);
        tl_blob_free(hull);
    }
}

static void test_support_on_flat_faces(void **state)
{
    (void)state;
    // A cube whose faces are grids of triangles: most vertices lie within flat faces or on straight edges, where a
    // climb against the face's normal finds nothing but level neighbours.
    enum { SIDE = 5 };
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    static uint32_t at[SIDE][SIDE][SIDE];
    for (int x = 0; x < SIDE; x++) {
        for (int y = 0; y < SIDE; y++) {
            for (int z = 0; z < SIDE; z++) {
                if (x % (SIDE - 1) == 0 || y % (SIDE - 1) == 0 || z % (SIDE - 1) == 0) {
                    tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make((float)x, (float)y, (float)z), &at[x][y][z]);
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
                    TEST_RESULT(tl_halfedge_mesh_add_face(&mesh, quad, 4, NULL), TL_OK);
                } else {
                    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, quad[0], quad[1], quad[2], NULL), TL_OK);
                    TEST_RESULT(tl_halfedge_mesh_add_triangle(&mesh, quad[0], quad[2], quad[3], NULL), TL_OK);
                }
            }
        }
    }
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    TEST_CHECK(mesh.boundary_count == 0);
    TEST_CHECK((int64_t)mesh.vertex_count - mesh.half_edge_count / 2 + mesh.face_count == 2);
    test_random random = { 4 };
    for (uint32_t hint = 0; hint < mesh.vertex_end; hint++) {
        for (int i = 0; i < 40; i++) {
            tl_vec3 d = test_random_direction(&random);
            if (i % 2 == 0) {
                d = tl_vec3_make(rintf(d.x), rintf(d.y), rintf(d.z));
            }
            TEST_CHECK(is_farthest(&mesh, d, tl_halfedge_mesh_support(&mesh, d, hint)));
        }
    }
    tl_halfedge_mesh_destroy(&mesh);
}

static void test_memory_runs_out(void **state)
{
    (void)state;
    for (uint64_t k = 1; k < 40; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_halfedge_mesh mesh;
        tl_halfedge_mesh_init(&mesh, &memory.allocator);
        uint32_t v, failures = 0;
        // A strip of triangles; whatever fails leaves what was there.
        for (uint32_t i = 0; i < 3000; i++) {
            uint32_t before = mesh.vertex_count;
            tl_result result = tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make((float)i, 0, 0), &v);
            TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && mesh.vertex_count == before));
            if (result == TL_OK && v >= 2) {
                uint32_t faces = mesh.face_count;
                bool odd = v % 2 != 0;
                // After a failed face the next may touch others by a vertex only: still manifold.
                result = tl_halfedge_mesh_add_triangle(&mesh, odd ? v - 1 : v - 2, odd ? v - 2 : v - 1, v, NULL);
                TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
                TEST_CHECK(mesh.face_count == faces + (result == TL_OK));
            }
            failures += result != TL_OK;
        }
        memory.fail_at = 0;
        TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
        TEST_CHECK(failures > 0 || k > 15);
        memory.fail_at = 1;
        memory.calls = 0;
        TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_ERR_MEMORY);
        tl_halfedge_mesh_destroy(&mesh);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
}

static void test_check_sees_damage(void **state)
{
    (void)state;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    from_hull(&mesh, NULL, 40, 1.0f, false);
    tl_halfedge_mesh_remove_face(&mesh, 5);
    tl_halfedge_mesh_remove_vertex(&mesh, 9);
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
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
        found += *word != kept && tl_halfedge_mesh_check(&mesh, NULL) == TL_ERR_CORRUPT;
        *word = kept;
    }
    // What is not seen is another edge of the same face or vertex, which is no damage, and fields of free entries.
    TEST_CHECK(found > 2500);
    TEST_RESULT(tl_halfedge_mesh_check(&mesh, NULL), TL_OK);
    tl_halfedge_mesh_destroy(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_index_slip),
        cmocka_unit_test(test_text_absolute_epsilon),
        cmocka_unit_test(test_text_remove_vertex_reads_cleared_links),
        cmocka_unit_test(test_text_live_edges_lose_their_vertex),
        cmocka_unit_test(test_text_boundary_has_no_next),
        cmocka_unit_test(test_text_boundary_count_is_not_cleared),
        cmocka_unit_test(test_text_start_vertex_without_edges),
        cmocka_unit_test(test_text_reused_twin_and_second_face),
        cmocka_unit_test(test_rings_of_large_faces),
        cmocka_unit_test(test_a_hull_can_be_edited),
        cmocka_unit_test(test_support_on_flat_faces),
        cmocka_unit_test(test_memory_runs_out),
        cmocka_unit_test(test_check_sees_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
