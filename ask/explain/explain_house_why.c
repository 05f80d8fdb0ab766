/* Says on what of a house an answer rests: cells, rooms, faces and walks; tiles that do not stand. */
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "driver/house/change_text.h"
#include "runtime/house/rule/witness.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/solids.h"
#include "runtime/plan/measure/amount.h"

enum { TEXT_MAX = 4096 };

/* ---- what questions find */

typedef struct answering {
    tn_house_explaining *e;
    tn_list *why; /* of tn_asked_of_house; what is found is of the last of them */
} answering;

/* The question as its author wrote it, on one line; the word of its kind where there is no source. */
static void question_text(const tn_house_explaining *e, uint32_t offset, char *text, size_t size)
{
    tn_span span;
    size_t used = 0;
    if (!e->session->opened->compiled || !tn_code_span(e->session->opened, offset, &span)) {
        snprintf(text, size, "a question of the file");
        return;
    }
    const char *source = e->session->opened->compilation.sources.files[span.file].text;
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

static tn_status append_found(answering *a, const char *text, tn_error *error)
{
    tn_asked_of_house *questions = a->why->items;
    return tn_owneds_add(&questions[a->why->count - 1].found, strdup(text), error);
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
        status = append_found(a, said.data, error);
    free(said.data);
    free(left.data);
    free(right.data);
    mpq_clears(value, constant, NULL);
    return status;
}

static tn_status begin_question(answering *a, uint32_t offset, tn_error *error)
{
    char text[TEXT_MAX] = "";
    tn_asked_of_house *asked = tn_message_add(&tn_message_asked_of_house, a->why, error);
    if (!asked)
        return TN_MEMORY;
    question_text(a->e, offset, text, sizeof text);
    asked->question = strdup(text);
    return asked->question ? TN_OK : tn_fail_memory(error);
}

static tn_status see_found(void *context, const tn_witness *found, tn_error *error)
{
    answering *a = context;
    char text[TEXT_MAX] = "";
    if (found->first != TN_NO_CELL) {
        found_text(&a->e->house, found, text, sizeof text);
        return append_found(a, text, error);
    }
    tn_status status = begin_question(a, found->offset, error);
    return status == TN_OK && tn_code_compares_house((tn_opcode)found->opcode) ? append_numbers(a, found->offset, error)
                                                                               : status;
}

tn_status tn_explain_found(tn_house_explaining *e, uint32_t function, tn_list *why, tn_error *error)
{
    answering a = {e, why};
    return tn_house_rules_witness(e->judge.rules, function, see_found, &a, error);
}

/* ---- tiles */

static tn_status add_tile(tn_house_explaining *e, uint32_t cell, uint32_t tile, tn_bare_cell *bare, tn_error *error)
{
    const tn_tile_record *record = &e->judge.module->TILE_records[tile];
    tn_tile_failure failure;
    char text[TEXT_MAX];
    tn_status status = tn_tile_fails(&e->house, cell, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(&e->judge.form, tile, &failure, tn_house_length_style(&e->house), text, sizeof text);
    tn_failing_tile *to = TN_ADD(failing_tile, bare->tiles, error);
    if (!to)
        return TN_MEMORY;
    to->tile = tn_text(e->judge.module, record->name);
    to->why = strdup(text);
    return to->why ? TN_OK : tn_fail_memory(error);
}

static tn_status add_bare(tn_house_explaining *e, uint32_t cell, tn_list *list, tn_error *error)
{
    const tn_form_record *form = e->judge.form.record;
    char text[96];
    tn_cell_text(&e->house, cell, text, sizeof text);
    tn_bare_cell *bare = tn_message_add(&tn_message_bare_cell, list, error);
    if (!bare)
        return TN_MEMORY;
    bare->usable = true;
    bare->cell = strdup(text);
    tn_status status = bare->cell ? TN_OK : tn_fail_memory(error);
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++)
        if (tn_tile_is_for(&e->house, cell, t))
            status = add_tile(e, cell, t, bare, error);
    return status;
}

static tn_status is_bare(const tn_house_explaining *e, uint32_t cell, bool *bare, tn_error *error)
{
    tn_variants tiles;
    tn_status status = tn_tile_variants(&e->house, cell, &tiles, error);
    *bare = status == TN_OK && tiles.wanted && tiles.count == 0;
    tn_variants_clear(&tiles);
    return status;
}

tn_status tn_explain_bare(tn_house_explaining *e, tn_list *list, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t cell = 0; status == TN_OK && cell < e->house.cell_count; cell++) {
        bool bare = false;
        status = is_bare(e, cell, &bare, error);
        if (status == TN_OK && bare)
            status = add_bare(e, cell, list, error);
    }
    return status;
}

/* ---- openings behind lower roofs */

tn_status tn_explain_covered(tn_house_explaining *e, tn_list *list, tn_error *error)
{
    for (uint32_t i = 0; i < e->house.face_count; i++) {
        char face[256], why[200];
        tn_behind_roof behind;
        if (!tn_face_behind_roof(&e->house, &e->house.faces[i], TN_NO_RECORD, &behind))
            continue;
        tn_covered_opening *to = tn_message_add(&tn_message_covered_opening, list, error);
        if (!to)
            return TN_MEMORY;
        tn_face_text(&e->house, i, face, sizeof face);
        tn_behind_roof_text(&e->house, &behind, why, sizeof why);
        to->opening = tn_form_kind_text(&e->judge.form, behind.kind);
        to->face = strdup(face);
        to->why = strdup(why);
        if (!to->face || !to->why)
            return tn_fail_memory(error);
    }
    return TN_OK;
}
