/* Counts the houses of a library, and names them: plan by plan, each plan's houses one after another. */
#include "cli/house/numbered_parts.h"

#include <stdlib.h>
#include <string.h>

static bool choose(tn_numbered *n, const char *name)
{
    const tn_module *module = n->job->opened.module;
    uint32_t found = tn_house_library_find(module, name);
    if (found != TN_NO_RECORD) {
        n->record = &module->HOUSE_LIBRARY_records[found];
        return true;
    }
    tn_diagnostic *d =
        name ? tn_job_usage(n->job, "the file has no library of houses `%.80s`", name)
             : tn_job_usage(n->job, module->HOUSE_LIBRARY_count ? "the file has several libraries of houses"
                                                                : "the file has no library of houses");
    tn_help(tn_job_diagnostics(n->job), d,
            module->HOUSE_LIBRARY_count ? "say which: --library NAME"
                                        : "a library of houses is `library NAME from PLANS in FORM { ... }`");
    return false;
}

bool tn_numbered_open(tn_numbered *n, tn_job *job, const tn_house_settings *settings)
{
    tn_error error;
    *n = (tn_numbered){.job = job};
    if (!choose(n, settings->library))
        return false;
    const tn_module *module = job->opened.module;
    tn_status status = tn_schema_new(module, module->FORM_records[n->record->form].schema, 0, &n->schema, &error);
    if (status == TN_OK) {
        tn_form_ready(module, n->record->form, n->schema, &n->form);
        status = tn_house_variants_new(&n->form, n->record, 0, &n->variants, &error);
    }
    if (status == TN_OK)
        status = tn_library_new(n->schema, n->record->plans, &settings->plans, &n->plans, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_numbered_close(tn_numbered *n)
{
    tn_house_variants_free(n->variants);
    tn_library_free(n->plans);
    tn_schema_free(n->schema);
}

bool tn_job_takes_houses(tn_job *job, const char *output)
{
    const char *ending = output ? strrchr(output, '.') : NULL;
    if (!ending || (strcmp(ending, ".sqlite") != 0 && strcmp(ending, ".sqlite3") != 0 && strcmp(ending, ".db") != 0))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "houses are written as lines, not into a database");
    tn_help(tn_job_diagnostics(job), d, "give the file another ending, such as .txt");
    return false;
}

void tn_numbered_bad_text(tn_job *job, tn_error *error, const char *name, const char *text)
{
    if (error->status != TN_INVALID) {
        tn_job_fail(job, error);
        return;
    }
    tn_error_place(error, error->column ? 1 : 0, error->column, error->column_end);
    tn_report_error(tn_job_diagnostics(job), error, name, text, strlen(text));
    tn_job_status(job, error->status);
}

/* ---- plans by rank */

/* The plan of a rank, whose digits end at `end`; trays: room for the longest. */
static tn_status plan_of_rank(const tn_numbered *n, const char *digits, size_t size, tn_tray *trays, uint32_t *length,
                              tn_error *error)
{
    mpz_t rank;
    char *text = strndup(digits, size);
    if (!text)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    mpz_init(rank);
    if (size == 0 || strspn(text, "0123456789") != size || mpz_set_str(rank, text, 10) != 0) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "a plan's rank is a whole number from 0, not `%.60s`", text);
        tn_error_help(error, "a house is #P:V: the plan's rank, and its place among the houses on that plan");
    } else if (!tn_library_unrank(n->plans, rank, trays, length)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library has no plan of rank %.60s", text);
        tn_library_kept(n->plans, TN_ALL_LENGTHS, rank);
        char *kept = mpz_get_str(NULL, 10, rank);
        tn_error_help(error, "it holds %.80s plans, and ranks count from 0", kept ? kept : "fewer");
        free(kept);
    }
    mpz_clear(rank);
    free(text);
    return status;
}

static tn_tray *tray_room(const tn_numbered *n, tn_error *error)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(n->plans) + 1));
    if (!trays)
        tn_fail_memory(error);
    return trays;
}

