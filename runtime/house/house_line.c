/* Reads house lines: `plan ; options ; functions ; faces ; tiles`, in this order; trays are between bars, and a part
 * without words is `-`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/nearest.h"
#include "runtime/house/line.h"
#include "runtime/house/ways.h"
#include "runtime/plan/schema/value.h"
#include "runtime/plan/text/text.h"

enum {
    PLAN = TN_LINE_PLAN,
    SECTION = TN_LINE_SECTION,
    FUNCTIONS = TN_LINE_FUNCTIONS,
    FACES = TN_LINE_FACES,
    TILES = TN_LINE_TILES,
    PARTS = TN_LINE_PARTS
};
static const char *const part_names[] = {"plan", "options", "functions", "faces", "tiles"};

/* What is wrong with a line that may leave values out, all of it: NULL where the first mistake ends the reading, and
 * where `_` is no value. */
typedef struct tn_line_faults {
    tn_line_error *said;
    void *context;
    bool any;     /* something is wrong */
    bool unknown; /* a value is left out, or wrong: what it decides on cannot be known */
} tn_line_faults;

/* The words of one part. */
typedef struct tn_part_reader {
    const char *line;
    size_t at, end; /* what is left of it */
    size_t bars;    /* before that */
    int part;
    bool there;    /* has it words at all? */
    bool given_up; /* it is not known what its words are about */
    tn_line_faults *faults;
} tn_part_reader;

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* The next word; of no size at the end. Bars are counted; `-` says nothing. */
static tn_word next_word(tn_part_reader *reader)
{
    for (;;) {
        while (reader->at < reader->end && (is_blank(reader->line[reader->at]) || reader->line[reader->at] == '|'))
            reader->bars += reader->line[reader->at++] == '|';
        size_t begin = reader->at;
        while (reader->at < reader->end && !is_blank(reader->line[reader->at]) && reader->line[reader->at] != '|')
            reader->at++;
        size_t size = reader->at - begin;
        if (size != 1 || reader->line[begin] != '-')
            return (tn_word){.text = reader->line + begin, .size = size, .column = begin + 1, .extent = size};
    }
}

static bool word_is(const tn_word *word, const char *text)
{
    return strlen(text) == word->size && memcmp(word->text, text, word->size) == 0;
}

static tn_part_reader open_part(const char *line, size_t size, int part, tn_line_faults *faults)
{
    tn_part_reader reader = {.line = line, .at = 0, .end = size, .part = part, .faults = faults};
    for (int i = 0; i < part && reader.at <= size; i++) {
        const char *next = reader.at < size ? memchr(line + reader.at, ';', size - reader.at) : NULL;
        reader.at = next ? (size_t)(next - line) + 1 : size;
    }
    const char *next = reader.at < size ? memchr(line + reader.at, ';', size - reader.at) : NULL;
    reader.end = next ? (size_t)(next - line) : size;
    tn_part_reader look = reader;
    reader.there = next_word(&look).size > 0;
    return reader;
}

/* ---- what is wrong */

/* Goes on after a mistake, if all are to be said. */
static tn_status go_on(tn_line_faults *faults, tn_status status, tn_error *error)
{
    if (status != TN_INVALID || !faults)
        return status;
    faults->any = faults->unknown = true;
    return faults->said(faults->context, error);
}

static tn_status refuse_word(const tn_part_reader *reader, const tn_word *word, const char *what, tn_error *error)
{
    char shown[TN_WORD_SHOWN];
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "in the %s, `%s` is no %s", part_names[reader->part],
            tn_word_show(word, shown), what);
    return tn_word_refuse(word, error);
}

static void help_choices(tn_error *error, const char *lead, const char *const *texts, size_t count)
{
    char list[240] = "";
    size_t room = sizeof error->help - strlen(lead) - 2;
    room = room < sizeof list ? room : sizeof list;
    for (size_t i = 0; i < count && strlen(list) + strlen(texts[i]) + 8 < room; i++)
        snprintf(list + strlen(list), room - strlen(list), "%s%s",
                 i == 0           ? ""
                 : i + 1 == count ? " or "
                                  : ", ",
                 texts[i]);
    tn_error_help(error, "%s %s", lead, list);
}

