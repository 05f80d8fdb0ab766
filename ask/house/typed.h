/* Houses as they are typed: a line, whole or with values left out (runtime/house/line.h).
 *
 * A whole line is a house of its form, whatever libraries keep. A line that leaves values out stands for the first
 * house of a library that has what is typed; if the library has none, for the first of the form.
 */
#ifndef TARTAN_ASK_HOUSE_TYPED_H
#define TARTAN_ASK_HOUSE_TYPED_H

#include "ask/session/session.h"
#include "driver/house/judge.h"
#include "runtime/house/house_names.h"
#include "runtime/house/line.h"
#include "runtime/plan/library/library.h"

/* Among which houses one is looked for. All is borrowed. */
typedef struct tn_typed_among {
    const tn_house_form *form;
    uint32_t form_number;                   /* a FORM record */
    const tn_house_library_record *library; /* or NULL: all houses of the form */
    const tn_library *plans;                /* of the library, or NULL: they are made if they are needed */
    tn_library_options options;             /* of these */
    size_t max_length;
    bool kept;       /* a house that the library does not keep will not do */
    bool tiles_free; /* the tiles may be left out of a whole line (tn_house_read_open) */
} tn_typed_among;

/* What was found out besides the house. told: for people, a sentence or two; empty if the house is what they expect. */
typedef struct tn_typed_told {
    bool completed; /* the line left values out */
    tn_buffer told;
} tn_typed_told;

void tn_typed_told_clear(tn_typed_told *told);

/* Finds the house. said: is told all mistakes of the line but the last, which is the error. TN_LIMIT where it takes too
 * much to find. Clear *house and *told in any case. */
tn_status tn_typed_find(const tn_typed_among *among, const char *text, size_t size, tn_line_error *said, void *context,
                        tn_house *house, tn_typed_told *told, tn_error *error);

/* The same in a session, which says what is wrong as of a text HOUSE, and what was found out as a note. */
tn_status tn_typed_house(tn_session *session, const tn_typed_among *among, const char *text, tn_house *house,
                         bool *completed);

/* For whoever takes the first mistake alone, or the error. */
typedef struct tn_first_mistake {
    bool any;
    tn_error error;
} tn_first_mistake;
tn_status tn_keep_first_mistake(void *first, tn_error *error);

#endif
