// SPDX-License-Identifier: MIT
//
// talus distance: how far two hulls are apart, and where they are nearest.

#include "cli/options/parse_value.h"
#include "cli/shapes/open_hull.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <talus/convex.h>

#include <string.h>

typedef struct distance_settings {
    tl_hull_settings hull_a, hull_b;
    const char *pose_a, *pose_b;
    const char *poses;
    float radius_a, radius_b;
} distance_settings;

typedef struct distance_query {
    tl_convex a, b;
    tl_transform pose_a, pose_b;
    bool mirrored; // the level's axes are left-handed, where turns go the other way
    bool json;
} distance_query;

// px,py,pz or px,py,pz,qx,qy,qz,qw; the queries normalize the quaternion, and 0,0,0,0 is the identity.
static const char *pose_from(const float *v, uint32_t count, tl_transform *pose_out)
{
    *pose_out = tl_transform_identity();
    if (count != 3 && count != 7) {
        return "needs 3 numbers (position) or 7 (position, then quaternion x, y, z, w)";
    }
    pose_out->position = tl_vec3_make(v[0], v[1], v[2]);
    if (count == 7) {
        const tl_quat rotation = { v[3], v[4], v[5], v[6] };
        pose_out->rotation = rotation;
    }
    return NULL;
}

static bool parse_pose(tl_cli *cli, const char *option, const char *text, tl_transform *pose_out, tl_exit *exit_out)
{
    *pose_out = tl_transform_identity();
    if (text == NULL) {
        return true;
    }
    float values[7];
    uint32_t count = 0;
    const char *reason = tl_parse_float_list(text, values, 3, 7, &count);
    if (reason == NULL) {
        reason = pose_from(values, count, pose_out);
    }
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--%s: '%s' %s", option, text, reason);
    }
    return reason == NULL;
}

static const char *status_word(tl_convex_status status)
{
    static const char *const words[] = { "converged", "iterations", "degenerate", "not finite" };
    return words[status];
}

static void write_json(tl_text *text, const tl_separation *s)
{
    tl_text_add(text, s->overlap ? "{\"overlap\":true,\"distance\":" : "{\"overlap\":false,\"distance\":");
    tl_text_add_json_float(text, s->distance);
    tl_text_add(text, ",\"lower_bound\":");
    tl_text_add_json_float(text, s->lower_bound);
    tl_text_add(text, ",\"point_a\":");
    tl_text_add_json_point(text, s->point_a);
    tl_text_add(text, ",\"point_b\":");
    tl_text_add_json_point(text, s->point_b);
    tl_text_add(text, ",\"normal\":");
    tl_text_add_json_direction(text, s->normal);
    tl_text_add(text, ",\"status\":\"");
    tl_text_add(text, status_word(s->status));
    tl_text_add(text, "\",\"iterations\":");
    tl_text_add_count(text, s->iterations);
    tl_text_add(text, "}\n");
}

static void write_line(tl_text *text, const tl_separation *s)
{
    if (s->overlap) {
        tl_text_add(text, "overlap\n");
        return;
    }
    tl_text_add_float(text, s->distance);
    tl_text_add(text, " ");
    tl_text_add_point(text, s->point_a, ',');
    tl_text_add(text, " ");
    tl_text_add_point(text, s->point_b, ',');
    tl_text_add(text, " ");
    tl_text_add_direction(text, s->normal, ',');
    tl_text_add(text, "\n");
}

static void answer_pose(const distance_query *query, tl_transform pose_b, tl_text *text)
{
    tl_separation separation;
    tl_convex_distance(&query->a, query->pose_a, &query->b, pose_b, NULL, &separation);
    if (query->json) {
        write_json(text, &separation);
    } else {
        write_line(text, &separation);
    }
}

// The turn about an axis that was mirrored with the level.
static tl_transform turn_back(tl_transform pose)
{
    pose.rotation.x = -pose.rotation.x;
    pose.rotation.y = -pose.rotation.y;
    pose.rotation.z = -pose.rotation.z;
    return pose;
}

// A pose of the options, in the level's axes: how far it moves from where the level has it, and how it turns.
static tl_transform enter_pose(const tl_pack_frame *frame, tl_transform pose)
{
    if (frame == NULL) {
        return pose;
    }
    const tl_pack_axes axes = (tl_pack_axes)frame->axes;
    const tl_vec3 about = tl_pack_turn_in(axes, tl_vec3_make(pose.rotation.x, pose.rotation.y, pose.rotation.z));
    pose.position = tl_pack_turn_in(axes, pose.position);
    pose.rotation.x = about.x;
    pose.rotation.y = about.y;
    pose.rotation.z = about.z;
    return axes >= TL_PACK_AXES_Y_UP_LEFT ? turn_back(pose) : pose;
}

// Both hulls of levels with the same axes and origin: the command speaks their coordinates. Else it speaks talus' own,
// and says so of each that has others.
static void choose_frame(tl_cli *cli, const tl_hull_input *a, const tl_hull_input *b)
{
    const tl_pack_frame *frames[2] = { &a->frame, &b->frame };
    const bool alike = frames[0]->axes == frames[1]->axes &&
                       memcmp(frames[0]->origin, frames[1]->origin, sizeof frames[0]->origin) == 0;
    cli->speaks_frame = alike;
    for (int i = 0; i < (alike ? 1 : 2); i++) {
        const tl_pack_frame frame = *frames[i];
        tl_level_take_frame(cli, cli->arguments.words[i], (tl_pack_axes)frame.axes, frame.origin);
    }
}

