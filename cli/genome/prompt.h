/* What a person types while breeding: the numbers of parents, `set NAME VALUE`, `insert FILE`, `out N`, `edit N` and
 * `edit N FILE`. N is a place on the sheet, or with # an id. Each line is read into an action of the question breed. */
#ifndef TARTAN_CLI_GENOME_PROMPT_H
#define TARTAN_CLI_GENOME_PROMPT_H

#include "ask/session/session.h"

/* The first of the words that say what an action does. */
enum { TN_PROMPT_BREED, TN_PROMPT_SET, TN_PROMPT_INSERT, TN_PROMPT_EDIT, TN_PROMPT_OUT };

typedef struct tn_prompt {
    const char *dir;          /* the run's folder, in which sentences are edited; borrowed */
    tn_breed_action *actions; /* what was done; owned */
    char **texts;             /* of each; owned */
    size_t count;
    char *sentence, *edited; /* owned: of the action that was read last; the file that the editor had, or NULL */
} tn_prompt;

typedef enum tn_prompt_answer {
    TN_PROMPT_ACTION,  /* it says what is to be done */
    TN_PROMPT_NOTHING, /* the line is empty */
    TN_PROMPT_REFUSED  /* what is wrong has been said */
} tn_prompt_answer;

/* Reads a line, whose end is cut off: the action borrows from it and from the prompt. bred: the generation that it is
 * about. */
tn_prompt_answer tn_prompt_read(tn_prompt *prompt, const tn_bred *bred, char *line, tn_breed_action *action);

/* Ends what was read: what was edited is kept unless it is done. */
void tn_prompt_end(tn_prompt *prompt, bool done);

/* Copies the action behind those of the request; takes it back. false: out of memory. */
bool tn_prompt_add(tn_prompt *prompt, const tn_breed_action *action, tn_breed_request *request);
void tn_prompt_take_back(tn_prompt *prompt, tn_breed_request *request);

/* Says on standard output what is wrong, with its place in a sentence. */
void tn_prompt_say(const tn_diagnostic *diagnostic);

void tn_prompt_clear(tn_prompt *prompt);

#endif
