/* Makes, crosses, mutates and writes lists of boxes for evolution. */
#include "runtime/genome/boxes/box_kind.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/breeding/chance.h"
#include "runtime/module/values.h"

#define GENES TN_BOX_GENES
#define CUT_RATE 0.5       /* of a crossing: one box's genes are exchanged from a point on */
#define MUTATION_SHARE 0.1 /* of a gene's range: the deviation of what mutation adds */

typedef struct workplace {
    const tn_box_breeding *of;
    char *text;
    size_t size;
} workplace;

static void *workplace_new(const void *context)
{
    workplace *w = calloc(1, sizeof *w);
    if (w)
        w->of = context;
    return w;
}

static void workplace_free(void *place)
{
    workplace *w = place;
    if (w)
        free(w->text);
    free(w);
}

/* ---- genes */

static double gene(const tn_genome *genome, size_t box, uint32_t k)
{
    return tn_double_of(genome->codons[box * GENES + k]);
}

static void set_gene(tn_genome *genome, size_t box, uint32_t k, double value)
{
    genome->codons[box * GENES + k] = tn_bits_of(value + 0.0); /* no -0 */
}

double tn_box_gene(const tn_box_breeding *of, uint32_t k, double value)
{
    double low = of->low[k], high = of->high[k], range = high - low;
    for (int i = 0; i < 4 && (value < low || value > high); i++)
        value = value < low ? 2 * low - value : 2 * high - value;
    value = range > 0 ? fmin(fmax(value, low), high) : low;
    double steps = k >= 3 && k < 6 ? TN_GENE_STEPS / 2 : TN_GENE_STEPS; /* sizes: even ones */
    return nearbyint(value * steps) / steps;
}

static bool add_box(tn_genome *to, const tn_genome *from, size_t box)
{
    if (!tn_genome_reserve(to, to->count + GENES))
        return false;
    memcpy(to->codons + to->count, from->codons + box * GENES, GENES * sizeof *to->codons);
    to->count += GENES;
    return true;
}

/* ---- first designs */

static tn_status first(void *place, uint64_t number, tn_chance *chance, tn_genome *genome, tn_birth *birth,
                       tn_error *error)
{
    const workplace *w = place;
    const tn_box_breeding *of = w->of;
    size_t count = of->least + (size_t)tn_chance_below(chance, of->most - of->least + 1);
    (void)number;
    if (!tn_genome_reserve(genome, count * GENES))
        return tn_fail_memory(error);
    genome->count = count * GENES;
    for (size_t box = 0; box < count; box++)
        for (uint32_t k = 0; k < GENES; k++)
            set_gene(genome, box, k,
                     tn_box_gene(of, k, of->low[k] + (of->high[k] - of->low[k]) * tn_chance_unit(chance)));
    birth->kind = TN_BIRTH_RANDOM;
    return TN_OK;
}

/* ---- crossing */

/* Each box goes whole to one child or the other; those behind the shorter parent's end to whichever has room. */
static bool cross_boxes(const tn_box_breeding *of, tn_chance *chance, const tn_parent parents[2],
                        tn_genome *children[2])
{
    size_t counts[2] = {parents[0].genome->count / GENES, parents[1].genome->count / GENES};
    size_t shorter = counts[0] < counts[1] ? counts[0] : counts[1], longer = counts[0] < counts[1] ? 1 : 0;
    double own = parents[0].weight / (parents[0].weight + parents[1].weight);
    bool well = true;
    children[0]->count = children[1]->count = 0;
    for (size_t box = 0; box < shorter; box++) {
        int from = tn_chance_is(chance, own) ? 0 : 1;
        well &= add_box(children[0], parents[from].genome, box);
        well &= add_box(children[1], parents[1 - from].genome, box);
    }
    for (size_t box = shorter; box < counts[longer]; box++) {
        int to = tn_chance_is(chance, 0.5) ? 0 : 1;
        to = children[to]->count / GENES < of->most ? to : 1 - to;
        well &= add_box(children[to], parents[longer].genome, box);
    }
    return well;
}

static void cut_box(tn_chance *chance, tn_genome *children[2])
{
    size_t shorter = children[0]->count < children[1]->count ? children[0]->count : children[1]->count;
    size_t box = (size_t)tn_chance_below(chance, shorter / GENES);
    uint32_t point = 1 + (uint32_t)tn_chance_below(chance, GENES - 1);
    for (uint32_t k = point; k < GENES; k++) {
        uint64_t bits = children[0]->codons[box * GENES + k];
        children[0]->codons[box * GENES + k] = children[1]->codons[box * GENES + k];
        children[1]->codons[box * GENES + k] = bits;
    }
}

/* ---- mutation */

static bool mutate_genes(const tn_box_breeding *of, tn_chance *chance, tn_genome *genome)
{
    double rate = of->mutation_rate < 0 ? 1 / (double)genome->count : of->mutation_rate;
    bool mutated = false;
    for (size_t i = 0; i < genome->count; i++) {
        if (!tn_chance_is(chance, rate))
            continue;
        uint32_t k = (uint32_t)(i % GENES);
        double moved =
            gene(genome, i / GENES, k) + MUTATION_SHARE * (of->high[k] - of->low[k]) * tn_chance_normal(chance);
        set_gene(genome, i / GENES, k, tn_box_gene(of, k, moved));
        mutated = true;
    }
    return mutated;
}

