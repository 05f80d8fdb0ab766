/* Palindromes by their halves: what a rule says of a palindrome is a property of its first half, and a regular one. */
#ifndef TARTAN_AUTOMATA_HALF_H
#define TARTAN_AUTOMATA_HALF_H

#include "runtime/automata/dfa.h"

/* The words u such that `dfa` accepts u followed by u reversed, or (odd) by u reversed without its first letter, so
 * that u's last letter is the palindrome's middle; then the empty word is not among them. Minimal; the caller frees
 * *out. */
tn_status tn_half(const tn_dfa *dfa, bool odd, tn_bounds *bounds, tn_dfa **out, tn_error *error);

#endif
