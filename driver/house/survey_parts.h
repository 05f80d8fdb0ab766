/* What the files of a survey share. Internal to driver/house. */
#ifndef TARTAN_DRIVER_HOUSE_SURVEY_PARTS_H
#define TARTAN_DRIVER_HOUSE_SURVEY_PARTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/house/survey.h"

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

/* ---- survey.c */

/* The first part: the form made ready, its sections counted. */
tn_status tn_survey_begin(const tn_module *module, uint32_t form, tn_opened *opened, tn_survey **survey,
                          tn_error *error);

/* The second: its trays. Warns about lines of faces where warnings are wanted. */
tn_status tn_survey_trays(tn_survey *survey, tn_error *error);

/* ---- survey_sections.c: values that no section has, and materials that none uses */
tn_status tn_survey_sections(tn_survey *survey, tn_error *error);

/* How many storeys a zone (a field) has in some section, or in every one. */
uint32_t tn_survey_storeys(const tn_survey *survey, uint32_t zone, bool most);

/* ---- survey_tiles.c */

/* Does a tile fit into some cell, whatever is round it? If not, further: what is in its way where it comes furthest, if
 * any cell is for it (TN_TILE_STANDS: none is). */
tn_status tn_survey_tile_anywhere(const tn_survey *survey, uint32_t tile, bool *fits, tn_tile_failure *further,
                                  tn_error *error);

/* ---- survey_fits.c */

/* Is the face large enough for the kind, as far as the largest cells of both classes say? */
bool tn_survey_may_fit(const tn_survey *survey, const tn_survey_meeting *meeting, uint32_t kind);

/* The kind does not fit: keeps the meeting where it comes nearer to it than in *nearest, if there is one yet. */
void tn_survey_note_misfit(const tn_survey *survey, const tn_survey_meeting *meeting, uint32_t kind,
                           tn_survey_meeting *nearest);

/* Adds a note: how large the kind is, and how large the faces are. None where there is no such meeting. */
void tn_survey_say_misfit(const tn_survey *survey, tn_diagnostic *diagnostic, const tn_survey_meeting *nearest,
                          uint32_t kind);

/* ---- survey_stairs.c */

/* Warns of stairs without a shape, once, with a flight that has room instead. */
void tn_survey_stairs(const tn_survey *survey);

/* ---- survey_reach.c */

/* How wide the way is that the kind leaves in the face of a meeting, for people; 0: none. */
int64_t tn_survey_passes(const tn_survey *survey, const tn_survey_meeting *meeting, uint32_t kind);

/* Notes that a face of the meeting may have such a kind, and how wide the widest is. TN_MEMORY. */
tn_status tn_survey_link(tn_survey *survey, const tn_survey_meeting *meeting, int64_t wide, tn_error *error);

/* Warns of functions and storeys that nobody comes to. */
tn_status tn_survey_reach(const tn_survey *survey, tn_error *error);

/* ---- survey_walks.c */

/* Does a measure or a comparison ask for walks or ways out in houses of the form (a FORM record), or the opened file
 * itself for what is `apart`? TN_MEMORY. */
tn_status tn_survey_asks_walks(const tn_opened *opened, uint32_t form, bool *asked, tn_error *error);

/* Finds the ends of those that the opened file itself asks for; before its trays. TN_MEMORY. */
tn_status tn_survey_ends(tn_survey *survey, const tn_opened *opened, tn_error *error);

/* Notes at which of them the cell is. */
void tn_survey_see_ends(tn_survey *survey, const tn_cell *cell);

/* Warns of those at which no cell is. TN_MEMORY. */
tn_status tn_survey_warn_walks(const tn_survey *survey, tn_opened *opened, tn_error *error);

/* ---- survey_faces.c: lines of faces that never apply, or are hidden by those before them; notes which kinds are used
 */
tn_status tn_survey_faces(tn_survey *survey, tn_error *error);

#endif
