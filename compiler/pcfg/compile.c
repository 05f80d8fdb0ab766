/* Writes a checked connection grammar as records and code; and the front end that the table of notations names, which
 * compiles several texts as one grammar. */
#include <stdio.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/layout.h"
#include "compiler/common/notation.h"
#include "compiler/pcfg/ast.h"

/* ==== writes a checked connection grammar as records and code. What cannot be reached is left out */

typedef struct emitting {
    const tn_pcfg_grammar *grammar;
    tn_builder *builder;
    tn_names vectors; /* by their text: a number above their index */
    uint32_t first_symbol;
} emitting;

static uint32_t vector(emitting *e, const tn_step *step)
{
    char text[64];
    int length = snprintf(text, sizeof text, "%d,%d,%d", step->a[0], step->a[1], step->a[2]);
    const void *known = tn_names_get(&e->vectors, text);
    if (known)
        return (uint32_t)((uintptr_t)known - 1);
    tn_vector_record record = {.x = step->a[0], .y = step->a[1], .z = step->a[2]};
    uint32_t index = tn_builder_add_VECTOR(e->builder, &record);
    const char *name = tn_arena_copy(e->grammar->arena, text, (size_t)length);
    if (name)
        tn_names_put(&e->vectors, name, (void *)((uintptr_t)index + 1));
    return index;
}

static void emit_step(emitting *e, const tn_step *step)
{
    static const tn_opcode opcodes[] = {
        [TN_STEP_PUSH] = TN_OP_PUSH,
        [TN_STEP_POP] = TN_OP_POP,
        [TN_STEP_MOVE] = TN_OP_MOVE,
        [TN_STEP_TURN] = TN_OP_HEADING,
        [TN_STEP_COLOUR] = TN_OP_COLOUR,
        [TN_STEP_PART] = TN_OP_PART,
        [TN_STEP_FILL] = TN_OP_FILL,
        [TN_STEP_FILL_OVER] = TN_OP_FILL_OVER,
        [TN_STEP_TOUCH] = TN_OP_TOUCH,
        [TN_STEP_BOUND_BOX] = TN_OP_BOUND_BOX,
        [TN_STEP_BOUND_BALL] = TN_OP_BOUND_BALL,
        [TN_STEP_EXPAND] = TN_OP_DERIVE,
    };
    tn_opcode opcode = opcodes[step->kind];
    int64_t operand = 0;
    switch (tn_opcode_describe((uint8_t)opcode)->operands) {
    case TN_OPERANDS_VECTOR:
        operand = vector(e, step);
        break;
    case TN_OPERANDS_AMOUNT:
        operand = step->a[0];
        break;
    case TN_OPERANDS_PART:
        operand = tn_builder_string(e->builder, step->text);
        break;
    case TN_OPERANDS_SYMBOL:
        operand = e->first_symbol + e->grammar->symbols[step->index]->emitted;
        break;
    default:
        break;
    }
    tn_builder_emit(e->builder, opcode, operand, 0);
}

static void emit_alternative(emitting *e, const tn_pcfg_alternative *alternative)
{
    tn_builder *builder = e->builder;
    tn_production_record production = {.code_begin = tn_builder_offset(builder),
                                       .file = alternative->span.file,
                                       .begin = alternative->span.begin,
                                       .end = alternative->span.end,
                                       .weight = alternative->probability};
    for (const tn_pcfg_item *item = alternative->first; item; item = item->next) {
        tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){.offset = tn_builder_offset(builder),
                                                                   .file = item->span.file,
                                                                   .begin = item->span.begin,
                                                                   .end = item->span.end});
        emit_step(e, &item->step);
    }
    tn_builder_emit(builder, TN_OP_PLACED, 0, 0);
    production.code_end = tn_builder_offset(builder);
    tn_builder_add_PRODUCTION(builder, &production);
}

