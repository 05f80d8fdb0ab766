/* Goes through the houses of tests, and counts for each line of a form how many of them have what it says. */
#include "driver/house/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/parts.h"

#define TEXT_MAX 512u
#define SPAN(RECORD) ((tn_span){(RECORD)->file, (RECORD)->begin, (RECORD)->end})

/* What is measured: a form, and the part that each kind of line begins with. */
typedef struct measuring {
    const tn_module *module;
    const tn_form_record *form;
    tn_form_coverage *coverage;
    size_t storeys, shapes, rules, openings, faces, tiles; /* first parts */
    bool *seen;                                            /* [part] in the house at hand */
} measuring;

static tn_status add_part(tn_form_coverage *coverage, unsigned depth, const char *kind, const char *text, tn_span place,
                          tn_error *error)
{
    if (!tn_array_reserve(&coverage->parts, &coverage->capacity, coverage->count, 1, sizeof *coverage->parts))
        return tn_fail_memory(error);
    char *copy = strdup(text);
    if (!copy)
        return tn_fail_memory(error);
    coverage->parts[coverage->count++] = (tn_form_line){.depth = depth, .kind = kind, .text = copy, .place = place};
    return TN_OK;
}

/* "function living" */
static tn_status add_named(measuring *m, const char *kind, const char *name, tn_span place, tn_error *error)
{
    char text[TEXT_MAX];
    snprintf(text, sizeof text, "%s %s", kind, name);
    return add_part(m->coverage, 0, kind, text, place, error);
}

/* As it stands in the source: it has no name. */
static tn_status add_written(measuring *m, const char *kind, tn_span place, tn_error *error)
{
    char text[TEXT_MAX];
    tn_source_text(m->module, place.file, place.begin, place.end, text, sizeof text);
    return add_part(m->coverage, 0, kind, *text ? text : kind, place, error);
}

/* ---- the parts */

/* The values of choices that leave any. */
static tn_status add_section(measuring *m, tn_error *error)
{
    char text[TEXT_MAX];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->form->choice_count; i++) {
        const tn_choice_record *choice = &m->module->CHOICE_records[m->form->choice_first + i];
        for (uint32_t k = 0; status == TN_OK && choice->shape_count > 1 && k < choice->shape_count; k++) {
            const tn_shape_record *shape = &m->module->SHAPE_records[choice->shape_first + k];
            snprintf(text, sizeof text, "option %s %s", tn_text(m->module, choice->name),
                     tn_text(m->module, shape->spelling));
            status = add_part(m->coverage, 0, "section", text, SPAN(shape), error);
        }
    }
    return status;
}

/* Lines `forbid` are of no house. */
static tn_status add_rules(measuring *m, tn_error *error)
{
    static const char *const kinds[TN_CELL_RULE_KIND_COUNT] = {
        [TN_CELL_FUNCTION] = "function", [TN_CELL_VOID] = "void", [TN_CELL_NO] = "no"};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->form->rule_count; i++) {
        const tn_cell_rule_record *rule = &m->module->CELL_RULE_records[m->form->rule_first + i];
        if (rule->kind == TN_CELL_FUNCTION)
            status = add_named(m, "function", tn_text(m->module, rule->name), SPAN(rule), error);
        else if (rule->kind != TN_CELL_FORBID)
            status = add_written(m, kinds[rule->kind], SPAN(rule), error);
    }
    return status;
}

static tn_status add_openings(measuring *m, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->form->opening_count; i++) {
        const tn_opening_record *opening = &m->module->OPENING_records[m->form->opening_first + i];
        status = add_named(m, opening->turn == TN_TURN_NONE ? "opening" : "flight", tn_text(m->module, opening->name),
                           SPAN(opening), error);
    }
    return status;
}

/* A line that leaves a choice has a part for each of its kinds below it. */
static tn_status add_faces(measuring *m, const tn_house_form *form, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->form->face_count; i++) {
        const tn_face_line_record *line = &m->module->FACE_LINE_records[m->form->face_first + i];
        status = add_written(m, "face", SPAN(line), error);
        for (uint32_t k = 0; status == TN_OK && line->kind_count > 1 && k < line->kind_count; k++) {
            uint32_t kind = m->module->HOUSE_ITEM_records[line->kind_first + k].number;
            status = add_part(m->coverage, 1, "kind", tn_form_kind_text(form, kind), SPAN(line), error);
        }
    }
    return status;
}

static tn_status add_parts(measuring *m, const tn_house_form *form, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->form->storey_count; i++) {
        const tn_storey_record *storey = &m->module->STOREY_records[m->form->storey_first + i];
        status = add_named(m, "storey", tn_text(m->module, storey->name), SPAN(storey), error);
    }
    m->shapes = m->coverage->count;
    if (status == TN_OK)
        status = add_section(m, error);
    m->rules = m->coverage->count;
    if (status == TN_OK)
        status = add_rules(m, error);
    m->openings = m->coverage->count;
    if (status == TN_OK)
        status = add_openings(m, error);
    m->faces = m->coverage->count;
    if (status == TN_OK)
        status = add_faces(m, form, error);
    m->tiles = m->coverage->count;
    for (uint32_t i = 0; status == TN_OK && i < m->form->tile_count; i++) {
        const tn_tile_record *tile = &m->module->TILE_records[m->form->tile_first + i];
        status = add_named(m, "tile", tn_text(m->module, tile->name), SPAN(tile), error);
    }
    return status;
}

/* ---- one house */

