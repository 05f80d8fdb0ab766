/* Heads that walk alike. */
#include "runtime/place/heads.h"

#include <string.h>

void tn_heads_begin(tn_heads *heads)
{
    heads->depth = 0;
    for (uint32_t h = 0; h < TN_UPRIGHT_TURNS; h++)
        heads->frames[0][h] = (tn_frame){.heading = h, .colour = TN_COLOUR_KEPT};
}

bool tn_heads_step(tn_heads *heads, const tn_step *step)
{
    tn_frame *frames = heads->frames[heads->depth];
    bool near = true;
    switch (step->kind) {
    case TN_STEP_PUSH:
        if (heads->depth + 1 == TN_HEADS_FRAMES)
            return false;
        memcpy(heads->frames[++heads->depth], frames, sizeof heads->frames[0]);
        return true;
    case TN_STEP_POP:
        return heads->depth-- > 0;
    default:
        for (uint32_t h = 0; h < TN_UPRIGHT_TURNS; h++)
            near &= tn_frame_step(&frames[h], step);
        return near;
    }
}
