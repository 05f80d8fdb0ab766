/* When a clause of a library of houses can be asked: how much of a house has to be known for what it asks. */
#ifndef TARTAN_HOUSE_STAGES_H
#define TARTAN_HOUSE_STAGES_H

#include "runtime/house/house_names.h"
#include "runtime/house/measure/measure.h"
#include "runtime/module/code.h"

typedef enum tn_clause_stage {
    TN_STAGE_SECTION,   /* the plan, the section, which cells there are */
    TN_STAGE_FUNCTIONS, /* their functions */
    TN_STAGE_FACES,     /* what is in the faces: rooms, walks, what touches what */
    TN_STAGE_TILES      /* what it costs, also what stands in its rooms; and how one walks around that */
} tn_clause_stage;

/* The stage of each clause of the library. */
tn_status tn_clause_stages(const tn_house_form *form, const tn_house_library_record *library, tn_clause_stage *stages,
                           tn_error *error);

/* Which clauses of the library compare a number with a term of such a kind (tn_house_term_kind). */
typedef bool tn_term_asked(uint32_t kind);
tn_status tn_clauses_asking(const tn_house_form *form, const tn_house_library_record *library, tn_term_asked *asked,
                            bool *clauses, tn_error *error);

/* Which functions of rules do, by themselves or by one that they call (malloc); for walks or ways out. */
tn_status tn_functions_asking(const tn_module *module, tn_term_asked *asked, bool **functions, tn_error *error);
tn_status tn_functions_walking(const tn_module *module, bool **functions, tn_error *error);

/* Which clauses ask for walks or ways out. Does a measure? */
tn_status tn_clauses_walking(const tn_house_form *form, const tn_house_library_record *library, bool *clauses,
                             tn_error *error);
/* Those that do not: so many, which the caller frees also after a failure. */
tn_status tn_clauses_not_walking(const tn_house_form *form, const tn_house_library_record *library,
                                 tn_house_clause_record **clauses, uint32_t *count, tn_error *error);
bool tn_measure_walks(const tn_module *module, const tn_house_measured *measure);

/* Marks the functions that an instruction names. */
void tn_mark_operands(const tn_module *module, const tn_instruction *op, bool *reached);

#endif
