/* Emits what is asked of houses: the functions that decide on cells, rooms and sections, and rules and libraries. */
#include "compiler/plan/check/form.h"
#include "compiler/plan/emit/emit.h"

#define PLACE(SPAN) .file = (SPAN).file, .begin = (SPAN).begin, .end = (SPAN).end

static uint32_t emit_meeting(tn_emit *emit, const tn_ast_expr *expr, tn_checked_ask *ask)
{
    const char *name = expr->kind == TN_EXPR_TOUCH ? "touch" : expr->kind == TN_EXPR_WALK ? "walk" : "apart";
    uint32_t first = tn_emit_decision(emit, ask->form, &ask->first, name, TN_FUNCTION_CELL);
    uint32_t second =
        ask->to_outside ? TN_NO_RECORD : tn_emit_decision(emit, ask->form, &ask->second, name, TN_FUNCTION_CELL);
    uint32_t through =
        ask->has_through ? tn_emit_decision(emit, ask->form, &ask->through, name, TN_FUNCTION_CELL) : TN_NO_RECORD;
    uint32_t index = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_MEETING);
    tn_builder_add_MEETING(emit->builder,
                           &(tn_meeting_record){.first = first,
                                                .second = second,
                                                .through = through,
                                                .kind_first = tn_emit_items(emit, ask->kinds, ask->kind_count),
                                                .kind_count = ask->kind_count,
                                                PLACE(expr->node.span)});
    return index;
}

void tn_emit_ask_needs(tn_emit *emit, tn_ast_expr *expr)
{
    tn_checked_ask *ask = expr->ask;
    bool cost = expr->kind == TN_EXPR_SUM && !expr->parts.first; /* it asks for no cells */
    if (!ask || ask->function > 0 || cost)
        return;
    if (expr->kind == TN_EXPR_TOUCH || expr->kind == TN_EXPR_APART || expr->kind == TN_EXPR_WALK) {
        ask->function = emit_meeting(emit, expr, ask) + 1;
        return;
    }
    tn_function_kind kind = expr->kind == TN_EXPR_ROOM      ? TN_FUNCTION_ROOM
                            : expr->kind == TN_EXPR_SECTION ? TN_FUNCTION_SECTION
                                                            : TN_FUNCTION_CELL;
    const char *name = kind == TN_FUNCTION_ROOM ? "room" : kind == TN_FUNCTION_SECTION ? "option" : "cell";
    ask->function = tn_emit_decision(emit, ask->form, &ask->first, name, kind) + 1;
}

void tn_emit_ask(tn_emit *emit, const tn_ast_expr *expr)
{
    tn_opcode opcode = expr->kind == TN_EXPR_CELL      ? TN_OP_SOME_CELL
                       : expr->kind == TN_EXPR_ROOM    ? TN_OP_SOME_ROOM
                       : expr->kind == TN_EXPR_SECTION ? TN_OP_SECTION_IS
                       : expr->kind == TN_EXPR_TOUCH   ? TN_OP_MEETS
                       : expr->kind == TN_EXPR_APART   ? TN_OP_APART
                                                       : TN_OP_AREAS;
    int64_t condition = opcode == TN_OP_AREAS ? (int64_t)expr->condition_checked->function - 1 : 0;
    tn_emit_op(emit, expr->node.span, opcode, (int64_t)expr->ask->function - 1, condition);
}

bool tn_emit_quantity(tn_emit *emit, const tn_ast_expr *quantity)
{
    const tn_ast_expr *part = (const tn_ast_expr *)quantity->parts.first;
    const tn_ast_expr *meant = part->kind == TN_EXPR_NAME ? part->rule->meaning : part;
    if (quantity->kind != TN_EXPR_QUANTITY || (meant->kind != TN_EXPR_CELL && meant->kind != TN_EXPR_ROOM))
        return false;
    tn_emit_op(emit, quantity->node.span, meant->kind == TN_EXPR_CELL ? TN_OP_CELLS : TN_OP_ROOMS,
               (int64_t)meant->ask->function - 1, (int64_t)quantity->condition_checked->function - 1);
    return true;
}

/* ---- records */

