/* Writes checked grammars (.bnf) into modules; and the front end that the table of notations names. */
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/bnf/ast.h"
#include "compiler/bnf/bnf.h"
#include "compiler/common/import.h"
#include "compiler/common/lexical.h"
#include "compiler/common/notation.h"

/* ==== writes a checked grammar (.bnf) into a module */

bool tn_bnf_collect_rules(tn_bnf_grammar *g)
{
    tn_bnf_reader *reader = g->reader;
    g->rule_count = reader->ast.rule_count;
    g->rules = TN_NEW_ARRAY(reader->arena, tn_bnf_rule *, g->rule_count + 1);
    if (!g->rules)
        return false;
    size_t count = 0;
    for (tn_bnf_rule *rule = reader->ast.first; rule; rule = rule->next)
        g->rules[count++] = rule;
    return true;
}

static void check_sizes(tn_bnf_grammar *g)
{
    for (size_t r = 0; r < g->rule_count; r++)
        if (g->rules[r]->name.length > TN_NAME_MAX)
            tn_report(g->reader->diagnostics, E_NAME_TOO_LONG, g->rules[r]->name_span,
                      "a name of %zu bytes; the limit is %u", g->rules[r]->name.length, TN_NAME_MAX);
    if (g->production_count > TN_BNF_PRODUCTIONS_MAX)
        tn_report(g->reader->diagnostics, E_GRAMMAR_TOO_LARGE, g->rules[0]->name_span,
                  "the grammar has %zu alternatives, more than %u, the limit", g->production_count,
                  TN_BNF_PRODUCTIONS_MAX);
}

/* ---- code */

static uint32_t length_of(tn_opcode opcode)
{
    return tn_opcode_describe((uint8_t)opcode)->length;
}

static uint32_t code_length(tn_bnf_items items)
{
    uint32_t length = 0;
    for (const tn_bnf_item *item = items.first; item; item = item->next)
        length += length_of(item->kind == TN_BNF_EDGE ? TN_OP_EDGE : TN_OP_EMIT) + code_length(item->body);
    return length;
}

static void emit_items(tn_builder *builder, tn_bnf_items items, uint32_t first_rule)
{
    for (const tn_bnf_item *item = items.first; item; item = item->next) {
        switch (item->kind) {
        case TN_BNF_NAME:
            tn_builder_emit(builder, TN_OP_EXPAND, first_rule + item->rule, 0);
            break;
        case TN_BNF_EDGE:
            tn_builder_emit(builder, TN_OP_EDGE, 0, 0);
            break;
        case TN_BNF_EDGE_SAME:
            tn_builder_emit(builder, TN_OP_EDGE_SAME, item->letter, 0);
            break;
        case TN_BNF_REPEAT:
        case TN_BNF_MAYBE:
            tn_builder_emit(builder, item->kind == TN_BNF_REPEAT ? TN_OP_REPEAT : TN_OP_MAYBE, code_length(item->body),
                            0);
            emit_items(builder, item->body, first_rule);
            break;
        default:
            tn_builder_emit(builder, TN_OP_EMIT, tn_builder_string_n(builder, item->text.text, item->text.length), 0);
            break;
        }
    }
}

static void emit_rule(tn_builder *builder, const tn_bnf_rule *rule, uint32_t first_rule)
{
    tn_nonterminal_record record = {.name = tn_builder_string_n(builder, rule->name.text, rule->name.length),
                                    .production_first = (uint32_t)tn_builder_count(builder, TN_SECTION_PRODUCTION),
                                    .production_count = (uint32_t)rule->alternatives.count,
                                    .file = rule->name_span.file,
                                    .begin = rule->name_span.begin,
                                    .end = rule->name_span.end};
    for (const tn_bnf_alternative *a = rule->alternatives.first; a; a = a->next) {
        tn_production_record production = {
            .code_begin = tn_builder_offset(builder), .file = a->span.file, .begin = a->span.begin, .end = a->span.end};
        tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){.offset = production.code_begin,
                                                                   .file = a->span.file,
                                                                   .begin = a->span.begin,
                                                                   .end = a->span.end});
        emit_items(builder, a->items, first_rule);
        tn_builder_emit(builder, TN_OP_DONE, 0, 0);
        production.code_end = tn_builder_offset(builder);
        tn_builder_add_PRODUCTION(builder, &production);
    }
    tn_builder_add_NONTERMINAL(builder, &record);
}

