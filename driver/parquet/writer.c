/* Writes plans in Parquet: row group by row group, in each column by column. */
#include "driver/parquet/writer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"
#include "runtime/base/integers.h"

static void plain_write(tn_buffer *out, int64_t value, unsigned bytes);

/* ---- keeps columns of numbers with a dictionary */

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
static bool make_number_room(tn_numbers *numbers)
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
    if (!make_number_room(numbers))
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
        plain_write(&numbers->plain, numbers->dictionary[numbers->places[i]], numbers->bytes);
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
    plain_write(&numbers->plain, value, numbers->bytes);
    return !numbers->plain.failed;
}

/* Appends a number of 4 or 8 bytes, the lowest first. */
static void plain_write(tn_buffer *out, int64_t value, unsigned bytes)
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

/* Appends the dictionary. */
static void numbers_dictionary(const tn_numbers *numbers, tn_buffer *body)
{
    for (size_t i = 0; i < numbers->known; i++)
        plain_write(body, numbers->dictionary[i], numbers->bytes);
}

/* ---- puts the pages of a file of plans together */

/* Compresses what is in w->body as a page of that column. */
static tn_status end_body(tn_parquet_writing *w, unsigned column, enum tn_parquet_encoding encoding, size_t values,
                          tn_error *error)
{
    tn_chunk *chunk = &w->chunks[column];
    tn_page_kind kind = {TN_PAGE_DATA, encoding, values};
    bool done = tn_page_write(&w->packer, kind, &w->body, &chunk->pages, &chunk->loose);
    chunk->values += values;
    w->body.size = 0;
    return done ? TN_OK : tn_fail_memory(error);
}

/* ---- ranks, lengths, totals */

static enum tn_parquet_encoding write_ranks(tn_parquet_writing *w)
{
    if (w->rank_bytes == 0) {
        tn_delta_end(&w->ranks, &w->body);
        return TN_ENCODING_DELTA;
    }
    tn_buffer_append(&w->body, w->wide_ranks.data, w->wide_ranks.size);
    w->wide_ranks.size = 0;
    return TN_ENCODING_PLAIN;
}

static tn_status end_numbers(tn_parquet_writing *w, tn_error *error)
{
    tn_status status = end_body(w, 0, write_ranks(w), w->in_page, error);
    if (status == TN_OK)
        status = end_body(w, 1, tn_numbers_page(&w->length, &w->body), w->in_page, error);
    if (status == TN_OK && w->has_total)
        status = end_body(w, 2, tn_numbers_page(&w->total, &w->body), w->in_page, error);
    if (status != TN_OK || !w->has_rank_texts)
        return status;
    tn_buffer_append(&w->body, w->rank_texts.data, w->rank_texts.size);
    w->rank_texts.size = 0;
    return end_body(w, tn_rank_texts_column(w), TN_ENCODING_PLAIN, w->in_page, error);
}

/* ---- lists */

/* Levels stand behind their size. */
static void end_levels(tn_buffer *body, size_t begin)
{
    if (!body->failed)
        tn_put_u32((uint8_t *)body->data + begin, (uint32_t)(body->size - begin - 4));
}

/* The levels of a list, which are those of all lists: where a plan begins, and where it has no tray. */
static void write_levels(tn_parquet_writing *w)
{
    tn_buffer *body = &w->body;
    size_t begin = body->size;
    tn_buffer_append(body, "\0\0\0", 4);
    tn_bits_write(body, w->goes_on, w->places);
    end_levels(body, begin);
    begin = body->size;
    tn_buffer_append(body, "\0\0\0", 4);
    if (w->some_empty)
        tn_bits_write(body, w->holds, w->places);
    else
        tn_run_write(body, 1, 1, w->places);
    end_levels(body, begin);
}

/* The field's values of the page's trays. */
static void write_field(tn_parquet_writing *w, uint32_t field)
{
    const uint8_t *number = w->tray_numbers;
    uint32_t mask = UINT32_MAX >> (32 - 8 * w->tray_bytes);
    size_t begin = w->body.size;
    uint8_t *values = tn_bytes_begin(&w->body, w->trays);
    if (!values)
        return;
    for (size_t i = 0; i < w->trays; i++, number += w->tray_bytes) {
        values[i] = (uint8_t)tn_tray_value(w->schema, tn_get_u32(number) & mask, field);
        w->seen[field][values[i]] = 1;
    }
    tn_bytes_end(&w->body, begin, w->trays);
}

