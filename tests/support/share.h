/* How much is done of what a test may do any number of times: a quarter, and all of it in `make check-long`. Under
 * AddressSanitizer, where it takes some five times as long, an eighth. */
#ifndef TARTAN_TESTS_SUPPORT_SHARE_H
#define TARTAN_TESTS_SUPPORT_SHARE_H

#include <stdlib.h>

static inline int test_share(int times)
{
    if (getenv("TARTAN_TESTS_LONG"))
        return times;
#ifdef __SANITIZE_ADDRESS__
    const int share = 8;
#else
    const int share = 4;
#endif
    return times < share ? 1 : times / share;
}

#endif
