#include "compiler/compile.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/bnf/bnf.h"
#include "compiler/evolution/evolution.h"
#include "compiler/plan/emit.h"
#include "compiler/study/study.h"
#include "runtime/base/file.h"

/* What `use` needs to know of a .plan file. */
static bool parse_plan(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, void **unit, tn_use **uses,
                       size_t *use_count)
{
    tn_ast_file *tree = tn_parse_plan(arena, diagnostics, file, NULL);
    if (!tree)
        return false;
    size_t count = 0;
    for (TN_EACH(const tn_ast_top, item, tree->items))
        count += item->kind == TN_ITEM_USE;
    tn_use *found = TN_NEW_ARRAY(arena, tn_use, count);
    if (!found)
        return false;
    *unit = tree;
    *uses = found;
    *use_count = 0;
    for (TN_EACH(const tn_ast_top, item, tree->items)) {
        const tn_ast_use *use = (const tn_ast_use *)item;
        if (item->kind == TN_ITEM_USE && !use->path->broken)
            found[(*use_count)++] = (tn_use){.path = use->path->text, .span = use->path->node.span};
    }
    return true;
}

/* Everything after the named file's text is among the sources. */
static tn_status compile(const tn_compile_options *options, tn_compilation *compilation, tn_error *error)
{
    tn_imports *imports = TN_NEW(compilation->arena, tn_imports);
    tn_checked *checked = TN_NEW(compilation->arena, tn_checked);
    tn_diagnostics *diagnostics = &compilation->diagnostics;
    if (!imports || !checked)
        return tn_fail_memory(error);
    if (tn_is_bnf(compilation->sources.files[0].path))
        return tn_bnf_compile_module(options, compilation, error);
    if (tn_is_evolution(compilation->sources.files[0].path, compilation->sources.files[0].text))
        return tn_evolution_compile(options, compilation, error);
    if (tn_is_hemls(compilation->sources.files[0].path) || tn_is_study(compilation->sources.files[0].path))
        return tn_compile_growth(compilation->arena, diagnostics, options->stdlib_dirs, options->stdlib_dir_count,
                                 options->warnings_are_errors, &compilation->module, &compilation->module_size, error);
    tn_status status = tn_import_all(compilation->arena, diagnostics, options->stdlib_dirs, options->stdlib_dir_count,
                                     ".plan", parse_plan, 0, imports);
    if (status == TN_OK)
        status = tn_check_program(compilation->arena, diagnostics, imports, checked);
    if (status != TN_OK || diagnostics->failed)
        return tn_fail_memory(error);
    compilation->imports = imports;
    compilation->checked = checked;
    if (diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    status = tn_emit_module(checked, imports, diagnostics, &compilation->module, &compilation->module_size, error);
    if (status == TN_OK)
        compilation->program = checked->program;
    return status;
}

static void start(tn_compilation *compilation)
{
    *compilation = (tn_compilation){0};
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
}

/* A failure without a place of its own is reported as it is; what is wrong in the rules has been reported already. */
static tn_status finish(tn_compilation *compilation, tn_status status, const tn_error *error, const char *path)
{
    if (status != TN_OK && status != TN_INVALID)
        tn_report_error(&compilation->diagnostics, error, path, NULL, 0);
    tn_diagnostics_sort(&compilation->diagnostics);
    return status;
}

tn_status tn_compile_text(const char *path, const char *text, size_t size, const tn_compile_options *options,
                          tn_compilation *compilation)
{
    tn_error error = {0};
    uint32_t file;
    start(compilation);
    compilation->sources.overlay = options->overlay;
    compilation->sources.overlay_context = options->overlay_context;
    compilation->arena = tn_arena_new();
    tn_status status = compilation->arena ? tn_sources_add(&compilation->sources, path, text, size, &file, &error)
                                          : tn_fail_memory(&error);
    if (status == TN_OK)
        status = compile(options, compilation, &error);
    return finish(compilation, status, &error, path);
}

void tn_compilation_clear(tn_compilation *compilation)
{
    tn_diagnostics_clear(&compilation->diagnostics);
    tn_sources_clear(&compilation->sources);
    tn_arena_free(compilation->arena);
    free(compilation->module);
    *compilation = (tn_compilation){0};
}
