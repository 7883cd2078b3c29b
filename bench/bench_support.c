// SPDX-License-Identifier: MIT
//
// Support queries, nanoseconds each, one thread: exhaustive scans in scalar code and in SIMD, the hill climbing of
// Allen Chou's article as written, from the first vertex and from the last answer, and tl_hull_support without and with
// a hint. A claim is a ratio of times to a peer's: smaller is better.
//
// Directions: random ones; ones that turn by one degree a query; and those that GJK asked of the hull for other shapes
// around it. Every query waits for the one before it, as in GJK: where the next direction is read from depends on the
// last answer. A figure is the best of several rounds of CPU time, each after one that brings the hull into the caches;
// the methods take turns within a round, and with them the yardstick: the AVX2 scan of a sphere of 256, in which the
// claims are expressed; a claim takes the median over the rounds of the ratio within one, for processors change their
// speed.

#define _GNU_SOURCE

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "report.h"
#include "support_peers.h"

#include <talus/convex.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUERIES = 4096, ROUNDS = 7, MAX_ROUNDS = 25, MAX_POINTS = 200000, LARGEST = 100000 };

// A batch of queries is cut short after so long, so that scans of large hulls do not take minutes.
static const double BATCH_NS = 4e5;

static double now(void)
{
    return 1e9 * bench_thread_seconds();
}

static uint64_t random_state = 1;

static float random_unit(void)
{
    return tl_random_unit_float(&random_state);
}

static tl_vec3 random_direction(void)
{
    for (;;) {
        tl_vec3 d = tl_vec3_make(2 * random_unit() - 1, 2 * random_unit() - 1, 2 * random_unit() - 1);
        if (tl_length_sq(d) > 0.01f && tl_length_sq(d) < 1.0f) {
            return tl_normalize(d);
        }
    }
}

// ---- shapes

typedef enum shape { SHAPE_SPHERE, SHAPE_LENS, SHAPE_CAPSULE, SHAPE_BOX, SHAPE_PRISM, SHAPE_COUNT } shape;

static const char *const shape_names[SHAPE_COUNT] = { "sphere", "lens", "capsule", "rounded box", "prism" };

static float sign_of(float a)
{
    return a < 0.0f ? -1.0f : 1.0f;
}

// The first eight points of the rounded box are corners, so the smallest is a plain box.
static tl_vec3 shape_point(shape kind, uint32_t i, uint32_t count)
{
    tl_vec3 d = random_direction();
    float angle = 6.2831853f * (float)(i / 2) / (float)(count / 2), c = sqrtf(1.0f / 3.0f);
    switch (kind) {
    case SHAPE_LENS: {
        // The caps of two balls.
        float y = 0.8f + 0.2f * random_unit(), radius = sqrtf((1 - y * y) / (d.x * d.x + d.z * d.z));
        return tl_vec3_make(d.x * radius, (y - 0.8f) * sign_of(d.y), d.z * radius);
    }
    case SHAPE_CAPSULE:
        return tl_vec3_make(d.x, d.y + 2.0f * sign_of(d.y), d.z);
    case SHAPE_BOX:
        d = i < 8 ? tl_vec3_make(i & 1 ? c : -c, i & 2 ? c : -c, i & 4 ? c : -c) : d;
        return tl_vec3_make(d.x + 2.0f * sign_of(d.x), d.y + 2.0f * sign_of(d.y), d.z + 2.0f * sign_of(d.z));
    case SHAPE_PRISM:
        return tl_vec3_make(cosf(angle), i % 2 ? 1.0f : -1.0f, sinf(angle));
    default:
        return d;
    }
}

static const tl_hull *build_hull(const tl_vec3 *points, uint32_t count)
{
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK) {
        fprintf(stderr, "a hull could not be built\n");
        exit(1);
    }
    return hull;
}

static const tl_hull *build_shape(shape kind, uint32_t count)
{
    static tl_vec3 points[MAX_POINTS];
    for (uint32_t i = 0; i < count; i++) {
        points[i] = shape_point(kind, i, count);
    }
    return build_hull(points, count);
}

