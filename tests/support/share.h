/* How much is done of what a test may do any number of times: under AddressSanitizer, where it takes some five times as
 * long, a fourth. */
#ifndef TARTAN_TESTS_SUPPORT_SHARE_H
#define TARTAN_TESTS_SUPPORT_SHARE_H

static inline int test_share(int times)
{
#ifdef __SANITIZE_ADDRESS__
    return times < 4 ? 1 : times / 4;
#else
    return times;
#endif
}

#endif
