/* 3MF, by the core specification of the 3MF Consortium (version 1.3): a ZIP archive of three parts, here stored as they
 * are. Millimetres or another unit, z up. Faces with colours are one object, each triangle of the base material (3.4.2)
 * that is its group's colour: the core has no other colours, and programs that know no extension show these. Without
 * colours, each group of faces is an object of its own. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/write.h"
#include "runtime/geometry/write_text.h"

/* ---- ZIP (PKWARE's APPNOTE, 4.3): entries, then a directory of them */

enum { LOCAL_SIZE = 30, DIRECTORY_SIZE = 46, END_SIZE = 22, ENTRIES_MAX = 3 };

#define ZIP_MAX UINT32_MAX /* larger ones need another format */

typedef struct entry {
    const char *name;
    uint32_t check, size, offset;
} entry;

typedef struct archive {
    FILE *out;
    entry entries[ENTRIES_MAX];
    uint16_t count;
    uint64_t offset;
} archive;

/* CRC-32 of ISO 3309, four bits at a time. */
static uint32_t check_of(const char *bytes, size_t size)
{
    static const uint32_t table[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                       0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                       0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    uint32_t check = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        check ^= (unsigned char)bytes[i];
        check = check >> 4 ^ table[check & 15];
        check = check >> 4 ^ table[check & 15];
    }
    return ~check;
}

/* Little-endian fields of 2 and 4 bytes, as `sizes` says: a digit each. */
static size_t put_fields(unsigned char *to, const char *sizes, const uint32_t *values)
{
    size_t at = 0;
    for (size_t i = 0; sizes[i]; i++)
        for (int byte = 0; byte < sizes[i] - '0'; byte++)
            to[at++] = (unsigned char)(values[i] >> 8 * byte);
    return at;
}

/* The day of all entries, 1 January 1980, is the first that ZIP has: files do not depend on the clock. */
#define DAY 0x21u

static void add_entry(archive *zip, const char *name, const char *bytes, size_t size)
{
    unsigned char head[LOCAL_SIZE];
    uint32_t length = (uint32_t)strlen(name), whole = (uint32_t)size;
    entry *e = &zip->entries[zip->count++];
    *e = (entry){name, check_of(bytes, size), whole, (uint32_t)zip->offset};
    const uint32_t fields[] = {0x04034b50, 20, 0, 0, 0, DAY, e->check, whole, whole, length, 0};
    fwrite(head, 1, put_fields(head, "42222244422", fields), zip->out);
    fwrite(name, 1, length, zip->out);
    fwrite(bytes, 1, size, zip->out);
    zip->offset += LOCAL_SIZE + length + size;
}

static void end_archive(archive *zip)
{
    unsigned char head[DIRECTORY_SIZE];
    uint32_t start = (uint32_t)zip->offset, size = 0;
    for (uint16_t i = 0; i < zip->count; i++) {
        const entry *e = &zip->entries[i];
        uint32_t length = (uint32_t)strlen(e->name);
        const uint32_t fields[] = {0x02014b50, 20,     20, 0, 0, 0, DAY, e->check, e->size,
                                   e->size,    length, 0,  0, 0, 0, 0,   e->offset};
        fwrite(head, 1, put_fields(head, "42222224442222244", fields), zip->out);
        fwrite(e->name, 1, length, zip->out);
        size += DIRECTORY_SIZE + length;
    }
    const uint32_t fields[] = {0x06054b50, 0, 0, zip->count, zip->count, size, start, 0};
    fwrite(head, 1, put_fields(head, "42222442", fields), zip->out);
}

/* ---- the parts */