static bool answer_pose_line(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const distance_query *query = user;
    tl_transform pose;
    (void)worker;
    (void)pose_from(numbers, count, &pose); // a line holds 3 numbers or 7, turned to talus' axes
    answer_pose(query, query->mirrored ? turn_back(pose) : pose, text);
    return true;
}

// The pose that the options gave.
static bool answer_given(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const distance_query *query = user;
    (void)numbers;
    (void)count;
    (void)worker;
    answer_pose(query, query->pose_b, text);
    return true;
}

static tl_exit answer_poses(tl_cli *cli, distance_query *query, const char *poses)
{
    const tl_batch batch = {
        poses, "px py pz [qx qy qz qw]", 3, 7, poses != NULL ? answer_pose_line : answer_given, query, 3u
    };
    return tl_batch_run(cli, &batch, NULL);
}

static tl_exit run_distance(tl_cli *cli)
{
    distance_settings s;
    memset(&s, 0, sizeof(s));
    s.hull_a = tl_default_hull_settings();
    s.hull_b = tl_default_hull_settings();
    const tl_option options[] = {
        { "pose", 0, TL_OPTION_TEXT, &s.pose_b, "POSE", "where B is: px,py,pz[,qx,qy,qz,qw]", NULL, 0, 0, 0, 0 },
        { "pose-a", 0, TL_OPTION_TEXT, &s.pose_a, "POSE", "where A is", NULL, 0, 0, 0, 0 },
        { "pose-b", 0, TL_OPTION_TEXT, &s.pose_b, "POSE", "the same as --pose", NULL, 0, 0, 0, 0 },
        { "poses", 0, TL_OPTION_INPUT, &s.poses, "FILE",
          "answer for the poses of B in FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "radius-a", 0, TL_OPTION_FLOAT, &s.radius_a, "M", "metres: A is rounded by a ball of this radius", NULL, 0,
          1e6f, 0, 0 },
        { "radius-b", 0, TL_OPTION_FLOAT, &s.radius_b, "M", "metres: B is rounded by a ball of this radius", NULL, 0,
          1e6f, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option of_a[] = { { "index-a", 0, TL_OPTION_NEEDED_COUNT, &s.hull_a.index, "I",
                                 "which cloud of A's file, from 0", NULL, 0, 0, 0, 0 },
                               TL_OPTION_TABLE_END };
    const tl_option of_b[] = { { "index-b", 0, TL_OPTION_NEEDED_COUNT, &s.hull_b.index, "I",
                                 "which cloud of B's file, from 0", NULL, 0, 0, 0, 0 },
                               TL_OPTION_TABLE_END };
    const tl_option_group groups[] = {
        { "Options:", options }, { "When A is not baked:", of_a }, { "When B is not baked:", of_b }, { NULL, NULL }
    };
    tl_exit code;
    distance_query query;
    memset(&query, 0, sizeof(query));
    if (!tl_cli_parse(cli, groups, 2, 2, &code) || !parse_pose(cli, "pose-a", s.pose_a, &query.pose_a, &code) ||
        !parse_pose(cli, "pose", s.pose_b, &query.pose_b, &code)) {
        return code;
    }
    if (!tl_input_refuse_options(cli, cli->arguments.words[0], of_a, &code) ||
        !tl_input_refuse_options(cli, cli->arguments.words[1], of_b, &code)) {
        return code;
    }
    tl_hull_input a, b;
    memset(&b, 0, sizeof(b));
    cli->speaks_frame = true; // until both are known
    if (tl_hull_open(cli, cli->arguments.words[0], &s.hull_a, &a, &code) &&
        tl_hull_open(cli, cli->arguments.words[1], &s.hull_b, &b, &code)) {
        query.a = tl_convex_from_hull(a.hull, s.radius_a);
        query.b = tl_convex_from_hull(b.hull, s.radius_b);
        query.json = cli->json;
        choose_frame(cli, &a, &b);
        query.pose_a = enter_pose(cli->frame, query.pose_a);
        query.pose_b = enter_pose(cli->frame, query.pose_b);
        query.mirrored = cli->frame != NULL && cli->frame->axes >= TL_PACK_AXES_Y_UP_LEFT;
        code = answer_poses(cli, &query, s.poses);
    }
    tl_hull_input_close(&a);
    tl_hull_input_close(&b);
    return code;
}

const tl_command tl_distance_command = {
    "distance",
    "Convex hulls",
    "measure the distance between two hulls",
    "HULL_A HULL_B [--pose POSE] [options]\n"
    "HULL_A HULL_B --poses POSES|- [options]",
    "HULL_A and HULL_B are meshes, points, or baked files that hold a hull. POSE is a position px,py,pz, or a\n"
    "position and a rotation px,py,pz,qx,qy,qz,qw; POSES holds one pose of B a line, with blanks for the\n"
    "commas. Prints one line for each: distance point-on-A point-on-B normal, the normal from A to B; or\n"
    "overlap.",
    "printf '%s\\n' '0 0 0' '2 0 0' '0 2 0' '0 0 2' > points.txt\n"
    "talus distance points.txt points.txt --pose 3,0,0\n"
    "talus distance points.txt points.txt --pose 3,0,0,0,0.707107,0,0.707107 --json\n"
    "echo '3 0 0' > poses.txt\n"
    "talus distance points.txt points.txt --poses poses.txt",
    run_distance,
};
