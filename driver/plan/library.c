/* Chooses a library of a file by name and makes it ready. */
#include "driver/plan/library.h"

#include <stdlib.h>
#include <string.h>

#include "driver/house/judge.h"
#include "runtime/base/nearest.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/search/search.h"

/* ---- makes rules of a library's clauses, and tells which of them drop a plan */

tn_status tn_clause_rules_new(const tn_schema *schema, const tn_library_record *library,
                              const tn_rules_options *options, tn_rules **rules, tn_error *error)
{
    uint32_t *functions = malloc(sizeof *functions * ((size_t)library->clause_count + 1));
    if (!functions)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < library->clause_count; i++)
        functions[i] = schema->module->CLAUSE_records[library->clause_first + i].holds;
    tn_status status = tn_rules_new(schema, functions, library->clause_count, options, rules, error);
    free(functions);
    return status;
}

/* ---- chooses a library of a file by name and makes it ready */

/* The names of things in a file, for choosing among them. */
typedef struct names {
    const char **texts;
    uint32_t *indices;
    size_t count;
} names;

static bool names_new(size_t room, names *list)
{
    *list = (names){malloc(sizeof *list->texts * (room + 1)), malloc(sizeof *list->indices * (room + 1)), 0};
    return list->texts && list->indices;
}

static void names_free(names *list)
{
    free(list->texts);
    free(list->indices);
}

static void names_add(names *list, const char *text, uint32_t index)
{
    list->texts[list->count] = text;
    list->indices[list->count++] = index;
}

static tn_status no_memory(tn_opened *opened)
{
    tn_error error;
    tn_status status = tn_fail_memory(&error);
    tn_finding_error(opened, &error);
    return status;
}

/* A library of houses in the form; NULL: there is none. */
static const char *library_in(const tn_module *module, uint32_t form)
{
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++)
        if (module->HOUSE_LIBRARY_records[i].form == form)
            return tn_text(module, module->HOUSE_LIBRARY_records[i].name);
    return NULL;
}

/* The same of a measure: it is about the houses of a form. */
static bool report_measure_of_houses(tn_opened *opened, const char *name)
{
    const tn_module *module = opened->module;
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    for (uint32_t i = 0; i < module->HOUSE_MEASURE_count; i++) {
        const tn_house_measure_record *measure = &module->HOUSE_MEASURE_records[i];
        if (strcmp(tn_text(module, measure->name), name) != 0)
            continue;
        const char *library = library_in(module, measure->form);
        tn_diagnostic *d =
            tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE,
                           "`%.80s` is a measure of houses of the form `%.80s`, which are not asked about here", name,
                           tn_text(module, module->FORM_records[measure->form].name));
        if (library)
            tn_help(diagnostics, d, "`--library %.80s` asks about them", library);
        else
            tn_help(diagnostics, d, "declare a library of them: `library NAME from PLANS in %.80s { }`",
                    tn_text(module, module->FORM_records[measure->form].name));
        return true;
    }
    return false;
}

/* Is the name that of a library or a rule about houses, where one about plans is asked for? Then that is said. */
static bool report_of_houses(tn_opened *opened, const char *what, const char *name)
{
    const tn_module *module = opened->module;
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    bool is_library = strcmp(what, "library") == 0;
    if (strcmp(what, "measure") == 0)
        return report_measure_of_houses(opened, name);
    uint32_t found = is_library ? tn_house_library_find(module, name) : tn_house_rule_find(module, name);
    if (found == TN_NO_RECORD)
        return false;
    tn_diagnostic *d =
        tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE,
                       "`%.80s` is a %s about houses, and a %s about plans is needed here", name, what, what);
    if (is_library)
        tn_help(diagnostics, d,
                "its plans are those of `%.80s`; `tartan count`, `sample`, `best`, `unrank`, `house` and `vary` take "
                "`--library %.80s`",
                tn_text(module, module->LIBRARY_records[module->HOUSE_LIBRARY_records[found].plans].name), name);
    else
        tn_help(diagnostics, d, "`tartan explain` and `tartan match` ask it about the lines of houses");
    return true;
}

