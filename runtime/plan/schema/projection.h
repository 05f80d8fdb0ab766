/* Projection of plans: which trays of a newer schema lie above each tray, being the same in the fields of a schema that
 * both are made from. An instruction IMAGE asks of a plan whether a plan of a library lies above it, tray by tray.
 */
#ifndef TARTAN_PLAN_SCHEMA_PROJECTION_H
#define TARTAN_PLAN_SCHEMA_PROJECTION_H

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"
#include "runtime/plan/schema/schema.h"

/* Is the function one IMAGE, so that its library is asked? *image: that instruction. */
bool tn_function_is_image(const tn_module *module, uint32_t function, tn_instruction *image);

/* Immutable once made. The fields that both schemas have come first in each, so trays that are the same in these follow
 * one another: above a tray lie the newer trays from `begin` to `end`. Owns what it holds; borrows the schema. */
typedef struct tn_projection {
    const tn_schema *schema;
    const tn_library_record *library; /* of the newer plans */
    tn_schema *newer;
    tn_tray *begin, *end; /* [trays] */
} tn_projection;

/* Free with tn_projection_free. E0803 as of tn_schema_new. */
tn_status tn_projection_new(const tn_schema *schema, const tn_instruction *image, tn_projection **projection,
                            tn_error *error);
void tn_projection_free(tn_projection *projection);

static inline const tn_clause_record *tn_projection_clause(const tn_projection *projection, uint32_t i)
{
    return &projection->schema->module->CLAUSE_records[projection->library->clause_first + i];
}

/* Appends to `trays` the first newer tray of each class above a tray, ascending. class_of: of the newer trays. seen:
 * room of the caller's for the classes, all below `stamp`, which grows from call to call. false where out of memory. */
bool tn_projection_list(const tn_projection *projection, const uint32_t *class_of, tn_tray tray, uint32_t *seen,
                        uint32_t stamp, tn_key *trays);

#endif