static tn_status end_lists(tn_parquet_writing *w, tn_error *error)
{
    static const char width[] = {8};
    tn_status status = TN_OK;
    for (uint32_t f = 0; status == TN_OK && f < w->schema->field_count; f++) {
        write_levels(w);
        tn_buffer_append(&w->body, width, 1);
        write_field(w, f);
        status = end_body(w, tn_first_field_column(w) + f, TN_ENCODING_RLE_DICTIONARY, w->places, error);
    }
    return status;
}

/* ---- */

static tn_status parquet_end_lines(tn_parquet_writing *w, tn_error *error)
{
    if (w->line_count == 0)
        return TN_OK;
    tn_buffer_append(&w->body, w->lines.data, w->lines.size);
    size_t count = w->line_count;
    w->lines.size = w->line_count = 0;
    return end_body(w, tn_lines_column(w), TN_ENCODING_PLAIN, count, error);
}

/* Compresses the page in hand, and begins another. */
static tn_status parquet_end_page(tn_parquet_writing *w, tn_error *error)
{
    if (w->in_page == 0)
        return TN_OK;
    tn_status status = end_numbers(w, error);
    if (status == TN_OK)
        status = end_lists(w, error);
    memset(w->goes_on, 0, w->places_room / 8);
    memset(w->holds, 0, w->places_room / 8);
    w->in_page = w->trays = w->places = 0;
    w->some_empty = false;
    return status;
}

static size_t write_values(tn_parquet_writing *w, uint32_t field)
{
    const tn_schema *schema = w->schema;
    uint32_t first = schema->value_start[field], count = schema->value_start[field + 1] - first;
    for (uint32_t v = first; v < first + count; v++) {
        const char *text = tn_text(schema->module, schema->values[v].spelling);
        size_t size = strlen(text);
        plain_write(&w->body, (int64_t)size, 4);
        tn_buffer_append(&w->body, text, size);
    }
    return count;
}

/* The dictionary page of a column, in w->body; false where it has none. *values: how many. */
static bool parquet_dictionary(tn_parquet_writing *w, unsigned column, size_t *values)
{
    unsigned first = tn_first_field_column(w);
    bool is_number = column > 0 && column < first,
         is_field = column >= first && column - first < w->schema->field_count;
    w->body.size = 0;
    if (is_field)
        *values = write_values(w, column - first);
    if (is_number) {
        const tn_numbers *numbers = column == 1 ? &w->length : &w->total;
        *values = numbers->known;
        numbers_dictionary(numbers, &w->body);
    }
    return is_number || is_field;
}

/* ---- writes plans in Parquet */

#define GROUP_DEFAULT 1000000u
#define DECIMAL_DIGITS 38u            /* of decimal numbers of most programs; ranks of more are written as texts, too */
#define PAGE_PLANS 32768u             /* plans of a page at most */
#define PAGE_TRAYS ((size_t)1 << 18)  /* trays, and a plan more */
#define LINES_BYTES ((size_t)1 << 20) /* plan lines of a page, and one more */

static tn_parquet_writing *writing_of(const tn_plan_writer *writer)
{
    return writer->parquet_state;
}

/* ---- opening */

/* Ranks that do not fit in 64 bits are decimal numbers of as many digits as the largest may have, in as many bytes as
 * these need with a sign. `ranks`: all are below. */
static void choose_rank(tn_parquet_writing *w, mpz_srcptr ranks)
{
    if (!ranks || mpz_sizeinbase(ranks, 2) < 64)
        return;
    mpz_t most;
    mpz_init(most);
    mpz_sub_ui(most, ranks, 1);
    w->rank_digits = (unsigned)tn_decimal_digits(most);
    w->has_rank_texts = w->rank_digits > DECIMAL_DIGITS;
    mpz_ui_pow_ui(most, 10, w->rank_digits);
    w->rank_bytes = (unsigned)(mpz_sizeinbase(most, 2) / 8 + 1);
    mpz_clear(most);
}

