/* A compilation: what it is told, and all that it makes. compile.h does it. */
#ifndef TARTAN_COMPILER_COMMON_COMPILATION_H
#define TARTAN_COMPILER_COMMON_COMPILATION_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/resolver.h"
#include "runtime/base/watch.h"

/* What a command line asks beyond what a .plan file says. */
typedef struct tn_questions {
    const char *library;       /* the library that is asked about; NULL: the only one */
    const char *const *wheres; /* expressions: further requirements, called where@1 and so on */
    size_t where_count;
    const char *schema;       /* of the next two */
    const char *pattern;      /* an open plan, or NULL: its trays become functions of the module */
    const char *plan;         /* a plan in brackets, as tests have it; or NULL */
    const char *plan_name;    /* what messages call these two */
    const char *const *parts; /* of a kit, or NULL: the text is a list of conditions, which may count these parts */
    size_t part_count;
} tn_questions;

/* What the source of a param's value is called, also in modules; its text is NAME=VALUE. */
#define TN_SETTING_SOURCE "--set"

/* Values of params, NAME=VALUE each. */
typedef struct tn_param_values {
    const char *const *items;
    size_t count;
} tn_param_values;

struct tn_imports;

typedef struct tn_compile_options {
    tn_resolver resolver; /* of what is used */
    tn_attachments attachments;
    bool warnings_are_errors;
    const tn_questions *questions; /* of a .plan file, or about parts; or NULL */
    tn_param_values params;        /* of a .plan file */
    size_t test; /* of a .plan file: the params have the values that its test of this number, from 1, says; 0: none */
    /* Further texts of the same compilation, in their order, where the notation puts several into one (tn_front.joins).
     */
    const tn_input *more;
    size_t more_count;
    tn_watch *watch; /* or NULL: compiling is given up (TN_STOPPED) between two texts once this says so */
    bool partial;    /* the text may be only a part of what it belongs to: an editor looks at one */
    /* Of a .plan file: changes the syntax trees after they are read and before they are checked, which shows what the
     * file would mean if it were written otherwise; or NULL. What it adds to them lives in the arena. */
    void (*change)(void *context, tn_arena *arena, const struct tn_imports *imports);
    void *change_context;
} tn_compile_options;

typedef struct tn_compilation {
    const struct tn_notation *notation;
    tn_sources sources;
    tn_diagnostics diagnostics;
    tn_arena *arena;
    const tn_input *input;                 /* while it is compiled; NULL afterwards */
    const struct tn_number_ranges *ranges; /* of its numbers (number_ranges.h) */
    struct tn_program *program;            /* checked; NULL where there were errors */
    /* for editors, of a .plan file, and also where there were errors: the files with their syntax trees (import.h), and
     * what became of them (check.h) */
    const struct tn_imports *imports;
    const struct tn_checked *checked;
    const struct tn_checked_fields *fields; /* of a .field file without errors, for breeding (compiler/field/field.h) */
    uint8_t *module;                        /* bytes of the module, owned; NULL where there were errors */
    size_t module_size;
} tn_compilation;

#endif
