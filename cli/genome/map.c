/* tartan map: genomes to sentences, and back. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "runtime/base/file.h"
#include "runtime/base/picture.h"
#include "runtime/genome/mapping/genome.h"

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

typedef struct mapping_run {
    tn_job *job;
    tn_map_request request; /* for the next genome */
    FILE *out;
    uint64_t done; /* genomes mapped */
    bool stop;
} mapping_run;

static void fail(mapping_run *run, const tn_error *error)
{
    tn_job_fail(run->job, error);
    run->stop = true;
}

/* ---- what is written of a mapping */

/* system: of the dialect genr8, or NULL. */
static void write_text(const mapping_run *run, const tn_mapped_sentence *m, const tn_mapped_system *system)
{
    fprintf(run->out, "# genome %" PRIu64 ": ", run->done + 1);
    if (m->has_phenotype)
        fprintf(run->out, "%" PRIu64 " codons, %" PRIu64 " wraps, %" PRIu64 " nodes, depth %" PRIu64, m->used_codons,
                m->wraps, m->nodes, m->depth);
    if (!m->valid)
        fprintf(run->out, "%snot valid: %s", m->has_phenotype ? "; " : "", m->reason);
    if (system && system->repaired_ids.count)
        fprintf(run->out, "; repaired with %zu rules and %" PRIu64 " codons", system->repaired_ids.count,
                system->repaired_used_codons - m->used_codons);
    fputc('\n', run->out);
    bool repaired = system && system->has_repaired_phenotype;
    if (m->has_phenotype)
        fprintf(run->out, "%s\n", repaired ? system->repaired_phenotype : m->phenotype);
}

/* What is asked for besides: a table and a tree. A picture has gone to its file. */
static void write_derivation(const mapping_run *run, const tn_shown_derivation *shown)
{
    if (shown->trace)
        fputs(shown->trace, run->out);
    if (shown->tree_text)
        fputs(shown->tree_text, run->out);
    if (shown->tree)
        fprintf(run->out, "%s\n", shown->tree);
}

/* JSON is a line for each, without what stands in texts of its own. */
static void write_json(const mapping_run *run, const tn_message *message, const void *row)
{
    tn_json json = tn_json_file(run->out, TN_JSON_TIGHT);
    tn_message_write(message, row, NULL, &json);
    tn_json_end_line(&json);
}

static void write_genome(mapping_run *run, const tn_reply *answer)
{
    const map_settings *settings = settings_of(run->job);
    const tn_mapped_systems *systems = TN_REPLY(mapped_systems, answer);
    const tn_mapped_genomes *genomes = TN_REPLY(mapped_genomes, answer);
    const tn_mapped_system *system = systems && systems->genomes.count ? &systems->genomes.items[0] : NULL;
    const tn_mapped_genome *genome = genomes && genomes->genomes.count ? &genomes->genomes.items[0] : NULL;
    if (!system && !genome)
        return;
    bool tree_alone = settings->tree && strcmp(settings->tree, "json") == 0;
    if (settings->format == 1 && !tree_alone && system)
        write_json(run, &tn_message_mapped_system, system);
    else if (settings->format == 1 && !tree_alone)
        write_json(run, &tn_message_mapped_genome, genome);
    else if (!tree_alone)
        write_text(run, system ? &system->sentence : &genome->sentence, system);
    write_derivation(run, system ? &system->shown : &genome->shown);
}

/* Asks for one genome; what was found of it is written also if its picture could not be drawn. */
static void map_genome(mapping_run *run)
{
    tn_reply answer;
    tn_status status = tn_ask_map(&run->job->session, &run->request, &answer);
    if (status != TN_STOPPED)
        write_genome(run, &answer);
    tn_reply_clear(&answer);
    run->stop = !tn_job_answered(run->job, status);
    run->done += !run->stop;
    run->stop |= ferror(run->out) != 0 || tn_interrupted();
}

/* ---- where genomes come from */

