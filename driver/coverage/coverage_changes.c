/* Makes the changes of a file's rules about plans, and measures what each does.
 *
 * Each is compiled first, and the tests run under it. All then tell which trays some change tells apart: the library is
 * opened once with classes that are fine enough for all of them, and each change is counted in it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/coverage/coverage_changes.h"
#include "driver/coverage/noticing.h"
#include "runtime/plan/analysis/coverage.h"
#include "runtime/plan/library/diff.h"
#include "runtime/plan/match/same.h"
#include "runtime/plan/match/vm.h"

/* A change that compiles. */
typedef struct tried {
    tn_module *module; /* owned; NULL: it is none */
    bool notices;
    bool same; /* the code of all rules and clauses, and the lengths, are the same */
} tried;

typedef struct trying {
    tn_covering *m;
    tn_change_scope scope;
    const tn_changes *changes;
    tried *items;    /* [changes] */
    uint32_t *rules; /* [rule_count]: RULE records whose answers count */
    size_t rule_count;
    tn_noticing *noticing;
    tn_classes *classes;
    tn_library *library; /* NULL: there is none, or it passes a limit */
    tn_coverage *coverage;
    size_t limits; /* changes whose count has passed a limit */
} trying;

/* Changes that may pass a limit, each of which takes as long as it is large. Then no more are counted. */
#define LIMITS_MAX 40u

/* ---- which rules */

static const tn_clause_record *clause_of(const trying *t, const tn_module *module, uint32_t i)
{
    return &module->CLAUSE_records[t->m->library->clause_first + i];
}

static uint32_t clause_count(const trying *t)
{
    return t->m->library ? t->m->library->clause_count : 0;
}

static bool is_clause(const trying *t, uint32_t holds)
{
    for (uint32_t i = 0; i < clause_count(t); i++)
        if (clause_of(t, t->m->module, i)->holds == holds)
            return true;
    return false;
}

static tn_status find_rules(trying *t, tn_error *error)
{
    const tn_module *module = t->m->module;
    t->rules = malloc((module->RULE_count + 1) * sizeof *t->rules);
    if (!t->rules)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < module->RULE_count; i++) {
        const tn_rule_record *rule = &module->RULE_records[i];
        bool wanted = !(rule->flags & TN_IMPORTED) || (t->scope.imported && is_clause(t, rule->holds));
        if (wanted && rule->schema == t->m->schema_index)
            t->rules[t->rule_count++] = i;
    }
    return TN_OK;
}

/* The rules and clauses whose code is another one in the changed module: their functions there, and (of rules) which
 * they are. functions, which: room for all of them. */
static tn_status find_changed(const trying *t, const tn_module *changed, uint32_t *functions, size_t *count,
                              uint32_t *which, size_t *rule_count, tn_error *error)
{
    const tn_module *module = t->m->module;
    tn_status status = TN_OK;
    *count = *rule_count = 0;
    for (size_t i = 0; status == TN_OK && i < t->rule_count; i++) {
        bool same = true;
        uint32_t now = module->RULE_records[t->rules[i]].holds, then = changed->RULE_records[t->rules[i]].holds;
        status = tn_functions_same(module, now, changed, then, &same, error);
        if (status != TN_OK || same)
            continue;
        which[(*rule_count)++] = t->rules[i];
        functions[(*count)++] = then;
    }
    for (uint32_t i = 0; status == TN_OK && i < clause_count(t); i++) {
        bool same = true;
        uint32_t then = clause_of(t, changed, i)->holds;
        status = tn_functions_same(module, clause_of(t, module, i)->holds, changed, then, &same, error);
        if (status == TN_OK && !same)
            functions[(*count)++] = then;
    }
    return status;
}

/* ---- making the changes */

static bool same_lengths(const trying *t, const tn_module *changed)
{
    const tn_library_record *now = t->m->library;
    if (!now)
        return true;
    const tn_library_record *then = &changed->LIBRARY_records[now - t->m->module->LIBRARY_records];
    return now->trays_min == then->trays_min && now->trays_max == then->trays_max;
}

/* A change that changes no code belongs to a rule or an expression, or else it is about something else: a `let` or a
 * rule with parameters that nothing here uses, the lengths of another library. */
static bool belongs(const tn_change *change)
{
    return change->rule != TN_NO_RECORD || change->clause != TN_NO_RECORD;
}

