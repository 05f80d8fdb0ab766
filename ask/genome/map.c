/* map, invert: the sentences that a grammar maps genomes to, and back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/mapper.h"
#include "runtime/genome/picture/tree_draw.h"

#define RANDOM_CODONS 200u   /* of a random genome, unless the request says otherwise */
#define RANDOM_CODON_BITS 31 /* their size */

/* ---- the grammar, which the session keeps: whoever maps very many genomes asks for one after another */

typedef struct kept_grammar {
    tn_grammar *grammar;
    tn_mapper *mapper;
    tn_genome genome;
} kept_grammar;

static void free_kept(void *value)
{
    kept_grammar *kept = value;
    tn_genome_clear(&kept->genome);
    tn_mapper_free(kept->mapper);
    tn_grammar_free(kept->grammar);
    free(kept);
}

static tn_status open_grammar(tn_session *session, tn_error *error)
{
    tn_opened *opened = session->opened;
    if (!tn_module_has_grammar(opened->module)) {
        tn_fail(error, TN_INVALID, E_NOT_A_GRAMMAR, "%.200s holds no grammar that genomes are mapped through",
                opened->path);
        tn_error_help(error, "%s", tn_opened_help(opened, "such grammars are .bnf files").text);
        return TN_INVALID;
    }
    kept_grammar *kept = calloc(1, sizeof *kept);
    if (!kept)
        return tn_fail_memory(error);
    tn_status status = tn_grammar_new(opened->module, 0, &kept->grammar, error);
    if (status == TN_OK && !(kept->mapper = tn_mapper_new(kept->grammar)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        session->grammar = (tn_boxed){kept, free_kept};
    else
        free_kept(kept);
    return status;
}

/* The grammar ready, and how it derives as the request wants it. */
static tn_status find_grammar(tn_session *session, const tn_grammar_asked *asked, kept_grammar **kept,
                              tn_mapping_options *options, tn_error *error)
{
    tn_status status = session->grammar.value ? TN_OK : open_grammar(session, error);
    if (status != TN_OK)
        return status;
    *kept = session->grammar.value;
    const tn_grammar *grammar = (*kept)->grammar;
    *options = tn_mapping_options_of(grammar);
    if (asked->has_max_depth)
        options->max_depth = (uint32_t)asked->max_depth;
    if (asked->mapping)
        options->position_independent = asked->mapping == 2;
    if (!options->position_independent || tn_grammar_takes_places(grammar))
        return TN_OK;
    bool genr8 = grammar->dialect == TN_DIALECT_GENR8;
    tn_fail(error, TN_INVALID, E_MAPPING_ORDER,
            genr8 ? "position-independent mapping is for the dialect ge, and this grammar is in genr8"
                  : "position-independent mapping reads two codons for every non-terminal, also for a single choice");
    tn_error_help(error, genr8 ? "leave out --mapping" : "leave out `%%single-choice skip` of the grammar");
    return TN_INVALID;
}

/* ---- mapped */

/* In the order of the words of the request. */
typedef enum tree_shown { TREE_NONE, TREE_JSON, TREE_TEXT, TREE_SVG, TREE_PNG, TREE_PDF } tree_shown;

typedef struct mapping_run {
    tn_session *session;
    const tn_map_request *request;
    kept_grammar *kept;
    tn_mapping_options options;
    tn_mapped_genomes *genomes; /* one of these is the answer */
    tn_mapped_systems *systems;
} mapping_run;

static tn_status copy_text(const char *text, size_t size, char **copy, bool *has, tn_error *error)
{
    *copy = malloc(size + 1);
    if (!*copy)
        return tn_fail_memory(error);
    memcpy(*copy, text, size);
    (*copy)[size] = '\0';
    *has = true;
    return TN_OK;
}

static tn_status put_sentence(const tn_mapping *m, tn_mapped_sentence *to, tn_error *error)
{
    to->valid = m->valid;
    to->has_reason = !m->valid;
    to->reason = tn_mapping_reason_text(m->reason);
    if (!m->has_phenotype)
        return TN_OK;
    to->has_used_codons = to->has_nodes = to->has_depth = to->has_wraps = true;
    to->used_codons = m->used;
    to->nodes = m->nodes;
    to->depth = m->depth;
    to->wraps = m->wraps;
    return copy_text(m->phenotype, m->phenotype_size, &to->phenotype, &to->has_phenotype, error);
}

static tn_status put_repair(const tn_mapping *m, tn_mapped_system *to, tn_error *error)
{
    to->has_max_id = m->has_phenotype;
    to->max_id = m->max_id;
    if (!m->repaired)
        return TN_OK;
    to->has_repaired_used_codons = true;
    to->repaired_used_codons = m->repaired_used;
    to->repaired_ids.items = calloc(m->repaired_count + 1, sizeof *to->repaired_ids.items);
    if (!to->repaired_ids.items)
        return tn_fail_memory(error);
    to->has_repaired_ids = true;
    to->repaired_ids.count = m->repaired_count;
    for (size_t i = 0; i < m->repaired_count; i++)
        to->repaired_ids.items[i] = m->repaired_ids[i];
    return copy_text(m->repaired_phenotype, m->repaired_size, &to->repaired_phenotype, &to->has_repaired_phenotype,
                     error);
}

/* ---- derivations */

/* Ends a text that was written, which is NULL if that failed. */
static tn_status end_text(FILE *stream, char **text, bool written, tn_error *error)
{
    bool closed = fclose(stream) == 0;
    if (closed && written)
        return TN_OK;
    free(*text);
    *text = NULL;
    return tn_fail_memory(error);
}

static tn_status put_trace(const mapping_run *run, const tn_mapping *m, tn_shown_derivation *to, tn_error *error)
{
    size_t size;
    FILE *stream = open_memstream(&to->trace, &size);
    if (!stream)
        return tn_fail_memory(error);
    bool written = tn_trace_write(run->kept->grammar, m->events, m->event_count, stream);
    to->has_trace = true;
    return end_text(stream, &to->trace, written, error);
}

static tn_status put_tree_text(const mapping_run *run, const tn_mapping *m, const tn_tree *tree,
                               tn_shown_derivation *to, tn_error *error)
{
    bool json = run->request->tree == TREE_JSON;
    char **text = json ? &to->tree : &to->tree_text;
    size_t size;
    FILE *stream = open_memstream(text, &size);
    if (!stream)
        return tn_fail_memory(error);
    bool written = (json ? tn_tree_write_json : tn_tree_write_text)(run->kept->grammar, m->events, tree, stream);
    to->has_tree = json;
    to->has_tree_text = !json;
    tn_status status = end_text(stream, text, written, error);
    if (status == TN_OK && json) /* the end of the line is no part of it */
        (*text)[size - 1] = '\0';
    return status;
}

static tn_status put_picture(const mapping_run *run, const tn_mapping *m, const tn_tree *tree, tn_shown_derivation *to,
                             tn_error *error)
{
    static const tn_file_format formats[] = {
        [TREE_SVG] = TN_FILE_SVG, [TREE_PNG] = TN_FILE_PNG, [TREE_PDF] = TN_FILE_PDF};
    tn_file_format format = formats[run->request->tree];
    tn_picture drawn = tn_picture_asked(format);
    drawn.watch = run->session->opened->module->watch;
    to->has_picture = true;
    tn_status status = tn_tree_draw(run->kept->grammar, m->events, tree, &drawn, error);
    if (status == TN_OK)
        status = tn_made_picture(run->session, &drawn, format, NULL, &to->picture, error);
    return status;
}

static tn_status put_derivation(const mapping_run *run, const tn_mapping *m, tn_shown_derivation *to, tn_error *error)
{
    tn_tree tree = {0};
    unsigned how = run->request->tree;
    tn_status status = run->request->trace ? put_trace(run, m, to, error) : TN_OK;
    if (status != TN_OK || how == TREE_NONE)
        return status;
    status = tn_tree_make(m->events, m->event_count, &tree, error);
    if (status == TN_OK)
        status = (how <= TREE_TEXT ? put_tree_text : put_picture)(run, m, &tree, to, error);
    tn_tree_clear(&tree);
    return status;
}

/* Maps the genome that is kept. */
static tn_status map_kept(const mapping_run *run, tn_error *error)
{
    const tn_genome *genome = &run->kept->genome;
    tn_mapping m;
    tn_status status = tn_watch_check(run->session->opened->module->watch, error);
    if (status == TN_OK)
        status = tn_mapper_derive(run->kept->mapper, genome->codons, genome->count, &run->options, &m, error);
    if (status != TN_OK)
        return status;
    tn_mapped_system *system = run->systems ? TN_ADD(mapped_system, run->systems->genomes, error) : NULL;
    tn_mapped_genome *plain = run->genomes ? TN_ADD(mapped_genome, run->genomes->genomes, error) : NULL;
    if (!system && !plain)
        return TN_MEMORY;
    status = put_sentence(&m, system ? &system->sentence : &plain->sentence, error);
    if (status == TN_OK && system)
        status = put_repair(&m, system, error);
    return status == TN_OK ? put_derivation(run, &m, system ? &system->shown : &plain->shown, error) : status;
}

/* ---- where genomes come from */

static tn_status map_given(const mapping_run *run)
{
    const tn_map_request *request = run->request;
    const char *file = request->file ? request->file : "genomes";
    size_t first = request->has_line ? tn_as_size(request->line) : 1;
    tn_error error;
    for (size_t i = 0; i < request->genomes.count; i++) {
        const char *text = request->genomes.items[i];
        tn_status status = tn_genome_read(text, strlen(text), &run->kept->genome, &error);
        if (status != TN_OK) {
            error.line = first + i;
            tn_report_error(&run->session->opened->compilation.diagnostics, &error, file, text, strlen(text));
            return status;
        }
        if (map_kept(run, &error) != TN_OK)
            return tn_session_fail(run->session, &error);
    }
    return TN_OK;
}

static tn_status map_random(const mapping_run *run)
{
    const tn_map_request *request = run->request;
    tn_genome *genome = &run->kept->genome;
    size_t codons = request->has_codons ? (size_t)request->codons : RANDOM_CODONS;
    tn_error error;
    tn_status status = tn_genome_reserve(genome, codons) ? TN_OK : tn_fail_memory(&error);
    for (uint64_t i = 0; status == TN_OK && i < request->random; i++) {
        genome->count = codons;
        for (size_t k = 0; k < codons; k++)
            genome->codons[k] = tn_random64(request->seed, request->first + i, k) >> (64 - RANDOM_CODON_BITS);
        status = map_kept(run, &error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(run->session, &error);
}

tn_status tn_ask_map(tn_session *session, const tn_map_request *request, tn_reply *answer)
{
    mapping_run run = {.session = session, .request = request};
    tn_error error;
    *answer = (tn_reply){0};
    if ((request->genomes.count > 0) == request->has_random)
        return tn_session_refuse(session, NULL, "say what to map: genomes, or how many random ones");
    tn_status status = find_grammar(session, &request->grammar, &run.kept, &run.options, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    bool genr8 = run.kept->grammar->dialect == TN_DIALECT_GENR8;
    status = tn_reply_new(genr8 ? &tn_message_mapped_systems : &tn_message_mapped_genomes, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    if (request->has_wraps)
        run.options.wraps = (uint32_t)request->wraps;
    run.options.max_steps = request->max_steps;
    run.options.record = request->tree != TREE_NONE || request->trace;
    run.genomes = TN_REPLY(mapped_genomes, answer);
    run.systems = TN_REPLY(mapped_systems, answer);
    return request->has_random ? map_random(&run) : map_given(&run);
}

/* ---- backwards */

tn_status tn_ask_invert(tn_session *session, const tn_invert_request *request, tn_reply *answer)
{
    const char *sentence = request->sentence;
    kept_grammar *kept;
    tn_mapping_options mapping;
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = find_grammar(session, &request->grammar, &kept, &mapping, &error);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_inverted, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    const tn_invert_options options = {.max_depth = mapping.max_depth,
                                       .position_independent = mapping.position_independent,
                                       .max_items = (size_t)request->max_items,
                                       .watch = session->opened->module->watch};
    status = tn_invert(kept->grammar, sentence, strlen(sentence), &options, &kept->genome, &error);
    if (status != TN_OK)
        return tn_session_bad_text(session, &error, "sentence", sentence);
    tn_inverted *inverted = answer->value;
    inverted->genome = tn_genome_text(&kept->genome);
    if (inverted->genome)
        return TN_OK;
    tn_fail_memory(&error);
    return tn_session_fail(session, &error);
}
