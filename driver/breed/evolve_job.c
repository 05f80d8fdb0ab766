/* Puts a run together from a study: grammar, settings, problem and first genomes. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/kit/with_rules.h"
#include "driver/breed/evolve.h"
#include "driver/breed/inputs.h"
#include "driver/open/missing.h"
#include "runtime/base/array.h"
#include "runtime/base/crew.h"
#include "runtime/base/file.h"

static tn_status evolution_forms(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                                 tn_error *error);

#define DATA_BYTES_MAX ((size_t)256 << 20)

void tn_evolution_job_clear(tn_evolution_job *job)
{
    tn_program_scorer_free(job->program);
    tn_problem_free(job->problem);
    tn_learner_free(job->learner);
    tn_grower_free(job->grower);
    tn_design_scorer_free(job->designs);
    tn_placer_free(job->placer);
    tn_field_scorer_free(job->fields);
    tn_field_parents_free(job->parents);
    tn_skeleton_free(job->skeleton);
    tn_grammar_free(job->grammar);
    for (size_t i = 0; i < job->seed_count; i++)
        tn_genome_clear(&job->seeds[i]);
    free(job->seeds);
    free(job->seeds_text);
    free(job->blamed_path);
    free(job->identity);
    free(job->inputs);
    *job = (tn_evolution_job){0};
}

/* ---- settings */

static uint32_t whole(const tn_evolution_study *s, tn_setting setting)
{
    return (uint32_t)s->of[setting].first;
}

/* Choices are in the engine's order (settings.def). */
static void translate_operators(const tn_evolution_study *s, tn_evolution_settings *out)
{
    const tn_setting_value *selection = &s->of[TN_SET_SELECTION], *crossover = &s->of[TN_SET_CROSSOVER],
                           *mutation = &s->of[TN_SET_MUTATION];
    out->select.selection = (tn_selection)selection->choice;
    if (selection->written == 2 && out->select.selection == TN_SELECT_TRUNCATION)
        out->select.truncation = selection->second;
    else if (selection->written == 2)
        out->select.tournament = (uint32_t)selection->second;
    out->vary.crossover = (tn_crossover)crossover->choice;
    out->vary.crossover_rate = crossover->second;
    out->vary.mutation = (tn_mutation)mutation->choice;
    out->vary.mutation_rate = mutation->second;
    out->vary.within_used = s->of[TN_SET_POINTS].choice == 0;
    out->vary.codon_limit = (uint64_t)s->of[TN_SET_CODON_LIMIT].first;
    out->vary.max_codons = whole(s, TN_SET_MAX_CODONS);
    out->vary.tree_depth = s->of[TN_SET_TREE_DEPTH].written ? whole(s, TN_SET_TREE_DEPTH) : out->depth_high;
}

static void translate(const tn_evolution_study *s, const tn_grammar *grammar, const tn_evolution_job_options *options,
                      tn_evolution_settings *out)
{
    *out = tn_evolution_settings_default();
    out->seed = options->says_seed ? options->seed : tn_setting_whole64(&s->of[TN_SET_SEED]);
    out->population = whole(s, TN_SET_POPULATION);
    out->initialisation = (tn_initialisation)s->of[TN_SET_INITIALISE].choice;
    out->codons = whole(s, TN_SET_CODONS);
    out->depth_low = whole(s, TN_SET_DEPTH);
    out->depth_high = (uint32_t)s->of[TN_SET_DEPTH].second;
    out->tail = s->of[TN_SET_TAIL].first;
    translate_operators(s, out);
    out->elites = whole(s, TN_SET_ELITES);
    out->keeps_copies = s->of[TN_SET_COPIES].choice == 1;
    out->islands = whole(s, TN_SET_ISLANDS);
    out->migrants = whole(s, TN_SET_MIGRATE);
    out->every = (uint32_t)s->of[TN_SET_MIGRATE].second;
    out->replacement = (tn_replacement)s->of[TN_SET_REPLACEMENT].choice;
    if (grammar)
        out->mapping = tn_mapping_options_of(grammar);
    if (s->of[TN_SET_MAX_DEPTH].written)
        out->mapping.max_depth = whole(s, TN_SET_MAX_DEPTH);
    if (s->of[TN_SET_WRAPS].written)
        out->mapping.wraps = whole(s, TN_SET_WRAPS);
    if (s->of[TN_SET_MAPPING].written)
        out->mapping.position_independent = s->of[TN_SET_MAPPING].choice == 1;
    out->mapping.max_steps = (uint64_t)s->of[TN_SET_MAX_STEPS].first;
    out->threads = options->threads ? options->threads : tn_crew_default();
    out->watch = options->watch;
    out->ranks = options->ranks;
    out->remembers = options->remembers;
}

