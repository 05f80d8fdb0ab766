/* Compiles .field files; and the front end that the table of notations names. */
#include <string.h>

#include "compiler/common/emit_sources.h"
#include "compiler/common/notation.h"
#include "compiler/field/field.h"

static const char field_files[] = ".field";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    *use_count = 0;
    tn_field_file *file = tn_parse_field(arena, diagnostics, unit->file, NULL);
    if (!file)
        return false;
    unit->tree = file;
    *uses = TN_NEW_ARRAY(arena, tn_use, file->use_count + 1);
    if (!*uses)
        return false;
    for (const tn_field_use *use = file->uses.first; use; use = use->next) {
        if (use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        (*uses)[(*use_count)++] = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_compile_options *options, const tn_imports *imports,
                      const tn_checked_fields *checked, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    if (!builder)
        return TN_MEMORY;
    tn_status status = tn_emit_field(builder, c->arena, &c->diagnostics, checked, error);
    if (status == TN_OK && options->warnings_are_errors && c->diagnostics.warning_count > 0)
        status = TN_INVALID;
    return tn_compilation_finish(c, builder, status, error);
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_fields *checked = TN_NEW(c->arena, tn_checked_fields);
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, field_files, parse_unit, &imports);
    if (status != TN_OK)
        return status;
    bool damaged = false;
    for (size_t u = 0; u < imports.count; u++) {
        const tn_field_file *file = imports.units[u]->tree;
        damaged = damaged || !file || file->damaged;
    }
    if (!damaged && (!checked || !tn_check_field(c->arena, diagnostics, &imports, &options->resolver, checked)))
        return tn_fail_memory(error);
    if (tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (damaged || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    c->fields = checked;
    return emit(c, options, &imports, checked, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_field(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

/* A library of functions leaves nothing but its name. */
static bool made(const tn_module *module)
{
    const char *path = module->SOURCE_count ? tn_text(module, module->SOURCE_records[0].path) : "";
    return module->SURFACE_count > 0 || strcmp(tn_path_extension(path), field_files) == 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/field/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/field/words.def"
};

const tn_vocabulary tn_field_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      .heads_begin = true};

bool tn_field_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_field_words, text, size, TN_FIELD_AT(STATEMENT), TN_AS_KEYWORDS) != NULL;
}

extern const tn_front tn_front_field;
const tn_front tn_front_field = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_field_list,
    .words = &tn_field_words,
    .lay_out = tn_format_field,
    .spell = tn_format_small_letters,
    .nests = true,
};
