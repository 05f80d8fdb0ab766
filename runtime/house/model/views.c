/* Reads which drawings of a house are wanted: `plan:STOREY`, `section:x=LENGTH`, `elevation:SIDE`, ... */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/base/nearest.h"
#include "runtime/house/model/views.h"

static const char *storey_name(const tn_house_form *form, uint32_t storey)
{
    return tn_text(form->module, form->module->STOREY_records[form->record->storey_first + storey].name);
}

static bool has_storey(const tn_house_form *form, const char *name)
{
    for (uint32_t k = 0; k < form->record->storey_count; k++)
        if (strcmp(storey_name(form, k), name) == 0)
            return true;
    return false;
}

static tn_status find_storey(const tn_house_form *form, const char *name, const char *option, uint32_t *storey,
                             tn_error *error)
{
    const char *names[TN_STOREYS_MAX];
    char all[512];
    uint32_t count = form->record->storey_count;
    for (uint32_t k = 0; k < count; k++) {
        names[k] = storey_name(form, k);
        if (strcmp(names[k], name) == 0) {
            *storey = k;
            return TN_OK;
        }
    }
    tn_status status = tn_fail(error, TN_INVALID, E_USAGE, "%s: the form has no storey `%.60s`", option, name);
    tn_word_list(names, count, all, sizeof all);
    const char *near = tn_nearest(name, names, count);
    tn_error_help(error, near ? "did you mean `%s`?" : "its storeys are %s", near ? near : all);
    return status;
}

static tn_status bad_view(const char *text, tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_USAGE, "--view: there is no drawing `%.60s`", text);
    tn_error_help(
        error, "write plan:STOREY, plan:roof, section:x=LENGTH, section:y=LENGTH, elevation:front (back, left, right), "
               "axonometric, or sheet");
    return status;
}

/* x=LENGTH or y=LENGTH, which may be negative. */
static tn_status read_section(const char *text, tn_aspect *aspect, tn_error *error)
{
    tn_error wrong = {0};
    bool x = strncmp(text, "x=", 2) == 0, known = x || strncmp(text, "y=", 2) == 0;
    const char *length = known ? text + 2 : text;
    bool negative = *length == '-';
    length += negative;
    size_t read = known ? tn_length_read(length, strlen(length), false, &aspect->at, &wrong) : 0;
    if (read == 0 || length[read]) {
        tn_status status =
            tn_fail(error, TN_INVALID, E_USAGE, "--view: a section is cut at a place, not `%.60s`", text);
        tn_error_help(error, "write section:x=LENGTH or section:y=LENGTH, with a unit: section:x=6', section:y=2.5m");
        return status;
    }
    aspect->kind = x ? TN_ASPECT_SECTION_X : TN_ASPECT_SECTION_Y;
    aspect->at = negative ? -aspect->at : aspect->at;
    return TN_OK;
}

static tn_status read_side(const char *text, tn_aspect *aspect, tn_error *error)
{
    static const char *const sides[] = {
        [TN_HOUSE_BACK] = "back", [TN_HOUSE_FRONT] = "front", [TN_HOUSE_LEFT] = "left", [TN_HOUSE_RIGHT] = "right"};
    for (int i = TN_HOUSE_BACK; i <= TN_HOUSE_RIGHT; i++) {
        if (strcmp(text, sides[i]) == 0) {
            aspect->kind = TN_ASPECT_ELEVATION;
            aspect->side = (tn_house_side)i;
            return TN_OK;
        }
    }
    tn_status status = tn_fail(error, TN_INVALID, E_USAGE, "--view: a house has no side `%.60s`", text);
    tn_error_help(error, "its sides are back, front, left and right");
    return status;
}

/* Does a cut there go along a wall, or might it? */
static bool in_wall(const tn_house *house, tn_aspect_kind kind, int64_t at)
{
    int64_t half = house->form->record->wall / 2;
    for (size_t i = 0; i < house->cell_count; i++) {
        const tn_rectangle *r = &house->cells[i].at;
        int64_t low = kind == TN_ASPECT_SECTION_X ? r->x0 : r->y0, high = kind == TN_ASPECT_SECTION_X ? r->x1 : r->y1;
        if (llabs(at - low) <= half || llabs(at - high) <= half)
            return true;
    }
    return false;
}

/* Where a section is cut: at the place, or if that is in a wall, in the nearest middle of a cell that is in none. */
static int64_t clear_of_walls(const tn_house *house, tn_aspect_kind kind, int64_t wanted)
{
    int64_t best = wanted;
    for (size_t i = 0; in_wall(house, kind, wanted) && i < house->cell_count; i++) {
        const tn_rectangle *r = &house->cells[i].at;
        int64_t at = kind == TN_ASPECT_SECTION_X ? r->x0 + (r->x1 - r->x0) / 2 : r->y0 + (r->y1 - r->y0) / 2;
        if ((best == wanted || llabs(at - wanted) < llabs(best - wanted)) && !in_wall(house, kind, at))
            best = at;
    }
    return best;
}