/* Everything that decides what the run does, but for how long, a setting a line: two runs of one identity are the same
 * run. */
static char *identity_of(const tn_evolution_job *job)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        tn_setting_value value = job->study.of[i];
        if (!(tn_setting_rows[i].use & tn_evolution_study_use(&job->study)) ||
            tn_setting_rows[i].kind == TN_SETTING_EACH)
            continue;
        bool follows =
            i == TN_SET_MAX_DEPTH || i == TN_SET_WRAPS || i == TN_SET_TREE_DEPTH || i == TN_SET_MAX_STEPS ||
            tn_setting_rows[i].kind == TN_SETTING_TEXT || /* from the grammar, or nothing, where not written */
            i >= TN_SET_TEST; /* newer than runs that lack them, where they say what always held */
        if (i == TN_SET_GENERATIONS || i == TN_SET_STOP || i == TN_SET_PROGRAM_TIMEOUT ||
            (follows && value.written == 0))
            continue;
        if (i == TN_SET_CROSSOVER)
            value.written = 2; /* its default number is said too */
        if (i == TN_SET_SEED)
            fprintf(out, "seed %" PRIu64, job->settings.seed);
        else
            tn_setting_write(out, i, &value);
        fputc('\n', out);
    }
    for (uint32_t i = 0; i < job->study.each_count; i++) {
        tn_setting_write(out, job->study.each[i].setting, &job->study.each[i].value);
        fputc('\n', out);
    }
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return text;
    free(text);
    return NULL;
}

/* ---- the problem */

/* The path of the file that a setting names; from here on what fails is that setting's to blame. */
static tn_status find_data(tn_evolution_job *job, tn_setting setting, const char *study, tn_error *error)
{
    free(job->blamed_path);
    job->blamed = setting;
    job->blamed_path = tn_file_beside(study, job->study.of[setting].text);
    return job->blamed_path ? TN_OK : tn_fail_memory(error);
}

static tn_status read_data(tn_evolution_job *job, tn_setting setting, const char *study, uint8_t **bytes, size_t *size,
                           tn_error *error)
{
    tn_status status = find_data(job, setting, study, error);
    return status == TN_OK ? tn_file_read(job->blamed_path, DATA_BYTES_MAX, bytes, size, error) : status;
}

