/* Gathers between what numbers may lie. */
#include "compiler/common/number_ranges.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "runtime/base/buffer.h"

static void note(tn_number_ranges *ranges, tn_span span, const char *least, const char *most)
{
    tn_number_range *range = TN_NEW(ranges->arena, tn_number_range);
    if (!range)
        return;
    *range = (tn_number_range){.span = span, .least = least, .most = most};
    TN_CHAIN(ranges, range);
    ranges->count++;
}

static const char *written(tn_arena *arena, double number)
{
    char text[TN_NUMBER_TEXT_SIZE];
    if (!isfinite(number))
        return NULL;
    tn_number_text(number, text);
    return tn_arena_copy(arena, text, strlen(text));
}

void tn_range_note(tn_diagnostics *diagnostics, tn_span span, double least, double most)
{
    tn_number_ranges *ranges = diagnostics->ranges;
    if (ranges)
        note(ranges, span, written(ranges->arena, least), written(ranges->arena, most));
}

void tn_range_note_whole64(tn_diagnostics *diagnostics, tn_span span)
{
    char most[TN_NUMBER_TEXT_SIZE];
    tn_number_ranges *ranges = diagnostics->ranges;
    if (!ranges)
        return;
    snprintf(most, sizeof most, "%" PRIu64, UINT64_MAX);
    note(ranges, span, "0", tn_arena_copy(ranges->arena, most, strlen(most)));
}
