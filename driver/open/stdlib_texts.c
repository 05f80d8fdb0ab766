/* Finds files of the standard library in the program itself. */
#include "driver/open/stdlib_texts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/missing.h"
#include "runtime/base/nearest.h"

const tn_stdlib_text *tn_stdlib_text_named(const char *name)
{
    for (size_t i = 0; i < tn_stdlib_text_count; i++)
        if (strcmp(tn_stdlib_texts[i].name, name) == 0)
            return &tn_stdlib_texts[i];
    return NULL;
}

/* ---- as a resolver */

/* The name of a file that was likely meant, with the extension that is asked for; NULL if there is none. */
static const char *find_near(const char *name, const char *extension)
{
    const char **names = calloc(tn_stdlib_text_count + 1, sizeof *names);
    size_t count = 0;
    for (size_t i = 0; names && i < tn_stdlib_text_count; i++)
        if (strcmp(strrchr(tn_stdlib_texts[i].name, '.'), extension) == 0)
            names[count++] = tn_stdlib_texts[i].name;
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    free(names);
    return near;
}

static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tn_stdlib_resolver *own = context;
    char name[TN_MEANT_SIZE];
    if (!tn_path_is_bare(request->path))
        return own->rest.resolve(own->rest.context, request, found, meant, error);
    snprintf(name, sizeof name, "%s%s", request->path, request->extension);
    const tn_stdlib_text *text = tn_stdlib_text_named(name);
    if (text) {
        *found = (tn_input){text->text, text->size, text->recorded, NULL, text->recorded};
        return TN_OK;
    }
    tn_status status = own->rest.resolve(own->rest.context, request, found, meant, error);
    const char *near = status == TN_INVALID ? find_near(name, request->extension) : NULL;
    if (near && !meant[0]) {
        int size = (int)(strlen(near) - strlen(request->extension));
        tn_error_help(error, "did you mean `%.*s`?", size, near);
        snprintf(meant, TN_MEANT_SIZE, "%.*s", size, near);
    }
    return status;
}

tn_resolver tn_stdlib_resolver_of(tn_stdlib_resolver *own)
{
    return (tn_resolver){resolve, own};
}
