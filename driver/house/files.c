/* Writes a house as files of each kind. */
#include "driver/house/files.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/house/values.h"
#include "runtime/geometry/write.h"
#include "runtime/house/export/export.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"

static const struct {
    const char *ending;
    tn_file_format format;
} kinds[TN_HOUSE_FILES] = {
    [TN_HOUSE_AS_LINE] = {NULL, TN_FILE_OTHER}, [TN_HOUSE_AS_JSON] = {".json", TN_FILE_JSON},
    [TN_HOUSE_AS_CSV] = {".csv", TN_FILE_CSV},  [TN_HOUSE_AS_PARTS] = {".parts.csv", TN_FILE_CSV},
    [TN_HOUSE_AS_OBJ] = {".obj", TN_FILE_OBJ},  [TN_HOUSE_AS_MTL] = {".mtl", TN_FILE_MTL},
    [TN_HOUSE_AS_PLY] = {".ply", TN_FILE_PLY},  [TN_HOUSE_AS_GLB] = {".glb", TN_FILE_GLB},
    [TN_HOUSE_AS_IFC] = {".ifc", TN_FILE_IFC},  [TN_HOUSE_AS_DXF] = {".dxf", TN_FILE_DXF},
    [TN_HOUSE_AS_SVG] = {".svg", TN_FILE_SVG},  [TN_HOUSE_AS_PDF] = {".pdf", TN_FILE_PDF},
    [TN_HOUSE_AS_PNG] = {".png", TN_FILE_PNG},
};

const char *tn_house_file_ending(tn_house_file kind)
{
    return kinds[kind].ending;
}

tn_house_file tn_house_file_of(const char *path)
{
    size_t size = strlen(path);
    for (int i = TN_HOUSE_FILES - 1; i > 0; i--) { /* `.parts.csv` before `.csv` */
        size_t length = strlen(kinds[i].ending);
        if (size > length && strcasecmp(path + size - length, kinds[i].ending) == 0)
            return (tn_house_file)i;
    }
    return TN_HOUSE_FILES;
}

tn_file_format tn_house_file_format(tn_house_file kind)
{
    return kinds[kind].format;
}

bool tn_house_file_draws(tn_house_file kind)
{
    return kind >= TN_HOUSE_AS_DXF && kind <= TN_HOUSE_AS_PNG;
}

/* What it is called on sheets and in building models. */
static const char *title_of(const tn_house_filed *filed)
{
    const tn_house_form *form = filed->house->form;
    const char *doc = tn_text(form->module, form->record->doc);
    if (filed->title)
        return filed->title;
    return doc[0] ? doc : tn_text(form->module, form->record->name);
}

/* With what the file's measures are worth. */
static tn_status describe(const tn_house_filed *filed, tn_buffer *text, tn_error *error)
{
    tn_house_valuer *valuer;
    tn_status status = tn_house_valuer_new(filed->house->form, filed->house->length, NULL, 0, &valuer, error);
    if (status == TN_OK)
        status = tn_house_values_find(valuer, filed->house, NULL, error);
    if (status == TN_OK) {
        size_t count;
        const tn_house_value *values = tn_house_values(valuer, &count);
        status = tn_house_describe(filed->house, filed->solids, values, count, text, error);
    }
    tn_house_valuer_free(valuer);
    return status;
}

static tn_status write_text(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error)
{
    const tn_house *house = filed->house;
    tn_buffer text = {0};
    tn_status status = kind == TN_HOUSE_AS_JSON  ? describe(filed, &text, error)
                       : kind == TN_HOUSE_AS_CSV ? tn_house_schedule(house, &text, error)
                                                 : tn_house_parts(house, filed->solids, &text, error);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return status;
}

