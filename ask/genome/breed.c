/* breed: evolution by a person's eye. A question says all that is done to a run from its beginning; the session keeps
 * the run, so that only what is new is done. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/genome/evolve.h"
#include "ask/session/questions.h"
#include "driver/hand/hand.h"
#include "driver/sheet/sheet_page.h"

/* In the order of the words of the request. */
typedef enum action_kind { DOES_BREED, DOES_SET, DOES_INSERT, DOES_EDIT, DOES_OUT } action_kind;

/* The run that is kept. */
typedef struct kept_run {
    tn_evolving e;
    tn_owneds done;     /* the run that is asked for, and what was done to it, as texts */
    tn_watch watch;     /* which the run's engines keep: it asks the one of whoever is waiting, */
    tn_watch *asking;   /* this one, or NULL */
    bool broken;        /* a generation could not be bred: the run has to be begun again */
    tn_run_asked again; /* then, if it has a folder, gone on with */
} kept_run;

static void free_kept(void *value)
{
    kept_run *kept = value;
    tn_evolving_clear(&kept->e);
    for (size_t i = 0; i < kept->done.count; i++)
        free(kept->done.items[i]);
    free(kept->done.items);
    free(kept);
}

static bool relay(void *context, double done, double total)
{
    kept_run *kept = context;
    (void)done, (void)total;
    bool stopped = tn_watch_stopped(kept->asking);
    kept->watch.full = kept->asking && kept->asking->full;
    return !stopped;
}

static void watch_begin(kept_run *kept, tn_watch *asking)
{
    tn_watch_begin(&kept->watch, relay, kept);
    kept->asking = asking;
    kept->watch.memory_limit = asking ? asking->memory_limit : 0;
    kept->watch.large = asking ? asking->large : NULL;
}

/* ---- what was done before */

/* A message of a request as a text (malloc). does: the choice that it has, which is not written with it. */
static char *text_of(const tn_message *message, const void *value, unsigned does)
{
    tn_buffer text = {0};
    tn_buffer_printf(&text, "%u ", does);
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_message_write(message, value, NULL, &json);
    if (!text.failed)
        return text.data;
    free(text.data);
    return NULL;
}

static char *action_text(const tn_breed_action *action)
{
    return text_of(&tn_message_breed_action, action, action->does);
}

static bool is_text(char *text, const char *other, bool *memory)
{
    *memory &= text != NULL;
    bool same = text && strcmp(text, other) == 0;
    free(text);
    return same;
}

/* Does the request say what was done, and perhaps more? */
static bool continues(const kept_run *kept, const tn_breed_request *request, bool *memory)
{
    if (request->actions.count + 1 < kept->done.count ||
        !is_text(text_of(&tn_message_run_asked, &request->asked, 0), kept->done.items[0], memory))
        return false;
    for (size_t i = 1; i < kept->done.count; i++)
        if (!is_text(action_text(&request->actions.items[i - 1]), kept->done.items[i], memory))
            return false;
    return true;
}

/* Begins the run, or goes on with that of a folder; its first generation is made if it has none. */
static tn_status begin(kept_run *kept)
{
    tn_error error;
    tn_status status = tn_evolving_begin(&kept->e);
    if (status != TN_OK || kept->e.run.generations > 0)
        return status;
    status = tn_run_step(&kept->e.run, NULL, 0, &error);
    if (status != TN_OK)
        return tn_session_fail(kept->e.session, &error);
    tn_evolving_warn(&kept->e);
    return TN_OK;
}

/* Begins it anew after a generation that could not be bred. A folder has what was done up to the one before. */
static tn_status begin_again(kept_run *kept)
{
    const char bred = '0' + DOES_BREED;
    tn_evolving_clear(&kept->e);
    kept->again = *kept->e.asked;
    kept->again.resume = kept->again.run != NULL;
    kept->e =
        (tn_evolving){.session = kept->e.session, .asked = &kept->again, .watch = &kept->watch, .remembers = true};
    while (kept->done.count > 1 && !(kept->again.run && kept->done.items[kept->done.count - 1][0] == bred))
        free(kept->done.items[--kept->done.count]);
    tn_status status = begin(kept);
    kept->broken = status != TN_OK;
    return status;
}