/* The plan of a line or of #P, one of the library's. */
tn_status tn_numbered_plan(tn_numbered *n, const char *text, size_t max_length, tn_plan *plan, tn_error *error)
{
    uint32_t length = 0;
    mpz_t rank;
    *plan = (tn_plan){0};
    if (text[0] == '#') {
        plan->trays = tray_room(n, error);
        if (!plan->trays)
            return TN_MEMORY;
        tn_status status = plan_of_rank(n, text + 1, strlen(text) - 1, plan->trays, &length, error);
        plan->length = length;
        return status;
    }
    mpz_init(rank);
    tn_status status = tn_plan_parse_line(n->schema, text, strlen(text), max_length, plan, error);
    if (status == TN_OK && !tn_library_rank(n->plans, plan->trays, plan->length, rank)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the plan is none of the library's");
        tn_error_help(error, "`tartan rank` says why, with --library and the library of plans");
    }
    mpz_clear(rank);
    return status;
}

static tn_status too_many_plans(const mpz_t plans, tn_error *error)
{
    char *digits = mpz_get_str(NULL, 10, plans);
    tn_status status =
        tn_fail(error, TN_LIMIT, E_VARIANTS, "the library has %.80s plans, too many to go through: the limit is %u",
                digits ? digits : "more", TN_HOUSE_PLANS_MAX);
    tn_error_help(error,
                  "ask about one plan (--plan PLAN or '#P'; #P:V names a house on it), or make a library of houses "
                  "from a smaller library of plans");
    free(digits);
    return status;
}

tn_status tn_numbered_plans(tn_numbered *n, tn_plan_visit *visit, void *context, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, kept);
    tn_status status = mpz_cmp_ui(kept, TN_HOUSE_PLANS_MAX) > 0 ? too_many_plans(kept, error)
                                                                : tn_numbered_plans_until(n, visit, context, error);
    mpz_clear(kept);
    return status;
}

tn_status tn_numbered_plans_until(tn_numbered *n, tn_plan_visit *visit, void *context, tn_error *error)
{
    tn_cursor *cursor = NULL;
    const tn_tray *trays;
    uint32_t length;
    bool stop = false;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, to);
    tn_status status = tn_cursor_new(n->plans, from, to, &cursor, error);
    while (status == TN_OK && !stop && tn_cursor_next(cursor, &trays, &length))
        status = visit(n, context, trays, length, &stop, error);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return status;
}

/* ---- counting */

typedef struct house_tally {
    uint64_t plans, with_houses;
    tn_house_counts counts;
    mpz_t *lengths; /* houses on plans of each length, from the shortest */
    uint32_t low, high;
} house_tally;

static tn_status tally_plan(tn_numbered *n, const tn_tray *trays, uint32_t length, house_tally *tally, tn_error *error)
{
    mpz_t before;
    mpz_init_set(before, tally->counts.houses);
    tn_status status = tn_house_variants_count(n->variants, trays, length, &tally->counts, error);
    tally->plans++;
    tally->with_houses += mpz_cmp(before, tally->counts.houses) != 0;
    mpz_sub(before, tally->counts.houses, before);
    if (length >= tally->low && length <= tally->high)
        mpz_add(tally->lengths[length - tally->low], tally->lengths[length - tally->low], before);
    mpz_clear(before);
    return status;
}

static tn_status tally_next(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                            tn_error *error)
{
    (void)stop;
    return tally_plan(n, trays, length, context, error);
}

static tn_status tally_text(tn_numbered *n, const char *text, size_t max_length, house_tally *tally, tn_error *error)
{
    tn_plan plan;
    tn_status status = tn_numbered_plan(n, text, max_length, &plan, error);
    if (status == TN_OK)
        status = tally_plan(n, plan.trays, (uint32_t)plan.length, tally, error);
    free(plan.trays);
    return status;
}

