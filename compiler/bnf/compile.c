/* Compiles .bnf texts to modules of their own; and the front end that the table of notations names. */
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/bnf/bnf.h"
#include "compiler/bnf/format.h"
#include "compiler/common/lexical.h"
#include "compiler/common/notation.h"

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
