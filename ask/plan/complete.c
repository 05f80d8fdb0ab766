/* complete: what may still be chosen in an open plan. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/completed.h"
#include "ask/plan/best.h"
#include "ask/plan/searched.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "driver/plan/library.h"
#include "runtime/plan/measure/bins.h"
#include "runtime/plan/picture/draw_open.h"
#include "runtime/plan/text/text.h"

/* ---- why no plan of a library completes an open plan */

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

/* ---- draws what may still be chosen in an open plan */

/* write: tn_wish_text, or tn_wish_caption of pictures. */
static char *write_best(const tn_open_choices *c, size_t at,
                        char *(*write)(const tn_wishes *wishes, uint32_t k, const mpq_t value))
{
    mpq_t value;
    if (!c->found.best || c->found.best[at] == TN_NO_BEST)
        return NULL;
    mpq_init(value);
    mpq_set_si(value, c->found.best[at], 1);
    mpq_mul(value, value, c->step);
    char *text = write(&c->wishes, 0, value);
    mpq_clear(value);
    return text;
}

char *tn_open_best_text(const tn_open_choices *c, size_t at)
{
    return write_best(c, at, tn_wish_text);
}

void tn_open_best_name(const tn_open_choices *c, char *text, size_t size)
{
    snprintf(text, size, "%s %.200s", c->wishes.most[0] ? "most" : "least", c->wishes.names[0]);
}

static bool take_choices(const tn_open_choices *c, tn_drawn_choice *choices)
{
    bool ok = true;
    for (uint32_t t = 0; t < c->found.trays; t++)
        for (uint32_t f = 0; f < c->schema->field_count; f++)
            for (uint32_t v = 0; ok && v < c->schema->fields[f].value_count; v++) {
                size_t at = tn_open_choice_at(c, t, f, v);
                tn_drawn_choice *choice = choices++;
                choice->share = tn_bins_share(c->found.counts[at], c->found.plans);
                choice->count = tn_digits(c->found.counts[at], true);
                choice->best = write_best(c, at, tn_wish_caption);
                ok = choice->count && (choice->best || !c->found.best || c->found.best[at] == TN_NO_BEST);
            }
    return ok;
}

static tn_status draw_choices(const tn_open_choices *c, const tn_drawn_choice *choices, tn_picture *to, tn_error *error)
{
    char about[512], best[256] = "";
    char *plans = tn_digits(c->found.plans, true);
    if (!plans)
        return tn_fail_memory(error);
    if (c->found.best)
        tn_open_best_name(c, best, sizeof best);
    snprintf(about, sizeof about, "%.200s %s complete the open plan%s%s%s", plans, c->what,
             c->found.best ? "; beside each count the " : "", c->found.best ? best : "",
             c->found.best ? " that is left" : "");
    free(plans);
    const tn_drawn_open open = {.title = c->title,
                                .doc = c->doc,
                                .about = about,
                                .best_name = c->found.best ? best : NULL,
                                .functions = c->spelled.functions,
                                .count = c->open.count,
                                .choices = choices};
    return tn_open_plan_draw(c->spelled.schema ? c->spelled.schema : c->schema, &open, to, error);
}

tn_status tn_open_choices_draw(const tn_open_choices *c, tn_picture *to, tn_error *error)
{
    size_t count = (size_t)c->found.trays * c->found.values;
    tn_drawn_choice *choices = calloc(count + 1, sizeof *choices);
    tn_status status = choices && take_choices(c, choices) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw_choices(c, choices, to, error);
    for (size_t i = 0; choices && i < count; i++) {
        free((char *)(uintptr_t)choices[i].count);
        free((char *)(uintptr_t)choices[i].best);
    }
    free(choices);
    return status;
}

static void free_choices(void *made)
{
    tn_open_choices *choices = made;
    if (!choices)
        return;
    tn_completions_clear(&choices->found);
    tn_weighed_free(choices->weighed);
    tn_spelled_clear(&choices->spelled);
    free(choices->trays);
    tn_schema_free(choices->own);
    mpq_clear(choices->step);
    free(choices->why);
    free(choices);
}

/* ---- the answer */

static void set_count(const tn_open_choices *c, bool *has_plans, mpz_t plans, bool *has_houses, mpz_t houses,
                      const mpz_t count)
{
    *has_houses = c->own != NULL;
    *has_plans = !c->own;
    mpz_set(c->own ? houses : plans, count);
}

