// SPDX-License-Identifier: MIT
//
// The support function of your own mesh: a prism is built face by face, queried along a turning direction, edited,
// queried again, and used as a shape in a distance query.

#include <talus/convex.h>
#include <talus/halfedge.h>

#include <math.h>
#include <stdio.h>

enum { SIDES = 64 };

// A custom shape: the mesh, and the last answer as the next hint.
typedef struct climber {
    const tl_halfedge_mesh *mesh;
    uint32_t hint;
} climber;

static tl_vec3 climb(tl_vec3 direction, void *user)
{
    climber *c = (climber *)user;
    c->hint = tl_halfedge_mesh_support(c->mesh, direction, c->hint);
    return c->mesh->vertices[c->hint].position;
}

// Even vertices below, odd ones above.
static tl_result build_prism(tl_halfedge_mesh *mesh)
{
    uint32_t vertices[2 * SIDES], bottom[SIDES], top[SIDES];
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < 2 * SIDES && result == TL_OK; i++) {
        float angle = 6.2831853f * (float)(i / 2) / SIDES;
        tl_vec3 p = tl_vec3_make(cosf(angle), i % 2 ? 1.0f : 0.0f, sinf(angle));
        result = tl_halfedge_mesh_add_vertex(mesh, p, &vertices[i]);
    }
    for (uint32_t i = 0; i < SIDES; i++) {
        bottom[i] = vertices[2 * i];
        top[i] = vertices[2 * (SIDES - 1 - i) + 1];
    }
    for (uint32_t i = 0; i < SIDES && result == TL_OK; i++) {
        uint32_t next = (i + 1) % SIDES;
        uint32_t side[4] = { vertices[2 * i], vertices[2 * i + 1], vertices[2 * next + 1], vertices[2 * next] };
        result = tl_halfedge_mesh_add_face(mesh, side, 4, NULL);
    }
    result = result == TL_OK ? tl_halfedge_mesh_add_face(mesh, bottom, SIDES, NULL) : result;
    return result == TL_OK ? tl_halfedge_mesh_add_face(mesh, top, SIDES, NULL) : result;
}

int main(void)
{
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    tl_result result = build_prism(&mesh);
    if (result != TL_OK || tl_halfedge_mesh_check(&mesh, NULL) != TL_OK) {
        fprintf(stderr, "mesh: %s\n", tl_result_text(result));
        tl_halfedge_mesh_destroy(&mesh);
        return 1;
    }

    // A turning direction: each answer is the hint of the next query, so hill climbing takes a step or none.
    uint32_t vertex = TL_HALFEDGE_NONE;
    float worst = 0.0f;
    for (int degree = 0; degree < 360; degree++) {
        float angle = (float)degree * 0.017453293f;
        tl_vec3 direction = tl_vec3_make(cosf(angle), 0.25f, sinf(angle));
        vertex = tl_halfedge_mesh_support(&mesh, direction, vertex);
        float best = tl_dot(mesh.vertices[vertex].position, direction);
        for (uint32_t v = 0; v < 2 * SIDES; v++) {
            worst = fmaxf(worst, tl_dot(mesh.vertices[v].position, direction) - best);
        }
    }
    printf("%u faces; a scan finds nothing farther than %g\n", mesh.face_count, (double)worst);

    // The mesh as a shape: a ball above it.
    climber user = { &mesh, TL_HALFEDGE_NONE };
    tl_convex prism = tl_convex_custom(climb, &user, 0.0f), ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.5f);
    tl_transform here = tl_transform_identity(), there = here;
    there.position = tl_vec3_make(0.2f, 3, 0.1f);
    tl_separation separation;
    tl_convex_distance(&prism, here, &ball, there, NULL, &separation);
    printf("the ball is %.4f above the prism\n", (double)separation.distance);

    bool right = mesh.face_count == SIDES + 2 && worst <= 1e-6f && fabsf(separation.distance - 1.5f) < 1e-5f;
    tl_halfedge_mesh_destroy(&mesh);
    return right ? 0 : 1;
}
