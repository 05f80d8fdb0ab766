/* Writes what is around the entities of a DXF file. */
#include "runtime/draw/device/dxf_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"

/* Handles: each table, entry and object has one. */
enum {
    VPORT_TABLE = 0x10,
    LTYPE_TABLE,
    LAYER_TABLE,
    STYLE_TABLE,
    VIEW_TABLE,
    UCS_TABLE,
    APPID_TABLE,
    DIMSTYLE_TABLE,
    BLOCK_TABLE,
    ROOT,
    GROUPS,
    LAYOUTS,
    MODEL_LAYOUT = TN_DXF_PAPER + 1,
    PAPER_LAYOUT,
    PLOT_STYLES,
    PLOT_STYLE,
    BOLD_STYLE = TN_DXF_STYLE + 1,
    ACTIVE_VIEWPORT,
    APPLICATION,
    DIMENSION_STYLE,
    MODEL_BLOCK,
    PAPER_BLOCK = MODEL_BLOCK + 2,
    PLAIN_LINES = PAPER_BLOCK + 2,
    FIRST_LAYER = 0x60
};

static const struct {
    const char *aia, *iso;
    int colour, weight;
} layers[TN_LAYER_COUNT] = {
#define LAYER(id, aia, iso, colour, weight) [TN_LAYER_##id] = {aia, iso, colour, weight},
#include "runtime/draw/device/layers.def"
#undef LAYER
};

double tn_dxf_paper_unit(const tn_dxf_options *options)
{
    return options->feet ? 1.0 / 72 : 25.4 / 72;
}

const char *tn_dxf_layer_name(const tn_dxf_options *options, tn_layer layer)
{
    return options->profile == TN_PROFILE_US ? layers[layer].aia : layers[layer].iso;
}

/* ---- groups */

#define LARGEST 1e9 /* far beyond any drawing */

void tn_dxf_put(tn_buffer *to, int code, double number)
{
    if (!(fabs(number) <= LARGEST))
        number = 0;
    int64_t millionths = llround(number * 1e6);
    uint64_t size = (uint64_t)(millionths < 0 ? -millionths : millionths);
    char text[40];
    int used = snprintf(text, sizeof text, "%s%" PRIu64 ".%06" PRIu64, millionths < 0 ? "-" : "", size / 1000000,
                        size % 1000000);
    while (text[used - 1] == '0' && text[used - 2] != '.')
        used--;
    text[used] = '\0';
    tn_buffer_printf(to, "%d\n%s\n", code, text);
}

static void put_point(tn_buffer *to, int code, double x, double y)
{
    tn_dxf_put(to, code, x);
    tn_dxf_put(to, code + 10, y);
    tn_dxf_put(to, code + 20, 0);
}

/* A caret begins a control character, and stands for itself before a blank. A backslash would begin a number. */
void tn_dxf_put_text(tn_buffer *to, int code, const char *text)
{
    tn_buffer_printf(to, "%d\n", code);
    for (size_t left = strlen(text), size; left > 0; text += size, left -= size) {
        uint32_t c = tn_utf8_read(text, left, &size);
        if (c == '^')
            tn_buffer_append(to, "^ ", 2);
        else if (c == '\\')
            tn_buffer_printf(to, "\\U+%04X", (unsigned)c);
        else if (c < ' ' || c == 0x7F || (c == TN_REPLACEMENT && size == 1))
            tn_buffer_append(to, "?", 1);
        else
            tn_buffer_append(to, text, size);
    }
    tn_buffer_append(to, "\n", 1);
}

/* ---- the header */

static bool is_empty(const tn_dxf_box *box)
{
    return box->low[0] > box->high[0];
}

static void put_variable(tn_buffer *to, const char *name, int code, int value)
{
    tn_buffer_printf(to, "9\n$%s\n%d\n%d\n", name, code, value);
}

static void put_length(tn_buffer *to, const char *name, double length)
{
    tn_buffer_printf(to, "9\n$%s\n", name);
    tn_dxf_put(to, 40, length);
}

/* The height of capitals in dimensions, on paper. */
static double dimension_text(const tn_dxf_content *c)
{
    return c->dimension_text > 0 ? c->dimension_text : 1.8 / 25.4 * 72 * tn_dxf_paper_unit(&c->options);
}

