/* Random rewrite systems, as text: what the compiler, the turtle and both ways of growing are tried with. */
#ifndef TARTAN_TESTS_TEST_SYSTEM_H
#define TARTAN_TESTS_TEST_SYSTEM_H

#include <stdint.h>

/* The system of this number: always the same, and always without errors. It has seeds of three to six edges, one to
 * four labels, turns of all kinds that end where they began, branches, `~`, ages, contexts, chains, conditions and
 * weights. The caller frees it. */
char *test_system_text(uint64_t number);

#endif
