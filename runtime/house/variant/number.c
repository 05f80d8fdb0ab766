/* Numbers of the houses on a plan: houses in a row from a number on, the house of a number, the number of a house. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/variant/furnish.h"
#include "runtime/house/variant/parts.h"

/* ---- houses from a number on */

typedef struct listing {
    mpz_t left, here; /* houses still to be passed over; houses with these faces */
    tn_house_each *each;
    void *context;
    bool passing; /* the first house is still to be found */
} listing;

/* Passes over a part of the houses, if the first that is wanted is not among them. */
static void pass_over(tn_house_variants *v, void *context, tn_house_part part, const tn_house_counts *counts,
                      bool *taken)
{
    listing *list = context;
    (void)v;
    (void)part;
    *taken = mpz_cmp(list->left, counts->houses) >= 0;
    if (*taken)
        mpz_sub(list->left, list->left, counts->houses);
}

/* Gives the houses with these faces out, from the `left`-th combination of tiles on. */
static tn_status give_tiles(tn_house_variants *v, void *context, bool *stop, tn_error *error)
{
    listing *list = context;
    tn_furnished_count(v, list->here);
    if (mpz_cmp(list->left, list->here) >= 0) {
        mpz_sub(list->left, list->left, list->here);
        return TN_OK;
    }
    tn_furnished_find(v, list->left);
    mpz_set_ui(list->left, 0);
    tn_status status;
    do {
        list->passing = false;
        v->work = v->work_limit; /* there is a limit on the way to a house, none on how many there are */
        status = list->each(list->context, &v->house, stop, error);
    } while (status == TN_OK && !*stop && tn_furnished_next(v));
    return status;
}

tn_status tn_house_variants_each(tn_house_variants *v, const tn_tray *trays, size_t length, const mpz_t from,
                                 tn_house_each *each, void *context, tn_error *error)
{
    listing list = {.each = each, .context = context, .passing = true};
    const tn_house_visitor visitor = {
        .by_faces = &list.passing, .count = pass_over, .visit = give_tiles, .context = &list};
    mpz_init_set(list.left, from);
    mpz_init(list.here);
    tn_status status = tn_variants_go_through(v, trays, length, &visitor, error);
    mpz_clears(list.left, list.here, NULL);
    return status;
}

static tn_status stop_at_once(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    (void)house;
    (void)error;
    *stop = *(bool *)context = true;
    return TN_OK;
}

tn_status tn_house_variants_too_few(const mpz_t houses, tn_error *error)
{
    if (mpz_sgn(houses) == 0) {
        tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library has no house on this plan");
        tn_error_help(
            error,
            "`tartan explain` with --library and this plan says why, and `tartan sample` draws houses that are there");
        return TN_INVALID;
    }
    char *digits = mpz_get_str(NULL, 10, houses);
    tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "this plan has only %.80s houses in the library",
                               digits ? digits : "some of these");
    if (digits)
        tn_error_help(error, "its houses have the numbers from 0 on, less than %.80s", digits);
    free(digits);
    return status;
}

tn_status tn_house_variants_no_house(tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not keep this house");
    tn_error_help(error, "`tartan explain` says which clauses drop it");
    return status;
}

/* The house at hand becomes the caller's. */
static void give_away(tn_house_variants *v, tn_house *house)
{
    *house = v->house;
    house->known = NULL;
    v->house = (tn_house){0};
}

tn_status tn_house_variants_at(tn_house_variants *v, const tn_tray *trays, size_t length, const mpz_t variant,
                               tn_house *house, tn_error *error)
{
    bool found = false;
    *house = (tn_house){0};
    tn_status status = tn_house_variants_each(v, trays, length, variant, stop_at_once, &found, error);
    if (status != TN_OK)
        return status;
    if (found) {
        give_away(v, house);
        return TN_OK;
    }
    tn_house_counts counts;
    tn_house_counts_init(&counts);
    status = tn_house_variants_count(v, trays, length, &counts, error);
    if (status == TN_OK)
        status = tn_house_variants_too_few(counts.houses, error);
    tn_house_counts_clear(&counts);
    return status;
}

/* The combinations of tiles of the house, whose faces are all set. */
static tn_status furnish(tn_house_variants *v, const tn_house *house, tn_error *error)
{
    bool fit = false;
    tn_status status = tn_variants_take(v, house, error);
    if (status == TN_OK)
        status = tn_variants_count_tiles(v, &fit, error);
    if (status == TN_OK && !fit)
        status = tn_house_variants_no_house(error);
    return status == TN_OK ? tn_furnish(v, error) : status;
}

