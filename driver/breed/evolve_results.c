/* What a person has of a run: the best sentences, statistics, a plot. All of it is derived from the run's database and
 * can be made again. */
#include "driver/breed/evolve_results.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "compiler/format.h"
#include "driver/breed/evolve.h"
#include "runtime/base/file.h"
#include "runtime/genome/picture/plot.h"
#include "runtime/genome/picture/tree_draw.h"

/* ---- where files go */

static char *path_of(const char *dir, const char *name)
{
    char *path = NULL;
    return asprintf(&path, "%s/%s", dir, name) < 0 ? NULL : path;
}

tn_status tn_run_file_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_file *file,
                            tn_error *error)
{
    *file = (tn_run_file){.files = files};
    if (files)
        return files->opens(files->context, name, &file->stream, error);
    char *path = path_of(dir, name);
    tn_status status = path ? tn_output_open(path, &file->output, error) : tn_fail_memory(error);
    file->stream = status == TN_OK ? file->output.stream : NULL;
    free(path);
    return status;
}

tn_status tn_run_file_end(tn_run_file *file, tn_status status, tn_error *error)
{
    if (file->files)
        return file->files->closes(file->files->context, status, error);
    if (status == TN_OK)
        return tn_output_commit(&file->output, error);
    tn_output_discard(&file->output);
    return status;
}

tn_status tn_run_picture_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_picture *picture,
                               tn_error *error)
{
    *picture = (tn_run_picture){.files = files, .name = name};
    if (files)
        return tn_canvas_format_of(name, &picture->to.format, error);
    picture->path = path_of(dir, name);
    picture->to.path = picture->path;
    return picture->path ? TN_OK : tn_fail_memory(error);
}

tn_status tn_run_picture_end(tn_run_picture *picture, tn_status status, tn_error *error)
{
    tn_run_file file;
    if (status == TN_OK && picture->files) {
        status = tn_run_file_begin(NULL, picture->files, picture->name, &file, error);
        if (status == TN_OK) {
            fwrite(picture->to.element, 1, picture->to.size, file.stream); /* what fails shows when it is ended */
            status = tn_run_file_end(&file, TN_OK, error);
        }
    }
    free(picture->to.element);
    free(picture->path);
    *picture = (tn_run_picture){0};
    return status;
}

/* ---- results */

#define BEST_MAX 10u   /* files of best/ for one objective; of several, all of the first front are written */
#define LOOKS_MAX 200u /* forms that are made to see whether they are others than those written before */

/* Results on their way. */
typedef struct results {
    tn_run *run;
    const tn_run_files *files; /* NULL: into the run's folder */
} results;

/* ---- best/ */

#define BEST "best/"

/* Files of an earlier call go: the best are others now. Only names that we write are removed. */
static void empty_best(const char *dir)
{
    DIR *folder = opendir(dir);
    if (!folder)
        return;
    for (const struct dirent *entry; (entry = readdir(folder));) {
        char *path = NULL;
        const char *name = entry->d_name, *dot = strchr(name, '.');
        bool ours = dot && dot > name && strspn(name, "0123456789") == (size_t)(dot - name);
        if (ours && asprintf(&path, "%s/%s", dir, name) >= 0)
            unlink(path);
        free(path);
    }
    closedir(folder);
}

/* How a form came about, as comments: it can be bred again by that. */
static void write_origin(const tn_run *run, const tn_individual *individual, FILE *out)
{
    fprintf(out, "# individual %" PRIu64 ", seed %" PRIu64, individual->id, run->job->settings.seed);
    bool child = individual->parents[0] != TN_NO_PARENT;
    uint8_t kind = individual->kind & (uint8_t)~TN_BIRTH_MUTATED;
    if (kind == TN_BIRTH_INSERTED)
        fputs("\n# written by hand", out);
    else if (kind == TN_BIRTH_SEED)
        fputs("\n# as it was given", out);
    else if (kind == TN_BIRTH_CROSSED)
        fprintf(out, "\n# a child of %" PRIu64 " and %" PRIu64, individual->parents[0], individual->parents[1]);
    else if (child)
        fprintf(out, "\n# a copy of %" PRIu64, individual->parents[0]);
    fprintf(out, "%s\n", individual->kind & TN_BIRTH_MUTATED ? ", mutated" : "");
}

