/* Puts the values that params are given into the syntax trees. */
#include "compiler/plan/settings.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/parse.h"

static const tn_ast_file *tree_of(const tn_imports *imports, size_t unit)
{
    return imports->units[unit]->tree;
}

/* The item of that name, or NULL; files that others use come first. */
static tn_ast_rule *param_named(const tn_imports *imports, const char *name)
{
    for (size_t u = 0; u < imports->count; u++)
        for (TN_EACH(tn_ast_top, item, tree_of(imports, u)->items))
            if (item->kind == TN_ITEM_PARAM && strcmp(((tn_ast_rule *)item)->name->text, name) == 0)
                return (tn_ast_rule *)item;
    return NULL;
}

static void give(const tn_imports *imports, tn_ast_rule *param, const tn_ast_setting *setting)
{
    param->given = setting->value;
    param->given_unit = imports->count - 1;
}

void tn_settings_of_test(const tn_imports *imports, size_t test)
{
    size_t number = 0;
    if (test == 0)
        return;
    for (TN_EACH(const tn_ast_top, item, tree_of(imports, imports->count - 1)->items)) {
        if (item->kind != TN_ITEM_TEST || ++number != test)
            continue;
        for (TN_EACH(const tn_ast_setting, setting, ((const tn_ast_test *)item)->settings)) {
            tn_ast_rule *param = param_named(imports, setting->name->text);
            if (param)
                give(imports, param, setting);
        }
    }
}

/* ---- what the command line gives */

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static tn_status read_setting(tn_compilation *compilation, const char *text, tn_ast_setting **setting, tn_error *error)
{
    uint32_t file;
    tn_status status = tn_sources_add(&compilation->sources, TN_SETTING_SOURCE, text, strlen(text), &file, error);
    if (status != TN_OK)
        return status;
    const tn_ast_file *tree = tn_parse_plan_part(compilation->arena, &compilation->diagnostics, file, TN_PARSE_SETTING);
    *setting = tree && !tree->broken ? tree->setting : NULL;
    return tree ? TN_OK : tn_fail_memory(error);
}

tn_status tn_settings_read(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                           tn_ast_list *settings, tn_error *error)
{
    size_t count = options->params.count;
    const char **texts = TN_NEW_ARRAY(compilation->arena, const char *, count);
    if (!texts)
        return tn_fail_memory(error);
    if (count)
        memcpy(texts, options->params.items, count * sizeof *texts);
    qsort(texts, count, sizeof *texts, by_text);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_ast_setting *setting = NULL;
        status = read_setting(compilation, texts[i], &setting, error);
        tn_ast_rule *param = setting ? param_named(imports, setting->name->text) : NULL;
        *settings = tn_ast_append(*settings, setting);
        if (param)
            give(imports, param, setting);
    }
    return status;
}