static const char content_types[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

static const char relations[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

/* Text that may hold any characters. */
static void add_plain(tn_text_out *out, const char *text)
{
    for (; *text; text++) {
        char one[2] = {(unsigned char)*text < ' ' ? ' ' : *text, '\0'};
        tn_text_add(out, *text == '<' ? "&lt;" : *text == '&' ? "&amp;" : *text == '"' ? "&quot;" : one);
        tn_text_flush(out, false);
    }
}

#define ALL UINT32_MAX /* groups */
#define MATERIALS "1"  /* the id of the base materials */

static uint32_t object_id(uint32_t group)
{
    return group == ALL ? 2 : group + 1;
}

static bool is_of(const tn_mesh *mesh, size_t face, uint32_t group)
{
    return group == ALL || !mesh->face_group || mesh->face_group[face] == group;
}

/* The vertices that the faces of a group have, numbered anew. */
static void add_vertices(tn_text_out *out, const tn_mesh *mesh, uint32_t group, uint32_t *number)
{
    uint32_t count = 0;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        number[v] = UINT32_MAX;
    for (size_t i = 0; i < mesh->face_first[mesh->face_count]; i++) {
        uint32_t v = mesh->corners[i];
        if (!is_of(mesh, i / 3, group) || number[v] != UINT32_MAX)
            continue;
        number[v] = count++;
        static const char *const before[3] = {"<vertex x=\"", "\" y=\"", "\" z=\""};
        for (int axis = 0; axis < 3; axis++) {
            tn_text_add(out, before[axis]);
            tn_text_decimal(out, mesh->positions[3 * (size_t)v + (size_t)axis]);
        }
        tn_text_add(out, "\"/>\n");
        tn_text_flush(out, false);
    }
}

static void add_triangles(tn_text_out *out, const tn_mesh *mesh, uint32_t group, const uint32_t *number)
{
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (!is_of(mesh, f, group))
            continue;
        static const char *const before[3] = {"<triangle v1=\"", "\" v2=\"", "\" v3=\""};
        for (size_t k = 0; k < 3; k++) {
            tn_text_add(out, before[k]);
            tn_text_whole(out, number[mesh->corners[3 * f + k]]);
        }
        if (group == ALL) {
            tn_text_add(out, "\" pid=\"" MATERIALS "\" p1=\"");
            tn_text_whole(out, mesh->face_group[f]);
        }
        tn_text_add(out, "\"/>\n");
        tn_text_flush(out, false);
    }
}

static void add_object(tn_text_out *out, const tn_mesh *mesh, uint32_t group, uint32_t *number)
{
    tn_text_add(out, "<object id=\"");
    tn_text_whole(out, object_id(group));
    tn_text_add(out, "\" type=\"model\"");
    if (group == ALL) {
        tn_text_add(out, " pid=\"" MATERIALS "\" pindex=\"0\"");
    } else if (mesh->group_names) {
        tn_text_add(out, " name=\"");
        add_plain(out, mesh->group_names[group]);
        tn_text_add(out, "\"");
    }
    tn_text_add(out, "><mesh><vertices>\n");
    add_vertices(out, mesh, group, number);
    tn_text_add(out, "</vertices><triangles>\n");
    add_triangles(out, mesh, group, number);
    tn_text_add(out, "</triangles></mesh></object>\n");
}

static void add_materials(tn_text_out *out, const tn_mesh *mesh, const tn_mesh_style *style)
{
    tn_text_add(out, "<basematerials id=\"" MATERIALS "\">\n");
    for (uint32_t group = 0; group < mesh->group_count; group++) {
        unsigned char rgb[3];
        char colour[64];
        tn_mesh_style_colour(style, group, rgb);
        tn_text_add(out, "<base name=\"");
        add_plain(out, mesh->group_names ? mesh->group_names[group] : "colour");
        snprintf(colour, sizeof colour, "\" displaycolor=\"#%02X%02X%02X\"/>\n", rgb[0], rgb[1], rgb[2]);
        tn_text_add(out, colour);
        tn_text_flush(out, false);
    }
    tn_text_add(out, "</basematerials>\n");
}

/* Where an object is put. */
static void add_item(tn_text_out *out, uint32_t group)
{
    tn_text_add(out, "<item objectid=\"");
    tn_text_whole(out, object_id(group));
    tn_text_add(out, "\"/>\n");
    tn_text_flush(out, false);
}

static void add_model(tn_text_out *out, const tn_mesh *mesh, const tn_mesh_style *style, uint32_t *number, bool *any)
{
    static const char *const units[TN_MESH_UNIT_COUNT] = {"millimeter", "millimeter", "centimeter",
                                                          "meter",      "inch",       "foot"};
    bool coloured = mesh->face_group && style->colours;
    uint32_t objects = mesh->face_group && !coloured ? mesh->group_count : 1;
    tn_text_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"");
    tn_text_add(out, units[style->unit]);
    tn_text_add(out, "\" xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n");
    tn_text_add(out, "<metadata name=\"Application\">tartan</metadata>\n");
    for (size_t i = 0; i < style->note_count; i++) {
        tn_text_add(out, i ? "\n" : "<metadata name=\"Description\">");
        add_plain(out, style->notes[i]);
    }
    tn_text_add(out, style->note_count ? "</metadata>\n<resources>\n" : "<resources>\n");
    for (size_t f = 0; f < mesh->face_count; f++) /* an object has a face at least */
        any[mesh->face_group && !coloured ? mesh->face_group[f] : 0] = true;
    if (coloured)
        add_materials(out, mesh, style);
    for (uint32_t group = 0; group < objects; group++)
        if (any[group])
            add_object(out, mesh, coloured ? ALL : group, number);
    tn_text_add(out, "</resources><build>\n");
    for (uint32_t group = 0; group < objects; group++)
        if (any[group])
            add_item(out, coloured ? ALL : group);
    tn_text_add(out, "</build></model>\n");
    tn_text_flush(out, true);
}

/* The model's text. The caller frees it. */
static tn_status make_model(const tn_mesh *mesh, const tn_mesh_style *style, char **bytes, size_t *size,
                            tn_error *error)
{
    double largest = 1;
    *bytes = NULL;
    FILE *stream = open_memstream(bytes, size);
    tn_text_out *out = malloc(sizeof *out);
    uint32_t *number = malloc((mesh->vertex_count + 1) * sizeof *number);
    bool *any = calloc(mesh->group_count + 1, sizeof *any), well = stream && out && number && any;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        largest = fmax(largest, fabs(mesh->positions[i]));
    if (well) {
        tn_text_begin(out, stream, largest);
        add_model(out, mesh, style, number, any);
    }
    well = stream && !ferror(stream) && well;
    well = stream && fclose(stream) == 0 && well;
    free(out);
    free(number);
    free(any);
    return well ? TN_OK : tn_fail_memory(error);
}

tn_status tn_mesh_write_3mf(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error)
{
    char *model;
    size_t size = 0;
    tn_status status = make_model(mesh, style, &model, &size, error);
    if (status == TN_OK && size > ZIP_MAX - 4096) {
        status = tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE, "a 3MF file of %zu bytes would be too large", size);
        tn_error_help(error, "the limit is 4 GB; write a .stl, or reduce the mesh with --decimate");
    }
    if (status == TN_OK) {
        archive zip = {.out = out};
        add_entry(&zip, "[Content_Types].xml", content_types, sizeof content_types - 1);
        add_entry(&zip, "_rels/.rels", relations, sizeof relations - 1);
        add_entry(&zip, "3D/3dmodel.model", model, size);
        end_archive(&zip);
    }
    free(model);
    return status;
}
