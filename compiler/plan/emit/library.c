/* Libraries and their clauses. */
#include "compiler/plan/emit/emit.h"

/* The total of a field over all trays of the plan. */
static void emit_total(tn_emit *emit, const tn_checked_clause *clause)
{
    uint32_t field = emit->checked->schemas[emit->schema]->field_first + clause->field;
    tn_emit_op(emit, clause->span, TN_OP_TRAY, tn_emit_spec(emit, clause->any), 0);
    tn_emit_op(emit, clause->span, TN_OP_SUM, field, clause->condition->function - 1);
}

/* A plan of another library lies above: that library's functions are lower ones. */
static uint32_t emit_onto(tn_emit *emit, tn_checked_clause *clause, uint32_t schema)
{
    for (size_t i = 0; i < clause->above->clause_count; i++)
        tn_emit_clause(emit, clause->above->clauses[i], clause->above->schema->index);
    emit->schema = schema;
    tn_emit_begin(emit, schema);
    tn_emit_op(emit, clause->span, TN_OP_IMAGE, clause->above->index, clause->onto->index);
    tn_emit_op(emit, clause->span, TN_OP_RETURN, 0, 0);
    clause->function = tn_emit_end(emit, clause->name, TN_FUNCTION_HOLDS) + 1;
    return clause->function - 1;
}

uint32_t tn_emit_clause(tn_emit *emit, tn_checked_clause *clause, uint32_t schema)
{
    bool whole = clause->kind == TN_CLAUSE_GENERATE; /* the plan as a whole is that, not only somewhere */
    if (clause->rule && !whole)
        return clause->rule->holds;
    if (clause->function > 0)
        return clause->function - 1;
    if (clause->above)
        return emit_onto(emit, clause, schema);
    emit->schema = schema;
    emit->derives = whole;
    if (clause->expr)
        tn_emit_needs(emit, clause->expr, clause->name);
    else
        tn_emit_condition(emit, clause->condition);
    tn_emit_begin(emit, schema);
    if (clause->expr)
        (whole ? tn_emit_whole : tn_emit_holds)(emit, clause->expr);
    else
        emit_total(emit, clause);
    tn_emit_op(emit, clause->expr ? clause->expr->node.span : clause->span, TN_OP_RETURN, 0, 0);
    clause->function = tn_emit_end(emit, clause->name, TN_FUNCTION_HOLDS) + 1;
    emit->derives = false;
    return clause->function - 1;
}

/* Returns the first of the records. */
static uint32_t emit_weights(tn_emit *emit, const tn_checked_library *library)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_WEIGHT);
    for (size_t i = 0; i < library->weight_count; i++) {
        const tn_checked_weight *weight = library->weights[i];
        tn_builder_add_WEIGHT(emit->builder, &(tn_weight_record){
                                                 .name = tn_builder_string(emit->builder, weight->name),
                                                 .sum = tn_emit_sum(emit, weight->sum, weight->name),
                                                 .factor = tn_builder_string(emit->builder, weight->factor),
                                                 .file = weight->span.file,
                                                 .begin = weight->span.begin,
                                                 .end = weight->span.end,
                                             });
    }
    return first;
}

/* The same of preferences. */
static uint32_t emit_preferences(tn_emit *emit, const tn_checked_library *library)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_PREFERENCE);
    uint32_t sum = library->preferred ? tn_emit_sum(emit, library->preferred, library->name) : 0;
    for (size_t i = 0; i < library->preference_count; i++) {
        const tn_checked_preference *preference = library->preferences[i];
        tn_builder_add_PREFERENCE(emit->builder, &(tn_preference_record){
                                                     .name = tn_builder_string(emit->builder, preference->name),
                                                     .doc = tn_builder_string(emit->builder, preference->doc),
                                                     .sum = sum,
                                                     .file = preference->span.file,
                                                     .begin = preference->span.begin,
                                                     .end = preference->span.end,
                                                 });
    }
    return first;
}

static void emit_library(tn_emit *emit, const tn_checked_library *library)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_CLAUSE);
    for (size_t i = 0; i < library->clause_count; i++) {
        tn_checked_clause *clause = library->clauses[i];
        uint32_t holds = tn_emit_clause(emit, clause, library->schema->index);
        tn_builder_add_CLAUSE(emit->builder, &(tn_clause_record){
                                                 .name = tn_builder_string(emit->builder, clause->name),
                                                 .doc = tn_builder_string(emit->builder, clause->doc),
                                                 .kind = clause->kind,
                                                 .holds = holds,
                                                 .file = clause->span.file,
                                                 .begin = clause->span.begin,
                                                 .end = clause->span.end,
                                             });
    }
    uint32_t first_weight = emit_weights(emit, library), first_preference = emit_preferences(emit, library);
    tn_span span = library->ast->top.node.span;
    const tn_ast_word *doc = library->ast->doc;
    tn_builder_add_LIBRARY(emit->builder, &(tn_library_record){
                                              .name = tn_builder_string(emit->builder, library->name),
                                              .doc = tn_builder_string(emit->builder, doc ? doc->text : NULL),
                                              .schema = library->schema->index,
                                              .trays_min = library->trays_min,
                                              .trays_max = library->trays_max,
                                              .clause_first = first,
                                              .clause_count = (uint32_t)library->clause_count,
                                              .flags = library->unit + 1 < emit->imports->count ? TN_IMPORTED : 0,
                                              .file = span.file,
                                              .begin = span.begin,
                                              .end = span.end,
                                              .weight_first = first_weight,
                                              .weight_count = (uint32_t)library->weight_count,
                                              .preference_first = first_preference,
                                              .preference_count = (uint32_t)library->preference_count,
                                          });
}

/* The trays of an open plan that the command line gives: a function each. And the plan in brackets. */
static void emit_asked(tn_emit *emit)
{
    const tn_checked *checked = emit->checked;
    tn_program *program = checked->program;
    program->plan = checked->asked_plan;
    program->plan_length = checked->asked_length;
    program->pattern = TN_NEW_ARRAY(emit->arena, uint32_t, checked->pattern_count);
    for (size_t i = 0; program->pattern && i < checked->pattern_count; i++) {
        tn_ast_expr *tray = checked->pattern[i];
        uint32_t function = TN_NO_RECORD;
        if (tray) {
            emit->schema = checked->pattern_schema->index;
            tn_emit_needs(emit, tray, "open plan");
            tn_emit_begin(emit, emit->schema);
            tn_emit_whole(emit, tray);
            tn_emit_op(emit, tray->node.span, TN_OP_RETURN, 0, 0);
            function = tn_emit_end(emit, "open plan", TN_FUNCTION_WHOLE);
        }
        program->pattern[program->pattern_count++] = function;
    }
}

void tn_emit_libraries(tn_emit *emit)
{
    emit_asked(emit);
    for (size_t i = 0; i < emit->checked->library_count; i++)
        if (!emit->checked->libraries[i]->form)
            emit_library(emit, emit->checked->libraries[i]);
    for (size_t i = 0; i < emit->checked->library_count; i++)
        if (emit->checked->libraries[i]->form)
            tn_emit_house_library(emit, emit->checked->libraries[i]);
}
