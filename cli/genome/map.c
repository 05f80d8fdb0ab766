/* tartan map: genomes to sentences, and back. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "runtime/base/file.h"
#include "runtime/base/file_error.h"
#include "runtime/base/json.h"
#include "runtime/base/picture.h"
#include "runtime/base/random.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/mapper.h"
#include "runtime/genome/picture/tree_draw.h"

typedef struct map_settings {
    tn_settings common;
    const char *genome, *genomes, *invert, *tree, *output;
    tn_option_number random, seed, codons;
    tn_option_number wraps, max_depth, max_steps, max_items;
    int format, mapping;
    bool trace;
} map_settings;

static const map_settings *settings_of(const tn_job *job)
{
    return (const map_settings *)job->settings;
}

#define RANDOM_CODONS 200u   /* of a random genome, unless --codons says otherwise */
#define RANDOM_CODON_BITS 31 /* their size */

typedef struct mapping_run {
    tn_job *job;
    tn_grammar *grammar;
    tn_mapper *mapper;
    tn_mapping_options options;
    tn_genome genome;
    FILE *out;
    uint64_t done; /* genomes mapped */
    bool json, stop;
} mapping_run;

static void fail(mapping_run *run, const tn_error *error)
{
    tn_job_fail(run->job, error);
    run->stop = true;
}

/* ---- what is written of a mapping */

static void write_number(tn_json *json, const char *key, bool known, uint64_t value)
{
    if (known)
        tn_json_count(json, key, value);
    else
        tn_json_null(json, key);
}

static void write_json_repair(tn_json *json, const tn_mapping *m)
{
    write_number(json, "max_id", m->has_phenotype, m->max_id);
    tn_json_string(json, "repaired_phenotype", m->repaired ? m->repaired_phenotype : NULL);
    write_number(json, "repaired_used_codons", m->repaired, m->repaired_used);
    if (!m->repaired) {
        tn_json_null(json, "repaired_ids");
        return;
    }
    tn_json_list(json, "repaired_ids");
    for (size_t i = 0; i < m->repaired_count; i++)
        tn_json_count(json, NULL, m->repaired_ids[i]);
    tn_json_list_end(json);
}