// The hull of an OBJ file's vertices, or NULL when it is not there.
static const tl_hull *build_model(const char *name)
{
    static tl_vec3 points[MAX_POINTS];
    char path[512], line[256];
    snprintf(path, sizeof path, "%s/models/%s.obj", TALUS_DATA_DIR, name);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return NULL;
    }
    uint32_t count = 0;
    while (count < MAX_POINTS && fgets(line, sizeof line, file) != NULL) {
        tl_vec3 *p = &points[count];
        count += sscanf(line, "v %f %f %f", &p->x, &p->y, &p->z) == 3;
    }
    fclose(file);
    return build_hull(points, count);
}

// ---- directions

typedef struct directions {
    tl_vec3 d[QUERIES + 1]; // one more, for an address that is computed and not used
    uint32_t count;
} directions;

static directions random_set, turning_set, recorded_set;

static void fill_directions(void)
{
    tl_vec3 d = random_direction();
    random_set.count = turning_set.count = QUERIES;
    for (int i = 0; i < QUERIES; i++) {
        random_set.d[i] = random_direction();
        tl_vec3 aside = tl_cross(d, random_direction());
        d = tl_normalize(tl_mul_add(d, tl_normalize(aside), 0.0174533f));
        turning_set.d[i] = d;
    }
}

static tl_vec3 recording_support(tl_vec3 d, void *user)
{
    const tl_hull *hull = user;
    // Directions along the axes are not GJK's: they ask for the size of a shape that is only a function.
    bool along_axis = (d.x != 0.0f) + (d.y != 0.0f) + (d.z != 0.0f) == 1;
    if (recorded_set.count < QUERIES && !along_axis) {
        recorded_set.d[recorded_set.count++] = d;
    }
    return tl_hull_vertices(hull)[tl_hull_support(hull, d, TL_NO_VERTEX)];
}

// What GJK asks of the hull while a small box is put around it at a twentieth to once its size.
static void record_gjk(const tl_hull *hull)
{
    tl_convex shape_a = tl_convex_custom(recording_support, (void *)(uintptr_t)hull, 0.0f);
    float size = tl_length(tl_sub(hull->bounds.max, hull->bounds.min));
    tl_convex shape_b = tl_convex_box(tl_vec3_make(0, 0, 0), tl_scale(tl_vec3_make(0.1f, 0.05f, 0.2f), size), 0.0f);
    tl_transform at_home = tl_transform_identity();
    for (recorded_set.count = 0; recorded_set.count < QUERIES;) {
        tl_vec3 d = random_direction(), axis = random_direction();
        tl_vec3 rim = tl_hull_vertices(hull)[tl_hull_support(hull, d, TL_NO_VERTEX)];
        float gap = (0.05f + random_unit()) * size;
        tl_quat turn = { axis.x, axis.y, axis.z, random_unit() };
        tl_transform pose = { turn, tl_mul_add(rim, d, gap) };
        tl_separation found;
        tl_convex_distance(&shape_a, at_home, &shape_b, pose, NULL, &found);
    }
}

// ---- what is measured

static uint32_t talus(peer_hull *peer, tl_vec3 d)
{
    return tl_hull_support(peer->hull, d, TL_NO_VERTEX);
}

static uint32_t talus_hinted(peer_hull *peer, tl_vec3 d)
{
    return peer->last = tl_hull_support(peer->hull, d, peer->last);
}

typedef enum method {
    TALUS,
    TALUS_HINTED,
    SCALAR_SCAN,
    SSE2_SCAN,
    AVX2_SCAN,
    AVX512_SCAN,
    CHOU,
    CHOU_WARM,
    YARDSTICK,
    METHOD_COUNT
} method;

static const char *const method_names[METHOD_COUNT] = { "talus",        "talus, last answer first",
                                                        "scalar scan",  "SSE2 scan",
                                                        "AVX2 scan",    "AVX-512 scan",
                                                        "Chou's climb", "Chou's climb, warm" };

