/* How cells, faces, changes and areas of houses are named. */
#ifndef TARTAN_DRIVER_HOUSE_CHANGE_TEXT_H
#define TARTAN_DRIVER_HOUSE_CHANGE_TEXT_H

#include "runtime/house/house.h"
#include "runtime/house/rule/change.h"

/* TRAY.ZONE.STOREY, trays from 1: "2.body.ground". */
void tn_cell_text(const tn_house *house, uint32_t cell, char *text, size_t size);

/* "2.body.ground, back", or "2.body.ground to 3.body.ground". */
void tn_face_text(const tn_house *house, uint32_t face, char *text, size_t size);

/* "2.body.loft, front, along 12'": a wall of the house for which tn_face_hangs holds. */
void tn_hanging_text(const tn_house *house, const tn_bearing *bearing, uint32_t face, char *text, size_t size);

typedef struct tn_change_words {
    char where[TN_NAME_MAX + 16], from[TN_VARIANT_TEXT], to[TN_VARIANT_TEXT];
} tn_change_words;

/* What a change is about, and its two values. house: before it. */
void tn_change_text(const tn_house *house, const tn_house_change *change, tn_change_words *words);

/* The floors between the planes of walls, in square nanometres; voids have none. */
tn_int128 tn_house_floor_area(const tn_house *house);

/* Areas of the form's houses are shown in "sf" where the widths of its schema are in feet, and in "m2" otherwise.
 * *nm2: how large one is, in square nanometres. */
const char *tn_house_area_unit(const tn_house_form *form, double *nm2);

#endif
