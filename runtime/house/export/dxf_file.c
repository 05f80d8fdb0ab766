/* Writes the parts of a DXF file that are the same for all drawings. */
#include "runtime/house/export/dxf_file.h"

#include <string.h>

#include "runtime/base/utf8.h"

/* Handles: each table, block and object has one, and entities those from FIRST_ENTITY on, below HANDLE_SEED. */
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
    MODEL_RECORD,
    PAPER_RECORD,
    MODEL_LAYOUT,
    PAPER_LAYOUT,
    FIRST_OTHER = 0x40,
    FIRST_LAYER = 0x60,
    FIRST_ENTITY = 0x1000,
    HANDLE_SEED = 0x7ffffff0
};

static void begin_table(FILE *out, const char *name, uint32_t handle, size_t count)
{
    fprintf(out, "0\nTABLE\n2\n%s\n5\n%X\n330\n0\n100\nAcDbSymbolTable\n70\n%zu\n", name, (unsigned)handle, count);
}

/* An entry of a table, up to what its kind has of its own. */
static void begin_entry(FILE *out, const char *table, const char *kind, uint32_t handle, uint32_t owner)
{
    fprintf(out, "0\n%s\n5\n%X\n330\n%X\n100\nAcDbSymbolTableRecord\n100\n%s\n", table, (unsigned)handle,
            (unsigned)owner, kind);
}

static void end_table(FILE *out)
{
    fputs("0\nENDTAB\n", out);
}

static void write_line_types(FILE *out)
{
    static const struct {
        const char *name, *shown;
    } plain[] = {{"ByBlock", ""}, {"ByLayer", ""}, {"Continuous", "Solid line"}};
    begin_table(out, "LTYPE", LTYPE_TABLE, 4);
    for (uint32_t i = 0; i < 3; i++) {
        begin_entry(out, "LTYPE", "AcDbLinetypeTableRecord", FIRST_OTHER + i, LTYPE_TABLE);
        fprintf(out, "2\n%s\n70\n0\n3\n%s\n72\n65\n73\n0\n40\n0.0\n", plain[i].name, plain[i].shown);
    }
    begin_entry(out, "LTYPE", "AcDbLinetypeTableRecord", FIRST_OTHER + 3, LTYPE_TABLE);
    fputs("2\nDASHED\n70\n0\n3\n__ __ __\n72\n65\n73\n2\n40\n300.0\n49\n200.0\n74\n0\n49\n-100.0\n74\n0\n", out);
    end_table(out);
}

static void write_layers(FILE *out, const tn_dxf_layer *layers, size_t count)
{
    static const tn_dxf_layer first = {"0", 7, false};
    begin_table(out, "LAYER", LAYER_TABLE, count + 1);
    for (size_t i = 0; i <= count; i++) {
        const tn_dxf_layer *layer = i == 0 ? &first : &layers[i - 1];
        begin_entry(out, "LAYER", "AcDbLayerTableRecord", (uint32_t)(FIRST_LAYER + i), LAYER_TABLE);
        fprintf(out, "2\n%s\n70\n0\n62\n%d\n6\n%s\n", layer->name, layer->colour,
                layer->dashed ? "DASHED" : "Continuous");
    }
    end_table(out);
}

/* The view shows all drawings. */
static void write_viewport(FILE *out, double width, double height)
{
    begin_table(out, "VPORT", VPORT_TABLE, 1);
    begin_entry(out, "VPORT", "AcDbViewportTableRecord", FIRST_OTHER + 4, VPORT_TABLE);
    fprintf(out,
            "2\n*Active\n70\n0\n10\n0.0\n20\n0.0\n11\n1.0\n21\n1.0\n12\n%.6f\n22\n%.6f\n13\n0.0\n23\n0.0\n14\n10."
            "0\n24\n10.0\n"
            "15\n10.0\n25\n10.0\n16\n0.0\n26\n0.0\n36\n1.0\n17\n0.0\n27\n0.0\n37\n0.0\n40\n%.6f\n41\n1.5\n42\n50."
            "0\n43\n0.0\n"
            "44\n0.0\n50\n0.0\n51\n0.0\n71\n0\n72\n100\n73\n1\n74\n3\n75\n0\n76\n0\n77\n0\n78\n0\n",
            width / 2, height / 2, 1.1 * (height > width / 1.5 ? height : width / 1.5));
    end_table(out);
}