/* Nothing is scored by these, so that they are no input of the run. */
static tn_status hold_data(tn_evolution_job *job, const char *path, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_status status = read_data(job, TN_SET_TEST, path, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    status = tn_problem_hold_csv(job->problem, (const char *)bytes, size, error);
    free(bytes);
    return status;
}

static tn_status make_fit(tn_evolution_job *job, const char *path, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_status status = read_data(job, TN_SET_FIT, path, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    tn_fit_options options = {.error = (tn_fit_error)job->study.of[TN_SET_ERROR].choice,
                              .scaled = job->study.of[TN_SET_SCALING].choice == 1,
                              .threads = job->settings.threads};
    status = tn_inputs_add(&job->inputs, "fit", job->blamed_path, bytes, size, error);
    if (status == TN_OK)
        status = tn_problem_fit_csv((const char *)bytes, size, &options, &job->problem, error);
    free(bytes);
    return status == TN_OK && job->study.of[TN_SET_TEST].written ? hold_data(job, path, error) : status;
}

static bool weighs_separately(const tn_evolution_job *job)
{
    return job->settings.select.selection == TN_SELECT_NSGA2;
}

/* Does a program score too? */
static bool is_asked(const tn_evolution_job *job)
{
    return job->study.of[TN_SET_PROGRAM].written > 0;
}

static bool selects_by_cases(const tn_evolution_job *job)
{
    tn_selection selection = job->settings.select.selection;
    return selection == TN_SELECT_LEXICASE || selection == TN_SELECT_EPSILON_LEXICASE;
}

/* How many errors in single cases the scores of a job hold: where it selects by those that its program answers with. */
static size_t evolution_held_cases(const tn_evolution_job *job)
{
    size_t values = (size_t)job->study.of[TN_SET_PROGRAM_VALUES].first;
    return is_asked(job) && selects_by_cases(job) ? TN_PROGRAM_CASES(values) : 0;
}

static tn_status make_learner(tn_evolution_job *job, const char *path, tn_error *error)
{
    const char *schema = job->study.of[TN_SET_SCHEMA].text;
    job->blamed = TN_SET_SCHEMA;
    tn_status status = tn_learner_new(schema ? schema : "lahave", path, job->study.of[TN_SET_LENGTH_WEIGHT].first,
                                      weighs_separately(job), &job->learner, error);
    if (status == TN_OK)
        status = tn_inputs_add_sources(&job->inputs, "schema", tn_learner_schema(job->learner), UINT32_MAX, error);
    static const tn_setting sources[] = {TN_SET_KEEP, TN_SET_DROP};
    for (size_t i = 0; i < 2 && status == TN_OK; i++) {
        status = find_data(job, sources[i], path, error);
        if (status == TN_OK)
            status = tn_inputs_add_file(&job->inputs, tn_setting_rows[sources[i]].name, job->blamed_path, error);
        if (status == TN_OK)
            status = tn_learner_read(job->learner, job->blamed_path, sources[i] == TN_SET_DROP, error);
    }
    return status;
}

static tn_status make_grower(tn_evolution_job *job, const char *path, tn_error *error)
{
    tn_status status = find_data(job, TN_SET_GROW, path, error);
    if (status == TN_OK)
        status = tn_grower_new(job->blamed_path, weighs_separately(job), is_asked(job), job->settings.threads,
                               &job->grower, error);
    job->forms = (tn_bred_forms){job->grower,         "surface",      ".svg",         tn_grower_draw,
                                 tn_grower_objective, tn_grower_mesh, tn_grower_unmet};
    return status == TN_OK ? tn_grower_inputs(job->grower, &job->inputs, error) : status;
}

static tn_status make_designs(tn_evolution_job *job, const char *path, tn_error *error)
{
    tn_status status = find_data(job, TN_SET_BUILD, path, error);
    if (status == TN_OK)
        status = tn_design_scorer_new(job->blamed_path, weighs_separately(job), is_asked(job), &job->designs, error);
    job->forms = tn_bred_designs(job->designs);
    return status == TN_OK ? tn_design_scorer_inputs(job->designs, &job->inputs, error) : status;
}

typedef struct kit_inputs {
    const char *kit; /* that names the files */
    char **inputs;
} kit_inputs;

static tn_status add_file(void *context, const char *path, tn_error *error)
{
    const kit_inputs *to = context;
    char *whole = tn_path_beside(to->kit, path, "");
    tn_status status = whole ? tn_inputs_add_file(to->inputs, "place", whole, error) : tn_fail_memory(error);
    free(whole);
    return status;
}

/* The kit, all that it uses, and what these name. */
static tn_status add_kit(const tn_module *module, char **inputs, tn_error *error)
{
    tn_status status = tn_inputs_add_sources(inputs, "place", module, UINT32_MAX, error);
    for (uint32_t i = 0; i < module->SOURCE_count && status == TN_OK; i++) {
        const tn_source_record *source = &module->SOURCE_records[i];
        kit_inputs to = {tn_text(module, source->path), inputs};
        status = tn_kit_attached(tn_text(module, source->text), add_file, &to, error);
    }
    return status;
}

static tn_status make_placer(tn_evolution_job *job, const char *path, tn_error *error)
{
    tn_status status = find_data(job, TN_SET_PLACE, path, error);
    if (status == TN_OK)
        status = tn_placer_new(job->blamed_path, weighs_separately(job), is_asked(job), &job->placer, error);
    job->forms =
        (tn_bred_forms){job->placer, "model", ".svg", tn_placer_draw, tn_placer_objective, NULL, tn_placer_unmet};
    return status == TN_OK ? add_kit(tn_placer_kit(job->placer), &job->inputs, error) : status;
}

/* An evaluator's function for runs that only recall scores: TN_INTERNAL. */
static tn_status never_evaluate(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                                char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)score, (void)message;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a score is missing in the run's database");
}

static tn_status never_evaluate_cases(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                                      tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)errors;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a parent is missing in the run's database");
}

