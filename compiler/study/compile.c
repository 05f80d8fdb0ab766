/* Compiling .hemls and .study files: a study, what it uses, and the rewrite system that it names. */
#include "compiler/common/emit_sources.h"
#include "compiler/study/study.h"

/* What importing needs to know of a file of either kind. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, void **unit, tn_use **uses,
                       size_t *use_count)
{
    *use_count = 0;
    if (tn_is_hemls(diagnostics->sources->files[file].path)) {
        *unit = tn_parse_hemls(arena, diagnostics, file, NULL);
        return *unit != NULL;
    }
    tn_study_file *study = tn_parse_study(arena, diagnostics, file, NULL);
    if (!study)
        return false;
    *unit = study;
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
        *item->use = (tn_use){item->text, item->text_span, rules ? ".hemls" : NULL, NULL};
    }
    *uses = found;
    return true;
}

/* `rules` names a .hemls file and `use` a .study file. */
static void check_kinds(tn_diagnostics *diagnostics, const tn_imports *imports)
{
    for (size_t u = 0; u < imports->count; u++) {
        const char *path = diagnostics->sources->files[imports->units[u]->file].path;
        const tn_study_file *study = imports->units[u]->tree;
        for (const tn_study_item *item = tn_is_hemls(path) ? NULL : study->first; item; item = item->next) {
            bool bare = item->text && !tn_is_hemls(item->text) && !tn_is_study(item->text);
            if (item->kind == TN_STUDY_RULES && !bare && !tn_is_hemls(item->text)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`rules` names a .hemls file");
                tn_help(diagnostics, d, "for a study write `use`");
            } else if (item->kind == TN_STUDY_USE && !bare && !tn_is_study(item->text)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`use` names a .study file");
                tn_help(diagnostics, d, "for a rewrite system write `rules`");
            }
        }
    }
}

/* The rewrite system that grows: the named file, or what its `rules` leads to. */
static const tn_unit *find_rules(const tn_imports *imports, const tn_sources *sources, const tn_checked_study *study)
{
    const tn_study_item *rules = study->settings[TN_STUDY_RULES];
    const tn_unit *named = imports->units[imports->count - 1], *found = rules && rules->use ? rules->use->unit : NULL;
    if (tn_is_hemls(sources->files[named->file].path))
        return named;
    return found && tn_is_hemls(sources->files[found->file].path) ? found : NULL;
}

static tn_status emit(tn_arena *arena, const tn_imports *imports, const tn_diagnostics *diagnostics,
                      const tn_checked_growth *growth, const tn_checked_study *study, uint8_t **bytes, size_t *size,
                      tn_error *error)
{
    tn_builder *builder = tn_builder_new();
    if (!builder)
        return tn_fail_memory(error);
    tn_emit_sources(builder, imports, diagnostics->sources);
    tn_emit_growth(builder, growth);
    if (study)
        tn_emit_study(builder, arena, diagnostics->sources, study);
    tn_status status = tn_builder_finish(builder, bytes, size, error);
    tn_builder_free(builder);
    return status;
}

tn_status tn_compile_growth(tn_arena *arena, tn_diagnostics *diagnostics, const char *const *stdlib_dirs,
                            size_t stdlib_dir_count, bool warnings_are_errors, uint8_t **bytes, size_t *size,
                            tn_error *error)
{
    tn_imports imports;
    tn_checked_study study = {0};
    tn_checked_growth *growth = NULL;
    bool has_study = tn_is_study(diagnostics->sources->files[0].path);
    tn_status status =
        tn_import_all(arena, diagnostics, stdlib_dirs, stdlib_dir_count, ".study", parse_unit, 0, &imports);
    if (status == TN_OK) {
        check_kinds(diagnostics, &imports);
        if (has_study)
            tn_check_study(arena, diagnostics, &imports, &study);
        const tn_unit *rules = find_rules(&imports, diagnostics->sources, &study);
        if (rules)
            growth = tn_check_hemls(arena, diagnostics, rules->tree, rules->file);
    }
    if (status != TN_OK || tn_arena_failed(arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (diagnostics->error_count > 0 || (warnings_are_errors && diagnostics->warning_count > 0) || !growth)
        return TN_INVALID;
    return emit(arena, &imports, diagnostics, growth, has_study ? &study : NULL, bytes, size, error);
}