tn_status tn_house_variants_furnish(tn_house_variants *v, const tn_house *like, const mpz_t number, tn_house *house,
                                    tn_error *error)
{
    *house = (tn_house){0};
    tn_status status = furnish(v, like, error);
    if (status != TN_OK)
        return status;
    mpz_t count;
    mpz_init(count);
    tn_furnished_count(v, count);
    if (mpz_cmp(number, count) < 0) {
        tn_furnished_find(v, number);
        give_away(v, house);
    } else {
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the houses with the same faces were counted wrong");
    }
    mpz_clear(count);
    return status;
}

tn_status tn_house_variants_furnished(tn_house_variants *v, const tn_house *house, mpz_t number, tn_error *error)
{
    tn_status status = furnish(v, house, error);
    if (status != TN_OK)
        return status;
    tn_furnished_before(v, house, number);
    return tn_house_variants_keep_tiles(v, house) ? TN_OK : tn_house_variants_no_house(error);
}

tn_status tn_house_variants_faced(tn_house_variants *v, const tn_house *like, tn_house_faced *faced, void *context,
                                  tn_error *error)
{
    tn_status status = furnish(v, like, error);
    return status == TN_OK ? faced(context, &v->house, v->tiles, error) : status;
}

tn_status tn_house_variants_tiles_from(tn_house_variants *v, const tn_house *house, tn_house_each *each, void *context,
                                       tn_error *error)
{
    bool stop = false;
    tn_status status = furnish(v, house, error);
    for (size_t i = 0; status == TN_OK && i < house->cell_count; i++)
        v->house.cells[i].variant = house->cells[i].variant;
    for (bool more = true; status == TN_OK && !stop && more; more = !stop && tn_furnished_next(v))
        status = each(context, &v->house, &stop, error);
    return status;
}

/* ---- the number of a house */

typedef struct seeking {
    mpz_t before, here;
    const tn_house *wanted;
    bool passing; /* it is still to be found */
} seeking;

static bool same_section(const tn_house *a, const tn_house *b)
{
    return memcmp(a->shapes, b->shapes, sizeof a->shapes) == 0;
}

static bool same_functions(const tn_house *a, const tn_house *b)
{
    bool same = a->cell_count == b->cell_count && a->face_count == b->face_count;
    for (size_t i = 0; same && i < a->cell_count; i++)
        same = a->cells[i].function == b->cells[i].function;
    return same;
}

/* In the faces that are set. */
static bool same_faces(const tn_house_variants *v, const tn_house *wanted)
{
    bool same = true;
    for (size_t i = 0; same && i < v->faces_set; i++)
        same = tn_wheel_chosen(&v->faces, i) == wanted->faces[v->faces.items[i].of].kind;
    return same;
}

/* Counts a part of the houses at once, if the wanted one is not among them. */
static void count_over(tn_house_variants *v, void *context, tn_house_part part, const tn_house_counts *counts,
                       bool *taken)
{
    seeking *s = context;
    *taken = part == PART_SECTION     ? !same_section(&v->house, s->wanted)
             : part == PART_FUNCTIONS ? !same_functions(&v->house, s->wanted)
                                      : !same_faces(v, s->wanted);
    if (*taken)
        mpz_add(s->before, s->before, counts->houses);
}

static tn_status stop_here(tn_house_variants *v, void *context, bool *stop, tn_error *error)
{
    seeking *s = context;
    (void)error;
    tn_furnished_before(v, s->wanted, s->here);
    mpz_add(s->before, s->before, s->here);
    s->passing = !tn_house_variants_keep_tiles(v, s->wanted);
    *stop = true;
    return TN_OK;
}

tn_status tn_house_variants_rank(tn_house_variants *v, const tn_house *house, mpz_t variant, tn_error *error)
{
    seeking s = {.wanted = house, .passing = true};
    const tn_house_visitor visitor = {.by_faces = &s.passing, .count = count_over, .visit = stop_here, .context = &s};
    mpz_inits(s.before, s.here, NULL);
    tn_status status = tn_variants_go_through(v, house->trays, house->length, &visitor, error);
    mpz_set(variant, s.before);
    if (status == TN_OK && s.passing)
        status = tn_house_variants_no_house(error);
    mpz_clears(s.before, s.here, NULL);
    return status;
}
