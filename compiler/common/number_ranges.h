/* Between what the numbers of a text may lie, as checking found it out: for whoever shows them as sliders.
 *
 * Where a check holds a number to a least or a most, it notes them with the diagnostics of its compilation. The notes
 * live in the compilation's arena. */
#ifndef TARTAN_COMPILER_COMMON_NUMBER_RANGES_H
#define TARTAN_COMPILER_COMMON_NUMBER_RANGES_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"

typedef struct tn_number_range {
    tn_span span;             /* of the number, with or without its sign */
    const char *least, *most; /* as they would be written; NULL: there is none */
    struct tn_number_range *next;
} tn_number_range;

typedef struct tn_number_ranges {
    tn_arena *arena;
    tn_number_range *first, *last;
    size_t count;
} tn_number_ranges;

/* Notes the least and the most; -INFINITY and INFINITY are none. Does nothing if nobody gathers them; out of memory is
 * the arena's to remember. */
void tn_range_note(tn_diagnostics *diagnostics, tn_span span, double least, double most);

/* The same of whole numbers of 64 bits, from 0 on. */
void tn_range_note_whole64(tn_diagnostics *diagnostics, tn_span span);

#endif
