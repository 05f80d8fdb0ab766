/* The front end of .study files with an evolution block: makes the syntax tree, as the parser asks; and compiles the
 * settings and the grammar that they name. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/bnf/ast.h"
#include "compiler/bnf/bnf.h"
#include "compiler/common/import.h"
#include "compiler/common/lexical.h"
#include "compiler/common/notation.h"
#include "compiler/common/words.h"
#include "compiler/evolution/evolution.h"
#include "compiler/study/study.h"
#include "runtime/base/file.h"
#include "runtime/number/data.h"

/* ==== makes the syntax tree of evolution blocks: what the parser calls */

void tn_evolution_block(tn_evolution_reader *reader, tn_span head)
{
    reader->open = head;
    if (reader->blocks++) {
        tn_diagnostic *diagnostic =
            tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, head, "a study has one evolution block");
        tn_note(reader->diagnostics, diagnostic, &reader->head, "the first is here");
        return;
    }
    reader->head = head;
}

void tn_evolution_outside(tn_evolution_reader *reader, tn_span span)
{
    if (reader->outside.end == 0)
        reader->outside = span;
}

void tn_evolution_setting_new(tn_evolution_reader *reader, tn_span span, tn_evolution_text name,
                              tn_evolution_value *values)
{
    tn_evolution_setting *setting = TN_NEW(reader->arena, tn_evolution_setting);
    char *copy = tn_arena_copy(reader->arena, name.text, name.length);
    if (!setting || !copy)
        return;
    setting->name = copy;
    setting->span = span;
    setting->values = values;
    TN_CHAIN(reader, setting);
}

tn_evolution_value *tn_evolution_value_new(tn_evolution_reader *reader, tn_evolution_value_kind kind, tn_span span,
                                           tn_evolution_text text)
{
    tn_evolution_value *value = TN_NEW(reader->arena, tn_evolution_value);
    char *copy = kind == TN_EVOLUTION_STRING ? tn_string_lex(reader->arena, text.text + 1, text.length - 2)
                                             : tn_arena_copy(reader->arena, text.text, text.length);
    if (!value || !copy)
        return NULL;
    value->kind = kind;
    value->span = span;
    value->text = copy;
    value->last = value;
    return value;
}

tn_evolution_value *tn_evolution_value_add(tn_evolution_value *list, tn_evolution_value *value)
{
    if (!list || !value)
        return list ? list : value;
    list->last->next = value;
    list->last = value;
    return list;
}

void tn_evolution_unexpected(tn_evolution_reader *reader, tn_span span, const char *token)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "%s does not belong here", token);
    tn_help(reader->diagnostics, diagnostic, "write one setting a line, as `population 500`");
}

void tn_evolution_unclosed_text(tn_evolution_reader *reader, tn_span span)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "this text has no closing quote");
    tn_help(reader->diagnostics, diagnostic, "a text ends with `\"` on the line that it begins on");
}

void tn_evolution_unclosed_block(tn_evolution_reader *reader, tn_span span)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "the evolution block is not closed");
    tn_note(reader->diagnostics, diagnostic, &reader->open, "it begins here");
    tn_help(reader->diagnostics, diagnostic, "write `}` after the last setting");
}

/* ==== compiles .study files with an evolution block: its settings, and the grammar that it names; and the front end
 * that the table of notations names */

#define DATA_BYTES_MAX ((size_t)256 << 20)

static const char grammar_files[] = ".bnf";

