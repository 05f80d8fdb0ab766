/* A .study with an evolution block as a module: its settings, and the grammar that it names. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/bnf/bnf.h"
#include "compiler/common/emit_sources.h"
#include "compiler/common/import.h"
#include "compiler/common/lexical.h"
#include "compiler/evolution/evolution.h"

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
    reader->failed = !tn_text_check(diagnostics, file);
    if (reader->failed || file != 0)
        return true;
    tn_evolution_read(reader, source->text, source->size);
    tn_use *use = TN_NEW(arena, tn_use);
    if (!use || reader->failed)
        return false;
    *uses = use;
    for (const tn_evolution_setting *s = reader->first; s && *use_count == 0; s = s->next) {
        if (strcasecmp(s->name, "grammar") != 0 || !s->values || s->values->kind != TN_EVOLUTION_STRING ||
            !s->values->text[0])
            continue;
        *use = (tn_use){.path = s->values->text, .span = s->values->span};
        *use_count = 1;
    }
    return true;
}

static void emit_settings(tn_builder *builder, const tn_evolution_study *study)
{
    for (uint32_t i = 0; i < TN_SETTING_COUNT; i++) {
        const tn_setting_value *v = &study->of[i];
        if (v->written)
            tn_builder_add_SETTING(builder, &(tn_setting_record){i, v->written, v->choice, v->first, v->second,
                                                                 tn_builder_string(builder, v->text), v->file, v->begin,
                                                                 v->end});
    }
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, uint32_t grammar, const tn_evolution_study *study,
                      tn_error *error)
{
    tn_builder *builder = tn_builder_new();
    tn_status status = builder ? tn_bnf_compile(&c->sources, grammar, &c->diagnostics, c->arena, builder, error)
                               : tn_fail_memory(error);
    if (status == TN_OK && c->diagnostics.error_count == 0) {
        tn_emit_sources(builder, imports, &c->sources);
        emit_settings(builder, study);
        status = tn_builder_finish(builder, &c->module, &c->module_size, error);
    }
    tn_builder_free(builder);
    return status;
}

tn_status tn_evolution_compile(const tn_compile_options *options, tn_compilation *c, tn_error *error)
{
    tn_imports imports;
    tn_evolution_study study;
    tn_status status = tn_import_all(c->arena, &c->diagnostics, options->stdlib_dirs, options->stdlib_dir_count, ".bnf",
                                     parse_unit, 0, &imports);
    if (status != TN_OK)
        return tn_fail_memory(error);
    const tn_unit *named = imports.units[imports.count - 1], *grammar = imports.count > 1 ? imports.units[0] : NULL;
    tn_evolution_check(named->tree, &study);
    if (grammar && !tn_is_bnf(c->sources.files[grammar->file].path)) {
        const tn_setting_value *v = &study.of[TN_SET_GRAMMAR];
        tn_diagnostic *d = tn_report(&c->diagnostics, E_EVOLUTION_VALUE, (tn_span){v->file, v->begin, v->end},
                                     "`grammar` names a .bnf file");
        tn_help(&c->diagnostics, d, "rule files such as .plan and .hemls are what a grammar's sentences become");
    } else if (grammar && !((const tn_evolution_reader *)grammar->tree)->failed) {
        status = emit(c, &imports, grammar->file, &study, error);
    }
    if (status == TN_MEMORY || status == TN_LIMIT)
        return status;
    bool refused = c->diagnostics.error_count > 0 || (options->warnings_are_errors && c->diagnostics.warning_count > 0);
    if (!refused && c->module)
        return TN_OK;
    free(c->module);
    c->module = NULL;
    return TN_INVALID;
}

bool tn_evolution_settings_read(tn_sources *sources, uint32_t file, tn_diagnostics *diagnostics, tn_arena *arena,
                                tn_evolution_study *study)
{
    tn_evolution_reader reader = {.arena = arena, .diagnostics = diagnostics, .file = file};
    tn_evolution_read(&reader, sources->files[file].text, sources->files[file].size);
    return tn_evolution_check(&reader, study) && !reader.failed;
}