static void write_tally(const tn_numbered *n, const house_tally *tally, bool json, FILE *out)
{
    static const char *const names[] = {"plans", "plans_with_houses", "zoned", "faced"};
    static const char *const words[] = {"plans", "with a house", "sections and functions", "with openings"};
    const uint64_t numbers[] = {tally->plans, tally->with_houses, tally->counts.zoned, tally->counts.faced};
    fputs(json ? "{" : "", out);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (json)
            fprintf(out, "\"%s\":\"%llu\",", names[i], (unsigned long long)numbers[i]);
        else
            fprintf(out, "%-24s%llu\n", words[i], (unsigned long long)numbers[i]);
    }
    if (json)
        gmp_fprintf(out, "\"library\":\"%s\",\"houses\":\"%Zd\",\"by_length\":{",
                    tn_text(n->job->opened.module, n->record->name), tally->counts.houses);
    else
        gmp_fprintf(out, "%-24s%Zd\n", "houses", tally->counts.houses);
    bool first = true;
    for (uint32_t i = 0; i <= tally->high - tally->low; i++) {
        if (mpz_sgn(tally->lengths[i]) == 0)
            continue;
        char label[40];
        snprintf(label, sizeof label, "  of %u tray%s", tally->low + i, tally->low + i == 1 ? "" : "s");
        if (json)
            gmp_fprintf(out, "%s\"%u\":\"%Zd\"", first ? "" : ",", tally->low + i, tally->lengths[i]);
        else
            gmp_fprintf(out, "%-24s%Zd\n", label, tally->lengths[i]);
        first = false;
    }
    fputs(json ? "}}\n" : "", out);
}

static bool tally_new(const tn_numbered *n, house_tally *tally)
{
    *tally = (house_tally){.low = tn_library_min(n->plans), .high = tn_library_max(n->plans)};
    size_t count = (size_t)tally->high - tally->low + 1;
    tally->lengths = malloc(count * sizeof *tally->lengths);
    for (size_t i = 0; tally->lengths && i < count; i++)
        mpz_init(tally->lengths[i]);
    tn_house_counts_init(&tally->counts);
    return tally->lengths != NULL;
}

static void tally_free(house_tally *tally)
{
    for (size_t i = 0; tally->lengths && i <= tally->high - tally->low; i++)
        mpz_clear(tally->lengths[i]);
    free(tally->lengths);
    tn_house_counts_clear(&tally->counts);
}

void tn_job_count_houses(tn_job *job, const tn_house_settings *settings, const char *plan, bool json,
                         const char *output)
{
    tn_numbered n;
    house_tally tally = {0};
    tn_error error = {0};
    tn_output out;
    if (!tn_numbered_open(&n, job, settings)) {
        tn_numbered_close(&n);
        return;
    }
    tn_status status = tally_new(&n, &tally) ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = plan ? tally_text(&n, plan, settings->max_length, &tally, &error)
                      : tn_numbered_plans(&n, tally_next, &tally, &error);
    if (status != TN_OK) {
        tn_numbered_bad_text(job, &error, "PLAN", plan ? plan : "");
    } else if (tn_job_output(job, output, &out)) {
        write_tally(&n, &tally, json, out.stream);
        tn_job_commit(job, &out);
    }
    tally_free(&tally);
    tn_numbered_close(&n);
}

/* ---- names */

static tn_status name_house(tn_numbered *n, const char *line, size_t max_length, mpz_t plan, mpz_t variant,
                            tn_error *error)
{
    tn_house house;
    tn_status status = tn_house_read(&n->form, line, strlen(line), max_length, &house, error);
    if (status == TN_OK && !tn_library_rank(n->plans, house.trays, house.length, plan)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not hold the plan of this house");
        tn_error_help(error, "`tartan explain` says which clauses drop it");
    }
    if (status == TN_OK)
        status = tn_house_variants_rank(n->variants, &house, variant, error);
    tn_house_clear(&house);
    return status;
}

void tn_job_rank_house(tn_job *job, const tn_house_settings *settings, const char *line)
{
    tn_numbered n;
    tn_error error = {0};
    tn_output out;
    mpz_t plan, variant;
    mpz_inits(plan, variant, NULL);
    if (tn_numbered_open(&n, job, settings)) {
        if (name_house(&n, line, settings->max_length, plan, variant, &error) != TN_OK) {
            tn_numbered_bad_text(job, &error, "HOUSE", line);
        } else if (tn_job_output(job, NULL, &out)) {
            gmp_fprintf(out.stream, "#%Zd:%Zd\n", plan, variant);
            tn_job_commit(job, &out);
        }
    }
    tn_numbered_close(&n);
    mpz_clears(plan, variant, NULL);
}

