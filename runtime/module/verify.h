/* The verifier: everything that running a module relies on, checked once when it is loaded.
 *
 * It takes a module that was decoded but not looked at, and refuses it (TN_INVALID, E0703, with the record or the code
 * offset named) unless:
 *
 * - strings are UTF-8, begin where another ends, and names are of the length that their row says;
 * - fields are what their rows in records.def say: numbers in bounds, references to records that are there, runs that
 *   follow one another and leave nothing out (so that the work is linear), places in their source's text;
 * - sections and kinds of code belong to an engine that is there;
 * - code of the records follows one another; functions end with their one last instruction; every opcode is known and
 * of the function's kind of code; operands are what their rows in operands.def say; the stack never runs empty and
 * never passes stack_max, which never passes the limit; the map ascends and names instructions;
 * - engines find what must hold between fields (engine.h); each says in its own folder what that is.
 *
 * Time and memory are linear in the module's size but for sorting the names.
 */
#ifndef TARTAN_MODULE_VERIFY_H
#define TARTAN_MODULE_VERIFY_H

#include "runtime/module/engine.h"

/* What verifying works with. Engines read it; the functions below write it. */
struct tn_checker {
    const tn_module *module;
    const tn_engines *engines;
    const tn_module_limits *limits;
    tn_error *error;
    const tn_operand_rules *operands[TN_OPERANDS_COUNT];
    uint32_t *sizes; /* bytes of each source's text */

    /* Where it is in the code; section is TN_SECTION_STRINGS before that. */
    tn_section section;
    uint32_t record; /* whose code it is */
    uint32_t offset; /* of the instruction */
    uint32_t end;    /* of the record's code */
    uint32_t depth;  /* of the stack before the instruction */
    size_t map;      /* the next map record */
};

/* Does the module hold to all of the above? TN_INVALID (E0703), TN_LIMIT (E0810), TN_MEMORY. */
tn_status tn_module_verify(const tn_module *module, const tn_engines *engines, const tn_module_limits *limits,
                           tn_error *error);

/* ---- for engines */

/* Refuses the module for this reason; says where in the code it is, if it is there. */
__attribute__((format(printf, 2, 3))) tn_status tn_refuse(const tn_checker *checker, const char *format, ...);

/* Are these texts different from one another: the first of them, and how far one is from the next (a field of records)?
 * Refuses the module for the reason. */
tn_status tn_check_different(const tn_checker *checker, const tn_string *texts, size_t stride, size_t count,
                             const char *reason);

/* A record's code begins: it follows the code before. */
tn_status tn_code_enter(tn_checker *checker, tn_section section, uint32_t record, uint32_t begin, uint32_t end);

/* Reads the next instruction: a known one of this kind of code, whole, with right operands. Does not go past it. */
tn_status tn_code_next(const tn_checker *checker, tn_code_kind code, tn_instruction *instruction);

/* Goes past the instruction; what the map says of it is checked. */
tn_status tn_code_pass(tn_checker *checker, const tn_instruction *instruction);

#endif
