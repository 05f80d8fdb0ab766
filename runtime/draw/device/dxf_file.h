/* What is around the entities of a DXF file of release 2007 (AC1021): header, classes, tables, blocks, objects. Group
 * codes and values in turn, a line each; the reference is Autodesk's "DXF Reference". */
#ifndef TARTAN_DRAW_DEVICE_DXF_FILE_H
#define TARTAN_DRAW_DEVICE_DXF_FILE_H

#include <stdio.h>

#include "runtime/base/buffer.h"
#include "runtime/draw/device/dxf.h"

/* Handles of what every file has; others begin at TN_DXF_FIRST. */
enum {
    TN_DXF_MODEL = 0x1C, /* the block records of the two spaces */
    TN_DXF_PAPER = 0x1D,
    TN_DXF_STYLE = 0x40, /* of lettering */
    TN_DXF_FIRST = 0x1000
};

/* A definition that entities are in: a symbol, or what shows a dimension. */
typedef struct tn_dxf_block {
    char *name;                  /* owned */
    uint32_t record, begin, end; /* handles */
    double scale;                /* of what is drawn: units a point */
    tn_buffer entities;          /* owned */
} tn_dxf_block;

/* A line type: dashes and gaps in turn, in units. Its name is its number. */
typedef struct tn_dxf_dashes {
    uint32_t count;
    double lengths[TN_DASHES_MAX];
} tn_dxf_dashes;

/* How lengths are written in dimensions: 12'-6 1/2", 3.6m, 3.6, 3600. */
typedef enum tn_dxf_measure {
    TN_DXF_UNSAID,
    TN_DXF_FEET,
    TN_DXF_METRES_NAMED,
    TN_DXF_METRES,
    TN_DXF_MILLIMETRES
} tn_dxf_measure;

typedef struct tn_dxf_box {
    double low[2], high[2];
} tn_dxf_box;

/* All that a file holds. */
typedef struct tn_dxf_content {
    tn_dxf_options options;
    tn_buffer model, paper; /* owned, as all that follows */
    tn_dxf_block *blocks;
    size_t block_count, block_capacity;
    tn_dxf_dashes *dashes;
    size_t dash_count, dash_capacity;
    tn_dxf_box model_box, paper_box;
    bool used[TN_LAYER_COUNT];
    double dimension_text; /* height of capitals in dimensions, in units of paper; 0: there are none */
    tn_dxf_measure measure;
    uint32_t next_handle;
} tn_dxf_content;

/* Units a point of paper: millimetres, or inches. */
double tn_dxf_paper_unit(const tn_dxf_options *options);

const char *tn_dxf_layer_name(const tn_dxf_options *options, tn_layer layer);

/* Appends a group of a number: millionths at most, without zeros that say nothing, whatever the locale. */
void tn_dxf_put(tn_buffer *to, int code, double number);

/* Appends a group of a text, in UTF-8, as releases from 2007 on have it. What is no UTF-8, and control characters, are
 * question marks. */
void tn_dxf_put_text(tn_buffer *to, int code, const char *text);

/* Writes the file. TN_MEMORY. */
tn_status tn_dxf_write(tn_dxf_content *content, FILE *out);

#endif
