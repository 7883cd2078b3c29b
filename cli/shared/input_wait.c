// SPDX-License-Identifier: MIT

#include "cli/shared/input_wait.h"

#include <fcntl.h>
#include <poll.h>

int tl_input_open(const char *path)
{
    return open(path, O_RDONLY | O_CLOEXEC);
}

bool tl_input_would_wait(int descriptor)
{
    struct pollfd waiter = { descriptor, POLLIN, 0 };
    return poll(&waiter, 1, 0) == 0;
}
