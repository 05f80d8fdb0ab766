/* Reads which drawings of a house are wanted: `plan:STOREY`, `section:x=LENGTH`, `elevation:SIDE`, ... */
#include <stdlib.h>
#include <string.h>

#include "cli/house/files.h"
#include "cli/house/houses.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

static const char *storey_name(const tn_house_form *form, uint32_t storey)
{
    return tn_text(form->module, form->module->STOREY_records[form->record->storey_first + storey].name);
}

static bool find_storey(tn_job *job, const tn_house_form *form, const char *name, const char *option, uint32_t *storey)
{
    for (uint32_t k = 0; k < form->record->storey_count; k++) {
        if (strcmp(storey_name(form, k), name) == 0) {
            *storey = k;
            return true;
        }
    }
    tn_diagnostic *d = tn_job_usage(job, "%s: the form has no storey `%.60s`", option, name);
    const char *names[TN_STOREYS_MAX];
    char all[512];
    for (uint32_t k = 0; k < form->record->storey_count; k++)
        names[k] = storey_name(form, k);
    tn_word_list(names, form->record->storey_count, all, sizeof all);
    const char *near = tn_nearest(name, names, form->record->storey_count);
    tn_help(tn_job_diagnostics(job), d, near ? "did you mean `%s`?" : "its storeys are %s", near ? near : all);
    return false;
}

static bool bad_view(tn_job *job, const char *text)
{
    tn_diagnostic *d = tn_job_usage(job, "--view: there is no drawing `%.60s`", text);
    tn_help(tn_job_diagnostics(job), d,
            "write plan:STOREY, section:x=LENGTH, section:y=LENGTH, elevation:front (back, left, right), axonometric, "
            "or sheet");
    return false;
}

/* x=LENGTH or y=LENGTH, which may be negative. */
static bool read_section(tn_job *job, const char *text, tn_aspect *aspect)
{
    tn_error error = {0};
    bool x = strncmp(text, "x=", 2) == 0, known = x || strncmp(text, "y=", 2) == 0;
    const char *length = known ? text + 2 : text;
    bool negative = *length == '-';
    length += negative;
    size_t read = known ? tn_length_read(length, strlen(length), false, &aspect->at, &error) : 0;
    if (read == 0 || length[read]) {
        tn_diagnostic *d = tn_job_usage(job, "--view: a section is cut at a place, not `%.60s`", text);
        tn_help(tn_job_diagnostics(job), d,
                "write section:x=LENGTH or section:y=LENGTH, with a unit: section:x=6', section:y=2.5m");
        return false;
    }
    aspect->kind = x ? TN_ASPECT_SECTION_X : TN_ASPECT_SECTION_Y;
    aspect->at = negative ? -aspect->at : aspect->at;
    return true;
}

static bool read_side(tn_job *job, const char *text, tn_aspect *aspect)
{
    static const char *const sides[] = {
        [TN_HOUSE_BACK] = "back", [TN_HOUSE_FRONT] = "front", [TN_HOUSE_LEFT] = "left", [TN_HOUSE_RIGHT] = "right"};
    for (int i = TN_HOUSE_BACK; i <= TN_HOUSE_RIGHT; i++) {
        if (strcmp(text, sides[i]) == 0) {
            aspect->kind = TN_ASPECT_ELEVATION;
            aspect->side = (tn_house_side)i;
            return true;
        }
    }
    tn_diagnostic *d = tn_job_usage(job, "--view: a house has no side `%.60s`", text);
    tn_help(tn_job_diagnostics(job), d, "its sides are back, front, left and right");
    return false;
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

/* Everything of a sheet: plans, sections through the middle or beside it, elevations, the house with its roof and
 * without. */
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
    for (uint32_t k = 0; k < house->form->record->storey_count && count + 8 < room; k++) {
        aspects[count] = *usual;
        aspects[count].kind = TN_ASPECT_PLAN;
        aspects[count].storey = k;
        count += tn_house_has_storey(house, k);
    }
    tn_aspect section = *usual, roofless = *usual;
    section.kind = TN_ASPECT_SECTION_X;
    section.at = house->trays ? clear_of_walls(house, section.kind, width / 4) : 0;
    aspects[count++] = section;
    section.kind = TN_ASPECT_SECTION_Y;
    section.at = clear_of_walls(house, section.kind, low + (high - low) / 2);
    aspects[count++] = section;
    for (int side = TN_HOUSE_BACK; side <= TN_HOUSE_RIGHT; side++) {
        aspects[count] = *usual;
        aspects[count].kind = TN_ASPECT_ELEVATION;
        aspects[count++].side = (tn_house_side)side;
    }
    aspects[count++] = *usual;
    roofless.storeys = usual->storeys ? usual->storeys : 1;
    roofless.camera.elevation = usual->camera.elevation < 50 ? 50 : usual->camera.elevation; /* into the rooms */
    aspects[count++] = roofless;
    return count;
}

static bool read_view(tn_job *job, const tn_house *house, const char *text, tn_aspect *aspect)
{
    if (strncmp(text, "plan:", 5) == 0) {
        aspect->kind = TN_ASPECT_PLAN;
        return find_storey(job, house->form, text + 5, "--view", &aspect->storey);
    }
    if (strncmp(text, "section:", 8) == 0)
        return read_section(job, text + 8, aspect);
    if (strncmp(text, "elevation:", 10) == 0)
        return read_side(job, text + 10, aspect);
    return strcmp(text, "axonometric") == 0 || bad_view(job, text);
}

size_t tn_house_views(tn_job *job, const tn_house *house, const tn_house_outputs *outputs, tn_aspect *aspects)
{
    tn_aspect usual = {.kind = TN_ASPECT_AXONOMETRIC, .camera = tn_house_sheet_camera(), .bare = outputs->furnish == 1};
    size_t count = 0;
    if (outputs->azimuth.given)
        usual.camera.azimuth = outputs->azimuth.value;
    if (outputs->elevation.given)
        usual.camera.elevation = outputs->elevation.value;
    if (outputs->cut) {
        if (!find_storey(job, house->form, outputs->cut, "--cut", &usual.storeys))
            return 0;
        usual.storeys++;
    }
    if (outputs->views.count == 0)
        return add_sheet(house, &usual, aspects, TN_HOUSE_VIEWS_MAX);
    for (size_t i = 0; i < outputs->views.count; i++) {
        if (count + 16 > TN_HOUSE_VIEWS_MAX) {
            tn_job_usage(job, "--view: more than %u drawings are too many for a sheet", TN_HOUSE_VIEWS_MAX - 16);
            return 0;
        }
        if (strcmp(outputs->views.items[i], "sheet") == 0) {
            count += add_sheet(house, &usual, aspects + count, TN_HOUSE_VIEWS_MAX - count);
            continue;
        }
        aspects[count] = usual;
        if (!read_view(job, house, outputs->views.items[i], &aspects[count++]))
            return 0;
    }
    return count;
}
