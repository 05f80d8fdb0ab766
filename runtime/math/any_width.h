/* Loops over rows of numbers that compilers turn into vector code, also for wider vectors than the oldest processors
 * have, where there are: each element is one IEEE operation by itself, so that the results are the same with any. */
#ifndef TARTAN_MATH_ANY_WIDTH_H
#define TARTAN_MATH_ANY_WIDTH_H

#ifdef TN_ONE_WIDTH /* what tests build for, whatever the processor */
#define TN_ANY_WIDTH TN_ONE_WIDTH
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__)
#define TN_ANY_WIDTH __attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))
#else
#define TN_ANY_WIDTH
#endif

#endif
