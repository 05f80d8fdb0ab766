/* What the files that explain houses share. Internal to cli/house. */
#ifndef TARTAN_CLI_HOUSE_EXPLAINED_PARTS_H
#define TARTAN_CLI_HOUSE_EXPLAINED_PARTS_H

#include "cli/house/judged.h"

/* What is explained: a library's clauses, or rules by themselves. */
typedef struct tn_house_explaining {
    tn_job *job;
    tn_house_judge judge;
    const tn_house_library_record *library; /* or NULL */
    const tn_option_list *rules;
    tn_house house;
    tn_buffer text;
    tn_json *json; /* into the text; NULL: as lines */
    bool full;
} tn_house_explaining;

/* ---- explained_why.c: each appends lines to e->text, or writes JSON into it */

/* What the questions of a clause or rule find: cells, rooms, faces, walks. */
tn_status tn_explain_why(tn_house_explaining *e, uint32_t function, tn_error *error);

/* The cells in which no tile stands, and what is in the way of each tile. */
tn_status tn_explain_tiles(tn_house_explaining *e, tn_error *error);

/* Moves on to the first cell from *cell on in which no tile stands; the number of cells where there is none. */
tn_status tn_explain_next_bare(const tn_house_explaining *e, uint32_t *cell, tn_error *error);

/* The openings that lower roofs keep out of faces. */
void tn_explain_behind_roofs(tn_house_explaining *e);

/* ---- explained_near.c: kept houses that differ from this one by as few choices as were found. */
tn_status tn_explain_nearest(tn_house_explaining *e, tn_error *error);

#endif
