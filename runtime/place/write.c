/* Writes placed models as text. */
#include "runtime/place/write.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/int128.h"
#include "runtime/module/code.h"

/* The matrix of a turn, row by row: its columns are where right, down and back point. */
static void write_turn(uint32_t turn, FILE *out)
{
    static const tn_axis columns[3] = {TN_AXIS_RIGHT, TN_AXIS_DOWN, TN_AXIS_BACK};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            tn_axis to = tn_axis_turn(columns[column], turn);
            fputs(to == columns[row] ? "1 " : to == tn_axis_opposite(columns[row]) ? "-1 " : "0 ", out);
        }
}

/* A cell's sides in millionths of an LDU. */
static void unit_of(const tn_module *module, int64_t unit[3])
{
    static const int64_t program[3] = {10000000, 8000000, 10000000};
    const tn_kit_record *kit = module && module->KIT_count ? &module->KIT_records[0] : NULL;
    unit[0] = kit ? kit->unit_x : program[0];
    unit[1] = kit ? kit->unit_y : program[1];
    unit[2] = kit ? kit->unit_z : program[2];
}

enum { MILLION = 1000000 }; /* units of a module in an LDU */

/* Cells times a cell's side, as a decimal number without needless digits. */
static void write_ldu(int64_t cells, int64_t unit, FILE *out)
{
    tn_int128 length = (tn_int128)cells * unit;
    bool negative = length < 0;
    uint64_t whole = (uint64_t)((negative ? -length : length) / MILLION);
    uint32_t rest = (uint32_t)((negative ? -length : length) % MILLION);
    fprintf(out, "%s%" PRIu64, negative ? "-" : "", whole);
    if (rest == 0)
        return;
    char digits[8];
    snprintf(digits, sizeof digits, "%06" PRIu32, rest);
    for (size_t last = strlen(digits); last > 0 && digits[last - 1] == '0'; last--)
        digits[last - 1] = '\0';
    fprintf(out, ".%s", digits);
}

static void write_at(const tn_frame *frame, const int64_t unit[3], const char *between, FILE *out)
{
    for (int k = 0; k < 3; k++) {
        fputs(k ? between : "", out);
        write_ldu(frame->at[k], unit[k], out);
    }
}

void tn_place_write_at(const tn_module *module, const tn_frame *frame, const char *between, FILE *out)
{
    int64_t unit[3];
    unit_of(module, unit);
    write_at(frame, unit, between, out);
}

void tn_place_at(const tn_module *module, const tn_frame *frame, double at[3])
{
    int64_t unit[3];
    unit_of(module, unit);
    for (int k = 0; k < 3; k++)
        at[k] = (double)((tn_int128)frame->at[k] * unit[k]) / MILLION;
}

/* Every r is left out of the names of parts of connection grammars, as by the published program. */
static void write_part(const tn_placed_part *part, const int64_t unit[3], bool kit, FILE *out)
{
    const tn_frame *f = &part->frame;
    fprintf(out, "1 %d ", f->colour);
    write_at(f, unit, " ", out);
    putc(' ', out);
    write_turn(f->heading, out);
    for (const char *c = part->name; *c; c++)
        if (kit || *c != 'r')
            putc(*c, out);
    fputs(".dat\n", out);
}

const char *tn_place_model_name(const tn_place_rules *rules)
{
    const tn_module *module = rules->module;
    return tn_text(module, rules->space ? rules->space->name : module->GRAMMAR_records[0].name);
}

void tn_place_write_header(const tn_place_rules *rules, uint32_t seed, FILE *out)
{
    const tn_module *module = rules->module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    fprintf(out, "0 %s\n0 seed %" PRIu32 ", rules %016" PRIx64 ", %s\n", tn_place_model_name(rules), seed,
            producer ? (uint64_t)producer->sources_hash : 0, producer ? tn_text(module, producer->version) : "tartan");
}

void tn_place_write_ldraw(const tn_module *module, const tn_placed_model *model, const tn_placed_steps *steps,
                          FILE *out)
{
    int64_t unit[3];
    size_t step = 0;
    bool kit = module && module->KIT_count;
    unit_of(module, unit);
    for (size_t i = 0; i < model->count && !ferror(out); i++) {
        write_part(&model->parts[i], unit, kit, out);
        if (steps && steps->ends[step] != i + 1)
            continue;
        fputs("0 STEP\n", out);
        step++;
    }
}

