// SPDX-License-Identifier: MIT
//
// Meshes, soups of all layouts and scenes: what they bake to, and what they answer.

#include "golden.h"

#include <stdlib.h>
#include <string.h>

enum { RAYS = 1500, SHAPES = 300 };

void golden_meshes(const tl_mesh_view *view)
{
    tl_mesh_def def = tl_default_mesh_def();
    def.weld_tolerance = 0.01f;
    tl_mesh mesh;
    MUST(tl_mesh_bake(view, &def, &mesh, NULL));
    digest d = digest_begin();
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        digest_vec3(&d, mesh.vertices[i]);
    }
    for (uint32_t i = 0; i < 3 * mesh.triangle_count; i++) {
        digest_u32(&d, mesh.indices[i]);
    }
    d.found = mesh.triangle_count;
    digest_print(&d, "mesh", "welded");

    const tl_mesh_view welded = tl_mesh_as_view(&mesh);
    tl_adjacency adjacency;
    MUST(tl_adjacency_bake(&welded, NULL, &adjacency, NULL));
    d = digest_begin();
    for (uint32_t i = 0; i < 3 * adjacency.triangle_count; i++) {
        digest_u32(&d, adjacency.across[i]);
    }
    d.found = adjacency.paired_edges;
    digest_print(&d, "mesh", "adjacency");
    tl_adjacency_free(&adjacency);

    tl_closed_parts parts;
    MUST(tl_closed_parts_find(&welded, NULL, &parts, NULL));
    d = digest_begin();
    for (uint32_t i = 0; i < parts.part_count; i++) {
        digest_f64(&d, parts.volumes[i]);
    }
    d.found = parts.part_count;
    digest_print(&d, "mesh", "parts");
    tl_closed_parts_free(&parts);
    tl_mesh_free(&mesh);
}

static void digest_hit(digest *d, const tl_ray_hit *hit)
{
    digest_f32(d, hit->t);
    digest_f32(d, hit->u);
    digest_f32(d, hit->v);
    digest_vec3(d, hit->normal);
    digest_u32(d, hit->triangle);
    digest_u32(d, hit->back);
}

void golden_rays(const tl_soup *soup, const char *kind)
{
    const tl_aabb box = tl_soup_bounds(soup);
    dice random = { 7 };
    digest d = digest_begin();
    for (uint32_t i = 0; i < RAYS; i++) {
        const tl_vec3 from = roll_in_box(&random, box);
        const tl_vec3 to = roll_in_box(&random, box);
        tl_ray ray = { from, tl_sub(to, from), i % 3 != 0 ? INFINITY : 1.0f };
        ray.direction.x = i % 7 == 0 ? 0 : ray.direction.x;
        ray.direction.z = i % 11 == 0 ? -0.0f : ray.direction.z;
        tl_ray_hit hit, hits[8];
        if (digest_found(&d, tl_soup_cast_ray(soup, &ray, NULL, &hit))) {
            digest_hit(&d, &hit);
        }
        if (digest_found(&d, tl_soup_cast_segment(soup, from, to, NULL, &hit))) {
            digest_hit(&d, &hit);
        }
        digest_found(&d, tl_soup_occluded(soup, &ray, NULL));
        digest_found(&d, tl_soup_line_of_sight(soup, from, to, NULL));
        uint32_t count = 0;
        const tl_hit_rule rule = i % 2 != 0 ? TL_HITS_CROSSED : TL_HITS_TOUCHED;
        digest_result(&d, tl_soup_cast_ray_all(soup, &ray, rule, NULL, hits, 8, &count));
        digest_u32(&d, count);
        for (uint32_t k = 0; k < count && k < 8; k++) {
            digest_hit(&d, &hits[k]);
        }
    }
    digest_print(&d, kind, "rays");
}