static char *spelling(const tn_open_choices *c, uint32_t field, uint32_t value)
{
    return strdup(tn_text(c->schema->module, c->schema->values[c->schema->value_start[field] + value].spelling));
}

static char *name_of(const tn_open_choices *c, uint32_t field)
{
    return strdup(tn_text(c->schema->module, c->schema->fields[field].name));
}

static tn_status count_field(const tn_open_choices *c, uint32_t tray, uint32_t field, tn_named_bigs *to,
                             tn_error *error)
{
    uint32_t count = c->schema->fields[field].value_count;
    tn_status status = TN_NEW_LIST(named_big, to->values, count, error);
    to->name = name_of(c, field);
    for (uint32_t v = 0; status == TN_OK && v < count; v++) {
        mpz_set(to->values.items[v].value, c->found.counts[tn_open_choice_at(c, tray, field, v)]);
        to->values.items[v].name = spelling(c, field, v);
        status = to->name && to->values.items[v].name ? TN_OK : tn_fail_memory(error);
    }
    return status;
}

static tn_status count_tray(const tn_open_choices *c, uint32_t tray, tn_tray_choices *to, tn_error *error)
{
    uint32_t count = c->schema->field_count;
    tn_status status = TN_NEW_LIST(named_bigs, to->fields, count, error);
    for (uint32_t f = 0; status == TN_OK && f < count; f++)
        status = count_field(c, tray, f, &to->fields.items[f], error);
    return status;
}

/* Hands over why nothing completes it. */
static void give_why(tn_open_choices *c, bool *has_why, char **why)
{
    *has_why = c->why != NULL;
    *why = c->why;
    c->why = NULL;
}

static tn_status give_counts(tn_open_choices *c, tn_completed *to, tn_error *error)
{
    give_why(c, &to->has_why_none, &to->why_none);
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.plans);
    tn_status status = TN_NEW_LIST(tray_choices, to->trays, c->found.trays, error);
    for (uint32_t t = 0; status == TN_OK && t < c->found.trays; t++)
        status = count_tray(c, t, &to->trays.items[t], error);
    return status;
}

/* ---- with a measure */

static void weigh_choice(const tn_open_choices *c, size_t at, tn_open_choice *to)
{
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.counts[at]);
    to->has_best = c->found.best[at] != TN_NO_BEST;
    if (!to->has_best)
        return;
    mpq_set_si(to->best, c->found.best[at], 1);
    mpq_mul(to->best, to->best, c->step);
    tn_amount_convert(c->wishes.units[0], to->best);
}

static tn_status weigh_field(const tn_open_choices *c, uint32_t tray, uint32_t field, tn_named_choices *to,
                             tn_error *error)
{
    uint32_t count = c->schema->fields[field].value_count;
    tn_status status = TN_NEW_LIST(named_choice, to->values, count, error);
    to->name = name_of(c, field);
    for (uint32_t v = 0; status == TN_OK && v < count; v++) {
        weigh_choice(c, tn_open_choice_at(c, tray, field, v), &to->values.items[v].choice);
        to->values.items[v].name = spelling(c, field, v);
        status = to->name && to->values.items[v].name ? TN_OK : tn_fail_memory(error);
    }
    return status;
}

static tn_status weigh_tray(const tn_open_choices *c, uint32_t tray, tn_tray_weighed *to, tn_error *error)
{
    uint32_t count = c->schema->field_count;
    tn_status status = TN_NEW_LIST(named_choices, to->fields, count, error);
    for (uint32_t f = 0; status == TN_OK && f < count; f++)
        status = weigh_field(c, tray, f, &to->fields.items[f], error);
    return status;
}

static tn_status give_weighed(tn_open_choices *c, tn_completed_by *to, tn_error *error)
{
    give_why(c, &to->has_why_none, &to->why_none);
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.plans);
    tn_status status = TN_NEW_LIST(tray_weighed, to->trays, c->found.trays, error);
    for (uint32_t t = 0; status == TN_OK && t < c->found.trays; t++)
        status = weigh_tray(c, t, &to->trays.items[t], error);
    return status;
}

/* Takes over the choices in any case. */
static tn_status give(tn_open_choices *c, tn_reply *answer, tn_error *error)
{
    bool weighed = c->wishes.count > 0;
    tn_status status = tn_reply_new(weighed ? &tn_message_completed_by : &tn_message_completed, answer, error);
    if (status != TN_OK) {
        free_choices(c);
        return status;
    }
    if (weighed) {
        tn_completed_by *to = answer->value;
        to->shown = (tn_boxed){c, free_choices};
        return give_weighed(c, to, error);
    }
    tn_completed *to = answer->value;
    to->shown = (tn_boxed){c, free_choices};
    return give_counts(c, to, error);
}

