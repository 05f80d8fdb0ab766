/* Finds walks, ways out and `apart` that the file asks for of cells that no house of the form has. */
#include <stdlib.h>

#include "driver/house/survey_parts.h"
#include "runtime/base/array.h"
#include "runtime/house/rule/stages.h"

/* ---- which are asked for */

static bool asks(const tn_module *module, uint32_t first, uint32_t count)
{
    bool floors = false;
    for (uint32_t i = first; i < first + count; i++)
        floors |= tn_house_term_of_floors(module->HOUSE_TERM_records[i].kind);
    return floors;
}

static bool asks_walks(const tn_module *module, uint32_t form)
{
    bool walks = false;
    for (uint32_t i = 0; i < module->HOUSE_MEASURE_count; i++) {
        const tn_house_measure_record *measure = &module->HOUSE_MEASURE_records[i];
        walks |= measure->form == form && asks(module, measure->term_first, measure->term_count);
    }
    for (uint32_t i = 0; i < module->HOUSE_SUM_count; i++) {
        const tn_house_sum_record *sum = &module->HOUSE_SUM_records[i];
        walks |= sum->form == form && asks(module, sum->term_first, sum->term_count);
    }
    return walks;
}

/* Marks the functions of rules and clauses about houses of the form, and those that they call, which are lower. */
static void mark_asked(const tn_module *module, uint32_t form, bool *reached)
{
    for (uint32_t i = 0; i < module->HOUSE_RULE_count; i++)
        if (module->HOUSE_RULE_records[i].form == form)
            reached[module->HOUSE_RULE_records[i].holds] = reached[module->HOUSE_RULE_records[i].whole] = true;
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        for (uint32_t k = 0; library->form == form && k < library->clause_count; k++)
            reached[module->HOUSE_CLAUSE_records[library->clause_first + k].holds] = true;
    }
    for (size_t f = module->FUNCTION_count; f-- > 0;) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        bool asked = reached[f] && tn_function_kinds[function->kind].code == TN_CODE_RULE;
        for (uint32_t at = function->code_begin; asked && at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            tn_mark_operands(module, &op, reached);
            at += op.length;
        }
    }
}

/* Calls back with each `apart` that the file itself asks of houses of the form. */
typedef tn_status apart_each(void *context, const tn_meeting_record *walk, tn_error *error);
static tn_status each_apart(const tn_opened *opened, uint32_t form, apart_each *each, void *context, tn_error *error)
{
    const tn_module *module = opened->module;
    bool *reached = calloc(module->FUNCTION_count + 1, sizeof *reached);
    tn_status status = reached ? TN_OK : tn_fail_memory(error);
    if (reached)
        mark_asked(module, form, reached);
    for (size_t f = 0; status == TN_OK && f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        bool asked = reached[f] && tn_function_kinds[function->kind].code == TN_CODE_RULE;
        for (uint32_t at = function->code_begin; status == TN_OK && asked && at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            tn_span span;
            if (op.opcode == TN_OP_APART && tn_code_span(opened, at, &span) && span.file == 0)
                status = each(context, &module->MEETING_records[op.first], error);
            at += op.length;
        }
    }
    free(reached);
    return status;
}

static tn_status note_any(void *context, const tn_meeting_record *walk, tn_error *error)
{
    bool *any = context;
    (void)walk, (void)error;
    *any = true;
    return TN_OK;
}

tn_status tn_survey_asks_walks(const tn_opened *opened, uint32_t form, bool *asked, tn_error *error)
{
    *asked = asks_walks(opened->module, form);
    return *asked ? TN_OK : each_apart(opened, form, note_any, asked, error);
}

/* Where the question about the cell stands: the last instruction has the whole of it. False where nobody knows. */
static bool find_place(const tn_opened *opened, uint32_t function, tn_span *span)
{
    const tn_module *module = opened->module;
    uint32_t at = module->FUNCTION_records[function].code_begin;
    while (module->code[at] != TN_OP_DECIDE)
        at += tn_code_read(module->code, at).length;
    return tn_code_span(opened, at, span);
}

/* Those of the file itself: others have been warned about where they stand. */
static tn_status add_end(tn_survey *s, const tn_opened *opened, uint32_t function, tn_walk_part part, tn_error *error)
{
    tn_span span;
    if (function == TN_NO_RECORD || !find_place(opened, function, &span) || span.file != 0)
        return TN_OK;
    for (size_t i = 0; i < s->end_count; i++)
        if (s->ends[i].function == function && s->ends[i].part == part)
            return TN_OK; /* several rules call one that asks for it */
    if (!tn_array_reserve(&s->ends, &s->end_room, s->end_count, 1, sizeof *s->ends))
        return tn_fail_memory(error);
    s->ends[s->end_count++] = (tn_walk_end){.function = function, .part = part, .span = span};
    return TN_OK;
}

static tn_status add_term(tn_survey *s, const tn_opened *opened, const tn_house_term_record *term, tn_error *error)
{
    if (!tn_house_term_of_floors(term->kind))
        return TN_OK;
    if (term->walk == TN_NO_RECORD)
        return add_end(s, opened, term->part, TN_WAYS_BEGIN, error);
    const tn_meeting_record *walk = &s->form.module->MEETING_records[term->walk];
    tn_status status = add_end(s, opened, walk->first, TN_WALK_BEGINS, error);
    if (status == TN_OK)
        status = add_end(s, opened, walk->second, TN_WALK_ENDS, error);
    return status == TN_OK ? add_end(s, opened, walk->through, TN_WALK_THROUGH, error) : status;
}

