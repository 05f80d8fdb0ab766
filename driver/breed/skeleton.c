/* Reads what designs of boxes are bred around, from a design's file and from the text that a run keeps of it. */
#include "driver/breed/skeleton.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/box_text.h"
#include "driver/breed/inputs.h"
#include "driver/solid/solid.h"
#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"
#include "runtime/math/elementary.h"

#define DEGREES 57.29577951308232

/* ---- from the design to text */

typedef struct writing {
    const tn_module *module;
    const tn_solid_record *record;
    FILE *out;
} writing;

/* The words of a file between two places, on one line, without a `;` at their end. */
static void put_source(const writing *w, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = tn_text(w->module, w->module->SOURCE_records[file].text);
    bool comment = false, blank = false;
    while (end > begin && strchr("; \t\r\n", text[end - 1]))
        end--;
    for (uint32_t i = begin; i < end; i++) {
        comment = text[i] == '#' || (comment && text[i] != '\n');
        bool space = comment || strchr(" \t\r\n", text[i]);
        if (!space && blank)
            fputc(' ', w->out);
        if (!space)
            fputc(text[i], w->out);
        blank = space;
    }
}

static void put_triple(FILE *out, double a, double b, double c)
{
    char text[3][TN_NUMBER_TEXT_SIZE];
    fprintf(out, "(%s, %s, %s)", tn_number_text(a, text[0]), tn_number_text(b, text[1]), tn_number_text(c, text[2]));
}

static void put_settings(const writing *w)
{
    static const char *const models[] = {"", "mm", "cm", "m"};
    uint32_t flags = w->record->flags;
    char depth[TN_NUMBER_TEXT_SIZE];
    if (flags & TN_SOLID_SYMMETRY) {
        const char *between = "";
        fputs("# head   symmetry ", w->out);
        for (int axis = 0; axis < 3; axis++)
            if (flags & TN_SOLID_SYMMETRY_X << axis) {
                fprintf(w->out, "%s%c", between, "xyz"[axis]);
                between = ", ";
            }
        fputs(";\n", w->out);
    }
    if (flags & TN_SOLID_FLAT)
        fprintf(w->out, "# head   flat %s;\n", tn_number_text(w->record->depth, depth));
    if (flags & TN_SOLID_NOCLIP)
        fputs("# head   noclip;\n", w->out);
    if (flags & TN_SOLID_PENETRATION)
        fputs("# head   correct penetration;\n", w->out);
    if (w->record->model && w->record->model < 4)
        fprintf(w->out, "# head   model %s;\n", models[w->record->model]);
}

/* A rigid box as its faces are, or, where a plane clips it, as it is written. */
static void put_rigid(const writing *w, uint32_t number)
{
    const tn_box_record *box = &w->module->BOX_records[number];
    fputs("# head   ", w->out);
    if (box->flags & TN_BOX_CLIPPED || w->record->flags & TN_SOLID_FLAT) {
        put_source(w, box->file, box->begin, box->end);
    } else {
        const char *name = tn_text(w->module, box->name);
        fprintf(w->out, "box %s from ", name[0] ? name : "skeleton");
        put_triple(w->out, box->low_x, box->low_y, box->low_z);
        fputs(" to ", w->out);
        put_triple(w->out, box->high_x, box->high_y, box->high_z);
        fputs(" rigid", w->out);
    }
    fputs(";\n", w->out);
}

static void put_conditions(const writing *w)
{
    for (uint32_t i = 0; i < w->record->requirement_count; i++) {
        const tn_requirement_record *r = &w->module->REQUIREMENT_records[w->record->requirement_first + i];
        fputs("# foot   require ", w->out);
        put_source(w, r->file, r->begin, r->end);
        fputs(";\n", w->out);
    }
    for (uint32_t i = 0; i < w->record->goal_count; i++) {
        const tn_solid_goal_record *g = &w->module->SOLID_GOAL_records[w->record->goal_first + i];
        fputs("# foot   ", w->out);
        put_source(w, g->file, g->begin, g->end);
        fputs(";\n", w->out);
    }
}

/* A free box as genes. One without a plane gets one so far out that it cuts nothing off: NAN stands for that. */
static void put_free(const writing *w, const tn_box_record *b)
{
    bool clipped = b->flags & TN_BOX_CLIPPED;
    double level = sqrt(b->normal_x * b->normal_x + b->normal_z * b->normal_z);
    const double genes[TN_BOX_GENES] = {(b->low_x + b->high_x) / 2,
                                        (b->low_y + b->high_y) / 2,
                                        (b->low_z + b->high_z) / 2,
                                        b->high_x - b->low_x,
                                        b->high_y - b->low_y,
                                        b->high_z - b->low_z,
                                        clipped ? b->planedist : (double)NAN,
                                        clipped ? tn_atan2(b->normal_x, b->normal_z) * DEGREES : 0,
                                        clipped ? tn_atan2(b->normal_y, level) * DEGREES : 0};
    for (uint32_t k = 0; k < TN_BOX_GENES; k++)
        fprintf(w->out, "%" PRIu64 " ", tn_bits_of(genes[k]));
}