/* Is the value left out? Then the next word, `_`, is passed over. */
static bool is_left_out(tn_part_reader *reader)
{
    tn_part_reader look = *reader;
    tn_word word = next_word(&look);
    bool out = reader->faults && (!reader->there || reader->given_up || word_is(&word, TN_LEFT_OUT));
    if (out && reader->there && !reader->given_up)
        *reader = look;
    return out;
}

/* Which of the texts the next word is. Where the part has no words, the only one there is. lead: what comes before the
 * texts in an error's help. */
static tn_status choose(tn_part_reader *reader, const char *what, const char *lead, const char *const *texts,
                        size_t count, size_t *chosen, tn_error *error)
{
    static const char any[] = "; `_` leaves it open";
    *chosen = 0;
    if (!reader->there && count == 1)
        return TN_OK;
    if (is_left_out(reader)) {
        reader->faults->unknown |= count > 1;
        return TN_OK;
    }
    tn_word word = next_word(reader);
    for (; *chosen < count; ++*chosen)
        if (word.size > 0 && word_is(&word, texts[*chosen]))
            return TN_OK;
    *chosen = 0;
    if (word.size > 0) {
        refuse_word(reader, &word, what, error);
    } else {
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the house line ends too soon: in the %s, a %s is missing",
                part_names[reader->part], what);
        tn_error_place(error, 0, reader->end + 1, reader->end + 1);
        reader->given_up = true;
    }
    help_choices(error, lead, texts, count);
    if (word.size == 0 && reader->faults && strlen(error->help) + sizeof any < sizeof error->help)
        strcat(error->help, any);
    return TN_INVALID;
}

static tn_status at_end(tn_part_reader *reader, const char *what, tn_error *error)
{
    tn_word word = next_word(reader);
    if (word.size == 0 || reader->given_up)
        return TN_OK;
    char shown[TN_WORD_SHOWN];
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "`%s` is one word too many in the %s", tn_word_show(&word, shown),
            part_names[reader->part]);
    tn_error_help(error, "there is a word for each %s", what);
    return tn_word_refuse(&word, error);
}

/* ---- which cell or face it is about */

#define LEAD_SIZE 240

/* "the corridor of tray 2 in storey ground" */
static void write_cell(const tn_house *house, uint32_t number, char *text, size_t size)
{
    const tn_house_form *form = house->form;
    const tn_cell *cell = &house->cells[number];
    snprintf(text, size, "the %.24s of tray %u in storey %.24s",
             tn_text(form->module, form->schema->fields[cell->zone].name), cell->tray + 1,
             tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name));
}

static void lead_for_cell(const tn_house *house, uint32_t number, char lead[LEAD_SIZE])
{
    char cell[LEAD_SIZE / 3 + 20];
    write_cell(house, number, cell, sizeof cell);
    snprintf(lead, LEAD_SIZE, "%s can have", cell);
}

static const char *const side_names[TN_HOUSE_SIDE_COUNT] = {
    [TN_HOUSE_BACK] = "back", [TN_HOUSE_FRONT] = "front", [TN_HOUSE_LEFT] = "left", [TN_HOUSE_RIGHT] = "right"};

static void lead_for_face(const tn_house *house, const tn_face *face, char lead[LEAD_SIZE])
{
    char first[LEAD_SIZE / 3 + 20], second[LEAD_SIZE / 3 + 20];
    write_cell(house, face->first, first, sizeof first);
    if (face->relation == TN_FACE_OUTSIDE) {
        snprintf(lead, LEAD_SIZE, "the %s of %s can be", side_names[face->side], first);
        return;
    }
    write_cell(house, face->second, second, sizeof second);
    snprintf(lead, LEAD_SIZE, "between %s and %s can be", first, second);
}

/* ---- reading */

