/* Goes through the houses on one plan: sections, functions, faces, each like the wheels of a counter. */
#include "runtime/house/variant/variant.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/variant/stage.h"

/* A wheel of the counter: a cell's functions or a face's kinds, and which of them is set. */
typedef struct wheel {
    uint32_t of; /* a cell or a face */
    uint32_t first, count, at;
} wheel;

typedef struct wheels {
    wheel *items;
    uint32_t *choices; /* of all wheels, one after another */
    size_t count, room, choice_count, choice_room;
} wheels;

struct tn_house_variants {
    const tn_house_form *form;
    const tn_house_library_record *library;
    tn_house_rules *rules;
    tn_clause_stage *stages; /* of each clause: when it can be asked */
    uint64_t work_limit, work;
    tn_house house;
    wheels functions, faces;
    size_t *tiles; /* how many fit in each cell; 1 where it has none */
    size_t tile_room;
};

/* Who looks at each house without tiles. *stop ends the going through. */
typedef struct visitor {
    tn_status (*visit)(tn_house_variants *v, void *context, bool *stop, tn_error *error);
    void *context;
    bool *zoned; /* set where the functions at hand have a house: for counting */
} visitor;

/* ---- wheels */

static void clear_wheels(wheels *w)
{
    w->count = w->choice_count = 0;
}

static tn_status add_wheel(wheels *w, uint32_t of, const uint32_t *choices, uint32_t count, tn_error *error)
{
    if (!tn_array_reserve(&w->items, &w->room, w->count, 1, sizeof *w->items) ||
        !tn_array_reserve(&w->choices, &w->choice_room, w->choice_count, count, sizeof *w->choices))
        return tn_fail_memory(error);
    w->items[w->count++] = (wheel){.of = of, .first = (uint32_t)w->choice_count, .count = count};
    memcpy(w->choices + w->choice_count, choices, count * sizeof *choices);
    w->choice_count += count;
    return TN_OK;
}

static uint32_t chosen(const wheels *w, size_t i)
{
    return w->choices[w->items[i].first + w->items[i].at];
}

/* The last wheel turns first. False: all have come round. */
static bool turn(wheels *w)
{
    for (size_t i = w->count; i-- > 0;) {
        if (++w->items[i].at < w->items[i].count)
            return true;
        w->items[i].at = 0;
    }
    return false;
}

/* ---- clauses */

static tn_status spend(tn_house_variants *v, tn_error *error)
{
    if (v->work-- > 0)
        return TN_OK;
    v->work = 0;
    tn_fail(error, TN_LIMIT, E_VARIANTS, "the houses on this plan take more than %llu steps to go through",
            (unsigned long long)v->work_limit);
    tn_error_help(error, "leave fewer choices: require more of cells and sections, or take a shorter plan");
    return TN_LIMIT;
}

/* Do all clauses that can be asked at this stage, and not before, keep the house? */
static tn_status keeps(tn_house_variants *v, tn_clause_stage stage, bool *kept, tn_error *error)
{
    tn_status status = spend(v, error);
    bool asked = false;
    *kept = true;
    for (uint32_t i = 0; status == TN_OK && *kept && i < v->library->clause_count; i++) {
        bool drops = false;
        if (v->stages[i] != stage)
            continue;
        if (!asked)
            status = tn_house_rules_start(v->rules, &v->house, error);
        asked = true;
        if (status == TN_OK)
            status = tn_house_rules_drop(v->rules, v->library, i, &drops, error);
        *kept = !drops;
    }
    return status;
}

/* ---- tiles */

static tn_status count_tiles(tn_house_variants *v, bool *fit, tn_error *error)
{
    tn_status status = TN_OK;
    *fit = true;
    for (uint32_t i = 0; status == TN_OK && *fit && i < v->house.cell_count; i++) {
        tn_variants tiles;
        status = tn_tile_variants(&v->house, i, &tiles, error);
        v->tiles[i] = tiles.wanted ? tiles.count : 1;
        *fit = v->tiles[i] > 0;
        tn_variants_clear(&tiles);
    }
    return status;
}

/* ---- stages */

static tn_status set_faces(tn_house_variants *v, tn_error *error)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    tn_status status = TN_OK;
    clear_wheels(&v->faces);
    for (uint32_t i = 0; status == TN_OK && i < v->house.face_count; i++) {
        size_t count = tn_face_options(&v->house, &v->house.faces[i], kinds);
        v->house.faces[i].kind = kinds[0];
        if (count > 1)
            status = add_wheel(&v->faces, i, kinds, (uint32_t)count, error);
    }
    return status;
}

