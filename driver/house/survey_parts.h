/* What the files of a survey share. Internal to driver/house. */
#ifndef TARTAN_DRIVER_HOUSE_SURVEY_PARTS_H
#define TARTAN_DRIVER_HOUSE_SURVEY_PARTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/house/survey.h"
#include "runtime/house/house.h"

/* Cells that no line of faces tells apart. met: a bit for each line's first cells, and one for its second ones. */
typedef struct tn_cell_class {
    uint32_t zone, storey;
    bool open;
    uint64_t *met;
} tn_cell_class;

typedef struct tn_survey {
    tn_opened *opened;
    tn_house house; /* of one tray, without cells: what decides on a cell needs no more */
    tn_tray tray;
    tn_schema *schema;
    tn_house_form form;
    bool *functions, *tiles; /* [function] a cell may have it; [tile] it fits somewhere */
    int64_t widest;          /* the longest that a face can be */
    bool bare;               /* a cell was found that no function may take: */
    tn_cell bare_cell;
    tn_tray bare_tray;
    size_t words; /* of a class's bits */
    tn_cell_class *classes;
    size_t class_count, class_room;
} tn_survey;

/* Does the form `allow` the warning? */
static inline bool tn_survey_allows(const tn_survey *survey, tn_code code, tn_span at)
{
    return tn_program_allows(survey->opened->compilation.program, code, at);
}

/* ---- survey_faces.c: lines of faces that never apply, or are hidden by those before them */
tn_status tn_survey_faces(tn_survey *survey, tn_error *error);

#endif