/* Whose ends are found. */
typedef struct finding {
    tn_survey *survey;
    const tn_opened *opened;
} finding;

static tn_status add_apart(void *context, const tn_meeting_record *walk, tn_error *error)
{
    const finding *f = context;
    tn_status status = add_end(f->survey, f->opened, walk->first, TN_APART_CELLS, error);
    if (status == TN_OK)
        status = add_end(f->survey, f->opened, walk->second, TN_APART_FROM, error);
    return status == TN_OK ? add_end(f->survey, f->opened, walk->through, TN_APART_THROUGH, error) : status;
}

static tn_status add_terms(tn_survey *s, const tn_opened *opened, uint32_t first, uint32_t count, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = first; status == TN_OK && i < first + count; i++)
        status = add_term(s, opened, &s->form.module->HOUSE_TERM_records[i], error);
    return status;
}

tn_status tn_survey_ends(tn_survey *s, const tn_opened *opened, tn_error *error)
{
    const tn_module *module = s->form.module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_MEASURE_count; i++) {
        const tn_house_measure_record *measure = &module->HOUSE_MEASURE_records[i];
        if (&module->FORM_records[measure->form] == s->form.record)
            status = add_terms(s, opened, measure->term_first, measure->term_count, error);
    }
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_SUM_count; i++) {
        const tn_house_sum_record *sum = &module->HOUSE_SUM_records[i];
        if (&module->FORM_records[sum->form] == s->form.record)
            status = add_terms(s, opened, sum->term_first, sum->term_count, error);
    }
    finding f = {s, opened};
    uint32_t form = (uint32_t)(s->form.record - module->FORM_records);
    return status == TN_OK ? each_apart(opened, form, add_apart, &f, error) : status;
}

void tn_survey_see_ends(tn_survey *s, const tn_cell *cell)
{
    for (size_t i = 0; i < s->end_count; i++)
        s->ends[i].met = s->ends[i].met || tn_house_decide(&s->house, s->ends[i].function, cell);
}

/* ---- what is said */

/* Does the question name the function? */
static bool names(const tn_survey *s, uint32_t question, uint32_t function)
{
    const tn_module *module = s->form.module;
    bool named = false;
    for (uint32_t at = module->FUNCTION_records[question].code_begin; module->code[at] != TN_OP_DECIDE;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        named |=
            instruction.opcode == TN_OP_IS_FOR && instruction.first == s->form.record->rule_first + (int64_t)function;
        at += instruction.length;
    }
    return named;
}

/* Appends "`bedroom` in `upper`, `loft`"; nothing where no cell may have the function. */
static void append_storeys(const tn_survey *s, uint32_t function, tn_buffer *text)
{
    bool any = false;
    for (uint32_t storey = 0; storey < s->form.record->storey_count; storey++) {
        bool there = false;
        for (size_t i = 0; i < s->class_count; i++)
            there |= s->classes[i].storey == storey && tn_survey_has(s->classes[i].functions, function);
        if (!there)
            continue;
        if (!any)
            tn_buffer_printf(text, "%s`%s` in ", text->size ? "; " : "",
                             tn_text(s->form.module, tn_form_rule(&s->form, function)->name));
        tn_buffer_printf(
            text, "%s`%s`", any ? ", " : "",
            tn_text(s->form.module, s->form.module->STOREY_records[s->form.record->storey_first + storey].name));
        any = true;
    }
}

/* Where the functions that it names can be; if none of these can be anywhere, where all can. */
static tn_status help_functions(const tn_survey *s, tn_diagnostics *list, const tn_walk_end *end, tn_diagnostic *d,
                                tn_error *error)
{
    enum { SHOWN = 400 };
    tn_buffer text = {0};
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++)
        if (names(s, end->function, f))
            append_storeys(s, f, &text);
    bool named = text.size > 0;
    for (uint32_t f = 0; !named && f < tn_form_functions(&s->form) && text.size < SHOWN; f++)
        append_storeys(s, f, &text);
    if (text.size > 0 && !text.failed)
        tn_help(list, d, "write a function and a storey in which it may be: %s%s", text.data,
                named ? "; the line of the function says in which trays and cells" : "");
    bool failed = text.failed;
    free(text.data);
    return failed ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_survey_warn_walks(const tn_survey *s, tn_opened *opened, tn_error *error)
{
    static const char *const texts[] = {
        [TN_WALK_BEGINS] = "this walk begins at",      [TN_WALK_ENDS] = "this walk leads to",
        [TN_WALK_THROUGH] = "this walk leads through", [TN_WAYS_BEGIN] = "these ways out begin at",
        [TN_APART_CELLS] = "this `apart` is about",       [TN_APART_FROM] = "this `apart` asks for walks to",
        [TN_APART_THROUGH] = "this `apart` asks for walks through"};
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < s->end_count; i++) {
        const tn_walk_end *end = &s->ends[i];
        if (end->met || tn_program_allows(opened->compilation.program, W_CELL_NEVER, end->span))
            continue;
        tn_diagnostic *d = tn_report(list, W_CELL_NEVER, end->span, "%s cells that no house of form `%s` has",
                                     texts[end->part], tn_text(s->form.module, s->form.record->name));
        status = help_functions(s, list, end, d, error);
    }
    return status;
}