static tn_status make_problem(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                              tn_error *error)
{
    const tn_evolution_study *s = &job->study;
    tn_status status = TN_OK;
    bool learns = s->of[TN_SET_KEEP].written, grows = s->of[TN_SET_GROW].written, builds = s->of[TN_SET_BUILD].written,
         places = s->of[TN_SET_PLACE].written;
    job->extension = learns ? "plan" : grows ? "hemls" : builds ? "solid" : places ? "kit" : "txt";
    if (options->only_replay) {
        size_t held = evolution_held_cases(job);
        job->evaluator = (tn_evaluator){.objectives = (size_t)options->objectives,
                                        .evaluate = never_evaluate,
                                        .cases = held ? held : 1,
                                        .evaluate_cases = held ? NULL : never_evaluate_cases};
        return TN_OK;
    }
    if (learns)
        status = make_learner(job, path, error);
    else if (grows)
        status = make_grower(job, path, error);
    else if (builds)
        status = make_designs(job, path, error);
    else if (places)
        status = make_placer(job, path, error);
    else if (s->of[TN_SET_FIT].written)
        status = make_fit(job, path, error);
    else if (s->of[TN_SET_MATCH].written)
        status = tn_problem_match(s->of[TN_SET_MATCH].text, &job->problem, error);
    else
        return TN_OK; /* the program alone scores */
    if (status == TN_OK)
        job->evaluator = job->grower    ? tn_grower_evaluator(job->grower)
                         : job->designs ? tn_design_scorer_evaluator(job->designs)
                         : job->placer  ? tn_placer_evaluator(job->placer)
                         : job->learner ? tn_learner_evaluator(job->learner)
                                        : tn_problem_evaluator(job->problem);
    return status;
}

/* ---- a program that scores too */

/* The program's whole path. The caller frees it. */
static tn_status find_program(const tn_evolution_job *job, const char *path, char **whole, tn_error *error)
{
    char *beside = tn_file_beside(path, job->study.of[TN_SET_PROGRAM].text);
    *whole = beside ? realpath(beside, NULL) : NULL;
    int reason = errno;
    tn_status status = *whole ? TN_OK : beside ? tn_cannot_read(beside, reason, error) : tn_fail_memory(error);
    free(beside);
    return status;
}

static tn_status refuse_program(const char *program, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PROGRAM_REFUSED, "this study runs the program %.350s for its scores", program);
    tn_error_help(error, "read the program first; if you trust it, say --run-programs");
    return TN_INVALID;
}

/* Does the problem want anything of its own? */
static bool wants(const tn_evolution_job *job)
{
    return job->grower    ? tn_grower_wants(job->grower)
           : job->designs ? tn_design_scorer_wants(job->designs)
           : job->placer  ? tn_placer_wants(job->placer)
           : job->fields  ? tn_field_scorer_wants(job->fields)
                          : false;
}