static void see_section(measuring *m, const tn_house *house)
{
    size_t first = m->shapes;
    for (uint32_t i = 0; i < m->form->choice_count; i++) {
        uint32_t values = tn_form_choice(house->form, i)->shape_count;
        if (values == 1)
            continue;
        m->seen[first + house->shapes[i]] = true;
        first += values;
    }
}

/* Which lines of a kind the cell meets. */
static void see_rules(measuring *m, const tn_house *house, const tn_cell *cell, tn_cell_rule_kind kind)
{
    for (uint32_t i = house->form->kinds_end[kind - 1]; i < house->form->kinds_end[kind]; i++)
        m->seen[m->rules + i] |= tn_house_decide(house, tn_form_rule(house->form, i)->decides, cell);
}

static tn_status see_tiles(measuring *m, const tn_house *house, uint32_t cell, tn_error *error)
{
    tn_variants variants = {0};
    tn_status status = tn_tile_variants(house, cell, &variants, error);
    for (size_t i = 0; status == TN_OK && i < variants.count; i++)
        m->seen[m->tiles + variants.variants[i].tile - m->form->tile_first] = true;
    tn_variants_clear(&variants);
    return status;
}

static tn_status see_cells(measuring *m, const tn_house *house, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        m->seen[m->storeys + cell->storey] = true;
        if (cell->open)
            see_rules(m, house, cell, TN_CELL_VOID);
        else if (cell->function != TN_NO_FUNCTION)
            m->seen[m->rules + cell->function] = true;
        if (!cell->open)
            status = see_tiles(m, house, i, error);
    }
    return status;
}

/* Where the cells of a zone end before its storeys do, a line `no` ends them. */
static void see_ends(measuring *m, const tn_house *house)
{
    for (uint32_t tray = 0; tray < house->length; tray++)
        for (uint32_t z = 0; z < house->form->zone_count; z++) {
            tn_cell end;
            if (tn_house_ends(house, tray, house->form->zones[z], &end))
                see_rules(m, house, &end, TN_CELL_NO);
        }
}

/* The part of a line of faces; those of its kinds come next. */
static size_t line_part(const measuring *m, uint32_t line)
{
    size_t part = m->faces;
    for (uint32_t i = 0; i < line; i++) {
        uint32_t kinds = m->module->FACE_LINE_records[m->form->face_first + i].kind_count;
        part += 1 + (kinds > 1 ? kinds : 0);
    }
    return part;
}

static void see_line(measuring *m, uint32_t index, uint32_t kind)
{
    const tn_face_line_record *line = &m->module->FACE_LINE_records[m->form->face_first + index];
    size_t part = line_part(m, index);
    m->seen[part] = true;
    for (uint32_t k = 0; line->kind_count > 1 && k < line->kind_count; k++)
        m->seen[part + 1 + k] |= m->module->HOUSE_ITEM_records[line->kind_first + k].number == kind;
}

static void see_faces(measuring *m, const tn_house *house)
{
    uint32_t kinds[TN_FACE_KINDS_MAX], line;
    for (size_t i = 0; i < house->face_count; i++) {
        uint32_t kind = house->faces[i].kind;
        if (kind >= TN_FACE_KIND_COUNT)
            m->seen[m->openings + kind - TN_FACE_KIND_COUNT] = true;
        tn_face_decided(house, &house->faces[i], kinds, &line);
        if (line != TN_NO_RECORD)
            see_line(m, line, kind);
    }
}

static tn_status see_house(measuring *m, const tn_house *house, tn_error *error)
{
    memset(m->seen, 0, m->coverage->count * sizeof *m->seen);
    see_section(m, house);
    see_ends(m, house);
    see_faces(m, house);
    tn_status status = see_cells(m, house, error);
    for (size_t i = 0; status == TN_OK && i < m->coverage->count; i++)
        m->coverage->parts[i].houses += m->seen[i];
    m->coverage->tests++;
    return status;
}

/* ---- the whole */

/* By their places in the file; kinds of a line stay behind it. */
static void sort_parts(tn_form_coverage *coverage)
{
    for (size_t i = 1; i < coverage->count; i++) {
        tn_form_line part = coverage->parts[i];
        size_t at = i;
        for (; at > 0 && coverage->parts[at - 1].place.begin > part.place.begin; at--)
            coverage->parts[at] = coverage->parts[at - 1];
        coverage->parts[at] = part;
    }
}

tn_status tn_form_covered(const tn_house_cases *cases, uint32_t form, tn_form_coverage *coverage, tn_error *error)
{
    const tn_module *module = cases->opened->module;
    *coverage = (tn_form_coverage){.name = tn_text(module, module->FORM_records[form].name),
                                   .place = SPAN(&module->FORM_records[form]),
                                   .imported = (module->FORM_records[form].flags & TN_IMPORTED) != 0};
    measuring m = {.module = module, .form = &module->FORM_records[form], .coverage = coverage};
    tn_house_judge judge;
    tn_status status = tn_house_judge_open(module, form, 0, &judge, error);
    if (status == TN_OK)
        status = add_parts(&m, &judge.form, error);
    tn_house_judge_close(&judge);
    m.seen = calloc(coverage->count + 1, sizeof *m.seen);
    if (status == TN_OK && !m.seen)
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < cases->count; i++)
        if (cases->items[i].form == form)
            status = see_house(&m, &cases->items[i].house, error);
    for (size_t i = 0; i < coverage->count; i++)
        coverage->reached += coverage->parts[i].houses > 0;
    sort_parts(coverage);
    free(m.seen);
    return status;
}

void tn_form_coverage_clear(tn_form_coverage *coverage)
{
    for (size_t i = 0; i < coverage->count; i++)
        free(coverage->parts[i].text);
    free(coverage->parts);
    *coverage = (tn_form_coverage){0};
}
