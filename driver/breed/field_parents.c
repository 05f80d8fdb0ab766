/* Reads the parents of bred fields from their files, and from the text that a run keeps of them. */
#include "driver/breed/field_parents.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/beside.h"
#include "driver/breed/field_tree.h"
#include "driver/breed/inputs.h"
#include "driver/open/open.h"
#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/base/file.h"

/* ---- from files to text */

typedef struct reading {
    const tn_evolution_study *study;
    const char *path;
    tn_constant_table constants;
    FILE *genomes; /* weights and genomes, a parent after the other */
    double low[3], high[3];
    uint32_t unit;
    char **inputs;
} reading;

/* "pebble.field:pair" is the surface `pair` of that file, "pebble.field" its last, and "heart" a primitive's name. */
typedef struct named {
    char *path;          /* owned */
    const char *surface; /* in it, or NULL: the last */
    bool primitive;
} named;

static tn_status name_parent(const char *study, const char *text, named *n, tn_error *error)
{
    *n = (named){0};
    n->primitive = !strchr(text, '.') && !strchr(text, '/');
    n->path = n->primitive ? strdup("primitives") : tn_file_beside(study, text);
    if (!n->path)
        return tn_fail_memory(error);
    char *colon = n->primitive ? NULL : strrchr(n->path, ':');
    n->surface = n->primitive ? text : colon ? colon + 1 : NULL;
    if (colon)
        *colon = '\0';
    return TN_OK;
}

static tn_status no_surface(const named *n, const tn_module *module, tn_error *error)
{
    const char **names = calloc(module->SURFACE_count + 1, sizeof *names);
    if (!names)
        return tn_fail_memory(error);
    for (size_t i = 0; i < module->SURFACE_count; i++)
        names[i] = tn_text(module, module->SURFACE_records[i].name);
    const char *near = n->surface ? tn_nearest(n->surface, names, module->SURFACE_count) : NULL;
    char list[300];
    tn_word_list(names, module->SURFACE_count, list, sizeof list);
    if (n->surface && n->primitive)
        tn_fail(error, TN_INVALID, E_FIELD_PARENT, "there is no primitive `%.100s`", n->surface);
    else if (n->surface)
        tn_fail(error, TN_INVALID, E_FIELD_PARENT, "%.200s has no surface `%.100s`", n->path, n->surface);
    else
        tn_fail(error, TN_INVALID, E_FIELD_PARENT, "%.200s has no surface", n->path);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    else if (n->primitive)
        tn_error_help(error, "there are %s; a file is named as `parent \"pebble.field\"`", list);
    else
        tn_error_help(error, module->SURFACE_count ? "it has %s" : "name a .field file", list);
    free(names);
    return TN_INVALID;
}

static const tn_surface_record *find_surface(const named *n, const tn_module *module)
{
    if (!n->surface)
        return module->SURFACE_count ? &module->SURFACE_records[module->SURFACE_count - 1] : NULL;
    for (size_t i = 0; i < module->SURFACE_count; i++)
        if (strcmp(tn_text(module, module->SURFACE_records[i].name), n->surface) == 0)
            return &module->SURFACE_records[i];
    return NULL;
}

static const tn_expression *body_of(const tn_checked_fields *checked, const char *name)
{
    for (uint32_t i = 0; i < checked->definition_count; i++) {
        const tn_field_definition *d = checked->definitions[i];
        if (d->unit == checked->unit && d->kind == TN_FIELD_SURFACE && strcmp(d->name.text, name) == 0)
            return d->body;
    }
    return NULL;
}

static void write_genome(reading *r, double weight, const tn_genome *genome)
{
    char text[TN_NUMBER_TEXT_SIZE];
    fprintf(r->genomes, "# weight %s\n", tn_number_text(weight, text));
    for (size_t i = 0; i < genome->count; i++)
        fprintf(r->genomes, i ? " %" PRIu64 : "%" PRIu64, genome->codons[i]);
    fputc('\n', r->genomes);
}

static void widen_box(reading *r, const tn_surface_record *record)
{
    const double low[3] = {record->low_x, record->low_y, record->low_z},
                 high[3] = {record->high_x, record->high_y, record->high_z};
    for (int k = 0; k < 3; k++) {
        r->low[k] = fmin(r->low[k], low[k]);
        r->high[k] = fmax(r->high[k], high[k]);
    }
    r->unit = r->unit ? r->unit : record->unit;
}

