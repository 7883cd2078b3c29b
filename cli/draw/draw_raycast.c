// SPDX-License-Identifier: MIT
//
// One ray a pixel, a second one towards the sun, and three more where neighbours differ.
//
// A painter's sort of the triangles goes wrong wherever a long floor meets a small thing on it, and a z-buffer is one
// more renderer to keep; the rays are what the library is for, and a picture is their hardest user.

#include "cli/draw/draw_raycast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct colour3 {
    float r, g, b;
} colour3;

static colour3 unpack_pixel(draw_colour colour)
{
    colour3 c = { (float)((colour >> 16) & 255), (float)((colour >> 8) & 255), (float)(colour & 255) };
    return c;
}

static colour3 mix(colour3 a, colour3 b, float t)
{
    colour3 c = { a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t };
    return c;
}

static uint32_t pack_pixel(colour3 c)
{
    return 0xff000000u | (uint32_t)lrintf(c.r) << 16 | (uint32_t)lrintf(c.g) << 8 | (uint32_t)lrintf(c.b);
}

static tl_result build_layer(const draw_layer *layer, const tl_host *host, tl_soup **soup_out)
{
    *soup_out = NULL;
    if (layer->count == 0) {
        return TL_OK;
    }
    uint32_t *indices = malloc(3 * (size_t)layer->count * sizeof *indices);
    if (indices == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < 3 * layer->count; i++) {
        indices[i] = i;
    }
    tl_mesh_view view = { layer->corners, 3 * layer->count, indices, layer->count, NULL };
    tl_soup_def def = tl_default_soup_def();
    // The picture has progress of its own; the layer's bake would only make it jump.
    def.host.tasks = host->tasks;
    tl_result result = tl_soup_bake(&view, &def, soup_out, NULL);
    free(indices);
    // A layer without any area shows nothing: no error of the picture.
    return result == TL_ERR_DEGENERATE ? TL_OK : result;
}

tl_result draw_soups_build(const draw_scene *scene, const tl_host *host, draw_soups *soups_out)
{
    memset(soups_out, 0, sizeof *soups_out);
    tl_result result = build_layer(&scene->backdrop, host, &soups_out->backdrop);
    if (result == TL_OK) {
        result = build_layer(&scene->overlay, host, &soups_out->overlay);
    }
    if (result != TL_OK) {
        draw_soups_free(soups_out);
    }
    return result;
}

void draw_soups_free(draw_soups *soups)
{
    tl_blob_free(soups->backdrop);
    tl_blob_free(soups->overlay);
    memset(soups, 0, sizeof *soups);
}

// The level's hit: fronts first, so that ceilings and roofs that are modelled one-sided are looked through; a level
// that is wound the other way round is still seen.
static bool hit_backdrop(const tl_soup *soup, const tl_ray *ray, tl_ray_hit *hit)
{
    tl_ray_filter fronts = { 0 };
    fronts.cull = TL_RAY_CULL_BACK;
    return soup != NULL && (tl_soup_cast_ray(soup, ray, &fronts, hit) || tl_soup_cast_ray(soup, ray, NULL, hit));
}

static float sunlight(const tl_soup *soup, const tl_ray *ray, const tl_ray_hit *hit, float pixel)
{
    const tl_vec3 sun = { -0.42f, 0.80f, 0.43f };
    tl_vec3 normal = tl_dot(hit->normal, ray->direction) > 0.0f ? tl_neg(hit->normal) : hit->normal;
    float lambert = tl_maxf(0.0f, tl_dot(normal, sun));
    if (lambert > 0.0f) {
        tl_vec3 point = tl_mul_add(ray->origin, ray->direction, hit->t);
        // Off the surface by half a pixel: invisible, and well above the rounding of the point.
        tl_ray to_sun = { tl_mul_add(point, normal, 0.5f * pixel), sun, INFINITY };
        // Only what is left by its back casts a shadow: a solid does, a one-sided ceiling that is looked through does
        // not.
        tl_ray_filter backs = { 0 };
        backs.cull = TL_RAY_CULL_FRONT;
        if (tl_soup_occluded(soup, &to_sun, &backs)) {
            lambert *= 0.35f;
        }
    }
    return 0.52f + 0.48f * lambert;
}

static colour3 lit(colour3 colour, float light)
{
    colour3 c = { colour.r * light, colour.g * light, colour.b * light };
    return c;
}

