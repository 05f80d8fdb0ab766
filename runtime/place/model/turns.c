/* Turns by where they take the axes: a turn is known by where it takes up and right. */
#include "runtime/place/model/turns.h"

enum { U = TN_AXIS_UP, D = TN_AXIS_DOWN, L = TN_AXIS_LEFT, R = TN_AXIS_RIGHT, F = TN_AXIS_FRONT, B = TN_AXIS_BACK };

/* [turn][axis]: where up, down, left, right, front and back point. */
static const uint8_t images[TN_TURNS][TN_AXIS_COUNT] = {
    {U, D, L, R, F, B}, {U, D, F, B, R, L}, {U, D, R, L, B, F}, {U, D, B, F, L, R}, {D, U, L, R, B, F},
    {D, U, B, F, R, L}, {D, U, R, L, F, B}, {D, U, F, B, L, R}, {L, R, D, U, F, B}, {L, R, F, B, U, D},
    {L, R, U, D, B, F}, {L, R, B, F, D, U}, {R, L, D, U, B, F}, {R, L, B, F, U, D}, {R, L, U, D, F, B},
    {R, L, F, B, D, U}, {F, B, D, U, R, L}, {F, B, R, L, U, D}, {F, B, U, D, L, R}, {F, B, L, R, D, U},
    {B, F, D, U, L, R}, {B, F, L, R, U, D}, {B, F, U, D, R, L}, {B, F, R, L, D, U},
};

/* [where up points][where right points] */
static const uint8_t turns[TN_AXIS_COUNT][TN_AXIS_COUNT] = {
    {0, 0, 2, 0, 3, 1},     {0, 0, 6, 4, 5, 7},     {8, 10, 0, 0, 11, 9},
    {12, 14, 0, 0, 13, 15}, {16, 18, 17, 19, 0, 0}, {20, 22, 23, 21, 0, 0},
};

tn_axis tn_axis_turn(tn_axis axis, uint32_t turn)
{
    return images[turn][axis];
}

uint32_t tn_turn_after(uint32_t outer, uint32_t inner)
{
    if ((outer | inner) < TN_UPRIGHT_TURNS)
        return (outer + inner) % TN_UPRIGHT_TURNS;
    return turns[images[outer][images[inner][U]]][images[outer][images[inner][R]]];
}

uint32_t tn_turn_back(uint32_t turn)
{
    uint32_t back = 0;
    while (tn_turn_after(turn, back) != 0)
        back++;
    return back;
}

/* Turns about the vertical, which are nearly all. */
static void turn_upright(uint32_t turn, const int32_t from[3], int32_t to[3])
{
    int32_t x = from[0], z = from[2];
    to[0] = turn == 0 ? x : turn == 1 ? -z : turn == 2 ? -x : z;
    to[1] = from[1];
    to[2] = turn == 0 ? z : turn == 1 ? x : turn == 2 ? -z : -x;
}

void tn_turn_place(uint32_t turn, const int32_t from[3], int32_t to[3])
{
    if (turn < TN_UPRIGHT_TURNS) {
        turn_upright(turn, from, to);
        return;
    }
    static const uint8_t forward[3] = {R, D, B}, coordinate[TN_AXIS_COUNT] = {1, 1, 0, 0, 2, 2};
    int32_t turned[3] = {0};
    for (int k = 0; k < 3; k++) {
        uint8_t axis = images[turn][forward[k]], to_axis = coordinate[axis];
        turned[to_axis] = axis == forward[to_axis] ? from[k] : -from[k];
    }
    for (int k = 0; k < 3; k++)
        to[k] = turned[k];
}
