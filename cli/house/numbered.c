/* Opens a library of houses, and names them: each plan's houses one after another. */
#include "cli/house/numbered_parts.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "runtime/base/nearest.h"

/* A name that is one of plans, or near to one of houses; false where it is neither. */
static bool report_other(tn_job *job, const char *name)
{
    const tn_module *module = job->opened.module;
    const char *near = NULL, *names[1];
    tn_diagnostic *d = NULL;
    for (uint32_t i = 0; i < module->LIBRARY_count && !d; i++)
        if (strcmp(tn_text(module, module->LIBRARY_records[i].name), name) == 0)
            d = tn_job_usage(job, "`%.80s` is a library about plans, and one about houses is needed here", name);
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count && !near; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        names[0] = tn_text(module, library->name);
        bool on_them = strcmp(tn_text(module, module->LIBRARY_records[library->plans].name), name) == 0;
        near = d ? (on_them ? names[0] : NULL) : tn_nearest(name, names, 1);
    }
    if (d && near)
        tn_help(tn_job_diagnostics(job), d, "`%s` has the houses on its plans", near);
    else if (d)
        tn_help(tn_job_diagnostics(job), d, "a library of houses is `library NAME from %.80s in FORM { ... }`", name);
    else if (near)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "the file has no library of houses `%.80s`", name),
                "did you mean `%s`?", near);
    return d || near;
}

void tn_report_no_houses(tn_job *job, const char *name)
{
    bool any = job->opened.module->HOUSE_LIBRARY_count > 0;
    if (name && report_other(job, name))
        return;
    tn_diagnostic *d = name ? tn_job_usage(job, "the file has no library of houses `%.80s`", name)
                            : tn_job_usage(job, any ? "the file has several libraries of houses"
                                                    : "the file has no library of houses");
    tn_help(tn_job_diagnostics(job), d,
            any ? "say which: --library NAME" : "a library of houses is `library NAME from PLANS in FORM { ... }`");
}

static bool choose(tn_numbered *n, const char *name)
{
    const tn_module *module = n->job->opened.module;
    uint32_t found = tn_house_library_find(module, name);
    if (found != TN_NO_RECORD) {
        n->record = &module->HOUSE_LIBRARY_records[found];
        return true;
    }
    tn_report_no_houses(n->job, name);
    return false;
}