static void emit_symbol(emitting *e, const tn_pcfg_symbol *symbol)
{
    tn_nonterminal_record record = {.name = tn_builder_string(e->builder, symbol->name),
                                    .production_first = (uint32_t)tn_builder_count(e->builder, TN_SECTION_PRODUCTION),
                                    .production_count = symbol->count,
                                    .file = symbol->span.file,
                                    .begin = symbol->span.begin,
                                    .end = symbol->span.end};
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next)
        emit_alternative(e, a);
    tn_builder_add_NONTERMINAL(e->builder, &record);
}

/* Adds the grammar's records and code; `name` is what it is called (emit.c). */
static void pcfg_emit(const tn_pcfg_grammar *grammar, const char *name, size_t length, tn_builder *builder)
{
    emitting e = {.grammar = grammar,
                  .builder = builder,
                  .vectors = {.arena = grammar->arena},
                  .first_symbol = (uint32_t)tn_builder_count(builder, TN_SECTION_NONTERMINAL)};
    uint32_t count = 0;
    for (uint32_t s = 0; s < grammar->count; s++)
        if (grammar->symbols[s]->reached)
            grammar->symbols[s]->emitted = count++;
    for (uint32_t s = 0; s < grammar->count; s++)
        if (grammar->symbols[s]->reached)
            emit_symbol(&e, grammar->symbols[s]);
    const tn_pcfg_symbol *start = grammar->symbols[0];
    tn_builder_add_GRAMMAR(builder, &(tn_grammar_record){.name = tn_builder_string_n(builder, name, length),
                                                         .dialect = TN_DIALECT_PLACE,
                                                         .repair = TN_REPAIR_OFF,
                                                         .rule_first = e.first_symbol,
                                                         .rule_count = count,
                                                         .rewrite_rule = TN_NO_RECORD,
                                                         .predecessor = TN_NO_RECORD,
                                                         .successor = TN_NO_RECORD,
                                                         .file = start->span.file,
                                                         .begin = start->span.begin,
                                                         .end = start->span.end});
}

/* ==== compiles .pcfg texts, several of them as one grammar; and the front end that the table of notations names */

/* ---- lays out .pcfg files, which are lines of tokens */

static size_t one_blank(const tn_format *format, size_t i)
{
    (void)format, (void)i;
    return 1;
}

/* Does a blank follow the token on its line? Tokens are followed by the line's end or by the text's two zero bytes. */
static bool has_blank(const tn_format_token *token)
{
    return strchr(" \t\f\v", token->text[token->size]) && token->text[token->size];
}

/* A line a line, one blank between tokens. A probability that a blank behind it makes void gets the [0] that the
 * program reads there: without the blank it would count. */
static void format_pcfg(tn_format *format)
{
    format->gap_before = one_blank;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !format->tokens[last].line_ends;)
            last++;
        tn_format_gap(format, first, 0, false);
        tn_format_flat(format, first, last);
        const tn_format_token *end = &format->tokens[last - 1];
        if (end->kind == TN_TOKEN_NUMBER && has_blank(end))
            tn_layout_put(&format->layout, " [0]", 4);
    }
    tn_format_gap(format, format->count, 0, false);
}

static bool same_text(tn_pcfg_text one, tn_pcfg_text other)
{
    return one.length == other.length && memcmp(one.text, other.text, one.length) == 0;
}

static bool same_alternative(const tn_pcfg_alternative *one, const tn_pcfg_alternative *other)
{
    const tn_pcfg_item *a = one->first, *b = other->first;
    for (; a && b; a = a->next, b = b->next)
        if (a->kind != b->kind || !same_text(a->text, b->text))
            return false;
    return !a && !b && one->probability == other->probability;
}

static bool same_rule(const tn_pcfg_rule *one, const tn_pcfg_rule *other)
{
    const tn_pcfg_alternative *a = one->alternatives.first, *b = other->alternatives.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_alternative(a, b))
            return false;
    return !a && !b && same_text(one->name, other->name);
}

/* Do the two have the same rules in the same order, with the same probabilities? */
static bool format_pcfg_same(const tn_pcfg_reader *one, const tn_pcfg_reader *other)
{
    const tn_pcfg_rule *a = one->ast.first, *b = other->ast.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_rule(a, b))
            return false;
    return !a && !b;
}

