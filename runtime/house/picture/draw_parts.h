/* The parts of drawing a house. Internal to runtime/house/picture. */
#ifndef TARTAN_HOUSE_DRAW_PARTS_H
#define TARTAN_HOUSE_DRAW_PARTS_H

#include "runtime/draw/canvas.h"
#include "runtime/house/picture/draw.h"
#include "runtime/scene/view.h"

/* Lettering whose capitals are 2.5 mm high, in points: those of DejaVu Sans take this share of its size. */
#define TN_CAPITALS 0.729
#define TN_LETTERING (2.5 * 72 / 25.4 / TN_CAPITALS)
#define TN_NAME_LETTERING (3.5 * 72 / 25.4 / TN_CAPITALS) /* of names of houses */

/* A drawing of a sheet, and where it stands. */
typedef struct tn_house_drawn {
    bool outlines;              /* given: it is drawn where nothing covers what is below it (tn_paint_covers) */
    const tn_house_form *form;  /* lent */
    double (*layer_colours)[3]; /* [layers of the form] where they are cut; owned, NULL if there are none */
    tn_house_projection projection;
    tn_hatch *hatches;       /* [cuts of the projection]; owned */
    double *layer_least;     /* [cuts] how thick the thinnest of its layers is; 0: it has none; owned */
    tn_hatch *layer_hatches; /* [layers of the form]; owned */
    tn_view *view;           /* what is filled with colour: in elevations and in space, otherwise NULL */
    double low[2], high[2];  /* with its marks, nanometres */
    double x, y;             /* of its lower left corner, points */
} tn_house_drawn;

/* The title block of a sheet. All is borrowed. kinds, measures: what is drawn, and what measures it has. points: a
 * nanometre of the drawings, which are 1:scale; style: of the lengths below the bar. */
typedef struct tn_title_block {
    const char *title; /* or NULL */
    const tn_drawing_says *says;
    const char *kinds, *measures;
    uint32_t scale;
    double points;
    bool metric;
    tn_length_style style;
} tn_title_block;

/* ---- draw_block.c */

#define TN_BLOCK_WIDTH 320.0 /* in points */
double tn_title_block_height(const tn_title_block *block);
void tn_title_block_paint(const tn_title_block *block, tn_paint *paint, double x, double y);

/* The scale, and a bar of four metres, or of 16 feet, or less if that is long, in black and white, that ends there. */
void tn_scale_bar_paint(const tn_title_block *block, tn_paint *paint, double right, double y);

/* The project, the date and the revision in one line. */
void tn_drawing_says_write(const tn_drawing_says *says, char *text, size_t size);

/* Takes a view of a house, without marks. Clear *drawn in any case. */
tn_status tn_house_view_take(const tn_solids *solids, const tn_aspect *aspect, const tn_house *house,
                             tn_house_drawn *drawn, tn_watch *watch, tn_error *error);
void tn_house_drawn_clear(tn_house_drawn *drawn);

/* The groups of what is drawn in this way, and their colours: in elevations and in space those of the form's materials,
 * where it names one for a part. In plans and sections the lines count, on light ground. NULL: only kinds of parts. */
#define TN_PALETTE_MAX (TN_GROUP_COUNT + TN_MATERIALS_MAX)
void tn_house_colour_groups(tn_mesh *mesh); /* puts the faces of a projection into the groups of the palette */
const tn_grouping *tn_house_grouping(const tn_house_form *form, tn_aspect_kind kind, tn_grouping *grouping);
void tn_house_palette(const tn_house_form *form, tn_aspect_kind kind, double palette[TN_PALETTE_MAX][3]);

/* The colours of the layers of a house's form where they are cut, light, by their materials in its section; NULL if it
 * has none. The caller frees *made. TN_MEMORY. */
tn_status tn_house_layer_colours(const tn_house *house, double (**made)[3], tn_error *error);

/* The hatch of each of a projection's cuts: by the material of what is cut, or by what it is. The caller frees *made.
 * TN_MEMORY. */
tn_status tn_house_hatches(const tn_house *house, const tn_house_projection *projection, tn_hatch **made,
                           tn_error *error);

/* How thick the thinnest layer of each cut is. The caller frees *made. TN_MEMORY. */
tn_status tn_house_cuts_layers(const tn_house *house, const tn_house_projection *projection, double **made,
                               tn_error *error);

/* The hatches of a form's layers: by their names, or by their materials. The caller frees *made. TN_MEMORY. */
tn_status tn_house_layer_hatches(const tn_house *house, tn_hatch **made, tn_error *error);

/* The share of light that comes from all around: more where surfaces have the colours of materials, as bricks and
 * slates in the shade are to be told apart. */
double tn_house_ambient(const tn_house_form *form, tn_aspect_kind kind);

/* Paints what is lit up in the storey of a plan, over it. */
void tn_draw_lits(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm, const tn_lit *lits,
                  size_t count);

/* Paints a drawing where it stands, points_per_nm its scale. */
void tn_draw_projection(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm);

#endif
