/* What is known of a module beyond its text, for hovering: how many plans each rule keeps out, how the plans that it
 * matches lie to those of the others, and what the declarations of forms come to. Owns its texts. */
#ifndef TARTAN_LSP_FACTS_H
#define TARTAN_LSP_FACTS_H

#include "driver/plan/analysis.h"
#include "lsp/places.h"

typedef struct tn_rule_count {
    char *library, *rule;
    char *out, *only;       /* in digits, as in tn_library_effect; rule NULL: how many are generated and kept */
    bool requires, is_rule; /* is_rule: the clause is the rule of its name, not an expression called so */
} tn_rule_count;

/* The relations of the rules of one schema. */
typedef struct tn_rule_matrix {
    char **names;       /* [count] */
    uint8_t *relations; /* [count][count]: a tn_rule_relation */
    size_t count;
} tn_rule_matrix;

/* How many plans of a library have so many trays. */
typedef struct tn_length_count {
    char *library;
    uint32_t length;
    double share; /* of those kept */
} tn_length_count;

/* What measures come to over the libraries. */
typedef struct tn_measure_fact {
    char *library, *measure;
    char *text; /* "146.88 m2 to 248.4 m2, 229.396 m2 on average" */
} tn_measure_fact;

typedef struct tn_measure_facts {
    tn_measure_fact *items;
    size_t count, capacity;
} tn_measure_facts;

typedef struct tn_facts {
    tn_rule_count *counts;
    size_t count, capacity;
    tn_rule_matrix *matrices;
    size_t matrix_count;
    tn_measure_facts measures;
    tn_place_facts places;
    tn_length_count *lengths; /* of libraries that have more than one */
    size_t length_count, length_capacity;
} tn_facts;

/* Counts the libraries of a module, and takes over the relations that were found. What does not fit into the limits is
 * left out. memory: where counts are found and kept, or NULL. NULL where out of memory. */
tn_facts *tn_facts_new(const tn_module *module, const tn_plan_analyses *analyses, tn_plan_memory *memory);
void tn_facts_free(tn_facts *facts);

/* What there is to say about a rule, measure, clause, library, form or part of one, as Markdown; NULL where there is
 * nothing. The caller frees it.
 */
char *tn_facts_text(const tn_facts *facts, const tn_symbol *symbol);

/* Writes a number's digits in groups of three: "1,234,567". */
void tn_facts_grouped(FILE *out, const char *digits);

#endif
