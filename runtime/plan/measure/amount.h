/* Values of measures as people and JSON read them: in feet where the schema's first length is written in feet or
 * inches, else in metres. */
#ifndef TARTAN_PLAN_MEASURE_AMOUNT_H
#define TARTAN_PLAN_MEASURE_AMOUNT_H

#include <gmp.h>

#include "runtime/plan/schema/sum.h"
#include "runtime/plan/text/text.h"

typedef struct tn_amount_unit {
    bool feet;
    int power;  /* of a length: 0 a plain number; below 0 a number by a length, an area, a volume */
    bool shown; /* spelled as pictures and pages have it, "m²", "sf"; otherwise as rules are written, "m2", "ft2" */
} tn_amount_unit;

tn_amount_unit tn_amount_unit_of(const tn_schema *schema, int power);

/* The same unit, spelled for a picture or a page. */
tn_amount_unit tn_amount_unit_shown(tn_amount_unit unit);

/* "ft2", "m", "/m2", or "" for a plain number. */
const char *tn_amount_unit_name(tn_amount_unit unit);

/* value := the same in the unit instead of nanometres to its power. */
void tn_amount_convert(tn_amount_unit unit, mpq_t value);

/* Writes a value in nanometres: "p/q" in the unit. false where out of memory. */
bool tn_amount_write_exact(tn_amount_unit unit, const mpq_t value, tn_buffer *out);

/* The same for people: "1,240 ft2"; a decimal where it ends within 12 significant digits, else a fraction. */
bool tn_amount_write(tn_amount_unit unit, const mpq_t value, tn_buffer *out);

/* The same as one word, as constants of rules are written: "1240ft2". */
bool tn_amount_write_word(tn_amount_unit unit, const mpq_t value, tn_buffer *out);

/* Writes a value that is in the unit already with 6 significant digits, its thousands apart: for people. */
bool tn_amount_write_about(tn_amount_unit unit, const mpq_t converted, tn_buffer *out);

/* The square root of a variance as a decimal of 12 significant digits, in the unit. */
bool tn_amount_write_root(tn_amount_unit unit, const mpq_t square, tn_buffer *out);

#endif