static void map_text(mapping_run *run, const char *path, uint64_t line, const char *text)
{
    run->request.genomes = (tn_texts){&text, 1};
    run->request.file = path;
    run->request.has_line = true;
    run->request.line = line;
    map_genome(run);
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
            text[--length] = '\0';
        for (ssize_t i = 0; i < length; i++) /* a zero byte is no codon, and no end of the line */
            text[i] = text[i] ? text[i] : '?';
        if (text[0] != '#')
            map_text(run, path, line, text);
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

/* One after another, so that any number can be written. */
static void random_genomes(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    run->request.has_random = true;
    run->request.random = 1;
    for (uint64_t i = 0; i < settings->random.value && !run->stop; i++) {
        run->request.first = i;
        map_genome(run);
    }
}

/* ---- backwards */

static void invert(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    const tn_invert_request request = {.sentence = settings->invert,
                                       .grammar = run->request.grammar,
                                       .has_max_items = settings->max_items.given,
                                       .max_items = settings->max_items.value};
    tn_reply answer;
    if (tn_job_answered(run->job, tn_ask_invert(&run->job->session, &request, &answer)))
        fprintf(run->out, "%s\n", TN_REPLY(inverted, &answer)->genome);
    tn_reply_clear(&answer);
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

static unsigned tree_asked(const char *how)
{
    static const char *const words[] = {"json", "text"};
    static const tn_file_format pictures[] = {TN_FILE_SVG, TN_FILE_PNG, TN_FILE_PDF};
    for (unsigned i = 0; how && i < 2; i++)
        if (strcmp(how, words[i]) == 0)
            return 1 + i;
    for (unsigned i = 0; how && i < 3; i++)
        if (tn_file_format_of(how) == pictures[i])
            return 3 + i;
    return 0;
}

/* What is asked of each genome. */
static tn_map_request request_of(const map_settings *s)
{
    return (tn_map_request){.has_seed = s->seed.given,
                            .seed = s->seed.value,
                            .has_codons = s->codons.given,
                            .codons = s->codons.value,
                            .has_wraps = s->wraps.given,
                            .wraps = s->wraps.value,
                            .has_max_steps = s->max_steps.given,
                            .max_steps = s->max_steps.value,
                            .grammar = {.has_max_depth = s->max_depth.given,
                                        .max_depth = s->max_depth.value,
                                        .mapping = (unsigned)s->mapping},
                            .tree = tree_asked(s->tree),
                            .trace = s->trace};
}

/* Asks for no genome: what is wrong with the grammar is said before the output is begun. */
static bool grammar_fits(const mapping_run *run)
{
    tn_map_request none = run->request;
    tn_reply answer;
    none.has_random = true;
    bool fits = tn_job_answered(run->job, tn_ask_map(&run->job->session, &none, &answer));
    tn_reply_clear(&answer);
    return fits;
}

static void map_all(mapping_run *run)
{
    const map_settings *settings = settings_of(run->job);
    tn_made_outputs pictures;
    tn_job_files(run->job, &pictures, &settings->tree, 1, false);
    if (settings->invert)
        invert(run);
    else if (settings->genome)
        map_text(run, "--genome", 1, settings->genome);
    else if (settings->genomes)
        read_genomes(run, settings->genomes);
    else
        random_genomes(run);
    tn_job_files_end(&pictures);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const map_settings *settings = (const map_settings *)common;
    tn_job job;
    mapping_run run = {.job = &job, .request = request_of(settings)};
    tn_output output;
    tn_job_begin(&job, common);
    if (check_options(&job) && tn_job_open(&job, common->operands.items[0]) && grammar_fits(&run) &&
        tn_job_output(&job, settings->output, &output)) {
        run.out = output.stream;
        map_all(&run);
        if (tn_interrupted())
            tn_job_interrupted(&job, "interrupted after %" PRIu64 " genomes", run.done);
        tn_job_close(&job, &output, !tn_interrupted());
    }
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