static void listen(tn_evolution_job *job)
{
    tn_form_listener listener = tn_program_scorer_listener(job->program);
    if (job->grower)
        tn_grower_tell(job->grower, listener);
    if (job->designs)
        tn_design_scorer_tell(job->designs, listener);
    if (job->fields)
        tn_field_scorer_tell(job->fields, listener);
    if (job->placer)
        tn_placer_tell(job->placer, tn_program_scorer_hear_model, job->program);
}

static tn_status take_program(tn_evolution_job *job, const char *program, tn_error *error)
{
    const tn_evolution_study *s = &job->study;
    const tn_program_scoring scoring = {
        .program = {.path = program,
                    .threads = job->settings.threads,
                    .seconds = (unsigned)s->of[TN_SET_PROGRAM_TIMEOUT].first,
                    .values = (size_t)s->of[TN_SET_PROGRAM_VALUES].first,
                    .watch = job->settings.watch},
        .weight = s->of[TN_SET_PROGRAM].second,
        .separately = weighs_separately(job),
        .by_cases = selects_by_cases(job),
        .population = job->settings.population,
    };
    tn_status status = tn_inputs_add_file(&job->inputs, "fitness program", program, error);
    if (status == TN_OK)
        status = tn_program_scorer_new(&scoring, &job->program, error);
    if (status == TN_OK)
        status = tn_program_scorer_follow(job->program, &job->evaluator, wants(job), error);
    if (status != TN_OK)
        return status;
    listen(job);
    job->evaluator = tn_program_scorer_evaluator(job->program);
    return TN_OK;
}

/* After the problem is made: from here on the evaluator asks the program too. */
static tn_status add_program(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                             tn_error *error)
{
    char *program = NULL;
    job->blamed = TN_SET_PROGRAM;
    for (job->blamed_each = 0; job->study.each[job->blamed_each].setting != TN_SET_PROGRAM;)
        job->blamed_each++;
    tn_status status = find_program(job, path, &program, error);
    if (status == TN_OK)
        status = options->run_programs ? take_program(job, program, error) : refuse_program(program, error);
    free(program);
    return status;
}

/* ---- first genomes */

/* First genomes, one a line. */
static tn_status read_seeds(tn_evolution_job *job, const char *text, size_t size, tn_error *error)
{
    size_t line = 0, capacity = 0;
    for (size_t at = 0; at < size; at++) {
        const char *end = memchr(text + at, '\n', size - at);
        size_t length = end ? (size_t)(end - text) - at : size - at;
        line++;
        if (length && text[at] != '#' && job->seed_count < job->settings.population) {
            if (!tn_array_reserve_from(&job->seeds, &capacity, 16, job->seed_count, 1, sizeof *job->seeds))
                return tn_fail_memory(error);
            job->seeds[job->seed_count] = (tn_genome){0};
            tn_status status = tn_genome_read(text + at, length, &job->seeds[job->seed_count++], error);
            if (status != TN_OK) {
                if (error)
                    error->line = line;
                return status;
            }
        }
        at += length;
    }
    job->settings.seeds = job->seeds;
    job->settings.seed_count = job->seed_count;
    if (job->seed_count)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_GENOME_SYNTAX, "there are no genomes in this file");
    tn_error_help(error, "write a genome on each line, as `12 7 104 3`, or leave `seeds` out");
    return TN_INVALID;
}