static tn_status make_parent(reading *r, const named *n, double weight, tn_opened *opened, tn_error *error)
{
    uint32_t most = (uint32_t)r->study->of[TN_SET_MAX_NODES].first;
    const tn_surface_record *record = find_surface(n, opened->module);
    if (!record)
        return no_surface(n, opened->module, error);
    const tn_checked_fields *checked = opened->compilation.fields;
    const char *name = tn_text(opened->module, record->name);
    const tn_expression *body = checked ? body_of(checked, name) : NULL;
    if (!body) {
        tn_fail(error, TN_INVALID, E_FIELD_PARENT, "%.200s is a module, and breeding needs the .field file", n->path);
        tn_error_help(error, "name the file that it was built from");
        return TN_INVALID;
    }
    tn_genome genome = {0};
    tn_error why = {0};
    tn_status status = tn_field_tree(checked, opened->compilation.arena, body, most, &r->constants, &genome, &why);
    if (status == TN_OK) {
        write_genome(r, weight, &genome);
        widen_box(r, record);
    } else if (status == TN_MEMORY) {
        tn_fail_memory(error);
    } else {
        tn_fail(error, status, E_FIELD_PARENT, "`%.100s` cannot be bred from: %.200s", name, why.message);
        tn_error_help(error, "%s", why.help);
    }
    tn_genome_clear(&genome);
    return status;
}

static tn_status read_parent(reading *r, const tn_setting_value *value, tn_error *error)
{
    named n;
    tn_opened opened;
    tn_status status = name_parent(r->path, value->text, &n, error);
    if (status != TN_OK)
        return status;
    status = tn_open(n.path, false, &opened);
    if (status == TN_OK)
        status = make_parent(r, &n, value->second, &opened, error);
    else if (status != TN_MEMORY)
        status = tn_fail(error, status, E_FIELD_PARENT, "the parent %.200s cannot be used: %.300s", n.path,
                         tn_first_error(&opened));
    else
        tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_inputs_add_sources(r->inputs, "parent", opened.module, UINT32_MAX, error);
    tn_close(&opened);
    free(n.path);
    return status;
}

static tn_status take_box(reading *r, tn_error *error)
{
    const tn_setting_value *box = &r->study->of[TN_SET_BOX];
    if (!box->written || tn_study_box(box->text, r->low, r->high))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.60s` is no box", box->text);
    tn_error_help(error, "write its low and its high corner: `box \"(-7, -7, -7)..(7, 7, 7)\"`");
    return TN_INVALID;
}

static void write_head(const reading *r, FILE *out)
{
    static const char *const units[] = {"", "mm", "cm", "m", "in", "ft"};
    char n[6][TN_NUMBER_TEXT_SIZE];
    for (uint32_t i = 0; i < r->constants.count; i++)
        fprintf(out, "# constant %s %s\n", r->constants.items[i].name,
                tn_number_text(r->constants.items[i].value, n[0]));
    for (int k = 0; k < 3; k++) {
        tn_number_text(r->low[k], n[k]);
        tn_number_text(r->high[k], n[3 + k]);
    }
    fprintf(out, "# footer box (%s, %s, %s)..(%s, %s, %s)\n# footer grid %u\n", n[0], n[1], n[2], n[3], n[4], n[5],
            (unsigned)r->study->of[TN_SET_GRID].first);
    if (r->unit && r->unit < sizeof units / sizeof *units)
        fprintf(out, "# footer unit %s\n", units[r->unit]);
}

static tn_status write_all(reading *r, const char *genomes, char **text, tn_error *error)
{
    size_t size;
    FILE *out = open_memstream(text, &size);
    if (!out)
        return tn_fail_memory(error);
    write_head(r, out);
    fputs(genomes, out);
    bool written = !ferror(out);
    return fclose(out) == 0 && written ? TN_OK : tn_fail_memory(error);
}