static peer_support_fn *methods[METHOD_COUNT];

// Nanoseconds a query; the first bit of an answer, always 0, goes into the address of the next direction.
static double run_batch(peer_hull *peer, peer_support_fn *support, const directions *set)
{
    static volatile uint32_t sink;
    enum { STRETCH = 256 };
    uint32_t answer = 0, done = 0;
    peer->last = 0;
    double start = now(), time = 0.0;
    while (done < set->count && time < BATCH_NS) {
        uint32_t end = done + STRETCH < set->count ? done + STRETCH : set->count;
        for (; done < end; done++) {
            answer = support(peer, set->d[done + (answer >> 31)]);
        }
        time = now() - start;
    }
    sink = answer;
    (void)sink;
    return time / done;
}

typedef struct timing {
    double ns[METHOD_COUNT]; // the best; 0: not measured
    double round[METHOD_COUNT][MAX_ROUNDS];
    int rounds;
} timing;

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The median over the rounds: what is measured within one ran at the same speed of the processor, mostly.
static double ratio(const timing *t, method of, method to)
{
    double ratios[MAX_ROUNDS];
    for (int i = 0; i < t->rounds; i++) {
        ratios[i] = t->round[of][i] / t->round[to][i];
    }
    qsort(ratios, (size_t)t->rounds, sizeof *ratios, compare_doubles);
    return ratios[t->rounds / 2];
}

static peer_hull yardstick_hull;

enum { MAX_COLUMNS = 6 };

// What is measured of a set of directions, and printed in this order.
typedef struct columns {
    method method[MAX_COLUMNS];
    int count;
} columns;

static const columns random_columns = { { SCALAR_SCAN, SSE2_SCAN, AVX2_SCAN, AVX512_SCAN, CHOU, TALUS }, 6 };
static const columns turning_columns = { { AVX2_SCAN, CHOU, CHOU_WARM, TALUS_HINTED }, 4 };
static const columns recorded_columns = { { AVX2_SCAN, CHOU_WARM, TALUS, TALUS_HINTED }, 4 };

static void measure_one(timing *t, int round, method m, peer_hull *peer, const directions *set)
{
    if (methods[m] != NULL) {
        run_batch(peer, methods[m], set);
        double ns = run_batch(peer, methods[m], set);
        t->round[m][round] = ns;
        t->ns[m] = round == 0 || ns < t->ns[m] ? ns : t->ns[m];
    }
}

static timing measure(peer_hull *peer, const directions *set, const columns *shown)
{
    timing t;
    memset(&t, 0, sizeof t);
    t.rounds = peer->count <= 64 ? MAX_ROUNDS : ROUNDS;
    for (int round = 0; round < t.rounds; round++) {
        for (int i = 0; i < shown->count; i++) {
            measure_one(&t, round, shown->method[i], peer, set);
        }
        measure_one(&t, round, YARDSTICK, &yardstick_hull, &random_set);
    }
    return t;
}

static uint32_t count_wrong(peer_hull *peer, peer_support_fn *support, const directions *set)
{
    uint32_t wrong = 0, step = 1 + peer->count / 4096;
    peer->last = 0;
    for (uint32_t i = 0; i < set->count; i += step) {
        tl_vec3 d = set->d[i], a = peer->vertices[support(peer, d)];
        double x = (double)d.x, y = (double)d.y, z = (double)d.z;
        double dot = x * (double)a.x + y * (double)a.y + z * (double)a.z;
        for (uint32_t v = 0; v < peer->count; v++) {
            tl_vec3 b = peer->vertices[v];
            if (x * (double)b.x + y * (double)b.y + z * (double)b.z > dot) {
                wrong++;
                break;
            }
        }
    }
    return wrong;
}

// ---- claims