static tn_status read_section(const tn_house_form *form, const char *line, size_t size, uint32_t shapes[TN_CHOICES_MAX],
                              tn_line_faults *faults, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, SECTION, faults);
    for (uint32_t i = 0; i < form->record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(form, i);
        const char *texts[TN_VALUES_MAX];
        size_t chosen;
        for (uint32_t s = 0; s < choice->shape_count; s++)
            texts[s] = tn_text(form->module, form->module->SHAPE_records[choice->shape_first + s].spelling);
        char what[120];
        snprintf(what, sizeof what, "value of `%.80s`", tn_text(form->module, choice->name));
        tn_status status = choose(&reader, what, "it can be", texts, choice->shape_count, &chosen, error);
        status = go_on(faults, status, error);
        if (status != TN_OK)
            return status;
        shapes[i] = (uint32_t)chosen;
    }
    return go_on(faults, at_end(&reader, "choice of the form", error), error);
}

/* Names a value of one choice with which the form allows the section, if there is one. The house stays as it is. */
static void help_section(tn_house *house, tn_error *error)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = 0; i < form->record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(form, i);
        uint32_t was = house->shapes[i], other = 0;
        for (; other < choice->shape_count; other++) {
            house->shapes[i] = other;
            if (tn_house_section_stands(house))
                break;
        }
        house->shapes[i] = was;
        if (other == choice->shape_count)
            continue;
        tn_error_help(error, "with `%.80s` for `%.80s` it would be allowed",
                      tn_text(form->module, form->module->SHAPE_records[choice->shape_first + other].spelling),
                      tn_text(form->module, choice->name));
        return;
    }
    tn_error_help(error, "its `forbid` lines say which options do not go together");
}

static tn_status check_section(tn_house *house, const char *line, size_t size, tn_error *error)
{
    if (tn_house_section_stands(house))
        return TN_OK;
    tn_part_reader reader = open_part(line, size, SECTION, NULL);
    size_t end = reader.end;
    tn_word first = next_word(&reader);
    while (end > 0 && is_blank(line[end - 1]))
        end--;
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the form forbids these options together");
    help_section(house, error);
    if (first.size > 0)
        tn_error_place(error, 0, first.column, end + 1);
    return TN_INVALID;
}

/* A cell that no function may take makes that there is no such house. */
static tn_status no_function(const tn_house *house, const tn_cell *cell, tn_error *error)
{
    const tn_house_form *form = house->form;
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "no function may take the %s of tray %u in storey %s",
            tn_text(form->module, form->schema->fields[cell->zone].name), cell->tray + 1,
            tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name));
    tn_error_help(error, "the form's `function` lines say where each may be");
    return TN_INVALID;
}

static tn_status read_function(tn_house *house, tn_part_reader *reader, tn_cell *cell, tn_error *error)
{
    const tn_house_form *form = house->form;
    const char *texts[TN_CELL_RULES_MAX];
    uint32_t functions[TN_CELL_RULES_MAX];
    size_t count = 0, chosen;
    for (uint32_t i = 0; i < tn_form_functions(form); i++) {
        if (!tn_cell_may(house, cell, i))
            continue;
        functions[count] = i;
        texts[count++] = tn_text(form->module, tn_form_rule(form, i)->name);
    }
    if (cell->open)
        texts[count++] = "void";
    if (count == 0)
        return no_function(house, cell, error);
    char lead[LEAD_SIZE];
    lead_for_cell(house, (uint32_t)(cell - house->cells), lead);
    tn_status status = choose(reader, "function that may be there", lead, texts, count, &chosen, error);
    if (status == TN_OK && !cell->open)
        cell->function = functions[chosen];
    return status;
}

