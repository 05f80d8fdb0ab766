/* The front end of .hemls files: makes the syntax tree, as the parser asks; writes a checked rewrite system as code;
 * lays files out, and compiles them. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/lexical.h"
#include "compiler/common/notation.h"
#include "compiler/hemls/hemls.h"
#include "runtime/base/bytes.h"

/* ==== the constructors of the syntax tree of rewrite systems (.hemls) */

/* ---- syntax tree */

tn_hemls_symbol *tn_hemls_symbol_new(tn_parsing *parse, tn_hemls_kind kind, tn_span span)
{
    tn_hemls_symbol *symbol = TN_NEW(parse->arena, tn_hemls_symbol);
    if (symbol) {
        symbol->kind = kind;
        symbol->span = span;
    }
    return symbol;
}

tn_hemls_symbols tn_hemls_symbols_add(tn_hemls_symbols list, tn_hemls_symbol *symbol)
{
    TN_CHAIN(&list, symbol);
    return list;
}

tn_hemls_alternative *tn_hemls_alternative_new(tn_parsing *parse, tn_span span, tn_hemls_symbols symbols,
                                               tn_hemls_choice choice)
{
    tn_hemls_alternative *one = TN_NEW(parse->arena, tn_hemls_alternative);
    if (one) {
        one->span = span;
        one->symbols = symbols;
        one->choice = choice;
    }
    return one;
}

tn_hemls_alternatives tn_hemls_alternatives_add(tn_hemls_alternatives list, tn_hemls_alternative *one)
{
    TN_CHAIN(&list, one);
    return list;
}

tn_hemls_line *tn_hemls_line_new(tn_parsing *parse, tn_hemls_line_kind kind, tn_span span)
{
    tn_hemls_line *line = TN_NEW(parse->arena, tn_hemls_line);
    if (line) {
        line->kind = kind;
        line->span = span;
    }
    return line;
}

void tn_hemls_add_line(tn_parsing *parse, tn_hemls_line *line)
{
    tn_hemls_file *file = parse->result;
    TN_CHAIN(file, line);
}

/* ==== writes a checked rewrite system as code: its seed, each successor, and a guard for each rule */

static uint32_t label_index(const tn_checked_growth *growth, uint32_t number)
{
    uint32_t index = 0;
    for (const tn_checked_label *label = growth->labels; label && label->number != number; label = label->next)
        index++;
    return index;
}

/* ---- functions */

/* One begins here, made of this stretch of the source. */
static tn_function_record begin(tn_builder *builder, tn_function_kind kind, tn_span span)
{
    uint32_t offset = tn_builder_offset(builder);
    tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){offset, span.file, span.begin, span.end});
    return (tn_function_record){.kind = kind, .code_begin = offset};
}

static uint32_t end(tn_builder *builder, tn_function_record *function, tn_opcode last)
{
    tn_builder_emit(builder, last, 0, 0);
    function->code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, function);
}

static void emit_number(tn_builder *builder, tn_opcode opcode, double number)
{
    tn_builder_emit(builder, opcode, (int64_t)tn_bits_of(number), 0);
}

static uint32_t emit_seed(tn_builder *builder, const tn_checked_growth *growth)
{
    tn_function_record function = begin(builder, TN_FUNCTION_SEED, growth->axiom_span);
    for (uint32_t i = 0; i < growth->axiom_count; i++) {
        if (growth->axiom_reversed[i])
            tn_builder_emit(builder, TN_OP_FLIP, 0, 0);
        tn_builder_emit(builder, TN_OP_DRAW, label_index(growth, growth->axiom[i]), TN_AGE_ZERO);
    }
    return end(builder, &function, TN_OP_LAND);
}

