/* Compiles .hemls files; and the front end that the table of notations names. */
#include "compiler/common/emit_sources.h"
#include "compiler/common/notation.h"
#include "compiler/hemls/hemls.h"

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

static bool is_arrow(const tn_listing *listing, size_t i)
{
    return tn_listing_is(listing, i, "->") || tn_listing_is(listing, i, "\xe2\x86\x92");
}

/* A rule by what it replaces; the seed; settings. */
static void list(tn_listing *listing)
{
    for (size_t first = 0, last; first < listing->count; first = last + 1) {
        last = tn_listing_line_end(listing, first, listing->count);
        size_t arrow = first;
        while (arrow < last && !is_arrow(listing, arrow))
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
    .lay_out = tn_format_hemls,
    .spell = spell,
};
