/* Every limit of the compiler, in one place. Each is reported as an ordinary diagnostic (E0830, E0831) that names it;
 * the sizes are far beyond what people write, and keep hostile input from taking the machine. What a module can hold
 * (fields, values, bytes of a name) is in runtime/module/module.h. */
#ifndef TARTAN_COMPILER_COMMON_LIMITS_H
#define TARTAN_COMPILER_COMMON_LIMITS_H

#define TN_NESTING_MAX 256u          /* rule expressions and conditions, one inside another: bounds the C stack */
#define TN_FILES_MAX 256u            /* files of one compilation; also bounds how deep imports nest */
#define TN_SCHEMAS_MAX 256u          /* over all files */
#define TN_RULES_MAX 10000u          /* over all files */
#define TN_LIBRARIES_MAX 1000u       /* over all files */
#define TN_CLAUSES_MAX 10000u        /* of one library, with those that it takes over */
#define TN_TESTS_MAX 10000u          /* test blocks over all files */
#define TN_FORBIDS_MAX 1000u         /* of one schema */
#define TN_TRAY_BOXES_MAX 1000u      /* of one `tray(...)` that compares sums */
#define TN_FORBID_BOXES_MAX 10000u   /* specifiers that they come to */
#define TN_LITERAL_TRAYS_MAX 4096u   /* of a plan in a test: the engines' default for the longest plan */
#define TN_INSTRUCTIONS_MAX 1000000u /* of a module: what loading accepts */

#endif
