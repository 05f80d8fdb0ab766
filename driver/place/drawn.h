/* Models that somebody drew, written as rules that place them again: as a connection grammar, and as a kit. */
#ifndef TARTAN_DRIVER_PLACE_DRAWN_H
#define TARTAN_DRIVER_PLACE_DRAWN_H

#include <stdio.h>

#include "driver/open/open.h"
#include "runtime/place/read.h"

#define TN_DRAWN_BYTES ((size_t)256 << 20) /* of a file */

/* In what the rules' model differs from the drawn one. */
typedef struct tn_drawn_changes {
    size_t moved;    /* parts that did not lie on whole cells */
    size_t turned;   /* whose rotation cannot be said */
    size_t renamed;  /* whose name loses a letter */
    size_t left_out; /* that cannot be placed */
    size_t tilted;   /* left out too: an alternative of a kit turns parts about the vertical alone */
    char first[64];  /* name of the first that is left out */
    uint32_t turns;  /* quarter turns of the whole model */
} tn_drawn_changes;

/* Reads a model from a file, in cells of the module's kit. As tn_ldraw_read and tn_file_read; E1314 where it has no
 * parts. Those that the kit has are called as there, with the module's text. */
tn_status tn_drawn_read(const char *path, const tn_module *module, tn_ldraw *ldraw, tn_error *error);

/* The same from a text that is at hand, which messages call `name`. beside: a path beside which its sub-files lie;
 * NULL: all are in the text. */
tn_status tn_drawn_read_text(const char *text, size_t size, const char *name, const char *beside,
                             const tn_module *module, tn_ldraw *ldraw, tn_error *error);

/* Writes an LDraw text as a connection grammar, as the published program's ldr2pcfg does: one rule `Init`, in which
 * bricks 3005 and 3004 are symbols (B1x1NoCheck, B1x2NoCheck) whose room is taken first, and all else is placed without
 * taking room. init: terminals and symbols that come first, for a grammar that has rules of its own for the two bricks;
 * NULL: a bound around the model, and rules for the two, so that the grammar stands alone. E1319 for a line that cannot
 * be read, E1361 for sub-files, E1314 where there are no parts. */
tn_status tn_drawn_pcfg(const char *text, size_t size, const char *init, FILE *out, tn_drawn_changes *changes,
                        tn_error *error);

/* Writes a model as a .kit file with a model `drawn`, which uses the kit that `use` names: one alternative places all
 * of its parts. module: of that kit. Where no part stands unturned, all are turned. *text: the caller's to free. It was
 * compiled as what would lie at `path`, and placed the same parts: E1361 where it does not, as where parts overlap, or
 * all lie on their side. opener: opens it for that; NULL: as files are opened. E1314 where the kit has none of the
 * parts, TN_LIMIT (E1313) for more than 10,000. */
tn_status tn_drawn_kit(const tn_module *module, const tn_placed_model *model, const char *use, const char *path,
                       const tn_text_opener *opener, char **text, tn_drawn_changes *changes, tn_error *error);

#endif
