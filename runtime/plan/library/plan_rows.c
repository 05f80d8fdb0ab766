/* Counts and ranks rows of plans. */
#include "runtime/plan/library/plan_rows.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/library_data.h"

struct tn_plan_rows {
    const tn_library *library;
    uint32_t first_record;
    mpz_t *plans; /* [records]: for how many plans the trays of each record stand */
    size_t records;
    mpz_t *columns; /* [columns]: for how many all trays of a column do */
    mpz_t *rows;    /* [max + 1][states]: rows of plans by trays to come */
    size_t row_count;
    mpz_t *before; /* [max + 2]: rows of plans of the lengths below */
};

static mpz_ptr rows_at(const tn_plan_rows *r, uint32_t left, uint32_t state)
{
    return r->rows[(size_t)left * r->library->kept->states + state];
}

mpz_srcptr tn_plan_rows_of_tray(const tn_plan_rows *r, tn_tray tray)
{
    return r->plans[r->library->schema->tray_plans[tray] - r->first_record];
}

/* ---- counting */

static tn_status read_plans(tn_plan_rows *r, tn_error *error)
{
    const tn_schema *schema = r->library->schema;
    const tn_module *module = schema->module;
    r->first_record = schema->record->tray_plans_first;
    r->records = schema->record->tray_plans_count;
    r->plans = tn_integers_new(r->records);
    r->columns = tn_integers_new(r->library->kept->columns);
    if (!r->plans || !r->columns)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < r->records; i++)
        mpz_set_str(r->plans[i], tn_text(module, module->TRAY_PLANS_records[r->first_record + i].plans), 10);
    for (tn_tray t = 0; t < schema->tray_count; t++) {
        mpz_ptr column = r->columns[r->library->tray_column[t]];
        mpz_add(column, column, tn_plan_rows_of_tray(r, t));
    }
    return TN_OK;
}

/* They grow with the trays to come: half as large in the mean. */
static tn_status make_room(tn_plan_rows *r, tn_error *error)
{
    const tn_library *library = r->library;
    mpz_t all;
    mpz_init(all);
    for (uint32_t c = 0; c < library->kept->columns; c++)
        mpz_add(all, all, r->columns[c]);
    uint64_t each = sizeof(mpz_t) + 16 + (uint64_t)mpz_sizeinbase(all, 2) * library->max / 16;
    mpz_clear(all);
    uint64_t cells = ((uint64_t)library->max + 1) * library->kept->states;
    uint64_t bytes = cells > UINT64_MAX / 4 / each ? UINT64_MAX / 4 : cells * each;
    tn_status status = tn_watch_room(library->schema->module->watch, bytes, "counting rows of plans", error);
    if (status == TN_LIMIT)
        tn_error_help(error, "give fewer trays with --trays, or raise the limit with --memory-limit");
    if (status != TN_OK)
        return status;
    r->row_count = tn_as_size(cells);
    r->rows = tn_integers_new(r->row_count);
    r->before = tn_integers_new((size_t)library->max + 2);
    return r->rows && r->before ? TN_OK : tn_fail_memory(error);
}

static void count_state(const tn_plan_rows *r, uint32_t left, uint32_t state)
{
    const tn_dfa *kept = r->library->kept;
    mpz_ptr rows = rows_at(r, left, state);
    if (left == 0)
        mpz_set_ui(rows, 1);
    for (uint32_t c = 0; left > 0 && c < kept->columns; c++)
        mpz_addmul(rows, r->columns[c], rows_at(r, left - 1, kept->delta[(size_t)state * kept->columns + c]));
}

static tn_status count_rows(tn_plan_rows *r, tn_error *error)
{
    const tn_library *library = r->library;
    tn_status status = TN_OK;
    for (uint32_t left = 0; status == TN_OK && left <= library->max; left++) {
        for (uint32_t s = 0; s < library->kept->states; s++)
            if (tn_library_alive(library, left, s))
                count_state(r, left, s);
        mpz_set(r->before[left + 1], r->before[left]);
        if (left >= library->min)
            mpz_add(r->before[left + 1], r->before[left + 1], rows_at(r, left, 0));
        status = tn_watch_check(library->schema->module->watch, error);
    }
    return status;
}

tn_status tn_plan_rows_new(const tn_library *library, tn_plan_rows **out, tn_error *error)
{
    tn_plan_rows *r = calloc(1, sizeof *r);
    *out = r;
    if (!r)
        return tn_fail_memory(error);
    r->library = library;
    tn_status status = read_plans(r, error);
    if (status == TN_OK)
        status = make_room(r, error);
    if (status == TN_OK)
        status = count_rows(r, error);
    if (status != TN_OK) {
        tn_plan_rows_free(r);
        *out = NULL;
    }
    return status;
}

