#include "compiler/notation.h"

#include <string.h>

static const char *const names[TN_NOTATION_COUNT] = {"plan", "hemls", "study", "bnf"};

const char *tn_notation_name(tn_notation notation)
{
    return names[notation];
}

tn_notation tn_notation_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    tn_notation notation = 0;
    while (notation < TN_NOTATION_COUNT && (!dot || strcmp(dot + 1, names[notation]) != 0))
        notation++;
    return notation;
}
