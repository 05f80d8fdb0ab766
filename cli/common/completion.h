/* Completion for shells, written from the tables of options.h: what `tartan help --completion SHELL` prints and the
 * build installs. */
#ifndef TARTAN_CLI_COMMON_COMPLETION_H
#define TARTAN_CLI_COMMON_COMPLETION_H

#include "cli/common/options.h"

typedef struct tn_shell {
    const char *name;
    void (*write)(const tn_commands *commands, FILE *out);
} tn_shell;

/* The shell named so, or NULL. */
const tn_shell *tn_shell_find(const char *name);

void tn_completion_bash(const tn_commands *commands, FILE *out);
void tn_completion_zsh(const tn_commands *commands, FILE *out);
void tn_completion_fish(const tn_commands *commands, FILE *out);

/* What can follow an option. */
typedef enum tn_completes {
    TN_COMPLETES_NOTHING, /* a flag */
    TN_COMPLETES_WORDS,   /* one of its choices */
    TN_COMPLETES_FILES,   /* a file or a folder */
    TN_COMPLETES_FREE,    /* anything else */
} tn_completes;
tn_completes tn_option_completes(const tn_option *option);

/* Writes the words that can be a command's first operand, those that its usage writes in small letters, with `between`
 * between them; returns how many. `out` may be NULL, to count. */
size_t tn_operand_words(const tn_command *command, const char *between, FILE *out);

/* Writes a list "a|b|c" with `between` instead of the bars. */
void tn_choices_write(const char *choices, const char *between, FILE *out);

/* How many bytes of an option's help serve as its description in a list: the first clause. */
size_t tn_description_size(const char *help);

#endif
