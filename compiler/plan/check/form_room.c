/* Reads what is asked of rooms: the items of `room(...)`, as code that decides on one room.
 *
 * An item is what each of its cells is, `by` and a kind of face that it has, its `area`, the number of its `cells`, or
 * its `glazing`.
 */
#include <string.h>

#include "compiler/plan/check/form.h"

typedef struct tn_room_reader {
    tn_check *check;
    const tn_checked_form *form;
    tn_decision *decision;
    tn_item_context context;
    bool by; /* the alternatives before were kinds of faces */
} tn_room_reader;

static void add(tn_room_reader *reader, tn_decision_step step)
{
    tn_decision_add(reader->check, reader->decision, step);
}

/* by window; after it in the same item a kind alone */
static bool read_kind(tn_room_reader *reader, const tn_ast_word *word)
{
    const tn_ast_word *kind = tn_word_is(word, "by") ? (const tn_ast_word *)word->node.next : word;
    reader->by = true;
    if (!kind || kind->kind != TN_WORD_NAME || kind->node.next) {
        tn_diagnostic *d =
            tn_report(reader->check->diagnostics, E_BAD_CELL, word->node.span, "one kind of face must follow `by`");
        tn_help(reader->check->diagnostics, d, "write `by` and an opening, `open`, `wall` or `stair`");
        return false;
    }
    uint32_t number = tn_form_kind(reader->check, reader->form, TN_FACE_RELATION_COUNT, kind);
    add(reader, (tn_decision_step){.opcode = TN_OP_HAS_FACE, .index = number, .span = kind->node.span});
    return number != TN_NONE;
}

static bool is_ratio(const tn_ast_word *word)
{
    return word && word->kind == TN_WORD_RATIO && !word->broken && !word->node.next &&
           word->low->value <= TN_RATIO_MAX && word->high->value >= 1 && word->high->value <= TN_RATIO_MAX;
}

/* glazing < 1:12 */
static bool read_glazing(tn_room_reader *reader, const tn_ast_word *word)
{
    const tn_ast_word *sign = (const tn_ast_word *)word->node.next;
    const tn_ast_word *ratio = sign ? (const tn_ast_word *)sign->node.next : NULL;
    if (!sign || sign->kind != TN_WORD_OPERATOR || !is_ratio(ratio)) {
        bool compared = sign && sign->kind == TN_WORD_OPERATOR && ratio;
        tn_diagnostic *d = tn_report(reader->check->diagnostics, E_BAD_CELL, (compared ? ratio : word)->node.span,
                                     "the glazing of a room can only be compared with a part of its floor");
        tn_help(reader->check->diagnostics, d,
                "write `glazing < 1:12` for windows smaller than a twelfth of the floor; numbers up to %u",
                TN_RATIO_MAX);
        return false;
    }
    add(reader, (tn_decision_step){.opcode = TN_OP_ROOM_GLAZING,
                                   .index = tn_form_test(sign->op),
                                   .area = ratio->low->value << 32 | ratio->high->value,
                                   .span = tn_span_join(word->node.span, ratio->node.span)});
    for (uint32_t i = 0; i < reader->form->opening_count; i++)
        if (reader->form->openings[i].glazed)
            return true;
    if (reader->check->skipped)
        return true; /* it may be among the lines that were not read */
    tn_diagnostic *d = tn_report(reader->check->diagnostics, E_BAD_CELL, word->node.span,
                                 "no opening of form `%s` is `glazed`", reader->form->name);
    tn_help(reader->check->diagnostics, d, "write `glazed` after the sizes of each opening that lets daylight in");
    return false;
}

static bool read_cells(tn_room_reader *reader, const tn_ast_word *word, tn_span span)
{
    tn_decision *cells = TN_NEW(reader->check->arena, tn_decision);
    if (!cells)
        return false;
    *cells = (tn_decision){.span = span};
    add(reader, (tn_decision_step){.opcode = TN_OP_ALL_CELLS, .cells = cells, .span = span});
    return tn_form_cell_words(reader->check, reader->form, word, span, &reader->context, cells);
}

static bool read_alternative(tn_room_reader *reader, const tn_ast_alternative *alternative)
{
    bool negated, good;
    const tn_ast_word *word = tn_form_negated(reader->check, alternative, "room", &negated);
    if (!word)
        return false;
    if (word->kind == TN_WORD_NAME && (tn_word_is(word, "by") || reader->by))
        good = read_kind(reader, word);
    else if (word->kind == TN_WORD_NAME && tn_word_is(word, "area"))
        good = tn_form_compared(reader->check, word, TN_OP_ROOM_AREA, reader->decision);
    else if (word->kind == TN_WORD_NAME && tn_word_is(word, "cells"))
        good = tn_form_compared(reader->check, word, TN_OP_ROOM_CELLS, reader->decision);
    else if (word->kind == TN_WORD_NAME && tn_word_is(word, "glazing"))
        good = read_glazing(reader, word);
    else
        good = read_cells(reader, word, alternative->node.span);
    if (negated)
        add(reader, (tn_decision_step){.opcode = TN_OP_NONE_OF, .span = alternative->node.span});
    return good;
}

static bool read_item(tn_room_reader *reader, const tn_ast_item *item)
{
    bool good = true, first = true;
    reader->context = (tn_item_context){.field = TN_NONE};
    reader->by = false;
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        good &= read_alternative(reader, alternative);
        if (!first)
            add(reader, (tn_decision_step){.opcode = TN_OP_ONE_OF, .span = alternative->node.span});
        first = false;
    }
    return good;
}

bool tn_form_room(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, tn_decision *decision)
{
    tn_room_reader reader = {.check = check, .form = form, .decision = decision};
    bool good = true, first = true;
    decision->span = expr->node.span;
    if (!expr->items.first)
        add(&reader, (tn_decision_step){.opcode = TN_OP_EVERY, .span = expr->node.span});
    for (TN_EACH(const tn_ast_item, item, expr->items)) {
        good &= read_item(&reader, item);
        if (!first)
            add(&reader, (tn_decision_step){.opcode = TN_OP_ALL_OF, .span = item->node.span});
        first = false;
    }
    return good;
}