static void write_json(const mapping_run *run, const tn_mapping *m)
{
    tn_json json = tn_json_file(run->out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_bool(&json, "valid", m->valid);
    tn_json_string(&json, "reason", m->valid ? NULL : tn_mapping_reason_text(m->reason));
    tn_json_string(&json, "phenotype", m->has_phenotype ? m->phenotype : NULL);
    write_number(&json, "used_codons", m->has_phenotype, m->used);
    write_number(&json, "nodes", m->has_phenotype, m->nodes);
    write_number(&json, "depth", m->has_phenotype, m->depth);
    write_number(&json, "wraps", m->has_phenotype, m->wraps);
    if (run->grammar->dialect == TN_DIALECT_GENR8)
        write_json_repair(&json, m);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_text(const mapping_run *run, const tn_mapping *m)
{
    fprintf(run->out, "# genome %" PRIu64 ": ", run->done + 1);
    if (m->has_phenotype)
        fprintf(run->out, "%" PRIu64 " codons, %" PRIu64 " wraps, %" PRIu64 " nodes, depth %u", m->used, m->wraps,
                m->nodes, m->depth);
    if (!m->valid)
        fprintf(run->out, "%snot valid: %s", m->has_phenotype ? "; " : "", tn_mapping_reason_text(m->reason));
    if (m->repaired_count)
        fprintf(run->out, "; repaired with %zu rules and %" PRIu64 " codons", m->repaired_count,
                m->repaired_used - m->used);
    fputc('\n', run->out);
    if (m->has_phenotype)
        fprintf(run->out, "%s\n", m->repaired ? m->repaired_phenotype : m->phenotype);
}

static void write_tree(mapping_run *run, const tn_mapping *m)
{
    const char *how = settings_of(run->job)->tree;
    tn_tree tree;
    tn_error error;
    tn_status status = tn_tree_make(m->events, m->event_count, &tree, &error);
    if (status == TN_OK && strcmp(how, "text") == 0)
        tn_tree_write_text(run->grammar, m->events, &tree, run->out);
    else if (status == TN_OK && strcmp(how, "json") == 0)
        tn_tree_write_json(run->grammar, m->events, &tree, run->out);
    else if (status == TN_OK)
        status = tn_tree_draw(run->grammar, m->events, &tree, &(tn_picture){.path = how}, &error);
    if (status != TN_OK)
        fail(run, &error);
    tn_tree_clear(&tree);
}

static void map_genome(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    tn_mapping mapping;
    tn_error error;
    if (tn_mapper_derive(run->mapper, run->genome.codons, run->genome.count, &run->options, &mapping, &error) !=
        TN_OK) {
        fail(run, &error);
        return;
    }
    bool tree_alone = settings->tree && strcmp(settings->tree, "json") == 0;
    if (run->json && !tree_alone)
        write_json(run, &mapping);
    else if (!tree_alone)
        write_text(run, &mapping);
    if (settings->trace)
        tn_trace_write(run->grammar, mapping.events, mapping.event_count, run->out);
    if (settings->tree)
        write_tree(run, &mapping);
    run->done++;
    run->stop |= ferror(run->out) != 0 || tn_interrupted();
}

/* ---- where genomes come from */

static void read_genome(mapping_run *run, const char *path, uint64_t line, const char *text, size_t length)
{
    tn_error error;
    tn_status status = tn_genome_read(text, length, &run->genome, &error);
    if (status == TN_OK) {
        map_genome(run);
        return;
    }
    error.line = line;
    tn_report_error(tn_job_diagnostics(run->job), &error, path, text, length);
    int code = tn_exit_code(status);
    run->job->exit_code = code > run->job->exit_code ? code : run->job->exit_code;
    run->stop = true;
}

/* One genome a line; lines that start with # are comments. */
static void read_genomes(mapping_run *run, const char *path)
{
    FILE *in = strcmp(path, "-") == 0 ? stdin : tn_file_stream(path);
    if (!in) {
        tn_error error;
        tn_cannot_read(path, errno, &error);
        fail(run, &error);
        return;
    }
    tn_file_state before = tn_file_state_of(fileno(in));
    char *text = NULL;
    size_t capacity = 0;
    uint64_t line = 0;
    for (ssize_t length; !run->stop && (length = getline(&text, &capacity, in)) >= 0;) {
        line++;
        if (length && text[length - 1] == '\n')
            length--;
        if (length == 0 || text[0] != '#')
            read_genome(run, path, line, text, (size_t)length);
    }
    tn_error error;
    if (ferror(in) && !run->stop) {
        tn_cannot_read(path, errno, &error);
        fail(run, &error);
    } else if (!run->stop && tn_file_state_same(&before, fileno(in), path, &error) != TN_OK) {
        fail(run, &error);
    }
    free(text);
    if (in != stdin)
        fclose(in);
}

static void random_genomes(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    size_t codons = settings->codons.given ? (size_t)settings->codons.value : RANDOM_CODONS;
    tn_error error;
    if (!tn_genome_reserve(&run->genome, codons)) {
        tn_fail_memory(&error);
        fail(run, &error);
        return;
    }
    run->genome.count = codons;
    for (uint64_t i = 0; i < settings->random.value && !run->stop; i++) {
        for (size_t k = 0; k < codons; k++)
            run->genome.codons[k] = tn_random64(settings->seed.value, i, k) >> (64 - RANDOM_CODON_BITS);
        map_genome(run);
    }
}

/* ---- backwards */

static void invert(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    const char *sentence = settings->invert;
    tn_invert_options options = {.max_depth = run->options.max_depth,
                                 .position_independent = run->options.position_independent,
                                 .max_items = (size_t)settings->max_items.value};
    tn_error error;
    tn_status status = tn_invert(run->grammar, sentence, strlen(sentence), &options, &run->genome, &error);
    if (status != TN_OK) {
        error.line = error.column ? 1 : 0;
        tn_report_error(tn_job_diagnostics(run->job), &error, "sentence", sentence, strlen(sentence));
        run->job->exit_code = tn_exit_code(status);
        return;
    }
    for (size_t i = 0; i < run->genome.count; i++)
        fprintf(run->out, i ? " %" PRIu64 : "%" PRIu64, run->genome.codons[i]);
    fputc('\n', run->out);
}

/* ---- the command */

/* Nothing that was asked for is left out without a word. */
static bool formats_agree(tn_job *job)
{
    const map_settings *s = settings_of(job);
    bool json = s->format == 1;
    if (s->invert && (json || s->tree || s->trace)) {
        tn_job_usage(job, "--invert writes a genome, and nothing else: map it for --tree, --trace or --format json");
        return false;
    }
    if (json && (s->trace || (s->tree && strcmp(s->tree, "text") == 0))) {
        tn_job_usage(job, "--trace and --tree text are text: leave out --format json, or say --tree json");
        return false;
    }
    return true;
}

static bool check_options(tn_job *job)
{
    const map_settings *s = settings_of(job);
    int sources = (s->genome != NULL) + (s->genomes != NULL) + s->random.given + (s->invert != NULL);
    if (sources != 1) {
        tn_job_usage(job, "say what to map: one of --genome, --genomes, --random or --invert");
        return false;
    }
    tn_error error;
    tn_canvas_format format;
    const char *dot = s->output ? strrchr(s->output, '.') : NULL;
    if (dot && tn_canvas_format_of(s->output, &format, &error) == TN_OK) {
        tn_diagnostic *d = tn_job_usage(job, "-o is where the text goes, and %.200s is a picture's name", s->output);
        tn_help(tn_job_diagnostics(job), d,
                "--tree %.200s draws the derivation there; text has another ending, or none", s->output);
        return false;
    }
    bool picture = s->tree && strcmp(s->tree, "text") != 0 && strcmp(s->tree, "json") != 0;
    if (picture && tn_canvas_format_of(s->tree, &format, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    if (picture && !s->genome && s->random.value != 1) {
        tn_job_usage(job, "a picture is of one genome: give it with --genome");
        return false;
    }
    return formats_agree(job);
}

static bool mapping_fits(mapping_run *run)
{
    tn_error error;
    if (!run->options.position_independent || tn_grammar_takes_places(run->grammar))
        return true;
    bool genr8 = run->grammar->dialect == TN_DIALECT_GENR8;
    tn_fail(&error, TN_INVALID, E_MAPPING_ORDER,
            genr8 ? "position-independent mapping is for the dialect ge, and this grammar is in genr8"
                  : "position-independent mapping reads two codons for every non-terminal, also for a single choice");
    tn_error_help(&error, genr8 ? "leave out --mapping" : "leave out `%%single-choice skip` of the grammar");
    fail(run, &error);
    return false;
}

static bool prepare(mapping_run *run)
{
    tn_job *job = run->job;
    const map_settings *settings = settings_of(job);
    tn_error error;
    if (!tn_job_open(job, settings->common.operands.items[0]))
        return false;
    if (!tn_module_has_grammar(job->opened.module)) {
        tn_fail(&error, TN_INVALID, E_NOT_A_GRAMMAR, "%.200s holds no grammar that genomes are mapped through",
                settings->common.operands.items[0]);
        tn_error_help(&error, "%s", tn_opened_help(&job->opened, "such grammars are .bnf files").text);
        fail(run, &error);
        return false;
    }
    if (tn_grammar_new(job->opened.module, 0, &run->grammar, &error) != TN_OK) {
        fail(run, &error);
        return false;
    }
    run->mapper = tn_mapper_new(run->grammar);
    if (!run->mapper) {
        tn_fail_memory(&error);
        fail(run, &error);
        return false;
    }
    run->options = tn_mapping_options_of(run->grammar);
    if (settings->wraps.given)
        run->options.wraps = (uint32_t)settings->wraps.value;
    if (settings->max_depth.given)
        run->options.max_depth = (uint32_t)settings->max_depth.value;
    run->options.max_steps = settings->max_steps.value;
    if (settings->mapping)
        run->options.position_independent = settings->mapping == 2;
    run->options.record = settings->tree || settings->trace;
    run->json = settings->format == 1;
    return mapping_fits(run);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const map_settings *settings = (const map_settings *)common;
    tn_job job;
    mapping_run run = {.job = &job};
    tn_output output;
    tn_job_begin(&job, common);
    if (check_options(&job) && prepare(&run) && tn_job_output(&job, settings->output, &output)) {
        run.out = output.stream;
        if (settings->invert)
            invert(&run);
        else if (settings->genome)
            read_genome(&run, "--genome", 1, settings->genome, strlen(settings->genome));
        else if (settings->genomes)
            read_genomes(&run, settings->genomes);
        else
            random_genomes(&run);
        if (tn_interrupted())
            tn_job_interrupted(&job, "interrupted after %" PRIu64 " genomes", run.done);
        tn_job_close(&job, &output, !tn_interrupted());
    }
    tn_genome_clear(&run.genome);
    tn_mapper_free(run.mapper);
    tn_grammar_free(run.grammar);
    return tn_job_end(&job);
}

#define SETTINGS map_settings
static const tn_option options[] = {
    TEXT("genome", 'g', "\"N N ...\"", genome, "map this genome"),
    TEXT("genomes", 0, "FILE", genomes, "map the genomes of FILE, one a line; - is standard input"),
    NUMBER("random", 0, "N", random, 0, 0, "map N random genomes"),
    TEXT("invert", 0, "SENTENCE", invert,
         "find a genome that maps to SENTENCE (before repair), or say why there is none"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which random genomes: the same seed gives the same (default 0)"),
    NUMBER("codons", 0, "N", codons, 0, TN_GENOME_CODONS_MAX, "codons of a random genome (default 200)"),
    NUMBER("wraps", 0, "N", wraps, 0, UINT32_MAX,
           "how often a genome may be read once more (default: what the grammar says)"),
    NUMBER("max-depth", 0, "N", max_depth, 0, UINT32_MAX,
           "limit of depth, 0 for none (default: what the grammar says)"),
    CHOICE("mapping", 0, "HOW", mapping, "grammar|leftmost|position-independent",
           "which non-terminal is replaced next: what the grammar says (the default), the leftmost, or, with codons in "
           "pairs, the one that the first codon of a pair says"),
    NUMBER("max-steps", 0, "N", max_steps, 1, UINT64_MAX,
           "most symbols of a sentence; a long terminal counts as one more for each 16 bytes (default 1000000)"),
    NUMBER("max-items", 0, "N", max_items, 1, UINT32_MAX - 1, "most parser states of --invert (default 2000000)"),
    CHOICE("format", 'f', "FORMAT", format, "text|json", "text (the default), or json: one object a line"),
    TEXT("tree", 0, "HOW", tree, "show the derivation: text, json, or a picture's file name (.svg, .png, .pdf)"),
    FLAG("trace", 0, trace, "show what each codon chose"),
    OPTION_OUTPUT_BY(TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES_PICTURES, "; .json is JSON"),
};

const tn_command tn_command_map = {
    .name = "map",
    .summary = "map genomes to the sentences of a grammar",
    .usage = "GRAMMAR.bnf --genome \"212 187 632 ...\"\nGRAMMAR.bnf --genomes FILE\nGRAMMAR.bnf --random N [--seed S]\n"
             "GRAMMAR.bnf --invert \"SENTENCE\"",
    .description =
        "Maps a genome to a sentence. From the start symbol on, each codon chooses a production for a non- "
        "terminal. The output has the sentence and the number of codons used, wraps, nodes and depth. A genome "
        "without a sentence is not an error: it is reported as not valid, with the reason. Codons are whole "
        "numbers from 0 to 18446744073709551615.\n\n"
        "JSON: one object a line with valid, reason, phenotype, used_codons, nodes, depth, wraps; for the genr8 "
        "dialect also max_id, repaired_phenotype, repaired_used_codons and repaired_ids.",
    .example = "$ tartan map genr8-example --genome \"212 187 632 832 800 517 338 39\" --trace",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one GRAMMAR.bnf",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
