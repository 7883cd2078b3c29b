// SPDX-License-Identifier: MIT
//
// The signed distance of two bodies as libccd and Bullet tell it, each asked with the same supports in double.

#ifndef TALUS_TEST_CONVEX_PEERS_HPP
#define TALUS_TEST_CONVEX_PEERS_HPP

#ifdef TALUS_HAVE_BULLET
#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#endif
#ifdef TALUS_HAVE_CCD
#include <ccd/ccd.h>
#endif

#include "convex_family.hpp"

// What a peer says. Some tell only whether, some also how far.
struct peer_answer {
    bool overlap;
    bool has_separation;
    double separation;
};

// A body about its pose's origin, turned as it lies; the origin is what a peer is told apart.
struct peer_body {
    const placed_body *placed;
    tl_vec3d origin;

    tl_vec3d support(tl_vec3d d) const
    {
        double length = tl_vec3d_length(d), radius = (double)placed->body->radius;
        tl_vec3d p = tl_vec3d_sub(placed->core_support(d), origin);
        return length > 0 ? tl_vec3d_mul_add(p, d, radius / length) : p;
    }
};

#ifdef TALUS_HAVE_CCD
inline void ccd_family_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out)
{
    const auto *o = static_cast<const peer_body *>(object);
    tl_vec3d p = tl_vec3d_add(o->support(tl_vec3d_make(direction->v[0], direction->v[1], direction->v[2])), o->origin);
    ccdVec3Set(out, p.x, p.y, p.z);
}

inline peer_answer ask_ccd(const peer_body &a, const peer_body &b, double size)
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = ccd_family_support;
    ccd.max_iterations = 500;
    ccd.epa_tolerance = 1e-6 * size;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    bool overlap = ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position) == 0;
    return { overlap, overlap, -depth };
}
#endif

#ifdef TALUS_HAVE_BULLET
class bullet_family_shape : public btConvexInternalShape
{
  public:
    explicit bullet_family_shape(const peer_body &b) : body(&b)
    {
        m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
        m_collisionMargin = 0;
    }
    btVector3 localGetSupportingVertexWithoutMargin(const btVector3 &d) const override
    {
        tl_vec3d p = body->support(tl_vec3d_make((double)d.x(), (double)d.y(), (double)d.z()));
        return btVector3((btScalar)p.x, (btScalar)p.y, (btScalar)p.z);
    }
    btVector3 localGetSupportingVertex(const btVector3 &d) const override
    {
        return localGetSupportingVertexWithoutMargin(d);
    }
    void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3 *d, btVector3 *out, int count) const override
    {
        for (int i = 0; i < count; i++) {
            out[i] = localGetSupportingVertexWithoutMargin(d[i]);
        }
    }
    btScalar getMargin() const override
    {
        return 0;
    }
    void calculateLocalInertia(btScalar, btVector3 &inertia) const override
    {
        inertia.setZero();
    }
    const char *getName() const override
    {
        return "family";
    }

  private:
    const peer_body *body;
};

inline peer_answer ask_bullet(const peer_body &a, const peer_body &b, double)
{
    bullet_family_shape shape_a(a), shape_b(b);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btGjkPairDetector detector(&shape_a, &shape_b, &simplex, &epa);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA.setIdentity();
    input.m_transformB.setIdentity();
    input.m_transformA.setOrigin(btVector3((btScalar)a.origin.x, (btScalar)a.origin.y, (btScalar)a.origin.z));
    input.m_transformB.setOrigin(btVector3((btScalar)b.origin.x, (btScalar)b.origin.y, (btScalar)b.origin.z));
    btPointCollector output;
    detector.getClosestPoints(input, output, nullptr);
    // Without a result Bullet has found no contact; it is told to look at any distance.
    return { output.m_hasResult && output.m_distance <= 0, output.m_hasResult, (double)output.m_distance };
}
#endif

#endif
