/* Why no plan of a library completes an open plan: the written tray that leaves none, and what prunes those that the
 * library generates. */
#include <stdlib.h>

#include "ask/plan/best.h"
#include "driver/open/digits.h"
#include "driver/plan/clauses.h"
#include "runtime/plan/text/text.h"

/* ---- which written tray leaves no completion: what begins as the open plan does is counted, for longer and longer
 * beginnings */

/* The plans that begin with the first `count` parts; any trays may follow. `parts` has room for one more. */
static tn_status count_beginning(const tn_library *library, const tn_open_plan *open, size_t count, tn_open_tray *parts,
                                 mpz_t plans, tn_error *error)
{
    tn_completions found;
    bool gap = count > 0 && open->trays[count - 1].gap;
    for (size_t i = 0; i < count; i++)
        parts[i] = open->trays[i];
    if (!gap)
        parts[count++] = (tn_open_tray){.gap = true};
    tn_status status = tn_complete(&found, library, &(tn_open_plan){.trays = parts, .count = count}, error);
    if (status == TN_OK)
        mpz_set(plans, found.plans);
    tn_completions_clear(&found);
    return status;
}

static bool say_why(const mpz_t plans, size_t trays, bool all, tn_buffer *text)
{
    char *digits = tn_digits(plans, true);
    bool one = mpz_cmp_ui(plans, 1) == 0;
    if (!digits)
        return false;
    if (all)
        tn_buffer_printf(text,
                         one ? "%s plan begins so, and it has more trays: `| ...` at the end lets it\n"
                             : "%s plans begin so, and all have more trays: `| ...` at the end lets them\n",
                         digits);
    else if (trays == 1)
        tn_buffer_printf(text, "no plan of the library has tray 1 as it is written\n");
    else
        tn_buffer_printf(text,
                         one ? "%s plan fits what is written before tray %zu, and it does not go on with it\n"
                             : "%s plans fit what is written before tray %zu, and none of them goes on with it\n",
                         digits, trays);
    free(digits);
    return true;
}

static tn_status say_tray(const tn_library *library, const tn_open_plan *open, tn_buffer *text, tn_error *error)
{
    tn_open_tray *parts = calloc(open->count + 1, sizeof *parts);
    tn_status status = parts ? TN_OK : tn_fail_memory(error);
    size_t trays = 0, i = 0;
    mpz_t before, plans;
    mpz_inits(before, plans, NULL);
    if (status == TN_OK)
        status = count_beginning(library, open, 0, parts, plans, error);
    bool empty = status == TN_OK && mpz_sgn(plans) == 0;
    for (; status == TN_OK && mpz_sgn(plans) > 0 && i < open->count; i++) {
        if (open->trays[i].gap)
            continue;
        trays++;
        mpz_set(before, plans);
        status = count_beginning(library, open, i + 1, parts, plans, error);
    }
    if (status == TN_OK && empty)
        tn_buffer_printf(text, "the library holds no plan at all\n");
    else if (status == TN_OK && !say_why(mpz_sgn(plans) > 0 ? plans : before, trays, mpz_sgn(plans) > 0, text))
        status = tn_fail_memory(error);
    mpz_clears(before, plans, NULL);
    free(parts);
    return status == TN_OK && text->failed ? tn_fail_memory(error) : status;
}

/* ---- which clauses prune what is generated */

/* Appends the names of the clauses that drop the plan. */
static tn_status say_clauses(const tn_ready_library *ready, const tn_completions *found, tn_buffer *text,
                             tn_error *error)
{
    const tn_module *module = ready->schema->module;
    const tn_library_record *record = ready->record;
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    uint64_t *bits = calloc(record->clause_count / 64 + 1, sizeof *bits);
    tn_status status = bits ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_clause_rules_new(ready->schema, record, &(tn_rules_options){0}, &rules, error);
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, error);
    if (status == TN_OK)
        status = tn_match(matcher, found->first, found->first_length, bits, error);
    const char *between = "";
    for (uint32_t i = 0; status == TN_OK && i < record->clause_count; i++) {
        if (!tn_clause_drops(module, record, i, bits))
            continue;
        tn_buffer_printf(text, "%s%s", between, tn_text(module, module->CLAUSE_records[record->clause_first + i].name));
        between = ", ";
    }
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    free(bits);
    return status;
}

static tn_status say_pruned(const tn_ready_library *ready, const tn_completions *found, tn_buffer *text,
                            tn_error *error)
{
    char *digits = tn_digits(found->plans, true);
    if (!digits)
        return tn_fail_memory(error);
    bool one = mpz_cmp_ui(found->plans, 1) == 0;
    tn_buffer_printf(text,
                     one ? "%s plan that is generated completes it, and is pruned: `"
                         : "%s plans that are generated complete it, and all are pruned; for example `",
                     digits);
    free(digits);
    tn_plan_write_line(ready->schema, found->first, found->first_length, text);
    tn_buffer_printf(text, "` by ");
    tn_status status = say_clauses(ready, found, text, error);
    tn_buffer_printf(text, "\n");
    return status;
}

/* The same library without its prunes may pass a limit: then nothing is said of them. */
static tn_status say_generated(const tn_ready_library *ready, const tn_open_plan *open, tn_buffer *text,
                               tn_error *error)
{
    const tn_library_options options = {.all_generated = true,
                                        .override_trays = true,
                                        .trays_min = tn_library_min(ready->library),
                                        .trays_max = tn_library_max(ready->library)};
    const tn_open_plan all = {.trays = open->trays, .count = open->count, .first = true};
    tn_library *library;
    tn_completions found;
    tn_status status = tn_library_new(ready->schema, ready->index, &options, &library, error);
    if (status != TN_OK)
        return status == TN_LIMIT ? TN_OK : status;
    status = tn_complete(&found, library, &all, error);
    if (status == TN_OK && mpz_sgn(found.plans) > 0)
        status = say_pruned(ready, &found, text, error);
    tn_completions_clear(&found);
    tn_library_free(library);
    return status;
}

tn_status tn_open_why_none(const tn_ready_library *ready, const tn_open_plan *open, tn_buffer *text, tn_error *error)
{
    tn_status status = say_tray(ready->library, open, text, error);
    if (status == TN_OK)
        status = say_generated(ready, open, text, error);
    if (text->size > 0)
        text->data[--text->size] = '\0';
    return status == TN_OK && text->failed ? tn_fail_memory(error) : status;
}