/* Everything of a sheet: plans, that of the roof, sections through the middle or beside it, elevations, the house with
 * its roof and without. */
static size_t add_sheet(const tn_house *house, const tn_aspect *usual, tn_aspect *aspects, size_t room)
{
    size_t count = 0;
    int64_t low = 0, high = 0, width = 0;
    for (size_t i = 0; i < house->cell_count; i++) {
        const tn_rectangle *at = &house->cells[i].at;
        low = i == 0 || at->y0 < low ? at->y0 : low;
        high = i == 0 || at->y1 > high ? at->y1 : high;
        width = at->x1 > width ? at->x1 : width;
    }
    for (uint32_t k = 0; k < house->form->record->storey_count && count + 9 < room; k++) {
        aspects[count] = *usual;
        aspects[count].kind = TN_ASPECT_PLAN;
        aspects[count].storey = k;
        count += tn_house_has_storey(house, k);
    }
    aspects[count] = *usual;
    aspects[count++].kind = TN_ASPECT_ROOF;
    tn_aspect section = *usual, roofless = *usual;
    section.kind = TN_ASPECT_SECTION_X;
    section.at = house->trays ? clear_of_walls(house, section.kind, width / 4) : 0;
    aspects[count++] = section;
    section.kind = TN_ASPECT_SECTION_Y;
    section.at = clear_of_walls(house, section.kind, low + (high - low) / 2);
    aspects[count++] = section;
    static const tn_house_side sides[] = {TN_HOUSE_FRONT, TN_HOUSE_RIGHT, TN_HOUSE_BACK, TN_HOUSE_LEFT};
    for (int i = 0; i < 4; i++) {
        aspects[count] = *usual;
        aspects[count].kind = TN_ASPECT_ELEVATION;
        aspects[count++].side = sides[i];
    }
    aspects[count++] = *usual;
    roofless.storeys = usual->storeys ? usual->storeys : 1;
    roofless.camera.elevation = usual->camera.elevation < 50 ? 50 : usual->camera.elevation; /* into the rooms */
    aspects[count++] = roofless;
    return count;
}

static tn_status read_view(const tn_house *house, const char *text, tn_aspect *aspect, tn_error *error)
{
    if (strcmp(text, "plan:roof") == 0 && !has_storey(house->form, "roof")) {
        aspect->kind = TN_ASPECT_ROOF;
        return TN_OK;
    }
    if (strncmp(text, "plan:", 5) == 0) {
        aspect->kind = TN_ASPECT_PLAN;
        return find_storey(house->form, text + 5, "--view", &aspect->storey, error);
    }
    if (strncmp(text, "section:", 8) == 0)
        return read_section(text + 8, aspect, error);
    if (strncmp(text, "elevation:", 10) == 0)
        return read_side(text + 10, aspect, error);
    return strcmp(text, "axonometric") == 0 ? TN_OK : bad_view(text, error);
}

/* What each drawing has if its text does not say otherwise. */
static tn_status usual_of(const tn_house *house, const tn_views *asked, tn_aspect *usual, tn_error *error)
{
    *usual = (tn_aspect){.kind = TN_ASPECT_AXONOMETRIC, .camera = tn_house_sheet_camera(), .bare = asked->bare};
    if (asked->azimuth)
        usual->camera.azimuth = *asked->azimuth;
    if (asked->elevation)
        usual->camera.elevation = *asked->elevation;
    if (!asked->cut)
        return TN_OK;
    tn_status status = find_storey(house->form, asked->cut, "--cut", &usual->storeys, error);
    usual->storeys++;
    return status;
}

tn_status tn_house_views(const tn_house *house, const tn_views *asked, tn_aspect *aspects, size_t *count,
                         tn_error *error)
{
    tn_aspect usual;
    *count = 0;
    tn_status status = usual_of(house, asked, &usual, error);
    if (status == TN_OK && asked->count == 0)
        *count = add_sheet(house, &usual, aspects, TN_HOUSE_VIEWS_MAX);
    for (size_t i = 0; status == TN_OK && i < asked->count; i++) {
        if (*count + 16 > TN_HOUSE_VIEWS_MAX)
            return tn_fail(error, TN_INVALID, E_USAGE, "--view: more than %u drawings are too many for a sheet",
                           TN_HOUSE_VIEWS_MAX - 16);
        if (strcmp(asked->items[i], "sheet") == 0) {
            *count += add_sheet(house, &usual, aspects + *count, TN_HOUSE_VIEWS_MAX - *count);
            continue;
        }
        aspects[*count] = usual;
        status = read_view(house, asked->items[i], &aspects[(*count)++], error);
    }
    return status;
}
