/* Designs of a file: choosing one, what there is to say about them, their requirements, and how boxes were squashed. */
#ifndef TARTAN_DRIVER_SOLID_SOLID_H
#define TARTAN_DRIVER_SOLID_SOLID_H

#include <stdio.h>

#include "driver/open/findings.h"
#include "runtime/solid/measure.h"

/* The design of this name, or the file's only one where that is NULL. What is wrong is reported (E1513). */
tn_status tn_solid_choose(tn_opened *opened, const char *name, uint32_t *solid);

/* Warns of what a person who placed boxes may not have meant: W151 to W155, and E1512 where nothing is left. */
tn_status tn_solid_report(tn_opened *opened);

typedef struct tn_solid_tally {
    size_t passed, failed; /* requirements */
} tn_solid_tally;

/* Measures the file's own designs and holds them to their requirements; those that fail are reported (E1514) with what
 * was found. The measures are written to `out`, as lines or as the objects of a JSON array. TN_INVALID where one
 * failed. */
tn_status tn_solid_tests_run(tn_opened *opened, bool json, FILE *out, tn_solid_tally *tally);

/* How the boxes of a design were squashed, pair by pair, in order. */
tn_status tn_solid_explain(tn_opened *opened, uint32_t solid, bool json, FILE *out);

/* What a box is called in the place of an image: "leg'xz"; a box without a name is called by its number. */
typedef struct tn_box_words {
    char text[TN_NAME_MAX + 16];
} tn_box_words;

tn_box_words tn_box_named(const tn_module *module, uint32_t solid, uint32_t box, uint32_t image);

/* Reports an error about a design at its name. Returns the error's status. */
tn_status tn_solid_fail(tn_opened *opened, uint32_t solid, const tn_error *error);

#endif
