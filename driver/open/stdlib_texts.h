/* The files of the standard library as they were when this was built, for programs that have no folder of it. */
#ifndef TARTAN_DRIVER_OPEN_STDLIB_TEXTS_H
#define TARTAN_DRIVER_OPEN_STDLIB_TEXTS_H

#include "compiler/common/compilation.h"

typedef struct tn_stdlib_text {
    const char *recorded; /* what a module calls it: "<stdlib>/shapes.field" */
    const char *name;     /* "shapes.field" */
    const char *text;     /* a zero byte follows it */
    size_t size;
} tn_stdlib_text;

/* In the order of their names. */
extern const tn_stdlib_text tn_stdlib_texts[];
extern const size_t tn_stdlib_text_count;

/* The file of that name, with its extension; NULL if there is none. */
const tn_stdlib_text *tn_stdlib_text_named(const char *name);

/* A resolver that finds bare names (`use "shapes"`) in these texts, and asks the other one for all else. */
typedef struct tn_stdlib_resolver {
    tn_resolver rest;
} tn_stdlib_resolver;

/* `own` stays the caller's, until compiling has ended. */
tn_resolver tn_stdlib_resolver_of(tn_stdlib_resolver *own);

#endif