static tn_status begin_new(tn_session *session, const tn_breed_request *request, kept_run **kept)
{
    tn_error error;
    tn_boxed_free(&session->breeding);
    *kept = calloc(1, sizeof **kept);
    if (!*kept || tn_owneds_add(&(*kept)->done, text_of(&tn_message_run_asked, &request->asked, 0), &error) != TN_OK) {
        free(*kept);
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    watch_begin(*kept, session->opened->module->watch);
    (*kept)->e =
        (tn_evolving){.session = session, .asked = &request->asked, .watch = &(*kept)->watch, .remembers = true};
    tn_status status = begin(*kept);
    if (status == TN_OK)
        session->breeding = (tn_boxed){*kept, free_kept};
    else
        free_kept(*kept);
    return status;
}

static tn_status find_run(tn_session *session, const tn_breed_request *request, kept_run **kept)
{
    bool memory = true;
    tn_error error;
    *kept = session->breeding.value;
    bool same = *kept && continues(*kept, request, &memory);
    if (!memory) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    if (!same)
        return begin_new(session, request, kept);
    (*kept)->e.asked = &request->asked;
    watch_begin(*kept, session->opened->module->watch);
    return (*kept)->broken ? begin_again(*kept) : TN_OK;
}

/* ---- done */

static tn_status refuse_choice(tn_session *session, const char *wrong, size_t members)
{
    return tn_session_refuse(session, NULL,
                             "`%s` is not a choice: write numbers from 1 to %zu, as 3 7 12; 3*2 counts twice, 3@0.4 "
                             "gives less of it (0 to 1), and #41 is the individual with that id",
                             wrong, members);
}

static tn_status breed(kept_run *kept, const tn_breed_action *action)
{
    tn_session *session = kept->e.session;
    tn_choices choices = {0};
    char wrong[40];
    tn_error error;
    size_t members;
    tn_evolution_members(kept->e.run.evolution, &members);
    tn_status status = tn_choices_read(action->parents ? action->parents : "", &choices, wrong, &error);
    for (size_t i = 0; status == TN_OK && i < choices.count; i++)
        if (!choices.items[i].by_id && choices.items[i].number >= members) {
            snprintf(wrong, sizeof wrong, "%" PRIu64, choices.items[i].number + 1);
            status = TN_INVALID;
        }
    if (status == TN_INVALID)
        status = refuse_choice(session, wrong, members);
    else if (status != TN_OK)
        tn_session_fail(session, &error);
    else if (choices.count == 0)
        status = tn_session_refuse(session, NULL, "say who has children: the numbers of parents");
    else if (kept->e.run.generations > kept->e.generations)
        status = tn_session_refuse(session, "`generations` says how many are bred", "all generations are bred");
    else if ((status = tn_run_step(&kept->e.run, choices.items, choices.count, &error)) != TN_OK) {
        kept->broken = status != TN_INVALID || error.code != E_NO_INDIVIDUAL; /* an id that nobody has is asked again */
        tn_session_fail(session, &error);
    }
    tn_choices_clear(&choices);
    return status;
}

static bool read_number(const char *digits, uint64_t *number)
{
    size_t size = strspn(digits, "0123456789");
    *number = strtoull(digits, NULL, 10);
    return size > 0 && size < 20 && digits[size] == '\0';
}

/* The member at a place ("3") or with an id ("#41"). */
static tn_status find_member(const kept_run *kept, const char *word, const tn_individual **member)
{
    size_t count;
    uint64_t number;
    const tn_individual *const *members = tn_evolution_members(kept->e.run.evolution, &count);
    word = word ? word : "";
    bool by_id = word[0] == '#', read = read_number(word + by_id, &number);
    for (size_t i = 0; read && i < count; i++) {
        *member = members[i];
        if (by_id ? members[i]->id == number : i + 1 == number)
            return TN_OK;
    }
    return tn_session_refuse(
        kept->e.session, NULL,
        "`%.40s` is nobody here: write a number from 1 to %zu, or # and the id of one on the sheet", word, count);
}

/* Inserts a sentence in the place of `member`, or of the worst (NULL). */
static tn_status insert(kept_run *kept, const tn_individual *member, const tn_breed_action *action)
{
    tn_session *session = kept->e.session;
    tn_genome genome = {0};
    tn_error error = {0};
    char *sentence = NULL, *event = NULL;
    const tn_by_hand_language language = tn_evolution_job_language(&kept->e.job);
    if (!action->sentence)
        return tn_session_refuse(session, NULL, "say which sentence is inserted");
    tn_status status =
        tn_by_hand_genome(&language, action->sentence, strlen(action->sentence), &genome, &sentence, &error);
    bool placed = status != TN_OK && sentence && error.line && error.column <= strlen(sentence);
    if (status == TN_OK && !(event = tn_by_hand_text(member ? member->id : TN_NO_PARENT, &genome)))
        status = tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_run_by_hand(&kept->e.run, member ? "edit" : "insert", event, &error);
    if (placed)
        tn_report_error(&session->opened->compilation.diagnostics, &error, action->file ? action->file : "sentence",
                        sentence, strlen(sentence));
    else if (status != TN_OK)
        tn_session_fail(session, &error);
    free(event);
    free(sentence);
    tn_genome_clear(&genome);
    return status;
}

static tn_status take_out(kept_run *kept, const tn_individual *member)
{
    char id[24];
    tn_error error;
    snprintf(id, sizeof id, "%" PRIu64, member->id);
    tn_status status = tn_run_by_hand(&kept->e.run, "remove", id, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(kept->e.session, &error);
}

static tn_status set(kept_run *kept, const tn_breed_action *action)
{
    tn_error error;
    tn_status status = tn_run_set(&kept->e.run, action->change ? action->change : "", &error);
    return status == TN_OK ? TN_OK : tn_session_fail(kept->e.session, &error);
}

static tn_status act(kept_run *kept, const tn_breed_action *action)
{
    const tn_individual *member = NULL;
    bool names = action->does == DOES_EDIT || action->does == DOES_OUT;
    tn_status status = names ? find_member(kept, action->member, &member) : TN_OK;
    if (status != TN_OK)
        return status;
    switch ((action_kind)action->does) {
    case DOES_BREED:
        return breed(kept, action);
    case DOES_SET:
        return set(kept, action);
    case DOES_INSERT:
    case DOES_EDIT:
        return insert(kept, member, action);
    case DOES_OUT:
        return take_out(kept, member);
    }
    return TN_OK;
}

/* What is new of the actions. */
static tn_status act_on(kept_run *kept, const tn_breed_request *request)
{
    tn_status status = TN_OK;
    while (status == TN_OK && kept->done.count < request->actions.count + 1) {
        const tn_breed_action *action = &request->actions.items[kept->done.count - 1];
        tn_error error;
        status = act(kept, action);
        if (status == TN_OK && (status = tn_owneds_add(&kept->done, action_text(action), &error)) != TN_OK) {
            kept->broken = true; /* it is not known any more what was done */
            tn_session_fail(kept->e.session, &error);
        }
    }
    return status;
}

/* ---- told */

static tn_status put_member(const tn_individual *member, size_t i, tn_bred_member *to, tn_error *error)
{
    bool valid = member->reason == TN_MAPPING_VALID;
    to->number = i + 1;
    to->parent = member->stayed || member->kind == TN_BIRTH_SEED;
    to->has_why_none = member->score.state != TN_SCORED;
    if (to->has_why_none && !(to->why_none = strdup(valid ? member->message : tn_mapping_reason_text(member->reason))))
        return tn_fail_memory(error);
    return tn_individual_put(member, &to->told, error);
}

static tn_status put_members(const kept_run *kept, tn_bred *told, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(kept->e.run.evolution, &count);
    tn_status status = TN_NEW_LIST(bred_member, told->members, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = put_member(members[i], i, &told->members.items[i], error);
    return status;
}

/* The sheet and its page. */
static tn_status make_sheet(const kept_run *kept, const tn_run_files *files, tn_bred *told, tn_error *error)
{
    char name[TN_SHEET_NAME_SIZE];
    tn_status status = tn_run_sheet(&kept->e.run, files, name, error);
    if (status != TN_OK)
        return status;
    told->has_sheet = true;
    told->sheet = strdup(name);
    if (!told->sheet)
        return tn_fail_memory(error);
    told->page = TN_SHEET_PAGE;
    return tn_sheet_page(&kept->e.run, files, &told->has_page, error);
}

static tn_status tell(kept_run *kept, bool results, tn_bred *told, tn_error *error)
{
    tn_run *run = &kept->e.run;
    tn_run_making making;
    told->has_run = run->dir != NULL;
    told->run = kept->e.asked->run;
    told->generation = run->generations - 1;
    told->more = run->generations <= kept->e.generations;
    told->extension = kept->e.job.extension;
    tn_run_making_begin(&making, &kept->e, (tn_list *)&told->files);
    tn_status status = put_members(kept, told, error);
    if (status != TN_OK)
        return status;
    return results ? tn_run_results(run, making.files, error) : make_sheet(kept, making.files, told, error);
}

tn_status tn_ask_breed(tn_session *session, const tn_breed_request *request, tn_reply *answer)
{
    kept_run *kept;
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = find_run(session, request, &kept);
    if (status == TN_OK)
        status = act_on(kept, request);
    if (status != TN_OK)
        return status;
    kept->e.asked = &request->asked;
    status = tn_reply_new(&tn_message_bred, answer, &error);
    if (status == TN_OK)
        status = tell(kept, request->results, answer->value, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}
