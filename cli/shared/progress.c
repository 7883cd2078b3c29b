// SPDX-License-Identifier: MIT
//
// A stage begins when another name, or 0 done, is reported, and ends with the next one. Ten updates a second are shown:
// more cannot be read and would cost time.

#include "cli/shared/progress.h"

#include "cli/shared/interrupt.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define SHOW_INTERVAL 0.1 // seconds

double tl_clock_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void add_time(tl_progress_display *display, const char *stage, double seconds)
{
    for (uint32_t i = 0; i < display->time_count; ++i) {
        if (strcmp(display->times[i].stage, stage) == 0) {
            display->times[i].seconds += seconds;
            return;
        }
    }
    if (display->time_count < TL_MAX_STAGES) {
        tl_stage_time entry = { stage, seconds };
        display->times[display->time_count++] = entry;
    }
}

static void close_stage(tl_progress_display *display, double now)
{
    if (display->stage != NULL) {
        add_time(display, display->stage, now - display->stage_began);
        display->stage = NULL;
    }
}

static void show(tl_progress_display *display, uint64_t done, uint64_t total, double now)
{
    double seconds = now - display->stage_began;
    if (display->style == TL_PROGRESS_JSON) {
        fprintf(stderr, "{\"command\":\"%s\",\"stage\":\"%s\",\"done\":%llu,\"total\":%llu,\"seconds\":%.3f}\n",
                display->command, display->stage, (unsigned long long)done, (unsigned long long)total, seconds);
    } else {
        double percent = total > 0 ? 100.0 * (double)done / (double)total : 100.0;
        fprintf(stderr, "\r\033[Ktalus %s: %s %.0f%% %.1f s", display->command, display->stage, percent, seconds);
        fflush(stderr);
        display->line_shown = true;
    }
    display->last_shown = now;
}

static bool update(const char *stage, uint64_t done, uint64_t total, void *user)
{
    tl_progress_display *display = user;
    double now = tl_clock_seconds();
    bool begins = display->stage == NULL || strcmp(display->stage, stage) != 0;
    bool ends = done >= total;
    if (begins) {
        close_stage(display, now);
        display->stage = stage;
        display->stage_began = now;
    }
    if (display->style != TL_PROGRESS_NONE) {
        bool named = display->style == TL_PROGRESS_JSON && (begins || ends);
        if (named || now - display->last_shown >= SHOW_INTERVAL) {
            show(display, done, total, now);
        }
    }
    if (ends) {
        close_stage(display, now);
    }
    return !tl_interrupted();
}

void tl_progress_begin(tl_progress_display *display, tl_progress_style style, const char *command)
{
    if (style == TL_PROGRESS_AUTO) {
        style = isatty(STDERR_FILENO) ? TL_PROGRESS_LINE : TL_PROGRESS_NONE;
    }
    display->hook.update = update;
    display->hook.user = display;
    display->style = style;
    display->command = command;
    display->last_shown = tl_clock_seconds(); // what is done within the first interval needs no line
}

void tl_progress_end(tl_progress_display *display)
{
    close_stage(display, tl_clock_seconds());
    if (display->line_shown) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
        display->line_shown = false;
    }
}

double tl_progress_seconds(const tl_progress_display *display, const char *stage)
{
    for (uint32_t i = 0; i < display->time_count; ++i) {
        if (strcmp(display->times[i].stage, stage) == 0) {
            return display->times[i].seconds;
        }
    }
    return 0.0;
}
