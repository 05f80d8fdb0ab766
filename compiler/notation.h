/* The notations of rule files, told apart by the ends of their names. */
#ifndef TARTAN_COMPILER_COMMON_NOTATION_H
#define TARTAN_COMPILER_COMMON_NOTATION_H

typedef enum tn_notation {
    TN_NOTATION_PLAN,
    TN_NOTATION_HEMLS,
    TN_NOTATION_STUDY,
    TN_NOTATION_BNF,
    TN_NOTATION_COUNT
} tn_notation;

/* "plan": the name, and without its dot the extension. */
const char *tn_notation_name(tn_notation notation);

/* The notation of a file by its path; TN_NOTATION_COUNT where its name ends in none of them. */
tn_notation tn_notation_of(const char *path);

#endif
