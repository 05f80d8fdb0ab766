/* Compiles .plan files; and the front end that the table of notations names. */
#include "compiler/common/notation.h"
#include "compiler/plan/ask.h"
#include "compiler/plan/emit/emit.h"
#include "compiler/plan/format_clauses.h"
#include "compiler/plan/rows.h"
#include "compiler/plan/settings.h"
#include "compiler/plan/syntax/parse.h"
#include "compiler/plan/syntax/words.h"

/* What `use` needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    tn_ast_file *tree = tn_parse_plan(arena, diagnostics, unit->file, NULL);
    if (!tree)
        return false;
    size_t count = 0;
    for (TN_EACH(const tn_ast_top, item, tree->items))
        count += item->kind == TN_ITEM_USE;
    tn_use *found = TN_NEW_ARRAY(arena, tn_use, count);
    if (!found)
        return false;
    unit->tree = tree;
    *uses = found;
    *use_count = 0;
    for (TN_EACH(const tn_ast_top, item, tree->items)) {
        const tn_ast_use *use = (const tn_ast_use *)item;
        if (item->kind == TN_ITEM_USE && !use->path->broken)
            found[(*use_count)++] = (tn_use){.path = use->path->text, .span = use->path->node.span};
    }
    return true;
}

static tn_status compile(tn_compilation *compilation, const tn_compile_options *options, tn_error *error)
{
    tn_diagnostics *diagnostics = &compilation->diagnostics;
    tn_imports *imports = TN_NEW(compilation->arena, tn_imports);
    tn_checked *checked = TN_NEW(compilation->arena, tn_checked);
    if (!imports || !checked)
        return tn_fail_memory(error);
    tn_status status = tn_import_all(compilation, options, compilation->notation->extension, parse_unit, imports);
    tn_asked_for asked = {0};
    if (status == TN_OK)
        status = tn_settings_read(compilation, options, imports, &asked.settings, error);
    if (status == TN_OK && options->change)
        options->change(options->change_context, compilation->arena, imports);
    if (status == TN_OK)
        tn_settings_of_test(imports, options->test);
    if (status == TN_OK)
        status = tn_rows_count(compilation, options, imports, compile, error);
    if (status == TN_OK && options->questions)
        status = tn_ask(compilation->arena, diagnostics, &compilation->sources, options->questions, &asked, error);
    if (status == TN_OK)
        status = tn_check_program(compilation->arena, diagnostics, imports, &asked, checked);
    if (status == TN_STOPPED)
        return status;
    if (status != TN_OK || diagnostics->failed)
        return tn_fail_memory(error);
    compilation->imports = imports;
    compilation->checked = checked;
    if (diagnostics->error_count > 0 || checked->uncounted ||
        (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    status = tn_emit_module(compilation->arena, checked, imports, diagnostics, &compilation->module,
                            &compilation->module_size, error);
    if (status == TN_OK)
        compilation->program = checked->program;
    return status;
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_plan(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->SCHEMA_count + module->RULE_count + module->LIBRARY_count + module->FORM_count > 0;
}

static bool rename_clauses(tn_arena *arena, const tn_source *source, const tn_reading *from, const tn_format *format,
                           tn_format_token *tokens)
{
    return tn_format_clause_names(arena, source, from->tree, format, tokens);
}

extern const tn_front tn_front_plan;
const tn_front tn_front_plan = {
    .read = read,
    .compile = compile,
    .words = &tn_plan_words,
    .made = made,
    .settable = true,
    .lay_out = tn_format_plan,
    .spell = tn_format_small_letters,
    .renew = tn_format_newer_words,
    .nests = true,
    .rename = rename_clauses,
};
