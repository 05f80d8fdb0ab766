/* Told of forms while they are there: what scores sentences builds a form, measures it and forgets it. */
#ifndef TARTAN_DRIVER_PROGRAM_FORM_LISTENER_H
#define TARTAN_DRIVER_PROGRAM_FORM_LISTENER_H

#include "runtime/geometry/mesh.h"

typedef struct tn_form_facts {
    const tn_mesh *mesh;
    const char *const *names; /* [count] of measures */
    const double *values;     /* [count]; not a number: it was not measured */
    size_t count;
} tn_form_facts;

/* Zeros: nobody listens. */
typedef struct tn_form_listener {
    void *context;
    tn_status (*hear)(void *context, unsigned thread, const tn_form_facts *facts, tn_error *error);
} tn_form_listener;

static inline tn_status tn_form_listener_tell(const tn_form_listener *listener, unsigned thread, const tn_form_facts *facts,
                                         tn_error *error)
{
    return listener->hear ? listener->hear(listener->context, thread, facts, error) : TN_OK;
}

#endif