static tn_status take_seeds(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    if (!job->study.of[TN_SET_SEEDS].written)
        return TN_OK;
    uint8_t *bytes = NULL;
    size_t size;
    tn_status status = stored ? TN_OK : read_data(job, TN_SET_SEEDS, path, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    job->seeds_text = stored ? strdup(stored) : strndup((const char *)bytes, size);
    free(bytes);
    if (job->seeds_text && tn_inputs_add(&job->inputs, "seeds", job->study.of[TN_SET_SEEDS].text, job->seeds_text,
                                         strlen(job->seeds_text), error) != TN_OK)
        return TN_MEMORY;
    return job->seeds_text ? read_seeds(job, job->seeds_text, strlen(job->seeds_text), error) : tn_fail_memory(error);
}

static tn_status make_codons(tn_evolution_job *job, const char *path, const tn_module *module,
                             const tn_evolution_job_options *options, tn_error *error)
{
    uint32_t own = job->study.of[TN_SET_GRAMMAR].file;
    tn_status status = tn_inputs_add_sources(&job->inputs, "grammar", module, own, error);
    if (status == TN_OK)
        status = take_seeds(job, path, options->stored_seeds, error);
    return status == TN_OK ? make_problem(job, path, options, error) : status;
}

tn_status tn_evolution_job_make(const tn_evolution_study *study, const char *path, const tn_module *module,
                                const tn_evolution_job_options *options, tn_evolution_job *job, tn_error *error)
{
    *job = (tn_evolution_job){.study = *study, .blamed = TN_SETTING_COUNT};
    bool codons = tn_evolution_study_use(study) == TN_USE_CODONS;
    tn_status status = codons ? tn_grammar_new(module, 0, &job->grammar, error) : TN_OK;
    if (status == TN_OK)
        translate(study, job->grammar, options, &job->settings);
    if (status == TN_OK)
        status = codons ? make_codons(job, path, module, options, error) : evolution_forms(job, path, options, error);
    if (status == TN_OK && is_asked(job) && !options->only_replay)
        status = add_program(job, path, options, error);
    if (status != TN_OK)
        return status;
    job->blamed = TN_SETTING_COUNT;
    job->identity = identity_of(job);
    return job->identity ? TN_OK : tn_fail_memory(error);
}

/* ---- forms bred as what they are: fields, and designs of boxes */

static tn_tree_variation tree_variation(const tn_evolution_study *s)
{
    return (tn_tree_variation){.order = (tn_pick_order)s->of[TN_SET_CHOICE].choice,
                               .maxprob = s->of[TN_SET_MAXPROB].first,
                               .mutation_rate = s->of[TN_SET_MUTATION_RATE].first,
                               .shares = {s->of[TN_SET_SWAP_NODES].first, s->of[TN_SET_SWAP_SUBTREES].first,
                                          s->of[TN_SET_DESTROY].first, s->of[TN_SET_NUDGE].first},
                               .max_nodes = (uint32_t)s->of[TN_SET_MAX_NODES].first};
}

/* The parents as text: from the run, or else from their files. */
static tn_status parents_text(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    if (stored) {
        job->seeds_text = strdup(stored);
        return job->seeds_text ? TN_OK : tn_fail_memory(error);
    }
    job->blamed = TN_SET_PARENT;
    tn_status status =
        tn_field_parents_read(&job->study, path, &job->seeds_text, &job->inputs, &job->blamed_each, error);
    if (status != TN_OK && job->blamed_each == UINT32_MAX)
        job->blamed = TN_SET_BOX;
    return status;
}

static tn_status take_parents(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    tn_status status = parents_text(job, path, stored, error);
    if (status == TN_OK)
        status = tn_field_parents_of(job->seeds_text, &job->parents, error);
    if (status != TN_OK)
        return status;
    tn_tree_breeding *breeding = tn_field_parents_breeding(job->parents);
    if (breeding->parent_count > job->settings.population) {
        job->blamed = TN_SET_POPULATION;
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "there are more parents than individuals");
        tn_error_help(error, "make the population at least %zu", breeding->parent_count);
        return TN_INVALID;
    }
    breeding->how = tree_variation(&job->study);
    job->kind = tn_tree_kind(breeding);
    job->settings.kind = &job->kind;
    job->settings.seeds = breeding->parents;
    job->settings.seed_count = breeding->parent_count;
    return TN_OK;
}