static tl_convex shape_of(uint32_t number)
{
    switch (number % 5) {
    case 0:
        return tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.75f);
    case 1:
        return tl_convex_capsule(tl_vec3_make(0, -0.5f, 0), tl_vec3_make(0, 0.5f, 0), 0.375f);
    case 2:
        return tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.625f, 0.75f), 0.125f);
    case 3:
        return tl_convex_cylinder(tl_vec3_make(0, -0.5f, 0), tl_vec3_make(0, 0.5f, 0), 0.5f, 0.0625f);
    default:
        return tl_convex_cone(tl_vec3_make(0, -0.5f, 0), tl_vec3_make(0, 0.5f, 0), 0.5f, 0);
    }
}

static void digest_shape_hit(digest *d, const tl_shape_hit *hit)
{
    digest_f32(d, hit->t);
    digest_u32(d, hit->triangle);
    digest_f32(d, hit->depth);
    digest_vec3(d, hit->point);
    digest_vec3(d, hit->normal);
    digest_u32(d, (uint32_t)hit->status);
}

static void answer_shapes(const tl_soup *soup, const char *kind)
{
    const tl_aabb box = tl_soup_bounds(soup);
    dice random = { 8 };
    digest d = digest_begin();
    for (uint32_t i = 0; i < SHAPES; i++) {
        const tl_convex shape = shape_of(i);
        tl_transform pose;
        pose.position = roll_in_box(&random, box);
        pose.rotation = roll_rotation(&random);
        const tl_vec3 motion = tl_sub(roll_in_box(&random, box), pose.position);
        tl_shape_hit hit;
        if (digest_result(&d, tl_soup_cast_shape(soup, &shape, pose, motion, NULL, &hit))) {
            digest_shape_hit(&d, &hit);
        }
        uint32_t triangles[16], count = 0;
        digest_result(&d, tl_soup_find_overlaps(soup, &shape, pose, NULL, triangles, 16, &count));
        for (uint32_t k = 0; k < count && k < 16; k++) {
            digest_u32(&d, triangles[k]);
        }
        tl_soup_point near;
        if (digest_result(&d, tl_soup_nearest(soup, pose.position, INFINITY, NULL, &near))) {
            digest_vec3(&d, near.point);
            digest_f32(&d, near.distance);
            digest_vec3(&d, near.normal);
            digest_u32(&d, near.triangle);
            digest_u32(&d, (uint32_t)near.feature);
        }
        tl_soup_location location;
        if (digest_result(&d, tl_soup_locate(soup, pose.position, &location))) {
            digest_u32(&d, (uint32_t)location.side);
            digest_u32(&d, (uint32_t)location.winding);
        }
    }
    digest_print(&d, kind, "shapes");
}

static void soup_of(const tl_mesh_view *view, const tl_soup_def *def, const char *kind)
{
    tl_soup *soup;
    MUST(tl_soup_bake(view, def, &soup, NULL));
    MUST(tl_soup_check(soup, tl_soup_size(soup), NULL));
    digest d = digest_begin();
    digest_blob(&d, soup);
    digest_print(&d, kind, "blob");
    golden_rays(soup, kind);
    answer_shapes(soup, kind);
    tl_blob_free(soup);
}

/// Every vertex moved, and the same tree over them.
static void refitted_soup(const tl_mesh_view *view)
{
    tl_soup *soup;
    MUST(tl_soup_bake(view, NULL, &soup, NULL));
    tl_vec3 *moved = malloc(view->vertex_count * sizeof *moved);
    must(moved != NULL ? TL_OK : TL_ERR_MEMORY, "malloc");
    for (uint32_t i = 0; i < view->vertex_count; i++) {
        const tl_vec3 v = view->vertices[i];
        moved[i] = tl_vec3_make(v.x + 0.25f * v.y, v.y, v.z - 0.125f * v.x);
    }
    tl_mesh_view moved_view = *view;
    moved_view.vertices = moved;
    MUST(tl_soup_refit(soup, &moved_view, NULL));
    digest d = digest_begin();
    digest_blob(&d, soup);
    digest_print(&d, "soup-refit", "blob");
    golden_rays(soup, "soup-refit");
    free(moved);
    tl_blob_free(soup);
}

