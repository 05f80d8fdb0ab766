/* A .study with an evolution block: its settings, and a module that holds its grammar. */
#include <stdlib.h>
#include <string.h>

#include "compiler/bnf.h"
#include "compiler/evolution.h"
#include "compiler/import.h"

/* What importing asks: the study uses its grammar, a grammar uses nothing. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, void **unit, tn_use **uses,
                       size_t *use_count)
{
    tn_source *source = &diagnostics->sources->files[file];
    tn_evolution_reader *reader = TN_NEW(arena, tn_evolution_reader);
    *use_count = 0;
    if (!reader)
        return false;
    *unit = reader;
    *reader = (tn_evolution_reader){.arena = arena, .diagnostics = diagnostics, .file = file};
    if (tn_is_bnf(source->path))
        return true;
    tn_evolution_read(reader, source->text, source->size);
    tn_use *use = TN_NEW(arena, tn_use);
    if (!use || reader->failed)
        return false;
    *uses = use;
    for (const tn_evolution_setting *s = reader->first; s; s = s->next) {
        if (strcmp(s->name, "grammar") != 0 || !s->values || s->values->kind != TN_EVOLUTION_STRING ||
            !s->values->text[0])
            continue;
        *use = (tn_use){.path = s->values->text, .span = s->values->span};
        *use_count = 1;
    }
    return true;
}

static tn_status emit(tn_compilation *c, uint32_t grammar, tn_error *error)
{
    tn_builder *builder = tn_builder_new();
    tn_status status = builder ? tn_bnf_compile(&c->sources, grammar, &c->diagnostics, c->arena, builder, error)
                               : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < c->sources.count; i++)
        tn_builder_add_SOURCE(builder,
                              &(tn_source_record){.path = tn_builder_string(builder, c->sources.files[i].path),
                                                  .text = tn_builder_string_n(builder, c->sources.files[i].text,
                                                                              c->sources.files[i].size)});
    if (status == TN_OK)
        status = tn_builder_finish(builder, &c->module, &c->module_size, error);
    tn_builder_free(builder);
    return status;
}

tn_status tn_evolution_compile(const tn_compile_options *options, tn_compilation *c, tn_error *error)
{
    tn_imports imports;
    tn_evolution_study *study = TN_NEW(c->arena, tn_evolution_study);
    tn_status status = study ? tn_import_all(c->arena, &c->diagnostics, options->stdlib_dirs, options->stdlib_dir_count,
                                             ".bnf", parse_unit, 0, &imports)
                             : tn_fail_memory(error);
    if (status != TN_OK)
        return tn_fail_memory(error);
    const tn_unit *named = imports.units[imports.count - 1], *grammar = imports.count > 1 ? imports.units[0] : NULL;
    bool well = tn_evolution_check(named->tree, study);
    if (grammar && !tn_is_bnf(c->sources.files[grammar->file].path)) {
        tn_report(&c->diagnostics, E_EVOLUTION_VALUE, study->span, "`grammar` names a .bnf file");
        return TN_INVALID;
    }
    if (grammar) {
        study->grammar_file = grammar->file;
        status = emit(c, grammar->file, error);
    }
    if (status == TN_MEMORY || status == TN_LIMIT)
        return status;
    if (!well || !grammar || c->diagnostics.error_count > 0 ||
        (options->warnings_are_errors && c->diagnostics.warning_count > 0)) {
        free(c->module);
        c->module = NULL;
        return TN_INVALID;
    }
    c->evolution = study;
    return TN_OK;
}

bool tn_evolution_settings_read(tn_sources *sources, uint32_t file, tn_diagnostics *diagnostics, tn_arena *arena,
                                tn_evolution_study *study)
{
    tn_evolution_reader reader = {.arena = arena, .diagnostics = diagnostics, .file = file};
    tn_evolution_read(&reader, sources->files[file].text, sources->files[file].size);
    return tn_evolution_check(&reader, study) && !reader.failed;
}
