/* How lines of .plan files are written, for errors about one that is not. */
#ifndef TARTAN_PLAN_SYNTAX_SYNTAX_EXAMPLE_H
#define TARTAN_PLAN_SYNTAX_SYNTAX_EXAMPLE_H

#include <stddef.h>

/* An example of the line that the byte `at` of a text is on, by the line's first word; NULL where the word begins
 * lines of several kinds, or of none. Its lengths are metric where the first one of the text is. A string that lives as
 * long as the program. */
const char *tn_syntax_example(const char *text, size_t at);

#endif
