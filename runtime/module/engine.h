/* An engine as the loader and the disassembler see it: what of a module is its own, how that is verified and listed.
 *
 * Each engine has one constant tn_engine in its own folder and one row in runtime/engines.def; runtime/load.c alone
 * sees all of them. By the rows of records.def and operands.def every field and operand is verified and listed without
 * the engine; it says what holds between them. Everything here is constant and shared between threads.
 */
#ifndef TARTAN_MODULE_ENGINE_H
#define TARTAN_MODULE_ENGINE_H

#include "runtime/module/code.h"

typedef struct tn_checker tn_checker; /* verify.h */
typedef struct tn_lister tn_lister;   /* lister.h */

/* What an engine says of a kind of operands beyond its row. Either may be NULL. */
typedef struct tn_operand_rules {
    tn_operands kind;
    tn_status (*verify)(const tn_checker *checker, const tn_instruction *instruction);
    void (*list)(tn_lister *lister, const tn_instruction *instruction); /* after a space */
} tn_operand_rules;

typedef struct tn_engine {
    const char *name;
    /* The sections that no other engine has; ended by TN_SECTION_STRINGS. */
    const tn_section *sections;
    /* The kinds of code that it runs: bits 1u << TN_CODE_RULE and so on. */
    uint32_t codes;
    const tn_operand_rules *operands;
    size_t operand_count;
    /* What a TERM is in the functions of one kind, by name: NULL if the engine has no such functions. */
    const char *const *terms;
    uint32_t term_count;
    tn_function_kind term_kind;

    /* Each of these may be NULL. Everything that the rows of records.def say has been verified before.
     * tables: what holds in its sections beyond that. */
    tn_status (*verify)(const tn_checker *checker);
    /* A FUNCTION record of its kinds of code, before the code is looked at. */
    tn_status (*verify_function)(const tn_checker *checker, uint32_t function);
    /* All code of one of its sections that has CODE, in order: by tn_code_enter, tn_code_next, tn_code_leave. */
    tn_status (*verify_code)(tn_checker *checker, tn_section section);
    /* Whatever needs all code to have been found right: what its functions are made of as a whole. */
    tn_status (*verify_after)(const tn_checker *checker);

    /* Lists its tables, and (after the functions) what has code of its own. An engine with neither has its records
     * listed field by field. */
    void (*list)(tn_lister *lister);
    void (*list_code)(tn_lister *lister);
    /* Lists one record of a section in its own words; false: it has none, and the fields are listed. */
    bool (*list_record)(tn_lister *lister, tn_section section, uint32_t index);
    /* Writes what a function of its code is: after its kind (" n > 1" of a condition), and in its heading (" of
     * houses" of a rule's). */
    void (*list_function)(tn_lister *lister, uint32_t function);
    void (*list_heading)(tn_lister *lister, uint32_t function);
} tn_engine;

/* All engines that a program has. */
typedef struct tn_engines {
    const tn_engine *const *items;
    size_t count;
} tn_engines;

/* The engine that has a section, or runs a kind of code; NULL if none does. */
const tn_engine *tn_engine_of_section(const tn_engines *engines, tn_section section);
const tn_engine *tn_engine_of_code(const tn_engines *engines, tn_code_kind code);

/* The engine that says what a TERM is in functions of this kind; NULL if none does. */
const tn_engine *tn_engine_of_terms(const tn_engines *engines, tn_function_kind kind);

/* What the engines say of each kind of operands; NULL if none says anything. */
void tn_engines_operands(const tn_engines *engines, const tn_operand_rules *rules[TN_OPERANDS_COUNT]);

#endif
