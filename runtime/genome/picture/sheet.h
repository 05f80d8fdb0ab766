/* A generation's sentences on a sheet, to choose from. */
#ifndef TARTAN_GENOME_PICTURE_SHEET_H
#define TARTAN_GENOME_PICTURE_SHEET_H

#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"

/* Draws all members, numbered from 1, each with its sentence or why it has none. */
tn_status tn_sentences_draw(const tn_individual *const *members, size_t count, const char *title, tn_picture *to,
                            tn_error *error);

#endif
