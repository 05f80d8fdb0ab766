/* Reads the parents of bred fields from their files, and from the text that a run keeps of them. */
#include "driver/breed/field_parents.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/field/field.h"
#include "driver/breed/box_text.h"
#include "driver/breed/inputs.h"
#include "driver/open/open.h"
#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"
#include "runtime/genome/tree/tree_kind.h"

/* Named constants of all parents. Owns the names; free with constant_table_clear. */
typedef struct constant_table {
    tn_gene_constant *items;
    uint32_t count;
    size_t capacity;
} constant_table;

/* ---- constants */

static void constant_table_clear(constant_table *table)
{
    for (uint32_t i = 0; i < table->count; i++)
        free((char *)(uintptr_t)table->items[i].name);
    free(table->items);
    *table = (constant_table){0};
}

static uint32_t constant_named(const constant_table *table, const char *name)
{
    uint32_t i = 0;
    while (i < table->count && strcmp(table->items[i].name, name) != 0)
        i++;
    return i;
}

/* The constant of this name and value; a name that is there with another value gets `_2`, `_3` and so on. Its index, or
 * UINT32_MAX where out of memory. */
static uint32_t constant_find(constant_table *table, const char *name, double value)
{
    char other[TN_NAME_MAX + 8];
    snprintf(other, sizeof other, "%.*s", TN_NAME_MAX, name);
    for (unsigned number = 2;; number++) {
        uint32_t i = constant_named(table, other);
        if (i == table->count)
            break;
        if (tn_bits_of(table->items[i].value) == tn_bits_of(value))
            return i;
        snprintf(other, sizeof other, "%.*s_%u", TN_NAME_MAX - 4, name, number);
    }
    char *copy = strdup(other);
    if (!copy || !tn_array_reserve(&table->items, &table->capacity, table->count, 1, sizeof *table->items)) {
        free(copy);
        return UINT32_MAX;
    }
    table->items[table->count] = (tn_gene_constant){copy, value};
    return table->count++;
}

/* ---- expressions */

/* An expression, and where its own names are looked up. */
typedef struct place {
    const struct bound *arguments;      /* of the function that it stands in */
    const struct bound *coordinates[3]; /* NULL: the coordinate itself */
} place;

typedef struct bound {
    const tn_expression *expression;
    const place *at;
} bound;

typedef struct making {
    const tn_checked_fields *checked;
    tn_arena *arena;
    uint32_t most, nodes, depth;
    constant_table *constants;
    tn_genome *genome;
    tn_status status;
    tn_error *error;
} making;

static void make(making *m, const tn_expression *e, const place *at);

static void fail(making *m, const char *what, const char *help)
{
    if (m->status != TN_OK)
        return;
    m->status = tn_fail(m->error, TN_INVALID, E_FIELD_PARENT, "%s", what);
    tn_error_help(m->error, "%s", help);
}

static void add(making *m, uint64_t token)
{
    if (m->status != TN_OK)
        return;
    if (!tn_genome_reserve(m->genome, m->genome->count + 1)) {
        m->status = tn_fail_memory(m->error);
        return;
    }
    m->genome->codons[m->genome->count++] = token;
}

static void node(making *m, tn_gene_symbol symbol)
{
    if (++m->nodes > m->most)
        fail(m, "it is larger than what is bred", "raise `max-nodes`, or breed from a simpler surface");
    add(m, symbol);
}

static void number(making *m, double value)
{
    if (value < 0 || (value == 0 && tn_bits_of(value)))
        node(m, TN_GENE_NEGATE);
    node(m, TN_GENE_NUMBER);
    add(m, tn_bits_of(__builtin_fabs(value)));
}