/* The names, and where they are those of libraries the ones of houses, which most commands take as well. */
static bool with_houses(const tn_opened *opened, const names *list, const char *what, names *all)
{
    const tn_module *module = opened->module;
    uint32_t more = strcmp(what, "library") == 0 ? module->HOUSE_LIBRARY_count : 0;
    if (!names_new(list->count + more, all))
        return false;
    for (size_t i = 0; i < list->count; i++)
        names_add(all, list->texts[i], list->indices[i]);
    for (uint32_t i = 0; i < more; i++)
        names_add(all, tn_text(module, module->HOUSE_LIBRARY_records[i].name), i);
    return true;
}

/* Finds `name` among the names; a name not there is reported with what there is. */
static tn_status pick(tn_opened *opened, const names *list, const char *what, const char *name, uint32_t *index)
{
    for (size_t i = 0; i < list->count; i++) {
        if (strcmp(list->texts[i], name) == 0) {
            *index = list->indices[i];
            return TN_OK;
        }
    }
    if (report_of_houses(opened, what, name))
        return TN_INVALID;
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    names all;
    if (!with_houses(opened, list, what, &all)) {
        names_free(&all);
        return no_memory(opened);
    }
    char text[240];
    tn_word_list(all.texts, all.count, text, sizeof text);
    tn_diagnostic *diagnostic =
        tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE, "%s has no %s `%.80s`", opened->path, what, name);
    const char *near = tn_nearest(name, all.texts, all.count);
    if (near)
        tn_help(diagnostics, diagnostic, "did you mean `%s`?", near);
    else if (strcmp(what, "measure") == 0 && strcmp(name, "cost") == 0 && opened->module->MATERIAL_count)
        tn_help(diagnostics, diagnostic, "write a measure of what a house costs: `measure cost = sum(cost)`");
    else if (all.count)
        tn_help(diagnostics, diagnostic, "it has %s", text);
    names_free(&all);
    return TN_INVALID;
}

/* The only library of the file itself, or the only one at all. */
static tn_status pick_only(tn_opened *opened, const names *all, uint32_t *index)
{
    names own;
    if (!names_new(all->count, &own)) {
        names_free(&own);
        return no_memory(opened);
    }
    for (size_t i = 0; i < all->count; i++)
        if (!(opened->module->LIBRARY_records[all->indices[i]].flags & TN_IMPORTED))
            names_add(&own, all->texts[i], all->indices[i]);
    const names *from = own.count ? &own : all;
    tn_status status = from->count == 1 ? TN_OK : TN_INVALID;
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    if (status == TN_OK) {
        *index = from->indices[0];
    } else if (from->count == 0) {
        tn_diagnostic *none = tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE, "%s has no library", opened->path);
        tn_help(diagnostics, none, "%s",
                tn_opened_help(opened, "a library says which plans are made and which are pruned: library NAME { trays "
                                       "4..9 prune RULE }")
                    .text);
    } else {
        char text[240];
        tn_word_list(from->texts, from->count, text, sizeof text);
        tn_diagnostic *several =
            tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE, "%s has %zu libraries", opened->path, from->count);
        tn_help(diagnostics, several, "choose one with --library: %s", text);
    }
    names_free(&own);
    return status;
}

tn_status tn_library_choose(tn_opened *opened, const char *name, uint32_t *index)
{
    const tn_module *module = opened->module;
    names all;
    tn_status status;
    if (names_new(module->LIBRARY_count, &all)) {
        for (uint32_t i = 0; i < module->LIBRARY_count; i++)
            names_add(&all, tn_text(module, module->LIBRARY_records[i].name), i);
        status = name ? pick(opened, &all, "library", name, index) : pick_only(opened, &all, index);
    } else {
        status = no_memory(opened);
    }
    names_free(&all);
    return status;
}

