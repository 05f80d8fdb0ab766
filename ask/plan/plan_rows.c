/* Finds, writes and reads rows of plans. */
#include "ask/plan/plan_rows.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"

static const tn_module *module_of(const tn_rows_of_plans *r)
{
    return r->session->opened->module;
}

static const char *library_name(const tn_rows_of_plans *r)
{
    return tn_text(module_of(r), r->ready->record->name);
}

/* ---- making ready */

static tn_status refuse_plain(const tn_rows_of_plans *r)
{
    return tn_session_refuse(r->session, "leave out --plans",
                             "--plans is about rows whose trays stand for plans, and a tray of `%s` is no plan",
                             library_name(r));
}

static tn_status make_ready(tn_rows_of_plans *r, const tn_library_asked *asked, tn_error *error)
{
    const tn_library_options given = tn_asked_options(asked);
    const tn_library_options options = {.max_states = given.max_states, .threads = given.threads};
    const tn_module *module = module_of(r);
    r->below.index = r->ready->schema->record->of;
    r->below.record = &module->LIBRARY_records[r->below.index];
    tn_status status = tn_schema_new(module, r->below.record->schema, 0, &r->below.schema, error);
    if (status == TN_OK)
        status = tn_library_new(r->below.schema, r->below.index, &options, &r->below.library, error);
    if (status == TN_OK)
        status = tn_plan_rows_new(r->ready->library, &r->rows, error);
    return status == TN_OK ? tn_standing_plans_new(r->below.library, r->ready->schema, &r->plans, error) : status;
}

static tn_status make_room(tn_rows_of_plans *r, tn_error *error)
{
    size_t most = (size_t)tn_library_max(r->ready->library) + 1;
    r->trays = calloc(most, sizeof *r->trays);
    r->numbers = tn_integers_new(most);
    r->stands = calloc((size_t)tn_library_max(r->below.library) + 1, sizeof *r->stands);
    return r->trays && r->numbers && r->stands ? TN_OK : tn_fail_memory(error);
}

