/* Says on what of a house an answer rests: cells, rooms, faces and walks; tiles that do not stand. */
#include <stdlib.h>
#include <string.h>

#include "driver/house/change_text.h"
#include "cli/house/explained_parts.h"
#include "runtime/house/rule/witness.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/solids.h"
#include "runtime/plan/measure/amount.h"

enum { TEXT_MAX = 4096 };

/* ---- what questions find */

typedef struct answering {
    tn_house_explaining *e;
    size_t found;
    bool begun;
} answering;

/* The question as its author wrote it, on one line; the word of its kind where there is no source. */
static void question_text(const tn_house_explaining *e, uint32_t offset, char *text, size_t size)
{
    tn_span span;
    size_t used = 0;
    if (!e->job->opened.compiled || !tn_code_span(&e->job->opened, offset, &span)) {
        snprintf(text, size, "a question of the file");
        return;
    }
    const char *source = e->job->opened.compilation.sources.files[span.file].text;
    for (uint32_t i = span.begin; i < span.end && used + 1 < size; i++) {
        bool blank = strchr(" \t\r\n", source[i]) != NULL;
        if (!blank || (used > 0 && text[used - 1] != ' '))
            text[used++] = blank ? ' ' : source[i];
    }
    text[used] = '\0';
}

static void room_text(const tn_house *house, uint32_t room, char *text, size_t size)
{
    uint32_t *rooms = NULL;
    tn_error error;
    size_t used = 0;
    char cell[96];
    if (tn_house_rooms(house, &rooms, &error) != TN_OK)
        return;
    for (uint32_t i = room; i < house->cell_count && used + sizeof cell < size; i++) {
        if (rooms[i] != room)
            continue;
        tn_cell_text(house, i, cell, sizeof cell);
        used += (size_t)snprintf(text + used, size - used, "%s%s", i == room ? "" : " with ", cell);
    }
    free(rooms);
}

/* "2.body.upper, from where one comes to 2.body.ground" */
static void walk_text(const tn_house *house, const tn_witness *found, char *text, size_t size)
{
    char cell[96];
    size_t used, others = 0;
    tn_cell_text(house, found->first, cell, sizeof cell);
    used = (size_t)snprintf(text, size, "%s, from where the walk ", cell);
    for (uint32_t i = 0; i < house->cell_count && used + sizeof cell < size; i++) {
        if (!found->reached[i] || i == found->first)
            continue;
        tn_cell_text(house, i, cell, sizeof cell);
        used += (size_t)snprintf(text + used, size - used, "%s%s", others++ ? ", " : "comes only to ", cell);
    }
    if (others == 0 && used < size)
        snprintf(text + used, size - used, "leads nowhere");
}

static void found_text(const tn_house *house, const tn_witness *found, char *text, size_t size)
{
    switch (found->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        room_text(house, found->first, text, size);
        return;
    case TN_OP_MEETS:
        tn_face_text(house, found->face, text, size);
        snprintf(text + strlen(text), size - strlen(text), ": %s",
                 tn_form_kind_text(house->form, house->faces[found->face].kind));
        return;
    case TN_OP_APART:
        walk_text(house, found, text, size);
        return;
    default:
        tn_cell_text(house, found->first, text, size);
    }
}

/* Exactly where a decimal does that, else to six digits. */
static bool append_amount(tn_amount_unit unit, mpq_t value, tn_buffer *out)
{
    bool good = tn_amount_write(unit, value, out);
    if (!good || !strchr(out->data, '/'))
        return good;
    out->size = 0;
    tn_amount_convert(unit, value);
    return tn_amount_write_about(unit, value, out);
}

static void append_found(answering *a, const char *text)
{
    if (a->e->json)
        tn_json_string(a->e->json, NULL, text);
    else
        tn_buffer_printf(&a->e->text, "%s %s", a->found ? ";" : "", text);
    a->found++;
}