/* Reads all sources, one after the other, into one list of rules. False if out of memory. */
static bool read_all(tn_compilation *c, tn_pcfg_file *rules)
{
    for (uint32_t file = 0; file < c->sources.count; file++) {
        tn_pcfg_reader *reader = TN_NEW(c->arena, tn_pcfg_reader);
        if (!reader)
            return false;
        *reader = (tn_pcfg_reader){.arena = c->arena, .diagnostics = &c->diagnostics, .file = file, .ast = *rules};
        if (!tn_text_check(&c->diagnostics, file))
            continue;
        tn_pcfg_read(reader, c->sources.files[file].text, c->sources.files[file].size);
        if (reader->failed)
            return false;
        *rules = reader->ast;
    }
    return true;
}

static tn_status add_sources(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_status status = TN_OK;
    uint32_t file;
    for (size_t i = 0; i < options->more_count && status == TN_OK; i++) {
        const tn_input *input = &options->more[i];
        status = tn_sources_add(&c->sources, input->name, input->text, input->size, &file, error);
    }
    return status;
}

static void check(tn_pcfg_grammar *grammar, const tn_pcfg_file *rules)
{
    tn_diagnostics *diagnostics = grammar->diagnostics;
    tn_pcfg_check(grammar, rules);
    if (!rules->first && diagnostics->error_count == 0) {
        tn_diagnostic *d =
            tn_report(diagnostics, E_PLACE_NO_RULES, (tn_span){0, 0, 0}, "there are no rules in this grammar");
        tn_help(diagnostics, d, "a rule is written: Symbol -> 'Move(0,3,0)' Other");
    } else if (diagnostics->error_count == 0 && !grammar->partial && !tn_arena_failed(grammar->arena)) {
        tn_pcfg_warn(grammar);
    }
}

static tn_status build(tn_compilation *c, const tn_pcfg_grammar *grammar, tn_error *error)
{
    const tn_imports none = {0};
    tn_builder *builder = tn_builder_new();
    size_t length;
    const char *name = tn_path_stem(c->sources.files[0].path, &length);
    if (!builder)
        return tn_fail_memory(error);
    pcfg_emit(grammar, name, length, builder);
    tn_emit_sources(builder, &none, &c->sources);
    tn_status status = tn_builder_finish(builder, &c->module, &c->module_size, error);
    tn_builder_free(builder);
    return status;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_pcfg_file rules = {0};
    tn_pcfg_grammar grammar = {.arena = c->arena, .diagnostics = diagnostics, .partial = options->partial};
    tn_status status = add_sources(c, options, error);
    if (status != TN_OK)
        return status;
    if (!read_all(c, &rules))
        return tn_fail_memory(error);
    check(&grammar, &rules);
    if (tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    bool refused = options->warnings_are_errors && diagnostics->warning_count > 0;
    if (diagnostics->error_count > 0 || refused || grammar.partial)
        return TN_INVALID;
    return build(c, &grammar, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    const tn_source *source = &diagnostics->sources->files[reading->file];
    tn_pcfg_reader *reader = TN_NEW(arena, tn_pcfg_reader);
    if (!reader)
        return false;
    *reader =
        (tn_pcfg_reader){.arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    tn_pcfg_read(reader, source->text, source->size);
    reading->tree = reader;
    return !reader->failed;
}

static bool made(const tn_module *module)
{
    return tn_module_has_places(module) && module->KIT_count == 0;
}

static bool same(const tn_reading *one, const tn_reading *other)
{
    return format_pcfg_same(one->tree, other->tree);
}

/* A rule by its symbol. */
static void list(tn_listing *listing)
{
    for (size_t first = 0, last; first < listing->count; first = last + 1) {
        last = tn_listing_line_end(listing, first, listing->count);
        if (last > first + 1 && tn_listing_is(listing, first + 1, "->"))
            tn_listing_add(listing, TN_LISTING_RULE, first, first + 1, last);
    }
}

extern const tn_front tn_front_pcfg;
const tn_front tn_front_pcfg = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = list,
    .lay_out = format_pcfg,
    .spell = tn_format_small_letters,
    .same = same,
    .joins = true,
};