static uint32_t named(const tn_bnf_grammar *g, const char *name, uint32_t first_rule)
{
    uint32_t rule =
        g->reader->ast.dialect == TN_DIALECT_GENR8 ? tn_bnf_find(g, (tn_bnf_text){name, strlen(name)}) : TN_BNF_NONE;
    return rule == TN_BNF_NONE ? TN_NO_RECORD : first_rule + rule;
}

/* Limits of depth and wraps where the file says none: what the paper's mapper and common practice have. */
enum { GENR8_MAX_DEPTH = 10, GENR8_WRAPS = 2, GE_MAX_DEPTH = 0, GE_WRAPS = 0 };

static void emit(const tn_bnf_grammar *g, const tn_source *source, tn_builder *builder)
{
    const tn_bnf_file *ast = &g->reader->ast;
    bool genr8 = ast->dialect == TN_DIALECT_GENR8;
    uint32_t first_rule = (uint32_t)tn_builder_count(builder, TN_SECTION_NONTERMINAL);
    for (size_t r = 0; r < g->rule_count; r++)
        emit_rule(builder, g->rules[r], first_rule);
    size_t length;
    const char *name = tn_path_stem(source->path, &length);
    tn_grammar_record record = {
        .name = tn_builder_string_n(builder, name, length),
        .dialect = ast->dialect,
        .flags = (ast->skip_single ? TN_SKIP_SINGLE : 0) | (ast->position_independent ? TN_POSITION_INDEPENDENT : 0),
        .repair = genr8 ? ast->repair : TN_REPAIR_OFF,
        .max_depth = ast->says_max_depth ? ast->max_depth
                     : genr8             ? GENR8_MAX_DEPTH
                                         : GE_MAX_DEPTH,
        .wraps = ast->says_wraps ? ast->wraps
                 : genr8         ? GENR8_WRAPS
                                 : GE_WRAPS,
        .rule_first = first_rule,
        .rule_count = (uint32_t)g->rule_count,
        .rewrite_rule = named(g, "<RewriteRule>", first_rule),
        .predecessor = named(g, "<Predecessor>", first_rule),
        .successor = named(g, "<Successor>", first_rule),
        .file = g->reader->file,
        .begin = g->rules[0]->name_span.begin,
        .end = g->rules[g->rule_count - 1]->span.end,
    };
    tn_builder_add_GRAMMAR(builder, &record);
}

bool tn_bnf_asks_data(const char *text, size_t size)
{
    static const char word[] = "GE_RANGE:dataset_n_";
    return memmem(text, size, word, sizeof word - 1) != NULL;
}

tn_status tn_bnf_compile(tn_sources *sources, uint32_t file, const tn_bnf_study *study, tn_diagnostics *diagnostics,
                         tn_arena *arena, tn_builder *builder, tn_error *error)
{
    tn_source *source = &sources->files[file];
    size_t errors_before = diagnostics->error_count;
    tn_bnf_reader reader = {.arena = arena, .diagnostics = diagnostics, .file = file};
    tn_bnf_grammar g = {.reader = &reader};
    if (study)
        memcpy(reader.ast.data, study->data, sizeof reader.ast.data);
    const char *zero = memchr(source->text, '\0', source->size);
    if (zero) {
        uint32_t at = (uint32_t)(zero - source->text);
        tn_report(diagnostics, E_STRAY_CHARACTER, (tn_span){file, at, at + 1}, "a grammar cannot hold the character 0");
        return tn_fail(error, TN_INVALID, E_STRAY_CHARACTER, "the grammar has errors");
    }
    tn_bnf_read(&reader, source->text, source->size);
    if (study && study->says_mapping) {
        reader.ast.position_independent = study->position_independent;
        reader.ast.mapping_span = study->mapping_span;
    }
    if (!tn_bnf_collect_rules(&g))
        return tn_fail_memory(error);
    if (g.rule_count == 0 && !reader.failed) {
        tn_diagnostic *diagnostic =
            tn_report(diagnostics, E_GRAMMAR_NO_RULES, (tn_span){file, 0, 0}, "there are no rules in this grammar");
        tn_help(diagnostics, diagnostic, "a rule is written `<name> ::= one | other`");
    } else if (!reader.failed) {
        tn_bnf_make_terminals(&g);
        tn_bnf_check(&g);
        check_sizes(&g);
    }
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    if (reader.failed || diagnostics->error_count > errors_before)
        return tn_fail(error, TN_INVALID, E_GRAMMAR_SYNTAX, "the grammar has errors");
    emit(&g, source, builder);
    return TN_OK;
}

