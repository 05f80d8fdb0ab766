/* Measures designs, and holds them to what they require. */
#include <stdlib.h>

#include "driver/solid/solid.h"
#include "runtime/base/bytes.h"
#include "runtime/number/run.h"

#define BARELY 1e-9 /* how far a strict comparison of equal values is from holding: no distance to tell anybody */

typedef struct testing {
    tn_opened *opened;
    const tn_module *module;
    uint32_t solid, most;
    tn_solid_measured_take *measured;
    void *context;
    double values[TN_SOLID_MEASURED_COUNT];
    const tn_solid_measure_record **listed; /* what the design asks for, each once; owned */
    size_t listed_count;
} testing;

static double value_of(const testing *t, uint32_t function)
{
    return tn_number_run(t->module->code, t->module->FUNCTION_records[function].code_begin, t->values);
}

/* Everything that the design's measures and requirements speak of. */
static uint64_t asked_of(const tn_module *module, const tn_solid_record *record)
{
    uint64_t asked = 0;
    for (uint32_t i = 0; i < record->asked_count; i++)
        asked |= tn_number_asked(module, module->SOLID_MEASURE_records[record->asked_first + i].function);
    for (uint32_t i = 0; i < record->requirement_count; i++)
        asked |= tn_number_asked(module, module->REQUIREMENT_records[record->requirement_first + i].holds);
    return asked;
}

/* A design and the one that it begins with may both ask for a measure: names are keys. Equal texts are one string of
 * the module. */
static tn_status list_measures(testing *t, tn_error *error)
{
    const tn_solid_record *record = &t->module->SOLID_records[t->solid];
    bool *seen = calloc(t->module->strings_size + 1, sizeof *seen);
    t->listed = malloc((record->asked_count + 1) * sizeof(const tn_solid_measure_record *));
    for (uint32_t i = 0; seen && t->listed && i < record->asked_count; i++) {
        const tn_solid_measure_record *asked = &t->module->SOLID_MEASURE_records[record->asked_first + i];
        if (!seen[asked->name])
            t->listed[t->listed_count++] = asked;
        seen[asked->name] = true;
    }
    bool fine = seen && t->listed;
    free(seen);
    return fine ? TN_OK : tn_fail_memory(error);
}

static tn_status tell_measures(const testing *t, tn_error *error)
{
    const char **names = malloc((t->listed_count + 1) * sizeof *names);
    double *values = malloc((t->listed_count + 1) * sizeof *values);
    tn_status status = names && values ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < t->listed_count; i++) {
        names[i] = tn_text(t->module, t->listed[i]->name);
        values[i] = value_of(t, t->listed[i]->function);
    }
    if (status == TN_OK)
        status = t->measured(t->context, tn_text(t->module, t->module->SOLID_records[t->solid].name), t->listed_count,
                             names, values, error);
    free(names);
    free(values);
    return status;
}

/* What was found of each measure that the requirement names: "parts is 3, height is 7.5". */
static void write_found(const testing *t, uint32_t function, char *text, size_t size)
{
    uint64_t asked = tn_number_asked(t->module, function);
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < TN_SOLID_MEASURED_COUNT && used < size; i++)
        if (asked >> i & 1)
            used += (size_t)snprintf(text + used, size - used, "%s%s is %.10g", used ? ", " : "",
                                     tn_solid_measured_names[i], tn_without_sign(t->values[i]));
}

static bool holds(const testing *t, uint32_t index)
{
    const tn_requirement_record *r = &t->module->REQUIREMENT_records[index];
    double value = value_of(t, r->holds), lacks = value_of(t, r->violation);
    char found[360];
    if (value - value == 0 && value != 0)
        return true;
    write_found(t, r->holds, found, sizeof found);
    tn_diagnostics *list = &t->opened->compilation.diagnostics;
    tn_diagnostic *d =
        tn_report(list, E_REQUIREMENT_FAILED, (tn_span){r->file, r->begin, r->end}, "`%.100s` does not meet this%s%s",
                  tn_text(t->module, t->module->SOLID_records[t->solid].name), *found ? ": " : "", found);
    if (lacks - lacks == 0 && lacks > BARELY)
        tn_note(list, d, NULL, "it is %.10g away from holding", lacks);
    return false;
}

static tn_status test_design(testing *t, tn_solid_tally *tally)
{
    const tn_solid_record *record = &t->module->SOLID_records[t->solid];
    tn_built built;
    tn_error error;
    tn_status status = tn_built_make(t->module, t->solid, t->most, &built, &error);
    if (status == TN_OK)
        status = tn_built_measure(&built, asked_of(t->module, record), t->values, &error);
    tn_built_clear(&built);
    if (status == TN_OK)
        status = list_measures(t, &error);
    if (status == TN_OK)
        status = tell_measures(t, &error);
    if (status != TN_OK)
        return tn_solid_fail(t->opened, t->solid, &error);
    for (uint32_t i = 0; i < record->requirement_count; i++) {
        bool held = holds(t, record->requirement_first + i);
        tally->passed += held;
        tally->failed += !held;
        status = held ? status : TN_INVALID;
    }
    return status;
}

tn_status tn_solid_tests_run(tn_opened *opened, uint32_t most, tn_solid_measured_take *measured, void *context,
                             tn_solid_tally *tally)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < opened->module->SOLID_count; i++) {
        if (opened->module->SOLID_records[i].flags & TN_SOLID_IMPORTED)
            continue;
        testing t = {.opened = opened,
                     .module = opened->module,
                     .solid = i,
                     .most = most,
                     .measured = measured,
                     .context = context};
        tn_status one = test_design(&t, tally);
        free(t.listed);
        status = status == TN_OK ? one : status;
    }
    return status;
}
