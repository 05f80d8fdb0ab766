/* Numbers the ids of an SVG text afresh, in the order they first occur: cairo counts its ids through the whole process,
 * so that the same drawing would differ from one run to another. */
#ifndef TARTAN_DRAW_SVG_IDS_H
#define TARTAN_DRAW_SVG_IDS_H

#include "runtime/base/error.h"

/* A new text, ended by a zero byte, that the caller frees with free(); ids are `prefix` and a number. */
tn_status tn_svg_renumber(const char *text, size_t size, const char *prefix, char **renumbered, size_t *renumbered_size,
                          tn_error *error);

#endif