bool tn_numbered_open(tn_numbered *n, tn_job *job, const tn_house_settings *settings)
{
    tn_error error;
    *n = (tn_numbered){.job = job, .max_states = settings->plans.max_states};
    if (!choose(n, settings->library))
        return false;
    const tn_module *module = job->opened.module;
    tn_status status = tn_schema_new(module, module->FORM_records[n->record->form].schema, 0, &n->schema, &error);
    if (status == TN_OK) {
        tn_form_ready(module, n->record->form, n->schema, &n->form);
        status = tn_house_variants_new(&n->form, n->record, 0, &n->variants, &error);
    }
    if (status == TN_OK)
        status = tn_library_new(n->schema, n->record->plans, &settings->plans, &n->opened, &error);
    n->plans = n->opened;
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_numbered_close(tn_numbered *n)
{
    tn_numbered_forget_plan(n);
    tn_house_variants_free(n->quick);
    tn_houses_free(n->all);
    tn_house_variants_free(n->variants);
    tn_library_free(n->opened);
    tn_schema_free(n->schema);
}

tn_status tn_numbered_other(const tn_numbered *n, const tn_module *module, const tn_house_library_record *record,
                            const tn_library *plans, tn_numbered *other, tn_error *error)
{
    *other = *n;
    other->form.module = module;
    other->record = record;
    other->plans = plans;
    other->opened = NULL;
    other->variants = other->quick = NULL;
    other->all = NULL;
    other->on_plan = (tn_numbered_plan_found){0};
    return tn_house_variants_new(&other->form, record, 0, &other->variants, error);
}

void tn_numbered_other_close(tn_numbered *other)
{
    tn_numbered_forget_plan(other);
    tn_house_variants_free(other->quick);
    tn_houses_free(other->all);
    tn_house_variants_free(other->variants);
    *other = (tn_numbered){0};
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

tn_status tn_numbered_plans_from(tn_numbered *n, const mpz_t first, tn_plan_visit *visit, void *context,
                                 tn_error *error)
{
    tn_cursor *cursor = NULL;
    const tn_tray *trays;
    uint32_t length;
    bool stop = false;
    mpz_t to;
    mpz_init(to);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, to);
    tn_status status = tn_cursor_new(n->plans, first, to, &cursor, error);
    while (status == TN_OK && !stop && tn_cursor_next(cursor, &trays, &length))
        status = visit(n, context, trays, length, &stop, error);
    tn_cursor_free(cursor);
    mpz_clear(to);
    return status;
}

tn_status tn_numbered_plans_until(tn_numbered *n, tn_plan_visit *visit, void *context, tn_error *error)
{
    mpz_t first;
    mpz_init(first);
    tn_status status = tn_numbered_plans_from(n, first, visit, context, error);
    mpz_clear(first);
    return status;
}

/* ---- fewer houses than were asked for */

void tn_numbered_say_few(const tn_numbered *n, bool on_plan, uint64_t found, uint64_t wanted)
{
    const char *name = tn_text(n->job->opened.module, n->record->name);
    if (found >= wanted)
        return;
    if (found > 0)
        tn_job_note(n->job,
                    "the library holds %" PRIu64 " house%s%s, fewer than the %" PRIu64 " asked for: these are all",
                    found, found == 1 ? "" : "s", on_plan ? " on this plan" : "", wanted);
    else if (on_plan)
        tn_job_note(n->job,
                    "the library has no house on this plan: `tartan explain` with the plan and --library %s says why",
                    name);
    else
        tn_job_note(n->job,
                    "the library holds no house: `tartan count` with --library %s and --clauses says what each clause "
                    "keeps out, `tartan explain` with '#0' what is wrong with the first plan",
                    name);
}

/* ---- all houses */

tn_status tn_numbered_of(tn_numbered *n, const tn_houses_what *what, tn_houses **houses, tn_error *error)
{
    tn_progress progress;
    tn_progress_watch(&progress, "counting houses", tn_interrupt_waiting());
    tn_status status = tn_houses_of(&n->form, n->record, n->plans, what, n->max_states, houses, error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    return status;
}

tn_status tn_numbered_all(tn_numbered *n, tn_error *error)
{
    const tn_houses_what all = {0};
    return n->all ? TN_OK : tn_numbered_of(n, &all, &n->all, error);
}

tn_status tn_numbered_find(tn_houses *houses, mpz_t rank, tn_tray *trays, uint32_t *length, tn_error *error)
{
    tn_progress progress;
    tn_progress_watch(&progress, "looking for the plan", tn_interrupt_waiting());
    tn_status status = tn_houses_find(houses, rank, trays, length, error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    return status;
}

/* rest: the rank, of which the houses before its plan are taken. */
static tn_status locate(tn_numbered *n, mpz_t rest, mpz_t plan, tn_error *error)
{
    uint32_t length = 0;
    tn_tray *trays = tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    tn_status status = tn_numbered_find(n->all, rest, trays, &length, error);
    if (status == TN_OK && !tn_library_rank(n->plans, trays, length, plan))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house stands on a plan that is not in the library");
    free(trays);
    return status;
}

tn_status tn_numbered_locate(tn_numbered *n, const mpz_t rank, mpz_t plan, mpz_t before, tn_error *error)
{
    tn_status status = TN_OK;
    tn_houses_count(n->all, TN_ALL_LENGTHS, before);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, plan);
    if (mpz_cmp(rank, before) < 0) {
        mpz_t rest;
        mpz_init_set(rest, rank);
        status = locate(n, rest, plan, error);
        mpz_sub(before, rank, rest);
        mpz_clear(rest);
    }
    return status;
}

static bool at_most(const tn_numbered *n, unsigned long plans)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, kept);
    bool few = mpz_cmp_ui(kept, plans) <= 0;
    mpz_clear(kept);
    return few;
}