/* Two `~` on end are none. Turns are not put together: two by 60 degrees end in other last digits than one by 120. */
static uint32_t emit_successor(tn_builder *builder, const tn_checked_growth *growth,
                               const tn_checked_successor *successor)
{
    tn_function_record function = begin(builder, TN_FUNCTION_SUCCESSOR, successor->span);
    function.stack_max = successor->depth;
    for (const tn_hemls_symbol *s = successor->symbols->first; s; s = s->next) {
        if (s->kind == TN_HEMLS_TILDE && s->next && s->next->kind == TN_HEMLS_TILDE) {
            s = s->next;
            continue;
        }
        tn_instruction move = tn_hemls_move(s, growth->angle);
        if (move.opcode == TN_OP_DRAW)
            move.first = label_index(growth, s->number);
        tn_builder_emit(builder, move.opcode, move.first, move.second);
    }
    return end(builder, &function, TN_OP_LAND);
}

/* ---- guards */

static double total_weight(const tn_checked_rewrite *rule)
{
    double total = 0;
    for (const tn_checked_alternative *a = rule->alternatives; a; a = a->next)
        total += a->choice.value;
    return total;
}

static void emit_test(tn_builder *builder, const tn_checked_rewrite *rule, const tn_checked_alternative *a)
{
    static const tn_opcode ages[TN_COMPARISON_COUNT] = {
        [TN_AGE_BELOW] = TN_OP_YOUNGER, [TN_AGE_ABOVE] = TN_OP_OLDER, [TN_AGE_EQUALS] = TN_OP_AGED};
    if (a->choice.comparison != TN_ALWAYS)
        emit_number(builder, ages[a->choice.comparison], a->choice.value);
    else if (tn_rewrite_by_chance(rule) && a->next) /* the last takes what is left */
        emit_number(builder, TN_OP_WEIGHT, a->choice.value);
}

/* Whether an alternative can be taken: where ages decide, those behind one without a condition never are. */
static bool is_last(const tn_checked_rewrite *rule, const tn_checked_alternative *a)
{
    return !a->next || (!tn_rewrite_by_chance(rule) && a->choice.comparison == TN_ALWAYS);
}

static uint32_t emit_guard(tn_builder *builder, const tn_checked_growth *growth, tn_checked_rewrite *rule)
{
    for (tn_checked_alternative *a = rule->alternatives; a; a = is_last(rule, a) ? NULL : a->next)
        a->function = emit_successor(builder, growth, &a->successor);
    tn_function_record function = begin(builder, TN_FUNCTION_GUARD, rule->span);
    for (uint32_t i = 0; i < rule->number_count; i++)
        tn_builder_emit(builder, TN_OP_LABEL, label_index(growth, rule->numbers[i]), 0);
    if (rule->left != TN_NO_LABEL)
        tn_builder_emit(builder, TN_OP_BEHIND, label_index(growth, rule->left), 0);
    if (rule->right != TN_NO_LABEL)
        tn_builder_emit(builder, TN_OP_AHEAD, label_index(growth, rule->right), 0);
    if (tn_rewrite_by_chance(rule))
        emit_number(builder, TN_OP_CHANCE, total_weight(rule));
    for (const tn_checked_alternative *a = rule->alternatives; a; a = is_last(rule, a) ? NULL : a->next) {
        emit_test(builder, rule, a);
        tn_builder_emit(builder, TN_OP_REPLACE, a->function, 0);
    }
    return end(builder, &function, TN_OP_PASS);
}

static void emit_group(tn_builder *builder, const tn_checked_growth *growth, const tn_checked_group *group)
{
    uint32_t first = (uint32_t)tn_builder_count(builder, TN_SECTION_REWRITE_RULE);
    for (tn_checked_rewrite *rule = group->rules; rule; rule = rule->next_in_group) {
        tn_rewrite_rule_record record = {emit_guard(builder, growth, rule), rule->span.file, rule->span.begin,
                                         rule->span.end};
        tn_builder_add_REWRITE_RULE(builder, &record);
    }
    tn_builder_add_REWRITE_GROUP(builder, &(tn_rewrite_group_record){first, group->rule_count});
}

