/* Opens a library of houses, and goes through its plans. */
#include "ask/house/numbered.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/spelled.h"
#include "runtime/base/nearest.h"
#include "runtime/house/house.h"
#include "runtime/house/rule/stages.h"

tn_house_settings tn_asked_houses(const tn_library_asked *asked)
{
    return (tn_house_settings){.library = asked->library,
                               .max_length = tn_asked_length(asked),
                               .max_houses = asked->max_houses,
                               .plans = tn_asked_options(asked),
                               .wheres = asked->where.items,
                               .where_count = asked->where.count};
}

/* The library of houses that stands on the plans of that name, or NULL. */
static const char *on_plans(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        if (strcmp(tn_text(module, module->LIBRARY_records[library->plans].name), name) == 0)
            return tn_text(module, library->name);
    }
    return NULL;
}

static bool is_of_plans(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->LIBRARY_count; i++)
        if (strcmp(tn_text(module, module->LIBRARY_records[i].name), name) == 0)
            return true;
    return false;
}

static tn_status say_of_plans(tn_session *session, const char *name)
{
    const char *houses = on_plans(session->opened->module, name);
    char help[240];
    if (houses)
        snprintf(help, sizeof help, "`%.200s` has the houses on its plans", houses);
    else
        snprintf(help, sizeof help, "a library of houses is `library NAME from %.80s in FORM { ... }`", name);
    return tn_session_refuse(session, help, "`%.80s` is a library about plans, and one about houses is needed here",
                             name);
}

/* The names of the libraries of houses (malloc), or NULL. */
static const char **house_libraries(const tn_module *module)
{
    const char **names = calloc(module->HOUSE_LIBRARY_count + 1, sizeof *names);
    for (uint32_t i = 0; names && i < module->HOUSE_LIBRARY_count; i++)
        names[i] = tn_text(module, module->HOUSE_LIBRARY_records[i].name);
    return names;
}

tn_status tn_say_no_houses(tn_session *session, const char *name)
{
    const tn_module *module = session->opened->module;
    const char *path = session->opened->path;
    size_t count = module->HOUSE_LIBRARY_count;
    char all[240] = "", help[320];
    if (name && is_of_plans(module, name))
        return say_of_plans(session, name);
    const char **names = house_libraries(module);
    const char *near = name && names ? tn_nearest(name, names, count) : NULL;
    tn_word_list(names, names ? count : 0, all, sizeof all);
    if (near)
        snprintf(help, sizeof help, "did you mean `%.200s`?", near);
    else if (count > 0)
        snprintf(help, sizeof help, name ? "it has %s" : "say which, with --library NAME: %s", all);
    else
        snprintf(help, sizeof help, "a library of houses is `library NAME from PLANS in FORM { ... }`");
    free(names);
    if (name)
        return tn_session_refuse(session, help, "%.200s has no library of houses `%.80s`", path, name);
    return tn_session_refuse(
        session, help, count > 0 ? "%.200s has several libraries of houses" : "%.200s has no library of houses", path);
}

static tn_status choose(tn_numbered *n, const char *name)
{
    const tn_module *module = n->session->opened->module;
    uint32_t found = tn_house_library_find(module, name);
    if (found == TN_NO_RECORD)
        return tn_say_no_houses(n->session, name);
    n->record = &module->HOUSE_LIBRARY_records[found];
    return TN_OK;
}

tn_status tn_numbered_open(tn_numbered *n, tn_session *session, const tn_house_settings *settings)
{
    tn_error error;
    *n =
        (tn_numbered){.session = session, .max_states = settings->plans.max_states, .max_houses = settings->max_houses};
    tn_status status = choose(n, settings->library);
    if (status != TN_OK)
        return status;
    const tn_module *module = session->opened->module;
    status = tn_form_schema(module, n->record->form, &n->schema, &error);
    if (status == TN_OK) {
        tn_form_ready(module, n->record->form, n->schema, &n->form);
        status = tn_library_new(n->schema, n->record->plans, &settings->plans, &n->opened, &error);
    }
    n->plans = n->opened;
    if (status == TN_OK)
        status = tn_functions_walking(module, &n->walking, &error);
    if (status == TN_OK)
        status = tn_houses_check_walls(&n->form, n->record, n->plans, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

void tn_numbered_close(tn_numbered *n)
{
    tn_numbered_forget_ranks(n);
    tn_house_rules_free(n->rules);
    tn_houses_free(n->all);
    tn_house_listing_free(n->listing);
    tn_library_free(n->opened);
    tn_schema_free(n->schema);
    free(n->walking);
}

void tn_numbered_other(const tn_numbered *n, const tn_module *module, const tn_house_library_record *record,
                       const tn_library *plans, tn_numbered *other)
{
    *other = *n;
    other->form.module = module;
    other->record = record;
    other->plans = plans;
    other->opened = NULL;
    other->listing = NULL;
    other->rules = NULL;
    other->all = NULL;
    other->ranked = (tn_numbered_ranked){0};
    other->plans_alone = 0;
}

void tn_numbered_other_close(tn_numbered *other)
{
    tn_numbered_forget_ranks(other);
    tn_house_rules_free(other->rules);
    tn_houses_free(other->all);
    tn_house_listing_free(other->listing);
    *other = (tn_numbered){0};
}

static tn_status report_contradiction(const tn_numbered *n, const tn_house *house, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK)
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE,
                         "this house was found in `%.80s`, though the rules of the library keep it out: %.400s",
                         tn_text(n->form.module, n->record->name), line.data);
    if (status == TN_INTERNAL)
        tn_error_help(error, "this is a fault of Tartan, and other answers about the library may be wrong as well: "
                             "please report it with the file and the command");
    free(line.data);
    return status;
}

