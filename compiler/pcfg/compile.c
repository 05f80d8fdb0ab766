/* Compiles .pcfg texts, several of them as one grammar; and the front end that the table of notations names. */
#include <string.h>

#include "compiler/common/emit_sources.h"
#include "compiler/common/format_tokens.h"
#include "compiler/common/notation.h"
#include "compiler/pcfg/ast.h"
#include "compiler/pcfg/check.h"

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

/* Reads all sources, one after the other, into one list of rules. False where out of memory. */
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
    tn_pcfg_emit(grammar, name, length, builder);
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
