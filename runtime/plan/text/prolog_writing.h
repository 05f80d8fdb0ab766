/* A Prolog program on the way. Internal to export_prolog*.c. */
#ifndef TARTAN_PLAN_TEXT_PROLOG_WRITING_H
#define TARTAN_PLAN_TEXT_PROLOG_WRITING_H

#include "runtime/plan/match/parts.h"
#include "runtime/plan/text/text.h"

typedef struct tn_prolog_writing {
    const tn_schema *schema;
    const tn_module *module;
    tn_buffer *out;
    bool ok, fetch;               /* fetch: prune_plan/1 is the library's */
    bool *said;                   /* [functions]: the program has words for all of it */
    bool *asked, *asked_sums;     /* [functions], [sums]: predicates that are named */
    bool *written, *written_sums; /* and that are there */
} tn_prolog_writing;

void tn_prolog_put(tn_prolog_writing *w, const char *text);
void tn_prolog_put_atom(tn_prolog_writing *w, const char *text, const char *more); /* quoted, of both texts */

/* The predicate of a function's part; of part 0, the function, which is then asked for: 'rule whole', 'rule whole 3'.
 */
void tn_prolog_put_name(tn_prolog_writing *w, uint32_t function, uint32_t part);

/* The goal that the stretch is a tray that meets a specifier. */
void tn_prolog_put_tray(tn_prolog_writing *w, uint32_t spec);

extern const char tn_prolog_prelude[];
bool tn_prolog_built_in(const char *name); /* a predicate of one argument, which a program may not define */

/* ---- export_prolog_sums.c */
/* The goal of a comparison: of sums, or of a stretch with its mirror image. */
tn_status tn_prolog_put_comparison(tn_prolog_writing *w, const tn_part *part, tn_error *error);
/* Is every function that the comparison needs said? */
bool tn_prolog_says_comparison(const tn_prolog_writing *w, const tn_part *part);
tn_status tn_prolog_put_sum(tn_prolog_writing *w, uint32_t sum, tn_error *error);

#endif
