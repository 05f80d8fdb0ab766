/* Reads house lines: `plan ; section ; functions ; faces ; tiles`, in this order; trays are between bars, and a part
 * without words is `-`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/house/solids.h"
#include "runtime/plan/schema/value.h"
#include "runtime/plan/text/text.h"

enum { PLAN, SECTION, FUNCTIONS, FACES, TILES, PARTS };
static const char *const part_names[] = {"plan", "section", "functions", "faces", "tiles"};

/* The words of one part. */
typedef struct tn_part_reader {
    const char *line;
    size_t at, end; /* what is left of it */
    size_t bars;    /* before that */
    int part;
    bool there; /* has it words at all? */
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

static tn_part_reader open_part(const char *line, size_t size, int part)
{
    tn_part_reader reader = {.line = line, .at = 0, .end = size, .part = part};
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

/* Which of the texts the next word is. Where the part has no words, the only one there is. lead: what comes before the
 * texts in an error's help. */
static tn_status choose(tn_part_reader *reader, const char *what, const char *lead, const char *const *texts,
                        size_t count, size_t *chosen, tn_error *error)
{
    *chosen = 0;
    if (!reader->there && count == 1)
        return TN_OK;
    tn_word word = next_word(reader);
    for (; *chosen < count; ++*chosen)
        if (word.size > 0 && word_is(&word, texts[*chosen]))
            return TN_OK;
    if (word.size > 0) {
        refuse_word(reader, &word, what, error);
    } else {
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the house line ends too soon: in the %s, a %s is missing",
                part_names[reader->part], what);
        tn_error_place(error, 0, reader->end + 1, reader->end + 1);
    }
    help_choices(error, lead, texts, count);
    return TN_INVALID;
}

static tn_status at_end(tn_part_reader *reader, const char *what, tn_error *error)
{
    tn_word word = next_word(reader);
    if (word.size == 0)
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
                              tn_error *error)
{
    tn_part_reader reader = open_part(line, size, SECTION);
    for (uint32_t i = 0; i < form->record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(form, i);
        const char *texts[TN_VALUES_MAX];
        size_t chosen;
        for (uint32_t s = 0; s < choice->shape_count; s++)
            texts[s] = tn_text(form->module, form->module->SHAPE_records[choice->shape_first + s].spelling);
        char what[120];
        snprintf(what, sizeof what, "value of `%.80s`", tn_text(form->module, choice->name));
        tn_status status = choose(&reader, what, "it can be", texts, choice->shape_count, &chosen, error);
        if (status != TN_OK)
            return status;
        shapes[i] = (uint32_t)chosen;
    }
    return at_end(&reader, "choice of the form", error);
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
    tn_error_help(error, "its `forbid` lines say which sections there are not");
}

static tn_status check_section(tn_house *house, const char *line, size_t size, tn_error *error)
{
    if (tn_house_section_stands(house))
        return TN_OK;
    tn_part_reader reader = open_part(line, size, SECTION);
    size_t end = reader.end;
    tn_word first = next_word(&reader);
    while (end > 0 && is_blank(line[end - 1]))
        end--;
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the form forbids this section");
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
    if (!reader->there || word.size == 0 || look.bars == tray)
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

static tn_status read_functions(tn_house *house, const char *line, size_t size, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, FUNCTIONS);
    for (size_t i = 0; i < house->cell_count; i++) {
        tn_status status = at_tray(house, &reader, house->cells[i].tray, error);
        if (status == TN_OK)
            status = read_function(house, &reader, &house->cells[i], error);
        if (status != TN_OK)
            return status;
    }
    return at_end(&reader, "cell", error);
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

static tn_status read_faces(tn_house *house, const char *line, size_t size, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, FACES);
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
        if (status != TN_OK) {
            help_behind_roof(house, i + 1, &word, error);
            return status;
        }
        house->faces[i].kind = kinds[chosen];
    }
    tn_part_reader look = reader;
    tn_word word = next_word(&look);
    tn_status status = at_end(&reader, "face with a choice", error);
    if (status != TN_OK)
        help_behind_roof(house, house->face_count, &word, error);
    return status;
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

static tn_status read_tile(tn_house *house, tn_part_reader *reader, uint32_t cell, tn_error *error)
{
    tn_variants v;
    tn_status status = tn_tile_variants(house, cell, &v, error);
    char(*names)[TN_VARIANT_TEXT] = NULL;
    const char **texts = NULL;
    if (status == TN_OK && v.wanted && v.count == 0)
        status = no_tile(house, &house->cells[cell], error);
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

static tn_status read_tiles(tn_house *house, const char *line, size_t size, tn_error *error)
{
    tn_part_reader reader = open_part(line, size, TILES);
    for (uint32_t i = 0; i < house->cell_count; i++) {
        tn_status status = read_tile(house, &reader, i, error);
        if (status != TN_OK)
            return status;
    }
    return at_end(&reader, "cell whose function has tiles", error);
}

static tn_status check_parts(const char *line, size_t size, tn_error *error)
{
    int parts = 0;
    for (size_t i = 0; i < size; i++) {
        if (line[i] != ';' || ++parts < PARTS)
            continue;
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "a house line has five parts, and this is a sixth");
        tn_error_help(error, "the parts are: plan ; section ; functions ; faces ; tiles");
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
        status = read_plan(form, line, max_trays, open_part(line, size, PLAN), &trays, error);
    if (status == TN_OK)
        status = read_section(form, line, size, shapes, error);
    if (status == TN_OK)
        status = tn_house_stand(form, trays.trays, trays.length, shapes, house, error);
    free(trays.trays);
    if (status == TN_OK)
        status = check_section(house, line, size, error);
    if (status == TN_OK)
        status = read_functions(house, line, size, error);
    if (status == TN_OK)
        status = read_faces(house, line, size, error);
    return status;
}

static tn_status read_whole(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                            tn_error *error)
{
    tn_status status = read_open(form, line, size, max_trays, house, error);
    return status == TN_OK ? read_tiles(house, line, size, error) : status;
}

static tn_status read_tiles_there(const tn_house_form *form, const char *line, size_t size, size_t max_trays,
                                  tn_house *house, tn_error *error)
{
    tn_status status = read_open(form, line, size, max_trays, house, error);
    house->tiles_left_out = !open_part(line, size, TILES).there;
    return status == TN_OK && !house->tiles_left_out ? read_tiles(house, line, size, error) : status;
}

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
        tn_error_help(error, "a house is a house line, or a JSON object with one: {\"house\": \"...\"}");
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