/* Is the next word, if there is one, in the tray whose turn it is? */
static tn_status at_tray(const tn_house *house, const tn_part_reader *reader, uint32_t tray, tn_error *error)
{
    tn_part_reader look = *reader;
    tn_word word = next_word(&look);
    if (!reader->there || reader->given_up || word.size == 0 || look.bars == tray)
        return TN_OK;
    bool more = look.bars < tray;
    if (more)
        tray = (uint32_t)look.bars;
    char shown[TN_WORD_SHOWN];
    uint32_t cells = house->tray_first[tray + 1] - house->tray_first[tray];
    tn_fail(error, TN_INVALID, E_BAD_HOUSE,
            more ? "tray %u has %u cell%s, and `%s` is one word more: a bar is missing, or a word too many"
                 : "tray %u has %u cell%s, and its functions end too soon, before `%s`",
            tray + 1, cells, cells == 1 ? "" : "s", tn_word_show(&word, shown));
    tn_error_help(error, "bars stand between the functions of two trays, as in the plan; without cells there is `-`");
    return tn_word_refuse(&word, error);
}

static tn_status read_functions(tn_house *house, const char *line, size_t size, tn_line_faults *faults, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, FUNCTIONS, faults);
    for (size_t i = 0; i < house->cell_count; i++) {
        tn_status status = at_tray(house, &reader, house->cells[i].tray, error);
        reader.given_up |= status == TN_INVALID;
        if (status == TN_OK)
            status = read_function(house, &reader, &house->cells[i], error);
        status = go_on(faults, status, error);
        if (status != TN_OK)
            return status;
    }
    return go_on(faults, at_end(&reader, "cell", error), error);
}

/* Where the word names an opening, or `open`, that a lower roof keeps out of one of the first faces, says so. */
static void help_behind_roof(const tn_house *house, size_t faces, const tn_word *word, tn_error *error)
{
    const tn_house_form *form = house->form;
    uint32_t kind = TN_FACE_OPEN, kinds = TN_FACE_KIND_COUNT + form->record->opening_count;
    tn_behind_roof behind;
    while (kind < kinds && !word_is(word, tn_form_kind_text(form, kind)))
        kind++;
    for (size_t i = 0; kind < kinds && i < faces; i++) {
        const tn_face *face = &house->faces[i];
        const tn_cell *cell = &house->cells[face->first];
        char text[200];
        if (!tn_face_behind_roof(house, face, kind, &behind))
            continue;
        tn_behind_roof_text(house, &behind, text, sizeof text);
        tn_error_help(
            error, "`%.40s` does not fit at the %s of %.24s in tray %u, storey %.24s: %s",
            tn_form_kind_text(form, kind), side_names[face->side],
            tn_text(form->module, form->schema->fields[cell->zone].name), cell->tray + 1,
            tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name), text);
        return;
    }
}

static tn_status read_faces(tn_house *house, const char *line, size_t size, tn_line_faults *faults, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, FACES, faults);
    for (size_t i = 0; i < house->face_count; i++) {
        uint32_t kinds[TN_FACE_KINDS_MAX];
        const char *texts[TN_FACE_KINDS_MAX];
        size_t count = tn_face_options(house, &house->faces[i], kinds), chosen = 0;
        tn_part_reader look = reader;
        tn_word word = next_word(&look);
        for (size_t k = 0; k < count; k++)
            texts[k] = tn_form_kind_text(house->form, kinds[k]);
        char lead[LEAD_SIZE] = "";
        if (count > 1)
            lead_for_face(house, &house->faces[i], lead);
        tn_status status = count > 1 ? choose(&reader, "kind of that face", lead, texts, count, &chosen, error) : TN_OK;
        if (status != TN_OK)
            help_behind_roof(house, i + 1, &word, error);
        status = go_on(faults, status, error);
        if (status != TN_OK)
            return status;
        house->faces[i].kind = kinds[chosen];
    }
    tn_part_reader look = reader;
    tn_word word = next_word(&look);
    tn_status status = at_end(&reader, "face with a choice", error);
    if (status != TN_OK)
        help_behind_roof(house, house->face_count, &word, error);
    return go_on(faults, status, error);
}

static tn_status no_tile(const tn_house *house, const tn_cell *cell, tn_error *error)
{
    const tn_house_form *form = house->form;
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "no tile fits into the %s of tray %u in storey %s",
            tn_text(form->module, tn_form_rule(form, cell->function)->name), cell->tray + 1,
            tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name));
    tn_error_help(error, "the room may be too small, or its walls have openings where a tile stands");
    return TN_INVALID;
}