static tn_status split_classes(trying *t, const tn_schema *changed, tried *item, const tn_change *change,
                               tn_error *error)
{
    uint32_t *functions = malloc((t->rule_count + clause_count(t) + 1) * sizeof *functions);
    uint32_t *which = malloc((t->rule_count + 1) * sizeof *which);
    size_t count = 0, rules;
    tn_classes *classes = NULL;
    tn_status status = functions && which ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_changed(t, item->module, functions, &count, which, &rules, error);
    item->same = count == 0 && same_lengths(t, item->module);
    if (status == TN_OK && count > 0)
        status = tn_classes_new(changed, functions, count, &classes, error);
    if (status == TN_OK && classes)
        status = tn_classes_refine(t->classes, classes, error);
    if (item->same && !belongs(change)) {
        tn_module_free(item->module);
        item->module = NULL;
    }
    tn_classes_free(classes);
    free(functions);
    free(which);
    return status;
}

/* A change that is tried. */
typedef struct tried_change {
    const trying *t;
    size_t number;
} tried_change;

static tn_status open_for_test(void *context, size_t test, tn_opened *opened)
{
    const tried_change *change = context;
    return tn_change_open(&change->t->scope, change->number, test, opened);
}

static tn_status try_opened(trying *t, size_t i, tn_opened *opened, tn_error *error)
{
    tn_schema *schema = NULL;
    tried *item = &t->items[i];
    tn_status status = tn_schema_new(opened->module, t->m->schema_index, 0, &schema, error);
    if (status == TN_INVALID || (status == TN_OK && !tn_same_trays(t->m->covered->schema, schema))) {
        tn_schema_free(schema);
        return TN_OK; /* a `let` that the schema uses */
    }
    tried_change change = {t, i};
    const tn_reopen reopen = {open_for_test, &change};
    if (status == TN_OK)
        status = tn_noticing_ask(t->noticing, opened, schema, &reopen, &item->notices, error);
    if (status == TN_OK) {
        item->module = opened->module;
        opened->module = NULL;
        status = split_classes(t, schema, item, &t->changes->items[i], error);
    }
    tn_schema_free(schema);
    return status;
}

static tn_status try_change(trying *t, size_t i, tn_error *error)
{
    tn_opened opened;
    tn_status status = tn_change_open(&t->scope, i, 0, &opened);
    if (status == TN_OK)
        status = try_opened(t, i, &opened, error);
    else if (status == TN_INVALID) /* what cannot be written is no mistake that stays unnoticed */
        status = TN_OK;
    else
        status = tn_open_error(&opened, status, error);
    tn_close(&opened);
    return status;
}

static tn_status base_classes(trying *t, tn_error *error)
{
    const tn_module *module = t->m->module;
    uint32_t *functions = malloc((t->rule_count + clause_count(t) + 1) * sizeof *functions);
    size_t count = 0;
    if (!functions)
        return tn_fail_memory(error);
    for (size_t i = 0; i < t->rule_count; i++)
        functions[count++] = module->RULE_records[t->rules[i]].holds;
    for (uint32_t i = 0; i < clause_count(t); i++)
        functions[count++] = clause_of(t, module, i)->holds;
    tn_status status = tn_classes_new(t->m->covered->schema, functions, count, &t->classes, error);
    free(functions);
    return status;
}

static tn_status try_all(trying *t, tn_error *error)
{
    size_t count = t->changes->count;
    tn_status status = base_classes(t, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_watch_tell(t->m->module->watch, (double)i, (double)(2 * count));
        status = tn_watch_check(t->m->module->watch, error);
        if (status == TN_OK)
            status = try_change(t, i, error);
    }
    return status;
}

/* ---- what is not known */

/* Adds to what is said of a limit what is not known therefore, once. */
static void say_unknown(trying *t, tn_diagnostic *note, const char *name)
{
    char text[TN_NAME_MAX + 100];
    snprintf(text, sizeof text, "so how many plans changes of `%.*s` decide otherwise is not known for all of them",
             TN_NAME_MAX, name);
    for (size_t i = 0; i < note->note_count; i++)
        if (strcmp(note->notes[i].text, text) == 0)
            return;
    tn_note(&t->m->opened->compilation.diagnostics, note, NULL, "%s", text);
}

/* A limit is said once for the rule or clause in which it is passed. */
static void say_limit(trying *t, const tn_change *change, const tn_error *error)
{
    const tn_module *module = t->m->module;
    tn_error said = *error;
    tn_span place = change->around;
    if (change->rule != TN_NO_RECORD) {
        const tn_rule_record *rule = &module->RULE_records[change->rule];
        place = (tn_span){rule->file, rule->begin, rule->end};
    } else if (change->clause != TN_NO_RECORD) {
        const tn_clause_record *clause = &module->CLAUSE_records[change->clause];
        place = (tn_span){clause->file, clause->begin, clause->end};
    }
    said.code_offset = TN_NO_OFFSET; /* it may be of the changed module */
    say_unknown(t, tn_finding_limit(t->m->opened, &said, &place), change->name);
}

