/* A kit's rules as a search needs them: for each kind of open connector, what may be put there, worked out beforehand.
 *
 * A choice is one alternative in one position: parts relative to the connector, and the connectors at which rules go on
 * from there. Parts have their boxes for each heading. All is constant once made, so that threads share it; it borrows
 * from the rules and their module, which outlive it. */
#ifndef TARTAN_PLACE_SEARCH_CHOICES_H
#define TARTAN_PLACE_SEARCH_CHOICES_H

#include "runtime/place/grow.h"

/* A part of the kit. shape: [heading] the lowest heading in which the part looks the same, apart from its place. */
typedef struct tn_kind_of_part {
    const tn_kit_part_record *record;
    tn_cell_box *boxes[4]; /* [upright heading]: record->box_count boxes from the part's place */
    tn_cell_box all[4];    /* around them */
    uint32_t shape[TN_TURNS];
    uint32_t mirrored[2]; /* its image at x = 0 (at z = 0) if it is not turned; TN_TURNS: is no such part */
    uint64_t most;        /* that the stock has; UINT64_MAX: any number */
} tn_kind_of_part;

/* A part of a choice, or of what was put: colour and heading as in frames. */
typedef struct tn_chosen_part {
    uint32_t kind;
    tn_frame frame;
} tn_chosen_part;

/* An open connector: `symbol` says what may come there. */
typedef struct tn_open_site {
    uint32_t symbol;
    tn_frame frame;
} tn_open_site;

typedef struct tn_site_choice {
    uint32_t part_first, part_count; /* none: the connector stays open */
    uint32_t site_first, site_count;
    uint32_t body;   /* choices of one body are one alternative in several positions */
    uint32_t member; /* of a draw among those that fit, or 0 */
    double weight;
    tn_cell_box around[4]; /* [upright heading]: all of its cells, from the connector */
} tn_site_choice;

typedef struct tn_choice_symbol {
    uint32_t first, count;
    bool may_stay_open;    /* a rule says `{}` */
    tn_cell_box common[4]; /* cells that every choice needs: where one is filled, nothing fits; may be empty */
    tn_cell_box around[4]; /* cells that some choice needs */
} tn_choice_symbol;

#define TN_NONE_STANDS UINT32_MAX

typedef struct tn_site_choices {
    const tn_place_rules *rules;
    tn_kind_of_part *kinds;
    tn_cell_box *boxes; /* of the kinds */
    tn_choice_symbol *symbols;
    tn_site_choice *choices;
    tn_chosen_part *parts;
    tn_open_site *sites; /* of choices; then of the start */
    uint32_t kind_count, symbol_count;
    size_t choice_count, part_count, site_count, start_first;
    size_t part_capacity, site_capacity, choice_capacity;
    uint32_t standing; /* the choice of what stands from the start on, behind those of symbols; TN_NONE_STANDS: none */
    uint64_t *known;   /* what may stand at which connector: a hash table of keys */
    size_t known_size;
} tn_site_choices;

/* Works the choices out. TN_INVALID (E1334) if the rules are not those of a kit, or a part lies beside its mirror
 * image; TN_LIMIT (E1313) if there are more than 2^22. Clear it in any case. */
tn_status tn_site_choices_make(const tn_place_rules *rules, tn_site_choices *choices, tn_error *error);
void tn_site_choices_clear(tn_site_choices *choices);

/* A frame seen from another. */
tn_frame tn_frame_from(const tn_frame *base, const tn_frame *relative);

/* What a choice at a frame puts, seen from a place: the same number for equal bodies in equal positions, from
 * whichever connector and in whichever of headings that look the same. */
uint64_t tn_choice_key(const tn_site_choices *choices, const tn_site_choice *choice, const tn_frame *at,
                       const int32_t from[3]);

/* Is what the choice puts at a frame one of those things that may come to the site? */
bool tn_choice_may_stand(const tn_site_choices *choices, const tn_open_site *site, const tn_site_choice *choice,
                         const tn_frame *at);

/* A box of a part, and the box around all of them, in any heading. */
static inline tn_cell_box tn_kind_box(const tn_kind_of_part *kind, uint32_t heading, uint32_t box)
{
    return heading < TN_UPRIGHT_TURNS ? kind->boxes[heading][box] : tn_cell_box_turn(&kind->boxes[0][box], heading);
}

static inline tn_cell_box tn_kind_all(const tn_kind_of_part *kind, uint32_t heading)
{
    return tn_cell_box_of(kind->all, heading);
}

static inline tn_cell_box tn_box_from(const tn_cell_box *box, const int32_t at[3])
{
    tn_cell_box moved = *box;
    for (int k = 0; k < 3; k++) {
        moved.low[k] += at[k];
        moved.high[k] += at[k];
    }
    return moved;
}

/* The parts of a kit as a search needs them: their boxes for each heading, and in which headings and images they look
 * the same. */

/* Fills choices->kinds and choices->boxes from the records of the rules' module. TN_MEMORY or TN_OK. */
tn_status tn_kinds_make(tn_site_choices *choices, tn_error *error);

/* The part in an image at x = 0 (axis 0) or z = 0 (axis 1), whose mirrored[axis] is below 4. */
tn_frame tn_kind_mirror(const tn_kind_of_part *kind, const tn_frame *frame, int axis);

#endif
