/* The verifier: everything that running a module relies on, checked once when it is loaded.
 *
 * It takes a module that was decoded but not looked at, and refuses it (TN_INVALID, E0703, with the record or the code
 * offset named) unless:
 *
 *   strings   are UTF-8, begin where another ends, and names are 1 to TN_NAME_MAX bytes long
 *   runs      follow one another (records.def), so that no record belongs to two and the work is linear
 *   schemas   have 1 to TN_FIELDS_MAX fields of 1 to TN_VALUES_MAX values of a known kind; a flag has two; lengths lie
 * in 0..TN_LENGTH_MAX; forbidden trays and specifiers are of the schema, with no bit beyond its last value functions
 * end with their one RETURN or ANSWER and nothing after it; every opcode is known and of the function's engine;
 * operands name a record of the right kind and schema, calls a lower function; the stack never runs empty and never
 * passes stack_max, which never passes the limit rules, libraries and clauses name functions of the right kind and
 * schema places    lie in their source's text; the map ascends and names instructions
 *   growth    one rewrite system and one study at most; labels, points and templates that are there; numbers within the
 *             limits of growth.h
 *
 *   grammars  have rules, and rules have productions, that follow one another; a production is code of engine MAP that
 * ends with its one DONE, whose bodies nest, and whose operands are the grammar's own
 *
 *   settings  of an evolution ascend, are in range and agree with one another, and there is one grammar
 *
 * Time and memory are linear in the module's size but for sorting the names.
 */
#ifndef TARTAN_MODULE_VERIFY_H
#define TARTAN_MODULE_VERIFY_H

#include "runtime/module/module.h"

/* Does the module hold to all of the above? TN_INVALID (E0703), TN_LIMIT (E0810), TN_MEMORY. */
tn_status tn_module_verify(const tn_module *module, const tn_module_limits *limits, tn_error *error);

/* Its parts. Code relies on the tables having been verified before. */
tn_status tn_verify_tables(const tn_module *module, const tn_module_limits *limits, tn_error *error);
tn_status tn_verify_growth(const tn_module *module, tn_error *error);
tn_status tn_verify_settings(const tn_module *module, tn_error *error);
tn_status tn_verify_code(const tn_module *module, const tn_module_limits *limits, tn_error *error);

/* Grammars with their productions' code, which starts at *offset, and its map records, from *map on; both are moved
 * past them. A part of verifying the code. */
tn_status tn_verify_grammars(const tn_module *module, uint32_t *offset, size_t *map, tn_error *error);

#endif