tn_status tn_rule_choose(tn_opened *opened, const char *name, uint32_t *index)
{
    const tn_module *module = opened->module;
    names all;
    tn_status status;
    if (names_new(module->RULE_count, &all)) {
        for (uint32_t i = 0; i < module->RULE_count; i++)
            names_add(&all, tn_text(module, module->RULE_records[i].name), i);
        status = pick(opened, &all, "rule", name, index);
    } else {
        status = no_memory(opened);
    }
    names_free(&all);
    return status;
}

/* Finds it among the measures of a schema's plans, or of houses on these. Where there are none the error says what to
 * write: a sum of a length that trays have, or how many trays there are. */
static tn_status pick_measure(tn_opened *opened, const names *all, uint32_t schema, const char *name, uint32_t *measure)
{
    const tn_module *module = opened->module;
    const tn_schema_record *record = &module->SCHEMA_records[schema];
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    const char *using = module->SCHEMA_count > 1 ? " using " : "", *of = *using ? tn_text(module, record->name) : "";
    size_t before = diagnostics->count;
    tn_status status = pick(opened, all, "measure", name, measure);
    if (status != TN_INVALID || all->count > 0 || diagnostics->count == before)
        return status;
    tn_diagnostic *none = &diagnostics->items[diagnostics->count - 1];
    if (none->help)
        return status;
    for (uint32_t i = record->field_first; i < record->field_first + record->field_count; i++)
        if (module->FIELD_records[i].kind == TN_FIELD_LENGTH) {
            const char *field = tn_text(module, module->FIELD_records[i].name);
            tn_help(diagnostics, none, "it has no measures: write one, such as `measure whole-%s%s%s = sum(%s)`", field,
                    using, of, field);
            return status;
        }
    tn_help(diagnostics, none, "it has no measures: write one, such as `measure trays-in-all%s%s = quantity(any)`",
            using, of);
    return status;
}

tn_status tn_measure_choose(tn_opened *opened, const char *name, const tn_library_record *library, uint32_t *measure)
{
    const tn_module *module = opened->module;
    names all;
    tn_status status;
    if (names_new((size_t)module->MEASURE_count + 1, &all)) {
        for (uint32_t i = TN_NO_RECORD; tn_named_measure_next(module, library, &i);)
            names_add(&all, tn_named_measure(module, i), i);
        status = pick_measure(opened, &all, library->schema, name, measure);
    } else {
        status = no_memory(opened);
    }
    names_free(&all);
    return status;
}

/* Houses go by measures that all of them have. */
static tn_status refuse_partial(tn_opened *opened, uint32_t measure)
{
    const tn_module *module = opened->module;
    if (!tn_named_measure_partial(module, measure))
        return TN_OK;
    tn_diagnostic *d = tn_report_bare(&opened->compilation.diagnostics, TN_ERROR, E_QUOTIENT,
                                      "some plans have no value of `%.80s`, and houses go by measures that all have",
                                      tn_text(module, module->MEASURE_records[measure].name));
    tn_help(&opened->compilation.diagnostics, d,
            "ask about the plans; of houses quotients, `max(...)` and `min(...)` can be compared in rules");
    return TN_INVALID;
}

tn_status tn_house_measure_choose(tn_opened *opened, const char *name, uint32_t form, uint32_t *index)
{
    const tn_module *module = opened->module;
    names all;
    tn_status status;
    if (names_new((size_t)module->HOUSE_MEASURE_count + module->MEASURE_count, &all)) {
        for (uint32_t i = 0; i < module->HOUSE_MEASURE_count; i++)
            if (module->HOUSE_MEASURE_records[i].form == form)
                names_add(&all, tn_text(module, module->HOUSE_MEASURE_records[i].name), i);
        for (uint32_t i = 0; i < module->MEASURE_count; i++)
            if (module->MEASURE_records[i].schema == module->FORM_records[form].schema)
                names_add(&all, tn_text(module, module->MEASURE_records[i].name),
                          (uint32_t)module->HOUSE_MEASURE_count + i);
        status = pick_measure(opened, &all, module->FORM_records[form].schema, name, index);
        if (status == TN_OK && *index >= module->HOUSE_MEASURE_count)
            status = refuse_partial(opened, *index - (uint32_t)module->HOUSE_MEASURE_count);
    } else {
        status = no_memory(opened);
    }
    names_free(&all);
    return status;
}

