/* The head that walks while a model is placed: a frame, what a step does to it, and the cells that a step is about. */
#ifndef TARTAN_PLACE_MODEL_FRAME_H
#define TARTAN_PLACE_MODEL_FRAME_H

#include "runtime/place/model/rules.h"
#include "runtime/place/model/turns.h"

/* A box of cells: low[k] <= coordinate < high[k]. Empty where a low is not below its high. */
typedef struct tn_cell_box {
    int32_t low[3], high[3];
} tn_cell_box;

static inline bool tn_cell_box_holds(const tn_cell_box *box, const int32_t cell[3])
{
    for (int k = 0; k < 3; k++)
        if (cell[k] < box->low[k] || cell[k] >= box->high[k])
            return false;
    return true;
}

/* Makes `all` hold the box too. */
static inline void tn_cell_box_widen(tn_cell_box *all, const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++) {
        all->low[k] = box->low[k] < all->low[k] ? box->low[k] : all->low[k];
        all->high[k] = box->high[k] > all->high[k] ? box->high[k] : all->high[k];
    }
}

typedef struct tn_frame {
    int32_t at[3];
    uint32_t heading; /* a turn (turns.h); in connection grammars, and where parts stay upright, 0 to 3 */
    int32_t colour;
} tn_frame;

/* A box about the origin, turned; how it lies for each of the upright turns is mostly worked out beforehand. */
tn_cell_box tn_cell_box_turn(const tn_cell_box *box, uint32_t turn);
static inline tn_cell_box tn_cell_box_of(const tn_cell_box upright[TN_UPRIGHT_TURNS], uint32_t turn)
{
    return turn < TN_UPRIGHT_TURNS ? upright[turn] : tn_cell_box_turn(&upright[0], turn);
}

/* A box that was worked out for each upright turn, at a frame. */
static inline tn_cell_box tn_cell_box_at(const tn_cell_box box[TN_UPRIGHT_TURNS], const tn_frame *frame)
{
    tn_cell_box moved = tn_cell_box_of(box, frame->heading);
    for (int k = 0; k < 3; k++) {
        moved.low[k] += frame->at[k];
        moved.high[k] += frame->at[k];
    }
    return moved;
}

/* Moves, turns or colours the frame. False where it would go farther than TN_PLACE_FAR. */
bool tn_frame_step(tn_frame *frame, const tn_step *step);

/* The cells of FILL, FILL_OVER, BLOCK and TOUCH at a frame. */
tn_cell_box tn_frame_box(const tn_frame *frame, const tn_step *step);

#endif
