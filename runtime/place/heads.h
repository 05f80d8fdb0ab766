/* Four heads that walk the same way, one for each upright turn: where steps lead from a frame that is not known yet. */
#ifndef TARTAN_PLACE_HEADS_H
#define TARTAN_PLACE_HEADS_H

#include "runtime/place/model/frame.h"

enum { TN_HEADS_FRAMES = 64 }; /* at once; and no colour of a part is TN_COLOUR_KEPT */
#define TN_COLOUR_KEPT INT32_MIN

typedef struct tn_heads {
    tn_frame frames[TN_HEADS_FRAMES][TN_UPRIGHT_TURNS]; /* [depth][turn at the start] */
    uint32_t depth;
} tn_heads;

/* Each head begins at the origin with its turn, and with the colour TN_COLOUR_KEPT. */
void tn_heads_begin(tn_heads *heads);

/* PUSH, POP, MOVE, TURN or COLOUR; other steps lead nowhere. False: the first frame was dropped, or there is no room
 * for another, or the heads went too far. */
bool tn_heads_step(tn_heads *heads, const tn_step *step);

/* The frames at hand, by the turn at the start. */
static inline const tn_frame *tn_heads_frames(const tn_heads *heads)
{
    return heads->frames[heads->depth];
}

#endif