static tn_status go_through_faces(tn_house_variants *v, const visitor *seen_by, bool *stop, tn_error *error)
{
    bool kept = false, fit = false;
    tn_status status = keeps(v, TN_STAGE_FUNCTIONS, &kept, error);
    if (status == TN_OK && kept)
        status = set_faces(v, error);
    if (status != TN_OK || !kept)
        return status;
    do {
        for (size_t i = 0; i < v->faces.count; i++)
            v->house.faces[v->faces.items[i].of].kind = chosen(&v->faces, i);
        status = keeps(v, TN_STAGE_FACES, &kept, error);
        if (status == TN_OK && kept)
            status = count_tiles(v, &fit, error);
        if (status == TN_OK && kept && fit)
            status = seen_by->visit(v, seen_by->context, stop, error);
    } while (status == TN_OK && !*stop && turn(&v->faces));
    return status;
}

/* A wheel for each cell; *possible: is there a function for each? */
static tn_status set_functions(tn_house_variants *v, bool *possible, tn_error *error)
{
    uint32_t functions[TN_CELL_RULES_MAX];
    tn_status status = TN_OK;
    clear_wheels(&v->functions);
    *possible = true;
    for (uint32_t i = 0; status == TN_OK && *possible && i < v->house.cell_count; i++) {
        uint32_t count = 0;
        for (uint32_t f = 0; f < tn_form_functions(v->form); f++)
            if (tn_cell_may(&v->house, &v->house.cells[i], f))
                functions[count++] = f;
        *possible = count > 0 || v->house.cells[i].open;
        if (count > 0)
            status = add_wheel(&v->functions, i, functions, count, error);
    }
    return status;
}

static tn_status go_through_functions(tn_house_variants *v, const visitor *seen_by, bool *stop, tn_error *error)
{
    bool kept = false, possible = false;
    if (!tn_array_resize(&v->tiles, v->house.cell_count + 1, sizeof *v->tiles))
        return tn_fail_memory(error);
    tn_status status = keeps(v, TN_STAGE_SECTION, &kept, error);
    if (status == TN_OK && kept)
        status = set_functions(v, &possible, error);
    if (status != TN_OK || !kept || !possible)
        return status;
    do {
        for (size_t i = 0; i < v->functions.count; i++)
            v->house.cells[v->functions.items[i].of].function = chosen(&v->functions, i);
        if (seen_by->zoned)
            *seen_by->zoned = false;
        status = go_through_faces(v, seen_by, stop, error);
    } while (status == TN_OK && !*stop && turn(&v->functions));
    return status;
}

static bool next_section(const tn_house_form *form, uint32_t *shapes)
{
    for (uint32_t i = form->record->choice_count; i-- > 0;) {
        if (++shapes[i] < tn_form_choice(form, i)->shape_count)
            return true;
        shapes[i] = 0;
    }
    return false;
}

static tn_status go_through(tn_house_variants *v, const tn_tray *trays, size_t length, const visitor *seen_by,
                            tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    bool stop = false;
    tn_status status;
    v->work = v->work_limit;
    do {
        tn_house_clear(&v->house);
        status = tn_house_stand(v->form, trays, length, shapes, &v->house, error);
        if (status == TN_OK && tn_house_section_stands(&v->house))
            status = go_through_functions(v, seen_by, &stop, error);
    } while (status == TN_OK && !stop && next_section(v->form, shapes));
    return status;
}

/* ---- what is asked of them */

static void multiply_tiles(const tn_house_variants *v, mpz_t product)
{
    mpz_set_ui(product, 1);
    for (size_t i = 0; i < v->house.cell_count; i++)
        mpz_mul_ui(product, product, v->tiles[i]);
}

typedef struct counting {
    tn_house_counts *counts;
    mpz_t here;
    bool zoned; /* are the functions at hand counted? */
} counting;

static tn_status count_one(tn_house_variants *v, void *context, bool *stop, tn_error *error)
{
    counting *c = context;
    (void)stop;
    (void)error;
    c->counts->zoned += !c->zoned;
    c->counts->faced++;
    c->zoned = true;
    multiply_tiles(v, c->here);
    mpz_add(c->counts->houses, c->counts->houses, c->here);
    return TN_OK;
}

tn_status tn_house_variants_count(tn_house_variants *v, const tn_tray *trays, size_t length, tn_house_counts *counts,
                                  tn_error *error)
{
    counting c = {.counts = counts};
    mpz_init(c.here);
    tn_status status =
        go_through(v, trays, length, &(visitor){.visit = count_one, .context = &c, .zoned = &c.zoned}, error);
    mpz_clear(c.here);
    return status;
}

typedef struct seeking {
    mpz_t left, here;
    const tn_house *wanted; /* for a rank; NULL: the house at `left` */
    bool found;
} seeking;

