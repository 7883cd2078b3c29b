// SPDX-License-Identifier: MIT
//
// Hulls with their support tables, half-edge meshes, pairs of convex shapes, and contours to polygons.

#include "golden.h"

#include <string.h>

enum { POINTS = 600 };

/// Points in a ball, on a lattice, or on a curved slab, which gives thin faces.
static void cloud_of(uint32_t kind, tl_vec3 *points)
{
    const tl_aabb box = { { -1, -1, -1 }, { 1, 1, 1 } };
    dice random = { 100 + kind };
    for (uint32_t i = 0; i < POINTS; i++) {
        const tl_vec3 p = roll_in_box(&random, box);
        if (kind == 0) {
            points[i] = tl_scale(tl_normalize(p), 2.0f);
        } else if (kind == 1) {
            points[i] = tl_vec3_make((float)(i % 9) - 4, (float)(i / 9 % 9) - 4, (float)(i / 81));
        } else {
            points[i] = tl_vec3_make(8 * p.x, 0.125f * p.x * p.x + 0.03125f * p.y, 3 * p.z);
        }
    }
}

static void digest_half_edges(digest *d, const tl_hull *hull)
{
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    MUST(tl_hull_to_halfedge(hull, &mesh));
    MUST(tl_halfedge_mesh_check(&mesh, NULL));
    for (uint32_t i = 0; i < mesh.vertex_end; i++) {
        digest_vec3(d, mesh.vertices[i].position);
        digest_u32(d, mesh.vertices[i].edge);
    }
    for (uint32_t i = 0; i < mesh.edge_end; i++) {
        digest_u32(d, mesh.edges[i].vertex);
        digest_u32(d, mesh.edges[i].face);
        digest_u32(d, mesh.edges[i].next);
    }
    dice random = { 11 };
    const tl_aabb box = { { -1, -1, -1 }, { 1, 1, 1 } };
    for (int i = 0; i < 50; i++) {
        digest_u32(d, tl_halfedge_mesh_support(&mesh, roll_in_box(&random, box), TL_NO_VERTEX));
    }
    d->found += mesh.half_edge_count;
    tl_halfedge_mesh_destroy(&mesh);
}

static void answer_hull(digest *d, const tl_hull *hull)
{
    dice random = { 12 };
    const tl_aabb box = { { -5, -5, -5 }, { 5, 5, 5 } };
    for (uint32_t i = 0; i < 500; i++) {
        const tl_vec3 direction = roll_in_box(&random, box);
        digest_u32(d, tl_hull_support(hull, direction, i % 5 != 0 ? TL_NO_VERTEX : roll(&random, hull->vertex_count)));
        const tl_vec3 from = roll_in_box(&random, box);
        tl_hull_hit hit;
        if (digest_found(d, tl_hull_cast_ray(hull, from, tl_neg(from), 4, &hit))) {
            digest_f32(d, hit.t);
            digest_u32(d, hit.face);
            digest_vec3(d, hit.normal);
        }
        digest_found(d, tl_hull_contains(hull, tl_scale(from, 0.25f)));
    }
}

void golden_hulls(void)
{
    digest blobs = digest_begin(), edges = digest_begin(), answers = digest_begin();
    for (uint32_t kind = 0; kind < 3; kind++) {
        tl_vec3 points[POINTS];
        cloud_of(kind, points);
        for (int limited = 0; limited < 2; limited++) {
            tl_hull_def def = tl_default_hull_def();
            def.max_vertices = limited != 0 ? 32 : def.max_vertices;
            tl_hull *hull, *turned;
            MUST(tl_hull_bake(points, POINTS, &def, &hull, NULL));
            MUST(tl_hull_check(hull, hull->blob.size, NULL));
            const tl_transform pose = { { 0.5f, -0.5f, 0.5f, 0.5f }, { 3, 2, 1 } };
            MUST(tl_hull_transform(hull, tl_vec3_make(2, 1, 0.5f), pose, NULL, &turned, NULL));
            digest_blob(&blobs, hull);
            digest_blob(&blobs, turned);
            digest_half_edges(&edges, hull);
            answer_hull(&answers, hull);
            tl_blob_free(turned);
            tl_blob_free(hull);
        }
    }
    digest_print(&blobs, "hull", "blob");
    digest_print(&edges, "hull", "half-edges");
    digest_print(&answers, "hull", "answers");
}

typedef struct pair_digests {
    digest distance, depth, cast, contacts;
} pair_digests;

static void answer_pair(pair_digests *d, const tl_convex *a, tl_transform pose_a, const tl_convex *b,
                        tl_transform pose_b)
{
    tl_separation apart;
    tl_convex_distance(a, pose_a, b, pose_b, NULL, &apart);
    digest_found(&d->distance, !apart.overlap);
    digest_f32(&d->distance, apart.distance);
    digest_f32(&d->distance, apart.lower_bound);
    digest_vec3(&d->distance, apart.point_a);
    digest_vec3(&d->distance, apart.point_b);
    digest_vec3(&d->distance, apart.normal);
    digest_u32(&d->distance, apart.iterations);
    tl_penetration deep;
    if (digest_found(&d->depth, tl_convex_penetration(a, pose_a, b, pose_b, NULL, &deep))) {
        digest_f32(&d->depth, deep.depth);
        digest_f32(&d->depth, deep.upper_bound);
        digest_vec3(&d->depth, deep.normal);
        digest_vec3(&d->depth, deep.point_a);
        digest_u32(&d->depth, deep.iterations);
    }
    tl_convex_hit hit;
    if (digest_found(&d->cast, tl_convex_cast(a, pose_a, b, pose_b, tl_sub(pose_b.position, pose_a.position), &hit))) {
        digest_f32(&d->cast, hit.t);
        digest_vec3(&d->cast, hit.point);
        digest_vec3(&d->cast, hit.normal);
    }
    const tl_contact_limits limits = { 0.0625f, 0.015625f, 0 };
    tl_contact_manifold manifold;
    if (digest_found(&d->contacts, tl_convex_contacts(a, pose_a, b, pose_b, &limits, NULL, &manifold) > 0)) {
        digest_vec3(&d->contacts, manifold.normal);
        for (uint32_t k = 0; k < manifold.count; k++) {
            digest_vec3(&d->contacts, manifold.contacts[k].point_a);
            digest_f32(&d->contacts, manifold.contacts[k].separation);
        }
    }
}