static tn_status make_fields(tn_evolution_job *job, const char *path, bool draws_open, tn_error *error)
{
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    uint32_t each = UINT32_MAX;
    tn_status status = tn_field_scorer_new(&job->study, path, separately, &job->fields, &job->inputs, &each, error);
    job->blamed_each = each;
    job->blamed = each < job->study.each_count ? job->study.each[each].setting : TN_SETTING_COUNT;
    if (status != TN_OK)
        return status;
    job->forms = (tn_bred_forms){
        job->fields, "surface", ".png", tn_field_scorer_draw, tn_field_scorer_objective, tn_field_scorer_mesh, NULL};
    if (draws_open)
        tn_field_scorer_draw_open(job->fields);
    job->evaluator = tn_field_scorer_evaluator(job->fields);
    job->scored = job->study.of[TN_SET_FITNESS].written || job->study.of[TN_SET_LIKENESS].written ||
                  job->study.of[TN_SET_PROGRAM].written;
    return TN_OK;
}

/* ---- designs of boxes */

tn_bred_forms tn_bred_designs(const tn_design_scorer *designs)
{
    return (tn_bred_forms){designs,
                           "form",
                           ".svg",
                           tn_design_scorer_draw,
                           tn_design_scorer_objective,
                           tn_design_scorer_mesh,
                           tn_design_scorer_unmet};
}

static tn_status take_skeleton(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    size_t seeds;
    tn_status status = TN_OK;
    job->blamed = TN_SET_DESIGN;
    job->seeds_text = stored ? strdup(stored) : NULL;
    if (stored && !job->seeds_text)
        return tn_fail_memory(error);
    if (!stored)
        status = tn_skeleton_read(&job->study, path, &job->seeds_text, &job->inputs, error);
    if (status == TN_OK)
        status = tn_skeleton_of(job->seeds_text, &job->study, &job->skeleton, &job->blamed, error);
    if (status != TN_OK)
        return status;
    job->kind = tn_box_kind(tn_skeleton_breeding(job->skeleton));
    job->settings.kind = &job->kind;
    job->settings.seeds = tn_skeleton_seed(job->skeleton, &seeds);
    job->settings.seed_count = seeds;
    return TN_OK;
}

static tn_status make_boxes(tn_evolution_job *job, const char *path, tn_error *error)
{
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    char *design = tn_file_beside(path, job->study.of[TN_SET_DESIGN].text);
    tn_status status =
        design ? tn_design_scorer_new(design, separately, true, &job->designs, error) : tn_fail_memory(error);
    free(design);
    if (status == TN_OK) {
        job->blamed = TN_SET_FITNESS;
        status = tn_design_scorer_add(job->designs, &job->study, &job->blamed_each, error);
    }
    if (status == TN_OK)
        status = tn_design_scorer_take_genes(job->designs, tn_skeleton_breeding(job->skeleton), error);
    if (status != TN_OK)
        return status;
    job->forms = tn_bred_designs(job->designs);
    job->evaluator = tn_design_scorer_evaluator(job->designs);
    job->scored = tn_design_scorer_wants(job->designs) || job->study.of[TN_SET_PROGRAM].written;
    return TN_OK;
}

/* Makes kind, first genomes and evaluator of a job whose settings are translated. */
static tn_status evolution_forms(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                                 tn_error *error)
{
    bool fields = tn_evolution_study_use(&job->study) == TN_USE_TREES;
    job->extension = fields ? "field" : "solid";
    tn_status status = fields ? take_parents(job, path, options->stored_seeds, error)
                              : take_skeleton(job, path, options->stored_seeds, error);
    if (status == TN_OK && !options->only_replay)
        return fields ? make_fields(job, path, options->draws_open, error) : make_boxes(job, path, error);
    job->evaluator = (tn_evaluator){
        .objectives = (size_t)options->objectives, .evaluate = never_evaluate, .cases = evolution_held_cases(job)};
    return status;
}