void tn_plan_rows_free(tn_plan_rows *r)
{
    if (!r)
        return;
    tn_integers_free(r->plans, r->records);
    tn_integers_free(r->columns, r->library->kept->columns);
    tn_integers_free(r->rows, r->row_count);
    tn_integers_free(r->before, (size_t)r->library->max + 2);
    free(r);
}

void tn_plan_rows_count(const tn_plan_rows *r, uint32_t length, mpz_t count)
{
    const tn_library *library = r->library;
    if (length == TN_ALL_LENGTHS)
        mpz_set(count, r->before[library->max + 1]);
    else if (length >= library->min && length <= library->max)
        mpz_set(count, rows_at(r, length, 0));
    else
        mpz_set_ui(count, 0);
}

void tn_plan_rows_before(const tn_plan_rows *r, uint32_t length, mpz_t before)
{
    if (length == TN_ALL_LENGTHS || length > r->library->max)
        mpz_set_ui(before, 0);
    else
        mpz_set(before, r->before[length]);
}

/* ---- ranks */

/* Goes to the tray in whose rows the rank lies, among those that begin as `prefix` rows of plans do; the rank becomes
 * that among them. */
static tn_tray choose_tray(const tn_plan_rows *r, uint32_t *state, uint32_t left, mpz_t prefix, mpz_t rank)
{
    mpz_t rows;
    tn_tray tray = 0;
    mpz_init(rows);
    for (;; tray++) {
        uint32_t next = tn_library_step(r->library, *state, tray);
        mpz_mul(rows, tn_plan_rows_of_tray(r, tray), rows_at(r, left, next));
        mpz_mul(rows, rows, prefix);
        if (mpz_cmp(rank, rows) < 0) {
            *state = next;
            break;
        }
        mpz_sub(rank, rank, rows);
    }
    mpz_mul(prefix, prefix, tn_plan_rows_of_tray(r, tray));
    mpz_clear(rows);
    return tray;
}

bool tn_plan_rows_unrank(const tn_plan_rows *r, const mpz_t rank, tn_tray *trays, uint32_t *length, mpz_t *plans)
{
    const tn_library *library = r->library;
    if (mpz_sgn(rank) < 0 || mpz_cmp(rank, r->before[library->max + 1]) >= 0)
        return false;
    mpz_t rest, prefix;
    mpz_init_set_ui(prefix, 1);
    for (*length = library->min; mpz_cmp(rank, r->before[*length + 1]) >= 0;)
        ++*length;
    mpz_init(rest);
    mpz_sub(rest, rank, r->before[*length]);
    uint32_t state = 0;
    for (uint32_t i = 0; i < *length; i++)
        trays[i] = choose_tray(r, &state, *length - i - 1, prefix, rest);
    for (uint32_t i = *length; i-- > 0;)
        mpz_tdiv_qr(rest, plans[i], rest, tn_plan_rows_of_tray(r, trays[i]));
    mpz_clears(rest, prefix, NULL);
    return true;
}

/* Adds the rows of plans that have a tray before this one here, of those that begin as `prefix` rows of plans do. */
static void pass_trays(const tn_plan_rows *r, uint32_t state, tn_tray tray, uint32_t left, const mpz_t prefix,
                       mpz_t rank)
{
    mpz_t rows;
    mpz_init(rows);
    for (tn_tray t = 0; t < tray; t++) {
        mpz_mul(rows, tn_plan_rows_of_tray(r, t), rows_at(r, left, tn_library_step(r->library, state, t)));
        mpz_addmul(rank, rows, prefix);
    }
    mpz_clear(rows);
}

bool tn_plan_rows_rank(const tn_plan_rows *r, const tn_tray *trays, uint32_t length, const mpz_t *plans, mpz_t rank)
{
    if (!tn_library_has(r->library, trays, length))
        return false;
    mpz_t prefix, number;
    uint32_t state = 0;
    mpz_init_set_ui(prefix, 1);
    mpz_init(number);
    mpz_set(rank, r->before[length]);
    for (uint32_t i = 0; i < length; i++) {
        pass_trays(r, state, trays[i], length - i - 1, prefix, rank);
        state = tn_library_step(r->library, state, trays[i]);
        mpz_mul(prefix, prefix, tn_plan_rows_of_tray(r, trays[i]));
        mpz_mul(number, number, tn_plan_rows_of_tray(r, trays[i]));
        mpz_add(number, number, plans[i]);
    }
    mpz_add(rank, rank, number);
    mpz_clears(prefix, number, NULL);
    return true;
}
