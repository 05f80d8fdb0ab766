/* What the files of the C interface to plans share.
 *
 * A tn_api_plans is a module as one object of the interface sees it, with a schema of its own and whoever waits while
 * the object is made; it lives in the object, is cleared with it, and must not move. */
#ifndef TARTAN_API_PLAN_PLAN_H
#define TARTAN_API_PLAN_PLAN_H

#include "api/base/api.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/schema/schema.h"

typedef struct tn_api_plans {
    tn_module module; /* the caller's, with our watch */
    tn_watch watch;
    tn_schema *schema; /* or NULL */
} tn_api_plans;

/* Sets up all but the schema. */
tartan_status tn_api_plans_begin(const tartan_module *module, const tartan_watch *watch, tn_api_plans *plans,
                                 tartan_error *error);

/* The object is made: nobody waits any more. */
void tn_api_plans_made(tn_api_plans *plans);
void tn_api_plans_clear(tn_api_plans *plans);

struct tartan_library {
    tn_api_plans plans;        /* empty for a part of a diff */
    const tn_schema *schema;   /* of plans, or of the diff's first library */
    const tn_library *library; /* what is asked: `owned`, or the diff's */
    tn_library *owned;
    uint32_t index; /* of the LIBRARY record, of an owned one */
    bool bare;      /* without pruning */
};

/* The index of the LIBRARY record named so; NULL: the only one of the compiled file itself. */
tartan_status tn_api_library_find(const tn_module *module, const char *name, uint32_t *index, tartan_error *error);

/* The i-th of ready rules: its RULE record; their schema. */
uint32_t tn_api_rules_record(const tartan_rules *rules, size_t i);
const tn_schema *tn_api_rules_schema(const tartan_rules *rules);

/* The RULE records named, or with count 0 all of the compiled file itself, which must be of one schema: *records is the
 * caller's. */
tartan_status tn_api_rules_find(const tn_module *module, const char *const *names, size_t count, uint32_t **records,
                                size_t *found, tartan_error *error);

/* Are these tray numbers of the schema? TN_INVALID where not. */
tn_status tn_api_trays(const tn_schema *schema, const uint32_t *trays, size_t length, tn_error *error);

/* Are these plans one behind the other, and are their trays there? */
tartan_status tn_api_plan_array(const uint32_t *trays, const size_t *ends, size_t count, tartan_error *error);

/* A number as a new decimal text. */
tartan_status tn_api_decimal(const mpz_t number, char **text, tartan_error *error);

/* tartan_schema is tn_schema under its public name. */
static inline const tn_schema *tn_api_schema(const tartan_schema *schema)
{
    return (const tn_schema *)(const void *)schema;
}

static inline const tartan_schema *tn_api_public_schema(const tn_schema *schema)
{
    return (const tartan_schema *)(const void *)schema;
}

#endif
