/* Lists of boxes as genomes: a split keeps the room that a box takes and the plane that clips it, children have each
 * box of their parents once, genes stay in their ranges and on their steps, and what is written are those genes. */
#include <math.h>
#include <stdio.h>

#include "runtime/base/bytes.h"
#include "runtime/genome/boxes/box_kind.h"
#include "runtime/module/values.h"
#include "tests/support/test_grammar.h"

enum { GENES = TN_BOX_GENES };

static tn_box_breeding ranges(void)
{
    return (tn_box_breeding){.low = {-6, 0, -4, 0.5, 0.5, 0.5, -5, -180, -90},
                             .high = {6, 7, 4, 7, 7, 7, 5, 180, 90},
                             .least = 2,
                             .most = 6,
                             .mutation_rate = 0.2,
                             .split = 0.3,
                             .delete_ = 0.3,
                             .head = "solid bred {\n",
                             .foot = "}\n"};
}

static double gene(const tn_genome *genome, size_t box, size_t k)
{
    return tn_double_of(genome->codons[box * GENES + k]);
}

static long steps(double value)
{
    double whole = value * TN_GENE_STEPS;
    assert_true(fabs(whole - nearbyint(whole)) < 1e-6);
    return lround(whole);
}

static void random_design(const tn_genome_kind *kind, void *place, uint64_t number, tn_genome *genome)
{
    tn_chance chance = tn_chance_for(5, TN_PURPOSE_INITIALISE, 0, number);
    tn_birth birth;
    assert_int_equal(kind->first(place, number, &chance, genome, &birth, NULL), TN_OK);
}

static void check_ranges(const tn_box_breeding *of, const tn_genome *genome)
{
    assert_int_equal(genome->count % GENES, 0);
    assert_in_range(genome->count / GENES, of->least, of->most);
    for (size_t box = 0; box < genome->count / GENES; box++)
        for (size_t k = 0; k < 6; k++) {
            double value = gene(genome, box, k);
            assert_true(value >= of->low[k] - 2 && value <= of->high[k] + 2); /* splits move centres outward */
            assert_true(steps(value) % (k < 3 ? 1 : 2) == 0);
        }
}

static void test_split(void **state)
{
    (void)state;
    tn_box_breeding of = ranges();
    tn_genome_kind kind = tn_box_kind(&of);
    void *place = kind.workplace_new(&of);
    for (uint64_t i = 0; i < 2000; i++) {
        tn_genome genome = {0};
        int axis = (int)(i % 3);
        random_design(&kind, place, i, &genome);
        size_t last = genome.count / GENES;
        double before[GENES], normal[3];
        for (size_t k = 0; k < GENES; k++)
            before[k] = gene(&genome, 1, k);
        assert_true(tn_box_split(&genome, 1, axis));
        assert_int_equal(genome.count / GENES, last + 1);
        tn_normal_of_angles(before[7], before[8], normal);
        long low = 2 * steps(before[axis]) - steps(before[3 + axis]), high = low + 2 * steps(before[3 + axis]);
        const size_t halves[] = {1, last};
        long ends[4];
        for (size_t h = 0; h < 2; h++) {
            long centre = 2 * steps(gene(&genome, halves[h], (size_t)axis)),
                 size = steps(gene(&genome, halves[h], 3 + (size_t)axis));
            ends[2 * h] = centre - size;
            ends[2 * h + 1] = centre + size;
            double shift = gene(&genome, halves[h], (size_t)axis) - before[axis];
            assert_true(fabs(gene(&genome, halves[h], 6) - (before[6] - normal[axis] * shift)) < 1e-12);
        }
        assert_int_equal(ends[0], low);
        assert_int_equal(ends[1], ends[2]);
        assert_int_equal(ends[3], high);
        tn_genome_clear(&genome);
    }
    kind.workplace_free(place);
}

/* A box of a child, by its genes, is one of the parents'. */
static bool has_box(const tn_genome *genome, const uint64_t *box)
{
    for (size_t i = 0; i < genome->count; i += GENES)
        if (memcmp(genome->codons + i, box, GENES * sizeof *box) == 0)
            return true;
    return false;
}