static double dimension_factor(const tn_dxf_content *c)
{
    return c->options.feet || c->measure == TN_DXF_MILLIMETRES ? 1 : 0.001;
}

/* The style of dimensions once more: some programs (LibreCAD) know no other. */
static void put_dimension_variables(tn_buffer *to, const tn_dxf_content *c)
{
    double text = dimension_text(c);
    put_length(to, "DIMSCALE", c->options.scale > 0 ? c->options.scale : 1);
    put_length(to, "DIMTXT", text);
    put_length(to, "DIMASZ", text);
    put_length(to, "DIMEXO", 0.55 * text);
    put_length(to, "DIMEXE", 0.4 * text);
    put_length(to, "DIMTSZ", 0.4 * text);
    put_length(to, "DIMGAP", 0.4 * text);
    put_length(to, "DIMLFAC", dimension_factor(c));
    put_variable(to, "DIMLUNIT", 70, c->options.feet ? 4 : 2);
    put_variable(to, "DIMDEC", 70, c->options.feet ? 4 : 3);
    put_variable(to, "DIMZIN", 70, c->options.feet ? 0 : 8);
    put_variable(to, "DIMTAD", 70, 1);
    put_variable(to, "DIMTIH", 70, 0);
    put_variable(to, "DIMTOH", 70, 0);
}

static void put_corner(tn_buffer *to, const char *name, const tn_dxf_box *box, bool high, bool flat)
{
    const double *at = high ? box->high : box->low;
    tn_buffer_printf(to, "9\n$%s\n", name);
    tn_dxf_put(to, 10, is_empty(box) ? 0 : at[0]);
    tn_dxf_put(to, 20, is_empty(box) ? 0 : at[1]);
    if (!flat)
        tn_dxf_put(to, 30, 0);
}

static void put_header(tn_buffer *to, const tn_dxf_content *c)
{
    bool feet = c->options.feet;
    tn_buffer_printf(to,
                     "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1021\n9\n$DWGCODEPAGE\n3\nANSI_1252\n9\n$HANDSEED\n5\n%X"
                     "\n9\n$CLAYER\n8\n0\n9\n$TEXTSTYLE\n7\nSTANDARD\n9\n$DIMSTYLE\n2\nSTANDARD\n",
                     (unsigned)c->next_handle);
    put_variable(to, "INSUNITS", 70, feet ? 1 : 4);
    put_variable(to, "MEASUREMENT", 70, !feet);
    put_variable(to, "LUNITS", 70, feet ? 4 : 2);
    put_variable(to, "LUPREC", 70, feet ? 4 : 2);
    put_variable(to, "LWDISPLAY", 290, 1);
    put_variable(to, "PSLTSCALE", 70, 0);
    put_variable(to, "TILEMODE", 70, 1);
    put_dimension_variables(to, c);
    put_corner(to, "EXTMIN", &c->model_box, false, false);
    put_corner(to, "EXTMAX", &c->model_box, true, false);
    put_corner(to, "LIMMIN", &c->model_box, false, true);
    put_corner(to, "LIMMAX", &c->model_box, true, true);
    put_corner(to, "PEXTMIN", &c->paper_box, false, false);
    put_corner(to, "PEXTMAX", &c->paper_box, true, false);
    tn_buffer_printf(to, "0\nENDSEC\n0\nSECTION\n2\nCLASSES\n0\nCLASS\n1\nACDBDICTIONARYWDFLT\n2\n"
                         "AcDbDictionaryWithDefault\n3\nObjectDBX Classes\n90\n0\n91\n1\n280\n0\n281\n0\n0\nCLASS\n1\n"
                         "ACDBPLACEHOLDER\n2\nAcDbPlaceHolder\n3\nObjectDBX Classes\n90\n0\n91\n1\n280\n0\n281\n0\n0\n"
                         "CLASS\n1\nLAYOUT\n2\nAcDbLayout\n3\nObjectDBX Classes\n90\n0\n91\n2\n280\n0\n281\n0\n"
                         "0\nENDSEC\n");
}

/* ---- tables */

static void begin_table(tn_buffer *to, const char *name, uint32_t handle, size_t count)
{
    tn_buffer_printf(to, "0\nTABLE\n2\n%s\n5\n%X\n330\n0\n100\nAcDbSymbolTable\n70\n%zu\n", name, (unsigned)handle,
                     count);
}