/* ---- asked */

static tn_open_choices *new_choices(const char *what)
{
    tn_open_choices *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->what = what;
    mpq_init(c->step);
    return c;
}

/* What is left out of a plan in brackets has its first value, and may be anything in an open plan. */
static void note_brackets(tn_session *session, const tn_open_choices *c)
{
    tn_buffer line = {0};
    if (tn_plan_write_line(c->schema, c->spelled.plan.trays, c->spelled.plan.length, &line))
        tn_session_note(session,
                        "in brackets this is the one plan `%s`; without them, what is not written may have any value",
                        line.data ? line.data : "");
    free(line.data);
}

/* The trays that may stand at each place of the open plan that is asked about; c has its schema. */
static tn_status read_open(tn_session *session, const tn_complete_request *request, tn_open_choices *c)
{
    static const char name[] = "PATTERN";
    tn_spelled *w = &c->spelled;
    tn_error error;
    tn_status status =
        tn_spelled_read(session, c->schema, request->pattern, name, tn_asked_length(&request->subject), true, w);
    if (status == TN_OK && w->in_brackets)
        note_brackets(session, c);
    if (status == TN_OK)
        status = tn_spelled_open(session, c->schema, name, w);
    if (status != TN_OK)
        return status;
    c->trays = calloc(w->count + 1, sizeof *c->trays);
    if (!c->trays) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    for (size_t i = 0; i < w->count; i++)
        c->trays[i] =
            (tn_open_tray){.fits = w->fits + i * c->schema->tray_count, .gap = w->functions[i] == TN_NO_RECORD};
    c->open = (tn_open_plan){.trays = c->trays, .count = w->count};
    return TN_OK;
}

/* The trays of plans that complete it, by a measure or none. */
static tn_status find_plans(tn_open_choices *c, const tn_ready_library *ready, tn_error *error)
{
    const tn_library *library = ready->library;
    tn_buffer why = {0};
    tn_status status = c->wishes.count ? tn_weighed_new(library, c->wishes.measures, 1, &c->weighed, error) : TN_OK;
    if (status != TN_OK)
        return status;
    c->open.weighed = c->weighed;
    c->open.most = c->wishes.most[0];
    if (c->weighed)
        mpq_set(c->step, tn_weighed_unit(c->weighed, 0));
    status = tn_complete(&c->found, library, &c->open, error);
    if (status == TN_OK && mpz_sgn(c->found.plans) == 0)
        status = tn_open_why_none(ready, &c->open, &why, error);
    c->why = why.data;
    return status;
}

/* ---- plans that are searched */

/* Joins the values of a field that the trays of an open plan's part may have; false: any value. */
static bool values_written(const tn_schema *schema, const tn_open_tray *part, uint32_t field, bool *may,
                           tn_buffer *text)
{
    uint32_t count = schema->fields[field].value_count, some = 0;
    for (uint32_t v = 0; v < count; v++)
        may[v] = false;
    for (tn_tray t = 0; t < schema->tray_count; t++)
        may[tn_tray_value(schema, t, field)] |= part->fits[t];
    for (uint32_t v = 0; v < count; v++) {
        if (may[v])
            tn_buffer_printf(text, "%s%s", some++ ? " or " : "",
                             tn_text(schema->module, schema->values[schema->value_start[field] + v].spelling));
    }
    return some < count;
}

typedef struct open_search {
    tn_session *session;
    const tn_complete_request *request;
    const tn_ready_library *ready;
    const tn_open_choices *choices;
} open_search;

static tn_status find_beginning(const open_search *o, const tn_open_plan *open, bool *any, size_t *parts,
                                tn_error *error)
{
    const tn_search_options options = tn_asked_search(&o->request->subject, &o->request->search);
    tn_plan_search *search;
    tn_status status = tn_plan_search_new(o->ready->schema, o->ready->index, &options, &search, error);
    if (status != TN_OK)
        return status;
    status = tn_plan_search_beginning(search, open, any, parts, error);
    tn_plan_search_free(search);
    return status;
}

