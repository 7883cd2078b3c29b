// SPDX-License-Identifier: MIT

#include "cli/shapes/decompose_files.h"

#include "cli/draw/draw_picture.h"
#include "cli/draw/draw_sheet.h"
#include "cli/options/output_check.h"
#include "io/mesh/obj_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURE_PIXELS = 900 };

static tl_vec3 middle_of_all(const tl_decomposition *d)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < d->part_count; i++) {
        box = tl_aabb_union(box, d->parts[i].hull->bounds);
    }
    return tl_aabb_center(box);
}

static tl_vec3 shift_of(const tl_convex_part *part, tl_vec3 middle, float apart)
{
    return tl_scale(tl_sub(tl_aabb_center(part->hull->bounds), middle), apart);
}

// ---- Objects -----------------------------------------------------------------------------------------------

// One object a part, of polygons.
static tl_result write_object(tl_obj_writer *writer, const tl_hull *hull, uint32_t index, tl_vec3 shift)
{
    uint32_t *corners = malloc(hull->half_edge_count * sizeof *corners);
    tl_vec3 *vertices = malloc(hull->vertex_count * sizeof *vertices);
    if (corners == NULL || vertices == NULL) {
        free(corners);
        free(vertices);
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < hull->vertex_count; i++) {
        vertices[i] = tl_add(tl_hull_vertices(hull)[i], shift);
    }
    char name[24];
    snprintf(name, sizeof name, "part_%u", index);
    tl_obj_writer_object(writer, name);
    const uint32_t first = tl_obj_writer_vertices(writer, vertices, hull->vertex_count);
    for (uint32_t i = 0; i < hull->face_count; i++) {
        const tl_hull_face face = tl_hull_face_at(hull, i);
        for (uint32_t k = 0; k < face.count; k++) {
            corners[k] = first + tl_hull_edge_origin(hull, face.first + k);
        }
        tl_obj_writer_face(writer, corners, face.count);
    }
    free(corners);
    free(vertices);
    return TL_OK;
}

static tl_result write_objects(const tl_decomposition *d, float apart, const char *path, tl_io_error *error)
{
    tl_obj_writer *writer;
    tl_result result = tl_obj_writer_open(path, &writer, error);
    const tl_vec3 middle = middle_of_all(d);
    for (uint32_t i = 0; i < d->part_count && result == TL_OK; i++) {
        result = write_object(writer, d->parts[i].hull, i, shift_of(&d->parts[i], middle, apart));
        if (result != TL_OK) {
            tl_obj_writer_abort(writer);
            return tl_io_fail(error, result, path, 0, NULL, "out of memory");
        }
    }
    return result == TL_OK ? tl_obj_writer_commit(writer, error) : result;
}

// ---- The picture -------------------------------------------------------------------------------------------

// The faces in the part's colour, darker where they turn away from the light, and their edges.
static void draw_part(draw_scene *scene, const tl_hull *hull, tl_vec3 shift, draw_colour hue)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (uint32_t i = 0; i < hull->face_count; i++) {
        const tl_hull_face face = tl_hull_face_at(hull, i);
        const tl_vec3 first = tl_add(vertices[tl_hull_edge_origin(hull, face.first)], shift);
        tl_vec3 last = tl_add(vertices[tl_hull_edge_origin(hull, face.first + face.count - 1)], shift);
        for (uint32_t k = 0; k < face.count; k++) {
            const tl_vec3 corner = tl_add(vertices[tl_hull_edge_origin(hull, face.first + k)], shift);
            if (k >= 2) {
                draw_add_triangle(scene, first, last, corner, hue);
            }
            draw_add_line(scene, last, corner, draw_colour_mix(hue, 0x202028, 0.5f), 0.7f, 0.4f);
            last = corner;
        }
    }
}

static tl_result write_picture(const tl_decomposition *d, float apart, const char *path, const char *title,
                               const tl_host *host, tl_io_error *error)
{
    const tl_vec3 middle = middle_of_all(d);
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < d->part_count; i++) {
        const tl_vec3 shift = shift_of(&d->parts[i], middle, apart);
        const tl_aabb own = d->parts[i].hull->bounds;
        box = tl_aabb_union(box, (tl_aabb){ tl_add(own.min, shift), tl_add(own.max, shift) });
    }
    draw_scene scene;
    draw_scene_init(&scene, box);
    scene.overlay_alpha = 1.0f;
    for (uint32_t i = 0; i < d->part_count; i++) {
        draw_part(&scene, d->parts[i].hull, shift_of(&d->parts[i], middle, apart),
                  draw_colour_mix(draw_colour_of_id(i + 1), 0xffffff, 0.3f));
    }
    snprintf(scene.title, sizeof scene.title, "%s: convex parts", draw_file_name(title));
    snprintf(scene.subtitle, sizeof scene.subtitle, "%u parts; none reaches farther than %.3g m from the body",
             d->part_count, d->concavity);
    const draw_options options = { .oblique = true, .panel_size = PICTURE_PIXELS };
    const tl_result result = draw_sheet_write(&scene, &options, path, host, error);
    draw_scene_free(&scene);
    return result;
}

tl_result tl_decomposition_write(const tl_decomposition *decomposition, float apart, const char *path,
                                 const char *title, const tl_host *host, tl_io_error *error_out)
{
    return tl_has_ending(path, ".png") || tl_has_ending(path, ".svg")
               ? write_picture(decomposition, apart, path, title, host, error_out)
               : write_objects(decomposition, apart, path, error_out);
}
