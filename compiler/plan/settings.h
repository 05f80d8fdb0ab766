/* The values that params are given: by `--set`, and by the head of a test whose cases are to be run.
 *
 * They are put into the syntax trees before these are checked. */
#ifndef TARTAN_COMPILER_PLAN_SETTINGS_H
#define TARTAN_COMPILER_PLAN_SETTINGS_H

#include "compiler/common/compilation.h"
#include "compiler/common/import.h"
#include "compiler/plan/syntax/ast.h"

/* Reads those of the options, each as a source of its own called TN_SETTING_SOURCE, in the order of their names, so
 * that the same settings make the same module; and gives them. What has not the form NAME=VALUE is reported there. */
tn_status tn_settings_read(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                           tn_ast_list *settings, tn_error *error);

/* Gives what the test of that number, from 1, of the file itself says; 0: nothing. */
void tn_settings_of_test(const tn_imports *imports, size_t test);

#endif