bool tn_box_split(tn_genome *genome, uint32_t at, int axis)
{
    if (!add_box(genome, genome, at))
        return false;
    size_t boxes[2] = {at, genome->count / GENES - 1};
    double normal[3], centre = gene(genome, at, (uint32_t)axis), whole = fabs(gene(genome, at, 3 + (uint32_t)axis));
    double steps = nearbyint(whole * TN_GENE_STEPS), part = 2 * floor(steps / 4); /* both halves are even */
    double sizes[2] = {part / TN_GENE_STEPS, (steps - part) / TN_GENE_STEPS}, distance = gene(genome, at, 6);
    tn_normal_of_angles(gene(genome, at, 7), gene(genome, at, 8), normal);
    for (int half = 0; half < 2; half++) {
        double shift = (half ? 1 : -1) * (whole - sizes[half]) / 2;
        double moved = nearbyint((centre + shift) * TN_GENE_STEPS) / TN_GENE_STEPS;
        set_gene(genome, boxes[half], (uint32_t)axis, moved);
        set_gene(genome, boxes[half], 3 + (uint32_t)axis, sizes[half]);
        set_gene(genome, boxes[half], 6, distance - normal[axis] * shift); /* the same plane, from the half's centre */
    }
    return true;
}

static void delete_box(tn_genome *genome, size_t at)
{
    memmove(genome->codons + at * GENES, genome->codons + (at + 1) * GENES,
            (genome->count - (at + 1) * GENES) * sizeof *genome->codons);
    genome->count -= GENES;
}

static bool may_split(const tn_box_breeding *of, const tn_genome *genome, size_t box, int axis)
{
    return genome->count / GENES < of->most && gene(genome, box, 3 + (uint32_t)axis) / 2 >= of->low[3 + axis];
}

static tn_status mutate(const tn_box_breeding *of, tn_chance *chance, tn_genome *genome, bool *mutated, tn_error *error)
{
    *mutated = mutate_genes(of, chance, genome);
    if (tn_chance_is(chance, of->split)) {
        size_t box = (size_t)tn_chance_below(chance, genome->count / GENES);
        int axis = (int)tn_chance_below(chance, of->flags & TN_SOLID_FLAT ? 2 : 3);
        bool may = may_split(of, genome, box, axis);
        if (may && !tn_box_split(genome, (uint32_t)box, axis))
            return tn_fail_memory(error);
        *mutated |= may;
    }
    if (tn_chance_is(chance, of->delete_)) {
        size_t box = (size_t)tn_chance_below(chance, genome->count / GENES);
        bool may = genome->count / GENES > of->least;
        if (may)
            delete_box(genome, box);
        *mutated |= may;
    }
    return TN_OK;
}

static tn_status breed(void *place, tn_chance *chance, const tn_parent parents[2], tn_genome *children[2],
                       uint8_t kinds[2], tn_error *error)
{
    const workplace *w = place;
    if (!cross_boxes(w->of, chance, parents, children))
        return tn_fail_memory(error);
    if (tn_chance_is(chance, CUT_RATE))
        cut_box(chance, children);
    tn_status status = TN_OK;
    for (int i = 0; i < 2 && status == TN_OK; i++) {
        bool mutated = false;
        status = mutate(w->of, chance, children[i], &mutated, error);
        kinds[i] = (uint8_t)(TN_BIRTH_CROSSED | (mutated ? TN_BIRTH_MUTATED : 0));
    }
    return status;
}

/* ---- sentences */

/* Most genes are whole steps, whose shortest text is at most three digits behind the point. Adds it, as
 * tn_number_text would. */
static char *put_number(char *at, double value)
{
    double steps = value * TN_GENE_STEPS;
    char number[TN_NUMBER_TEXT_SIZE];
    if (!(fabs(value) < 100000) || steps != nearbyint(steps) || steps / TN_GENE_STEPS != value)
        return stpcpy(at, tn_number_text(value, number));
    unsigned whole = (unsigned)fabs(steps), rest = whole % 1000, count = 0;
    if (steps < 0)
        *at++ = '-';
    for (unsigned left = whole / 1000; left || !count; left /= 10)
        number[count++] = (char)('0' + left % 10);
    while (count)
        *at++ = number[--count];
    if (rest)
        *at++ = '.';
    for (unsigned digit = 100; rest; rest %= digit, digit /= 10)
        *at++ = (char)('0' + rest / digit);
    *at = '\0';
    return at;
}

/* Room for nine numbers and what stands between them. */
static char *put_box(char *at, const tn_genome *genome, size_t box)
{
    at = stpcpy(at, "  genes (");
    for (uint32_t k = 0; k < GENES; k++)
        at = put_number(stpcpy(at, k ? ", " : ""), gene(genome, box, k));
    return stpcpy(at, ");\n");
}

static tn_status write(void *place, const tn_genome *genome, tn_written *written, tn_error *error)
{
    workplace *w = place;
    size_t boxes = genome->count / GENES, head = strlen(w->of->head), foot = strlen(w->of->foot);
    size_t size = head + foot + boxes * (GENES * (TN_NUMBER_TEXT_SIZE + 2) + 16) + 1;
    if (genome->count % GENES || !boxes)
        return tn_fail(error, TN_INVALID, E_RUN_DATABASE, "a genome is no list of boxes");
    if (!tn_array_reserve(&w->text, &w->size, 0, size, 1))
        return tn_fail_memory(error);
    char *at = stpcpy(w->text, w->of->head);
    for (size_t box = 0; box < boxes; box++)
        at = put_box(at, genome, box);
    at = stpcpy(at, w->of->foot);
    *written = (tn_written){
        .sentence = w->text, .size = (size_t)(at - w->text), .used = boxes, .depth = 1, .reason = TN_MAPPING_VALID};
    return TN_OK;
}

tn_genome_kind tn_box_kind(tn_box_breeding *breeding)
{
    return (tn_genome_kind){.context = breeding,
                            .workplace_new = workplace_new,
                            .workplace_free = workplace_free,
                            .first = first,
                            .breed = breed,
                            .write = write,
                            .weighs = true,
                            .parents_stay = true};
}