void tn_place_write_mpd(const tn_module *module, const tn_placed_model *model, const tn_placed_steps *steps,
                        const char *name, FILE *out)
{
    int64_t unit[3];
    size_t part = 0;
    unit_of(module, unit);
    for (size_t i = 0; i < steps->count && !ferror(out); i++)
        fprintf(out, "1 16 0 0 0 1 0 0 0 1 0 0 0 1 %s-%zu.ldr\n0 STEP\n", name, i + 1);
    for (size_t i = 0; i < steps->count && !ferror(out); i++) {
        fprintf(out, "0 FILE %s-%zu.ldr\n0 %s, step %zu of %zu\n", name, i + 1, name, i + 1, steps->count);
        for (; part < steps->ends[i]; part++)
            write_part(&model->parts[part], unit, true, out);
    }
}

/* ---- lists of parts */

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

/* Of a kit a list has more columns. */
static void write_row(const tn_module *module, const tn_part_count *count, FILE *out)
{
    const tn_kit_part_record *part = NULL;
    for (uint32_t i = 0; module && i < module->KIT_PART_count && !part; i++)
        if (strcmp(tn_text(module, module->KIT_PART_records[i].name), count->name) == 0)
            part = &module->KIT_PART_records[i];
    write_field(count->name, out);
    if (module && module->KIT_count) {
        putc(',', out);
        write_field(part ? tn_text(module, part->title) : "", out);
    }
    fprintf(out, ",%d,%" PRIu64, count->colour, count->count);
    if (module && module->KIT_count)
        fprintf(out, ",%.10g,%.10g", part ? part->mass * (double)count->count : 0,
                part ? part->price * (double)count->count : 0);
    putc('\n', out);
}

tn_status tn_place_write_list(const tn_module *module, const tn_placed_model *model, FILE *out, tn_error *error)
{
    tn_part_count *counts;
    size_t kinds;
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    fputs(module && module->KIT_count ? "part,name,colour,number,mass,price\n" : "part,colour,number\n", out);
    for (size_t i = 0; i < kinds && !ferror(out); i++)
        write_row(module, &counts[i], out);
    free(counts);
    return TN_OK;
}

/* ---- programs */

const char *tn_step_text(const tn_place_rules *rules, const tn_step *step, size_t *length)
{
    const tn_source_map_record *place = tn_module_place(rules->module, step->offset);
    *length = 0;
    uint32_t quotes = !rules->module->KIT_count; /* about a terminal of a connection grammar */
    if (!place || place->end - place->begin < 2 * quotes)
        return "";
    *length = place->end - place->begin - 2 * quotes;
    return tn_text(rules->module, rules->module->SOURCE_records[place->file].text) + place->begin + quotes;
}

/* A box that connection grammars can fill hangs from its middle and is an even number of cells wide and deep. */
static void write_block(const tn_step *step, FILE *out)
{
    const int32_t *a = step->a, *b = step->b;
    int32_t x = (a[0] + b[0]) / 2, z = (a[2] + b[2]) / 2;
    fprintf(out, "( Move(%d,%d,%d) FillRect(%d,%d,%d) )", x, a[1], z, b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

void tn_step_write(const tn_step *step, FILE *out)
{
    switch (step->kind) {
    case TN_STEP_PUSH:
        putc('(', out);
        break;
    case TN_STEP_POP:
        putc(')', out);
        break;
    case TN_STEP_MOVE:
        fprintf(out, "Move(%d,%d,%d)", step->a[0], step->a[1], step->a[2]);
        break;
    case TN_STEP_TURN:
        fprintf(out, "Rotate(%d)", 90 * step->a[0]);
        break;
    case TN_STEP_COLOUR:
        fprintf(out, "SetColor(%d)", step->a[0]);
        break;
    case TN_STEP_PART:
        fprintf(out, "Place(%s)", step->text);
        break;
    case TN_STEP_BLOCK:
        write_block(step, out);
        break;
    default:
        break;
    }
}

void tn_place_write_program(const tn_placed_model *model, const tn_place_rules *rules, FILE *out)
{
    for (uint64_t i = 0; i < model->counts.steps && !ferror(out); i++) {
        const tn_step *step = &rules->steps[model->steps[i]];
        size_t length;
        if (i > 0)
            putc(' ', out);
        if (rules->space) {
            tn_step_write(step, out);
            continue;
        }
        const char *text = tn_step_text(rules, step, &length);
        fwrite(text, 1, length, out);
    }
    putc('\n', out);
}