/* Which tile each cell has, of the `left`-th combination: the last cell's changes first. */
static tn_status stop_at(tn_house_variants *v, void *context, bool *stop, tn_error *error)
{
    seeking *s = context;
    (void)error;
    multiply_tiles(v, s->here);
    if (mpz_cmp(s->left, s->here) >= 0) {
        mpz_sub(s->left, s->left, s->here);
        return TN_OK;
    }
    for (size_t i = v->house.cell_count; i-- > 0;)
        v->house.cells[i].variant = mpz_fdiv_q_ui(s->left, s->left, v->tiles[i]);
    *stop = s->found = true;
    return TN_OK;
}

static bool same_choices(const tn_house *a, const tn_house *b)
{
    bool same = memcmp(a->shapes, b->shapes, sizeof a->shapes) == 0 && a->cell_count == b->cell_count &&
                a->face_count == b->face_count;
    for (size_t i = 0; same && i < a->cell_count; i++)
        same = a->cells[i].function == b->cells[i].function;
    for (size_t i = 0; same && i < a->face_count; i++)
        same = a->faces[i].kind == b->faces[i].kind;
    return same;
}

static tn_status stop_here(tn_house_variants *v, void *context, bool *stop, tn_error *error)
{
    seeking *s = context;
    (void)error;
    multiply_tiles(v, s->here);
    if (!same_choices(&v->house, s->wanted)) {
        mpz_add(s->left, s->left, s->here);
        return TN_OK;
    }
    mpz_set_ui(s->here, 0);
    for (size_t i = 0; i < v->house.cell_count; i++) {
        mpz_mul_ui(s->here, s->here, v->tiles[i]);
        mpz_add_ui(s->here, s->here, s->wanted->cells[i].variant);
    }
    mpz_add(s->left, s->left, s->here);
    *stop = s->found = true;
    return TN_OK;
}

tn_status tn_house_variants_at(tn_house_variants *v, const tn_tray *trays, size_t length, const mpz_t variant,
                               tn_house *house, tn_error *error)
{
    seeking s = {0};
    *house = (tn_house){0};
    mpz_init_set(s.left, variant);
    mpz_init(s.here);
    tn_status status = go_through(v, trays, length, &(visitor){.visit = stop_at, .context = &s}, error);
    if (status == TN_OK && s.found) {
        *house = v->house;
        v->house = (tn_house){0};
    } else if (status == TN_OK) {
        mpz_sub(s.here, variant, s.left);
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "there are fewer houses than that on this plan");
        char *digits = mpz_get_str(NULL, 10, s.here);
        tn_error_help(error, "it has %.80s: variants count from 0", digits ? digits : "fewer");
        free(digits);
    }
    mpz_clears(s.left, s.here, NULL);
    return status;
}

tn_status tn_house_variants_rank(tn_house_variants *v, const tn_house *house, mpz_t variant, tn_error *error)
{
    seeking s = {.wanted = house};
    mpz_inits(s.left, s.here, NULL);
    tn_status status = go_through(v, house->trays, house->length, &(visitor){.visit = stop_here, .context = &s}, error);
    mpz_set(variant, s.left);
    if (status == TN_OK && !s.found) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not keep this house");
        tn_error_help(error, "`tartan explain` says which clauses drop it");
    }
    mpz_clears(s.left, s.here, NULL);
    return status;
}

/* ---- making */

tn_status tn_house_variants_new(const tn_house_form *form, const tn_house_library_record *library, uint64_t work,
                                tn_house_variants **out, tn_error *error)
{
    tn_house_variants *v = *out = calloc(1, sizeof *v);
    if (!v)
        return tn_fail_memory(error);
    *v = (tn_house_variants){.form = form, .library = library, .work_limit = work > 0 ? work : TN_VARIANT_WORK_DEFAULT};
    v->stages = calloc((size_t)library->clause_count + 1, sizeof *v->stages);
    tn_status status = v->stages ? tn_clause_stages(form, library, v->stages, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_house_rules_new(form, 0, &v->rules, error);
    if (status != TN_OK) {
        tn_house_variants_free(v);
        *out = NULL;
    }
    return status;
}

void tn_house_variants_free(tn_house_variants *v)
{
    if (!v)
        return;
    tn_house_rules_free(v->rules);
    tn_house_clear(&v->house);
    free(v->functions.items);
    free(v->functions.choices);
    free(v->faces.items);
    free(v->faces.choices);
    free(v->stages);
    free(v->tiles);
    free(v);
}

void tn_house_counts_init(tn_house_counts *counts)
{
    counts->zoned = counts->faced = 0;
    mpz_init(counts->houses);
}

void tn_house_counts_clear(tn_house_counts *counts)
{
    mpz_clear(counts->houses);
}
