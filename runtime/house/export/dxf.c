/* Writes drawings of a house as DXF: lines, arcs and texts, each kind of part on layers of its own. */
#include <math.h>
#include <stdlib.h>

#include "runtime/house/export/dxf_file.h"
#include "runtime/house/export/export.h"

#define LETTERING_NM 100e6 /* 2 mm high at 1:50 */
#define HATCH_NM 60e6      /* between lines; more where a drawing would have more than HATCH_MOST of them */
#define HATCH_MOST 10000
#define GAP_NM 3e9
#define HEIGHT_MM 20000.0 /* that a viewer shows first */

/* Layers of marks come first, in the order of tn_mark_layer; then what is seen of the parts, and what is cut, in the
 * order of tn_material_group. */
enum {
    LAYER_SEEN = TN_MARK_LAYERS,
    LAYER_CUT = LAYER_SEEN + TN_GROUP_COUNT,
    LAYER_HATCH = LAYER_CUT + TN_GROUP_COUNT,
    LAYER_TITLE,
    LAYER_COUNT
};

static const tn_dxf_layer layers[LAYER_COUNT] = {
    [TN_MARK_DOOR] = {"DOORS", 30, false},
    [TN_MARK_STAIR] = {"STAIRS", 8, false},
    [TN_MARK_VOID] = {"VOIDS", 9, true},
    [TN_MARK_GROUND] = {"GROUND", 7, false},
    [TN_MARK_DIMENSION] = {"DIMENSIONS", 8, false},
    [TN_MARK_NAME] = {"NAMES", 7, false},
    [TN_MARK_TAG] = {"TAGS", 7, false},
    [TN_MARK_SECTION] = {"SECTIONS", 7, false},
    [LAYER_SEEN + TN_GROUP_WALL] = {"WALLS", 7, false},
    [LAYER_SEEN + TN_GROUP_FLOOR] = {"FLOORS", 9, false},
    [LAYER_SEEN + TN_GROUP_ROOF] = {"ROOFS", 8, false},
    [LAYER_SEEN + TN_GROUP_ITEM] = {"FURNITURE", 32, false},
    [LAYER_SEEN + TN_GROUP_PANE] = {"PANES", 150, false},
    [LAYER_SEEN + TN_GROUP_LEAF] = {"LEAVES", 30, false},
    [LAYER_SEEN + TN_GROUP_GUARD] = {"GUARDS", 34, false},
    [LAYER_SEEN + TN_GROUP_FLIGHT] = {"FLIGHTS", 9, false},
    [LAYER_CUT + TN_GROUP_WALL] = {"WALLS-CUT", 1, false},
    [LAYER_CUT + TN_GROUP_FLOOR] = {"FLOORS-CUT", 1, false},
    [LAYER_CUT + TN_GROUP_ROOF] = {"ROOFS-CUT", 1, false},
    [LAYER_CUT + TN_GROUP_ITEM] = {"FURNITURE-CUT", 1, false},
    [LAYER_CUT + TN_GROUP_PANE] = {"PANES-CUT", 150, false},
    [LAYER_CUT + TN_GROUP_LEAF] = {"LEAVES-CUT", 30, false},
    [LAYER_CUT + TN_GROUP_GUARD] = {"GUARDS-CUT", 1, false},
    [LAYER_CUT + TN_GROUP_FLIGHT] = {"FLIGHTS-CUT", 1, false},
    [LAYER_HATCH] = {"HATCH", 253, false},
    [LAYER_TITLE] = {"TITLES", 7, false},
};

/* Where a drawing stands on the sheet: its u, v move by this. */
typedef struct tn_dxf {
    FILE *out;
    double du, dv;
    uint32_t entities; /* so far */
} tn_dxf;

static void begin(tn_dxf *dxf, const char *entity, const char *kind, int layer)
{
    tn_dxf_entity(dxf->out, entity, dxf->entities++, layers[layer].name);
    fprintf(dxf->out, "100\n%s\n", kind);
}

static void point(const tn_dxf *dxf, int code, double u, double v)
{
    fprintf(dxf->out, "%d\n%.6f\n%d\n%.6f\n%d\n0.0\n", code, (u + dxf->du) / 1e6, code + 10, (v + dxf->dv) / 1e6,
            code + 20);
}

static void line(tn_dxf *dxf, int layer, double u0, double v0, double u1, double v1)
{
    begin(dxf, "LINE", "AcDbLine", layer);
    point(dxf, 10, u0, v0);
    point(dxf, 11, u1, v1);
}

static void text(tn_dxf *dxf, int layer, double u, double v, double high, bool upright, const char *words)
{
    begin(dxf, "TEXT", "AcDbText", layer);
    point(dxf, 10, u, v);
    fprintf(dxf->out, "40\n%.6f\n1\n", high / 1e6);
    tn_dxf_text(dxf->out, words);
    fprintf(dxf->out, "\n50\n%d.0\n72\n1\n", upright ? 90 : 0);
    point(dxf, 11, u, v);
    fputs("100\nAcDbText\n73\n2\n", dxf->out);
}

