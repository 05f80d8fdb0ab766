/* What the files that write about forms share. Internal to places*.c. */
#ifndef TARTAN_LSP_PLACES_PARTS_H
#define TARTAN_LSP_PLACES_PARTS_H

#include <stdio.h>

#include "driver/house/survey.h"
#include "runtime/base/length.h"

/* A form that was gone through, and where the words go. */
typedef struct tn_place_words {
    const tn_survey *survey;
    const tn_module *module;
    tn_length_style style;
    bool tries; /* there are few enough tiles and sizes of cells to try each tile in each */
    FILE *out;
} tn_place_words;

enum { TN_NAMES_SHOWN = 10, TN_SIZES_SHOWN = 6, TN_TRIES_MAX = 50000 };

/* "machine, ground" */
void tn_words_stack(const tn_place_words *w, uint32_t zone, uint32_t storey);
void tn_words_length(const tn_place_words *w, int64_t nanometres);
void tn_words_count(const tn_place_words *w, uint64_t number); /* "23,500" */

/* "`entry`, `bath` and 3 more"; "no function" where the set is empty. */
void tn_words_functions(const tn_place_words *w, const uint64_t *set);

/* Storeys of a set of bits: "`ground`, `upper`". */
void tn_words_storeys(const tn_place_words *w, uint64_t storeys);

/* Sizes of cells, each once: "8' by 4', 12' by 8' and 3 more". */
typedef struct tn_words_sizes {
    int64_t seen[64][2];
    size_t count;
} tn_words_sizes;
void tn_words_size(const tn_place_words *w, tn_words_sizes *sizes, const tn_survey_place *place);
void tn_words_more(const tn_place_words *w, const tn_words_sizes *sizes);

/* The first place of a zone (by its number among the form's) and storey; TN_NO_PLACE: there is none. */
static inline size_t tn_words_first(const tn_place_words *w, uint32_t zone, uint32_t storey)
{
    const tn_survey *s = w->survey;
    return s->first_places[(size_t)s->form.zones[zone] * s->form.record->storey_count + storey];
}

/* ---- places_tiles.c: tiles, openings and flights, counted within the form */
tn_status tn_words_tile(const tn_place_words *w, uint32_t tile, tn_error *error);
void tn_words_opening(const tn_place_words *w, uint32_t opening);

#endif