/* ==== compiles .bnf texts to modules of their own; and the front end that the table of notations names */

static tn_status build(tn_compilation *c, uint32_t file, tn_builder *builder, tn_error *error)
{
    const tn_source *source = &c->sources.files[file];
    tn_status status = tn_bnf_compile(&c->sources, file, NULL, &c->diagnostics, c->arena, builder, error);
    if (status != TN_OK)
        return status;
    tn_builder_add_SOURCE(builder,
                          &(tn_source_record){.path = tn_builder_string(builder, source->path),
                                              .text = tn_builder_string_n(builder, source->text, source->size)});
    tn_builder_add_PRODUCER(builder,
                            &(tn_producer_record){.version = tn_builder_string(builder, "tartan " TARTAN_VERSION),
                                                  .sources_hash = (int64_t)XXH3_64bits(source->text, source->size)});
    return tn_builder_finish(builder, &c->module, &c->module_size, error);
}

static tn_status compile(tn_compilation *compilation, const tn_compile_options *options, tn_error *error)
{
    if (!tn_text_check(&compilation->diagnostics, 0))
        return TN_INVALID;
    tn_builder *builder = tn_builder_new();
    tn_status status = builder ? build(compilation, 0, builder, error) : tn_fail_memory(error);
    tn_builder_free(builder);
    if (status == TN_OK && options->warnings_are_errors && compilation->diagnostics.warning_count > 0) {
        free(compilation->module);
        compilation->module = NULL;
        return TN_INVALID;
    }
    return status;
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    const tn_source *source = &diagnostics->sources->files[reading->file];
    size_t errors = diagnostics->error_count;
    tn_bnf_reader *reader = TN_NEW(arena, tn_bnf_reader);
    if (!reader)
        return false;
    *reader =
        (tn_bnf_reader){.arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    tn_bnf_read(reader, source->text, source->size);
    reading->tree = reader;
    return !reader->failed || diagnostics->error_count > errors;
}

static bool made(const tn_module *module)
{
    return tn_module_has_grammar(module);
}

static bool same(const tn_reading *one, const tn_reading *other)
{
    return tn_format_bnf_same(one->tree, other->tree);
}

/* Rules and directives. */
static void list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        bool rule = listing->tokens[i].kind == TN_TOKEN_NAME;
        for (end = i + 1; rule && end < listing->count && listing->tokens[end].kind != TN_TOKEN_NAME;)
            end++;
        if (!rule && listing->tokens[i].kind != TN_TOKEN_WORD)
            continue;
        tn_listing_entry *entry = tn_listing_add(listing, rule ? TN_LISTING_RULE : TN_LISTING_SETTING, i, i + 1, i + 1);
        size_t last = end; /* blank texts and line ends before the next rule are not this one's */
        while (last > i + 1 && listing->tokens[last - 1].kind == TN_TOKEN_LINE)
            last--;
        entry->whole = tn_listing_span(listing, i, last);
    }
}

extern const tn_front tn_front_bnf;
const tn_front tn_front_bnf = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = list,
    .lay_out = tn_format_bnf,
    .spell = tn_format_bnf_directive,
    .nests = true,
    .trim = tn_format_bnf_trim,
    .same = same,
};
