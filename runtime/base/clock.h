/* Time that passes, for pauses and progress; never for results. */
#ifndef TARTAN_BASE_CLOCK_H
#define TARTAN_BASE_CLOCK_H

#include <time.h>

/* Seconds since some moment before the program began; nobody sets this clock back. */
static inline double tn_seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

#endif