/* PLY has colours and no names. */
static tn_status write_ply(const tn_house_filed *filed, FILE *out, tn_error *error)
{
    tn_mesh mesh;
    unsigned char colours[TN_HOUSE_GROUPS_MAX][3];
    const tn_mesh_style style = {.unit = TN_MESH_UNIT_M, .colours = (const unsigned char(*)[3])colours};
    tn_house_mesh_colours(filed->house->form, colours);
    tn_status status = tn_house_mesh(filed->house, filed->solids, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_write_ply(&mesh, &style, out, error);
    tn_mesh_clear(&mesh);
    return status;
}

static tn_status write_named(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_mesh mesh;
    tn_mesh_model model;
    const char *notes[] = {filed->line};
    const char *line = kind == TN_HOUSE_AS_GLB ? filed->line : NULL; /* with other facts */
    tn_status status = tn_house_model(filed->house, filed->solids, title_of(filed), line, &mesh, &model, error);
    const tn_mesh_style style = {.notes = notes,
                                 .note_count = line ? 0 : 1,
                                 .unit = TN_MESH_UNIT_M,
                                 .model = &model,
                                 .mtl = filed->mtl ? filed->mtl : "house.mtl"};
    if (status == TN_OK)
        status = kind == TN_HOUSE_AS_OBJ   ? tn_mesh_write_obj(&mesh, &style, out, error)
                 : kind == TN_HOUSE_AS_MTL ? tn_mesh_write_mtl(&model, out, error)
                                           : tn_mesh_write_glb(&mesh, &style, out, error);
    tn_mesh_model_clear(&model);
    tn_mesh_clear(&mesh);
    return status;
}

static tn_status draw(const tn_house_filed *filed, tn_house_drawing *drawing, tn_house_file kind, FILE *out,
                      tn_error *error)
{
    tn_picture to = {.format = kind == TN_HOUSE_AS_SVG   ? TN_CANVAS_SVG
                               : kind == TN_HOUSE_AS_PDF ? TN_CANVAS_PDF
                               : kind == TN_HOUSE_AS_DXF ? TN_CANVAS_DXF
                                                         : TN_CANVAS_PNG,
                     .dpi = filed->dpi,
                     .profile = filed->profile,
                     .watch = filed->watch};
    const char *notes[] = {filed->line};
    drawing->notes = notes;
    tn_status status = tn_house_draw(filed->house, filed->solids, drawing, &to, error);
    if (status == TN_OK)
        fwrite(to.element, 1, to.size, out);
    free(to.element);
    return status;
}

bool tn_house_time_stamp(const char *date, char stamp[TN_TIME_STAMP_TEXT])
{
    static const char form[] = "0000-00-00T00:00:00", day_only[] = "0000-00-00";
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    size_t size = strlen(date);
    int year, month, day, hour, minute, second;
    if (size != sizeof form - 1 && size != sizeof day_only - 1)
        return false;
    memcpy(stamp, form, sizeof form);
    for (size_t i = 0; i < size; i++) {
        if (form[i] == '0' ? date[i] < '0' || date[i] > '9' : date[i] != form[i])
            return false;
        stamp[i] = date[i];
    }
    sscanf(stamp, "%4d-%2d-%2dT%2d:%2d:%2d", &year, &month, &day, &hour, &minute, &second);
    bool leap = month == 2 && (year % 400 == 0 || (year % 4 == 0 && year % 100 != 0));
    return month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1] + leap && hour < 24 && minute < 60 &&
           second < 60;
}

/* Identifiers do not depend on which house of a library it is. */
static tn_status write_model(const tn_house_filed *filed, FILE *out, tn_error *error)
{
    const tn_house_form *form = filed->house->form;
    const char *project = filed->says.project, *form_name = tn_text(form->module, form->record->name);
    char stamp[TN_TIME_STAMP_TEXT];
    bool dated = filed->says.date && tn_house_time_stamp(filed->says.date, stamp);
    const tn_ifc_said said = {.name = title_of(filed),
                              .project = project ? project : title_of(filed),
                              .seed = project ? project : form_name,
                              .date = dated ? stamp : NULL,
                              .author = filed->author,
                              .north = filed->says.north,
                              .latitude = filed->latitude,
                              .longitude = filed->longitude};
    return tn_house_write_ifc(filed->house, filed->solids, &said, out, error);
}

/* A sheet says the house's line; one drawing alone has no room for it. */
static tn_status write_picture(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_aspect aspects[TN_HOUSE_VIEWS_MAX];
    size_t count;
    tn_status status = tn_house_views(filed->house, &filed->views, aspects, &count, error);
    tn_house_drawing drawing = {
        .aspects = aspects, .count = count, .title = title_of(filed), .says = filed->says, .note_count = count > 1, .scale = filed->scale};
    return status == TN_OK ? draw(filed, &drawing, kind, out, error) : status;
}

static tn_status write_known(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error)
{
    switch (kind) {
    case TN_HOUSE_AS_LINE:
        fprintf(out, "%s\n", filed->line);
        return TN_OK;
    case TN_HOUSE_AS_OBJ:
    case TN_HOUSE_AS_MTL:
    case TN_HOUSE_AS_GLB:
        return write_named(filed, kind, out, error);
    case TN_HOUSE_AS_PLY:
        return write_ply(filed, out, error);
    case TN_HOUSE_AS_IFC:
        return write_model(filed, out, error);
    case TN_HOUSE_AS_DXF:
    case TN_HOUSE_AS_SVG:
    case TN_HOUSE_AS_PDF:
    case TN_HOUSE_AS_PNG:
        return write_picture(filed, kind, out, error);
    default:
        return write_text(filed, kind, out, error);
    }
}

static bool says_line(tn_house_file kind)
{
    return kind == TN_HOUSE_AS_LINE || kind == TN_HOUSE_AS_OBJ || kind == TN_HOUSE_AS_GLB || tn_house_file_draws(kind);
}

tn_status tn_house_file_write(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_buffer line = {0};
    tn_house_filed known = *filed;
    tn_status status = TN_OK;
    if (!filed->line && says_line(kind)) {
        status = tn_house_write(filed->house, &line, error);
        known.line = line.data;
    }
    if (status == TN_OK)
        status = write_known(&known, kind, out, error);
    free(line.data);
    return status;
}