/* Laid out as `tartan fmt` does; what cannot be laid out stays as it is. */
static void write_laid_out(const char *path, const char *text, size_t size, FILE *out)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *formatted = NULL;
    size_t formatted_size = 0;
    tn_diagnostics_init(&diagnostics, &sources);
    bool well = tn_format_text(&diagnostics, tn_notation_or_first(path, text, size), path, text, size, &formatted,
                               &formatted_size) == TN_OK;
    fwrite(well ? formatted : text, 1, well ? formatted_size : size, out);
    free(formatted);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
}

static tn_status write_form(const tn_run *run, const char *path, const tn_individual *individual, FILE *out,
                            tn_error *error)
{
    char *text = NULL;
    size_t size;
    FILE *whole = open_memstream(&text, &size);
    if (!whole)
        return tn_fail_memory(error);
    write_origin(run, individual, whole);
    fwrite(individual->sentence, 1, individual->sentence_size, whole);
    bool written = !ferror(whole);
    tn_status status = fclose(whole) == 0 && written ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        write_laid_out(path, text, size, out);
    free(text);
    return status;
}

/* What the file of a sentence that a grammar made holds: the sentence, or the kit that it is put into. */
static tn_status write_text(const tn_run *run, const char *sentence, size_t size, FILE *out, tn_error *error)
{
    char *text = NULL;
    if (run->job->placer) {
        tn_status status = tn_placer_text(run->job->placer, sentence, &text, error);
        if (status != TN_OK)
            return status;
        sentence = text;
        size = strlen(text);
    }
    fwrite(sentence, 1, size, out);
    if (size == 0 || sentence[size - 1] != '\n')
        fputc('\n', out);
    free(text);
    return TN_OK;
}

static tn_status write_sentence(const results *r, const char *name, const tn_individual *individual, tn_error *error)
{
    const tn_run *run = r->run;
    tn_run_file file;
    tn_status status = tn_run_file_begin(run->dir, r->files, name, &file, error);
    if (status != TN_OK)
        return status;
    status = run->job->settings.kind
                 ? write_form(run, name, individual, file.stream, error)
                 : write_text(run, individual->sentence, individual->sentence_size, file.stream, error);
    return tn_run_file_end(&file, status, error);
}

/* The derivation as a picture; one that is too large to draw is left out. */
static tn_status draw_derivation(const tn_run *run, const tn_individual *individual, tn_picture *to, tn_error *error)
{
    tn_mapping_options options = run->job->settings.mapping;
    tn_mapper *mapper = tn_mapper_new(run->job->grammar);
    tn_mapping mapping;
    tn_tree tree = {0};
    options.record = true;
    tn_status status = mapper ? tn_mapper_derive(mapper, individual->genome.codons, individual->genome.count, &options,
                                                 &mapping, error)
                              : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_tree_make(mapping.events, mapping.event_count, &tree, error);
    if (status == TN_OK && tree.count <= TN_TREE_DRAWN)
        status = tn_tree_draw(run->job->grammar, mapping.events, &tree, to, error);
    tn_tree_clear(&tree);
    tn_mapper_free(mapper);
    return status;
}

/* Its form, its rule or its derivation. */
static tn_status draw_individual(const results *r, const char *name, const char *title, const tn_individual *individual,
                                 tn_error *error)
{
    const tn_evolution_job *job = r->run->job;
    const tn_bred_forms *forms = &job->forms;
    const char *const text[] = {individual->sentence};
    tn_run_picture picture;
    tn_status status = tn_run_picture_begin(r->run->dir, r->files, name, &picture, error);
    if (status == TN_OK && forms->context)
        status = forms->draw(forms->context, text, NULL, 1, title, &picture.to, error);
    else if (status == TN_OK && job->learner)
        status = tn_learner_draw(job->learner, individual->sentence, &picture.to, error);
    else if (status == TN_OK)
        status = draw_derivation(r->run, individual, &picture.to, error);
    bool drawn = picture.to.path || picture.to.element; /* a derivation that is too large is not */
    if (status == TN_OK && !drawn)
        picture.files = NULL;
    return tn_run_picture_end(&picture, status, error);
}

