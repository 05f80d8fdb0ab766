/* What a person types while breeding, beside the numbers of parents. */
#ifndef TARTAN_CLI_GENOME_PROMPT_H
#define TARTAN_CLI_GENOME_PROMPT_H

#include "cli/genome/evolution_session.h"

typedef enum tn_prompt_answer {
    TN_PROMPT_NOT_A_COMMAND,
    TN_PROMPT_DONE,   /* the run has changed */
    TN_PROMPT_REFUSED /* what is wrong has been said */
} tn_prompt_answer;

/* Does what a line says: `set NAME VALUE`, `insert FILE`, `out N`, `edit N` and `edit N FILE`. N is a place on the
 * sheet, or with # an id. */
tn_prompt_answer tn_prompt_do(tn_evolving *session, char *line);

#endif
