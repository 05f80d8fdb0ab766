/* Rules as regular expressions: a POSIX extended one over a letter for each set of trays that the rule does not tell
 * apart (a column of its automaton). */
#ifndef TARTAN_PLAN_TEXT_EXPORT_REGEX_H
#define TARTAN_PLAN_TEXT_EXPORT_REGEX_H

#include "runtime/automata/dfa.h"
#include "runtime/plan/schema/classes.h"
#include "runtime/plan/text/text.h"

#define TN_REGEX_LETTERS_MAX 62u  /* a-z, A-Z, 0-9: columns past it are TN_LIMIT (E0802) */
#define TN_REGEX_LENGTH_MAX 2000u /* characters, anchors and all: a longer one is TN_LIMIT (E0802) */

/* The letter of a column, below TN_REGEX_LETTERS_MAX. */
char tn_regex_letter(uint32_t column);

/* Appends the expression for all plans that the automaton accepts, "^...$"; nothing where it accepts none. By state
 * elimination on the automaton (Brzozowski, McCluskey 1963), which should be minimal. */
tn_status tn_export_regex(const tn_dfa *dfa, tn_buffer *out, tn_error *error);

/* Appends lines of a comment ("# ...") that say of each tray which letter it is (regex_legend.c). The automaton has at
 * most TN_REGEX_LETTERS_MAX columns. */
tn_status tn_regex_legend(const tn_dfa *dfa, const tn_classes *classes, tn_buffer *out, tn_error *error);

/* Appends a plan as letters. false where out of memory. */
bool tn_regex_plan(const tn_dfa *dfa, const tn_classes *classes, const tn_tray *trays, size_t length, tn_buffer *out);

#endif
