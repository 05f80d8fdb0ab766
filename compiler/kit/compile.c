/* Compiles .kit files and what they use; and the front end that the table of notations names. */
#include "compiler/common/emit_sources.h"
#include "compiler/common/notation.h"
#include "compiler/kit/kit.h"

static const char kit_files[] = ".kit";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    tn_kit_file *file = tn_parse_kit(arena, diagnostics, unit->file, NULL);
    size_t count = 0;
    *use_count = 0;
    if (!file)
        return false;
    unit->tree = file;
    for (const tn_kit_use *use = file->uses.first; use; use = use->next)
        count++;
    *uses = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!*uses)
        return false;
    for (tn_kit_use *use = file->uses.first; use; use = use->next) {
        if (!use->path.text || use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        (*uses)[(*use_count)++] = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, tn_kit *kit, tn_error *error)
{
    size_t length;
    const char *name = tn_path_stem(c->sources.files[0].path, &length);
    const tn_kit_file *file = imports->units[imports->count - 1]->tree;
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    return builder ? tn_compilation_finish(c, builder, tn_emit_kit(builder, kit, file, name, length, error), error)
                   : TN_MEMORY;
}

/* Conditions alone, about parts that are named. */
static tn_status compile_conditions(tn_compilation *c, const tn_questions *questions, tn_error *error)
{
    tn_kit kit = {
        .arena = c->arena, .diagnostics = &c->diagnostics, .parts.arena = c->arena, .turns = TN_UPRIGHT_TURNS};
    tn_kit_file *file = tn_parse_kit_conditions(c->arena, &c->diagnostics, 0);
    tn_unit unit = {.file = 0, .recorded = c->sources.files[0].path, .tree = file}, *units[] = {&unit};
    const tn_imports imports = {units, 1};
    for (size_t i = 0; i < questions->part_count; i++)
        if (!tn_names_get(&kit.parts, questions->parts[i]))
            tn_names_put(&kit.parts, questions->parts[i], (void *)(uintptr_t)questions->parts[i]);
    if (file && file->first)
        tn_kit_check_conditions(&kit, file->first);
    if (!file || tn_arena_failed(c->arena) || c->diagnostics.failed)
        return tn_fail_memory(error);
    if (file->damaged || !file->first || c->diagnostics.error_count > 0)
        return TN_INVALID;
    tn_builder *builder = tn_compilation_begin(c, &imports, error);
    return builder ? tn_compilation_finish(c, builder, tn_emit_kit_conditions(builder, &kit, file->first, error), error)
                   : TN_MEMORY;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_kit kit = {
        .arena = c->arena, .diagnostics = diagnostics, .attachments = &options->attachments, .turns = TN_UPRIGHT_TURNS};
    if (options->questions && options->questions->parts)
        return compile_conditions(c, options->questions, error);
    tn_status status = tn_import_all(c, options, kit_files, parse_unit, &imports);
    bool right = status == TN_OK && tn_check_kit(&kit, &imports);
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed || kit.out_of_memory)
        return tn_fail_memory(error);
    if (!right || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    return emit(c, &imports, &kit, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_kit(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->KIT_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/kit/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/kit/words.def"
};

const tn_vocabulary tn_kit_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places, false};

extern const tn_front tn_front_kit;
const tn_front tn_front_kit = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_kit_list,
    .words = &tn_kit_words,
    .lay_out = tn_format_kit,
    .spell = tn_format_small_letters,
    .nests = true,
};
