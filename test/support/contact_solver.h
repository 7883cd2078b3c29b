// SPDX-License-Identifier: MIT
//
// A small sequential-impulse solver, to see whether contacts are what one needs: 12 iterations, warm start, friction by
// two tangents. Source: Catto, Iterative Dynamics with Temporal Coherence, GDC 2005; the last iterations, after the
// bodies have moved, take out the velocity that pushed them apart: Catto, Solver2D, 2024. Plain on purpose: what holds
// here holds because of the contacts.

#ifndef TALUS_TEST_CONTACT_SOLVER_H
#define TALUS_TEST_CONTACT_SOLVER_H

#include "math/vec3d.h"

#include <talus/convex.h>

#include <string.h>

enum { SOLVER_BODIES = 64, SOLVER_PAIRS = 256, SOLVER_ITERATIONS = 12, SOLVER_RELAX = 4 };

typedef struct solver_body {
    const tl_convex *shape;
    tl_transform pose;
    double inverse_mass; // 0: does not move
    tl_vec3d inverse_inertia, velocity, spin;
} solver_body;

typedef struct solver_contact {
    tl_vec3d arm_a, arm_b;
    double bias, impulse, friction[2];
} solver_contact;

typedef struct solver_pair {
    uint32_t a, b;
    tl_contact_cache cache;
    tl_contact_manifold manifold;
    solver_contact contacts[TL_MAX_CONTACTS];
    tl_vec3d normal, tangents[2];
} solver_pair;

typedef struct solver {
    solver_body bodies[SOLVER_BODIES];
    solver_pair pairs[SOLVER_PAIRS];
    uint32_t body_count, pair_count;
    tl_contact_limits limits;
    double friction, step;
    tl_vec3d gravity;
    uint64_t contact_count, jump_count; // of all steps; contacts that moved by more than jump_length
    double jump_length;
} solver;

static inline tl_vec3d solver_velocity(const solver_body *body, tl_vec3d arm)
{
    return tl_vec3d_add(body->velocity, tl_vec3d_cross(body->spin, arm));
}

static inline tl_vec3d solver_turn(const solver_body *body, tl_vec3d torque)
{
    tl_frame f = tl_frame_from(body->pose);
    tl_vec3d local = tl_frame_rotate_back(&f, torque);
    local.x *= body->inverse_inertia.x;
    local.y *= body->inverse_inertia.y;
    local.z *= body->inverse_inertia.z;
    return tl_frame_rotate(&f, local);
}

static inline void solver_push(solver_body *body, tl_vec3d arm, tl_vec3d impulse)
{
    body->velocity = tl_vec3d_mul_add(body->velocity, impulse, body->inverse_mass);
    body->spin = tl_vec3d_add(body->spin, solver_turn(body, tl_vec3d_cross(arm, impulse)));
}

static inline void solver_push_pair(solver *s, const solver_pair *pair, const solver_contact *c, tl_vec3d axis,
                                    double impulse)
{
    solver_push(&s->bodies[pair->a], c->arm_a, tl_vec3d_scale(axis, -impulse));
    solver_push(&s->bodies[pair->b], c->arm_b, tl_vec3d_scale(axis, impulse));
}

static inline double solver_mass(const solver *s, const solver_pair *pair, const solver_contact *c, tl_vec3d axis)
{
    const solver_body *a = &s->bodies[pair->a], *b = &s->bodies[pair->b];
    double sum = a->inverse_mass + b->inverse_mass;
    sum += tl_vec3d_dot(axis, tl_vec3d_cross(solver_turn(a, tl_vec3d_cross(c->arm_a, axis)), c->arm_a));
    sum += tl_vec3d_dot(axis, tl_vec3d_cross(solver_turn(b, tl_vec3d_cross(c->arm_b, axis)), c->arm_b));
    return 1.0 / sum;
}