typedef enum claim {
    CLAIM_SMALL,
    CLAIM_RANDOM,
    CLAIM_RANDOM_1024,
    CLAIM_RANDOM_4096,
    CLAIM_TURNING,
    CLAIM_PRISM,
    CLAIM_COUNT
} claim;

typedef struct limit {
    const char *text;
    double most;
} limit;

// The limits are what the best peers need, in scans of 256 with AVX2 (32 ns on the machine where they were measured).
static const limit limits[CLAIM_COUNT] = {
    { "N <= 48, random: of the fastest SIMD scan of N", 1.1 },
    { "8 <= N <= 1024, random: of the AVX2 scan of 256", 1.1 },
    { "N = 1024, random: of the AVX2 scan of 1024", 0.45 },
    { "N = 4096, random: of the AVX2 scan of 256", 45.0 / 32.0 },
    { "N <= 512, turning: of the AVX2 scan of 256", 12.0 / 32.0 },
    { "prism of 256, random: of the AVX2 scan of 256", 50.0 / 32.0 },
};

// The worst over all shapes and sizes.
static double found[CLAIM_COUNT];

static void note(claim which, double ratio)
{
    found[which] = ratio > found[which] ? ratio : found[which];
}

static void judge(shape kind, uint32_t count, const timing *random, const timing *turning)
{
    for (int m = SSE2_SCAN; m <= AVX512_SCAN && count <= 48; m++) {
        if (methods[m] != NULL) {
            note(CLAIM_SMALL, ratio(random, TALUS, (method)m));
        }
    }
    if (methods[YARDSTICK] == NULL) {
        return;
    }
    if (kind == SHAPE_PRISM) {
        if (count == 256) {
            note(CLAIM_PRISM, ratio(random, TALUS, YARDSTICK));
        }
        return;
    }
    if (count <= 1024) {
        note(CLAIM_RANDOM, ratio(random, TALUS, YARDSTICK));
    }
    if (count == 1024) {
        note(CLAIM_RANDOM_1024, ratio(random, TALUS, AVX2_SCAN));
    }
    if (count == 4096) {
        note(CLAIM_RANDOM_4096, ratio(random, TALUS, YARDSTICK));
    }
    if (count <= 512) {
        note(CLAIM_TURNING, ratio(turning, TALUS_HINTED, YARDSTICK));
    }
}

// ---- the table

static void print_head(const char *name)
{
    printf("\n%-12s | %-47s | %-31s | %-31s | wrong\n", name, "random directions", "turning 1 degree",
           "recorded from GJK");
    printf("%12s | %7s %7s %7s %7s %7s %7s | %7s %7s %7s %7s | %7s %7s %7s %7s | talus Chou\n", "N", "scalar", "SSE2",
           "AVX2", "AVX-512", "Chou", "talus", "AVX2", "Chou", "Chou,w", "talus,w", "AVX2", "Chou,w", "talus",
           "talus,w");
}

static void print_times(const timing *times, const columns *shown)
{
    printf(" |");
    for (int i = 0; i < shown->count; i++) {
        double ns = times->ns[shown->method[i]];
        if (ns > 0.0) {
            printf(ns < 10000.0 ? " %7.1f" : " %7.0f", ns);
        } else {
            printf(" %7s", "-");
        }
    }
}

static void print_row(peer_hull *peer, const timing *random, const timing *turning, const timing *recorded)
{
    printf("%12u", peer->count);
    print_times(random, &random_columns);
    print_times(turning, &turning_columns);
    print_times(recorded, &recorded_columns);
    uint32_t wrong = 0;
    const directions *sets[] = { &random_set, &turning_set, &recorded_set };
    for (int i = 0; i < 3; i++) {
        wrong += count_wrong(peer, talus, sets[i]) + count_wrong(peer, talus_hinted, sets[i]);
    }
    printf(" | %5u %4u\n", wrong, count_wrong(peer, peer_chou_climb, &random_set));
    fflush(stdout);
}