static void say_enough(trying *t)
{
    tn_diagnostics *list = &t->m->opened->compilation.diagnostics;
    tn_diagnostic *note = tn_report_bare(
        list, TN_NOTE, TN_CODE_NONE,
        "counting has passed a limit for %u changes: of those after them only the tests are run", LIMITS_MAX);
    tn_help(list, note, "raise the limit with --max-states, or give the library fewer trays");
}

/* ---- measuring */

/* The library over the classes of all changes. Where only those are too many, nothing is counted in it. */
static tn_status open_library(trying *t, tn_error *error)
{
    const tn_covered *covered = t->m->covered;
    tn_library_options options = {.max_states = t->m->options->max_states,
                                  .override_trays = true,
                                  .trays_min = covered->min,
                                  .trays_max = covered->max,
                                  .classes = t->classes};
    if (!t->m->library)
        return TN_OK;
    uint32_t index = (uint32_t)(t->m->library - t->m->module->LIBRARY_records);
    tn_status status = tn_library_new(covered->schema, index, &options, &t->library, error);
    if (status != TN_LIMIT)
        return status;
    tn_library *alone = NULL;
    tn_error first = *error;
    options.classes = NULL;
    status = tn_library_new(covered->schema, index, &options, &alone, error);
    tn_library_free(alone);
    if (status != TN_OK)
        return status;
    tn_span place = {t->m->library->file, t->m->library->begin, t->m->library->end};
    first.code_offset = TN_NO_OFFSET;
    say_unknown(t, tn_finding_limit(t->m->opened, &first, &place), tn_text(t->m->module, t->m->library->name));
    return TN_OK;
}

/* Of the change's own rule, where its answers differ, else of all rules. *which: the RULE record of the shortest plan.
 */
static tn_status measure_rules(trying *t, const tn_change *change, const tn_schema *changed, bool shortest,
                               tn_otherwise *otherwise, uint32_t *which, tn_error *error)
{
    const tn_module *module = t->m->module;
    uint32_t *lists = malloc(4 * (t->rule_count + clause_count(t) + 1) * sizeof *lists);
    size_t most = t->rule_count + clause_count(t) + 1, all, count = 0;
    uint32_t *functions = lists, *rules = lists + most, *now = rules + most, *then = now + most;
    if (!lists)
        return tn_fail_memory(error);
    tn_status status = find_changed(t, changed->module, functions, &all, rules, &count, error);
    for (size_t i = 0; i < count; i++)
        if (rules[i] == change->rule) { /* it comes first */
            rules[i] = rules[0];
            rules[0] = change->rule;
        }
    for (size_t i = 0; i < count; i++) {
        now[i] = module->RULE_records[rules[i]].holds;
        then[i] = changed->module->RULE_records[rules[i]].holds;
    }
    bool own = count > 0 && rules[0] == change->rule;
    if (status == TN_OK && own)
        status = tn_coverage_rules(t->coverage, now, changed, then, 1, shortest, otherwise, error);
    if (status == TN_OK && mpz_sgn(otherwise->plans) == 0 && count > own)
        status = tn_coverage_rules(t->coverage, now, changed, then, count, shortest, otherwise, error);
    if (status == TN_OK && otherwise->found)
        *which = rules[otherwise->rule];
    free(lists);
    return status;
}

/* How many plans are decided otherwise: by the library, or, where it decides the same, by the rules alone. */
static tn_status count_flips(trying *t, const tn_change *change, const tn_schema *changed, tn_covered_part *part,
                             tn_error *error)
{
    tn_otherwise otherwise;
    uint32_t which;
    bool same = true;
    tn_status status = TN_OK;
    tn_otherwise_init(&otherwise);
    if (t->m->library && !t->library)
        status = TN_LIMIT;
    else if (t->library)
        status = tn_coverage_library(t->coverage, changed, false, &same, &otherwise, error);
    part->alone = t->m->library && status == TN_OK && mpz_sgn(otherwise.plans) == 0;
    if (status == TN_OK && mpz_sgn(otherwise.plans) == 0)
        status = measure_rules(t, change, changed, false, &otherwise, &which, error);
    part->counted = status == TN_OK;
    mpz_set(part->flips, otherwise.plans);
    part->alone = part->alone && mpz_sgn(part->flips) > 0;
    tn_otherwise_clear(&otherwise);
    bool said = t->m->library && !t->library; /* when it was opened */
    if (status == TN_LIMIT && !said)
        say_limit(t, change, error);
    if (status == TN_LIMIT && !said && ++t->limits == LIMITS_MAX)
        say_enough(t);
    return status == TN_LIMIT ? TN_OK : status;
}

