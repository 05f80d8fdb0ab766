/* Draws plans on the line of their masses, without those drawn before. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"
#include "runtime/plan/measure/likelihood_data.h"

/* ---- what was drawn: stretches of the line, in a tree
 *
 * A treap (Seidel, Aragon: Randomized search trees, 1996): a search tree by the stretches' places, and a heap by
 * numbers that look random. So it is low whatever is drawn. */

#define NOTHING UINT32_MAX

typedef struct stretch {
    mpz_t begin, size;
    mpz_t below; /* the sizes of this one and of those under it */
    uint32_t left, right;
} stretch;

typedef struct stretches {
    stretch *items;
    uint32_t count, root;
} stretches;

static void add_up(stretches *tree, uint32_t i)
{
    stretch *s = &tree->items[i];
    mpz_set(s->below, s->size);
    if (s->left != NOTHING)
        mpz_add(s->below, s->below, tree->items[s->left].below);
    if (s->right != NOTHING)
        mpz_add(s->below, s->below, tree->items[s->right].below);
}

/* Parts what is under `root` into those before a place and those behind it. As deep as the tree. */
static void part(stretches *tree, uint32_t root, const mpz_t place, uint32_t *left, uint32_t *right)
{
    *left = *right = NOTHING;
    if (root == NOTHING)
        return;
    stretch *s = &tree->items[root];
    if (mpz_cmp(s->begin, place) < 0) {
        *left = root;
        part(tree, s->right, place, &s->right, right);
    } else {
        *right = root;
        part(tree, s->left, place, left, &s->left);
    }
    add_up(tree, root);
}

/* Adds item i under `root`; returns the root after that. As deep as the tree. */
static uint32_t add(stretches *tree, uint32_t root, uint32_t i)
{
    if (root == NOTHING || tn_mix64(i) > tn_mix64(root)) {
        part(tree, root, tree->items[i].begin, &tree->items[i].left, &tree->items[i].right);
        add_up(tree, i);
        return i;
    }
    stretch *s = &tree->items[root];
    if (mpz_cmp(tree->items[i].begin, s->begin) < 0)
        s->left = add(tree, s->left, i);
    else
        s->right = add(tree, s->right, i);
    add_up(tree, root);
    return root;
}

/* From a place on the line without the stretches to the same place on the whole line. */
static void find(const stretches *tree, mpz_t place)
{
    mpz_t before, begin;
    mpz_inits(before, begin, NULL); /* before: the sizes of stretches before what is looked at */
    for (uint32_t i = tree->root; i != NOTHING;) {
        const stretch *s = &tree->items[i];
        mpz_sub(begin, s->begin, before);
        if (s->left != NOTHING)
            mpz_sub(begin, begin, tree->items[s->left].below);
        if (mpz_cmp(place, begin) < 0) {
            i = s->left;
            continue;
        }
        mpz_add(before, before, s->size);
        if (s->left != NOTHING)
            mpz_add(before, before, tree->items[s->left].below);
        i = s->right;
    }
    mpz_add(place, place, before);
    mpz_clears(before, begin, NULL);
}

static bool make_room(stretches *tree, size_t count)
{
    *tree = (stretches){.items = calloc(count + 1, sizeof *tree->items), .root = NOTHING};
    return tree->items != NULL;
}

static stretch *next(stretches *tree)
{
    stretch *s = &tree->items[tree->count++];
    s->left = s->right = NOTHING;
    mpz_inits(s->begin, s->size, s->below, NULL);
    return s;
}

static void clear(stretches *tree)
{
    for (uint32_t i = 0; i < tree->count; i++)
        mpz_clears(tree->items[i].begin, tree->items[i].size, tree->items[i].below, NULL);
    free(tree->items);
}

/* ---- drawing */

/* A tray of the plan: what lies before it on the line of the plans that begin alike, and what multiplies the rest. */
typedef struct step {
    mpz_t before;
    uint32_t factor;
} step;