/* An entry of a table, up to what its kind has of its own. */
static void begin_entry(tn_buffer *to, const char *table, const char *kind, uint32_t handle, uint32_t owner)
{
    bool dimension = owner == DIMSTYLE_TABLE; /* whose entries have their handles by another code */
    tn_buffer_printf(to, "0\n%s\n%d\n%X\n330\n%X\n100\nAcDbSymbolTableRecord\n100\n%s\n", table, dimension ? 105 : 5,
                     (unsigned)handle, (unsigned)owner, kind);
}

static void end_table(tn_buffer *to)
{
    tn_buffer_printf(to, "0\nENDTAB\n");
}

static void put_line_types(tn_buffer *to, tn_dxf_content *c)
{
    static const struct {
        const char *name, *shown;
    } plain[] = {{"ByBlock", ""}, {"ByLayer", ""}, {"Continuous", "Solid line"}};
    begin_table(to, "LTYPE", LTYPE_TABLE, 3 + c->dash_count);
    for (uint32_t i = 0; i < 3; i++) {
        begin_entry(to, "LTYPE", "AcDbLinetypeTableRecord", PLAIN_LINES + i, LTYPE_TABLE);
        tn_buffer_printf(to, "2\n%s\n70\n0\n3\n%s\n72\n65\n73\n0\n40\n0.0\n", plain[i].name, plain[i].shown);
    }
    for (size_t i = 0; i < c->dash_count; i++) {
        const tn_dxf_dashes *d = &c->dashes[i];
        uint32_t count = d->count % 2 ? 2 * d->count : d->count; /* an odd number of lengths: dashes become gaps */
        double length = 0;
        for (uint32_t k = 0; k < count; k++)
            length += d->lengths[k % d->count];
        begin_entry(to, "LTYPE", "AcDbLinetypeTableRecord", c->next_handle++, LTYPE_TABLE);
        tn_buffer_printf(to, "2\nDASHED-%zu\n70\n0\n3\n__ __ __\n72\n65\n73\n%u\n", i + 1, (unsigned)count);
        tn_dxf_put(to, 40, length);
        for (uint32_t k = 0; k < count; k++) {
            tn_dxf_put(to, 49, k % 2 ? -d->lengths[k % d->count] : d->lengths[k % d->count]);
            tn_buffer_printf(to, "74\n0\n");
        }
    }
    end_table(to);
}

static void put_layers(tn_buffer *to, const tn_dxf_content *c)
{
    size_t count = 1;
    for (int i = 1; i < TN_LAYER_COUNT; i++)
        count += c->used[i];
    begin_table(to, "LAYER", LAYER_TABLE, count);
    for (int i = 0; i < TN_LAYER_COUNT; i++) {
        if (i > 0 && !c->used[i])
            continue;
        begin_entry(to, "LAYER", "AcDbLayerTableRecord", (uint32_t)(FIRST_LAYER + i), LAYER_TABLE);
        tn_buffer_printf(to, "2\n%s\n70\n0\n62\n%d\n6\nContinuous\n%s370\n%d\n390\n%X\n",
                         tn_dxf_layer_name(&c->options, (tn_layer)i), layers[i].colour,
                         i == TN_LAYER_VIEWPORT ? "290\n0\n" : "", layers[i].weight, (unsigned)PLOT_STYLE);
    }
    end_table(to);
}

/* The view shows all that is in model space. */
static void put_active_viewport(tn_buffer *to, const tn_dxf_box *box)
{
    bool empty = is_empty(box);
    double width = empty ? 1 : box->high[0] - box->low[0], height = empty ? 1 : box->high[1] - box->low[1];
    begin_table(to, "VPORT", VPORT_TABLE, 1);
    begin_entry(to, "VPORT", "AcDbViewportTableRecord", ACTIVE_VIEWPORT, VPORT_TABLE);
    tn_buffer_printf(to, "2\n*Active\n70\n0\n10\n0.0\n20\n0.0\n11\n1.0\n21\n1.0\n");
    tn_dxf_put(to, 12, empty ? 0 : (box->low[0] + box->high[0]) / 2);
    tn_dxf_put(to, 22, empty ? 0 : (box->low[1] + box->high[1]) / 2);
    tn_buffer_printf(to,
                     "13\n0.0\n23\n0.0\n14\n10.0\n24\n10.0\n15\n10.0\n25\n10.0\n16\n0.0\n26\n0.0\n36\n1.0\n17\n0.0\n"
                     "27\n0.0\n37\n0.0\n");
    tn_dxf_put(to, 40, 1.1 * fmax(height, width / 1.5));
    tn_buffer_printf(to,
                     "41\n1.5\n42\n50.0\n43\n0.0\n44\n0.0\n50\n0.0\n51\n0.0\n71\n0\n72\n100\n73\n1\n74\n3\n75\n0\n76\n"
                     "0\n77\n0\n78\n0\n");
    end_table(to);
}