/* Does a field of the last part leave no plan by itself? Then says so. */
static tn_status say_value(const open_search *o, tn_open_tray *parts, size_t count, uint32_t field, uint32_t tray,
                           tn_buffer *text, tn_error *error)
{
    const tn_schema *schema = o->choices->schema;
    tn_open_tray *last = &parts[count - 1];
    const tn_open_tray written = *last;
    bool may[TN_FIELD_VALUES_MAX], any = false;
    size_t found = count;
    tn_buffer values = {0};
    bool *fits = calloc((size_t)schema->tray_count + 1, sizeof *fits);
    tn_status status = fits ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && values_written(schema, &written, field, may, &values)) {
        for (tn_tray t = 0; t < schema->tray_count; t++)
            fits[t] = may[tn_tray_value(schema, t, field)];
        *last = (tn_open_tray){.fits = fits};
        status = find_beginning(o, &(tn_open_plan){.trays = parts, .count = count}, &any, &found, error);
        *last = written;
    }
    if (status == TN_OK && found < count)
        tn_buffer_printf(text, "`%s` of tray %u alone leaves none: its %s is something else\n",
                         values.data ? values.data : "", tray, tn_text(schema->module, schema->fields[field].name));
    free(values.data);
    free(fits);
    return status;
}

/* The part at `at` is the first with which none goes on. */
static tn_status say_part(const open_search *o, size_t at, tn_buffer *text, tn_error *error)
{
    const tn_open_plan *open = &o->choices->open;
    tn_open_tray *parts = calloc(open->count + 1, sizeof *parts);
    uint32_t tray = 0;
    if (!parts)
        return tn_fail_memory(error);
    for (size_t i = 0; i <= at; i++) {
        parts[i] = open->trays[i];
        tray += !parts[i].gap;
    }
    if (tray == 1)
        tn_buffer_printf(text, "no plan of the library has tray 1 as it is written\n");
    else
        tn_buffer_printf(text, "plans fit what is written before tray %u, and none of them goes on with it\n", tray);
    tn_status status = TN_OK;
    for (uint32_t f = 0; status == TN_OK && f < o->choices->schema->field_count; f++)
        status = say_value(o, parts, at + 1, f, tray, text, error);
    free(parts);
    return status;
}

static tn_status say_why_none(const open_search *o, tn_buffer *text, tn_error *error)
{
    const tn_open_plan *open = &o->choices->open;
    bool any = false;
    size_t parts = 0;
    tn_status status = find_beginning(o, open, &any, &parts, error);
    if (status == TN_OK && !any)
        tn_buffer_printf(text, "the library holds no plan at all\n");
    else if (status == TN_OK && parts == open->count)
        tn_buffer_printf(text, "plans begin so, and all have more trays: `| ...` at the end lets them\n");
    else if (status == TN_OK)
        status = say_part(o, parts, text, error);
    if (text->size > 0)
        text->data[--text->size] = '\0';
    return status == TN_OK && text->failed ? tn_fail_memory(error) : status;
}

enum { COMPLETIONS_SHOWN = 10 };

static tn_status find_first(const open_search *o, tn_plan_search *search, tn_completed_searched *to, tn_error *error)
{
    tn_searched_lines lines = {.schema = o->ready->schema, .lines = &to->first, .most = COMPLETIONS_SHOWN};
    tn_buffer why = {0};
    tn_plan_search_narrow(search, &o->choices->open);
    tn_status status = tn_searched_list(o->session, search, &lines, error);
    to->more = lines.more;
    if (status != TN_OK || to->first.count > 0)
        return status;
    status = say_why_none(o, &why, error);
    to->has_why_none = why.data != NULL;
    to->why_none = why.data;
    return status;
}

static tn_status complete_searched(const open_search *o, const tn_error *limit, tn_reply *answer)
{
    tn_plan_search *search;
    tn_error error;
    if (o->request->by.count > 0) {
        tn_session_fail(o->session, limit);
        tn_session_note(o->session,
                        "`best` finds the best of the plans that complete it by search, with the further requirement "
                        "`plan [PATTERN]` (--where)");
        return limit->status;
    }
    if (tn_answer_has_picture(&o->request->drawn))
        return tn_session_refuse(o->session, "leave out the picture, or give fewer trays with --trays",
                                 "what completes an open plan is drawn with its counts, and a library that is searched "
                                 "has none");
    tn_searched_note(o->session, limit);
    tn_status status = tn_searched_new(o->session, o->ready, &o->request->subject, &o->request->search, &search);
    if (status != TN_OK)
        return status;
    status = tn_reply_new(&tn_message_completed_searched, answer, &error);
    if (status == TN_OK)
        status = find_first(o, search, answer->value, &error);
    tn_plan_search_free(search);
    return status == TN_OK ? TN_OK : tn_session_fail(o->session, &error);
}