typedef struct drawing {
    const tn_likelihood *likelihood;
    uint64_t seed, stream, words; /* words: random ones taken so far */
    mpz_t first, all;             /* the stretch of the line that is drawn on: where it begins, and its size */
    stretches drawn;
    step *steps;    /* [max + 1] */
    tn_tray *trays; /* [max + 1] */
    mpz_t mass, part, scale, place;
} drawing;

static bool drawing_make(drawing *d, size_t count)
{
    size_t trays = (size_t)d->likelihood->library->max + 1;
    mpz_inits(d->first, d->all, d->mass, d->part, d->scale, d->place, NULL);
    d->steps = calloc(trays, sizeof *d->steps);
    d->trays = calloc(trays, sizeof *d->trays);
    for (size_t i = 0; d->steps && i < trays; i++)
        mpz_init(d->steps[i].before);
    return make_room(&d->drawn, count) && d->steps && d->trays;
}

static void drawing_clear(drawing *d)
{
    for (size_t i = 0; d->steps && i <= d->likelihood->library->max; i++)
        mpz_clear(d->steps[i].before);
    mpz_clears(d->first, d->all, d->mass, d->part, d->scale, d->place, NULL);
    free(d->steps);
    free(d->trays);
    clear(&d->drawn);
}

/* d->place := a number below the bound, each as likely as each: cut to the bound's bits, and thrown away past it. */
static void draw_below(drawing *d, const mpz_t bound)
{
    size_t bits = mpz_sizeinbase(bound, 2), limbs = (bits + 63) / 64;
    do {
        mp_limb_t *words = mpz_limbs_write(d->place, (mp_size_t)limbs);
        for (size_t i = 0; i < limbs; i++)
            words[i] = tn_random64(d->seed, d->stream, d->words++);
        words[limbs - 1] >>= limbs * 64 - bits;
        mpz_limbs_finish(d->place, (mp_size_t)limbs);
    } while (mpz_cmp(d->place, bound) >= 0);
}

