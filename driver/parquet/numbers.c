/* Keeps columns of numbers with a dictionary. */
#include "driver/parquet/numbers.h"

#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

#define DICTIONARY_MOST 65536u
#define SLOTS_FIRST 256u /* a power of two, as all larger ones */

tn_status tn_numbers_new(tn_numbers *numbers, unsigned bytes, size_t page, tn_error *error)
{
    *numbers = (tn_numbers){.bytes = bytes,
                            .places = calloc(page, sizeof *numbers->places),
                            .slots = calloc(SLOTS_FIRST, sizeof *numbers->slots),
                            .slot_count = SLOTS_FIRST};
    bool made = numbers->places && numbers->slots;
    if (made)
        tn_numbers_clear(numbers);
    return made ? TN_OK : tn_fail_memory(error);
}

void tn_numbers_free(tn_numbers *numbers)
{
    free(numbers->places);
    free(numbers->plain.data);
    free(numbers->dictionary);
    free(numbers->slots);
}

void tn_numbers_clear(tn_numbers *numbers)
{
    memset(numbers->slots, 0, numbers->slot_count * sizeof *numbers->slots);
    numbers->known = 0;
    numbers->full = numbers->mixed = false;
    numbers->least = INT64_MAX;
    numbers->most = INT64_MIN;
}

/* ---- the dictionary */

/* The slot that has the number, or the empty one where it belongs. */
static uint32_t *find_slot(const tn_numbers *numbers, int64_t value)
{
    size_t last = numbers->slot_count - 1;
    size_t slot = (size_t)((uint64_t)value * UINT64_C(0x9E3779B97F4A7C15) >> 32) & last;
    while (numbers->slots[slot] && numbers->dictionary[numbers->slots[slot] - 1] != value)
        slot = (slot + 1) & last;
    return &numbers->slots[slot];
}

/* Room for one number more; half of the slots stay empty. */
static bool make_room(tn_numbers *numbers)
{
    if (!tn_array_reserve(&numbers->dictionary, &numbers->known_room, numbers->known, 1, sizeof *numbers->dictionary))
        return false;
    if (2 * numbers->known < numbers->slot_count)
        return true;
    uint32_t *slots = calloc(2 * numbers->slot_count, sizeof *slots);
    if (!slots)
        return false;
    free(numbers->slots);
    numbers->slots = slots;
    numbers->slot_count *= 2;
    for (size_t i = 0; i < numbers->known; i++)
        *find_slot(numbers, numbers->dictionary[i]) = (uint32_t)i + 1;
    return true;
}

/* Puts the number into the dictionary, where it is new and there is a place left. */
static bool add_to_dictionary(tn_numbers *numbers, int64_t value, uint32_t **slot)
{
    *slot = find_slot(numbers, value);
    if (**slot || numbers->known == DICTIONARY_MOST)
        return true;
    if (!make_room(numbers))
        return false;
    *slot = find_slot(numbers, value);
    numbers->dictionary[numbers->known] = value;
    **slot = (uint32_t)++numbers->known;
    return true;
}

/* From now on numbers are written as they are, those of this page too. */
static void leave_dictionary(tn_numbers *numbers, size_t before)
{
    numbers->full = true;
    for (size_t i = 0; i < before; i++)
        tn_plain_write(&numbers->plain, numbers->dictionary[numbers->places[i]], numbers->bytes);
}

bool tn_numbers_add(tn_numbers *numbers, int64_t value)
{
    size_t i = numbers->count++;
    uint32_t *slot = NULL;
    numbers->least = value < numbers->least ? value : numbers->least;
    numbers->most = value > numbers->most ? value : numbers->most;
    if (!numbers->full && !add_to_dictionary(numbers, value, &slot))
        return false;
    if (slot && *slot) {
        numbers->places[i] = (uint16_t)(*slot - 1);
        return true;
    }
    if (!numbers->full)
        leave_dictionary(numbers, i);
    tn_plain_write(&numbers->plain, value, numbers->bytes);
    return !numbers->plain.failed;
}

void tn_plain_write(tn_buffer *out, int64_t value, unsigned bytes)
{
    uint8_t written[8];
    tn_put_u64(written, (uint64_t)value);
    tn_buffer_append(out, (const char *)written, bytes);
}

enum tn_parquet_encoding tn_numbers_page(tn_numbers *numbers, tn_buffer *body)
{
    static const char width[] = {16};
    if (numbers->full) {
        tn_buffer_append(body, numbers->plain.data, numbers->plain.size);
        numbers->plain.size = 0;
    } else {
        tn_buffer_append(body, width, 1);
        tn_shorts_write(body, numbers->places, numbers->count);
    }
    numbers->mixed = numbers->mixed || numbers->full;
    numbers->count = 0;
    return numbers->full ? TN_ENCODING_PLAIN : TN_ENCODING_RLE_DICTIONARY;
}

void tn_numbers_dictionary(const tn_numbers *numbers, tn_buffer *body)
{
    for (size_t i = 0; i < numbers->known; i++)
        tn_plain_write(body, numbers->dictionary[i], numbers->bytes);
}
