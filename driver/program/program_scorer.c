/* Asks a program about what is bred: writes the lines and meshes, and adds its numbers to the scores. */
#include "driver/program/program_scorer.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/place/shape.h"
#include "driver/program/keeper.h"
#include "runtime/base/file.h"
#include "runtime/base/json.h"
#include "runtime/geometry/write.h"
#include "runtime/place/model/terms.h"

#define BATCH_MAX 16u
#define SHARES 8u /* batches of a thread in a generation, so that one that is slow holds up little */

/* What is written about the individual that a thread is at. */
typedef struct writing {
    const tn_individual *individual; /* NULL: nobody is asked about */
    tn_json line;
    bool has_folder;
} writing;

struct tn_program_scorer {
    tn_external *program;
    tn_program_scoring options;
    tn_evaluator problem; /* evaluate is NULL: there is none */
    size_t first;         /* of the run's objectives that is the program's */
    writing *writings;    /* [threads] */
};

/* A question's texts. */
typedef struct asked {
    char *line, *folder; /* owned; no folder: NULL */
} asked;

tn_status tn_program_scorer_new(const tn_program_scoring *options, tn_program_scorer **scorer, tn_error *error)
{
    tn_program_scorer *s = calloc(1, sizeof *s);
    *scorer = NULL;
    if (!s)
        return tn_fail_memory(error);
    s->options = *options;
    s->writings = calloc(options->program.threads, sizeof *s->writings);
    tn_status status = s->writings ? tn_external_new(&options->program, &s->program, error) : tn_fail_memory(error);
    if (status == TN_OK)
        *scorer = s;
    else
        tn_program_scorer_free(s);
    return status;
}

void tn_program_scorer_free(tn_program_scorer *s)
{
    if (!s)
        return;
    tn_external_free(s->program);
    free(s->writings);
    free(s);
}

const tn_external *tn_program_scorer_program(const tn_program_scorer *scorer)
{
    return scorer->program;
}

tn_status tn_program_scorer_follow(tn_program_scorer *s, const tn_evaluator *problem, bool wants, tn_error *error)
{
    s->problem = *problem;
    s->first = s->options.separately && wants ? problem->objectives : 0;
    if (s->first + s->options.program.values <= TN_OBJECTIVES_MAX)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE,
            "`selection nsga2` weighs at most %u objectives; here are %zu goals and %zu numbers of the program",
            TN_OBJECTIVES_MAX, s->first, s->options.program.values);
    tn_error_help(error, "leave some goals out, or choose by the sum: `selection tournament 3`");
    return TN_INVALID;
}

size_t tn_program_scorer_number(const tn_program_scorer *s, size_t objective)
{
    return objective < s->first ? SIZE_MAX : objective - s->first;
}

/* ---- what the program reads */

static void write_measures(tn_json *json, const tn_form_facts *facts)
{
    tn_json_object(json, "measures");
    for (size_t i = 0; i < facts->count; i++)
        if (facts->names[i] && isfinite(facts->values[i]))
            tn_json_number(json, facts->names[i], facts->values[i]);
    tn_json_object_end(json);
}

static tn_status write_mesh(const tn_mesh *mesh, const char *path, tn_error *error)
{
    FILE *out = fopen(path, "we");
    if (!out)
        return tn_cannot_write(path, errno, error);
    tn_status status = tn_mesh_write_obj(mesh, &(tn_mesh_style){0}, out, error);
    bool written = !ferror(out);
    if ((fclose(out) != 0 || !written) && status == TN_OK)
        status = tn_cannot_write(path, errno, error);
    return status;
}

/* The folder of an individual's files. The caller frees it. */
static char *folder_of(const tn_program_scorer *s, uint64_t id)
{
    char *folder = NULL;
    return asprintf(&folder, "%s/%" PRIu64, tn_external_folder(s->program), id) < 0 ? NULL : folder;
}

static tn_status hear(void *context, unsigned thread, const tn_form_facts *facts, tn_error *error)
{
    tn_program_scorer *s = context;
    writing *w = &s->writings[thread];
    if (!w->individual)
        return TN_OK;
    char *folder = folder_of(s, w->individual->id), *path = NULL;
    tn_status status =
        folder && asprintf(&path, "%s/form.obj", folder) >= 0 ? tn_folder_make(folder, error) : tn_fail_memory(error);
    w->has_folder = status == TN_OK;
    if (status == TN_OK)
        status = write_mesh(facts->mesh, path, error);
    if (status == TN_OK) {
        tn_json_string(&w->line, "mesh", path);
        write_measures(&w->line, facts);
    }
    free(folder);
    free(path);
    return status;
}

tn_form_listener tn_program_scorer_listener(tn_program_scorer *scorer)
{
    return (tn_form_listener){scorer, hear};
}

tn_status tn_program_scorer_hear_model(void *scorer, unsigned thread, const tn_placed_facts *facts, tn_error *error)
{
    tn_mesh mesh = {0};
    unsigned char(*palette)[3] = NULL;
    tn_status status = tn_placed_mesh(facts->module, facts->model, &mesh, &palette, error);
    if (status == TN_OK)
        status =
            hear(scorer, thread, &(tn_form_facts){&mesh, tn_placed_terms, facts->terms, TN_PLACED_TERM_COUNT}, error);
    tn_mesh_clear(&mesh);
    free(palette);
    return status;
}