static void report_curves(bench_report *report, const char *name, double count, const timing *random,
                          const timing *turning)
{
    char chart[64];
    snprintf(chart, sizeof chart, "%s, random directions", name);
    for (int m = 0; m < YARDSTICK; m++) {
        if (random->ns[m] > 0.0) {
            bench_report_point(report, chart, method_names[m], count, random->ns[m]);
        }
    }
    static const method warm[] = { TALUS_HINTED, AVX2_SCAN, CHOU_WARM };
    snprintf(chart, sizeof chart, "%s, directions that turn 1 degree", name);
    for (int i = 0; i < 3; i++) {
        if (turning->ns[warm[i]] > 0.0) {
            bench_report_point(report, chart, method_names[warm[i]], count, turning->ns[warm[i]]);
        }
    }
}

// `asked`: points that the hull was made of; 0 for a model.
static void run_subject(bench_report *report, const char *name, shape kind, uint32_t asked, const tl_hull *hull)
{
    peer_hull peer;
    if (!peer_hull_make(&peer, hull)) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    record_gjk(hull);
    timing random = measure(&peer, &random_set, &random_columns);
    timing turning = measure(&peer, &turning_set, &turning_columns);
    timing recorded = measure(&peer, &recorded_set, &recorded_columns);
    print_row(&peer, &random, &turning, &recorded);
    if (kind < SHAPE_COUNT) {
        judge(kind, asked, &random, &turning);
    }
    // Sizes between powers of two are for the claims; in the picture they would only be crowded.
    bool drawn = (asked & (asked - 1)) == 0 || asked == LARGEST;
    if (drawn && (kind == SHAPE_SPHERE || kind == SHAPE_PRISM)) {
        report_curves(report, name, (double)peer.count, &random, &turning);
    }
    peer_hull_free(&peer);
    tl_blob_free((tl_hull *)(uintptr_t)hull);
}

int main(int argc, char **argv)
{
    static const uint32_t counts[] = { 8, 12, 16, 24, 32, 48, 64, 96, 128, 256, 512, 1024, 4096, 16384, LARGEST };
    static const char *const models[] = { "suzanne", "teapot", "cow", "fandisk", "rocker-arm", "stanford-bunny" };
    const bench_option options[] = { { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("support", "ns a query", "vertices");
    methods[TALUS] = talus;
    methods[TALUS_HINTED] = talus_hinted;
    methods[SCALAR_SCAN] = peer_scan_scalar;
    methods[SSE2_SCAN] = peer_scan_sse2();
    methods[AVX2_SCAN] = peer_scan_avx2();
    methods[AVX512_SCAN] = peer_scan_avx512();
    methods[YARDSTICK] = peer_scan_avx2();
    methods[CHOU] = peer_chou_climb;
    methods[CHOU_WARM] = peer_chou_climb_warm;
    fill_directions();
    const tl_hull *yardstick = build_shape(SHAPE_SPHERE, 256);
    if (!peer_hull_make(&yardstick_hull, yardstick)) {
        return 1;
    }
    printf("support, ns a query (Chou,w and talus,w: warm, from the last answer)\n");
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        print_head(shape_names[kind]);
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            run_subject(report, shape_names[kind], (shape)kind, counts[c], build_shape((shape)kind, counts[c]));
        }
    }
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        const tl_hull *hull = build_model(models[i]);
        if (hull != NULL) {
            print_head(models[i]);
            run_subject(report, models[i], SHAPE_COUNT, 0, hull);
        }
    }
    timing reference = measure(&yardstick_hull, &random_set, &random_columns);
    printf("\nthe AVX2 scan of 256 takes %.1f ns here; the worst of all shapes:\n", reference.ns[YARDSTICK]);
    for (int i = 0; i < CLAIM_COUNT && methods[YARDSTICK] != NULL; i++) {
        bench_report_at_most(report, limits[i].text, found[i], limits[i].most);
    }
    bench_report_print_claims(report);
    peer_hull_free(&yardstick_hull);
    tl_blob_free((tl_hull *)(uintptr_t)yardstick);
    return bench_report_close(report, json);
}
