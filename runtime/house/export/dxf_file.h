/* What is around the drawings in a DXF file of release 2000 (AC1015): header, tables, blocks, objects. Internal to
 * runtime/house/export. Group codes and values in turn, a line each; the reference is Autodesk's "DXF Reference". */
#ifndef TARTAN_HOUSE_DXF_FILE_H
#define TARTAN_HOUSE_DXF_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct tn_dxf_layer {
    const char *name;
    int colour; /* of AutoCAD's index */
    bool dashed;
} tn_dxf_layer;

/* Up to where entities begin; after the last of them. width, height: of all drawings, in millimetres. */
void tn_dxf_begin(FILE *out, const tn_dxf_layer *layers, size_t count, double width, double height);
void tn_dxf_end(FILE *out);

/* What each entity begins with. handle: its number among entities, from 0. */
void tn_dxf_entity(FILE *out, const char *entity, uint32_t handle, const char *layer);

/* A text, in ASCII. Releases before 2007, whose files are in the code page of some computer, have all other characters
 * by their numbers in UTF-16. */
void tn_dxf_text(FILE *out, const char *text);

#endif