static void put_bounds(const writing *w)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < w->record->box_count; i++) {
        const tn_box_record *b = &w->module->BOX_records[w->record->box_first + i];
        const double from[3] = {b->low_x, b->low_y, b->low_z}, to[3] = {b->high_x, b->high_y, b->high_z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], from[k]);
            high[k] = fmax(high[k], to[k]);
        }
    }
    fputs("# bounds ", w->out);
    put_triple(w->out, low[0], low[1], low[2]);
    fputs("..", w->out);
    put_triple(w->out, high[0], high[1], high[2]);
    fputc('\n', w->out);
}

static void put_all(const writing *w)
{
    char depth[TN_NUMBER_TEXT_SIZE];
    bool any = false;
    fprintf(w->out, "# flags %u\n# depth %s\n", w->record->flags & ~TN_SOLID_IMPORTED,
            tn_number_text(w->record->depth, depth));
    put_bounds(w);
    fputs("# head solid bred {\n", w->out);
    put_settings(w);
    for (uint32_t i = w->record->box_first; i < w->record->box_first + w->record->box_count; i++)
        if (w->module->BOX_records[i].flags & TN_BOX_RIGID)
            put_rigid(w, i);
    put_conditions(w);
    fputs("# foot }\n", w->out);
    for (uint32_t i = w->record->box_first; i < w->record->box_first + w->record->box_count; i++)
        if (!(w->module->BOX_records[i].flags & TN_BOX_RIGID)) {
            put_free(w, &w->module->BOX_records[i]);
            any = true;
        }
    if (any)
        fputc('\n', w->out);
}

static tn_status write_text(const tn_opened *opened, uint32_t solid, char **text, tn_error *error)
{
    size_t size;
    writing w = {.module = opened->module, .record = &opened->module->SOLID_records[solid]};
    w.out = open_memstream(text, &size);
    if (!w.out)
        return tn_fail_memory(error);
    put_all(&w);
    bool written = !ferror(w.out);
    return fclose(w.out) == 0 && written ? TN_OK : tn_fail_memory(error);
}

tn_status tn_skeleton_read(const tn_evolution_study *study, const char *path, char **text, char **inputs,
                           tn_error *error)
{
    char *design = tn_file_beside(path, study->of[TN_SET_DESIGN].text);
    tn_opened opened;
    uint32_t solid;
    *text = NULL;
    if (!design)
        return tn_fail_memory(error);
    tn_status status = tn_open(design, false, &opened);
    if (status == TN_OK)
        status = tn_solid_choose(&opened, NULL, &solid);
    if (status == TN_OK)
        status = write_text(&opened, solid, text, error);
    else if (status != TN_MEMORY)
        tn_fail(error, status, E_DESIGN_GOALS, "the design %.200s cannot be bred from: %.300s", design,
                tn_first_error(&opened));
    else
        tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_inputs_add_sources(inputs, "design", opened.module, UINT32_MAX, error);
    tn_close(&opened);
    free(design);
    return status;
}

/* ---- from text to what is bred */

struct tn_skeleton {
    tn_box_breeding breeding;
    double low[3], high[3]; /* of all boxes */
    char *head, *foot;
    tn_genome seed;
};

void tn_skeleton_free(tn_skeleton *s)
{
    if (!s)
        return;
    tn_genome_clear(&s->seed);
    free(s->head);
    free(s->foot);
    free(s);
}

static tn_status add_line(char **lines, const char *line, size_t size, tn_error *error)
{
    char *longer = NULL;
    if (asprintf(&longer, "%s%.*s\n", *lines ? *lines : "", (int)size, line) < 0)
        return tn_fail_memory(error);
    free(*lines);
    *lines = longer;
    return TN_OK;
}

static tn_status take_line(tn_skeleton *s, const char *line, size_t size, tn_error *error)
{
    if (size > 7 && strncmp(line, "# head ", 7) == 0)
        return add_line(&s->head, line + 7, size - 7, error);
    if (size > 7 && strncmp(line, "# foot ", 7) == 0)
        return add_line(&s->foot, line + 7, size - 7, error);
    if (sscanf(line, "# flags %u", &s->breeding.flags) == 1 || sscanf(line, "# depth %lf", &s->breeding.depth) == 1 ||
        sscanf(line, "# bounds (%lf, %lf, %lf)..(%lf, %lf, %lf)", &s->low[0], &s->low[1], &s->low[2], &s->high[0],
               &s->high[1], &s->high[2]) == 6)
        return TN_OK;
    return line[0] == '#' || size == 0 ? TN_OK : tn_genome_read(line, size, &s->seed, error);
}

static tn_status refuse(tn_setting setting, tn_setting *blamed, const char *what, const char *help, tn_error *error)
{
    *blamed = setting;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "%s", what);
    tn_error_help(error, "%s", help);
    return TN_INVALID;
}

