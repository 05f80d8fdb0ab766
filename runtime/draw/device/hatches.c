/* Patterns of hatches. */
#include "runtime/draw/device/hatches.h"

static const tn_hatch_lines diagonal[] = {{.angle = 45, .apart = 1.6}},
                            masonry[] = {{.angle = 45, .apart = 4}, {.angle = 45, .x = 2, .apart = 4}},
                            concrete[] = {{.angle = 45, .apart = 4},
                                          {.angle = 45, .x = 2.828, .apart = 4, .dashes = {2.4, 1.6}}},
                            timber[] = {{.angle = -45, .apart = 1.2}},
                            insulation[] = {{.angle = 60, .apart = 2.4}, {.angle = -60, .apart = 2.4}},
                            earth[] =
                                {
                                    {.y = 0, .shift = 6, .apart = 6, .dashes = {6, 6}},
                                    {.y = -2, .shift = 6, .apart = 6, .dashes = {6, 6}},
                                    {.y = -4, .shift = 6, .apart = 6, .dashes = {6, 6}},
                                    {.angle = 90, .x = 7, .y = 1, .shift = 6, .apart = 6, .dashes = {6, 6}},
                                    {.angle = 90, .x = 9, .y = 1, .shift = 6, .apart = 6, .dashes = {6, 6}},
                                    {.angle = 90, .x = 11, .y = 1, .shift = 6, .apart = 6, .dashes = {6, 6}},
},
                            tiles[] = {{.apart = 4}, {.angle = 90, .apart = 4}},
                            falling[] = {{.angle = -45, .apart = 1.6}},
                            crossed[] = {{.angle = 45, .apart = 1.6}, {.angle = -45, .apart = 1.6}},
                            level[] = {{.apart = 1.6}}, upright[] = {{.angle = 90, .apart = 1.6}},
                            dotted[] = {{.shift = 0.8, .apart = 1.6, .dashes = {0.2, 1.4}}};

#define PATTERN(name, lines)                                                                                           \
    {                                                                                                                  \
        name, lines, sizeof lines / sizeof *lines                                                                      \
    }

static const struct {
    const char *name;
    const tn_hatch_lines *lines;
    size_t count;
} patterns[TN_HATCH_COUNT] = {
    [TN_HATCH_DIAGONAL] = PATTERN("ANSI31", diagonal),
    [TN_HATCH_MASONRY] = PATTERN("MASONRY", masonry),
    [TN_HATCH_CONCRETE] = PATTERN("CONCRETE", concrete),
    [TN_HATCH_TIMBER] = PATTERN("TIMBER", timber),
    [TN_HATCH_INSULATION] = PATTERN("INSULATION", insulation),
    [TN_HATCH_EARTH] = PATTERN("EARTH", earth),
    [TN_HATCH_TILES] = PATTERN("TILES", tiles),
    [TN_HATCH_FALLING] = PATTERN("FALLING", falling),
    [TN_HATCH_CROSSED] = PATTERN("ANSI37", crossed),
    [TN_HATCH_LEVEL] = PATTERN("LINE", level),
    [TN_HATCH_UPRIGHT] = PATTERN("UPRIGHT", upright),
    [TN_HATCH_DOTTED] = PATTERN("DOTTED", dotted),
};

const tn_hatch_lines *tn_hatch_made_of(tn_hatch hatch, size_t *count)
{
    *count = patterns[hatch].count;
    return patterns[hatch].lines;
}

const char *tn_hatch_name(tn_hatch hatch)
{
    return patterns[hatch].name;
}