void tn_emit_house_rule(tn_emit *emit, const tn_checked_rule *rule)
{
    const tn_ast_word *doc = rule->ast->doc;
    bool imported = rule->unit + 1 < emit->imports->count;
    tn_builder_add_HOUSE_RULE(emit->builder,
                              &(tn_house_rule_record){.name = tn_builder_string(emit->builder, rule->name),
                                                      .doc = tn_builder_string(emit->builder, doc ? doc->text : NULL),
                                                      .form = rule->form->index,
                                                      .whole = rule->whole,
                                                      .holds = rule->holds,
                                                      .flags = imported ? TN_IMPORTED : 0,
                                                      PLACE(rule->ast->top.node.span)});
}

static tn_house_term_kind house_term_kind(const tn_checked_term *term)
{
    switch (term->kind) {
    case TN_TERM_AREAS:
        return TN_HOUSE_AREAS;
    case TN_TERM_ROOMS:
        return TN_HOUSE_ROOMS;
    case TN_TERM_COST:
        return TN_HOUSE_COST;
    case TN_TERM_WALK:
        return term->part->extreme == TN_EXTREME_MOST ? TN_HOUSE_LONGEST_WALK : TN_HOUSE_SHORTEST_WALK;
    case TN_TERM_EXITS:
        return TN_HOUSE_EXITS;
    default:
        return TN_HOUSE_CELLS;
    }
}

/* The records of what the sum adds up of houses; returns the first. */
static uint32_t emit_house_terms(tn_emit *emit, const tn_checked_sum *sum, uint32_t *count)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_HOUSE_TERM);
    *count = 0;
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind < TN_TERM_CELLS)
            continue;
        uint32_t asked = term->kind == TN_TERM_COST ? TN_NO_RECORD : term->part->ask->function - 1;
        bool walk = term->kind == TN_TERM_WALK;
        tn_builder_add_HOUSE_TERM(emit->builder,
                                  &(tn_house_term_record){.kind = house_term_kind(term),
                                                          .factor = tn_builder_string(emit->builder, term->factor),
                                                          .part = walk ? TN_NO_RECORD : asked,
                                                          .walk = walk ? asked : TN_NO_RECORD});
        ++*count;
    }
    return first;
}

uint32_t tn_emit_house_sum(tn_emit *emit, const tn_checked_sum *sum, uint32_t of_plan)
{
    uint32_t count, first = emit_house_terms(emit, sum, &count);
    return tn_builder_add_HOUSE_SUM(
        emit->builder,
        &(tn_house_sum_record){.form = sum->form->index, .sum = of_plan, .term_first = first, .term_count = count});
}

void tn_emit_house_measure(tn_emit *emit, const tn_checked_rule *measure)
{
    const tn_ast_word *doc = measure->ast->doc;
    uint32_t count, first = emit_house_terms(emit, measure->sum, &count);
    tn_builder_add_HOUSE_MEASURE(
        emit->builder, &(tn_house_measure_record){.name = tn_builder_string(emit->builder, measure->name),
                                                  .doc = tn_builder_string(emit->builder, doc ? doc->text : NULL),
                                                  .form = measure->form->index,
                                                  .sum = measure->sum->index,
                                                  .term_first = first,
                                                  .term_count = count,
                                                  .flags = measure->unit + 1 < emit->imports->count ? TN_IMPORTED : 0,
                                                  PLACE(measure->ast->top.node.span)});
}

void tn_emit_house_library(tn_emit *emit, const tn_checked_library *library)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_HOUSE_CLAUSE);
    const tn_ast_word *doc = library->ast->doc;
    bool imported = library->unit + 1 < emit->imports->count;
    for (size_t i = 0; i < library->clause_count; i++) {
        tn_checked_clause *clause = library->clauses[i];
        uint32_t holds = tn_emit_clause(emit, clause, library->schema->index);
        tn_builder_add_HOUSE_CLAUSE(emit->builder,
                                    &(tn_house_clause_record){.name = tn_builder_string(emit->builder, clause->name),
                                                              .doc = tn_builder_string(emit->builder, clause->doc),
                                                              .kind = clause->kind,
                                                              .holds = holds,
                                                              PLACE(clause->span)});
    }
    tn_builder_add_HOUSE_LIBRARY(
        emit->builder, &(tn_house_library_record){.name = tn_builder_string(emit->builder, library->name),
                                                  .doc = tn_builder_string(emit->builder, doc ? doc->text : NULL),
                                                  .form = library->form->index,
                                                  .plans = library->plans->index,
                                                  .clause_first = first,
                                                  .clause_count = (uint32_t)library->clause_count,
                                                  .flags = imported ? TN_IMPORTED : 0,
                                                  PLACE(library->ast->top.node.span)});
}
