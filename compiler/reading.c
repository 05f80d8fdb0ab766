#include "compiler/reading.h"

#include "compiler/bnf/ast.h"
#include "compiler/evolution/evolution.h"
#include "compiler/plan/parse.h"
#include "compiler/study/study.h"

static bool read_study(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    const tn_source *source = &diagnostics->sources->files[reading->file];
    if (!tn_has_evolution(source->text)) {
        reading->tree = tn_parse_study(arena, diagnostics, reading->file, &reading->tokens);
        return reading->tree != NULL;
    }
    tn_evolution_reader reader = {
        .arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    tn_evolution_read(&reader, source->text, source->size);
    return !reader.failed;
}

static bool read_bnf(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    const tn_source *source = &diagnostics->sources->files[reading->file];
    size_t errors = diagnostics->error_count;
    tn_bnf_reader *reader = TN_NEW(arena, tn_bnf_reader);
    if (!reader)
        return false;
    *reader =
        (tn_bnf_reader){.arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    tn_bnf_read(reader, source->text, source->size);
    reading->tree = reader;
    return !reader->failed || diagnostics->error_count > errors;
}

bool tn_read(tn_arena *arena, tn_diagnostics *diagnostics, tn_notation notation, uint32_t file, tn_reading *reading)
{
    *reading = (tn_reading){.file = file, .tokens = {.arena = arena}};
    switch (notation) {
    case TN_NOTATION_HEMLS:
        reading->tree = tn_parse_hemls(arena, diagnostics, file, &reading->tokens);
        return reading->tree != NULL;
    case TN_NOTATION_STUDY:
        return read_study(arena, diagnostics, reading);
    case TN_NOTATION_BNF:
        return read_bnf(arena, diagnostics, reading);
    default:
        reading->tree = tn_parse_plan(arena, diagnostics, file, &reading->tokens);
        return reading->tree != NULL;
    }
}
