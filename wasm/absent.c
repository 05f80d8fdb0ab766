/* System calls of Linux that emscripten's C library lacks. They fail, as on a system that is too old for them. */
#include <errno.h>

int eventfd(unsigned count, int flags);

int eventfd(unsigned count, int flags)
{
    (void)count, (void)flags;
    errno = ENOSYS;
    return -1;
}