static colour3 colour_of_ray(const draw_scene *scene, const draw_soups *soups, const tl_ray *ray, float pixel)
{
    colour3 colour = unpack_pixel(DRAW_PAPER);
    tl_ray_hit hit;
    float level_t = INFINITY;
    if (hit_backdrop(soups->backdrop, ray, &hit)) {
        level_t = hit.t;
        colour = lit(unpack_pixel(scene->backdrop.colours[hit.triangle]), sunlight(soups->backdrop, ray, &hit, pixel));
    }
    if (soups->overlay != NULL && tl_soup_cast_ray(soups->overlay, ray, NULL, &hit)) {
        const tl_soup *shading = soups->backdrop != NULL ? soups->backdrop : soups->overlay;
        float light =
            scene->overlay_alpha < 1.0f ? 0.9f + 0.1f * fabsf(hit.normal.y) : sunlight(shading, ray, &hit, pixel);
        bool hidden = hit.t > level_t + scene->overlay_bias;
        float alpha = hidden ? 0.4f * scene->overlay_alpha : scene->overlay_alpha;
        colour = mix(colour, lit(unpack_pixel(scene->overlay.colours[hit.triangle]), light), alpha);
    }
    return colour;
}

typedef struct raycast_job {
    const draw_scene *scene;
    const draw_soups *soups;
    const draw_camera *camera;
    uint32_t *first;  // one sample a pixel
    uint32_t *pixels; // the result
    uint32_t stride;
} raycast_job;

static colour3 sample(const raycast_job *job, float x, float y)
{
    tl_ray ray = draw_camera_ray(job->camera, x, y);
    return colour_of_ray(job->scene, job->soups, &ray, 1.0f / job->camera->pixels_per_metre);
}

static void first_row(uint32_t row, uint32_t worker, void *user)
{
    (void)worker;
    const raycast_job *job = user;
    for (uint32_t x = 0; x < job->camera->width; x++) {
        job->first[(size_t)row * job->camera->width + x] = pack_pixel(sample(job, (float)x + 0.5f, (float)row + 0.5f));
    }
}

// Whether two samples differ so much that an edge between them would show its steps.
static bool differ(uint32_t a, uint32_t b)
{
    int sum = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        sum += abs((int)((a >> shift) & 255) - (int)((b >> shift) & 255));
    }
    return sum > 18;
}

static bool on_edge(const raycast_job *job, uint32_t x, uint32_t y)
{
    uint32_t width = job->camera->width;
    const uint32_t *here = job->first + (size_t)y * width + x;
    return (x > 0 && differ(here[0], here[-1])) || (x + 1 < width && differ(here[0], here[1])) ||
           (y > 0 && differ(here[0], *(here - width))) ||
           (y + 1 < job->camera->height && differ(here[0], *(here + width)));
}

static void smooth_row(uint32_t row, uint32_t worker, void *user)
{
    (void)worker;
    const raycast_job *job = user;
    for (uint32_t x = 0; x < job->camera->width; x++) {
        uint32_t colour = job->first[(size_t)row * job->camera->width + x];
        if (on_edge(job, x, row)) {
            // A rotated grid: near-horizontal and near-vertical edges get four steps instead of two.
            static const float offset[4][2] = {
                { 0.375f, 0.125f }, { 0.875f, 0.375f }, { 0.125f, 0.625f }, { 0.625f, 0.875f }
            };
            colour3 sum = { 0, 0, 0 };
            for (int i = 0; i < 4; i++) {
                colour3 c = sample(job, (float)x + offset[i][0], (float)row + offset[i][1]);
                sum.r += 0.25f * c.r;
                sum.g += 0.25f * c.g;
                sum.b += 0.25f * c.b;
            }
            colour = pack_pixel(sum);
        }
        job->pixels[(size_t)row * job->stride + x] = colour;
    }
}

static tl_result run_rows(const tl_host *host, tl_task_fn *task, raycast_job *job)
{
    if (host->tasks != NULL) {
        host->tasks->run(task, job->camera->height, job, host->tasks->user);
    } else {
        for (uint32_t row = 0; row < job->camera->height; row++) {
            task(row, 0, job);
        }
    }
    const tl_progress *progress = host->progress;
    return progress == NULL || progress->update("draw", 0, 1, progress->user) ? TL_OK : TL_ERR_CANCELLED;
}

tl_result draw_raycast(const draw_scene *scene, const draw_soups *soups, const draw_camera *camera, const tl_host *host,
                       uint32_t *pixels, uint32_t stride)
{
    uint32_t *first = malloc((size_t)camera->width * camera->height * sizeof *first);
    if (first == NULL) {
        return TL_ERR_MEMORY;
    }
    raycast_job job = { scene, soups, camera, first, pixels, stride };
    tl_result result = run_rows(host, first_row, &job);
    if (result == TL_OK) {
        result = run_rows(host, smooth_row, &job);
    }
    free(first);
    return result;
}

bool draw_is_hidden(const draw_scene *scene, const draw_soups *soups, const draw_camera *camera, tl_vec3 point)
{
    const tl_soup *soup = soups->backdrop != NULL ? soups->backdrop : soups->overlay;
    if (soup == NULL) {
        return false;
    }
    double x;
    double y;
    draw_camera_project(camera, point, &x, &y);
    tl_ray ray = draw_camera_ray(camera, (float)x, (float)y);
    tl_ray_hit hit;
    float depth = tl_dot(tl_sub(point, ray.origin), camera->forward);
    return hit_backdrop(soup, &ray, &hit) && hit.t + scene->overlay_bias < depth;
}