void golden_pairs(void)
{
    tl_vec3 points[POINTS];
    cloud_of(0, points);
    tl_hull *hull;
    MUST(tl_hull_bake(points, POINTS, NULL, &hull, NULL));
    const tl_vec3 o = { 0, 0, 0 }, low = { 0, -1, 0 }, high = { 0, 1, 0 };
    const tl_convex shapes[] = {
        tl_convex_from_hull(hull, 0),
        tl_convex_from_hull(hull, 0.25f),
        tl_convex_sphere(o, 1),
        tl_convex_capsule(low, high, 0.5f),
        tl_convex_from_points(points, 20, 0),
        tl_convex_box(o, tl_vec3_make(1, 0.5f, 2), 0),
        tl_convex_cylinder(low, high, 1, 0.125f),
        tl_convex_cone(low, high, 1, 0),
        tl_convex_triangle(low, high, tl_vec3_make(2, 0, 0), 0),
    };
    const uint32_t count = sizeof shapes / sizeof shapes[0];
    pair_digests d = { digest_begin(), digest_begin(), digest_begin(), digest_begin() };
    dice random = { 13 };
    for (uint32_t i = 0; i < 12 * count * count; i++) {
        // Deep, shallow and apart.
        const float reach = i % 3 == 0 ? 0.5f : i % 3 == 1 ? 2.5f : 6.0f;
        const tl_aabb box = { { -reach, -reach, -reach }, { reach, reach, reach } };
        tl_transform a = tl_transform_identity(), b;
        a.rotation = i % 4 == 0 ? a.rotation : roll_rotation(&random);
        b.rotation = i % 4 == 0 ? a.rotation : roll_rotation(&random);
        b.position = roll_in_box(&random, box);
        answer_pair(&d, &shapes[i % count], a, &shapes[i / count % count], b);
    }
    digest_print(&d.distance, "pairs", "distance");
    digest_print(&d.depth, "pairs", "penetration");
    digest_print(&d.cast, "pairs", "cast");
    digest_print(&d.contacts, "pairs", "contacts");
    tl_blob_free(hull);
}

/// A comb: teeth of uneven length up and down, clockwise or not as the bake finds it.
static uint32_t comb_outline(dice *random, tl_contour_vertex *vertices)
{
    enum { TEETH = 40 };
    memset(vertices, 0, (4 * TEETH) * sizeof *vertices);
    for (int i = 0; i < TEETH; i++) {
        vertices[2 * i].x = 4 * i;
        vertices[2 * i].z = 100 + (int32_t)roll(random, 60);
        vertices[2 * i + 1].x = 4 * i + 2;
        vertices[2 * i + 1].z = 20 + (int32_t)roll(random, 60);
        vertices[4 * TEETH - 2 - 2 * i].x = 4 * i + 1;
        vertices[4 * TEETH - 2 - 2 * i].z = -100 + (int32_t)roll(random, 60);
        vertices[4 * TEETH - 1 - 2 * i].x = 4 * i;
        vertices[4 * TEETH - 1 - 2 * i].z = -30 + (int32_t)roll(random, 40);
    }
    return 4 * TEETH;
}

void golden_polygons(void)
{
    static const struct {
        const char *part;
        tl_partition_method method;
    } KINDS[] = { { "classic", TL_PARTITION_CLASSIC },
                  { "optimal", TL_PARTITION_OPTIMAL },
                  { "delaunay", TL_PARTITION_DELAUNAY } };
    tl_contour_vertex vertices[256];
    dice random = { 14 };
    tl_contour contour = { 0, comb_outline(&random, vertices), 1, 63 };
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.vertex_count = contour.vertex_count;
    set.contours = &contour;
    set.contour_count = 1;
    set.cell_size = 0.25f;
    set.cell_height = 0.25f;
    set.width = 200;
    set.height = 200;
    for (int i = 0; i < 3; i++) {
        tl_polygon_def def = tl_default_polygon_def();
        def.method = KINDS[i].method;
        tl_polygon_mesh mesh;
        MUST(tl_polygon_mesh_bake(&set, &def, &mesh, NULL));
        digest d = digest_begin();
        d.found = mesh.polygon_count;
        for (uint32_t k = 0; k < 3 * mesh.vertex_count; k++) {
            digest_u32(&d, (uint32_t)mesh.vertices[k]);
        }
        for (uint32_t k = 0; k < mesh.index_count; k++) {
            digest_u32(&d, mesh.indices[k]);
            digest_u32(&d, mesh.neighbours[k]);
        }
        digest_print(&d, "polygons", KINDS[i].part);
        tl_polygon_mesh_free(&mesh);
    }
}