/* The length of the plan at d->place of the line of all, by halving. */
static uint32_t find_length(const drawing *d)
{
    const tn_likelihood *l = d->likelihood;
    uint32_t low = l->library->min, high = l->library->max + 1; /* lengths[low] <= place < lengths[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(l->lengths[middle], d->place) <= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Goes by the edge in which d->place lies, on the line of the plans with `left` trays to come; d->place is then that on
 * the line of its target's. Returns the target. */
static uint32_t follow(drawing *d, uint32_t state, uint32_t left, step *to, tn_tray *tray)
{
    const tn_likelihood *l = d->likelihood;
    size_t e = l->first[state];
    mpz_set_ui(to->before, 0);
    for (;; e++) {
        const tn_likely_edge *edge = &l->edges[e];
        if (!tn_weighed_alive(l->weighed, left - 1, edge->target))
            continue;
        mpz_set(d->part, tn_likely_mass(l, left - 1, edge->target));
        tn_likely_apply(l, edge->factor, d->part);
        mpz_mul(d->mass, d->part, l->letter[edge->letter]);
        if (mpz_cmp(d->place, d->mass) < 0)
            break;
        mpz_sub(d->place, d->place, d->mass);
        mpz_add(to->before, to->before, d->mass);
    }
    const tn_likely_edge *edge = &l->edges[e];
    uint32_t low = l->letter_first[edge->letter], high = l->letter_first[edge->letter + 1];
    mpz_fdiv_q(d->mass, d->place, d->part); /* before[low] <= mass < before[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(l->before[middle], d->mass) <= 0)
            low = middle;
        else
            high = middle;
    }
    *tray = l->trays[low];
    to->factor = edge->factor;
    mpz_submul(d->place, d->part, l->before[low]);
    mpz_addmul(to->before, d->part, l->before[low]);
    mpz_mul(d->place, d->place, l->factors[edge->factor].down);
    mpz_mul(d->mass, tn_likely_alone(l, *tray), l->factors[edge->factor].up);
    mpz_fdiv_q(d->place, d->place, d->mass);
    return edge->target;
}

/* The plan at d->place of the line of all, and its stretch there. Returns its length. */
static uint32_t find_plan(drawing *d, stretch *found)
{
    const tn_likelihood *l = d->likelihood;
    uint32_t length = find_length(d), state = 0;
    mpz_sub(d->place, d->place, l->lengths[length]);
    tn_likely_scale(l, length, d->scale);
    mpz_fdiv_q(d->place, d->place, d->scale);
    for (uint32_t i = 0; i < length; i++)
        state = follow(d, state, length - i, &d->steps[i], &d->trays[i]);
    mpz_set_ui(found->begin, 0);
    mpz_set(found->size, tn_likely_mass(l, 0, state));
    for (uint32_t i = length; i-- > 0;) {
        mpz_srcptr alone = tn_likely_alone(l, d->trays[i]);
        mpz_mul(found->begin, found->begin, alone);
        tn_likely_apply(l, d->steps[i].factor, found->begin);
        mpz_add(found->begin, found->begin, d->steps[i].before);
        mpz_mul(found->size, found->size, alone);
        tn_likely_apply(l, d->steps[i].factor, found->size);
    }
    mpz_mul(found->begin, found->begin, d->scale);
    mpz_mul(found->size, found->size, d->scale);
    mpz_add(found->begin, found->begin, l->lengths[length]);
    return length;
}

tn_status tn_likely_plan(const tn_likelihood *l, const mpz_t place, tn_tray *trays, uint32_t *length, mpz_t begin,
                         mpz_t size, tn_error *error)
{
    drawing d = {.likelihood = l};
    tn_status status = drawing_make(&d, 1) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        stretch *found = next(&d.drawn);
        mpz_set(d.place, place);
        *length = find_plan(&d, found);
        memcpy(trays, d.trays, *length * sizeof *trays);
        mpz_set(begin, found->begin);
        mpz_set(size, found->size);
    }
    drawing_clear(&d);
    return status;
}

static tn_status draw(drawing *d, mpz_t rank, tn_error *error)
{
    const tn_library *library = d->likelihood->library;
    stretch *drawn = next(&d->drawn);
    draw_below(d, d->all);
    find(&d->drawn, d->place);
    mpz_add(d->place, d->place, d->first);
    uint32_t length = find_plan(d, drawn);
    mpz_sub(drawn->begin, drawn->begin, d->first);
    mpz_sub(d->all, d->all, drawn->size);
    d->drawn.root = add(&d->drawn, d->drawn.root, d->drawn.count - 1);
    return tn_library_rank(library, d->trays, length, rank)
               ? TN_OK
               : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan that was drawn is not in the library");
}

static int compare(const void *a, const void *b)
{
    mpz_srcptr x = a, y = b;
    return mpz_cmp(x, y);
}

static tn_status draw_all(const tn_likelihood *l, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                          tn_error *error)
{
    drawing d = {.likelihood = l, .seed = seed, .stream = length};
    tn_status status = drawing_make(&d, count) ? TN_OK : tn_fail_memory(error);
    bool one = length != TN_ALL_LENGTHS;
    if (status == TN_OK && one)
        mpz_set(d.first, l->lengths[length]);
    if (status == TN_OK)
        mpz_sub(d.all, l->lengths[one ? length + 1 : l->library->max + 1], d.first);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_weighed_check(l->weighed, error);
        if (status == TN_OK)
            status = draw(&d, ranks[i], error);
    }
    drawing_clear(&d);
    if (status == TN_OK)
        qsort(ranks, count, sizeof *ranks, compare);
    return status;
}

tn_status tn_likelihood_sample(const tn_likelihood *l, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                               size_t *found, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(l->library, length, kept);
    bool all = mpz_cmp_ui(kept, count) <= 0;
    mpz_clear(kept);
    if (all || count == 0)
        return tn_library_sample(l->library, seed, length, count, ranks, found, error);
    *found = count;
    return draw_all(l, seed, length, count, ranks, error);
}
