/* Forms, clauses and measures that are drawn at random, as text: for tests. Asserts with cmocka. */
#ifndef TARTAN_TEST_DRAWN_HOUSE_H
#define TARTAN_TEST_DRAWN_HOUSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* state: where the drawing stands; to begin with any number. priced: forms have prices and roofs of more kinds, the
 * houses of `some` are small, of up to three trays, and there is a measure `fifth` of costs. compares: the houses of
 * `all` are small, too, and `some` has clauses that compare measures. places: the same, but `some` has a clause about
 * where in the row rooms and walks are. */
typedef struct drawn_house {
    uint64_t state;
    bool priced, compares, places;
    bool ways; /* set by the drawing: the form asks for ways, and has flights instead of stairs */
    char text[8192];
    size_t size;
} drawn_house;

/* text := the next file: a schema, a form `huts`, a library `all` without clauses and one with some, and measures. */
void drawn_house_write(drawn_house *drawn);

#endif
