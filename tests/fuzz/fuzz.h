/* What a fuzz target defines: one input in, 0 out. A mistake shows as a crash, a sanitizer's report or an abort. */
#ifndef TARTAN_TESTS_FUZZ_H
#define TARTAN_TESTS_FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* And, if it changes its inputs itself: makes another of one, in place, of at most max_size bytes. Returns its size. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

#endif