static tn_status write_individual(const results *r, size_t number, const tn_individual *individual, tn_error *error)
{
    const tn_evolution_job *job = r->run->job;
    char *sentence = NULL, *picture = NULL;
    tn_status status = TN_OK;
    if (asprintf(&sentence, BEST "%zu.%s", number, job->extension) < 0 ||
        asprintf(&picture, BEST "%zu%s", number, job->forms.context ? job->forms.picture : ".svg") < 0)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = write_sentence(r, sentence, individual, error);
    if (status == TN_OK)
        status = draw_individual(r, picture, sentence + strlen(BEST), individual, error); /* no folder */
    if (status != TN_OK && (status == TN_LIMIT || error->code == E_PART_ABSENT))
        status = TN_OK; /* too large to be drawn, or pictures are left out of this build: the sentence is there */
    free(sentence);
    free(picture);
    return status;
}

static bool seen_before(const tn_individual *const *members, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (members[k]->hash[0] == members[i]->hash[0] && members[k]->hash[1] == members[i]->hash[1])
            return true;
    return false;
}

/* Those that were written: where they have forms, each is another. */
typedef struct written {
    const tn_individual **items; /* owned */
    uint64_t *forms;             /* owned; 0: not looked at yet */
    size_t count, looks;
} written;

/* What tells a form from others: its vertices, in whatever order they came about. Never 0. */
static tn_status look_at_form(const tn_run *run, const tn_individual *individual, uint64_t *form, tn_error *error)
{
    tn_mesh mesh = {0};
    tn_guides guides = {0};
    tn_status status = run->job->forms.mesh(run->job->forms.context, individual->sentence, &mesh, &guides, error);
    uint64_t sum = mesh.face_count;
    for (size_t i = 0; status == TN_OK && i < mesh.vertex_count; i++)
        sum += XXH3_64bits(mesh.positions + 3 * i, 3 * sizeof *mesh.positions);
    *form = sum ? sum : 1;
    tn_mesh_clear(&mesh);
    tn_guides_clear(&guides);
    return status;
}

static bool scored_alike(const tn_run *run, const tn_individual *a, const tn_individual *b)
{
    size_t numbers = tn_evaluator_numbers(&run->job->evaluator);
    return memcmp(a->score.objectives, b->score.objectives, numbers * sizeof(double)) == 0;
}

/* Has one of those written this form too? Only forms that score alike are looked at. Other sentences often grow the
 * same surface, and a designer wants to see others. */
static tn_status drawn_before(const tn_run *run, const tn_individual *individual, written *w, uint64_t *form,
                              bool *before, tn_error *error)
{
    tn_status status = TN_OK;
    *form = 0;
    *before = false;
    for (size_t i = 0; run->job->forms.mesh && i < w->count && !*before && status == TN_OK; i++) {
        if (!scored_alike(run, individual, w->items[i]))
            continue;
        if (!*form) {
            w->looks++;
            status = look_at_form(run, individual, form, error);
        }
        if (status == TN_OK && !w->forms[i])
            status = look_at_form(run, w->items[i], &w->forms[i], error);
        *before = status == TN_OK && w->forms[i] == *form;
    }
    return status == TN_LIMIT ? TN_OK : status;
}

/* Of an answer's numbers; behind them, where these are cases of their own, comes the problem's score. */
static const char *const program_numbers[TN_OBJECTIVES_MAX + 1] = {
    "program", "program 2", "program 3", "program 4", "program 5", "program 6", "program 7", "program 8", "goals"};

static const char *case_name(const tn_run *run, size_t i)
{
    size_t last = run->job->evaluator.cases - 1;
    return program_numbers[i < last ? i : TN_OBJECTIVES_MAX];
}

