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
    int64_t wide, deep; /* the most that one of them has */
    uint64_t *met;
} tn_cell_class;

typedef struct tn_survey {
    tn_opened *opened;
    tn_house house; /* of one tray, without cells: what decides on a cell needs no more */
    tn_tray tray;
    tn_schema *schema;
    tn_house_form form;
    bool *functions, *tiles;   /* [function] a cell may have it; [tile] it fits somewhere */
    tn_tile_failure *failures; /* [tile] where it came furthest so far */
    bool *climbs;              /* [opening] a flight for which a cell has room */
    bool *used;                /* [kind of face] a face may have it, as far as is known */
    int64_t widest;            /* the longest that a face can be */
    bool bare;                 /* a cell was found that no function may take: */
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

static inline tn_diagnostics *tn_survey_list(const tn_survey *survey)
{
    return &survey->opened->compilation.diagnostics;
}

#define TN_SURVEY_SPAN(RECORD) ((tn_span){(RECORD)->file, (RECORD)->begin, (RECORD)->end})

#define TN_FLIGHT_NEEDS                                                                                                \
    "a flight needs cells whose functions have no tiles, with room between the walls for the steps and a place at "    \
    "both "                                                                                                            \
    "ends"

/* Has a line of faces this kind? */
bool tn_survey_names(const tn_survey *survey, uint32_t kind);

/* ---- survey_sections.c: values that no section has, and materials that none uses */
tn_status tn_survey_sections(tn_survey *survey, tn_error *error);

/* ---- survey_faces.c: lines of faces that never apply, or are hidden by those before them; notes which kinds are used
 */
tn_status tn_survey_faces(tn_survey *survey, tn_error *error);

#endif
