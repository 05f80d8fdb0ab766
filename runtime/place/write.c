/* Writes placed models as text. */
#include "runtime/place/write.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"

enum { UNIT = 10, PLATE = 8 }; /* LDU of a cell, across and down */

static const char *const rotations[] = {"1 0 0 0 1 0 0 0 1", "0 0 -1 0 1 0 1 0 0", "-1 0 0 0 1 0 0 0 -1",
                                        "0 0 1 0 1 0 -1 0 0"};

void tn_place_write_ldraw(const tn_placed_model *model, FILE *out)
{
    for (size_t i = 0; i < model->count && !ferror(out); i++) {
        const tn_placed_part *part = &model->parts[i];
        const tn_frame *f = &part->frame;
        fprintf(out, "1 %d %" PRId64 " %" PRId64 " %" PRId64 " %s ", f->colour, (int64_t)f->at[0] * UNIT,
                (int64_t)f->at[1] * PLATE, (int64_t)f->at[2] * UNIT, rotations[f->heading]);
        for (const char *c = part->name; *c; c++)
            if (*c != 'r')
                putc(*c, out);
        fputs(".dat\n0 STEP\n", out);
    }
}

/* ---- lists of parts */

typedef struct part_table {
    tn_part_count *counts;
    size_t *slots; /* one more than an index of the counts; 0: free */
    size_t kinds, slot_count;
} part_table;

/* Texts of one name are one text of the module. */
static size_t *slot_of(const part_table *table, const char *name, int32_t colour)
{
    size_t slot = (size_t)tn_mix64((uint64_t)(uintptr_t)name ^ tn_mix64((uint32_t)colour)) & (table->slot_count - 1);
    for (; table->slots[slot]; slot = (slot + 1) & (table->slot_count - 1)) {
        const tn_part_count *found = &table->counts[table->slots[slot] - 1];
        if (found->colour == colour && strcmp(found->name, name) == 0)
            break;
    }
    return &table->slots[slot];
}

tn_status tn_place_count_parts(const tn_placed_model *model, tn_part_count **counts, size_t *kinds, tn_error *error)
{
    part_table table = {.slot_count = 16};
    while (table.slot_count < 2 * model->count)
        table.slot_count *= 2;
    table.counts = calloc(model->count + 1, sizeof *table.counts);
    table.slots = calloc(table.slot_count, sizeof *table.slots);
    *counts = table.counts;
    if (!table.counts || !table.slots) {
        free(table.counts);
        free(table.slots);
        *counts = NULL;
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < model->count; i++) {
        const tn_placed_part *part = &model->parts[i];
        size_t *slot = slot_of(&table, part->name, part->frame.colour);
        if (!*slot) {
            table.counts[table.kinds++] = (tn_part_count){part->name, part->frame.colour, 0};
            *slot = table.kinds;
        }
        table.counts[*slot - 1].count++;
    }
    *kinds = table.kinds;
    free(table.slots);
    return TN_OK;
}

/* A field of a CSV file: in quotes where it has to be. */
static void write_field(const char *text, FILE *out)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, out);
        return;
    }
    putc('"', out);
    for (; *text; text++) {
        if (*text == '"')
            putc('"', out);
        putc(*text, out);
    }
    putc('"', out);
}

tn_status tn_place_write_list(const tn_placed_model *model, FILE *out, tn_error *error)
{
    tn_part_count *counts;
    size_t kinds;
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    fputs("part,colour,number\n", out);
    for (size_t i = 0; i < kinds && !ferror(out); i++) {
        write_field(counts[i].name, out);
        fprintf(out, ",%d,%" PRIu64 "\n", counts[i].colour, counts[i].count);
    }
    free(counts);
    return TN_OK;
}

/* ---- programs */

const char *tn_step_text(const tn_place_rules *rules, const tn_step *step, size_t *length)
{
    const tn_source_map_record *place = tn_module_place(rules->module, step->offset);
    *length = 0;
    if (!place || place->end - place->begin < 2)
        return "";
    *length = place->end - place->begin - 2; /* without its quotes */
    return tn_text(rules->module, rules->module->SOURCE_records[place->file].text) + place->begin + 1;
}

void tn_place_write_program(const tn_placed_model *model, const tn_place_rules *rules, FILE *out)
{
    for (uint64_t i = 0; i < model->counts.steps && !ferror(out); i++) {
        size_t length;
        const char *text = tn_step_text(rules, &rules->steps[model->steps[i]], &length);
        if (i > 0)
            putc(' ', out);
        fwrite(text, 1, length, out);
    }
    putc('\n', out);
}
