/* Says which written tray of an open plan leaves no completion: it counts what begins as the open plan does, for longer
 * and longer beginnings. */
#include "ask/plan/best.h"

#include <stdlib.h>

#include "driver/open/digits.h"

/* The plans that begin with the first `count` parts; any trays may follow. `parts` has room for one more. */
static tn_status count_beginning(const tn_library *library, const tn_open_plan *open, size_t count, uint32_t *parts,
                                 mpz_t plans, tn_error *error)
{
    tn_completions found;
    bool gap = count > 0 && open->functions[count - 1] == TN_NO_RECORD;
    for (size_t i = 0; i < count; i++)
        parts[i] = open->functions[i];
    if (!gap)
        parts[count++] = TN_NO_RECORD;
    tn_status status = tn_complete(&found, library, &(tn_open_plan){.functions = parts, .count = count}, error);
    if (status == TN_OK)
        mpz_set(plans, found.plans);
    tn_completions_clear(&found);
    return status;
}

static bool say(const mpz_t plans, size_t trays, bool all, tn_buffer *text)
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

tn_status tn_complete_why(const tn_library *library, const tn_open_plan *open, tn_buffer *text, tn_error *error)
{
    uint32_t *parts = calloc(open->count + 1, sizeof *parts);
    tn_status status = parts ? TN_OK : tn_fail_memory(error);
    size_t trays = 0, i = 0;
    mpz_t before, plans;
    mpz_inits(before, plans, NULL);
    if (status == TN_OK)
        status = count_beginning(library, open, 0, parts, plans, error);
    bool empty = status == TN_OK && mpz_sgn(plans) == 0;
    for (; status == TN_OK && mpz_sgn(plans) > 0 && i < open->count; i++) {
        if (open->functions[i] == TN_NO_RECORD)
            continue;
        trays++;
        mpz_set(before, plans);
        status = count_beginning(library, open, i + 1, parts, plans, error);
    }
    if (status == TN_OK && empty)
        tn_buffer_printf(text, "the library holds no plan at all\n");
    else if (status == TN_OK && !say(mpz_sgn(plans) > 0 ? plans : before, trays, mpz_sgn(plans) > 0, text))
        status = tn_fail_memory(error);
    mpz_clears(before, plans, NULL);
    free(parts);
    return status == TN_OK && text->failed ? tn_fail_memory(error) : status;
}
