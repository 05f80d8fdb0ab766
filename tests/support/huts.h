/* Small houses for tests: plans of one bay or two; each has a roof of two kinds, and the front of each bay a window or
 * none. */
#ifndef TARTAN_TESTS_HUTS_H
#define TARTAN_TESTS_HUTS_H

#define TEST_HUTS                                                                                                      \
    "schema hut { width role length = 8' | 10' zone body role band = room(10') }\n"                                    \
    "form huts \"small huts\" of hut {\n"                                                                              \
    "  storey ground 9' wall 6\" partition 4\" floor 10\" roof 8\"\n"                                                   \
    "  option body roof = gable(9:12) | vault(3')\n"                                                                  \
    "  function bed at cell(body)\n"                                                                                   \
    "  opening window wide 3' high 4' sill 2'8\"\n"                                                                    \
    "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"                                                          \
    "  face cell(bed) beside cell(bed) = door\n"                                                                       \
    "  face cell(bed) outside front = window | wall\n"                                                                 \
    "  material brick \"#a05030\" price 10 per sf for wall\n"                                                          \
    "}\n"                                                                                                              \
    "library rows using hut { trays 1..2 }\n"

#endif