bool tn_numbered_few(const tn_numbered *n)
{
    return at_most(n, TN_HOUSE_PLANS_FEW);
}

bool tn_numbered_countable(const tn_numbered *n)
{
    return at_most(n, TN_HOUSE_PLANS_MAX);
}

/* ---- names */

/* variant := the rank among all houses, where that is wanted. */
static tn_status name_house(tn_numbered *n, const char *line, size_t max_length, bool of_all, mpz_t plan, mpz_t variant,
                            tn_error *error)
{
    tn_house house;
    tn_status status = tn_house_read(&n->form, line, strlen(line), max_length, &house, error);
    if (status == TN_OK && !tn_library_rank(n->plans, house.trays, house.length, plan)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not hold the plan of this house");
        tn_error_help(error, "`tartan explain` says which clauses drop it");
    }
    if (status == TN_OK && of_all)
        status = tn_numbered_all(n, error);
    if (status == TN_OK)
        status = tn_numbered_number(n, &house, variant, error);
    if (status == TN_OK && of_all) {
        status = tn_houses_before(n->all, house.trays, (uint32_t)house.length, plan, error);
        mpz_add(variant, variant, plan);
    }
    tn_house_clear(&house);
    return status;
}

void tn_job_rank_house(tn_job *job, const tn_house_settings *settings, const char *line, bool of_all)
{
    tn_numbered n;
    tn_error error = {0};
    tn_output out;
    mpz_t plan, variant;
    mpz_inits(plan, variant, NULL);
    if (tn_numbered_open(&n, job, settings)) {
        if (name_house(&n, line, settings->max_length, of_all, plan, variant, &error) != TN_OK) {
            tn_numbered_bad_text(job, &error, "HOUSE", line);
        } else if (tn_job_output(job, NULL, &out)) {
            if (of_all)
                gmp_fprintf(out.stream, "#%Zd\n", variant);
            else
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

/* Plan by plan, the houses before it are counted. */
static tn_status search_plans(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
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

static tn_status find_house(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    uint32_t length = 0;
    mpz_t rest;
    tn_tray *trays = tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    mpz_init_set(rest, rank);
    tn_status status = tn_numbered_find(n->all, rest, trays, &length, error);
    if (status == TN_OK)
        status = tn_numbered_at(n, trays, length, rest, house, error);
    mpz_clear(rest);
    free(trays);
    return status;
}

/* The house that `rank` others come before. */
static tn_status house_of_rank(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    tn_status status = tn_numbered_all(n, error);
    if (status == TN_OK)
        return find_house(n, rank, house, error);
    return status == TN_LIMIT && tn_numbered_countable(n) ? search_plans(n, rank, house, error) : status;
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
        status = tn_numbered_at(n, trays, length, variant, house, error);
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

static tn_status append_json(const tn_house *house, tn_buffer *out, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK) {
        tn_buffer_printf(out, "{\"house\":");
        tn_buffer_append_json(out, line.data);
        tn_buffer_printf(out, ",\"trays\":");
        tn_plan_write_trays(house->form->schema, house->trays, house->length, out);
        status = tn_house_write_members(house, out, error);
        tn_buffer_append(out, "}", 1);
    }
    free(line.data);
    return status;
}

static void write_house(tn_job *job, const tn_house *house, bool json)
{
    tn_buffer text = {0};
    tn_error error = {0};
    tn_output out;
    tn_status status = json ? append_json(house, &text, &error) : tn_house_write(house, &text, &error);
    if (status == TN_OK && !tn_buffer_append(&text, "\n", 1))
        status = tn_fail_memory(&error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &out)) {
        fwrite(text.data, 1, text.size, out.stream);
        tn_job_commit(job, &out);
    }
    free(text.data);
}

static void write_line(tn_job *job, const tn_house *house)
{
    write_house(job, house, false);
}

static void write_json(tn_job *job, const tn_house *house)
{
    write_house(job, house, true);
}

void tn_job_unrank_house(tn_job *job, const tn_house_settings *settings, const char *number, bool json)
{
    tn_job_use_house(job, settings, number, json ? write_json : write_line);
}
