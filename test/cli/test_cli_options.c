// SPDX-License-Identifier: MIT
//
// Names of options: other spellings, the names of Recast and Detour, and what is said of words that are none.
#include "cli_run.h"

static void expect_same_bake(const char *options, const char *theirs)
{
    char line[1024];
    snprintf(line, sizeof(line), "bake level.obj -o ours.talus %s", options);
    cli_do(0, line);
    snprintf(line, sizeof(line), "bake level.obj -o theirs.talus %s", theirs);
    cli_do(0, line);
    size_t size, other_size;
    char *bytes = cli_read_file("ours.talus", &size);
    char *other = cli_read_file("theirs.talus", &other_size);
    assert_int_equal(size, other_size);
    assert_memory_equal(bytes, other, size);
    free(bytes);
    free(other);
}

static void test_names_with_one_meaning(void **state)
{
    (void)state;
    static const char ours[] = "--cell-size 0.4 --cell-height 0.25 --agent-max-slope 40 --edge-max-error 1.5 "
                               "--max-verts-per-poly 5 --tile-size 64 --detail-sample-dist 5 "
                               "--detail-sample-max-error 2 --region-min-size 9 --region-merge-size 21 "
                               "--edge-max-len 10 --partition monotone";
    cli_do(0, "sample courtyard -o level.obj");
    // rcConfig, as recast-navigation-js writes it.
    expect_same_bake(ours,
                     "--cs 0.4 --ch 0.25 --walkableSlopeAngle 40 --maxSimplificationError 1.5 --maxVertsPerPoly 5 "
                     "--tileSize 64 --detailSampleDist 5 --detailSampleMaxError 2 --region-min-size 9 "
                     "--region-merge-size 21 --edge-max-len 10 --partition monotone");
    expect_same_bake(ours, "--cs=0.4 --ch=0.25 --walkable-slope-angle=40 --max-simplification-error=1.5 "
                           "--max-verts-per-poly=5 --tile-size=64 --detail-sample-dist=5 --detail-sample-max-error=2 "
                           "--region-min-size 9 --region-merge-size 21 --edge-max-len 10 --partition monotone");
    // RecastDemo: its fields, then its labels.
    expect_same_bake(ours, "--cellSize 0.4 --cellHeight 0.25 --agentMaxSlope 40 --edgeMaxError 1.5 --vertsPerPoly 5 "
                           "--tileSize 64 --detailSampleDist 5 --detailSampleMaxError 2 --regionMinSize 9 "
                           "--regionMergeSize 21 --edgeMaxLen 10 --partitionType monotone");
    expect_same_bake(ours, "--cell-size 0.4 --cell-height 0.25 --max-slope 40 --max-edge-error 1.5 --verts-per-poly 5 "
                           "--tile-size 64 --sample-distance 5 --max-sample-error 2 --min-region-size 9 "
                           "--merged-region-size 21 --max-edge-length 10 --partitioning monotone");
    expect_same_bake("--agent-height 1.5 --agent-radius 0.4 --agent-max-climb 0.5",
                     "--agentHeight 1.5 --agentRadius 0.4 --maxClimb 0.5");
    cli_do(0, "path ours.talus 2,0,20 38,0,20 --halfExtents 2,4,2");
}

typedef struct refused_name {
    const char *camel, *kebab;
    const char *option, *unit; // what the message must name
} refused_name;

static void test_names_in_other_units(void **state)
{
    (void)state;
    static const refused_name names[] = {
        { "walkableHeight", "walkable-height", "--agent-height", "in metres" },
        { "walkableClimb", "walkable-climb", "--agent-max-climb", "in metres" },
        { "walkableRadius", "walkable-radius", "--agent-radius", "in metres" },
        { "maxEdgeLen", "max-edge-len", "--edge-max-len", "in metres" },
        { "minRegionArea", "min-region-area", "--region-min-size", "in cells" },
        { "mergeRegionArea", "merge-region-area", "--region-merge-size", "in cells" },
        { "bmin", "bmin", "--bounds", "in metres" },
        { "bmax", "bmax", "--bounds", "in metres" },
        { "height", "height", "--agent-height", "in metres" },
        { "width", "width", "--cell-size", "--bounds" },
        { "borderSize", "border-size", "--agent-radius", "leave it out" },
        { "tileWidth", "tile-width", "--tile-size", "in cells" },
        { "maxTiles", "max-tiles", "is not needed", "tiles" },
        { "filterLedgeSpans", "filter-ledge-spans", "--no-filter-ledge-spans", "is on" },
    };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); ++i) {
        char line[128];
        snprintf(line, sizeof(line), "bake a -o b --%s 4", names[i].camel);
        cli_check_error(2, line, names[i].option, names[i].unit);
        snprintf(line, sizeof(line), "bake a -o b --%s=4", names[i].kebab);
        cli_check_error(2, line, names[i].option, names[i].unit);
    }
    // Detour's tile height is a length in the plane; the option of that name is the height of a layer.
    cli_check_error(2, "bake a -o b --tileHeight 4", "--tile-size", "in cells");
    cli_do(4, "bake no.obj -o b --tile-height 4");
    cli_check_error(2, "path a 0,0,0 1,1,1 --maxNodes 2048", "is not needed", "whole navmesh");
}

static void test_suggestions(void **state)
{
    (void)state;
    cli_check_error(2, "bake a -o b --cel-size 1", "--cel-size is no option; did you mean --cell-size?", "--help");
    cli_check_error(2, "bake a -o b --agentRadus 1", "did you mean --agent-radius?", "--agentRadus is no option");
    cli_check_error(2, "bake a -o b --walkableHeigt 1", "did you mean --agent-height?", "is no option");
    cli_check_error(2, "bake a -o b --radius 1", "did you mean --agent-radius?", "--radius is no option");
    cli_check_error(2, "bake a -o b --frobnicate", "--frobnicate is no option\n", "--help");
    // A command that bakes no navmesh knows none of its names.
    cli_check_error(2, "nearest a 1,2,3 --walkableSlopeAngle 4", "--walkableSlopeAngle is no option\n", "--help");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_with_one_meaning),
        cmocka_unit_test(test_names_in_other_units),
        cmocka_unit_test(test_suggestions),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
