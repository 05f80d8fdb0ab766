/* Grammars: genomes mapped to sentences, and sentences back to genomes.
 *
 * A genome is an array of codons, unsigned 64-bit numbers. Mapping reads them one after another, and each chooses among
 * the productions of a rule; any genome, also an empty one, gives a sentence or a reason why there is none. */
#ifndef TARTAN_GENOME_H
#define TARTAN_GENOME_H

#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tartan_grammar tartan_grammar;

/* The grammar of a module (of a .bnf file, or of an evolution's .study). It borrows nothing: the module may be freed
 * first. TARTAN_INVALID where the module has none. */
TARTAN_API tartan_status tartan_grammar_new(const tartan_module *module, tartan_grammar **grammar, tartan_error *error);
TARTAN_API void tartan_grammar_free(tartan_grammar *grammar);

/* How many derivations there are, in decimal: of at most `depth` levels, or, where the grammar has loops
 * (*by_codons is then set), of exactly `depth` codons. TARTAN_LIMIT past 2^20 bits. */
TARTAN_API tartan_status tartan_grammar_derivations(const tartan_grammar *grammar, uint32_t depth, bool *by_codons,
                                                    char **count, tartan_error *error);

/* What a genr8 grammar does about edges without a rule: nothing, a rule from further codons, or the rule that leaves
 * them as they are. */
typedef enum tartan_repair { TARTAN_REPAIR_OFF, TARTAN_REPAIR_GENOME, TARTAN_REPAIR_IDENTITY } tartan_repair;

typedef struct tartan_map_options {
    size_t size;
    uint32_t wraps;     /* further readings of the genome */
    uint32_t max_depth; /* of a derivation; 0: no limit */
    uint64_t max_steps; /* symbols and codons handled; 0: 1,000,000 */
    tartan_repair repair;
    bool derivation;           /* keep the derivation, for tartan_mapper_nodes */
    bool position_independent; /* codons in pairs: which non-terminal is replaced next, and by what */
} tartan_map_options;
TARTAN_SIZED(tartan_map_options)

/* What the grammar's own directives say. */
TARTAN_API tartan_status tartan_map_options_of(const tartan_grammar *grammar, tartan_map_options *options,
                                               tartan_error *error);

/* Scratch memory for mapping; borrows the grammar, belongs to one thread. */
typedef struct tartan_mapper tartan_mapper;

/* A mapper for the grammar. */
TARTAN_API tartan_status tartan_mapper_new(const tartan_grammar *grammar, tartan_mapper **mapper, tartan_error *error);
TARTAN_API void tartan_mapper_free(tartan_mapper *mapper);

typedef enum tartan_map_reason {
    TARTAN_MAP_VALID,
    TARTAN_MAP_OUT_OF_CODONS,
    TARTAN_MAP_TOO_DEEP,
    TARTAN_MAP_TOO_LONG,             /* max_steps */
    TARTAN_MAP_REPAIR_OUT_OF_CODONS, /* the sentence itself is there */
    TARTAN_MAP_REPAIR_TOO_LONG,
} tartan_map_reason;

typedef struct tartan_mapping {
    size_t size;
    bool valid;
    tartan_map_reason reason;
    const char *reason_text; /* "out of codons"; "" where it is valid */
    const char *sentence;    /* zero-ended, after repair; "" where there is none */
    size_t sentence_size;
    uint64_t used; /* codons, counting past the end when wrapping; without repair's own */
    uint64_t nodes;
    uint32_t depth;
    uint64_t wraps;
} tartan_mapping;
TARTAN_SIZED(tartan_mapping)

/* Maps a genome. TARTAN_OK also where it is not valid: mapping->reason says why. Texts are the mapper's, until its next
 * use. `options` NULL: the grammar's own. No codons may be NULL. */
TARTAN_API tartan_status tartan_map(tartan_mapper *mapper, const uint64_t *codons, size_t count,
                                    const tartan_map_options *options, tartan_mapping *mapping, tartan_error *error);

/* A derivation as a tree, in the order of the text; roots have no parent. */
typedef enum tartan_node_kind {
    TARTAN_NODE_RULE,     /* a non-terminal: text is its name, choice the production */
    TARTAN_NODE_TERMINAL, /* text is what it writes */
    TARTAN_NODE_EDGE,     /* choice is its number; text "X", "Y", "Z" for a variable, else "" */
    TARTAN_NODE_LOOP,     /* a loop goes on (choice 1) or ends (0) */
    TARTAN_NODE_OPTION,   /* an option is taken (choice 1) or not (0) */
    TARTAN_NODE_REPAIR,   /* choice: the edge type that gets a rule */
} tartan_node_kind;

#define TARTAN_NONE UINT32_MAX

typedef struct tartan_node {
    tartan_node_kind kind;
    uint32_t parent, first_child, next; /* nodes, or TARTAN_NONE */
    uint32_t depth;
    const char *text; /* the grammar's, of text_size bytes; not zero-ended */
    size_t text_size;
    bool reads;                      /* a codon was read for it: */
    uint64_t read;                   /* which one, from 0, counting past the end when wrapping */
    uint64_t codon, modulus, choice; /* choice = codon mod modulus, where it reads; a RULE's choice is always there */
    size_t text_begin;               /* in the sentence before repair */
} tartan_node;

/* The derivation of the mapper's last tartan_map, which was to keep it. The array is the mapper's, until its next use.
 * Also of a mapping that is not valid, as far as it went. */
TARTAN_API tartan_status tartan_mapper_nodes(tartan_mapper *mapper, const tartan_node **nodes, size_t *count,
                                             tartan_error *error);

/* A genome that is mapped to the sentence (before repair) as the grammar says, within max_depth (0: no limit).
 * TARTAN_INVALID, with error->column, where the grammar has no such sentence; TARTAN_LIMIT where finding out takes too
 * much. Free the codons with tartan_bytes_free. `watch` may be NULL; it is told how much of the sentence has been read.
 */
TARTAN_API tartan_status tartan_invert(const tartan_grammar *grammar, const char *sentence, size_t size,
                                       uint32_t max_depth, const tartan_watch *watch, uint64_t **codons, size_t *count,
                                       tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