static void put_styles(tn_buffer *to)
{
    static const char *const styles[][2] = {{"STANDARD", "arial.ttf"}, {"BOLD", "arialbd.ttf"}};
    begin_table(to, "STYLE", STYLE_TABLE, 2);
    for (uint32_t i = 0; i < 2; i++) {
        begin_entry(to, "STYLE", "AcDbTextStyleTableRecord", TN_DXF_STYLE + i, STYLE_TABLE);
        tn_buffer_printf(to, "2\n%s\n70\n0\n40\n0.0\n41\n1.0\n50\n0.0\n71\n0\n42\n2.5\n3\n%s\n4\n\n", styles[i][0],
                         styles[i][1]);
    }
    end_table(to);
}

/* Oblique strokes, the text above the line; metres, or feet and inches to sixteenths, as Tartan writes them. Lengths
 * are those of paper. */
static void put_dimension_style(tn_buffer *to, const tn_dxf_content *c)
{
    bool feet = c->options.feet;
    double text = dimension_text(c);
    begin_table(to, "DIMSTYLE", DIMSTYLE_TABLE, 1);
    tn_buffer_printf(to, "100\nAcDbDimStyleTable\n");
    begin_entry(to, "DIMSTYLE", "AcDbDimStyleTableRecord", DIMENSION_STYLE, DIMSTYLE_TABLE);
    tn_buffer_printf(to, "2\nSTANDARD\n70\n0\n3\n%s\n", c->measure == TN_DXF_METRES_NAMED ? "<>m" : "");
    tn_dxf_put(to, 40, c->options.scale > 0 ? c->options.scale : 1);
    tn_dxf_put(to, 41, text);
    tn_dxf_put(to, 42, 0.55 * text);
    tn_dxf_put(to, 44, 0.4 * text);
    tn_dxf_put(to, 140, text);
    tn_dxf_put(to, 142, 0.4 * text);
    tn_dxf_put(to, 144, dimension_factor(c));
    tn_dxf_put(to, 147, 0.4 * text);
    tn_buffer_printf(to, "73\n0\n74\n0\n77\n1\n78\n%d\n271\n%d\n277\n%d\n340\n%X\n", feet ? 0 : 8, feet ? 4 : 3,
                     feet ? 4 : 2, (unsigned)TN_DXF_STYLE);
    end_table(to);
}

static void put_block_records(tn_buffer *to, const tn_dxf_content *c)
{
    begin_table(to, "BLOCK_RECORD", BLOCK_TABLE, 2 + c->block_count);
    begin_entry(to, "BLOCK_RECORD", "AcDbBlockTableRecord", TN_DXF_MODEL, BLOCK_TABLE);
    tn_buffer_printf(to, "2\n*Model_Space\n340\n%X\n", (unsigned)MODEL_LAYOUT);
    begin_entry(to, "BLOCK_RECORD", "AcDbBlockTableRecord", TN_DXF_PAPER, BLOCK_TABLE);
    tn_buffer_printf(to, "2\n*Paper_Space\n340\n%X\n", (unsigned)PAPER_LAYOUT);
    for (size_t i = 0; i < c->block_count; i++) {
        begin_entry(to, "BLOCK_RECORD", "AcDbBlockTableRecord", c->blocks[i].record, BLOCK_TABLE);
        tn_buffer_printf(to, "2\n%s\n340\n0\n70\n%d\n", c->blocks[i].name, c->options.feet ? 1 : 4);
    }
    end_table(to);
}