static void write_tables(FILE *out, const tn_dxf_layer *layers, size_t count, double width, double height)
{
    fputs("0\nSECTION\n2\nTABLES\n", out);
    write_viewport(out, width, height);
    write_line_types(out);
    write_layers(out, layers, count);
    begin_table(out, "STYLE", STYLE_TABLE, 1);
    begin_entry(out, "STYLE", "AcDbTextStyleTableRecord", FIRST_OTHER + 5, STYLE_TABLE);
    fputs("2\nStandard\n70\n0\n40\n0.0\n41\n1.0\n50\n0.0\n71\n0\n42\n100.0\n3\ntxt\n4\n\n", out);
    end_table(out);
    begin_table(out, "VIEW", VIEW_TABLE, 0);
    end_table(out);
    begin_table(out, "UCS", UCS_TABLE, 0);
    end_table(out);
    begin_table(out, "APPID", APPID_TABLE, 1);
    begin_entry(out, "APPID", "AcDbRegAppTableRecord", FIRST_OTHER + 6, APPID_TABLE);
    fputs("2\nACAD\n70\n0\n", out);
    end_table(out);
    begin_table(out, "DIMSTYLE", DIMSTYLE_TABLE, 1);
    fprintf(out,
            "100\nAcDbDimStyleTable\n0\nDIMSTYLE\n105\n%X\n330\n%X\n100\nAcDbSymbolTableRecord\n100\n"
            "AcDbDimStyleTableRecord\n2\nStandard\n70\n0\n",
            FIRST_OTHER + 7u, (unsigned)DIMSTYLE_TABLE);
    end_table(out);
    begin_table(out, "BLOCK_RECORD", BLOCK_TABLE, 2);
    begin_entry(out, "BLOCK_RECORD", "AcDbBlockTableRecord", MODEL_RECORD, BLOCK_TABLE);
    fprintf(out, "2\n*Model_Space\n340\n%X\n", (unsigned)MODEL_LAYOUT);
    begin_entry(out, "BLOCK_RECORD", "AcDbBlockTableRecord", PAPER_RECORD, BLOCK_TABLE);
    fprintf(out, "2\n*Paper_Space\n340\n%X\n", (unsigned)PAPER_LAYOUT);
    end_table(out);
    fputs("0\nENDSEC\n", out);
}

static void write_block(FILE *out, const char *name, uint32_t record, uint32_t handle, bool paper)
{
    const char *space = paper ? "67\n1\n" : "";
    fprintf(out,
            "0\nBLOCK\n5\n%X\n330\n%X\n100\nAcDbEntity\n%s8\n0\n100\nAcDbBlockBegin\n2\n%s\n70\n0\n10\n0.0\n20\n0."
            "0\n30\n0.0\n"
            "3\n%s\n1\n\n0\nENDBLK\n5\n%X\n330\n%X\n100\nAcDbEntity\n%s8\n0\n100\nAcDbBlockEnd\n",
            (unsigned)handle, (unsigned)record, space, name, name, (unsigned)handle + 1, (unsigned)record, space);
}

void tn_dxf_begin(FILE *out, const tn_dxf_layer *layers, size_t count, double width, double height)
{
    fprintf(out,
            "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$DWGCODEPAGE\n3\nANSI_1252\n9\n$HANDSEED\n5\n%X\n9\n$"
            "INSUNITS\n70\n4\n0\nENDSEC\n"
            "0\nSECTION\n2\nCLASSES\n0\nENDSEC\n",
            (unsigned)HANDLE_SEED);
    write_tables(out, layers, count, width, height);
    fputs("0\nSECTION\n2\nBLOCKS\n", out);
    write_block(out, "*Model_Space", MODEL_RECORD, FIRST_OTHER + 8, false);
    write_block(out, "*Paper_Space", PAPER_RECORD, FIRST_OTHER + 10, true);
    fputs("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n", out);
}