bool tn_is_house_number(const char *text)
{
    size_t digits = strspn(text, "0123456789");
    return text[0] == '#' || (digits > 0 && text[digits] == ':');
}

typedef struct tn_house_search {
    mpz_t left; /* houses before the wanted one, on the plans to come */
    tn_house *house;
    bool found;
} tn_house_search;

static tn_status search_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                             tn_error *error)
{
    tn_house_search *s = context;
    tn_house_counts counts;
    tn_house_counts_init(&counts);
    tn_status status = tn_house_variants_count(n->variants, trays, length, &counts, error);
    *stop = s->found = status == TN_OK && mpz_cmp(s->left, counts.houses) < 0;
    if (s->found)
        status = tn_house_variants_at(n->variants, trays, length, s->left, s->house, error);
    else
        mpz_sub(s->left, s->left, counts.houses);
    tn_house_counts_clear(&counts);
    return status;
}

/* The house that `rank` others come before: plan by plan, the houses before it are counted. */
static tn_status house_of_rank(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    tn_house_search s = {.house = house};
    mpz_init_set(s.left, rank);
    tn_status status = tn_numbered_plans(n, search_plan, &s, error);
    if (status == TN_OK && !s.found) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library has fewer houses than that");
        tn_error_help(error, "`tartan count` says how many; ranks count from 0");
    }
    mpz_clear(s.left);
    return status;
}

static tn_status house_of_digits(tn_numbered *n, const char *digits, tn_house *house, tn_error *error)
{
    mpz_t rank;
    if (!*digits || digits[strspn(digits, "0123456789")]) {
        tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "`#%.60s` names no house", digits);
        tn_error_help(error, "a house is #P:V, the plan's rank and its place among the houses on that plan, or #R, its "
                             "rank among all houses");
        return status;
    }
    mpz_init_set_str(rank, digits, 10);
    tn_status status = house_of_rank(n, rank, house, error);
    mpz_clear(rank);
    return status;
}

tn_status tn_numbered_house(tn_numbered *n, const char *number, tn_house *house, tn_error *error)
{
    number += number[0] == '#';
    const char *colon = strchr(number, ':');
    mpz_t variant;
    uint32_t length = 0;
    *house = (tn_house){0};
    if (!colon)
        return house_of_digits(n, number, house, error);
    tn_tray *trays = tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    mpz_init(variant);
    tn_status status = plan_of_rank(n, number, (size_t)(colon - number), trays, &length, error);
    if (status == TN_OK && (!colon[1] || strspn(colon + 1, "0123456789") != strlen(colon + 1) ||
                            mpz_set_str(variant, colon + 1, 10) != 0)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "a variant is a whole number from 0, not `%.60s`", colon + 1);
        tn_error_help(error, "a house is #P:V: the plan's rank, and its place among the houses on that plan");
    }
    if (status == TN_OK)
        status = tn_house_variants_at(n->variants, trays, length, variant, house, error);
    mpz_clear(variant);
    free(trays);
    return status;
}

void tn_job_use_house(tn_job *job, const tn_house_settings *settings, const char *number, tn_house_use *use)
{
    tn_numbered n;
    tn_error error = {0};
    if (tn_numbered_open(&n, job, settings)) {
        tn_house house;
        if (tn_numbered_house(&n, number, &house, &error) == TN_OK)
            use(job, &house);
        else
            tn_job_fail(job, &error);
        tn_house_clear(&house);
    }
    tn_numbered_close(&n);
}

static void write_line(tn_job *job, const tn_house *house)
{
    tn_buffer line = {0};
    tn_error error = {0};
    tn_output out;
    tn_status status = tn_house_write(house, &line, &error);
    if (status == TN_OK && !tn_buffer_append(&line, "\n", 1))
        status = tn_fail_memory(&error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &out)) {
        fwrite(line.data, 1, line.size, out.stream);
        tn_job_commit(job, &out);
    }
    free(line.data);
}

void tn_job_unrank_house(tn_job *job, const tn_house_settings *settings, const char *number)
{
    tn_job_use_house(job, settings, number, write_line);
}
