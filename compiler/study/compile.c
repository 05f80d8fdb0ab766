/* Compiles .study files about growth: a study, what it uses, and the rewrite system that it names; and the front end
 * that the table of notations names. */
#include <string.h>

#include "compiler/common/emit_sources.h"
#include "compiler/common/notation.h"
#include "compiler/study/study.h"

static const char study_files[] = ".study", rule_files[] = ".hemls";

static bool ends_in(const char *path, const char *extension)
{
    return strcmp(tn_path_extension(path), extension) == 0;
}

static bool is_rules(const tn_unit *unit)
{
    return strcmp(unit->extension, rule_files) == 0;
}

/* What importing needs to know of a file of either kind. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    *use_count = 0;
    if (is_rules(unit)) {
        unit->tree = tn_parse_hemls(arena, diagnostics, unit->file, NULL);
        return unit->tree != NULL;
    }
    tn_study_file *study = tn_parse_study(arena, diagnostics, unit->file, NULL);
    if (!study)
        return false;
    unit->tree = study;
    size_t count = 0;
    for (const tn_study_item *item = study->first; item; item = item->next)
        count += item->kind == TN_STUDY_USE || item->kind == TN_STUDY_RULES;
    tn_use *found = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!found)
        return false;
    for (tn_study_item *item = study->first; item; item = item->next) {
        bool rules = item->kind == TN_STUDY_RULES;
        if ((!rules && item->kind != TN_STUDY_USE) || !item->text)
            continue;
        if (item->text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, item->text_span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        item->use = &found[(*use_count)++];
        *item->use = (tn_use){item->text, item->text_span, rules ? rule_files : NULL, NULL};
    }
    *uses = found;
    return true;
}

/* `rules` names a .hemls file and `use` a .study file. */
static void check_kinds(tn_diagnostics *diagnostics, const tn_imports *imports)
{
    for (size_t u = 0; u < imports->count; u++) {
        const tn_study_file *study = imports->units[u]->tree;
        for (const tn_study_item *item = is_rules(imports->units[u]) ? NULL : study->first; item; item = item->next) {
            if (item->kind == TN_STUDY_RULES && item->text && ends_in(item->text, study_files)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`rules` names a .hemls file");
                tn_help(diagnostics, d, "for a study write `use`");
            } else if (item->kind == TN_STUDY_USE && item->text && ends_in(item->text, rule_files)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`use` names a .study file");
                tn_help(diagnostics, d, "for a rewrite system write `rules`");
            }
        }
    }
}

/* The rewrite system that grows: what the study's `rules` leads to. */
static const tn_unit *find_rules(const tn_checked_study *study)
{
    const tn_study_item *rules = study->settings[TN_STUDY_RULES];
    const tn_unit *found = rules && rules->use ? rules->use->unit : NULL;
    return found && is_rules(found) ? found : NULL;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, const tn_checked_growth *growth,
                      const tn_checked_study *study, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    if (!builder)
        return TN_MEMORY;
    tn_emit_growth(builder, growth);
    return tn_compilation_finish(c, builder, tn_emit_study(builder, c->arena, &c->sources, study, error), error);
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_study study = {0};
    tn_checked_growth *growth = NULL;
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, study_files, parse_unit, &imports);
    if (status == TN_OK) {
        check_kinds(diagnostics, &imports);
        tn_check_study(c->arena, diagnostics, &imports, &study);
        const tn_unit *rules = find_rules(&study);
        if (rules)
            growth = tn_check_hemls(c->arena, diagnostics, rules->tree, rules->file);
    }
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0) || !growth)
        return TN_INVALID;
    return emit(c, &imports, growth, &study, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_study(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->GROWTH_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/study/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/study/words.def"
};

const tn_vocabulary tn_study_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      .heads_begin = true};

extern const tn_front tn_front_study;
const tn_front tn_front_study = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_study_list,
    .words = &tn_study_words,
    .lay_out = tn_format_study,
    .spell = tn_format_small_letters,
};
