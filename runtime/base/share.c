/* Sharing work by OpenMP, where the compiler has it. */
#include "runtime/base/share.h"

#ifdef _OPENMP
#include <omp.h>

int tn_thread_count(void)
{
    return omp_get_max_threads();
}

void tn_threads_limit(int threads)
{
    omp_set_num_threads(threads);
}

int tn_thread_number(void)
{
    return omp_get_thread_num();
}
#else
int tn_thread_count(void)
{
    return 1;
}

void tn_threads_limit(int threads)
{
    (void)threads;
}

int tn_thread_number(void)
{
    return 0;
}
#endif

/* One thread works in a plain loop. OpenMP would make a team of one for each region, with memory of its own and a call
 * to the kernel that wakes nobody: together some microseconds, which is as long as a pass over a small surface takes.
 */
bool tn_share(tn_watch *watch, int threads, uint32_t count, tn_share_how how, tn_share_work *work, void *context)
{
    if (threads <= 1 || count <= 1) {
        for (uint32_t i = 0; i < count && !tn_watch_stopped(watch); i++)
            work(context, i);
    } else if (how == TN_SHARE_EVENLY) {
#pragma omp parallel for num_threads(threads) schedule(static, 1)
        for (uint32_t i = 0; i < count; i++)
            if (!tn_watch_stopped(watch))
                work(context, i);
    } else {
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (uint32_t i = 0; i < count; i++)
            if (!tn_watch_stopped(watch))
                work(context, i);
    }
    return !tn_watch_stopped(watch);
}