static inline double solver_closing(const solver *s, const solver_pair *pair, const solver_contact *c, tl_vec3d axis)
{
    return tl_vec3d_dot(axis, tl_vec3d_sub(solver_velocity(&s->bodies[pair->b], c->arm_b),
                                           solver_velocity(&s->bodies[pair->a], c->arm_a)));
}

static inline void solver_count_jumps(solver *s, const tl_contact_manifold *last, const tl_contact_manifold *next)
{
    for (uint32_t i = 0; i < next->count && last->count > 0; i++) {
        double nearest = (double)INFINITY;
        for (uint32_t k = 0; k < last->count; k++) {
            nearest = fmin(nearest, (double)tl_distance(next->contacts[i].point_a, last->contacts[k].point_a));
        }
        s->contact_count++;
        s->jump_count += nearest > s->jump_length;
    }
}

// Contacts with the impulses of those that they continue.
static inline void solver_refresh(solver *s, solver_pair *pair, const tl_contact_manifold *next)
{
    double impulses[TL_MAX_CONTACTS];
    for (uint32_t i = 0; i < TL_MAX_CONTACTS; i++) {
        impulses[i] = pair->contacts[i].impulse;
    }
    solver_count_jumps(s, &pair->manifold, next);
    pair->manifold = *next;
    pair->normal = tl_vec3d_from(next->normal);
    if (next->count > 0) {
        pair->normal = tl_vec3d_scale(pair->normal, 1.0 / tl_vec3d_length(pair->normal));
        pair->tangents[0] = tl_vec3d_perpendicular(pair->normal);
        pair->tangents[1] = tl_vec3d_cross(pair->normal, pair->tangents[0]);
    }
    for (uint32_t i = 0; i < next->count; i++) {
        const tl_contact *from = &next->contacts[i];
        solver_contact *c = &pair->contacts[i];
        tl_vec3d p = tl_vec3d_scale(tl_vec3d_add(tl_vec3d_from(from->point_a), tl_vec3d_from(from->point_b)), 0.5);
        c->arm_a = tl_vec3d_sub(p, tl_vec3d_from(s->bodies[pair->a].pose.position));
        c->arm_b = tl_vec3d_sub(p, tl_vec3d_from(s->bodies[pair->b].pose.position));
        double gap = (double)from->separation;
        c->bias = gap > 0.0 ? gap / s->step : fmax(0.05 * fmin(gap + 0.0002, 0.0) / s->step, -2.0);
        // Friction starts from nothing: the last one, for a tower that leaned otherwise, would make it sway.
        c->impulse = from->previous != TL_NO_CONTACT ? impulses[from->previous] : 0.0;
        c->friction[0] = c->friction[1] = 0.0;
        solver_push_pair(s, pair, c, pair->normal, c->impulse);
    }
}

static inline void solver_iterate(solver *s, solver_pair *pair, bool relax)
{
    for (uint32_t i = 0; i < pair->manifold.count; i++) {
        solver_contact *c = &pair->contacts[i];
        for (int k = 0; k < 2; k++) {
            double most = s->friction * c->impulse, before = c->friction[k];
            double change = -solver_closing(s, pair, c, pair->tangents[k]) * solver_mass(s, pair, c, pair->tangents[k]);
            c->friction[k] = fmax(-most, fmin(most, before + change));
            solver_push_pair(s, pair, c, pair->tangents[k], c->friction[k] - before);
        }
    }
    for (uint32_t i = 0; i < pair->manifold.count; i++) {
        solver_contact *c = &pair->contacts[i];
        double before = c->impulse;
        double bias = relax ? fmax(c->bias, 0.0) : c->bias;
        double change = -(solver_closing(s, pair, c, pair->normal) + bias) * solver_mass(s, pair, c, pair->normal);
        c->impulse = fmax(0.0, before + change);
        solver_push_pair(s, pair, c, pair->normal, c->impulse - before);
    }
}