void tn_emit_growth(tn_builder *builder, const tn_checked_growth *growth)
{
    for (const tn_checked_label *label = growth->labels; label; label = label->next)
        tn_builder_add_EDGE_LABEL(builder,
                                  &(tn_edge_label_record){tn_builder_string(builder, label->name), label->number});
    tn_growth_record record = {.name = tn_builder_string(builder, growth->name),
                               .branch_angle = growth->branch_angle,
                               .flags = (growth->sync ? TN_GROWTH_SYNC : 0) | (growth->even ? TN_GROWTH_EVEN : 0),
                               .seed = emit_seed(builder, growth),
                               .file = growth->span.file,
                               .begin = growth->span.begin,
                               .end = growth->span.end};
    tn_builder_add_GROWTH(builder, &record);
    for (const tn_checked_group *group = growth->groups; group; group = group->next)
        emit_group(builder, growth, group);
}

/* ==== laying out .hemls files: a line a line; the successors of a rule one below the other, their arrows lined up */

static size_t gap_before(const tn_format *format, size_t i)
{
    bool negative = format->tokens[i].kind == TN_TOKEN_NUMBER && tn_format_is(format, i - 1, "-");
    return negative ? 0 : 1;
}

static bool is_arrow(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "->") || tn_format_is(format, i, "\xe2\x86\x92");
}

static void put_line(tn_format *format, size_t first, size_t last)
{
    tn_layout *layout = &format->layout;
    size_t arrow = 0; /* column of the first; none is at 0 */
    for (size_t i = first; i < last; i++) {
        if (is_arrow(format, i) && arrow)
            tn_layout_line(layout, arrow);
        tn_format_put(format, i, i > first ? gap_before(format, i) : 0);
        if (is_arrow(format, i) && !arrow)
            arrow = layout->column - format->tokens[i].width;
    }
}

/* Lays out a .hemls file. */
static void format_hemls(tn_format *format)
{
    format->gap_before = gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !format->tokens[last].line_ends;)
            last++;
        tn_format_gap(format, first, 0, false);
        put_line(format, first, last);
    }
    tn_format_gap(format, format->count, 0, false);
}

/* ==== compiles .hemls files; and the front end that the table of notations names */

/* A rewrite system uses nothing. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    *uses = NULL;
    *use_count = 0;
    unit->tree = tn_parse_hemls(arena, diagnostics, unit->file, NULL);
    return unit->tree != NULL;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_growth *growth = NULL;
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, c->notation->extension, parse_unit, &imports);
    if (status == TN_OK)
        growth = tn_check_hemls(c->arena, diagnostics, imports.units[0]->tree, imports.units[0]->file);
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0) || !growth)
        return TN_INVALID;
    tn_builder *builder = tn_compilation_begin(c, &imports, error);
    if (!builder)
        return TN_MEMORY;
    tn_emit_growth(builder, growth);
    return tn_compilation_finish(c, builder, TN_OK, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_hemls(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->GROWTH_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/hemls/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/hemls/words.def"
};

const tn_vocabulary tn_hemls_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      false};

static const char *spell(tn_arena *arena, const char *text, size_t size)
{
    const tn_vocabulary_word *word = tn_vocabulary_find(&tn_hemls_words, text, size, TN_ANYWHERE, TN_AS_KEYWORDS);
    return word ? word->text : tn_arena_copy(arena, text, size);
}

/* ---- for editors */

static bool lists_arrow(const tn_listing *listing, size_t i)
{
    return tn_listing_is(listing, i, "->") || tn_listing_is(listing, i, "\xe2\x86\x92");
}

/* A rule by what it replaces; the seed; settings. */
static void list(tn_listing *listing)
{
    for (size_t first = 0, last; first < listing->count; first = last + 1) {
        last = tn_listing_line_end(listing, first, listing->count);
        size_t arrow = first;
        while (arrow < last && !lists_arrow(listing, arrow))
            arrow++;
        if (first == last)
            continue;
        if (arrow > first && arrow < last)
            tn_listing_add(listing, TN_LISTING_RULE, first, arrow, last);
        else if (listing->tokens[first].kind == TN_TOKEN_WORD)
            tn_listing_add(listing, TN_LISTING_SETTING, first, first + 1, last);
        else
            tn_listing_add(listing, TN_LISTING_CONSTANT, first, last, last);
    }
}

extern const tn_front tn_front_hemls;
const tn_front tn_front_hemls = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = list,
    .words = &tn_hemls_words,
    .lay_out = format_hemls,
    .spell = spell,
};