tn_status tn_rows_open(tn_rows_of_plans *r, tn_session *session, const tn_ready_library *ready,
                       const tn_library_asked *asked)
{
    tn_error error;
    *r = (tn_rows_of_plans){.session = session, .ready = ready, .longest = tn_asked_length(asked)};
    if (!tn_schema_of_plans(ready->schema))
        return refuse_plain(r);
    tn_session_begins(session, "plans of trays counted");
    tn_status status = make_ready(r, asked, &error);
    tn_session_ends(session);
    if (status == TN_OK)
        status = make_room(r, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

void tn_rows_close(tn_rows_of_plans *r)
{
    tn_integers_free(r->numbers, r->rows ? (size_t)tn_library_max(r->ready->library) + 1 : 0);
    free(r->trays);
    free(r->stands);
    tn_standing_plans_free(r->plans);
    tn_plan_rows_free(r->rows);
    tn_library_close(&r->below);
    *r = (tn_rows_of_plans){0};
}

tn_status tn_rows_refuse_with(tn_session *session, const char *other)
{
    bool houses = other[0] != '-';
    return tn_session_refuse(session, "leave out one of them",
                             houses ? "--plans is about rows of plans, and this is about %s"
                                    : "--plans and %s exclude each other: a row of plans is no plan of the library",
                             other);
}

/* ---- the row of a rank */

bool tn_rows_find(tn_rows_of_plans *r, const mpz_t rank)
{
    return tn_plan_rows_unrank(r->rows, rank, r->trays, &r->length, r->numbers);
}

tn_status tn_rows_no_rank(const tn_rows_of_plans *r, const char *rank)
{
    mpz_t count;
    mpz_init(count);
    tn_plan_rows_count(r->rows, TN_ALL_LENGTHS, count);
    tn_status status = tn_session_no_rank_of(r->session, r->ready->record, count,
                                             (const char *const[2]){"row of plans", "rows of plans"}, rank);
    mpz_clear(count);
    return status;
}

/* The plan that stands at a place of the row, into `stands`. */
static tn_status find_plan(tn_rows_of_plans *r, uint32_t place, uint32_t *length, tn_error *error)
{
    return tn_standing_plans_unrank(r->plans, r->trays[place], r->numbers[place], r->stands, length, error);
}

static tn_status write_place(tn_rows_of_plans *r, uint32_t place, tn_buffer *line, tn_json *members, tn_error *error)
{
    uint32_t length;
    const tn_schema *schema = r->below.schema;
    tn_status status = find_plan(r, place, &length, error);
    if (status != TN_OK)
        return status;
    bool good = tn_buffer_append(line, place ? " | " : "", place ? 3 : 0) &&
                tn_plan_write_line(r->ready->schema, &r->trays[place], 1, line) && tn_buffer_append(line, " [", 2) &&
                tn_plan_write_line(schema, r->stands, length, line) && tn_buffer_append(line, "]", 1);
    tn_json_object(members, NULL);
    tn_plan_write_trays(schema, r->stands, length, members);
    tn_json_object_end(members);
    return good ? TN_OK : tn_fail_memory(error);
}

/* Its line, with an end; and its plans as a member of the object that is open. */
static tn_status write_row(tn_rows_of_plans *r, tn_buffer *line, tn_json *members, tn_error *error)
{
    tn_status status = TN_OK;
    tn_json_list(members, "plans");
    for (uint32_t i = 0; status == TN_OK && i < r->length; i++)
        status = write_place(r, i, line, members, error);
    tn_json_list_end(members);
    if (status == TN_OK && (!tn_buffer_append(line, "", 1) || members->text->failed))
        status = tn_fail_memory(error);
    return status;
}

tn_status tn_rows_texts(tn_rows_of_plans *r, char **line, char **members, tn_error *error)
{
    tn_buffer text = {0}, written = {0};
    tn_json json = tn_json_text(&written, TN_JSON_TIGHT);
    tn_plan_write_trays(r->ready->schema, r->trays, r->length, &json);
    tn_status status = write_row(r, &text, &json, error);
    *line = text.data;
    *members = written.data;
    return status;
}

tn_status tn_rows_give(tn_rows_of_plans *r, const mpz_t rank, tn_finds *finds, tn_error *error)
{
    tn_buffer line = {0}, plans = {0};
    tn_json json = tn_json_text(&plans, TN_JSON_TIGHT);
    if (!tn_rows_find(r, rank))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a row of plans is not in the library");
    tn_status status = write_row(r, &line, &json, error);
    const tn_found_one found = {
        .rank = rank, .trays = r->trays, .length = r->length, .row = line.data, .plans = plans.data};
    if (status == TN_OK)
        status = tn_finds_give(finds, &found, error);
    free(line.data);
    free(plans.data);
    return status;
}

/* ---- the rank of a row */

/* A text of a row that is read, up to its end. */
typedef struct reading {
    tn_rows_of_plans *rows;
    const char *text, *at;
} reading;

static size_t column_of(const reading *g, const char *at)
{
    return (size_t)(at - g->text) + 1;
}

static void skip_blanks(reading *g)
{
    g->at += strspn(g->at, " \t");
}

/* Reads a stretch as a plan; an error has its place in the whole text. */
static tn_status read_stretch(const reading *g, const tn_schema *schema, const char *begin, const char *end,
                              tn_plan *plan, tn_error *error)
{
    tn_status status = tn_plan_parse_line(schema, begin, (size_t)(end - begin), g->rows->longest, plan, error);
    if (status != TN_OK && error->column) {
        error->column += (size_t)(begin - g->text);
        error->column_end += error->column_end ? (size_t)(begin - g->text) : 0;
    }
    return status;
}

static tn_status wrong_at(const reading *g, const char *at, const char *what, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "%s", what);
    error->column = column_of(g, at);
    error->column_end = error->column + 1;
    tn_error_help(error, "a row of plans is a tray and its plan in brackets, then `|` and the next, as `tartan unrank "
                         "--plans` writes it");
    return TN_INVALID;
}

/* Reads a tray, up to its bracket. */
static tn_status read_tray(reading *g, tn_tray *tray, tn_error *error)
{
    const char *begin = g->at, *bracket = begin + strcspn(begin, "[|");
    tn_plan plan = {0};
    if (*bracket != '[')
        return wrong_at(g, bracket, "a tray is not followed by its plan in brackets", error);
    tn_status status = read_stretch(g, g->rows->ready->schema, begin, bracket, &plan, error);
    if (status == TN_OK && plan.length != 1)
        status = wrong_at(g, bracket, "no tray stands before this plan", error);
    if (status == TN_OK)
        *tray = plan.trays[0];
    free(plan.trays);
    g->at = bracket;
    return status;
}

/* Says why the tray that was read last does not stand for the plan in these brackets. */
static tn_status stands_not(const reading *g, bool kept, tn_error *error)
{
    const tn_ready_library *below = &g->rows->below;
    const char *name = tn_text(below->schema->module, below->record->name);
    if (kept)
        tn_fail(error, TN_INVALID, E_NOT_IN_LIBRARY, "the tray before this plan of `%s` does not stand for it", name);
    else
        tn_fail(error, TN_INVALID, E_NOT_IN_LIBRARY, "`%s` has no such plan", name);
    if (kept)
        tn_error_help(error, "what its fields say is not so of the plan");
    error->column = column_of(g, g->at);
    error->column_end = error->column + 1;
    return TN_INVALID;
}

/* Reads the plan in brackets of a tray, which has to stand for it, and finds its number. */
static tn_status read_plan(reading *g, tn_tray tray, mpz_t number, tn_error *error)
{
    tn_rows_of_plans *r = g->rows;
    const char *begin = g->at + 1, *end = begin + strcspn(begin, "]");
    tn_plan plan = {0};
    bool stands = false;
    if (!*end)
        return wrong_at(g, g->at, "this bracket is not closed", error);
    tn_status status = read_stretch(g, r->below.schema, begin, end, &plan, error);
    if (status == TN_OK)
        status = tn_standing_plans_rank(r->plans, tray, plan.trays, (uint32_t)plan.length, number, &stands, error);
    if (status == TN_OK && !stands)
        status = stands_not(g, tn_library_has(r->below.library, plan.trays, plan.length), error);
    free(plan.trays);
    g->at = end + 1;
    return status;
}

static tn_status read_place(reading *g, tn_error *error)
{
    tn_rows_of_plans *r = g->rows;
    if (r->length == tn_library_max(r->ready->library))
        return tn_fail(error, TN_INVALID, E_NOT_IN_LIBRARY, "rows of `%s` have at most %u trays", library_name(r),
                       tn_library_max(r->ready->library));
    tn_status status = read_tray(g, &r->trays[r->length], error);
    if (status == TN_OK)
        status = read_plan(g, r->trays[r->length], r->numbers[r->length], error);
    skip_blanks(g);
    r->length++;
    if (status != TN_OK || !*g->at)
        return status;
    if (*g->at != '|')
        return wrong_at(g, g->at, "`|` parts a plan from the next tray", error);
    g->at++;
    skip_blanks(g);
    return *g->at ? TN_OK : wrong_at(g, g->at, "a tray is missing here", error);
}

tn_status tn_rows_read(tn_rows_of_plans *r, const char *text)
{
    reading g = {.rows = r, .text = text, .at = text};
    tn_error error;
    tn_status status = TN_OK;
    r->length = 0;
    skip_blanks(&g);
    while (status == TN_OK && *g.at)
        status = read_place(&g, &error);
    return status == TN_OK ? TN_OK : tn_session_bad_text(r->session, &error, "ROW", text);
}
