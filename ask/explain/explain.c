/* explain: why a plan or a house is kept or dropped; of plans here, by the clauses of a library or by rules, as trees
 * of messages. */
#include "ask/explain/explain.h"
#include "ask/form/form.h"

#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/plan/match.h"
#include "ask/plan/searched.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "ask/session/spelled.h"

/* What plans are explained with, kept from one to the next. */
typedef struct tn_plan_explainer {
    const tn_library_record *record; /* NULL: rules by themselves */
    tn_chosen_rules rules;
    uint32_t schema_index; /* of the SCHEMA record */
    tn_schema *schema;
    tn_library *library;    /* for ranks; NULL: nobody asked, or it passed a limit, */
    tn_error limit;         /* which is this one */
    tn_near_finder *finder; /* NULL: nobody asked, or a clause passed a limit */
    bool tried_library, tried_nearest;
    uint32_t max_states, max_length;
} tn_plan_explainer;

static void free_explainer(void *made)
{
    tn_plan_explainer *explainer = made;
    if (!explainer)
        return;
    tn_near_finder_free(explainer->finder);
    tn_library_free(explainer->library);
    tn_schema_free(explainer->schema);
    tn_chosen_rules_clear(&explainer->rules);
    free(explainer);
}

static void free_reasons(void *made)
{
    tn_plan_reasons *reasons = made;
    if (!reasons)
        return;
    tn_explained_clear(&reasons->explained);
    free(reasons->plan.trays);
    free(reasons);
}

/* ---- what is explained against */

/* The library that is named, or the only one; without any, or if rules are named, rules by themselves. */
static tn_status choose(tn_session *session, const tn_explain_request *request, tn_plan_explainer *made)
{
    tn_opened *opened = session->opened;
    const char *name = request->subject.library;
    uint32_t library = UINT32_MAX;
    tn_status status = TN_OK;
    bool rules = request->rules.count > 0;
    if (!rules && !name && opened->module->LIBRARY_count > 0) {
        status = tn_library_choose(opened, NULL, &library);
        made->schema_index = status == TN_OK ? opened->module->LIBRARY_records[library].schema : 0;
    } else if (!rules && name) {
        status = tn_schema_choose(opened, name, &made->schema_index, &library);
    } else {
        status = tn_session_rules(session, &request->rules, "name one of those it uses with --rule", &made->rules);
        made->schema_index = made->rules.schema;
    }
    made->record = library == UINT32_MAX ? NULL : &opened->module->LIBRARY_records[library];
    return status;
}

static bool are_alike(const tn_plan_explainer *a, const tn_plan_explainer *b)
{
    return a->record == b->record && a->max_states == b->max_states && a->max_length == b->max_length &&
           a->rules.count == b->rules.count &&
           (a->rules.count == 0 ||
            memcmp(a->rules.indices, b->rules.indices, a->rules.count * sizeof *a->rules.indices) == 0);
}

static tn_status new_explainer(tn_session *session, const tn_explain_request *request, tn_plan_explainer **made)
{
    tn_error error;
    *made = calloc(1, sizeof **made);
    if (!*made) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    (*made)->max_states = (uint32_t)request->subject.max_states;
    (*made)->max_length = (uint32_t)request->subject.max_length;
    return choose(session, request, *made);
}