/* By the problem, which tells of the form that it builds. */
static tn_status score_problem(tn_program_scorer *s, unsigned thread, tn_individual *individual, tn_error *error)
{
    const tn_evaluator *problem = &s->problem;
    if (problem->evaluate_many)
        return problem->evaluate_many(problem->context, thread, &individual, 1, error);
    return problem->evaluate
               ? problem->evaluate(problem->context, thread, individual->sentence, individual->sentence_size,
                                   &individual->score, individual->message, error)
               : TN_OK;
}

static tn_status write_question(tn_program_scorer *s, unsigned thread, tn_individual *individual, asked *texts,
                                tn_question *question, tn_error *error)
{
    writing *w = &s->writings[thread];
    tn_buffer text = {0};
    *question = (tn_question){.id = individual->id};
    *w = (writing){individual, tn_json_text(&text, TN_JSON_SPACED), false};
    tn_json_object(&w->line, NULL);
    tn_json_count(&w->line, "id", individual->id);
    tn_json_string(&w->line, "sentence", individual->sentence);
    tn_status status = score_problem(s, thread, individual, error);
    tn_json_object_end(&w->line);
    tn_json_end_line(&w->line);
    texts->line = text.data;
    question->size = text.size;
    if (text.failed && status == TN_OK)
        status = tn_fail_memory(error);
    if (w->has_folder && !(texts->folder = folder_of(s, individual->id)) && status == TN_OK)
        status = tn_fail_memory(error);
    *w = (writing){0};
    question->line = texts->line;
    return status;
}

/* ---- scores */

static void take_answer(const tn_program_scorer *s, const tn_answer *answer, tn_individual *individual)
{
    tn_score *score = &individual->score;
    double sum = 0;
    if (answer->refusal[0]) {
        score->state = TN_SCORE_FAILED;
        snprintf(individual->message, sizeof individual->message, TN_PROGRAM_SAYS "%.187s", answer->refusal);
        return;
    }
    size_t values = s->options.program.values;
    if (s->options.by_cases) /* behind the one objective, the numbers of the program, and then this */
        score->objectives[1 + values] = score->objectives[0];
    for (size_t i = 0; i < values; i++) {
        double part = s->options.weight * answer->values[i];
        sum += part;
        if (s->options.separately)
            score->objectives[s->first + i] = part;
        if (s->options.by_cases)
            score->objectives[1 + i] = part;
    }
    if (!s->options.separately)
        score->objectives[0] += sum;
    if (isfinite(sum))
        return;
    score->state = TN_SCORE_FAILED;
    snprintf(individual->message, sizeof individual->message,
             TN_PROGRAM_SAYS "answered with numbers that are too large");
}

static void clear_asked(asked *texts)
{
    if (texts->folder)
        tn_folder_remove(texts->folder);
    free(texts->folder);
    free(texts->line);
}

static tn_status evaluate_many(void *context, unsigned thread, struct tn_individual *const *individuals, size_t count,
                               tn_error *error)
{
    tn_program_scorer *s = context;
    tn_question questions[BATCH_MAX];
    asked texts[BATCH_MAX] = {0};
    size_t places[BATCH_MAX], wanted = 0;
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        status = write_question(s, thread, individuals[i], &texts[i], &questions[wanted], error);
        places[wanted] = i;
        wanted += individuals[i]->score.state == TN_SCORED;
    }
    if (status == TN_OK && wanted)
        status = tn_external_ask(s->program, thread, questions, wanted, error);
    for (size_t i = 0; i < wanted && status == TN_OK; i++)
        take_answer(s, &questions[i].answer, individuals[places[i]]);
    for (size_t i = 0; i < count; i++)
        clear_asked(&texts[i]);
    return status;
}

static tn_status say_again(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                           char message[200], tn_error *error)
{
    const tn_program_scorer *s = context;
    const tn_evaluator *problem = &s->problem;
    tn_status status =
        problem->evaluate ? problem->evaluate(problem->context, thread, sentence, size, score, message, error) : TN_OK;
    if (status != TN_OK || score->state != TN_SCORED)
        return status;
    score->state = TN_SCORE_FAILED;
    snprintf(message, 200, TN_PROGRAM_SAYS "had no score for it in an earlier generation");
    return TN_OK;
}

/* "program weight 2" is ours; everything else is about the problem. */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    static const char words[] = "program weight ";
    tn_program_scorer *s = context;
    bool ours = strncasecmp(change, "program ", 8) == 0, weighs = strncasecmp(change, words, sizeof words - 1) == 0;
    if (!ours && s->problem.adjust)
        return s->problem.adjust(s->problem.context, change, error);
    char *end = NULL;
    double weight = weighs ? strtod(change + sizeof words - 1, &end) : 0;
    if (end && end > change + sizeof words - 1 && !*end && weight >= 0 && weight <= 1e6) {
        s->options.weight = weight;
        return TN_OK;
    }
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
    tn_error_help(error, "what the program counts can be changed, as \"program weight 2\"");
    return TN_INVALID;
}

tn_evaluator tn_program_scorer_evaluator(tn_program_scorer *s)
{
    size_t shared = s->options.population / (s->options.program.threads * SHARES);
    return (tn_evaluator){.context = s,
                          .objectives = s->options.separately ? s->first + s->options.program.values : 1,
                          .evaluate = say_again,
                          .adjust = adjust,
                          .evaluate_many = evaluate_many,
                          .cases = s->options.by_cases ? TN_PROGRAM_CASES(s->options.program.values) : 0,
                          .batch = shared < 1           ? 1
                                   : shared < BATCH_MAX ? shared
                                                        : BATCH_MAX};
}