static tn_status write_out(tn_plan_writer *writer, const tn_buffer *bytes, tn_error *error)
{
    writing_of(writer)->offset += bytes->size;
    if (bytes->size == 0 || fwrite(bytes->data, 1, bytes->size, writer->output.stream) == bytes->size)
        return TN_OK;
    return tn_cannot_write(strcmp(writer->path, "-") == 0 ? "standard output" : writer->path, errno, error);
}

#define PAGE_BYTES (PAGE_TRAYS + PAGE_TRAYS / 4 + PAGE_PLANS) /* before compression, where plans are not long */

static tn_status open_columns(tn_parquet_writing *w, tn_error *error)
{
    tn_status status = tn_page_packer_new(&w->packer, error);
    if (status == TN_OK &&
        (!tn_buffer_reserve(&w->body, PAGE_BYTES) || !tn_buffer_reserve(&w->packer.packed, PAGE_BYTES)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_numbers_new(&w->length, 4, PAGE_PLANS, error);
    if (status == TN_OK && w->has_total)
        status = tn_numbers_new(&w->total, 8, PAGE_PLANS, error);
    return status;
}

tn_status tn_parquet_writer_open(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error)
{
    tn_parquet_writing *w = calloc(1, sizeof *w);
    if (!w)
        return tn_fail_memory(error);
    writer->parquet_state = w;
    w->schema = writer->schema;
    w->group_most = options->row_group > 0 ? options->row_group : GROUP_DEFAULT;
    w->has_lines = options->plan_lines;
    w->has_total = writer->length_field != UINT32_MAX;
    choose_rank(w, options->ranks);
    while (w->tray_bytes < 4 && w->schema->tray_count > UINT32_C(1) << 8 * w->tray_bytes)
        w->tray_bytes++;
    tn_status status = open_columns(w, error);
    if (status != TN_OK)
        return status;
    if (!tn_footer_metadata(w, writer, &options->metadata) || !tn_buffer_append(&w->body, TN_PARQUET_MAGIC, 4))
        return tn_fail_memory(error);
    status = write_out(writer, &w->body, error);
    w->body.size = 0;
    return status;
}

/* ---- row groups */

static tn_status write_column(tn_plan_writer *writer, unsigned column, tn_chunk_place *place, tn_error *error)
{
    tn_parquet_writing *w = writing_of(writer);
    tn_chunk *chunk = &w->chunks[column];
    tn_buffer page = {0};
    size_t values;
    tn_status status = TN_OK;
    *place = (tn_chunk_place){.dictionary = w->offset};
    if (parquet_dictionary(w, column, &values)) {
        tn_page_kind kind = {TN_PAGE_DICTIONARY, TN_ENCODING_PLAIN, values};
        bool packed = tn_page_write(&w->packer, kind, &w->body, &page, &place->loose);
        status = packed ? write_out(writer, &page, error) : tn_fail_memory(error);
    } else {
        place->dictionary = 0;
    }
    place->data = w->offset;
    place->loose += chunk->loose;
    if (status == TN_OK)
        status = write_out(writer, &chunk->pages, error);
    place->end = w->offset;
    w->body.size = 0;
    free(page.data);
    return status;
}

static void clear_group(tn_parquet_writing *w)
{
    for (unsigned c = 0; c < tn_column_count(w); c++) {
        w->chunks[c].pages.size = 0;
        w->chunks[c].values = w->chunks[c].loose = 0;
    }
    tn_numbers_clear(&w->length);
    if (w->has_total)
        tn_numbers_clear(&w->total);
    memset(w->seen, 0, sizeof w->seen);
    w->in_group = w->empty_in_group = 0;
    w->groups++;
}

static tn_status end_group(tn_plan_writer *writer, tn_error *error)
{
    tn_parquet_writing *w = writing_of(writer);
    tn_chunk_place places[TN_PARQUET_COLUMNS_MAX];
    if (w->in_group == 0)
        return TN_OK;
    tn_status status = parquet_end_page(w, error);
    if (status == TN_OK)
        status = parquet_end_lines(w, error);
    for (unsigned c = 0; status == TN_OK && c < tn_column_count(w); c++)
        status = write_column(writer, c, &places[c], error);
    if (status != TN_OK)
        return status;
    tn_footer_group(w, places);
    clear_group(w);
    return w->about_groups.failed ? tn_fail_memory(error) : TN_OK;
}

/* ---- plans */

/* The rank as the file has it, in w->this_rank; also in the page in hand. */
static bool encode_rank(tn_parquet_writing *w, const mpz_t rank)
{
    tn_buffer *out = &w->this_rank;
    out->size = 0;
    if (w->rank_bytes == 0) {
        int64_t number = (int64_t)mpz_get_ui(rank);
        plain_write(out, number, 8);
        return !out->failed && tn_delta_add(&w->ranks, number);
    }
    size_t used = (mpz_sizeinbase(rank, 2) + 7) / 8;
    if (!tn_buffer_reserve(out, w->rank_bytes))
        return false;
    memset(out->data, 0, w->rank_bytes);
    if (mpz_sgn(rank) > 0)
        mpz_export(out->data + w->rank_bytes - used, NULL, 1, 1, 1, 0, rank);
    out->size = w->rank_bytes;
    return tn_buffer_append(&w->wide_ranks, out->data, out->size);
}

/* Is the rank in hand below this one? */
static bool is_below(const tn_parquet_writing *w, const tn_buffer *other)
{
    const uint8_t *mine = (const uint8_t *)w->this_rank.data, *theirs = (const uint8_t *)other->data;
    return w->rank_bytes > 0 ? memcmp(mine, theirs, w->rank_bytes) < 0 : tn_get_i64(mine) < tn_get_i64(theirs);
}

static bool set_rank(tn_buffer *rank, const tn_buffer *to)
{
    rank->size = 0;
    return tn_buffer_append(rank, to->data, to->size);
}

/* Holds the rank against the least and the most of the row group. */
static bool compare_rank(tn_parquet_writing *w)
{
    bool first = w->in_group == 0, below = !first && is_below(w, &w->most_rank);
    bool done = below || set_rank(&w->most_rank, &w->this_rank);
    if (done && (first || (below && is_below(w, &w->least_rank))))
        done = set_rank(&w->least_rank, &w->this_rank);
    w->descends = (w->descends && !first) || below;
    return done;
}

static bool add_rank_text(tn_parquet_writing *w, const mpz_t rank)
{
    size_t begin = w->rank_texts.size;
    if (!tn_buffer_append(&w->rank_texts, "\0\0\0", 4))
        return false;
    tn_buffer_integer(&w->rank_texts, rank);
    if (!w->rank_texts.failed)
        tn_put_u32((uint8_t *)w->rank_texts.data + begin, (uint32_t)(w->rank_texts.size - begin - 4));
    return !w->rank_texts.failed;
}

static tn_status add_rank(tn_parquet_writing *w, const mpz_t rank, tn_error *error)
{
    if (w->rank_bytes > 0 ? mpz_sizeinbase(rank, 2) >= 8 * (size_t)w->rank_bytes : mpz_sizeinbase(rank, 2) > 63)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a rank is larger than the column of ranks was made for");
    bool done = encode_rank(w, rank) && compare_rank(w) && (!w->has_rank_texts || add_rank_text(w, rank));
    return done ? TN_OK : tn_fail_memory(error);
}

/* Room for so many trays more in the page. A number is written as four bytes, of which the next one takes some back. */
static bool make_room(tn_parquet_writing *w, size_t more)
{
    size_t first = (PAGE_TRAYS + 64) * w->tray_bytes, used = w->trays * w->tray_bytes;
    return tn_array_reserve_from(&w->tray_numbers, &w->tray_room, first, used, more * w->tray_bytes + 4, 1);
}

static bool make_places(tn_parquet_writing *w, size_t more)
{
    size_t room = w->places_room;
    if (w->places + more <= room)
        return true;
    room = tn_array_larger(room, w->places + more, PAGE_TRAYS + PAGE_PLANS);
    room = (room + 7) / 8 * 8;
    uint8_t **bits[] = {&w->goes_on, &w->holds};
    for (size_t i = 0; i < 2; i++) {
        if (!tn_array_resize(bits[i], room / 8, 1))
            return false;
        memset(*bits[i] + w->places_room / 8, 0, (room - w->places_room) / 8);
    }
    w->places_room = room;
    return true;
}

static void set_bit(uint8_t *bits, size_t i)
{
    bits[i / 8] |= (uint8_t)(1u << i % 8);
}

static void add_places(tn_parquet_writing *w, size_t length)
{
    w->some_empty = w->some_empty || length == 0;
    w->empty_in_group += length == 0;
    for (size_t k = 0; k < length; k++) {
        if (k > 0)
            set_bit(w->goes_on, w->places + k);
        set_bit(w->holds, w->places + k);
    }
    w->places += length > 0 ? length : 1;
}

static void add_trays(tn_parquet_writing *w, const tn_tray *trays, size_t length)
{
    uint8_t *out = w->tray_numbers + w->trays * w->tray_bytes;
    for (size_t k = 0; k < length; k++, out += w->tray_bytes)
        tn_put_u32(out, trays[k]);
    w->trays += length;
}

static tn_status add_line(tn_plan_writer *writer, const tn_tray *trays, size_t length, tn_error *error)
{
    tn_parquet_writing *w = writing_of(writer);
    size_t begin = w->lines.size;
    if (!tn_buffer_append(&w->lines, "\0\0\0", 4) || !tn_writer_line(writer, trays, length, &w->lines))
        return tn_fail_memory(error);
    tn_put_u32((uint8_t *)w->lines.data + begin, (uint32_t)(w->lines.size - begin - 4));
    w->line_count++;
    return w->lines.size >= LINES_BYTES ? parquet_end_lines(w, error) : TN_OK;
}

tn_status tn_parquet_writer_write(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                                  tn_error *error)
{
    tn_parquet_writing *w = writing_of(writer);
    tn_status status = add_rank(w, rank, error);
    if (status == TN_OK && (!make_room(w, length) || !make_places(w, length + 1)))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    if (!tn_numbers_add(&w->length, (int64_t)length) ||
        (w->has_total && !tn_numbers_add(&w->total, tn_writer_total(writer, trays, length))))
        return tn_fail_memory(error);
    add_places(w, length);
    add_trays(w, trays, length);
    w->in_page++;
    w->in_group++;
    w->plans++;
    if (w->has_lines)
        status = add_line(writer, trays, length, error);
    if (status == TN_OK && (w->in_page == PAGE_PLANS || w->trays >= PAGE_TRAYS))
        status = parquet_end_page(w, error);
    return status == TN_OK && w->in_group == w->group_most ? end_group(writer, error) : status;
}

/* ---- the end */

tn_status tn_parquet_writer_close(tn_plan_writer *writer, tn_error *error)
{
    tn_parquet_writing *w = writing_of(writer);
    tn_status status = end_group(writer, error);
    if (status != TN_OK)
        return status;
    tn_footer_write(w, &w->body);
    return w->body.failed ? tn_fail_memory(error) : write_out(writer, &w->body, error);
}

void tn_parquet_writer_free(tn_plan_writer *writer)
{
    tn_parquet_writing *w = writing_of(writer);
    if (!w)
        return;
    tn_buffer *buffers[] = {&w->about_groups, &w->created_by, &w->metadata,  &w->wide_ranks, &w->rank_texts,
                            &w->lines,        &w->least_rank, &w->most_rank, &w->this_rank,  &w->body};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        free(buffers[i]->data);
    for (unsigned c = 0; c < TN_PARQUET_COLUMNS_MAX; c++)
        free(w->chunks[c].pages.data);
    tn_numbers_free(&w->length);
    tn_numbers_free(&w->total);
    tn_page_packer_free(&w->packer);
    free(w->tray_numbers);
    free(w->goes_on);
    free(w->holds);
    free(w->ranks.blocks.data);
    free(w);
    writer->parquet_state = NULL;
}