static void mark(tn_dxf *dxf, const tn_mark *m)
{
    if (m->kind == TN_MARK_TEXT) {
        text(dxf, m->layer, m->u0, m->v0, 0.7 * m->high, m->upright, m->text);
    } else if (m->kind == TN_MARK_LINE) {
        line(dxf, m->layer, m->u0, m->v0, m->u1, m->v1);
    } else if (m->kind == TN_MARK_CIRCLE) {
        begin(dxf, "CIRCLE", "AcDbCircle", m->layer);
        point(dxf, 10, m->u0, m->v0);
        fprintf(dxf->out, "40\n%.6f\n", fabs(m->u1 - m->u0) / 1e6);
    } else {
        double u = m->u1 - m->u0, v = m->v1 - m->v0;
        int from = fabs(u) > fabs(v) ? (u > 0 ? 0 : 180) : (v > 0 ? 90 : 270);
        begin(dxf, "ARC", "AcDbCircle", m->layer);
        point(dxf, 10, m->u0, m->v0);
        fprintf(dxf->out, "40\n%.6f\n100\nAcDbArc\n50\n%d.0\n51\n%d.0\n", (fabs(u) + fabs(v)) / 1e6, from,
                (from + 90) % 360);
    }
}

/* ---- what was cut */

/* Lines at 45 degrees across a polygon, on a grid that all polygons of the drawing share. */
static void hatch(tn_dxf *dxf, const tn_cut_face *face, double apart)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < 4; i++) {
        low = fmin(low, face->at[i][1] - face->at[i][0]);
        high = fmax(high, face->at[i][1] - face->at[i][0]);
    }
    for (double k = ceil(low / apart); k * apart < high; k++) {
        double ends[2][2];
        int found = 0;
        for (int i = 0; i < 4 && found < 2; i++) {
            const double *a = face->at[i], *b = face->at[(i + 1) % 4];
            double over_a = a[1] - a[0] - k * apart, over_b = b[1] - b[0] - k * apart;
            if ((over_a < 0) == (over_b < 0))
                continue;
            double t = over_a / (over_a - over_b);
            ends[found][0] = a[0] + t * (b[0] - a[0]);
            ends[found++][1] = a[1] + t * (b[1] - a[1]);
        }
        if (found == 2)
            line(dxf, LAYER_HATCH, ends[0][0], ends[0][1], ends[1][0], ends[1][1]);
    }
}

static void write_projection(tn_dxf *dxf, const tn_house_projection *p)
{
    double apart = fmax(HATCH_NM, (p->high[0] - p->low[0] + p->high[1] - p->low[1]) / HATCH_MOST);
    for (size_t i = 0; i < p->line_count; i++) {
        const tn_drawn_line *l = &p->lines[i];
        line(dxf, (l->cut ? LAYER_CUT : LAYER_SEEN) + (int)l->group, l->at[0][0], l->at[0][1], l->at[1][0],
             l->at[1][1]);
    }
    for (size_t i = 0; i < p->cut_count; i++)
        if (p->cuts[i].kind != TN_SOLID_PANE && p->cuts[i].kind != TN_SOLID_LEAF)
            hatch(dxf, &p->cuts[i], apart);
    for (size_t i = 0; i < p->joint_count; i++) {
        const tn_drawn_line *l = &p->joints[i];
        line(dxf, LAYER_CUT + (int)tn_joint_layer(p, l)->group, l->at[0][0], l->at[0][1], l->at[1][0], l->at[1][1]);
    }
    for (size_t i = 0; i < p->marks.count; i++)
        mark(dxf, &p->marks.items[i]);
}

/* ---- the file */

/* About how wide the drawings are together, in millimetres: what a viewer shows first. */
static double width_of(const tn_house *house, size_t drawings)
{
    double wide = 0;
    for (size_t i = 0; i < house->cell_count; i++)
        wide = fmax(wide, (double)house->cells[i].at.x1);
    return (double)drawings * (wide + GAP_NM) / 1e6;
}

tn_status tn_house_write_dxf(const tn_house *house, const tn_solids *solids, const tn_aspect *aspects, size_t count,
                             FILE *out, tn_error *error)
{
    tn_dxf dxf = {.out = out};
    const tn_mark_style style = {.lettering = LETTERING_NM, .us = tn_house_length_style(house) == TN_STYLE_FEET};
    double at = 0;
    tn_status status = TN_OK;
    tn_dxf_begin(out, layers, LAYER_COUNT, width_of(house, count), HEIGHT_MM);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_house_projection p;
        double low[2], high[2];
        status = tn_house_projection_take(house, solids, &aspects[i], NULL, &p, error);
        if (status == TN_OK)
            status = tn_house_projection_mark(house, &style, &p, error);
        if (status == TN_OK)
            status = tn_lines_merge(p.lines, &p.line_count, true, error);
        if (status == TN_OK) {
            tn_house_projection_extent(&p, low, high);
            dxf.du = at - low[0];
            dxf.dv = -p.low[1];
            write_projection(&dxf, &p);
            text(&dxf, LAYER_TITLE, (low[0] + high[0]) / 2, low[1] - 3 * LETTERING_NM, 1.4 * LETTERING_NM, false,
                 p.title);
            at += high[0] - low[0] + GAP_NM;
        }
        tn_house_projection_clear(&p);
    }
    tn_dxf_end(out);
    return status;
}