/* What a comparison finds: the number of the house and the one that is compared with it, costs to the cent. */
static tn_status append_numbers(answering *a, uint32_t offset, tn_error *error)
{
    const tn_module *module = a->e->judge.module;
    tn_instruction op = tn_code_read(module->code, offset);
    const tn_sum_record *sum = &module->SUM_records[module->HOUSE_SUM_records[op.first].sum];
    tn_amount_unit unit = tn_amount_unit_of(a->e->judge.schema, sum->power);
    tn_buffer left = {0}, right = {0}, said = {0};
    bool costs = false;
    mpq_t value, constant;
    mpq_inits(value, constant, NULL);
    tn_status status = tn_house_rules_sum(a->e->judge.rules, (uint32_t)op.first, value, &costs, error);
    mpq_set_str(constant, tn_text(module, sum->constant), 10);
    mpq_sub(value, value, constant);
    mpq_neg(constant, constant);
    if (costs)
        tn_round_to_cent(value);
    bool alone = mpq_sgn(constant) == 0;
    if (status == TN_OK && (!append_amount(unit, value, &left) || !append_amount(unit, constant, &right)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        tn_buffer_printf(&said, "%s%s%s%s", alone ? "the left side less the right side is " : "", left.data,
                         alone ? "" : ", compared with ", alone ? "" : right.data);
    if (status == TN_OK && said.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        append_found(a, said.data);
    free(said.data);
    free(left.data);
    free(right.data);
    mpq_clears(value, constant, NULL);
    return status;
}

static void end_question(answering *a)
{
    if (!a->begun)
        return;
    if (a->e->json) {
        tn_json_list_end(a->e->json);
        tn_json_object_end(a->e->json);
    } else {
        tn_buffer_printf(&a->e->text, "%s", a->found == 0 ? " nothing\n" : "\n");
    }
}

static tn_status write_found(void *context, const tn_witness *found, tn_error *error)
{
    answering *a = context;
    char text[TEXT_MAX] = "";
    if (found->first != TN_NO_CELL) {
        found_text(&a->e->house, found, text, sizeof text);
        append_found(a, text);
        return TN_OK;
    }
    end_question(a);
    question_text(a->e, found->offset, text, sizeof text);
    if (a->e->json) {
        tn_json_object(a->e->json, NULL);
        tn_json_string(a->e->json, "question", text);
        tn_json_list(a->e->json, "found");
    } else {
        tn_buffer_printf(&a->e->text, "    %s:", text);
    }
    a->begun = true;
    a->found = 0;
    return tn_code_compares_house((tn_opcode)found->opcode) ? append_numbers(a, found->offset, error) : TN_OK;
}

tn_status tn_explain_why(tn_house_explaining *e, uint32_t function, tn_error *error)
{
    answering a = {.e = e};
    tn_status status = tn_house_rules_witness(e->judge.rules, function, write_found, &a, error);
    end_question(&a);
    return status;
}

/* ---- tiles */

static tn_status write_tile(tn_house_explaining *e, uint32_t cell, uint32_t tile, tn_error *error)
{
    const tn_tile_record *record = &e->judge.module->TILE_records[tile];
    tn_tile_failure failure;
    char text[TEXT_MAX];
    tn_status status = tn_tile_fails(&e->house, cell, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(&e->judge.form, tile, &failure, tn_house_length_style(&e->house), text, sizeof text);
    const char *name = tn_text(e->judge.module, record->name);
    if (!e->json) {
        tn_buffer_printf(&e->text, "    %s: %s\n", name, text);
        return TN_OK;
    }
    tn_json_object(e->json, NULL);
    tn_json_string(e->json, "tile", name);
    tn_json_string(e->json, "why", text);
    tn_json_object_end(e->json);
    return TN_OK;
}

static tn_status write_bare(tn_house_explaining *e, uint32_t cell, tn_error *error)
{
    const tn_form_record *form = e->judge.form.record;
    char text[96];
    tn_status status = TN_OK;
    tn_cell_text(&e->house, cell, text, sizeof text);
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "cell", text);
        tn_json_list(e->json, "tiles");
    } else {
        tn_buffer_printf(&e->text, "- no tile stands in %s, so this is no house of any library\n", text);
    }
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++)
        if (tn_tile_is_for(&e->house, cell, t))
            status = write_tile(e, cell, t, error);
    if (e->json) {
        tn_json_list_end(e->json);
        tn_json_object_end(e->json);
    }
    return status;
}

tn_status tn_explain_next_bare(const tn_house_explaining *e, uint32_t *cell, tn_error *error)
{
    tn_status status = TN_OK;
    for (; *cell < e->house.cell_count; ++*cell) {
        tn_variants tiles;
        status = tn_tile_variants(&e->house, *cell, &tiles, error);
        bool bare = status == TN_OK && tiles.wanted && tiles.count == 0;
        tn_variants_clear(&tiles);
        if (bare || status != TN_OK)
            return status;
    }
    return status;
}

tn_status tn_explain_tiles(tn_house_explaining *e, tn_error *error)
{
    uint32_t cell = 0;
    if (e->json)
        tn_json_list(e->json, "bare");
    tn_status status = tn_explain_next_bare(e, &cell, error);
    while (status == TN_OK && cell < e->house.cell_count) {
        status = write_bare(e, cell++, error);
        if (status == TN_OK)
            status = tn_explain_next_bare(e, &cell, error);
    }
    if (e->json)
        tn_json_list_end(e->json);
    return status;
}

/* ---- openings behind lower roofs */

void tn_explain_behind_roofs(tn_house_explaining *e)
{
    tn_behind_roof behind;
    bool any = false;
    if (e->json)
        tn_json_list(e->json, "behind_roofs");
    for (uint32_t i = 0; i < e->house.face_count; i++) {
        char face[256], why[200];
        if (!tn_face_behind_roof(&e->house, &e->house.faces[i], TN_NO_RECORD, &behind))
            continue;
        const char *opening = tn_form_kind_text(&e->judge.form, behind.kind);
        tn_face_text(&e->house, i, face, sizeof face);
        tn_behind_roof_text(&e->house, &behind, why, sizeof why);
        if (e->json) {
            tn_json_object(e->json, NULL);
            tn_json_string(e->json, "face", face);
            tn_json_string(e->json, "opening", opening);
            tn_json_string(e->json, "why", why);
            tn_json_object_end(e->json);
        } else {
            tn_buffer_printf(&e->text, "%s    %s: `%s` does not fit, as %s\n", any ? "" : "behind lower roofs:\n", face,
                             opening, why);
        }
        any = true;
    }
    if (e->json)
        tn_json_list_end(e->json);
}