static const char *number_name(const tn_run *run, size_t i)
{
    size_t objectives = run->job->evaluator.objectives;
    if (i >= objectives)
        return case_name(run, i - objectives);
    if (objectives == 1)
        return "score";
    size_t number = run->job->program ? tn_program_scorer_number(run->job->program, i) : SIZE_MAX;
    if (number != SIZE_MAX)
        return program_numbers[number];
    if (run->job->learner)
        return i ? "length" : "errors";
    return run->job->forms.objective(run->job->forms.context, i);
}

/* scores.csv, beside the files: a line for each. */
static void list_head(const tn_run *run, FILE *out)
{
    fputs("file,individual", out);
    for (size_t i = 0; i < tn_evaluator_numbers(&run->job->evaluator); i++)
        fprintf(out, ",%s", number_name(run, i));
    if (run->job->study.of[TN_SET_TEST].written)
        fputs(",test", out);
    if (run->job->study.of[TN_SET_SCALING].choice)
        fputs(",intercept,slope", out);
    fputc('\n', out);
}

/* Its error with the test data, and the line that scales its values. */
static tn_status list_report(const tn_run *run, const tn_individual *individual, FILE *out, tn_error *error)
{
    tn_fit_report report;
    bool tests = run->job->study.of[TN_SET_TEST].written, scales = run->job->study.of[TN_SET_SCALING].choice;
    if (!tests && !scales)
        return TN_OK;
    tn_status status =
        tn_problem_examine(run->job->problem, individual->sentence, individual->sentence_size, &report, error);
    if (status == TN_OK && tests)
        fprintf(out, ",%.17g", report.test);
    if (status == TN_OK && scales)
        fprintf(out, ",%.17g,%.17g", report.line[0], report.line[1]);
    return status;
}

static tn_status list_individual(const tn_run *run, size_t number, const tn_individual *individual, FILE *out,
                                 tn_error *error)
{
    fprintf(out, "%zu.%s,%" PRIu64, number, run->job->extension, individual->id);
    for (size_t i = 0; i < tn_evaluator_numbers(&run->job->evaluator); i++)
        fprintf(out, ",%.17g", individual->score.objectives[i]);
    tn_status status = list_report(run, individual, out, error);
    fputc('\n', out);
    return status;
}

static tn_status write_member(const results *r, const tn_individual *individual, written *w, FILE *list,
                              tn_error *error)
{
    uint64_t form;
    bool before;
    tn_status status = drawn_before(r->run, individual, w, &form, &before, error);
    if (status != TN_OK || before)
        return status;
    w->items[w->count] = individual;
    w->forms[w->count++] = form;
    status = write_individual(r, w->count, individual, error);
    return status == TN_OK ? list_individual(r->run, w->count, individual, list, error) : status;
}

/* The best of one objective, or the first front of several. */
static tn_status write_members(const results *r, FILE *list, tn_error *error)
{
    const tn_run *run = r->run;
    size_t count, front = tn_evolution_front(run->evolution);
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    bool several = run->job->evaluator.objectives > 1;
    written w = {calloc(count + 1, sizeof *w.items), calloc(count + 1, sizeof *w.forms), 0, 0};
    tn_status status = w.items && w.forms ? TN_OK : tn_fail_memory(error);
    list_head(run, list);
    for (size_t i = 0; i < count && status == TN_OK && w.looks < LOOKS_MAX; i++) {
        if (several ? i >= front : w.count >= BEST_MAX)
            break;
        if (members[i]->score.state == TN_SCORED && !seen_before(members, i))
            status = write_member(r, members[i], &w, list, error);
    }
    free(w.items);
    free(w.forms);
    return status;
}

/* The folder of the best, without those of an earlier call. */
static tn_status begin_best(const char *dir, tn_error *error)
{
    char *best = NULL;
    if (asprintf(&best, "%s/best", dir) < 0)
        return tn_fail_memory(error);
    tn_status status = tn_folder_make(best, error);
    if (status == TN_OK)
        empty_best(best);
    free(best);
    return status;
}

