/* Rows of option tables: the constructors of a row, and the rows that several commands share, so that each is spelt and
 * explained in one place. Arguments: name, letter of the short form (or 0), name of the argument, field of tn_settings,
 * help. */
#ifndef TARTAN_CLI_COMMON_OPTION_ROWS_H
#define TARTAN_CLI_COMMON_OPTION_ROWS_H

#include <stddef.h>

#include "cli/common/options.h"

#define OPTION_COUNT(OPTIONS) (sizeof(OPTIONS) / sizeof *(OPTIONS))

#define OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, KIND, HELP)                                                          \
    .name = NAME, .letter = LETTER, .argument = ARGUMENT, .offset = offsetof(tn_settings, FIELD), .kind = KIND,        \
    .help = HELP
#define FLAG(NAME, LETTER, FIELD, HELP)                                                                                \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, NULL, FIELD, TN_OPTION_FLAG, HELP)                                                    \
    }
#define TEXT(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_TEXT, HELP)                                                \
    }
#define LIST(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_LIST, HELP)                                                \
    }
#define RANK(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_RANK, HELP)                                                \
    }
#define NUMBER(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                         \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_NUMBER, HELP), .low = LOW, .high = HIGH                    \
    }
#define RANGE(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                          \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_RANGE, HELP), .low = LOW, .high = HIGH                     \
    }
#define CHOICE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                           \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_CHOICE, HELP), .choices = CHOICES                          \
    }

#define MAYBE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                            \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_MAYBE, HELP), .choices = CHOICES                           \
    }
#define REAL(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TN_OPTION_REAL, HELP)                                                \
    }

#define WISH(NAME, HELP)                                                                                               \
    {                                                                                                                  \
        OPTION_ROW(NAME, 0, "MEASURE", wanted, TN_OPTION_WISH, HELP)                                                   \
    }

#define OPTION_WERROR FLAG("werror", 0, werror, "treat warnings as errors")
#define OPTION_OUTPUT                                                                                                  \
    TEXT("output", 'o', "FILE", output, "write to FILE (beside it, then renamed over it); - is standard output")
#define OPTION_LIBRARY                                                                                                 \
    TEXT("library", 'l', "NAME", library, "which library of the file; may be left out where the file has only one")
#define OPTION_WHERE                                                                                                   \
    LIST("where", 0, "EXPRESSION", wheres,                                                                             \
         "only plans that meet EXPRESSION too, a requirement in the words of the file; may be repeated")
#define OPTION_TRAYS                                                                                                   \
    RANGE("trays", 0, "A..B", trays, 0, UINT32_MAX - 1, "how many trays a plan has, instead of what the library says")
#define OPTION_MAX_LENGTH                                                                                              \
    NUMBER("max-length", 0, "N", max_length, 1, 1u << 24, "the longest plan that is accepted, in trays (default 4096)")
#define OPTION_MAX_STATES                                                                                              \
    NUMBER("max-states", 0, "N", max_states, 1, 1u << 30,                                                              \
           "the most states an automaton may have while it is made (default 20000, 1000000 for a library)")
#define OPTION_THREADS                                                                                                 \
    NUMBER("threads", 0, "N", threads, 1, 1024,                                                                        \
           "how many threads work (default: all processors); changes nothing but the time")
#define OPTION_ENGINE                                                                                                  \
    CHOICE(                                                                                                            \
        "engine", 0, "ENGINE", engine, "auto|vm|dfa",                                                                  \
        "vm (the interpreter) or dfa (automata); auto, the default, is automata with the interpreter for rules that "  \
        "pass the state limit")

#endif
