/* The C interface to open plans. */
#include "runtime/plan/measure/complete.h"

#include <stdlib.h>

#include "api/plan/measure_data.h"

struct tartan_completions {
    const tn_schema *schema;
    tn_completions found;
    char *plans;
    char **counts, **bests; /* [trays][values]; bests NULL without a wish */
};

void tartan_completions_free(tartan_completions *completions)
{
    if (!completions)
        return;
    size_t count = (size_t)completions->found.trays * completions->found.values;
    for (size_t i = 0; i < count; i++) {
        free(completions->counts ? completions->counts[i] : NULL);
        free(completions->bests ? completions->bests[i] : NULL);
    }
    free(completions->counts);
    free(completions->bests);
    free(completions->plans);
    tn_completions_clear(&completions->found);
    free(completions);
}

static tartan_status write_texts(tartan_completions *made, const tn_api_wishes *wishes, tartan_error *error)
{
    size_t count = (size_t)made->found.trays * made->found.values;
    made->counts = calloc(count + 1, sizeof *made->counts);
    made->bests = wishes->weighed ? calloc(count + 1, sizeof *made->bests) : NULL;
    if (!made->counts || (wishes->weighed && !made->bests))
        return tn_api_memory(error);
    tartan_status status = tn_api_decimal(made->found.plans, &made->plans, error);
    for (size_t i = 0; status == TARTAN_OK && i < count; i++) {
        status = tn_api_decimal(made->found.counts[i], &made->counts[i], error);
        if (status == TARTAN_OK && made->bests && made->found.best[i] != TN_NO_BEST)
            status = tn_api_wish_value(wishes, 0, &made->found.best[i], &made->bests[i], error);
    }
    return status;
}

static tartan_status find(const tartan_library *library, const tartan_open_tray *places, size_t count,
                          const tn_api_wishes *wishes, tartan_completions *made, tartan_error *error)
{
    tn_open_tray *open = calloc(count + 1, sizeof *open);
    tn_error found;
    if (!open)
        return tn_api_memory(error);
    for (size_t i = 0; i < count; i++)
        open[i] = (tn_open_tray){places[i].fits, places[i].gap};
    const tn_open_plan plan = {.trays = open, .count = count, .weighed = wishes->weighed, .most = wishes->most[0]};
    tn_status status = tn_complete(&made->found, library->library, &plan, &found);
    free(open);
    return status == TN_OK ? write_texts(made, wishes, error) : tn_api_fail(&found, error);
}

tartan_status tartan_completions_new(const tartan_library *library, const tartan_open_tray *places, size_t count,
                                     const tartan_wish *wish, tartan_completions **completions, tartan_error *error)
{
    tn_api_wishes wishes = {0};
    if (!library || (count && !places))
        return tn_api_missing(error, library ? "array of places" : "library");
    tartan_status status = wish ? tn_api_wishes_take(library, wish, 1, 1, &wishes, error) : TARTAN_OK;
    tartan_completions *made = NULL;
    if (status == TARTAN_OK) {
        made = calloc(1, sizeof *made);
        status = made ? TARTAN_OK : tn_api_memory(error);
    }
    if (status == TARTAN_OK) {
        made->schema = library->schema;
        status = find(library, places, count, &wishes, made, error);
    }
    tn_api_wishes_clear(&wishes);
    if (status == TARTAN_OK)
        *completions = made;
    else
        tartan_completions_free(made);
    return status;
}

const char *tartan_completions_plans(const tartan_completions *completions)
{
    return completions->plans;
}

size_t tartan_completions_count(const tartan_completions *completions, size_t place)
{
    return place < completions->found.trays ? completions->found.values : 0;
}

tartan_status tartan_completions_choice(const tartan_completions *completions, size_t place, size_t i,
                                        tartan_choice *choice, tartan_error *error)
{
    if (!completions || !choice)
        return tn_api_missing(error, completions ? "choice to fill" : "object of completions");
    if (i >= tartan_completions_count(completions, place))
        return tn_api_refuse(error, TARTAN_INVALID, "there is no choice %zu at place %zu", i, place);
    const tn_schema *schema = completions->schema;
    size_t at = place * completions->found.values + i;
    uint32_t field = 0;
    while (schema->value_start[field + 1] <= i)
        field++;
    *choice = (tartan_choice){tn_text(schema->module, schema->fields[field].name),
                              tn_text(schema->module, schema->values[i].spelling), completions->counts[at],
                              completions->bests ? completions->bests[at] : NULL};
    return TARTAN_OK;
}
