/* Rows of option tables: the constructors of a row, and the rows that several commands share, so that each is spelt and
 * explained in one place. Arguments: name, letter of the short form (or 0), name of the argument, field, help.
 *
 * The file of a command defines SETTINGS, its struct of options, before its table. A field that is not of the type that
 * the option's kind writes is a warning. Shared rows name the fields that commands have in common: `common`, `output`,
 * and those of the groups. */
#ifndef TARTAN_CLI_COMMON_OPTION_ROWS_H
#define TARTAN_CLI_COMMON_OPTION_ROWS_H

#include <stddef.h>

#include "cli/common/options.h"

#define OPTION_COUNT(OPTIONS) (sizeof(OPTIONS) / sizeof *(OPTIONS))

/* The offset of a field of that type: the compiler warns of comparing pointers of two types. */
#define OPTION_OFFSET(FIELD, TYPE) (offsetof(SETTINGS, FIELD) + 0 * sizeof(&((SETTINGS *)0)->FIELD == (TYPE *)0))

#define OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TYPE, KIND, HELP)                                                    \
    .name = NAME, .letter = LETTER, .argument = ARGUMENT, .offset = OPTION_OFFSET(FIELD, TYPE), .kind = KIND,          \
    .help = HELP
#define FLAG(NAME, LETTER, FIELD, HELP)                                                                                \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, NULL, FIELD, bool, TN_OPTION_FLAG, HELP)                                              \
    }
#define TEXT(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_TEXT, HELP)                                  \
    }
#define LIST(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_list, TN_OPTION_LIST, HELP)                                \
    }
#define RANK(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_RANK, HELP)                                  \
    }
#define NUMBER(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                         \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_number, TN_OPTION_NUMBER, HELP), .low = LOW, .high = HIGH  \
    }
#define RANGE(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                          \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_range, TN_OPTION_RANGE, HELP), .low = LOW, .high = HIGH    \
    }
#define CHOICE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                           \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, int, TN_OPTION_CHOICE, HELP), .choices = CHOICES                     \
    }
#define MAYBE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                            \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, int, TN_OPTION_MAYBE, HELP), .choices = CHOICES                      \
    }
#define REAL(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_real, TN_OPTION_REAL, HELP)                                \
    }

/* The file that a command writes, in formats of the set WRITES (formats.h); several files; other files. */
#define OUTPUT(FIELD, WRITES, HELP) WRITTEN("output", 'o', "FILE", FIELD, WRITES, HELP)
#define OUTPUTS(FIELD, WRITES, HELP)                                                                                   \
    {                                                                                                                  \
        OPTION_ROW("output", 'o', "FILE", FIELD, tn_option_list, TN_OPTION_LIST, HELP), .writes = WRITES               \
    }
#define WRITTEN(NAME, LETTER, ARGUMENT, FIELD, WRITES, HELP)                                                           \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_TEXT, HELP), .writes = WRITES                \
    }

/* FIELD keeps the names and words of all such options of the command, in their order. */
#define WISH(NAME, FIELD, HELP)                                                                                        \
    {                                                                                                                  \
        OPTION_ROW(NAME, 0, "MEASURE", FIELD, tn_option_list, TN_OPTION_WISH, HELP)                                    \
    }

#define OPTION_WERROR FLAG("werror", 0, common.werror, "treat warnings as errors")
#define OPTION_SET                                                                                                     \
    LIST("set", 0, "NAME=VALUE", common.params,                                                                        \
         "give the param NAME of the .plan file another value than its default, for this run; may be repeated")
#define OPTION_LDRAW                                                                                                   \
    TEXT("ldraw", 0, "DIR", common.ldraw,                                                                              \
         "the LDraw library of which kits take parts (default: the folder that LDRAWDIR names, or /usr/share/ldraw)")
#define OPTION_OUTPUT(WRITES) OPTION_OUTPUT_BY(WRITES, "")
/* AS: what the endings mean, as "; .json is JSON". */
#define OPTION_OUTPUT_BY(WRITES, AS)                                                                                   \
    OUTPUT(output, WRITES, "write to FILE (beside it, then renamed over it)" AS "; - is standard output")
#define OPTION_OUTPUT_OR_PICTURE                                                                                       \
    OUTPUT(output, TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES_PICTURES,                                              \
           "write to FILE (beside it, then renamed over it); - is standard output; .svg, .png and .pdf make a "        \
           "picture, .json is JSON")

/* The field: where the command keeps it. */
#define OPTION_MAX_BOXES(FIELD)                                                                                        \
    NUMBER("max-boxes", 0, "N", FIELD, 1, 100000000, "the most boxes of a design, with their images (default 100000)")
#define OPTION_THREADS(FIELD)                                                                                          \
    NUMBER("threads", 0, "N", FIELD, 1, 1024,                                                                          \
           "how many threads work (default: all processors); changes nothing but the time")

#endif
