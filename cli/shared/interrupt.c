// SPDX-License-Identifier: MIT
//
// SA_RESETHAND lets a second Ctrl-C through, for work that does not look at the flag; no SA_RESTART, so that a read
// from a terminal or pipe returns at once.

#include "cli/shared/interrupt.h"

#include <signal.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

enum { CANCELLED = 130 }; // TL_EXIT_CANCELLED

static volatile sig_atomic_t interrupted; // the one global: signal handlers have no user pointer

static volatile sig_atomic_t ends;

static void on_signal(int number)
{
    (void)number;
    if (ends) {
        static const char text[] = "talus: cancelled\n";
        const ssize_t written = write(STDERR_FILENO, text, sizeof(text) - 1);
        (void)written;
        _exit(CANCELLED);
    }
    interrupted = 1;
}

void tl_interrupt_catch(void)
{
    static const int numbers[] = { SIGINT, SIGTERM, SIGHUP };
    for (unsigned i = 0; i < sizeof(numbers) / sizeof(numbers[0]); ++i) {
        struct sigaction before;
        // A job that was started with the signal ignored (nohup, a background job) keeps it so.
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler == SIG_IGN) {
            continue;
        }
        struct sigaction action;
        memset(&action, 0, sizeof(action));
        action.sa_handler = on_signal;
        action.sa_flags = (int)SA_RESETHAND;
        sigemptyset(&action.sa_mask);
        sigaction(numbers[i], &action, NULL);
    }
}

bool tl_interrupted(void)
{
    return interrupted != 0;
}

void tl_interrupt_ends(void)
{
    ends = 1;
    if (interrupted) {
        _exit(CANCELLED);
    }
}