static tn_status write_list(const results *r, const char *list, size_t size, tn_error *error)
{
    tn_run_file file;
    tn_status status = tn_run_file_begin(r->run->dir, r->files, BEST "scores.csv", &file, error);
    if (status != TN_OK)
        return status;
    fwrite(list, 1, size, file.stream); /* what fails shows when it is ended */
    return tn_run_file_end(&file, TN_OK, error);
}

static tn_status write_best(const results *r, tn_error *error)
{
    char *list = NULL;
    size_t size;
    tn_status status = r->files ? TN_OK : begin_best(r->run->dir, error);
    FILE *stream = status == TN_OK ? open_memstream(&list, &size) : NULL;
    if (status == TN_OK)
        status = stream ? write_members(r, stream, error) : tn_fail_memory(error);
    if (stream && fclose(stream) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = write_list(r, list, size, error);
    free(list);
    return status;
}

/* ---- how it went */

static tn_status write_stats(const results *r, const tn_generation_stats *stats, size_t count, tn_error *error)
{
    tn_run_file file;
    tn_status status = tn_run_file_begin(r->run->dir, r->files, "stats.csv", &file, error);
    if (status != TN_OK)
        return status;
    fputs("generation,best,mean,scored,no_sentence,failed,limit,distinct,evaluations,births,mean_codons,mean_depth,"
          "lower_quartile,median,upper_quartile\n",
          file.stream);
    for (size_t i = 0; i < count; i++)
        fprintf(file.stream, "%u,%.17g,%.17g,%u,%u,%u,%u,%u,%" PRIu64 ",%" PRIu64 ",%.6g,%.6g,%.17g,%.17g,%.17g\n",
                stats[i].generation, stats[i].best[0], stats[i].mean, stats[i].scored, stats[i].no_sentence,
                stats[i].failed, stats[i].limited, stats[i].distinct, stats[i].evaluations, stats[i].births,
                stats[i].mean_codons, stats[i].mean_depth, stats[i].quartiles[0], stats[i].quartiles[1],
                stats[i].quartiles[2]);
    return tn_run_file_end(&file, TN_OK, error);
}

static tn_status draw_stats(const results *r, const tn_generation_stats *stats, size_t count, tn_error *error)
{
    char *stored = NULL;
    tn_run_picture picture;
    tn_status status = r->run->store ? tn_run_store_get_meta(r->run->store, "study_path", &stored, error) : TN_OK;
    const char *study = r->run->store ? stored : r->run->study;
    if (status != TN_OK)
        return status;
    status = tn_run_picture_begin(r->run->dir, r->files, "fitness.svg", &picture, error);
    if (status == TN_OK) /* no name of a folder: the same run has the same picture, wherever it lies */
        status = tn_stats_plot(stats, count, study ? study : "", &picture.to, error);
    status = tn_run_picture_end(&picture, status, error);
    free(stored);
    return status;
}

tn_status tn_run_stats(const tn_run *run, tn_generation_stats **stats, size_t *count, tn_error *error)
{
    *stats = NULL;
    *count = 0;
    if (run->store)
        return tn_run_store_stats(run->store, stats, count, error);
    *stats = calloc(run->kept_count + 1, sizeof **stats);
    if (!*stats)
        return tn_fail_memory(error);
    if (run->kept_count)
        memcpy(*stats, run->kept, run->kept_count * sizeof **stats);
    *count = run->kept_count;
    return TN_OK;
}

tn_status tn_run_results(tn_run *run, const tn_run_files *files, tn_error *error)
{
    const results r = {run, files};
    tn_generation_stats *stats = NULL;
    size_t count;
    tn_status status = write_best(&r, error);
    if (status == TN_OK)
        status = tn_run_stats(run, &stats, &count, error);
    if (status == TN_OK)
        status = write_stats(&r, stats, count, error);
    if (status == TN_OK)
        status = draw_stats(&r, stats, count, error);
    if (status != TN_OK && error->code == E_PART_ABSENT)
        status = TN_OK; /* the numbers are in stats.csv */
    free(stats);
    return status;
}