/* What importing asks: the study uses its grammar, a grammar uses nothing. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    uint32_t file = unit->file;
    tn_source *source = &diagnostics->sources->files[file];
    tn_evolution_reader *reader = TN_NEW(arena, tn_evolution_reader);
    *use_count = 0;
    if (!reader)
        return false;
    unit->tree = reader;
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

static void emit_setting(tn_builder *builder, tn_setting setting, const tn_setting_value *v)
{
    if (v->written)
        tn_builder_add_SETTING(builder,
                               &(tn_setting_record){setting, v->written, v->choice, v->first, v->second,
                                                    tn_builder_string(builder, v->text), v->file, v->begin, v->end});
}

static void emit_settings(tn_builder *builder, const tn_evolution_study *study)
{
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        if (tn_setting_rows[i].kind != TN_SETTING_EACH)
            emit_setting(builder, i, &study->of[i]);
        for (uint32_t k = 0; k < study->each_count; k++)
            if (study->each[k].setting == i)
                emit_setting(builder, i, &study->each[k].value);
    }
}

/* A study of fields or of designs has no grammar: what it names is read when it is bred. */
static tn_status emit_forms(tn_compilation *c, const tn_imports *imports, const tn_evolution_study *study,
                            tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    if (!builder)
        return TN_MEMORY;
    emit_settings(builder, study);
    return tn_compilation_finish(c, builder, TN_OK, error);
}

/* ---- numbers of the data that a grammar asks for */

static const tn_setting data_settings[TN_BNF_DATA] = {TN_SET_DATASET_VARS, TN_SET_DATASET_INPUTS,
                                                      TN_SET_DATASET_OUTPUTS};

static tn_status count_data(const char *text, size_t size, size_t counts[TN_BNF_DATA], tn_error *error)
{
    tn_data *table = calloc(1, sizeof *table);
    if (!table)
        return tn_fail_memory(error);
    tn_status status = tn_data_read(text, size, table, error);
    if (status == TN_OK) {
        counts[0] = table->width - 1;
        status = tn_data_distinct(table, 0, counts[0], &counts[1], error);
    }
    if (status == TN_OK)
        status = tn_data_distinct(table, counts[0], table->width, &counts[2], error);
    tn_data_clear(table);
    free(table);
    return status;
}

/* In the data, where the error has its place there; otherwise where they are named. */
static void report_data(tn_compilation *c, const tn_setting_value *fit, const char *path, const tn_error *why)
{
    tn_diagnostic *d = tn_report_error(&c->diagnostics, why, path, NULL, 0);
    if (!d || why->line)
        return;
    d->has_span = true;
    d->span = (tn_span){fit->file, fit->begin, fit->end};
}

/* Settings that the study does not write are written by the data that it fits; with those that it does, they are a part
 * of the run from here on. Data that cannot be read are an error here: the grammar needs them. */