static void put_tables(tn_buffer *to, tn_dxf_content *c)
{
    tn_buffer_printf(to, "0\nSECTION\n2\nTABLES\n");
    put_active_viewport(to, &c->model_box);
    put_line_types(to, c);
    put_layers(to, c);
    put_styles(to);
    begin_table(to, "VIEW", VIEW_TABLE, 0);
    end_table(to);
    begin_table(to, "UCS", UCS_TABLE, 0);
    end_table(to);
    begin_table(to, "APPID", APPID_TABLE, 1);
    begin_entry(to, "APPID", "AcDbRegAppTableRecord", APPLICATION, APPID_TABLE);
    tn_buffer_printf(to, "2\nACAD\n70\n0\n");
    end_table(to);
    put_dimension_style(to, c);
    put_block_records(to, c);
    tn_buffer_printf(to, "0\nENDSEC\n");
}

/* ---- blocks */

static void put_block(tn_buffer *to, const char *name, uint32_t record, const uint32_t handles[2], bool paper,
                      const tn_buffer *entities)
{
    const char *space = paper ? "67\n1\n" : "";
    int flags = strncmp(name, "*D", 2) == 0; /* without a name of its own */
    tn_buffer_printf(
        to,
        "0\nBLOCK\n5\n%X\n330\n%X\n100\nAcDbEntity\n%s8\n0\n100\nAcDbBlockBegin\n2\n%s\n70\n%d\n10\n0.0\n20"
        "\n0.0\n30\n0.0\n3\n%s\n1\n\n",
        (unsigned)handles[0], (unsigned)record, space, name, flags, name);
    if (entities)
        tn_buffer_append(to, entities->data ? entities->data : "", entities->size);
    tn_buffer_printf(to, "0\nENDBLK\n5\n%X\n330\n%X\n100\nAcDbEntity\n%s8\n0\n100\nAcDbBlockEnd\n",
                     (unsigned)handles[1], (unsigned)record, space);
}

static void put_blocks(tn_buffer *to, const tn_dxf_content *c)
{
    static const uint32_t model[] = {MODEL_BLOCK, MODEL_BLOCK + 1}, paper[] = {PAPER_BLOCK, PAPER_BLOCK + 1};
    tn_buffer_printf(to, "0\nSECTION\n2\nBLOCKS\n");
    put_block(to, "*Model_Space", TN_DXF_MODEL, model, false, NULL);
    put_block(to, "*Paper_Space", TN_DXF_PAPER, paper, true, NULL);
    for (size_t i = 0; i < c->block_count; i++) {
        const tn_dxf_block *b = &c->blocks[i];
        const uint32_t handles[] = {b->begin, b->end};
        put_block(to, b->name, b->record, handles, false, &b->entities);
    }
    tn_buffer_printf(to, "0\nENDSEC\n");
}

/* ---- objects */

static void begin_dictionary(tn_buffer *to, uint32_t handle, uint32_t owner)
{
    tn_buffer_printf(to, "0\nDICTIONARY\n5\n%X\n330\n%X\n100\nAcDbDictionary\n281\n1\n", (unsigned)handle,
                     (unsigned)owner);
}

/* A sheet of paper, in its own units, printed at 1:1. */
static void put_layout(tn_buffer *to, const tn_dxf_content *c, const char *name, bool paper)
{
    enum { OF_MODEL = 1024 | 688, OF_PAPER = 688 };
    const tn_dxf_box *box = paper ? &c->paper_box : &c->model_box;
    double mm = 25.4 / 72, unit = tn_dxf_paper_unit(&c->options);
    tn_buffer_printf(
        to,
        "0\nLAYOUT\n5\n%X\n330\n%X\n100\nAcDbPlotSettings\n1\n\n2\nnone_device\n4\n\n6\n\n40\n0.0\n41\n0.0\n"
        "42\n0.0\n43\n0.0\n",
        (unsigned)(paper ? PAPER_LAYOUT : MODEL_LAYOUT), (unsigned)LAYOUTS);
    tn_dxf_put(to, 44, c->options.width * mm);
    tn_dxf_put(to, 45, c->options.height * mm);
    tn_buffer_printf(
        to,
        "46\n0.0\n47\n0.0\n48\n0.0\n49\n0.0\n140\n0.0\n141\n0.0\n142\n1.0\n143\n1.0\n70\n%d\n72\n%d\n73\n0\n"
        "74\n5\n7\n\n75\n16\n147\n1.0\n148\n0.0\n149\n0.0\n100\nAcDbLayout\n",
        paper ? OF_PAPER : OF_MODEL, c->options.feet ? 0 : 1);
    tn_dxf_put_text(to, 1, name);
    tn_buffer_printf(to, "70\n1\n71\n%d\n10\n0.0\n20\n0.0\n", paper);
    tn_dxf_put(to, 11, c->options.width * unit);
    tn_dxf_put(to, 21, c->options.height * unit);
    put_point(to, 12, 0, 0);
    put_point(to, 14, is_empty(box) ? 0 : box->low[0], is_empty(box) ? 0 : box->low[1]);
    put_point(to, 15, is_empty(box) ? 0 : box->high[0], is_empty(box) ? 0 : box->high[1]);
    tn_buffer_printf(
        to,
        "146\n0.0\n13\n0.0\n23\n0.0\n33\n0.0\n16\n1.0\n26\n0.0\n36\n0.0\n17\n0.0\n27\n1.0\n37\n0.0\n76\n1\n"
        "330\n%X\n",
        (unsigned)(paper ? TN_DXF_PAPER : TN_DXF_MODEL));
}

