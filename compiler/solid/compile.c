/* Compiles .solid files and what they use; and the front end that the table of notations names. */
#include "compiler/common/emit_sources.h"
#include "compiler/common/notation.h"
#include "compiler/solid/solid.h"

static const char solid_files[] = ".solid";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    tn_tokens tokens = {.arena = arena};
    tn_solid_file *file = tn_parse_solid(arena, diagnostics, unit->file, &tokens);
    size_t count = 0;
    *use_count = 0;
    if (!file)
        return false;
    tn_solid_name_measures(arena, &diagnostics->sources->files[unit->file], &tokens, file);
    unit->tree = file;
    for (const tn_solid_use *use = file->uses.first; use; use = use->next)
        count++;
    *uses = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!*uses)
        return false;
    for (tn_solid_use *use = file->uses.first; use; use = use->next) {
        if (!use->path.text || use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        use->use = &(*uses)[(*use_count)++];
        *use->use = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, const tn_checked_solids *solids, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    return builder ? tn_compilation_finish(c, builder, tn_emit_solids(builder, &c->sources, solids, error), error)
                   : TN_MEMORY;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_solids solids = {0};
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, solid_files, parse_unit, &imports);
    bool right = status == TN_OK && tn_check_solids(c->arena, diagnostics, &imports, &solids);
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (!right || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    return emit(c, &imports, &solids, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_solid(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->SOLID_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/solid/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/solid/words.def"
};

const tn_vocabulary tn_solid_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      false};

extern const tn_front tn_front_solid;
const tn_front tn_front_solid = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_solid_list,
    .words = &tn_solid_words,
    .lay_out = tn_format_solid,
    .spell = tn_format_small_letters,
    .nests = true,
};