static tn_status note_data(tn_compilation *c, const tn_source *grammar, tn_evolution_study *study, tn_error *error)
{
    const tn_setting_value *fit = &study->of[TN_SET_FIT];
    const tn_source *own = &c->sources.files[study->of[TN_SET_GRAMMAR].file];
    size_t counts[TN_BNF_DATA] = {0}, size;
    uint8_t *bytes;
    tn_error why = {0};
    if (!fit->written || !fit->text || !tn_bnf_asks_data(grammar->text, grammar->size))
        return TN_OK;
    char *path = tn_file_beside(own->path, fit->text);
    tn_status status = path ? tn_file_read(path, DATA_BYTES_MAX, &bytes, &size, &why) : TN_MEMORY;
    if (status == TN_OK) {
        status = count_data((const char *)bytes, size, counts, &why);
        free(bytes);
    }
    if (status != TN_OK && status != TN_MEMORY) {
        report_data(c, fit, path, &why);
        counts[0] = counts[1] = counts[2] = 1; /* so that the grammar does not miss them, too */
    }
    free(path);
    for (size_t i = 0; i < TN_BNF_DATA; i++) {
        tn_setting_value value = {
            .written = 1, .first = (double)counts[i], .file = fit->file, .begin = fit->begin, .end = fit->end};
        if (!study->of[data_settings[i]].written && tn_setting_fits(data_settings[i], &value))
            study->of[data_settings[i]] = value;
    }
    return status == TN_MEMORY ? tn_fail_memory(error) : TN_OK;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, uint32_t grammar, tn_evolution_study *study,
                      tn_error *error)
{
    const tn_setting_value *mapping = &study->of[TN_SET_MAPPING];
    tn_bnf_study said = {.says_mapping = mapping->written,
                         .position_independent = mapping->choice == 1,
                         .mapping_span = {mapping->file, mapping->begin, mapping->end}};
    tn_builder *builder = tn_builder_new();
    tn_status status = builder ? note_data(c, &c->sources.files[grammar], study, error) : tn_fail_memory(error);
    for (size_t i = 0; i < TN_BNF_DATA; i++)
        said.data[i] = study->of[data_settings[i]].written ? (uint32_t)study->of[data_settings[i]].first : 0;
    if (status == TN_OK)
        status = tn_bnf_compile(&c->sources, grammar, &said, &c->diagnostics, c->arena, builder, error);
    if (status == TN_OK && c->diagnostics.error_count == 0) {
        tn_emit_sources(builder, imports, &c->sources);
        emit_settings(builder, study);
        status = tn_builder_finish(builder, &c->module, &c->module_size, error);
    }
    tn_builder_free(builder);
    return status;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_evolution_study study;
    tn_status status = tn_import_all(c, options, grammar_files, parse_unit, &imports);
    if (status != TN_OK)
        return tn_fail_memory(error);
    const tn_unit *named = imports.units[imports.count - 1], *grammar = imports.count > 1 ? imports.units[0] : NULL;
    tn_evolution_check(named->tree, &study);
    if (grammar && strcmp(grammar->extension, grammar_files) != 0) {
        const tn_setting_value *v = &study.of[TN_SET_GRAMMAR];
        tn_diagnostic *d = tn_report(&c->diagnostics, E_EVOLUTION_VALUE, (tn_span){v->file, v->begin, v->end},
                                     "`grammar` names a .bnf file");
        tn_help(&c->diagnostics, d, "rule files such as .plan and .hemls are what a grammar's sentences become");
    } else if (grammar && !((const tn_evolution_reader *)grammar->tree)->failed) {
        status = emit(c, &imports, grammar->file, &study, error);
    } else if (!grammar && c->diagnostics.error_count == 0) {
        status = emit_forms(c, &imports, &study, error);
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

/* ---- the front end */

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    const tn_source *source = &diagnostics->sources->files[reading->file];
    tn_evolution_reader reader = {
        .arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    tn_evolution_read(&reader, source->text, source->size);
    return !reader.failed;
}

static bool made(const tn_module *module)
{
    return module->SETTING_count > 0;
}

/* What a setting's value is, by its kind. */
#define OF_WHOLE(CHOICES) "a whole number"
#define OF_REAL(CHOICES) "a number"
#define OF_PAIR(CHOICES) "a whole number, or a range of them: `2..10`"
#define OF_SEED(CHOICES) "which random numbers: `seed 7`"
#define OF_TEXT(CHOICES) "in quotes"
#define OF_CHOICE(CHOICES) "one of `" CHOICES "`"
#define OF_CHOICE_REAL(CHOICES) "one of `" CHOICES "`, and perhaps a number"
#define OF_SPAN(CHOICES) "a number, or a range of them: `1..4`"
#define OF_EVERY(CHOICES) "a whole number, and perhaps `every` and another one"
#define OF_EACH(CHOICES) "perhaps with `target` and `weight` behind; may be there more than once"

static const tn_vocabulary_place places[] = {{"", ""}, {"evolution", ""}};

static const tn_vocabulary_word words[] = {
    {"evolution", "how forms are bred: `evolution { ... }`, a setting a line", 1 << 0, TN_AS_VALUE, 0},
#define SETTING(ID, NUMBER, NAME, KIND, FIRST, SECOND, LOW, HIGH, CHOICES, USE)                                        \
    {NAME, OF_##KIND(CHOICES), 1 << 1, TN_AS_VALUE, 0},
#include "runtime/genome/settings.def"
};

static const tn_vocabulary evolution_words = {.words = words,
                                              .count = sizeof words / sizeof *words,
                                              .places = places,
                                              .place_count = sizeof places / sizeof *places};

extern const tn_front tn_front_evolution;
const tn_front tn_front_evolution = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_study_list,
    .words = &evolution_words,
    .lay_out = tn_format_study,
    .spell = tn_format_small_letters,
};
