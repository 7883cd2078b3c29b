// SPDX-License-Identifier: MIT

#include "cli/crowd/crowd_play.h"

#include <string.h>

bool tl_crowd_play_read(tl_cli *cli, const char *path, tl_crowd_play *play_out, tl_exit *exit_out)
{
    memset(play_out, 0, sizeof(*play_out));
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    const tl_result result = tl_crowd_scenario_read(path, &cli->frame_room, &play_out->scenario, &error);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
    }
    return result == TL_OK;
}

bool tl_crowd_play_run(tl_cli *cli, tl_input *input, const tl_bake_settings *settings, float interval,
                       tl_crowd_play *play, tl_exit *exit_out)
{
    tl_crowd_stage stage = { NULL, NULL, &play->scenario };
    if (play->scenario.obstacle_count == 0) {
        if (input->navmesh == NULL && !tl_input_need_navmesh(cli, settings, input, exit_out)) {
            return false;
        }
        stage.navmesh = input->navmesh;
    } else {
        if (!tl_crowd_obstacles_make(cli, input, settings, &play->scenario, &play->obstacles, exit_out) ||
            !tl_crowd_obstacles_set_time(cli, &play->obstacles, 0.0f, exit_out)) {
            return false;
        }
        stage.navmesh = play->obstacles.navmesh;
        stage.obstacles = &play->obstacles;
    }
    play->navmesh = stage.navmesh;
    const bool done = tl_crowd_run(cli, &stage, interval, &play->film, &play->outcome, exit_out);
    tl_progress_end(&cli->progress);
    return done;
}

void tl_crowd_play_free(tl_crowd_play *play)
{
    tl_crowd_film_free(&play->film);
    tl_crowd_obstacles_free(&play->obstacles);
    tl_crowd_scenario_free(&play->scenario);
    memset(play, 0, sizeof(*play));
}