static tn_status make_schema(tn_session *session, tn_plan_explainer *made)
{
    tn_error error;
    tn_status status = tn_schema_new(session->opened->module, made->schema_index, 0, &made->schema, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* The session's, made anew if something else was explained before. */
static tn_status make_ready(tn_session *session, const tn_explain_request *request, tn_plan_explainer **explainer)
{
    tn_plan_explainer *made;
    tn_status status = new_explainer(session, request, &made);
    tn_boxed *last = &session->explainer;
    bool kept = status == TN_OK && last->value && are_alike(last->value, made);
    if (status == TN_OK && !kept)
        status = make_schema(session, made);
    if (status == TN_OK && !kept) {
        tn_boxed_free(last);
        *last = (tn_boxed){made, free_explainer};
    } else {
        free_explainer(made);
    }
    *explainer = last->value;
    return status;
}

tn_status tn_explain_schema(tn_session *session, const tn_explain_request *request, const tn_schema **schema)
{
    tn_plan_explainer *explainer;
    tn_status status = make_ready(session, request, &explainer);
    *schema = status == TN_OK ? explainer->schema : NULL;
    return status;
}

static uint32_t library_index(const tn_session *session, const tn_plan_explainer *explainer)
{
    return (uint32_t)(explainer->record - session->opened->module->LIBRARY_records);
}

/* A limit that is passed while finding out what can be done without. */
static void note_limit(tn_session *session, const tn_error *error, const char *consequence)
{
    tn_diagnostic *note = tn_finding_note(session->opened, error);
    tn_note(&session->opened->compilation.diagnostics, note, NULL, "%s", consequence);
}

/* The library's automaton, for ranks, once: TN_LIMIT if it passes a limit. */
static tn_status make_library(tn_session *session, tn_plan_explainer *explainer, tn_error *error)
{
    if (explainer->tried_library) {
        *error = explainer->limit;
        return explainer->library ? TN_OK : TN_LIMIT;
    }
    const tn_library_options options = {.max_states = explainer->max_states, .max_length = explainer->max_length};
    tn_status status =
        tn_library_new(explainer->schema, library_index(session, explainer), &options, &explainer->library, error);
    explainer->tried_library = status == TN_OK || status == TN_LIMIT;
    if (status == TN_LIMIT)
        explainer->limit = *error;
    return status;
}

/* Ranks are done without if the library passes a limit, which is said once. */
static tn_status try_library(tn_session *session, tn_plan_explainer *explainer, tn_error *error)
{
    if (!explainer->record || explainer->tried_library)
        return TN_OK;
    tn_status status = make_library(session, explainer, error);
    if (status != TN_LIMIT)
        return status;
    note_limit(session, error, "so ranks are not known");
    return TN_OK;
}

static tn_status try_finder(tn_session *session, tn_plan_explainer *explainer, tn_error *error)
{
    if (explainer->tried_nearest)
        return TN_OK;
    const tn_near_options options = {.max_states = explainer->max_states};
    tn_status status =
        tn_near_finder_new(explainer->schema, library_index(session, explainer), &options, &explainer->finder, error);
    explainer->tried_nearest = status == TN_OK || status == TN_LIMIT;
    if (status != TN_LIMIT)
        return status;
    if (tn_plan_search_is_there())
        tn_session_note(session, "nearest plans are found by search, since %.400s", error->message);
    else
        note_limit(session, error, "so nearest plans are not known");
    return TN_OK;
}

/* If the automata of clauses pass a limit, or the way through them does. */
static tn_status search_near(tn_session *session, tn_plan_explainer *explainer, const tn_explain_request *request,
                             size_t most, tn_explained *explained, tn_error *error)
{
    const tn_search_options options = tn_asked_search(&request->subject, &request->search);
    tn_plan_search *search;
    tn_status status =
        tn_plan_search_new(explainer->schema, library_index(session, explainer), &options, &search, error);
    if (status != TN_OK)
        return status;
    status = tn_explained_search_near(explained, search, most, error);
    tn_plan_search_free(search);
    if (status != TN_LIMIT)
        return status;
    note_limit(session, error, "so nearest plans are not known");
    return TN_OK;
}

static tn_status find_near(tn_session *session, tn_plan_explainer *explainer, const tn_explain_request *request,
                           tn_explained *explained, tn_error *error)
{
    size_t most = request->has_nearest ? (size_t)request->nearest : TN_NEAREST_DEFAULT;
    if (most == 0 || !explainer->record || explained->kept)
        return TN_OK;
    tn_status status = try_finder(session, explainer, error);
    if (status == TN_OK && explainer->finder) {
        status = tn_explained_near(explained, explainer->finder, most, error);
        if (status != TN_LIMIT)
            return status;
        tn_finding_note(session->opened, error);
        status = TN_OK;
    }
    return status == TN_OK && tn_plan_search_is_there()
               ? search_near(session, explainer, request, most, explained, error)
               : status;
}

/* ---- the plan */

static tn_status plan_of_rank(tn_session *session, tn_plan_explainer *explainer, const char *digits, tn_plan *plan)
{
    tn_error error;
    mpz_t rank;
    uint32_t length;
    if (!tn_is_rank(digits))
        return tn_session_refuse(session, NULL, "a rank is # and a whole number from 0, not `#%.60s`", digits);
    if (!explainer->record)
        return tn_session_refuse(session, NULL,
                                 "#%.60s is a plan's rank in a library, and rules alone are explained here", digits);
    tn_status status = make_library(session, explainer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    plan->trays = malloc(sizeof *plan->trays * ((size_t)tn_library_max(explainer->library) + 1));
    if (!plan->trays) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    mpz_init_set_str(rank, digits, 10);
    if (tn_library_unrank(explainer->library, rank, plan->trays, &length))
        plan->length = length;
    else
        status = tn_session_no_rank(session, explainer->library, explainer->record, digits);
    mpz_clear(rank);
    return status;
}

static tn_status read_plan(tn_session *session, tn_plan_explainer *explainer, const tn_explain_request *request,
                           tn_plan *plan)
{
    const char *text = request->plan;
    return text[0] == '#' ? plan_of_rank(session, explainer, text + 1, plan)
                          : tn_session_plan(session, explainer->schema, text, tn_asked_length(&request->subject), plan);
}

/* ---- messages */

static tn_status take_words(tn_buffer *words, char **text, bool *has, tn_error *error)
{
    bool failed = words->failed;
    *text = words->data;
    *has = words->data != NULL;
    return failed ? tn_fail_memory(error) : TN_OK;
}

static tn_tray_stretch stretch_of(tn_stretch stretch)
{
    return (tn_tray_stretch){(uint64_t)stretch.begin + 1, stretch.end};
}

static void set_gap(const tn_gap *gap, tn_explained_gap *to)
{
    to->source = stretch_of(gap->source);
    to->destination = stretch_of(gap->destination);
    to->has_between = gap->between.begin < gap->between.end;
    to->between = stretch_of(gap->between);
    to->has_number = gap->number != TN_NO_NUMBER;
    to->number = gap->number;
    to->fits = gap->fits;
}

static void set_place(const tn_explained *explained, const tn_part *part, tn_explained_part *to)
{
    tn_place place;
    to->has_file = to->has_line = to->has_column = tn_code_place(explained->opened, part->root, &place);
    if (!to->has_file)
        return;
    to->file = place.path;
    to->line = place.line;
    to->column = place.column;
}

static tn_status set_closest(const tn_explanation *why, const tn_why *node, tn_closest_tray *to, tn_error *error)
{
    tn_buffer wrong = {0};
    to->tray = (uint64_t)node->closest + 1;
    tn_words_wrong(why, node, &wrong);
    return take_words(&wrong, &to->wrong, &to->has_wrong, error);
}

static tn_status set_lists(const tn_explanation *why, const tn_why *node, tn_explained_part *to, tn_error *error)
{
    tn_status status = TN_NEW_LIST(tray_stretch, to->trays, node->stretch_count, error);
    for (uint32_t i = 0; status == TN_OK && i < node->stretch_count; i++)
        to->trays.items[i] = stretch_of(why->stretches[node->stretch_first + i]);
    to->has_gaps = tn_explanation_gaps(why, (uint32_t)(node - why->nodes)) == (uint32_t)(node - why->nodes);
    if (status != TN_OK || !to->has_gaps)
        return status;
    status = TN_NEW_LIST(explained_gap, to->gaps, node->gap_count, error);
    for (uint32_t i = 0; status == TN_OK && i < node->gap_count; i++)
        set_gap(&why->gaps[node->gap_first + i], &to->gaps.items[i]);
    return status;
}

/* What the sides of a comparison came to. */
static tn_status set_sides(const tn_explanation *why, const tn_why *node, tn_explained_part *to, tn_error *error)
{
    tn_buffer text = {0};
    if (node->sides == TN_NO_WHY)
        return TN_OK;
    const tn_sides *sides = &why->sides[node->sides];
    if (!tn_words_side(why, sides, sides->left, &text))
        return tn_fail_memory(error);
    to->has_left = to->has_right = !sides->difference;
    to->has_difference = sides->difference;
    *(sides->difference ? &to->difference : &to->left) = text.data;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < sides->right_count; i++) {
        tn_buffer right = {0};
        if (!tn_words_side(why, sides, sides->right[i], &right))
            return tn_fail_memory(error);
        status = tn_owneds_add(&to->right, right.data, error);
    }
    return status;
}

static void set_number(const tn_why *node, const tn_part *part, tn_explained_part *to)
{
    bool known = node->number != TN_NO_NUMBER, sum = part->kind == TN_PART_SUM;
    to->has_nanometres = known && sum;
    to->has_count = known && !sum;
    to->nanometres = to->count = node->number;
}

static tn_status set_part(const tn_explained *explained, const tn_explanation *why, uint32_t index,
                          tn_explained_part *to, tn_error *error)
{
    const tn_why *node = &why->nodes[index];
    const tn_part *part = tn_why_part(why, node);
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0};
    tn_part_text(&why->trees[node->tree], node->part, text, sizeof text);
    to->kind = tn_part_word(part->kind);
    to->text = strdup(text);
    to->has_number = node->tree == 0;
    to->number = node->part;
    set_place(explained, part, to);
    to->matched = node->matched;
    to->has_mirrored = to->mirrored = node->mirrored;
    to->has_left_out = to->left_out = node->absent;
    to->has_cut = to->cut = node->cut;
    set_number(node, part, to);
    to->has_run = node->run_count > 0;
    to->run = (tn_explained_run){(uint64_t)node->run_first + 1, node->run_count, stretch_of(node->run)};
    to->has_closest = node->closest != TN_NO_WHY;
    tn_words_evidence(why, node, &evidence);
    tn_status status = take_words(&evidence, &to->evidence, &to->has_evidence, error);
    if (status == TN_OK && !to->text)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = set_sides(why, node, to, error);
    if (status == TN_OK && to->has_closest)
        status = set_closest(why, node, &to->closest, error);
    return status == TN_OK ? set_lists(why, node, to, error) : status;
}

/* A node with those below it; trees are TN_EXPLAIN_DEPTH_MAX deep at most. */
static tn_status set_tree(const tn_explained *explained, const tn_explanation *why, uint32_t index,
                          tn_explained_tree *to, tn_error *error)
{
    size_t count = 0, i = 0;
    for (uint32_t child = why->nodes[index].first; child != TN_NO_WHY; child = why->nodes[child].next)
        count++;
    tn_status status = set_part(explained, why, index, &to->part, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(explained_tree, to->parts, count, error);
    for (uint32_t child = why->nodes[index].first; status == TN_OK && child != TN_NO_WHY;
         child = why->nodes[child].next)
        status = set_tree(explained, why, child, &to->parts.items[i++], error);
    return status;
}

static tn_status set_beginning(const tn_explained *explained, const tn_generated_beginning *beginning,
                               tn_generated_start *to, tn_error *error)
{
    enum { THEN_MAX = 100 };
    tn_buffer words = {0};
    to->trays = beginning->length;
    to->may_end = beginning->may_end;
    to->follows = beginning->count;
    tn_words_beginning(explained, beginning, &words);
    bool has = false;
    tn_status status = take_words(&words, &to->words, &has, error);
    for (tn_tray t = 0; status == TN_OK && t < explained->schema->tray_count && to->then.count < THEN_MAX; t++) {
        tn_buffer line = {0};
        if (!beginning->follows[t])
            continue;
        status = tn_plan_write_line(explained->schema, &t, 1, &line) ? tn_owneds_add(&to->then, line.data, error)
                                                                     : tn_fail_memory(error);
    }
    return status;
}

static tn_status set_clause(const tn_explained *explained, const tn_explained_rule *rule, tn_explained_clause *to,
                            tn_error *error)
{
    uint32_t largest = rule->holds ? TN_NO_WHY : tn_explanation_largest(&rule->why);
    to->name = rule->name;
    to->doc = rule->doc;
    to->has_doc = *rule->doc != '\0';
    to->kind = rule->clause ? tn_names_CLAUSE_KIND[rule->clause->kind] : "rule";
    to->matches = rule->holds;
    to->has_drops = rule->clause != NULL;
    to->drops = rule->drops;
    to->has_largest = largest != TN_NO_WHY;
    to->has_beginning = rule->beginning.known;
    to->has_ways = rule->ways != NULL;
    if (rule->ways)
        mpz_set_str(to->ways, rule->ways, 10);
    to->has_above = rule->above != NULL;
    tn_status status = set_tree(explained, &rule->why, 0, &to->why, error);
    if (status == TN_OK && rule->above && !(to->above = strdup(rule->above)))
        status = tn_fail_memory(error);
    if (status == TN_OK && to->has_beginning)
        status = set_beginning(explained, &rule->beginning, &to->beginning, error);
    return status == TN_OK && to->has_largest ? set_part(explained, &rule->why, largest, &to->largest, error) : status;
}

static tn_status set_clauses(const tn_explained *explained, tn_list *clauses, tn_error *error)
{
    tn_status status = tn_message_list(&tn_message_explained_clause, explained->count, clauses, error);
    tn_explained_clause *items = clauses->items;
    for (size_t i = 0; status == TN_OK && i < explained->count; i++)
        status = set_clause(explained, &explained->rules[i], &items[i], error);
    return status;
}

static tn_status set_preferences(const tn_explained *explained, tn_explained_plan *to, tn_error *error)
{
    mpq_t all;
    mpq_init(all);
    to->has_preference = to->has_preferences = explained->preference_count > 0;
    tn_explained_preferred(explained, to->preference, all);
    mpq_clear(all);
    tn_status status = TN_NEW_LIST(explained_preference, to->preferences, explained->preference_count, error);
    for (size_t i = 0; status == TN_OK && i < explained->preference_count; i++) {
        const tn_preference_reason *from = &explained->preferences[i];
        tn_explained_preference *item = &to->preferences.items[i];
        item->name = from->name;
        item->doc = from->doc;
        item->has_doc = *from->doc != '\0';
        item->met = from->met;
        mpq_set_str(item->worth, from->worth, 10);
        status = set_tree(explained, &from->why, 0, &item->why, error);
    }
    return status;
}

static tn_status set_line(const tn_schema *schema, const tn_tray *trays, size_t length, char **to, tn_error *error)
{
    tn_buffer line = {0};
    bool has;
    tn_plan_write_line(schema, trays, length, &line);
    tn_status status = take_words(&line, to, &has, error);
    if (status != TN_OK || has)
        return status;
    *to = strdup(""); /* of no trays */
    return *to ? TN_OK : tn_fail_memory(error);
}

/* None of a plan that is not in the library. */
static bool set_rank(const tn_explained *explained, const tn_tray *trays, size_t length, mpz_t rank)
{
    return explained->automaton && tn_library_rank(explained->automaton, trays, length, rank);
}

static tn_status set_near(const tn_explained *explained, const tn_near_plan *plan, tn_nearest_plan *to, tn_error *error)
{
    tn_buffer changes = {0};
    to->has_rank = set_rank(explained, plan->trays, plan->length, to->rank);
    tn_words_changes(explained, plan, &changes);
    tn_status status = take_words(&changes, &to->changes, &to->has_changes, error);
    return status == TN_OK ? set_line(explained->schema, plan->trays, plan->length, &to->plan, error) : status;
}

static tn_status set_library(const tn_explained *explained, tn_explained_plan *to, tn_error *error)
{
    const tn_near *near = &explained->near;
    to->library = tn_text(explained->opened->module, explained->library->name);
    to->kept = explained->kept;
    to->has_rank = set_rank(explained, explained->trays, explained->length, to->rank);
    to->too_short_or_long = explained->length_drops;
    to->has_distance = near->count > 0;
    to->distance = near->cost;
    to->more = near->more;
    tn_status status = TN_NEW_LIST(nearest_plan, to->nearest, near->count, error);
    for (size_t i = 0; status == TN_OK && i < near->count; i++)
        status = set_near(explained, &near->plans[i], &to->nearest.items[i], error);
    return status;
}

/* The answer takes the reasons over in any case. */
static tn_status answer_with(tn_plan_reasons *reasons, tn_reply *answer, tn_error *error)
{
    const tn_explained *explained = &reasons->explained;
    bool library = explained->library != NULL;
    tn_status status =
        tn_reply_new(library ? &tn_message_explained_plan : &tn_message_explained_by_rules, answer, error);
    if (status != TN_OK) {
        free_reasons(reasons);
        return status;
    }
    tn_explained_plan *of_library = TN_REPLY(explained_plan, answer);
    tn_explained_by_rules *of_rules = TN_REPLY(explained_by_rules, answer);
    *(library ? &of_library->reasons : &of_rules->reasons) = (tn_boxed){reasons, free_reasons};
    status = set_line(explained->schema, explained->trays, explained->length,
                      library ? &of_library->plan : &of_rules->plan, error);
    if (status == TN_OK)
        status = set_clauses(explained, library ? (tn_list *)&of_library->clauses : (tn_list *)&of_rules->rules, error);
    if (status == TN_OK && library)
        status = set_preferences(explained, of_library, error);
    return status == TN_OK && library ? set_library(explained, of_library, error) : status;
}

/* ---- the whole */

static tn_status explain(tn_session *session, const tn_explain_request *request, tn_plan_explainer *explainer,
                         tn_plan_reasons *reasons, tn_error *error)
{
    tn_explained *explained = &reasons->explained;
    size_t longest = request->subject.has_max_length ? (size_t)request->subject.max_length : TN_EXPLAIN_LENGTH_DEFAULT;
    tn_status status =
        tn_explained_make(explained, session->opened, explainer->schema, explainer->record, explainer->rules.indices,
                          explainer->rules.count, reasons->plan.trays, reasons->plan.length, longest, error);
    if (status == TN_OK && !request->no_ranks)
        status = try_library(session, explainer, error);
    explained->automaton = explainer->library;
    return status == TN_OK ? find_near(session, explainer, request, explained, error) : status;
}

static tn_status explain_plan(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    tn_error error;
    tn_plan_explainer *explainer;
    tn_status status = make_ready(session, request, &explainer);
    if (status != TN_OK)
        return status;
    tn_plan_reasons *reasons = calloc(1, sizeof *reasons);
    if (!reasons) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    status = read_plan(session, explainer, request, &reasons->plan);
    if (status != TN_OK) {
        free_reasons(reasons);
        return status;
    }
    status = explain(session, request, explainer, reasons, &error);
    if (status == TN_OK)
        status = answer_with(reasons, answer, &error);
    else
        free_reasons(reasons);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- the picture */

static tn_status draw(tn_session *session, const tn_explain_request *request, const tn_reply *answer)
{
    tn_explained_plan *by_library = TN_REPLY(explained_plan, answer);
    tn_explained_by_rules *by_rules = TN_REPLY(explained_by_rules, answer);
    const tn_plan_reasons *reasons = by_library ? by_library->reasons.value : by_rules->reasons.value;
    tn_picture to = tn_answer_picture_begin(&request->drawn);
    tn_error error;
    tn_status status = tn_explained_draw(&reasons->explained, request->full, &to, &error);
    return tn_answer_picture_give(session, &request->drawn, &to, status, &error,
                                  by_library ? (tn_list *)&by_library->files : (tn_list *)&by_rules->files,
                                  by_library ? &by_library->has_files : &by_rules->has_files);
}

/* ---- asked */

/* #P: is the plan of rank P, and what keeps houses off it. */
static bool is_for_houses(const tn_explain_request *request)
{
    const char *plan = request->plan;
    return plan && plan[0] == '#' && plan[strlen(plan) - 1] == ':';
}

static tn_status explain_of_houses(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    if (request->has_nearest)
        return tn_session_refuse(session, NULL, "--nearest is about plans that a library of plans drops");
    return request->house ? tn_explain_house(session, request, answer) : tn_explain_cells(session, request, answer);
}

/* A design of boxes is explained if neither a plan nor a house is named. */
static bool is_about_design(const tn_session *session, const tn_explain_request *request)
{
    return tn_subject_of(session->opened->module) == TN_SUBJECT_SOLID && !request->plan && !request->house;
}

static tn_status check_subject(tn_session *session, const tn_explain_request *request)
{
    const tn_asked_use uses[] = {{request->solid.solid != NULL, TN_OF_SOLIDS, "solid"},
                                 {request->solid.has_max_boxes, TN_OF_SOLIDS, "max-boxes"}};
    return tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_status tn_ask_explain(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const char *library = request->subject.library;
    *answer = (tn_reply){0};
    tn_status status = check_subject(session, request);
    if (status != TN_OK)
        return status;
    bool drawn = tn_answer_has_picture(&request->drawn);
    if (is_about_design(session, request))
        return drawn ? tn_session_refuse(session, "`draw` with `show` history draws its steps",
                                         "why boxes are squashed is not drawn here")
                     : tn_explain_design(session, request, answer);
    if (!request->plan == !request->house)
        return tn_session_refuse(session, NULL, "say which plan or which house is explained: one of them");
    if (request->subject.has_trays)
        return tn_session_refuse(session, "leave it out",
                                 "--trays is for all plans of a library, and one is explained");
    bool of_houses =
        library && request->rules.count == 0 && tn_house_library_find(session->opened->module, library) != TN_NO_RECORD;
    if (request->house || of_houses || is_for_houses(request))
        return explain_of_houses(session, request, answer);
    status = explain_plan(session, request, answer);
    return status == TN_OK && drawn ? draw(session, request, answer) : status;
}
