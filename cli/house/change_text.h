/* How commands name cells, faces and changes of houses. */
#ifndef TARTAN_CLI_HOUSE_CHANGE_TEXT_H
#define TARTAN_CLI_HOUSE_CHANGE_TEXT_H

#include "runtime/house/variant/change.h"

/* TRAY.ZONE.STOREY, trays from 1: "2.body.ground". */
void tn_cell_text(const tn_house *house, uint32_t cell, char *text, size_t size);

/* "2.body.ground, back", or "2.body.ground to 3.body.ground". */
void tn_face_text(const tn_house *house, uint32_t face, char *text, size_t size);

typedef struct tn_change_words {
    char where[TN_NAME_MAX + 16], from[TN_VARIANT_TEXT], to[TN_VARIANT_TEXT];
} tn_change_words;

/* What a change is about, and its two values. house: before it. */
void tn_change_text(const tn_house *house, const tn_house_change *change, tn_change_words *words);

#endif
