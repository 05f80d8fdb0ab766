/* Opens a file once more, from the texts that were opened before. */
#include "driver/open/again.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/common/import.h"

/* What is changed, and who finds the texts. */
typedef struct changing {
    tn_change_tree *change;
    void *context;
} changing;

static void change_trees(void *context, tn_arena *arena, const struct tn_imports *imports)
{
    const changing *c = context;
    for (size_t i = 0; i < imports->count; i++)
        c->change(c->context, arena, imports->units[i]->tree, i + 1 == imports->count);
}

static const tn_unit *unit_named(const tn_compilation *compilation, const char *name)
{
    for (size_t i = 0; i < compilation->imports->count; i++) {
        const tn_unit *unit = compilation->imports->units[i];
        if (strcmp(compilation->sources.files[unit->file].path, name) == 0)
            return unit;
    }
    return NULL;
}

static tn_input input_of(const tn_compilation *compilation, const tn_unit *unit)
{
    const tn_source *source = &compilation->sources.files[unit->file];
    return (tn_input){source->text, source->size, source->path, unit->identity, unit->recorded};
}

/* What a `use` led to before. */
static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tn_compilation *compilation = context;
    const tn_unit *user = unit_named(compilation, request->user);
    (void)meant;
    for (size_t i = 0; user && i < user->use_count; i++)
        if (user->uses[i].unit && strcmp(user->uses[i].path, request->path) == 0) {
            *found = input_of(compilation, user->uses[i].unit);
            return TN_OK;
        }
    return tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "`%.200s` was not used before", request->path);
}

tn_status tn_opened_params(const tn_opened *opened, tn_param_values *params)
{
    const tn_sources *sources = &opened->compilation.sources;
    const char **items = calloc(sources->count + 1, sizeof *items);
    *params = (tn_param_values){.items = items};
    for (size_t i = 0; items && i < sources->count; i++)
        if (strcmp(sources->files[i].path, TN_SETTING_SOURCE) == 0)
            items[params->count++] = sources->files[i].text;
    return items ? TN_OK : TN_MEMORY;
}

void tn_opened_params_text(const tn_opened *opened, char *text, size_t size)
{
    const tn_sources *sources = &opened->compilation.sources;
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sources->count && used < size; i++)
        if (strcmp(sources->files[i].path, TN_SETTING_SOURCE) == 0)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", sources->files[i].text);
}

tn_status tn_open_again(const tn_opened *opened, tn_change_tree *change, void *context, size_t test, tn_opened *again)
{
    const tn_compilation *before = &opened->compilation;
    const tn_input input = input_of(before, before->imports->units[before->imports->count - 1]);
    changing c = {change, context};
    tn_compile_options options = {.resolver = {resolve, (void *)(uintptr_t)before},
                                  .watch = opened->module->watch,
                                  .change = change ? change_trees : NULL,
                                  .change_context = &c,
                                  .test = test};
    *again = (tn_opened){.path = input.name};
    tn_status status = tn_opened_params(opened, &options.params);
    if (status == TN_OK)
        status = tn_open_text(before->notation, &input, &options, again);
    free((void *)(uintptr_t)options.params.items);
    return status;
}