/// Every triangle from both sides.
static void two_sided_soup(const tl_mesh_view *view)
{
    const size_t corners = 3 * (size_t)view->triangle_count;
    uint32_t *sides = malloc(2 * corners * sizeof *sides);
    must(sides != NULL ? TL_OK : TL_ERR_MEMORY, "malloc");
    for (size_t i = 0; i < corners; i++) {
        sides[i] = sides[2 * corners - 1 - i] = view->indices[i];
    }
    tl_mesh_view both = *view;
    both.indices = sides;
    both.triangle_count *= 2;
    both.materials = NULL;
    const tl_soup_def def = tl_default_soup_def();
    soup_of(&both, &def, "soup-two-sided");
    free(sides);
}

void golden_soups(const tl_mesh_view *view)
{
    tl_soup_def def = tl_default_soup_def();
    soup_of(view, &def, "soup-fast");
    def.layout = TL_SOUP_COMPACT;
    soup_of(view, &def, "soup-compact");
    def = tl_default_soup_def();
    def.pair_triangles = false;
    soup_of(view, &def, "soup-singles");
    def = tl_default_soup_def();
    def.split_budget = 0.5f;
    soup_of(view, &def, "soup-split");
    def = tl_default_soup_def();
    def.partition = TL_SOUP_KD_TREE;
    soup_of(view, &def, "soup-kd");
    two_sided_soup(view);
    refitted_soup(view);
}

// Soups along each axis another, mirrored; shapes alike along all, which suits rounded ones too.
static tl_vec3 roll_scale(dice *random, const tl_convex *shape)
{
    const tl_aabb box = { { 0.5f, 0.5f, 0.5f }, { 2, 2, 2 } };
    const tl_vec3 scale = roll_in_box(random, box);
    return shape == NULL ? tl_vec3_make(-scale.x, scale.y, scale.z) : tl_vec3_make(scale.x, -scale.x, scale.x);
}

static void scene_answers(const tl_soup *soup, bool scaled, const char *what)
{
    enum { INSTANCES = 60 };
    tl_convex shapes[5];
    tl_scene_instance instances[INSTANCES];
    const tl_aabb box = { { -100, -10, -100 }, { 100, 10, 100 } };
    dice random = { 9 };
    memset(instances, 0, sizeof instances);
    for (uint32_t i = 0; i < INSTANCES; i++) {
        shapes[i % 5] = shape_of(i);
        instances[i].soup = i % 3 == 0 ? soup : NULL;
        instances[i].shape = i % 3 == 0 ? NULL : &shapes[i % 5];
        instances[i].pose.position = roll_in_box(&random, box);
        instances[i].pose.rotation = roll_rotation(&random);
        instances[i].mask = 1;
        if (scaled) {
            instances[i].scale = roll_scale(&random, instances[i].shape);
        }
    }
    tl_scene *scene;
    MUST(tl_scene_bake(instances, INSTANCES, NULL, &scene, NULL));
    digest d = digest_begin();
    for (uint32_t i = 0; i < RAYS; i++) {
        const tl_vec3 from = roll_in_box(&random, box);
        const tl_vec3 to = roll_in_box(&random, box);
        const tl_ray ray = { from, tl_sub(to, from), INFINITY };
        tl_scene_hit hit;
        if (digest_found(&d, tl_scene_cast_ray(scene, instances, &ray, NULL, &hit))) {
            digest_hit(&d, &hit.hit);
            digest_u32(&d, hit.instance);
        }
        if (i % 8 == 0) {
            const tl_convex moving = shape_of(i / 8);
            tl_transform pose = tl_transform_identity();
            pose.position = from;
            tl_scene_shape_hit swept;
            if (digest_result(&d, tl_scene_cast_shape(scene, instances, &moving, pose, ray.direction, NULL, &swept))) {
                digest_shape_hit(&d, &swept.hit);
                digest_u32(&d, swept.instance);
            }
            tl_scene_point near;
            if (digest_result(&d, tl_scene_nearest(scene, instances, from, INFINITY, NULL, &near))) {
                digest_vec3(&d, near.point.point);
                digest_u32(&d, near.instance);
            }
        }
    }
    digest_print(&d, "scene", what);
    tl_blob_free(scene);
}

void golden_scene(const tl_soup *soup)
{
    scene_answers(soup, false, "answers");
    scene_answers(soup, true, "scaled");
}