/* ---- telling plans */

static void take_telling(tn_otherwise *otherwise, tn_telling *telling)
{
    telling->found = otherwise->found;
    telling->now = otherwise->now;
    telling->trays = otherwise->trays;
    telling->length = otherwise->length;
    otherwise->trays = NULL;
}

/* The shortest plan of which the change's rule says otherwise; else one that the library decides otherwise. */
static tn_status find_telling(trying *t, const tn_change *change, const tn_schema *changed, tn_telling *telling,
                              tn_error *error)
{
    tn_otherwise otherwise;
    bool same;
    tn_otherwise_init(&otherwise);
    tn_status status = measure_rules(t, change, changed, true, &otherwise, &telling->rule, error);
    if (status == TN_OK && otherwise.found) {
        take_telling(&otherwise, telling);
    } else if ((status == TN_OK || status == TN_LIMIT) && t->library) {
        status = tn_coverage_library(t->coverage, changed, true, &same, &otherwise, error);
        telling->of_library = true;
        if (status == TN_OK && otherwise.found && !otherwise.now)
            telling->by = otherwise.rule == SIZE_MAX
                              ? "trays"
                              : tn_text(t->m->module, clause_of(t, t->m->module, (uint32_t)otherwise.rule)->name);
        take_telling(&otherwise, telling);
    }
    tn_otherwise_clear(&otherwise);
    return status == TN_LIMIT ? TN_OK : status;
}

/* Does the changed library keep the plan? */
static tn_status keeps(const trying *t, const tn_schema *changed, tn_plan_vm *vm, const tn_telling *telling, bool *kept,
                       tn_error *error)
{
    const tn_library_record *then = &changed->module->LIBRARY_records[t->m->library - t->m->module->LIBRARY_records];
    tn_status status = TN_OK;
    *kept = telling->length >= then->trays_min && telling->length <= then->trays_max;
    for (uint32_t i = 0; status == TN_OK && *kept && i < then->clause_count; i++) {
        const tn_clause_record *clause = &changed->module->CLAUSE_records[then->clause_first + i];
        bool holds = false;
        status = tn_plan_vm_holds(vm, clause->holds, &holds, error);
        *kept = holds != (clause->kind == TN_CLAUSE_PRUNE);
    }
    return status;
}

/* Is a plan that tells another change decided otherwise under this one too? */
static tn_status tells_too(const trying *t, const tn_schema *changed, tn_plan_vm *vm, const tn_telling *telling,
                           bool *tells, tn_error *error)
{
    bool then = telling->now;
    tn_status status = tn_plan_vm_plan(vm, telling->trays, telling->length, error);
    if (status == TN_OK && telling->of_library)
        status = keeps(t, changed, vm, telling, &then, error);
    else if (status == TN_OK)
        status = tn_plan_vm_holds(vm, changed->module->RULE_records[telling->rule].holds, &then, error);
    *tells = status == TN_OK && then != telling->now;
    return status;
}