/* The name of the layout: the title, without what a name may not have. */
static void name_layout(const char *title, char name[64])
{
    size_t used = 0;
    if (title)
        tn_utf8_copy(title, 64, name);
    else
        name[0] = '\0';
    for (; name[used]; used++)
        if (strchr("<>/\\\":;?*|,=`", name[used]) || (unsigned char)name[used] < ' ')
            name[used] = '-';
    if (used == 0 || strcmp(name, "Model") == 0)
        strcpy(name, "Sheet");
}

static void put_objects(tn_buffer *to, const tn_dxf_content *c)
{
    char name[64];
    name_layout(c->options.title, name);
    tn_buffer_printf(to, "0\nSECTION\n2\nOBJECTS\n");
    begin_dictionary(to, ROOT, 0);
    tn_buffer_printf(to, "3\nACAD_GROUP\n350\n%X\n3\nACAD_LAYOUT\n350\n%X\n3\nACAD_PLOTSTYLENAME\n350\n%X\n",
                     (unsigned)GROUPS, (unsigned)LAYOUTS, (unsigned)PLOT_STYLES);
    begin_dictionary(to, GROUPS, ROOT);
    begin_dictionary(to, LAYOUTS, ROOT);
    tn_buffer_printf(to, "3\nModel\n350\n%X\n", (unsigned)MODEL_LAYOUT);
    tn_dxf_put_text(to, 3, name);
    tn_buffer_printf(to, "350\n%X\n", (unsigned)PAPER_LAYOUT);
    tn_buffer_printf(to,
                     "0\nACDBDICTIONARYWDFLT\n5\n%X\n330\n%X\n100\nAcDbDictionary\n281\n1\n3\nNormal\n350\n%X\n100\n"
                     "AcDbDictionaryWithDefault\n340\n%X\n0\nACDBPLACEHOLDER\n5\n%X\n330\n%X\n",
                     (unsigned)PLOT_STYLES, (unsigned)ROOT, (unsigned)PLOT_STYLE, (unsigned)PLOT_STYLE,
                     (unsigned)PLOT_STYLE, (unsigned)PLOT_STYLES);
    put_layout(to, c, "Model", false);
    put_layout(to, c, name, true);
    tn_buffer_printf(to, "0\nENDSEC\n0\nEOF\n");
}

tn_status tn_dxf_write(tn_dxf_content *content, FILE *out)
{
    tn_buffer before = {0}, after = {0}, tables = {0};
    put_tables(&tables, content); /* takes the last handles, which the header knows of */
    put_header(&before, content);
    put_blocks(&tables, content);
    put_objects(&after, content);
    const tn_buffer *parts[] = {&before, &tables, &content->model, &content->paper, &after};
    bool failed = false;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        failed |= parts[i]->failed;
    for (size_t i = 0; i < content->block_count; i++)
        failed |= content->blocks[i].entities.failed;
    for (size_t i = 0; !failed && i < sizeof parts / sizeof *parts; i++) {
        if (i == 2)
            fputs("0\nSECTION\n2\nENTITIES\n", out);
        if (parts[i]->size > 0)
            fwrite(parts[i]->data, 1, parts[i]->size, out);
        if (i == 3)
            fputs("0\nENDSEC\n", out);
    }
    free(before.data);
    free(tables.data);
    free(after.data);
    return failed ? TN_MEMORY : TN_OK;
}