static inline void solver_move(solver *s)
{
    for (uint32_t i = 0; i < s->body_count; i++) {
        solver_body *body = &s->bodies[i];
        tl_quat q = body->pose.rotation;
        tl_vec3 w = tl_vec3d_to_float(tl_vec3d_scale(body->spin, 0.5 * s->step));
        tl_quat turn = { w.x, w.y, w.z, 0.0f }, d = tl_quat_mul(turn, q);
        q.x += d.x, q.y += d.y, q.z += d.z, q.w += d.w;
        if (body->inverse_mass > 0.0) {
            body->pose.rotation = tl_quat_normalize(q);
            body->pose.position =
                tl_vec3d_to_float(tl_vec3d_mul_add(tl_vec3d_from(body->pose.position), body->velocity, s->step));
        }
    }
}

static inline void solver_fall(solver *s)
{
    for (uint32_t i = 0; i < s->body_count; i++) {
        if (s->bodies[i].inverse_mass > 0.0) {
            s->bodies[i].velocity = tl_vec3d_mul_add(s->bodies[i].velocity, s->gravity, s->step);
        }
    }
}

// With the manifolds of all pairs given by solver_refresh.
static inline void solver_solve(solver *s)
{
    for (int k = 0; k < SOLVER_ITERATIONS; k++) {
        if (k == SOLVER_ITERATIONS - SOLVER_RELAX) {
            solver_move(s);
        }
        for (uint32_t i = 0; i < s->pair_count; i++) {
            solver_iterate(s, &s->pairs[i], k >= SOLVER_ITERATIONS - SOLVER_RELAX);
        }
    }
}

// One step.
static inline void solver_run_step(solver *s)
{
    solver_fall(s);
    for (uint32_t i = 0; i < s->pair_count; i++) {
        solver_pair *pair = &s->pairs[i];
        const solver_body *a = &s->bodies[pair->a], *b = &s->bodies[pair->b];
        tl_contact_manifold next;
        tl_convex_contacts(a->shape, a->pose, b->shape, b->pose, &s->limits, &pair->cache, &next);
        solver_refresh(s, pair, &next);
    }
    solver_solve(s);
}

// A body of density 1000 kg/m3 whose inertia is that of a box of these half extents.
static inline uint32_t solver_add(solver *s, const tl_convex *shape, tl_vec3 position, tl_vec3 half)
{
    solver_body *body = &s->bodies[s->body_count];
    double x = (double)half.x, y = (double)half.y, z = (double)half.z, mass = 8000.0 * x * y * z;
    body->shape = shape;
    body->pose = tl_transform_identity();
    body->pose.position = position;
    body->inverse_mass = 1.0 / mass;
    body->inverse_inertia =
        tl_vec3d_make(3.0 / (mass * (y * y + z * z)), 3.0 / (mass * (x * x + z * z)), 3.0 / (mass * (x * x + y * y)));
    body->velocity = body->spin = tl_vec3d_make(0.0, 0.0, 0.0);
    return s->body_count++;
}

static inline uint32_t solver_add_fixed(solver *s, const tl_convex *shape, tl_vec3 position)
{
    uint32_t at = solver_add(s, shape, position, tl_vec3_make(1, 1, 1));
    s->bodies[at].inverse_mass = 0.0;
    s->bodies[at].inverse_inertia = tl_vec3d_make(0.0, 0.0, 0.0);
    return at;
}

static inline void solver_link(solver *s, uint32_t a, uint32_t b)
{
    solver_pair *pair = &s->pairs[s->pair_count++];
    pair->a = a;
    pair->b = b;
}

static inline void solver_start(solver *s)
{
    memset(s, 0, sizeof *s);
    s->limits.margin = s->limits.tolerance = 0.02f;
    s->friction = 0.6;
    s->step = 1.0 / 60.0;
    s->gravity = tl_vec3d_make(0.0, -10.0, 0.0);
    s->jump_length = 0.05;
}

#endif