void tn_dxf_entity(FILE *out, const char *entity, uint32_t handle, const char *layer)
{
    fprintf(out, "0\n%s\n5\n%X\n330\n%X\n100\nAcDbEntity\n8\n%s\n", entity, (unsigned)FIRST_ENTITY + handle,
            (unsigned)MODEL_RECORD, layer);
}

/* A caret begins a control character, and stands for itself before a blank. A backslash begins a number. */
void tn_dxf_text(FILE *out, const char *text)
{
    for (size_t left = strlen(text), size; left > 0; text += size, left -= size) {
        uint32_t c = tn_utf8_read(text, left, &size), above = c - 0x10000;
        if (c == '^')
            fputs("^ ", out);
        else if (c >= ' ' && c <= '~' && c != '\\')
            putc((int)c, out);
        else if (c <= UINT16_MAX)
            fprintf(out, "\\U+%04X", (unsigned)c);
        else
            fprintf(out, "\\U+%04X\\U+%04X", (unsigned)(0xD800 | above >> 10), (unsigned)(0xDC00 | (above & 0x3FF)));
    }
}

static void begin_dictionary(FILE *out, uint32_t handle, uint32_t owner)
{
    fprintf(out, "0\nDICTIONARY\n5\n%X\n330\n%X\n100\nAcDbDictionary\n281\n1\n", (unsigned)handle, (unsigned)owner);
}

/* A layout of an A4 sheet that nothing is on: programs ask for one of each space. */
static void write_layout(FILE *out, const char *name, uint32_t handle, uint32_t record, int order, int flags)
{
    fprintf(out,
            "0\nLAYOUT\n5\n%X\n330\n%X\n100\nAcDbPlotSettings\n1\n\n2\nnone_device\n4\nA4\n6\n\n40\n7.5\n41\n20."
            "0\n42\n7.5\n43\n20.0\n"
            "44\n210.0\n45\n297.0\n46\n0.0\n47\n0.0\n48\n0.0\n49\n0.0\n140\n0.0\n141\n0.0\n142\n1.0\n143\n1.0\n70\n%"
            "d\n72\n1\n"
            "73\n0\n74\n5\n7\n\n75\n16\n147\n1.0\n148\n0.0\n149\n0.0\n100\nAcDbLayout\n1\n%s\n70\n1\n71\n%d\n10\n0."
            "0\n20\n0.0\n"
            "11\n420.0\n21\n297.0\n12\n0.0\n22\n0.0\n32\n0.0\n14\n0.0\n24\n0.0\n34\n0.0\n15\n0.0\n25\n0.0\n35\n0."
            "0\n146\n0.0\n"
            "13\n0.0\n23\n0.0\n33\n0.0\n16\n1.0\n26\n0.0\n36\n0.0\n17\n0.0\n27\n1.0\n37\n0.0\n76\n1\n330\n%X\n",
            (unsigned)handle, (unsigned)LAYOUTS, flags, name, order, (unsigned)record);
}

void tn_dxf_end(FILE *out)
{
    enum { OF_MODEL = 1024 | 688, OF_PAPER = 688 };
    fputs("0\nENDSEC\n0\nSECTION\n2\nOBJECTS\n", out);
    begin_dictionary(out, ROOT, 0);
    fprintf(out, "3\nACAD_GROUP\n350\n%X\n3\nACAD_LAYOUT\n350\n%X\n", (unsigned)GROUPS, (unsigned)LAYOUTS);
    begin_dictionary(out, GROUPS, ROOT);
    begin_dictionary(out, LAYOUTS, ROOT);
    fprintf(out, "3\nModel\n350\n%X\n3\nLayout1\n350\n%X\n", (unsigned)MODEL_LAYOUT, (unsigned)PAPER_LAYOUT);
    write_layout(out, "Model", MODEL_LAYOUT, MODEL_RECORD, 0, OF_MODEL);
    write_layout(out, "Layout1", PAPER_LAYOUT, PAPER_RECORD, 1, OF_PAPER);
    fputs("0\nENDSEC\n0\nEOF\n", out);
}