tn_status tn_numbered_keeps(tn_numbered *n, const tn_house *house, bool *kept, tn_error *error)
{
    tn_status status = n->rules ? TN_OK : tn_house_rules_new(&n->form, tn_library_max(n->plans), &n->rules, error);
    *kept = false;
    if (status == TN_OK)
        status = tn_house_rules_start(n->rules, house, error);
    return status == TN_OK ? tn_house_rules_keep(n->rules, n->record, kept, error) : status;
}

tn_status tn_numbered_judge(tn_numbered *n, const tn_house *house, tn_error *error)
{
    bool kept;
    tn_status status = tn_numbered_keeps(n, house, &kept, error);
    return status == TN_OK && !kept ? report_contradiction(n, house, error) : status;
}

/* ---- plans by rank */

tn_status tn_numbered_plan_of_rank(const tn_numbered *n, const char *digits, size_t size, tn_tray *trays,
                                   uint32_t *length, tn_error *error)
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

tn_tray *tn_numbered_tray_room(const tn_numbered *n, tn_error *error)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(n->plans) + 1));
    if (!trays)
        tn_fail_memory(error);
    return trays;
}

static tn_status plan_of_rank(tn_numbered *n, const char *text, tn_plan *plan, tn_error *error)
{
    uint32_t length = 0;
    plan->trays = tn_numbered_tray_room(n, error);
    if (!plan->trays)
        return TN_MEMORY;
    tn_status status = tn_numbered_plan_of_rank(n, text + 1, strlen(text) - 1, plan->trays, &length, error);
    plan->length = length;
    return status;
}

static tn_status check_plan(const tn_numbered *n, const tn_plan *plan, tn_error *error)
{
    mpz_t rank;
    mpz_init(rank);
    bool known = tn_library_rank(n->plans, plan->trays, plan->length, rank);
    mpz_clear(rank);
    if (known)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_NO_VARIANT, "the plan is none of the library's");
    tn_error_help(error, "`tartan rank` says why, with --library and the library of plans");
    return TN_INVALID;
}

tn_status tn_numbered_plan(tn_numbered *n, const char *text, size_t max_length, tn_plan *plan)
{
    tn_error error = {0};
    *plan = (tn_plan){0};
    tn_status status = TN_OK;
    if (text[0] == '#') {
        status = plan_of_rank(n, text, plan, &error);
    } else {
        status = tn_session_plan(n->session, n->schema, text, max_length, plan);
        if (status != TN_OK)
            return status;
        status = check_plan(n, plan, &error);
    }
    return status == TN_OK ? TN_OK : tn_session_bad_text(n->session, &error, "PLAN", text);
}

tn_status tn_numbered_open_on(tn_numbered *n, tn_session *session, const tn_library_asked *asked, const char *text,
                              tn_plan *plan)
{
    const tn_house_settings settings = tn_asked_houses(asked);
    *plan = (tn_plan){0};
    tn_status status = tn_numbered_open(n, session, &settings);
    return status == TN_OK && text ? tn_numbered_plan(n, text, settings.max_length, plan) : status;
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
    const char *name = tn_text(n->session->opened->module, n->record->name);
    if (found >= wanted || n->not_all)
        return;
    if (found > 0)
        tn_session_note(n->session,
                        "the library holds %" PRIu64 " house%s%s, fewer than the %" PRIu64 " asked for: these are all",
                        found, found == 1 ? "" : "s", on_plan ? " on this plan" : "", wanted);
    else if (on_plan)
        tn_session_note(
            n->session,
            "the library has no house on this plan: `tartan explain` with the plan and --library %s says why", name);
    else if (tn_numbered_walks(n))
        tn_session_note(n->session,
                        "the library holds no house: none that its other clauses keep is kept by those that ask for "
                        "walks");
    else
        tn_session_note(
            n->session,
            "the library holds no house: `tartan count` with --library %s and --clauses says what each clause "
            "keeps out, `tartan explain` with '#0:' what is wrong with the first plan",
            name);
}
