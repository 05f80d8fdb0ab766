/* Looks for first generations with few different sentences, or with none that names a column of the data; and for data
 * without names. */
#include <stdio.h>

#include "driver/breed/evolve_replay.h"

#define FEW 4u              /* different sentences are few where they are fewer than one in so many */
#define SENTENCES_LEAST 10u /* of fewer, nothing is said */
#define TRIAL_MOST 2000u    /* individuals of a generation that is made to see what another depth gives */
#define DEPTH_MOST 10000u   /* of settings.def */
#define SHOWN 90            /* bytes of the columns' names */

static tn_finding *add(tn_first_look *look, tn_code code)
{
    tn_finding *finding = &look->items[look->count++];
    *finding = (tn_finding){.code = code};
    return finding;
}

/* ---- few different sentences */

static tn_status score_nothing(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                               char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)message, (void)error;
    score->objectives[0] = 0;
    return TN_OK;
}

/* How many different sentences a first generation has that is made so; nobody scores it. */
static tn_status try(const tn_run *run, const tn_evolution_settings *settings, uint32_t *distinct, tn_error *error)
{
    static const tn_evaluator evaluator = {.objectives = 1, .evaluate = score_nothing};
    tn_evolution *trial = NULL;
    tn_status status = tn_evolution_new(run->job->grammar, settings, &evaluator, &trial, error);
    if (status == TN_OK)
        status = tn_evolution_step(trial, error);
    *distinct = status == TN_OK ? tn_evolution_stats(trial).distinct : 0;
    tn_evolution_free(trial);
    return status;
}

/* Another way to make the first generation. */
typedef struct proposal {
    tn_initialisation initialisation;
    uint32_t deeper; /* levels that the largest depth is raised by */
} proposal;

static void propose(const tn_evolution_settings *from, const proposal *p, tn_evolution_settings *to)
{
    *to = *from;
    to->initialisation = p->initialisation;
    to->depth_high += to->depth_high + p->deeper <= DEPTH_MOST ? p->deeper : 0;
    to->select = (tn_select_options){.selection = TN_SELECT_TOURNAMENT, .tournament = 2};
    to->islands = 1;
    to->every = 0;
    to->population = from->population < TRIAL_MOST ? from->population : TRIAL_MOST;
    to->elites = 1;
    to->remembers = false;
    to->ranks = NULL;
}

static void describe(const tn_evolution_settings *now, const tn_evolution_settings *other, uint32_t distinct,
                     tn_finding *finding)
{
    char depth[48];
    snprintf(depth, sizeof depth, "`depth %u..%u`", other->depth_low, other->depth_high);
    const char *way = other->initialisation == TN_INITIALISE_PI_GROW ? "`initialise pi-grow`" : "`initialise ramped`";
    bool other_way = now->initialisation != other->initialisation, deeper = now->depth_high != other->depth_high;
    snprintf(finding->help, sizeof finding->help, "%s%s%s makes %u different ones of %u", other_way ? way : "",
             other_way && deeper ? " with " : "", deeper ? depth : "", distinct, other->population);
}

/* The first way that makes twice as many, and half of them different; or else the best of those that make half as many
 * again. */
static tn_status find_better(const tn_run *run, tn_finding *finding, tn_error *error)
{
    const tn_evolution_settings *now = &run->job->settings;
    bool random = now->initialisation == TN_INITIALISE_RANDOM;
    tn_initialisation method = random ? TN_INITIALISE_RAMPED : now->initialisation;
    const proposal proposals[] = {
        {method, random ? 0 : 2}, {method, 4}, {TN_INITIALISE_PI_GROW, 0}, {method, 8}, {TN_INITIALISE_PI_GROW, 4}};
    tn_evolution_settings settings;
    uint32_t distinct, today, best;
    propose(now, &(proposal){now->initialisation, 0}, &settings);
    tn_status status = try(run, &settings, &today, error);
    best = today + today / 2;
    for (size_t i = 0; i < sizeof proposals / sizeof *proposals && status == TN_OK; i++) {
        propose(now, &proposals[i], &settings);
        status = try(run, &settings, &distinct, error);
        if (status != TN_OK || distinct <= best)
            continue;
        best = distinct;
        describe(now, &settings, distinct, finding);
        if (distinct >= 2 * today && distinct >= settings.population / 2)
            break;
    }
    return status;
}

static tn_status look_for_few(const tn_run *run, tn_first_look *look, tn_error *error)
{
    tn_generation_stats s = tn_evolution_stats(run->evolution);
    uint32_t sentences = s.scored + s.failed + s.limited;
    if (!run->job->grammar || sentences < SENTENCES_LEAST || s.distinct * FEW >= sentences)
        return TN_OK;
    tn_finding *finding = add(look, W_FEW_SENTENCES);
    snprintf(finding->message, sizeof finding->message,
             "of %u sentences of the first generation, only %u are different", sentences, s.distinct);
    return find_better(run, finding, error);
}

/* ---- no column */

static void name_columns(const tn_problem *problem, char *text, size_t size)
{
    size_t count, length = 0;
    const char *const *names = tn_problem_columns(problem, &count);
    text[0] = '\0';
    for (size_t i = 0; i < count && length < SHOWN; i++)
        length += (size_t)snprintf(text + length, size - length, "%s`%.40s`", i ? ", " : "", names[i]);
}

static tn_status look_for_columns(const tn_run *run, tn_first_look *look, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    bool read = false;
    if (!run->job->problem || !run->job->study.of[TN_SET_FIT].written)
        return TN_OK;
    for (size_t i = 0; i < count; i++) {
        bool names;
        if (members[i]->score.state != TN_SCORED)
            continue;
        tn_status status =
            tn_problem_names_column(run->job->problem, members[i]->sentence, members[i]->sentence_size, &names, error);
        if (status != TN_OK || names)
            return status;
        read = true;
    }
    if (!read)
        return TN_OK; /* why not is told */
    char names[200];
    name_columns(run->job->problem, names, sizeof names);
    tn_finding *finding = add(look, W_NO_COLUMN);
    snprintf(finding->message, sizeof finding->message,
             "no sentence of the first generation that can be scored names a column of the data");
    snprintf(finding->help, sizeof finding->help,
             "its columns are %s; the grammar can also say x[:, 0], x[:, 1] and so on", names);
    return TN_OK;
}

/* A line of numbers is no line of names, whatever was meant. */
static void look_for_names(const tn_run *run, tn_first_look *look)
{
    if (!run->job->problem || !run->job->study.of[TN_SET_FIT].written || !tn_problem_unnamed(run->job->problem))
        return;
    char names[200];
    name_columns(run->job->problem, names, sizeof names);
    tn_finding *finding = add(look, W_NO_HEADER);
    snprintf(finding->message, sizeof finding->message,
             "the data have no line of names: their first line is numbers, and is fitted, too");
    snprintf(finding->help, sizeof finding->help,
             "the columns are called %s and, what is wanted, `y`; write a first line with their names, or one that "
             "begins with # if these are numbers",
             names);
}

tn_status tn_run_first_look(const tn_run *run, tn_first_look *look, tn_error *error)
{
    *look = (tn_first_look){0};
    look_for_names(run, look);
    tn_status status = look_for_few(run, look, error);
    if (status == TN_OK)
        status = look_for_columns(run, look, error);
    for (size_t i = 0; i < look->count; i++) {
        const tn_finding said = look->items[i];
        snprintf(look->items[i].text, sizeof look->items[i].text, "%s%s%s", said.message, said.help[0] ? "; " : "",
                 said.help);
    }
    return status;
}