/* A cell without tiles in which people cannot go about makes that there is no such house. */
static tn_status check_ways(const tn_house *house, uint32_t number, tn_error *error)
{
    const tn_house_form *form = house->form;
    const tn_cell *cell = &house->cells[number];
    tn_way_fault fault;
    char why[2 * TN_NAME_MAX];
    tn_status status = tn_cell_ways(house, number, &fault, error);
    if (status != TN_OK || (fault.fault == TN_FLOOR_FITS && !fault.flight))
        return status;
    tn_way_fault_text(form, &fault, why, sizeof why);
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "in the %.80s of tray %u in storey %.80s, %s",
            tn_text(form->module, tn_form_rule(form, cell->function)->name), cell->tray + 1,
            tn_text(form->module, form->module->STOREY_records[form->record->storey_first + cell->storey].name), why);
    tn_error_help(error,
                  "the form asks for ways that are wide enough: doors elsewhere or a larger cell would leave them");
    return TN_INVALID;
}

static tn_status read_tile(tn_house *house, tn_part_reader *reader, uint32_t cell, tn_error *error)
{
    tn_variants v;
    tn_status status = tn_tile_variants(house, cell, &v, error);
    char(*names)[TN_VARIANT_TEXT] = NULL;
    const char **texts = NULL;
    if (status == TN_OK && v.wanted && v.count == 0)
        status = no_tile(house, &house->cells[cell], error);
    if (status == TN_OK && !v.wanted)
        status = check_ways(house, cell, error);
    if (status == TN_OK && v.count > 0) {
        names = malloc(v.count * sizeof *names);
        texts = malloc(v.count * sizeof *texts);
        status = names && texts ? TN_OK : tn_fail_memory(error);
        for (size_t i = 0; status == TN_OK && i < v.count; i++) {
            tn_variant_text(house->form, &v.variants[i], names[i]);
            texts[i] = names[i];
        }
        if (status == TN_OK) {
            char lead[LEAD_SIZE];
            lead_for_cell(house, cell, lead);
            status = choose(reader, "tile that fits there", lead, texts, v.count, &house->cells[cell].variant, error);
        }
    }
    free(names);
    free(texts);
    tn_variants_clear(&v);
    return status;
}

static tn_status read_tiles(tn_house *house, const char *line, size_t size, tn_line_faults *faults, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, TILES, faults);
    for (uint32_t i = 0; i < house->cell_count; i++) {
        tn_status status = go_on(faults, read_tile(house, &reader, i, error), error);
        if (status != TN_OK)
            return status;
    }
    return go_on(faults, at_end(&reader, "cell whose function has tiles", error), error);
}

static tn_status check_parts(const char *line, size_t size, tn_error *error)
{
    int parts = 0;
    for (size_t i = 0; i < size; i++) {
        if (line[i] != ';' || ++parts < PARTS)
            continue;
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "a house line has five parts, and this is a sixth");
        tn_error_help(error, "the parts are: plan ; options ; functions ; faces ; tiles");
        tn_error_place(error, 0, i + 1, i + 2);
        return TN_INVALID;
    }
    return TN_OK;
}

/* The part of the plan is a plan line, or `-` where the plan has no trays. */
static tn_status read_plan(const tn_house_form *form, const char *line, size_t max_trays, tn_part_reader part,
                           tn_plan *plan, tn_error *error)
{
    bool none = !part.there && !memchr(line, '|', part.end);
    return tn_plan_parse_line(form->schema, line, none ? 0 : part.end, max_trays, plan, error);
}

/* Everything but the tiles. */
static tn_status read_open(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                           tn_error *error)
{
    tn_plan trays = {0};
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    *house = (tn_house){0};
    tn_status status = check_parts(line, size, error);
    if (status == TN_OK)
        status = read_plan(form, line, max_trays, open_part(line, size, PLAN, NULL), &trays, error);
    if (status == TN_OK)
        status = read_section(form, line, size, shapes, NULL, error);
    if (status == TN_OK)
        status = tn_house_stand(form, trays.trays, trays.length, shapes, house, error);
    free(trays.trays);
    if (status == TN_OK)
        status = check_section(house, line, size, error);
    if (status == TN_OK)
        status = read_functions(house, line, size, NULL, error);
    if (status == TN_OK)
        status = read_faces(house, line, size, NULL, error);
    return status;
}