/* Chooses a library and makes its schema ready. */
static tn_status ready_schema(tn_opened *opened, const char *name, tn_ready_library *ready)
{
    tn_error error;
    *ready = (tn_ready_library){0};
    tn_status status = tn_library_choose(opened, name, &ready->index);
    if (status != TN_OK)
        return status;
    ready->record = &opened->module->LIBRARY_records[ready->index];
    status = tn_schema_new(opened->module, ready->record->schema, 0, &ready->schema, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}

tn_status tn_library_ready(tn_opened *opened, const char *name, const tn_library_options *options,
                           tn_ready_library *ready)
{
    tn_error error;
    tn_status status = ready_schema(opened, name, ready);
    if (status != TN_OK || !options)
        return status;
    status = tn_library_new(ready->schema, ready->index, options, &ready->library, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}

tn_status tn_library_ready_or_searched(tn_opened *opened, const char *name, const tn_library_options *options,
                                       tn_ready_library *ready, tn_error *limit)
{
    tn_status status = ready_schema(opened, name, ready);
    if (status != TN_OK)
        return status;
    status = tn_library_new(ready->schema, ready->index, options, &ready->library, limit);
    bool states = status == TN_LIMIT && limit->code == E_TOO_MANY_STATES;
    if (states && tn_plan_search_is_there())
        return TN_OK;
    if (status != TN_OK)
        tn_finding_error(opened, limit);
    if (states)
        tn_report_bare(&opened->compilation.diagnostics, TN_NOTE, TN_CODE_NONE,
                       "a tartan that was built with the part `search` (CaDiCaL, libcadical-dev) finds plans of such a "
                       "library by searching");
    return status;
}

void tn_library_close(tn_ready_library *ready)
{
    tn_library_free(ready->library);
    tn_schema_free(ready->schema);
    *ready = (tn_ready_library){0};
}

/* The number of libraries of the file itself, and the last of them. */
static size_t own_libraries(const tn_module *module, uint32_t *last)
{
    size_t count = 0;
    for (uint32_t i = 0; i < module->LIBRARY_count; i++) {
        if (module->LIBRARY_records[i].flags & TN_IMPORTED)
            continue;
        *last = i;
        count++;
    }
    return count;
}

tn_status tn_schema_choose(tn_opened *opened, const char *name, uint32_t *index, uint32_t *library)
{
    const tn_module *module = opened->module;
    uint32_t chosen = 0;
    if (name || own_libraries(module, &chosen) == 1) {
        tn_status status = name ? tn_library_choose(opened, name, &chosen) : TN_OK;
        if (status == TN_OK) {
            *library = chosen;
            *index = module->LIBRARY_records[chosen].schema;
        }
        return status;
    }
    *index = 0;
    if (module->SCHEMA_count == 1)
        return TN_OK;
    tn_diagnostics *diagnostics = &opened->compilation.diagnostics;
    if (module->SCHEMA_count == 0) {
        tn_diagnostic *none = tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE,
                                             "%s has no schema that says what a tray is", opened->path);
        tn_help(diagnostics, none, "%s",
                tn_opened_help(opened, "write `use \"lahave\"` at its top, or declare a `schema` of your own").text);
        return TN_INVALID;
    }
    tn_diagnostic *unclear = tn_report_bare(diagnostics, TN_ERROR, E_NOT_IN_FILE,
                                            "%s has %zu schemas, and it is not clear which one the plans are of",
                                            opened->path, module->SCHEMA_count);
    tn_help(diagnostics, unclear, "name a library with --library: its schema is then the one");
    return TN_INVALID;
}