/* Where nothing is said: centres within the design's boxes, sizes from a twentieth of its largest extent up to that. */
static tn_status take_ranges(tn_skeleton *s, const tn_evolution_study *study, tn_setting *blamed, tn_error *error)
{
    tn_box_breeding *b = &s->breeding;
    const tn_setting_value *region = &study->of[TN_SET_REGION], *sizes = &study->of[TN_SET_SIZES];
    double low[3], high[3], extent = 0;
    memcpy(low, s->low, sizeof low);
    memcpy(high, s->high, sizeof high);
    if (region->written && !tn_study_box(region->text, low, high))
        return refuse(TN_SET_REGION, blamed, "this is no region",
                      "write its low and its high corner: `region \"(-6, 0, -4)..(6, 8, 4)\"`", error);
    for (int k = 0; k < 3; k++)
        extent = fmax(extent, high[k] - low[k]);
    double least = sizes->written ? sizes->first : extent / 20, most = sizes->written ? sizes->second : extent;
    for (int k = 0; k < 3; k++) {
        bool flat = k == 2 && (b->flags & TN_SOLID_FLAT);
        if (!flat && least > high[k] - low[k])
            return refuse(TN_SET_REGION, blamed, "the region is smaller than the least size of a box",
                          "make it larger, or `sizes` smaller", error);
        b->low[k] = flat ? 0 : low[k];
        b->high[k] = flat ? 0 : high[k];
        b->low[3 + k] = flat ? b->depth : least;
        b->high[3 + k] = flat ? b->depth : fmin(most, high[k] - low[k]);
    }
    double diagonal = sqrt(b->high[3] * b->high[3] + b->high[4] * b->high[4] + b->high[5] * b->high[5]);
    b->high[6] = ceil(diagonal / 2 * TN_GENE_STEPS) / TN_GENE_STEPS;
    b->low[6] = -b->high[6];
    b->low[7] = b->flags & TN_SOLID_FLAT ? 90 : -180;
    b->high[7] = b->flags & TN_SOLID_FLAT ? 90 : 180;
    b->low[8] = -90;
    b->high[8] = 90;
    return TN_OK;
}

/* The free boxes of the design, moved into the ranges. */
static void tidy_seed(tn_skeleton *s)
{
    tn_genome *seed = &s->seed;
    for (size_t i = 0; i < seed->count; i++) {
        uint32_t k = (uint32_t)(i % TN_BOX_GENES);
        double value = tn_double_of(seed->codons[i]);
        value = isnan(value) ? s->breeding.high[6] : fmin(fmax(value, s->breeding.low[k]), s->breeding.high[k]);
        seed->codons[i] = tn_bits_of(tn_box_gene(&s->breeding, k, value) + 0.0);
    }
}

static tn_status take_study(tn_skeleton *s, const tn_evolution_study *study, tn_setting *blamed, tn_error *error)
{
    tn_box_breeding *b = &s->breeding;
    b->least = (uint32_t)study->of[TN_SET_BOXES].first;
    b->most = (uint32_t)study->of[TN_SET_BOXES].second;
    b->mutation_rate = study->of[TN_SET_MUTATION_RATE].written ? study->of[TN_SET_MUTATION_RATE].first : -1;
    b->split = study->of[TN_SET_SPLIT].first;
    b->delete_ = study->of[TN_SET_DELETE].first;
    size_t boxes = s->seed.count / TN_BOX_GENES;
    if (boxes && (boxes < b->least || boxes > b->most))
        return refuse(study->of[TN_SET_BOXES].written ? TN_SET_BOXES : TN_SET_DESIGN, blamed,
                      "the design has another number of free boxes",
                      "let `boxes` hold theirs, as `boxes 1..12`; rigid ones are not counted", error);
    tn_status status = take_ranges(s, study, blamed, error);
    if (status == TN_OK)
        tidy_seed(s);
    return status;
}

tn_status tn_skeleton_of(const char *text, const tn_evolution_study *study, tn_skeleton **skeleton, tn_setting *blamed,
                         tn_error *error)
{
    tn_skeleton *s = calloc(1, sizeof *s);
    tn_status status = s ? TN_OK : tn_fail_memory(error);
    *skeleton = s;
    for (const char *line = text; status == TN_OK && *line; line += strcspn(line, "\n"), line += *line == '\n')
        status = take_line(s, line, strcspn(line, "\n"), error);
    if (status == TN_OK && (!s->head || !s->foot || s->seed.count % TN_BOX_GENES))
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database holds no design");
    if (status != TN_OK)
        return status;
    s->breeding.head = s->head;
    s->breeding.foot = s->foot;
    return take_study(s, study, blamed, error);
}

tn_box_breeding *tn_skeleton_breeding(tn_skeleton *skeleton)
{
    return &skeleton->breeding;
}

const tn_genome *tn_skeleton_seed(const tn_skeleton *skeleton, size_t *count)
{
    *count = skeleton->seed.count ? 1 : 0;
    return &skeleton->seed;
}