static tn_status read_whole(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                            tn_error *error)
{
    tn_status status = read_open(form, line, size, max_trays, house, error);
    return status == TN_OK ? read_tiles(house, line, size, NULL, error) : status;
}

static tn_status read_tiles_there(const tn_house_form *form, const char *line, size_t size, size_t max_trays,
                                  tn_house *house, tn_error *error)
{
    tn_status status = read_open(form, line, size, max_trays, house, error);
    house->tiles_left_out = !open_part(line, size, TILES, NULL).there;
    return status == TN_OK && !house->tiles_left_out ? read_tiles(house, line, size, NULL, error) : status;
}

/* ---- lines that leave values out */

/* A word that cannot be told apart by where it stands, since something before it is not known: is it one of these? */
static tn_status is_any_of(const tn_part_reader *reader, const tn_word *word, const char *what,
                           const char *const *texts, size_t count, tn_error *error)
{
    char shown[TN_WORD_SHOWN];
    for (size_t i = 0; i < count; i++)
        if (word_is(word, texts[i]))
            return TN_OK;
    refuse_word(reader, word, what, error);
    const char *near = tn_nearest(tn_word_show(word, shown), texts, count);
    if (near)
        tn_error_help(error, "did you mean `%.80s`?", near);
    else
        help_choices(error, "it can be", texts, count);
    return TN_INVALID;
}

static tn_status check_words(const tn_house_line *line, int part, const char *what, const char *const *texts,
                             size_t count, tn_line_faults *faults, tn_error *error)
{
    tn_part_reader reader = open_part(line->text, line->size, part, faults);
    tn_status status = TN_OK;
    for (tn_word word = next_word(&reader); status == TN_OK && word.size > 0; word = next_word(&reader)) {
        const char *dot = part == TILES ? memchr(word.text, '.', word.size) : NULL;
        if (dot) /* where a tile stands is as free as the cell */
            word.size = word.extent = (size_t)(dot - word.text);
        if (!word_is(&word, TN_LEFT_OUT))
            status = go_on(faults, is_any_of(&reader, &word, what, texts, count, error), error);
    }
    return status;
}

static tn_status check_functions(const tn_house_line *line, tn_line_faults *faults, tn_error *error)
{
    const tn_house_form *form = line->form;
    const char *texts[TN_CELL_RULES_MAX + 1];
    size_t count = 0;
    for (uint32_t i = 0; i < tn_form_functions(form); i++)
        texts[count++] = tn_text(form->module, tn_form_rule(form, i)->name);
    texts[count++] = "void";
    return check_words(line, FUNCTIONS, "function of the form", texts, count, faults, error);
}

static tn_status check_faces(const tn_house_line *line, tn_line_faults *faults, tn_error *error)
{
    const char *texts[TN_FACE_KINDS_MAX];
    size_t count = 0;
    while (count < TN_FACE_KIND_COUNT + line->form->record->opening_count) {
        texts[count] = tn_form_kind_text(line->form, (uint32_t)count);
        count++;
    }
    return check_words(line, FACES, "kind of face", texts, count, faults, error);
}

static tn_status check_tiles(const tn_house_line *line, tn_line_faults *faults, tn_error *error)
{
    const tn_module *module = line->form->module;
    const tn_form_record *record = line->form->record;
    const char **texts = malloc(((size_t)record->tile_count + 1) * sizeof *texts);
    if (!texts)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < record->tile_count; i++)
        texts[i] = tn_text(module, module->TILE_records[record->tile_first + i].name);
    tn_status status = check_words(line, TILES, "tile of the form", texts, record->tile_count, faults, error);
    free(texts);
    return status;
}