/* A plan that is shown for an earlier change may tell this one too. */
static tn_status find_same(trying *t, const tn_schema *changed, size_t number, tn_error *error)
{
    tn_covered *covered = t->m->covered;
    tn_plan_vm *vm = NULL;
    bool tells = false;
    tn_status status = tn_plan_vm_new(changed, 0, &vm, error);
    for (size_t i = 0; status == TN_OK && !tells && i < number; i++) {
        const tn_telling *telling = &covered->parts[i].telling;
        if (!telling->found || telling->same_as != i)
            continue;
        status = tells_too(t, changed, vm, telling, &tells, error);
        if (tells)
            covered->parts[number].telling = (tn_telling){.found = true, .same_as = i};
    }
    tn_plan_vm_free(vm);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status tell(trying *t, const tn_change *change, const tn_schema *changed, size_t number, tn_error *error)
{
    tn_telling *telling = &t->m->covered->parts[number].telling;
    tn_status status = find_same(t, changed, number, error);
    if (status != TN_OK || telling->found)
        return status;
    telling->same_as = number;
    return find_telling(t, change, changed, telling, error);
}

/* ---- parts */

static char *text_of(const tn_module *module, tn_span span)
{
    char text[TN_PART_TEXT_MAX];
    tn_source_text(module, span.file, span.begin, span.end, text, sizeof text);
    return strdup(text);
}

static uint32_t function_of(const trying *t, const tn_change *change)
{
    const tn_module *module = t->m->module;
    return change->rule != TN_NO_RECORD     ? module->RULE_records[change->rule].holds
           : change->clause != TN_NO_RECORD ? module->CLAUSE_records[change->clause].holds
                                            : UINT32_MAX;
}

static bool describe(const trying *t, const tn_change *change, tn_covered_part *part)
{
    part->change = change;
    part->function = function_of(t, change);
    part->name = change->name;
    part->depth = change->depth;
    part->kind = change->what;
    part->place = change->span;
    part->text = text_of(t->m->module, change->span);
    bool inner = change->around.begin != change->span.begin || change->around.end != change->span.end;
    part->around = inner ? text_of(t->m->module, change->around) : NULL;
    return part->text && (!inner || part->around);
}

/* Gives the changed module back. */
static tn_status measure_change(trying *t, size_t i, tn_error *error)
{
    const tn_change *change = &t->changes->items[i];
    tried *item = &t->items[i];
    size_t number = t->m->covered->count;
    tn_schema *changed = NULL;
    tn_covered_part *part = tn_covered_add(t->m->covered);
    if (!part || !describe(t, change, part))
        return tn_fail_memory(error);
    part->noticed = item->notices;
    t->m->covered->noticed += part->noticed;
    tn_status status = tn_schema_new(item->module, t->m->schema_index, 0, &changed, error);
    part->counted = item->same;
    if (status == TN_OK && !item->same && t->limits < LIMITS_MAX)
        status = count_flips(t, change, changed, part, error);
    part->fate = part->noticed               ? TN_FATE_NOTICED
                 : !part->counted            ? TN_FATE_UNKNOWN
                 : mpz_sgn(part->flips) == 0 ? TN_FATE_EQUAL
                                             : TN_FATE_SURVIVES;
    if (status == TN_OK && t->m->options->tell && part->fate == TN_FATE_SURVIVES)
        status = tell(t, change, changed, number, error);
    tn_schema_free(changed);
    tn_module_free(item->module);
    item->module = NULL;
    return status;
}

/* The changes of one rule or clause, in a row: that its clause is left out comes behind those of the rule. */
static tn_status measure_group(trying *t, size_t first, tn_error *error)
{
    uint32_t function = function_of(t, &t->changes->items[first]);
    tn_status status = TN_OK;
    for (size_t i = first; status == TN_OK && i < t->changes->count; i++) {
        const tn_change *change = &t->changes->items[i];
        bool same = function_of(t, change) == function && strcmp(change->name, t->changes->items[first].name) == 0;
        if (!same || !t->items[i].module)
            continue;
        tn_watch_tell(t->m->module->watch, (double)(t->changes->count + i), (double)(2 * t->changes->count));
        status = tn_watch_check(t->m->module->watch, error);
        if (status == TN_OK)
            status = measure_change(t, i, error);
    }
    return status;
}

static tn_status measure_all(trying *t, tn_error *error)
{
    tn_covered *covered = t->m->covered;
    size_t count = t->changes->count;
    tn_status status = open_library(t, error);
    if (status == TN_OK)
        status = tn_coverage_new(covered->schema, t->library, t->classes, covered->max, t->m->options->max_states,
                                 &t->coverage, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        if (t->items[i].module)
            status = measure_group(t, i, error);
    return status;
}

static void clear(trying *t)
{
    for (size_t i = 0; t->items && i < t->changes->count; i++)
        tn_module_free(t->items[i].module);
    tn_coverage_free(t->coverage);
    tn_library_free(t->library);
    tn_classes_free(t->classes);
    tn_noticing_free(t->noticing);
    free(t->items);
    free(t->rules);
}

tn_status tn_measure_changes(tn_covering *m, tn_error *error)
{
    trying t = {.m = m,
                .scope = {.opened = m->opened,
                          .schema = m->schema_index,
                          .library = m->library,
                          .imported = m->options->imported,
                          .most = TN_COVERAGE_CHANGES},
                .changes = &m->covered->changes};
    tn_status status = find_rules(&t, error);
    if (status == TN_OK)
        status = tn_changes_list(&t.scope, &m->covered->changes, error);
    if (status == TN_OK)
        status = tn_noticing_new(m->opened, m->covered->schema, &t.noticing, error);
    t.items = status == TN_OK ? calloc(t.changes->count + 1, sizeof *t.items) : NULL;
    if (status == TN_OK && !t.items)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = try_all(&t, error);
    if (status == TN_OK)
        status = measure_all(&t, error);
    clear(&t);
    return status;
}