static tn_status complete_plans(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    const tn_ready_library *ready;
    tn_wishes wishes;
    tn_error error, limit;
    tn_status status = tn_session_searched(session, &request->subject, false, &ready, &limit);
    if (status == TN_OK)
        status = tn_wishes_of_plans(session, ready, request->by.items, request->by.count, 0, &wishes);
    if (status != TN_OK)
        return status;
    tn_open_choices *c = new_choices("plans");
    if (!c) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    c->schema = ready->schema;
    c->title = tn_text(module, ready->record->name);
    c->doc = tn_text(module, ready->record->doc);
    c->wishes = wishes;
    status = read_open(session, request, c);
    if (status == TN_OK && !ready->library)
        status = complete_searched(&(open_search){session, request, ready, c}, &limit, answer);
    if (status != TN_OK || !ready->library) {
        free_choices(c);
        return status;
    }
    status = find_plans(c, ready, &error);
    if (status == TN_OK)
        status = give(c, answer, &error);
    else
        free_choices(c);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* A schema of its own: that of houses does not stay. */
static tn_status make_schema(tn_session *session, const char *library, tn_open_choices *c)
{
    const tn_module *module = session->opened->module;
    const tn_house_library_record *record = &module->HOUSE_LIBRARY_records[tn_house_library_find(module, library)];
    tn_error error;
    tn_status status = tn_form_schema(module, record->form, &c->own, &error);
    c->schema = c->own;
    c->title = tn_text(module, record->name);
    c->doc = tn_text(module, record->doc);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* Takes over the choices in any case. */
static tn_status give_houses(tn_houses_search *search, tn_open_choices *c, tn_reply *answer)
{
    tn_error error;
    c->wishes = search->found;
    c->open.most = c->wishes.most[0];
    if (c->wishes.count)
        mpq_set(c->step, search->by.weights[0]->shown);
    tn_status status =
        search->by.houses ? tn_houses_complete(search->by.houses, &c->open, &c->found, &error)
                          : tn_completed_walked(&search->n, &search->by.measures, &c->open, &c->found, c->step, &error);
    if (status == TN_OK)
        status = give(c, answer, &error);
    else
        free_choices(c);
    return status == TN_OK ? TN_OK : tn_session_fail(search->n.session, &error);
}

static tn_status search_houses(tn_session *session, const tn_complete_request *request, tn_open_choices *c,
                               tn_reply *answer)
{
    const tn_house_asked asked = {.subject = &request->subject,
                                  .aim = TN_HOUSES_COMPLETE,
                                  .by = request->by.items,
                                  .by_count = request->by.count};
    tn_houses_search search;
    tn_status status = tn_houses_search_begin(&search, session, &asked);
    if (status == TN_OK)
        status = give_houses(&search, c, answer);
    else
        free_choices(c);
    tn_houses_search_end(&search);
    return status;
}

static tn_status complete_houses(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    tn_error error;
    tn_open_choices *c = new_choices("houses");
    if (!c) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = make_schema(session, request->subject.library, c);
    if (status == TN_OK)
        status = read_open(session, request, c);
    if (status == TN_OK)
        return search_houses(session, request, c, answer);
    free_choices(c);
    return status;
}

static tn_status draw(tn_session *session, const tn_answer_picture *asked, const tn_reply *answer)
{
    tn_completed *counted = TN_REPLY(completed, answer);
    tn_completed_by *weighed = TN_REPLY(completed_by, answer);
    tn_picture to = tn_answer_picture_begin(asked);
    tn_error error;
    tn_status status = tn_open_choices_draw(counted ? counted->shown.value : weighed->shown.value, &to, &error);
    return tn_answer_picture_give(session, asked, &to, status, &error,
                                  counted ? (tn_list *)&counted->files : (tn_list *)&weighed->files,
                                  counted ? &counted->has_files : &weighed->has_files);
}

tn_status tn_ask_complete(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (request->by.count > 1)
        return tn_session_refuse(session, NULL, "complete looks at one measure: give one --least or --most");
    bool houses = tn_session_of_houses(session, &request->subject);
    tn_status status = (houses ? complete_houses : complete_plans)(session, request, answer);
    return status == TN_OK && tn_answer_has_picture(&request->drawn) ? draw(session, &request->drawn, answer) : status;
}