/* The functions, faces and tiles: by where they stand, as far as all before them is known. */
static tn_status check_values(const tn_house_line *line, tn_house *house, bool stands, tn_line_faults *faults,
                              tn_error *error)
{
    bool known = stands && !faults->unknown;
    tn_status status =
        known ? read_functions(house, line->text, line->size, faults, error) : check_functions(line, faults, error);
    known = known && !faults->unknown;
    if (status == TN_OK)
        status = known ? read_faces(house, line->text, line->size, faults, error) : check_faces(line, faults, error);
    known = known && !faults->unknown;
    if (status == TN_OK)
        status = known ? read_tiles(house, line->text, line->size, faults, error) : check_tiles(line, faults, error);
    return status;
}

/* The plan and the section; *stands: the house does on them. */
static tn_status check_beginning(tn_house_line *line, size_t max_trays, tn_house *house, bool *stands,
                                 tn_line_faults *faults, tn_error *error)
{
    tn_part_reader plan = open_part(line->text, line->size, PLAN, faults), look = plan;
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    tn_status status = TN_OK;
    for (tn_word word = next_word(&look); status == TN_OK && word.size > 0; word = next_word(&look)) {
        if (!word_is(&word, TN_LEFT_OUT))
            continue;
        status = tn_fail(error, TN_INVALID, E_BAD_HOUSE, "`_` leaves a value out, and the plan has to be whole");
        tn_error_help(error, "`tartan complete` says which values a tray can still have");
        tn_word_refuse(&word, error);
    }
    if (status == TN_OK)
        status = read_plan(line->form, line->text, max_trays, plan, &line->plan, error);
    status = go_on(faults, status, error);
    bool known = !faults->unknown;
    if (status == TN_OK)
        status = read_section(line->form, line->text, line->size, shapes, faults, error);
    if (status != TN_OK || !known)
        return status;
    status =
        go_on(faults, tn_house_stand(line->form, line->plan.trays, line->plan.length, shapes, house, error), error);
    *stands = status == TN_OK && house->form;
    if (*stands && !faults->unknown)
        status = go_on(faults, check_section(house, line->text, line->size, error), error);
    return status;
}

/* A house without trays is a line, too: `-`. */
static tn_status check_any(const tn_house_line *line, tn_error *error)
{
    size_t at = 0;
    while (at < line->size && is_blank(line->text[at]))
        at++;
    if (at < line->size)
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the house line is empty");
    tn_error_help(error, "it begins with a plan; what is left out behind that is found: plan ; options ; functions ; "
                         "faces ; tiles");
    tn_error_place(error, 0, 1, 1);
    return status;
}

/* The values that are typed, part by part. */
static tn_status take_values(tn_house_line *line, tn_error *error)
{
    size_t number = 0;
    for (int part = SECTION; part < PARTS; part++) {
        tn_line_part *to = &line->parts[part];
        tn_part_reader reader = open_part(line->text, line->size, part, NULL);
        to->values = malloc((line->size / 2 + 2) * sizeof *to->values);
        if (!to->values)
            return tn_fail_memory(error);
        for (tn_word word = next_word(&reader); word.size > 0; word = next_word(&reader)) {
            bool out = word_is(&word, TN_LEFT_OUT);
            to->values[to->count++] = (tn_line_value){word.text, word.size, word.column, out, number};
            number += !out;
        }
    }
    line->typed = number;
    return TN_OK;
}

/* Errors of what a JSON object has as its line are placed in the object. */
typedef struct tn_line_placing {
    const tn_house_line *line;
    tn_line_error *said;
    void *context;
} tn_line_placing;

void tn_house_line_place(const tn_house_line *line, size_t column, size_t column_end, tn_error *error)
{
    if (line->own.data && column > 0) {
        column = tn_json_read_column(line->given, line->given_size, line->begin, column);
        column_end = tn_json_read_column(line->given, line->given_size, line->begin, column_end);
    }
    tn_error_place(error, 0, column, column_end);
}

static tn_status say_placed(void *context, tn_error *error)
{
    tn_line_placing *p = context;
    tn_house_line_place(p->line, error->column, error->column_end, error);
    return p->said(p->context, error);
}