static tn_gene_symbol symbol_of(tn_opcode op)
{
    static const struct {
        tn_opcode op;
        tn_gene_symbol symbol;
    } pairs[] = {
        {TN_OP_NEGATE, TN_GENE_NEGATE},
        {TN_OP_ADD, TN_GENE_ADD},
        {TN_OP_SUBTRACT, TN_GENE_SUBTRACT},
        {TN_OP_MULTIPLY, TN_GENE_MULTIPLY},
        {TN_OP_DIVIDE, TN_GENE_DIVIDE},
        {TN_OP_MODULO, TN_GENE_MODULO},
        {TN_OP_POWER, TN_GENE_POWER},
        {TN_OP_ROOT, TN_GENE_ROOT},
        {TN_OP_SQUARE, TN_GENE_SQUARE},
        {TN_OP_ABSOLUTE, TN_GENE_ABSOLUTE},
        {TN_OP_LEAST, TN_GENE_LEAST},
        {TN_OP_MOST, TN_GENE_MOST},
        {TN_OP_CLAMP, TN_GENE_CLAMP},
        {TN_OP_MIX, TN_GENE_MIX},
        {TN_OP_BLEND, TN_GENE_BLEND},
        {TN_OP_SINE, TN_GENE_SINE},
        {TN_OP_COSINE, TN_GENE_COSINE},
        {TN_OP_TANGENT, TN_GENE_TANGENT},
        {TN_OP_ARC_TANGENT, TN_GENE_ARC_TANGENT},
        {TN_OP_EXPONENTIAL, TN_GENE_EXPONENTIAL},
        {TN_OP_LOGARITHM, TN_GENE_LOGARITHM},
        {TN_OP_HYPERBOLIC_TANGENT, TN_GENE_HYPERBOLIC_TANGENT},
        {TN_OP_FLOOR, TN_GENE_FLOOR},
        {TN_OP_NOISE, TN_GENE_NOISE},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (pairs[i].op == op)
            return pairs[i].symbol;
    return TN_GENE_SYMBOL_COUNT;
}

/* `let` names numbers that can be computed at once. One that is called as a function stays a number. */
static void make_constant(making *m, const tn_field_definition *definition)
{
    tn_field_nodes nodes = {.arena = m->arena, .checked = m->checked};
    uint32_t at = tn_field_expand(&nodes, definition->body);
    double value = nodes.count > at ? nodes.items[at].number : 0;
    const char *name = definition->name.text;
    if (tn_function_named(TN_WORDS_FIELD, name, strlen(name)) || strcmp(name, "distance") == 0) {
        number(m, value);
        return;
    }
    uint32_t index = constant_find(m->constants, name, value);
    node(m, TN_GENE_CONSTANT);
    add(m, index);
    if (index == UINT32_MAX && m->status == TN_OK)
        m->status = tn_fail_memory(m->error);
}

static const bound *bind(making *m, const tn_expression *first, uint32_t count, const place *at)
{
    bound *bounds = TN_NEW_ARRAY(m->arena, bound, count + 1u);
    uint32_t i = 0;
    for (const tn_expression *e = first; bounds && e && i < count; e = e->next)
        bounds[i++] = (bound){e, at};
    if (!bounds && m->status == TN_OK)
        m->status = tn_fail_memory(m->error);
    return bounds;
}

static void make_definition(making *m, const tn_expression *e, const place *at)
{
    const tn_field_definition *of = m->checked->definitions[e->term];
    if (of->kind == TN_FIELD_LET) {
        make_constant(m, of);
        return;
    }
    place *inside = TN_NEW(m->arena, place);
    const bound *arguments = bind(m, e->first, of->parameters.count, at);
    if (!inside || !arguments)
        return;
    *inside = *at;
    inside->arguments = arguments;
    make(m, of->body, inside);
}

/* The coordinates are the first three operands, the surface is the last. */
static void make_at(making *m, const tn_expression *e, const place *at)
{
    place *there = TN_NEW(m->arena, place);
    const bound *coordinates = bind(m, e->first, 3, at);
    if (!there || !coordinates)
        return;
    *there = *at;
    for (int axis = 0; axis < 3; axis++)
        there->coordinates[axis] = &coordinates[axis];
    make(m, e->last, there);
}

static void make_operation(making *m, const tn_expression *e, const place *at)
{
    tn_gene_symbol symbol = symbol_of(e->op);
    if (symbol == TN_GENE_SYMBOL_COUNT) {
        fail(m, "it measures a distance from a mesh, and meshes are not bred",
             "name a surface without `distance(...)`");
        return;
    }
    node(m, symbol);
    bool call = tn_gene_is_call(symbol);
    for (uint32_t i = 1; call && i < e->operand_count; i++)
        node(m, TN_GENE_COMMA);
    for (const tn_expression *operand = e->first; operand; operand = operand->next)
        make(m, operand, at);
}

static void make(making *m, const tn_expression *e, const place *at)
{
    if (m->status != TN_OK)
        return;
    if (++m->depth > TN_FIELD_EXPAND_MAX)
        fail(m, "it nests too deep to be bred", "breed from a simpler surface");
    const bound *named = e->op == TN_OP_TERM         ? &at->arguments[e->term]
                         : e->op == TN_OP_COORDINATE ? at->coordinates[e->term]
                                                     : NULL;
    if (named)
        make(m, named->expression, named->at);
    else if (e->op == TN_OP_COORDINATE)
        node(m, (tn_gene_symbol)(TN_GENE_X + e->term));
    else if (e->op == TN_OP_NUMBER)
        number(m, e->number);
    else if (e->op == TN_OPCODE_COUNT && tn_field_is_at(e))
        make_at(m, e, at);
    else if (e->op == TN_OPCODE_COUNT)
        make_definition(m, e, at);
    else
        make_operation(m, e, at);
    m->depth--;
}

/* Makes the genome of an expression of checked fields: functions and surfaces are put in their places, and what `let`
 * names are named constants. TN_INVALID (E1247) where it measures distances from a mesh, or is larger than `most`
 * nodes. */
static tn_status field_tree(const tn_checked_fields *checked, tn_arena *arena, const tn_expression *body, uint32_t most,
                            constant_table *constants, tn_genome *genome, tn_error *error)
{
    making m = {
        .checked = checked, .arena = arena, .most = most, .constants = constants, .genome = genome, .error = error};
    place outermost = {0};
    genome->count = 0;
    make(&m, body, &outermost);
    if (m.status == TN_OK && tn_arena_failed(arena))
        return tn_fail_memory(error);
    tn_gene_tree tree = {0};
    if (m.status == TN_OK)
        m.status = tn_gene_tree_read(genome, constants->count, &tree, error);
    if (m.status == TN_OK && tree.height > TN_GENE_HEIGHT_MAX)
        fail(&m, "it nests too deep to be bred", "breed from a simpler surface");
    tn_gene_tree_clear(&tree);
    return m.status;
}

/* ---- from files to text */

typedef struct reading {
    const tn_evolution_study *study;
    const char *path;
    constant_table constants;
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
    tn_status status = field_tree(checked, opened->compilation.arena, body, most, &r->constants, &genome, &why);
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
    constant_table_clear(&r.constants);
    return status;
}

/* ---- from text to what is bred */

struct tn_field_parents {
    tn_tree_breeding breeding;
    constant_table constants;
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
    constant_table_clear(&p->constants);
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
        constant_find(&p->constants, name, value) == UINT32_MAX)
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
