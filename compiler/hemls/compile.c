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

tn_hemls_symbol *tn_hemls_symbol_new(tn_growth_parse *parse, tn_hemls_kind kind, tn_span span)
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

tn_hemls_alternative *tn_hemls_alternative_new(tn_growth_parse *parse, tn_span span, tn_hemls_symbols symbols,
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

tn_hemls_line *tn_hemls_line_new(tn_growth_parse *parse, tn_hemls_line_kind kind, tn_span span)
{
    tn_hemls_line *line = TN_NEW(parse->arena, tn_hemls_line);
    if (line) {
        line->kind = kind;
        line->span = span;
    }
    return line;
}

void tn_hemls_add_line(tn_growth_parse *parse, tn_hemls_line *line)
{
    tn_hemls_file *file = parse->result;
    TN_CHAIN(file, line);
}

/* ---- what the lexers share */

bool tn_growth_readable(tn_growth_parse *parse)
{
    return tn_text_check(parse->diagnostics, parse->file);
}

void tn_growth_place(tn_growth_parse *parse, tn_span *span, size_t size)
{
    *span = (tn_span){parse->file, parse->offset, parse->offset + (uint32_t)size};
    parse->offset = span->end;
}

/* A sign, digits, a point, digits, a power of ten. The C library's reader depends on the locale; this one keeps the
 * first 17 digits, and is correctly rounded up to 15. */
tn_decimal tn_growth_number(tn_growth_parse *parse, tn_span span)
{
    double value = tn_decimal_value(parse->text + span.begin, span.end - span.begin);
    if (!(value <= TN_COORDINATE_MAX && value >= -TN_COORDINATE_MAX)) {
        tn_diagnostic *d = tn_report(parse->diagnostics, E_NUMBER_TOO_LARGE, span, "this number is too large");
        tn_help(parse->diagnostics, d, "the largest is %.0f", TN_COORDINATE_MAX);
        value = 3; /* what every setting takes: one mistake is told once */
    }
    return (tn_decimal){value, span, 0};
}

tn_decimal tn_growth_whole(tn_growth_parse *parse, tn_span span)
{
    uint64_t whole;
    bool fits = tn_whole_read(parse->text + span.begin, span.end - span.begin, &whole);
    return (tn_decimal){fits ? (double)whole : -1, span, whole};
}

void tn_growth_stray(tn_growth_parse *parse, tn_span span, const char *help)
{
    bool again = parse->stray_end > 0 && span.begin == parse->stray_end;
    parse->stray_end = span.end;
    if (again)
        return;
    const char *text = parse->text + span.begin;
    size_t size = tn_character_size(text, parse->size - span.begin);
    span.end = span.begin + (uint32_t)size;
    bool visible = (unsigned char)text[0] > ' ' && text[0] != 0x7f;
    tn_diagnostic *d =
        visible ? tn_report(parse->diagnostics, E_STRAY_CHARACTER, span, "`%.*s` means nothing here", (int)size, text)
                : tn_report(parse->diagnostics, E_STRAY_CHARACTER, span,
                            "the control character 0x%02x means nothing here", (unsigned char)text[0]);
    tn_help(parse->diagnostics, d, "%s", help);
}

/* Only blanks lie between a character that means nothing, which was reported, and this place: what is wrong here
 * follows from that. */
static bool behind_stray(const tn_growth_parse *parse, uint32_t begin)
{
    if (!parse->stray_end || parse->stray_end > begin)
        return false;
    for (uint32_t i = parse->stray_end; i < begin; i++)
        if (!isspace((unsigned char)parse->text[i]))
            return false;
    return true;
}

/* A misspelled word is a name to the parser, which then stumbles over what follows: `filll 20`. Does only white space
 * lie between such a name and this place? */
static bool behind_misspelled(const tn_growth_parse *parse, tn_span place)
{
    if (!parse->named || parse->meant || parse->name_span.end > place.begin)
        return false;
    for (uint32_t i = parse->name_span.end; i < place.begin; i++)
        if (!isspace((unsigned char)parse->text[i]))
            return false;
    return true;
}

static void report_misspelled(tn_growth_parse *parse)
{
    tn_span span = parse->name_span;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, span, "`%.*s` is not expected here",
                                 (int)(span.end - span.begin), parse->text + span.begin);
    tn_suggest(parse->diagnostics, d, "%s", parse->named);
}

void tn_growth_syntax_error(tn_growth_parse *parse, tn_span span, const char *found, const char *const *expected,
                            size_t count, const char *help)
{
    char list[400] = "", here[100], meant[100];
    if (parse->reported || behind_stray(parse, span.begin))
        return;
    if (behind_misspelled(parse, span)) {
        report_misspelled(parse);
        return;
    }
    bool named = count == 1 && strcmp(expected[0], "a name") == 0 && isalpha((unsigned char)parse->text[span.begin]);
    size_t used = 0, size = span.end > span.begin ? span.end - span.begin : 0;
    for (size_t i = 0; i < count && count <= 6 && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s",
                                 i == 0           ? ", but "
                                 : i + 1 == count ? " or "
                                                  : ", ",
                                 expected[i]);
    if (size > 0 && size <= 40 && parse->text[span.begin] != '\n' && parse->text[span.begin] != '\r')
        snprintf(here, sizeof here, "`%.*s`", (int)size, parse->text + span.begin);
    else
        snprintf(here, sizeof here, "%s", found);
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, span, "%s is not expected here%s", here, list);
    if (parse->meant) {
        snprintf(meant, sizeof meant, "did you mean `%s`?", parse->meant);
        help = meant;
    } else if (named) {
        snprintf(meant, sizeof meant, "%s is a word of the language: take another name", here);
        help = meant;
    }
    tn_help(parse->diagnostics, d, "%s", help);
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