static const char no_object[] = "a house is a house line, or a JSON object with one: {\"house\": \"...\"}";

static tn_status find_text(tn_house_line *line, const char *text, size_t size, tn_error *error)
{
    size_t at = 0;
    line->given = line->text = text;
    line->given_size = line->size = size;
    while (at < size && is_blank(text[at]))
        at++;
    if (at == size || text[at] != '{')
        return TN_OK;
    tn_status status = tn_json_read_text(text, size, "house", &line->own, &line->begin, error);
    if (status == TN_INVALID) { /* it is the object that is wrong: places in it are not mapped */
        free(line->own.data);
        line->own = (tn_buffer){0};
        tn_error_help(error, "%s", no_object);
    }
    line->text = line->own.data ? line->own.data : "";
    line->size = line->own.size;
    return status;
}

tn_status tn_house_line_read(const tn_house_form *form, const char *text, size_t size, size_t max_trays,
                             tn_line_error *said, void *context, tn_house_line *line, bool *wrong, tn_error *error)
{
    tn_line_placing placing = {line, said, context};
    tn_line_faults faults = {.said = say_placed, .context = &placing};
    tn_house house = {0};
    bool stands = false;
    *line = (tn_house_line){.form = form};
    tn_status status = go_on(&faults, find_text(line, text, size, error), error);
    if (status == TN_OK && !faults.any)
        status = go_on(&faults, check_parts(line->text, line->size, error), error);
    if (status == TN_OK && !faults.any)
        status = go_on(&faults, check_any(line, error), error);
    if (status == TN_OK && !faults.any)
        status = check_beginning(line, max_trays, &house, &stands, &faults, error);
    if (status == TN_OK)
        status = check_values(line, &house, stands, &faults, error);
    tn_house_clear(&house);
    if (status == TN_OK)
        status = take_values(line, error);
    *wrong = faults.any;
    return status;
}

void tn_house_line_clear(tn_house_line *line)
{
    for (int part = 0; part < PARTS; part++)
        free(line->parts[part].values);
    free(line->plan.trays);
    free(line->own.data);
    *line = (tn_house_line){0};
}

const char *tn_house_line_part(int part)
{
    return part_names[part];
}

/* ---- whole lines */

typedef tn_status line_reader(const tn_house_form *form, const char *line, size_t size, size_t max_trays,
                              tn_house *house, tn_error *error);

/* The line that is member "house" of a JSON object. */
static tn_status read_member(line_reader *read, const tn_house_form *form, const char *text, size_t size,
                             size_t max_trays, tn_house *house, tn_error *error)
{
    tn_buffer line = {0};
    size_t begin;
    *house = (tn_house){0};
    tn_status status = tn_json_read_text(text, size, "house", &line, &begin, error);
    if (status == TN_OK) {
        status = read(form, line.data ? line.data : "", line.size, max_trays, house, error);
        if (status == TN_INVALID && error && error->column)
            tn_error_place(error, 0, tn_json_read_column(text, size, begin, error->column),
                           tn_json_read_column(text, size, begin, error->column_end));
    } else if (status == TN_INVALID) {
        tn_error_help(error, "%s", no_object);
    }
    free(line.data);
    return status;
}

static tn_status read_text(line_reader *read, const tn_house_form *form, const char *text, size_t size,
                           size_t max_trays, tn_house *house, tn_error *error)
{
    size_t at = 0;
    while (at < size && is_blank(text[at]))
        at++;
    return at < size && text[at] == '{' ? read_member(read, form, text, size, max_trays, house, error)
                                        : read(form, text, size, max_trays, house, error);
}

tn_status tn_house_read(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                        tn_error *error)
{
    return read_text(read_whole, form, line, size, max_trays, house, error);
}

tn_status tn_house_read_open(const tn_house_form *form, const char *line, size_t size, size_t max_trays,
                             tn_house *house, tn_error *error)
{
    return read_text(read_tiles_there, form, line, size, max_trays, house, error);
}