static void test_crossing(void **state)
{
    (void)state;
    tn_box_breeding of = ranges();
    of.mutation_rate = of.split = of.delete_ = 0;
    tn_genome_kind kind = tn_box_kind(&of);
    void *place = kind.workplace_new(&of);
    size_t cut = 0, boxes = 0;
    for (uint64_t i = 0; i < 1000; i++) {
        tn_genome from[2] = {{0}, {0}}, to[2] = {{0}, {0}}, *children[2] = {&to[0], &to[1]};
        random_design(&kind, place, 2 * i, &from[0]);
        random_design(&kind, place, 2 * i + 1, &from[1]);
        tn_parent parents[2] = {{&from[0], 0, 1}, {&from[1], 0, 0.4}};
        tn_chance chance = tn_chance_for(6, TN_PURPOSE_BIRTH, 0, i);
        uint8_t kinds[2];
        assert_int_equal(kind.breed(place, &chance, parents, children, kinds, NULL), TN_OK);
        assert_int_equal(to[0].count + to[1].count, from[0].count + from[1].count);
        for (int c = 0; c < 2; c++) {
            check_ranges(&of, &to[c]);
            for (size_t at = 0; at < to[c].count; at += GENES, boxes++)
                cut += !has_box(&from[0], to[c].codons + at) && !has_box(&from[1], to[c].codons + at);
        }
        for (int c = 0; c < 2; c++) {
            tn_genome_clear(&from[c]);
            tn_genome_clear(&to[c]);
        }
    }
    assert_in_range(cut, 850, 1150); /* every other crossing cuts a box of each child */
    assert_true(boxes > 6000);
    kind.workplace_free(place);
}

static void test_mutation(void **state)
{
    (void)state;
    tn_box_breeding of = ranges();
    tn_genome_kind kind = tn_box_kind(&of);
    void *place = kind.workplace_new(&of);
    size_t mutated = 0;
    for (uint64_t i = 0; i < 1000; i++) {
        tn_genome from[2] = {{0}, {0}}, to[2] = {{0}, {0}}, *children[2] = {&to[0], &to[1]};
        random_design(&kind, place, 2 * i, &from[0]);
        random_design(&kind, place, 2 * i + 1, &from[1]);
        tn_parent parents[2] = {{&from[0], 0, 1}, {&from[1], 0, 1}};
        tn_chance chance = tn_chance_for(6, TN_PURPOSE_BIRTH, 1, i);
        uint8_t kinds[2];
        assert_int_equal(kind.breed(place, &chance, parents, children, kinds, NULL), TN_OK);
        for (int c = 0; c < 2; c++) {
            check_ranges(&of, &to[c]);
            mutated += kinds[c] == TN_BIRTH_CROSSED + TN_BIRTH_MUTATED;
            tn_genome_clear(&from[c]);
            tn_genome_clear(&to[c]);
        }
    }
    assert_true(mutated > 1900);
    kind.workplace_free(place);
}

static void test_text(void **state)
{
    (void)state;
    tn_box_breeding of = ranges();
    tn_genome_kind kind = tn_box_kind(&of);
    void *place = kind.workplace_new(&of);
    for (uint64_t i = 0; i < 500; i++) {
        tn_genome genome = {0};
        tn_written written;
        random_design(&kind, place, i, &genome);
        assert_true(tn_box_split(&genome, 0, 1)); /* distances off the steps */
        assert_int_equal(kind.write(place, &genome, &written, NULL), TN_OK);
        assert_int_equal(strlen(written.sentence), written.size);
        const char *at = strstr(written.sentence, "genes (");
        for (size_t g = 0; g < genome.count; g++) {
            char *end;
            at += strcspn(at, "-0123456789");
            double value = strtod(at, &end);
            assert_memory_equal(&value, &genome.codons[g], sizeof value);
            at = end;
        }
        assert_string_equal(at + strcspn(at, "}"), "}\n");
        tn_genome_clear(&genome);
    }
    tn_genome none = {0};
    tn_written written;
    assert_int_equal(kind.write(place, &none, &written, NULL), TN_INVALID);
    kind.workplace_free(place);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_split),
        cmocka_unit_test(test_crossing),
        cmocka_unit_test(test_mutation),
        cmocka_unit_test(test_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