tn_status tn_field_parents_read(const tn_evolution_study *study, const char *path, char **text, char **inputs,
                                uint32_t *blamed, tn_error *error)
{
    reading r = {.study = study,
                 .path = path,
                 .low = {INFINITY, INFINITY, INFINITY},
                 .high = {-INFINITY, -INFINITY, -INFINITY},
                 .inputs = inputs};
    char *genomes = NULL;
    size_t size;
    *text = NULL;
    r.genomes = open_memstream(&genomes, &size);
    if (!r.genomes)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < study->each_count && status == TN_OK; i++) {
        if (study->each[i].setting != TN_SET_PARENT)
            continue;
        *blamed = i;
        status = read_parent(&r, &study->each[i].value, error);
    }
    if (status == TN_OK)
        *blamed = UINT32_MAX;
    if (status == TN_OK)
        status = take_box(&r, error);
    bool written = !ferror(r.genomes);
    if ((fclose(r.genomes) != 0 || !written) && status == TN_OK)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = write_all(&r, genomes, text, error);
    free(genomes);
    tn_constant_table_clear(&r.constants);
    return status;
}

/* ---- from text to what is bred */

struct tn_field_parents {
    tn_tree_breeding breeding;
    tn_constant_table constants;
    tn_genome *genomes;
    double *weights;
    size_t count, capacity, weight_capacity;
    char *footer;
};

void tn_field_parents_free(tn_field_parents *p)
{
    if (!p)
        return;
    for (size_t i = 0; i < p->count; i++)
        tn_genome_clear(&p->genomes[i]);
    free(p->genomes);
    free(p->weights);
    free(p->footer);
    tn_constant_table_clear(&p->constants);
    free(p);
}

static tn_status add_footer(tn_field_parents *p, const char *line, size_t size, tn_error *error)
{
    char *longer = NULL;
    if (asprintf(&longer, "%s%.*s\n", p->footer ? p->footer : "", (int)size, line) < 0)
        return tn_fail_memory(error);
    free(p->footer);
    p->footer = longer;
    return TN_OK;
}

/* What follows "# " in a line. */
static tn_status take_remark(tn_field_parents *p, const char *line, size_t size, double *weight, tn_error *error)
{
    char name[TN_NAME_MAX + 8];
    double value;
    if (size > 7 && strncmp(line, "footer ", 7) == 0)
        return add_footer(p, line + 7, size - 7, error);
    if (sscanf(line, "weight %lf", weight) == 1)
        return TN_OK;
    if (sscanf(line, "constant %255s %lf", name, &value) == 2 &&
        tn_constant_find(&p->constants, name, value) == UINT32_MAX)
        return tn_fail_memory(error);
    return TN_OK;
}

static tn_status take_genome(tn_field_parents *p, const char *line, size_t size, double weight, tn_error *error)
{
    if (!tn_array_reserve(&p->genomes, &p->capacity, p->count, 1, sizeof *p->genomes) ||
        !tn_array_reserve(&p->weights, &p->weight_capacity, p->count, 1, sizeof *p->weights))
        return tn_fail_memory(error);
    p->genomes[p->count] = (tn_genome){0};
    p->weights[p->count] = weight;
    return tn_genome_read(line, size, &p->genomes[p->count++], error);
}

tn_status tn_field_parents_of(const char *text, tn_field_parents **parents, tn_error *error)
{
    tn_field_parents *p = calloc(1, sizeof *p);
    *parents = p;
    if (!p)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    double weight = 1;
    for (const char *line = text; *line && status == TN_OK; line += strcspn(line, "\n"), line += *line == '\n') {
        size_t size = strcspn(line, "\n");
        if (size > 2 && line[0] == '#')
            status = take_remark(p, line + 2, size - 2, &weight, error);
        else if (size)
            status = take_genome(p, line, size, weight, error);
    }
    if (status == TN_OK && (p->count == 0 || !p->footer))
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database holds no parents");
    p->breeding = (tn_tree_breeding){.parents = p->genomes,
                                     .weights = p->weights,
                                     .parent_count = p->count,
                                     .constants = p->constants.items,
                                     .constant_count = p->constants.count,
                                     .footer = p->footer};
    return status;
}

tn_tree_breeding *tn_field_parents_breeding(tn_field_parents *parents)
{
    return &parents->breeding;
}
