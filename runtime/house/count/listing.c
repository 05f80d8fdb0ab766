/* Goes through the houses on one plan: sections, functions, faces, each like the wheels of a counter. */
#include "runtime/house/count/listing.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/section.h"
#include "runtime/house/form/form.h"
#include "runtime/house/rule/furnish.h"
#include "runtime/house/rule/stages.h"

/* A wheel of the counter: a cell's functions or a face's kinds, and which of them is set. */
typedef struct tn_wheel {
    uint32_t of; /* a cell or a face */
    uint32_t first, count, at;
} tn_wheel;

typedef struct tn_wheels {
    tn_wheel *items;
    uint32_t *choices; /* of all wheels, one after another */
    size_t count, room, choice_count, choice_room;
} tn_wheels;

/* Shown a house without its tiles, of which the furnisher knows the combinations: there are so many. */
typedef tn_status tn_listing_seen(tn_house_listing *listing, void *context, const mpz_t houses, bool *stop,
                                  tn_error *error);

struct tn_house_listing {
    const tn_house_form *form;
    const tn_house_library_record *library;
    tn_house_rules *rules;
    tn_clause_stage *stages; /* of each clause: when it can be asked */
    uint64_t work_limit, work;
    uint64_t step;  /* what a step takes of it: as much as the house is large */
    uint64_t *runs; /* of each clause, on the plan at hand: the dearest is named if the work is too much */
    tn_house house;
    tn_house_known known; /* of that house's cells */
    tn_wheels functions, faces;
    tn_furnisher *furnisher;
    tn_sections sections;
    mpz_t houses; /* with the functions and faces at hand */
    tn_listing_seen *listed;
    void *context;
};

/* ---- wheels */

static void clear_wheels(tn_wheels *w)
{
    w->count = w->choice_count = 0;
}

static tn_status add_wheel(tn_wheels *w, uint32_t of, const uint32_t *choices, uint32_t count, tn_error *error)
{
    if (!tn_array_reserve(&w->items, &w->room, w->count, 1, sizeof *w->items) ||
        !tn_array_reserve(&w->choices, &w->choice_room, w->choice_count, count, sizeof *w->choices))
        return tn_fail_memory(error);
    w->items[w->count++] = (tn_wheel){.of = of, .first = (uint32_t)w->choice_count, .count = count};
    memcpy(w->choices + w->choice_count, choices, count * sizeof *choices);
    w->choice_count += count;
    return TN_OK;
}

static uint32_t chosen(const tn_wheels *w, size_t i)
{
    return w->choices[w->items[i].first + w->items[i].at];
}

/* The last of the wheels turns first. False: all have come round. */
static bool turn(tn_wheels *w)
{
    for (size_t i = w->count; i-- > 0;) {
        if (++w->items[i].at < w->items[i].count)
            return true;
        w->items[i].at = 0;
    }
    return false;
}

/* ---- clauses */

/* The clause that was run most often; NULL if none was. */
static const tn_house_clause_record *dearest(const tn_house_listing *v)
{
    const tn_house_clause_record *clauses = v->form->module->HOUSE_CLAUSE_records + v->library->clause_first;
    uint64_t most = 0;
    const tn_house_clause_record *found = NULL;
    for (uint32_t i = 0; i < v->library->clause_count; i++) {
        if (v->runs[i] > most)
            found = &clauses[i];
        most = v->runs[i] > most ? v->runs[i] : most;
    }
    return found;
}

/* Takes steps of the work on a plan. */
static tn_status spend(tn_house_listing *v, uint64_t steps, tn_error *error)
{
    if (v->work >= steps * v->step) {
        v->work -= steps * v->step;
        return TN_OK;
    }
    v->work = 0;
    tn_fail(error, TN_LIMIT, E_VARIANTS, "the houses on this plan take more than %llu steps to go through",
            (unsigned long long)v->work_limit);
    const tn_house_clause_record *clause = dearest(v);
    if (clause)
        tn_error_help(
            error,
            "most of them ask `%.60s`: leave fewer choices (--where), or let it ask for cells instead of rooms "
            "and walks",
            tn_text(v->form->module, clause->name));
    else
        tn_error_help(error,
                      "leave fewer choices: require more of cells and options (--where), or take a shorter plan");
    return TN_LIMIT;
}

/* Runs a clause, on a house that the rules have started on or, the first time, start on now. */
static tn_status run_clause(tn_house_listing *v, uint32_t clause, bool *started, bool *drops, tn_error *error)
{
    tn_status status = *started ? TN_OK : tn_house_rules_start(v->rules, &v->house, error);
    *started = true;
    v->runs[clause]++;
    return status == TN_OK ? tn_house_rules_drop(v->rules, v->library, clause, drops, error) : status;
}

/* Do all clauses that can be asked at this stage, and not before, keep the house? */
static tn_status keep(tn_house_listing *v, tn_clause_stage stage, bool *kept, tn_error *error)
{
    tn_status status = spend(v, 1, error);
    bool started = false;
    *kept = true;
    for (uint32_t i = 0; status == TN_OK && *kept && i < v->library->clause_count; i++) {
        bool drops = false;
        if (v->stages[i] == stage)
            status = run_clause(v, i, &started, &drops, error);
        *kept = !drops;
    }
    return status;
}

/* ---- faces */

/* A wheel for each face that can have several kinds, all at their first. */
static tn_status set_faces(tn_house_listing *v, tn_error *error)
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

/* Shows the house, if it is kept with some tiles. */
static tn_status show(tn_house_listing *v, bool *stop, tn_error *error)
{
    enum { PRICING_STEPS = 100, WALKING_STEPS = 400 }; /* what a house costs takes as long as so many other steps */
    bool kept = false;
    tn_status status = keep(v, TN_STAGE_FACES, &kept, error);
    if (status == TN_OK && kept && tn_furnisher_prices(v->furnisher))
        status = spend(v, PRICING_STEPS, error);
    if (status != TN_OK || !kept)
        return status;
    status = tn_furnish(v->furnisher, &v->house, NULL, v->houses, error);
    if (status == TN_OK && tn_furnisher_walks(v->furnisher))
        status = spend(v, WALKING_STEPS * (1 + tn_furnisher_asked(v->furnisher)), error);
    return status == TN_OK && mpz_sgn(v->houses) > 0 ? v->listed(v, v->context, v->houses, stop, error) : status;
}

static tn_status go_through_faces(tn_house_listing *v, bool *stop, tn_error *error)
{
    bool kept = false;
    tn_status status = keep(v, TN_STAGE_FUNCTIONS, &kept, error);
    if (status == TN_OK && kept)
        status = set_faces(v, error);
    if (status != TN_OK || !kept)
        return status;
    do {
        for (size_t i = 0; i < v->faces.count; i++)
            v->house.faces[v->faces.items[i].of].kind = chosen(&v->faces, i);
        status = show(v, stop, error);
    } while (status == TN_OK && !*stop && turn(&v->faces));
    return status;
}

/* ---- functions */

/* A wheel for each cell; *possible: is there a function for each? */
static tn_status set_functions(tn_house_listing *v, bool *possible, tn_error *error)
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

static tn_status go_through_functions(tn_house_listing *v, bool *stop, tn_error *error)
{
    bool kept = false, possible = false;
    tn_status status = keep(v, TN_STAGE_SECTION, &kept, error);
    if (status == TN_OK && kept)
        status = set_functions(v, &possible, error);
    if (status != TN_OK || !kept || !possible)
        return status;
    do {
        for (size_t i = 0; i < v->functions.count; i++)
            v->house.cells[v->functions.items[i].of].function = chosen(&v->functions, i);
        status = go_through_faces(v, stop, error);
    } while (status == TN_OK && !*stop && turn(&v->functions));
    return status;
}

/* ---- sections */

static tn_status stand(tn_house_listing *v, const tn_tray *trays, size_t length, const uint32_t *shapes,
                       tn_error *error)
{
    enum { USUAL_CELLS = 16 }; /* a step is as much as a house of so many takes; each may be asked about each */
    tn_status status = tn_house_stand_again(v->form, trays, length, shapes, &v->house, error);
    if (status != TN_OK)
        return status;
    v->step = 1 + (uint64_t)v->house.cell_count * v->house.cell_count / (USUAL_CELLS * USUAL_CELLS);
    return tn_house_known_use(&v->known, &v->house, error);
}

static void begin(tn_house_listing *v, tn_listing_seen *listed, void *context)
{
    v->listed = listed;
    v->context = context;
    v->work = v->work_limit;
    memset(v->runs, 0, v->library->clause_count * sizeof *v->runs);
}

/* The houses of a section, which stands. */
static tn_status go_through_section(tn_house_listing *v, const tn_tray *trays, size_t length, const uint32_t *shapes,
                                    bool *stop, tn_error *error)
{
    tn_status status = stand(v, trays, length, shapes, error);
    return status == TN_OK ? go_through_functions(v, stop, error) : status;
}

static tn_status go_through(tn_house_listing *v, const tn_tray *trays, size_t length, tn_listing_seen *listed,
                            void *context, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    bool stop = false;
    tn_status status = TN_OK;
    begin(v, listed, context);
    for (bool more = true; status == TN_OK && !stop && more; more = tn_form_next_section(v->form, shapes)) {
        tn_house_take_section(v->form, shapes, &v->house);
        if (tn_house_section_stands(&v->house))
            status = go_through_section(v, trays, length, shapes, &stop, error);
    }
    return status;
}

/* ---- counting */

/* Sections that nothing tells apart have as many houses. */
typedef struct counted_section {
    tn_section_key key;
    tn_house_counts counts;
} counted_section;

typedef struct counting {
    counted_section *sections;
    size_t count, section_room;
    uint32_t *functions; /* [cells] of the house that was counted last */
    size_t room;
    bool any; /* was one, in this section? */
} counting;

/* Adds to the section that was begun last. */
static tn_status count_house(tn_house_listing *v, void *context, const mpz_t houses, bool *stop, tn_error *error)
{
    counting *c = context;
    tn_house_counts *counts = &c->sections[c->count - 1].counts;
    bool same = c->any;
    (void)stop;
    if (!tn_array_reserve(&c->functions, &c->room, 0, v->house.cell_count + 1, sizeof *c->functions))
        return tn_fail_memory(error);
    for (size_t i = 0; i < v->house.cell_count; i++) {
        same = same && c->functions[i] == v->house.cells[i].function;
        c->functions[i] = v->house.cells[i].function;
    }
    c->any = true;
    counts->zoned += !same;
    counts->faced++;
    mpz_add(counts->houses, counts->houses, houses);
    return TN_OK;
}

/* *counts: those of the section, whose houses are gone through if no other like it was. */
static tn_status count_section(tn_house_listing *v, counting *c, const tn_tray *trays, size_t length,
                               const uint32_t *shapes, const tn_house_counts **counts, tn_error *error)
{
    tn_section_key key = tn_sections_key(&v->sections, &v->house);
    bool stop = false;
    *counts = NULL;
    for (size_t i = 0; !*counts && i < c->count; i++)
        if (memcmp(&c->sections[i].key, &key, sizeof key) == 0)
            *counts = &c->sections[i].counts;
    if (*counts)
        return TN_OK;
    if (!tn_array_reserve(&c->sections, &c->section_room, c->count, 1, sizeof *c->sections))
        return tn_fail_memory(error);
    counted_section *section = &c->sections[c->count++];
    section->key = key;
    tn_house_counts_init(&section->counts);
    c->any = false;
    *counts = &section->counts;
    return go_through_section(v, trays, length, shapes, &stop, error);
}

tn_status tn_house_listing_sections(tn_house_listing *v, const tn_tray *trays, size_t length, tn_section_each *each,
                                    void *context, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    counting c = {0};
    tn_status status = TN_OK;
    begin(v, count_house, &c);
    for (bool more = true; status == TN_OK && more; more = tn_form_next_section(v->form, shapes)) {
        const tn_house_counts *counts;
        tn_house_take_section(v->form, shapes, &v->house);
        if (!tn_house_section_stands(&v->house))
            continue;
        status = count_section(v, &c, trays, length, shapes, &counts, error);
        if (status == TN_OK && mpz_sgn(counts->houses) > 0)
            status = each(context, shapes, counts, error);
    }
    for (size_t i = 0; i < c.count; i++)
        tn_house_counts_clear(&c.sections[i].counts);
    free(c.sections);
    free(c.functions);
    return status;
}

static tn_status add_counts(void *context, const uint32_t *shapes, const tn_house_counts *counts, tn_error *error)
{
    tn_house_counts *sum = context;
    (void)shapes;
    (void)error;
    sum->zoned += counts->zoned;
    sum->faced += counts->faced;
    mpz_add(sum->houses, sum->houses, counts->houses);
    return TN_OK;
}

tn_status tn_house_listing_count(tn_house_listing *v, const tn_tray *trays, size_t length, tn_house_counts *counts,
                                 tn_error *error)
{
    return tn_house_listing_sections(v, trays, length, add_counts, counts, error);
}

/* ---- numbers */

typedef struct giving {
    mpz_t left; /* houses still to be passed over */
    tn_house_each *each;
    void *context;
} giving;

/* Gives the houses with these faces out, from the `left`-th combination of tiles on. */
static tn_status give_tiles(tn_house_listing *v, void *context, const mpz_t houses, bool *stop, tn_error *error)
{
    giving *g = context;
    if (mpz_cmp(g->left, houses) >= 0) {
        mpz_sub(g->left, g->left, houses);
        return TN_OK;
    }
    tn_furnish_at(v->furnisher, g->left);
    mpz_set_ui(g->left, 0);
    tn_status status;
    do {
        v->work = v->work_limit; /* there is a limit on the way to a house, none on how many there are */
        status = g->each(g->context, &v->house, stop, error);
    } while (status == TN_OK && !*stop && tn_furnish_next(v->furnisher));
    return status;
}

tn_status tn_house_listing_each(tn_house_listing *v, const tn_tray *trays, size_t length, const mpz_t from,
                                tn_house_each *each, void *context, tn_error *error)
{
    giving g = {.each = each, .context = context};
    mpz_init_set(g.left, from);
    tn_status status = go_through(v, trays, length, give_tiles, &g, error);
    mpz_clear(g.left);
    return status;
}

tn_status tn_house_too_few(const mpz_t houses, tn_error *error)
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

tn_status tn_house_not_kept(tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not keep this house");
    tn_error_help(error, "`tartan explain` says which clauses drop it");
    return status;
}

typedef struct finding {
    mpz_t left;
    tn_house *house;
    bool found;
} finding;

/* The house at hand becomes the caller's. */
static tn_status take_house(tn_house_listing *v, void *context, const mpz_t houses, bool *stop, tn_error *error)
{
    finding *f = context;
    (void)error;
    *stop = f->found = mpz_cmp(f->left, houses) < 0;
    if (!f->found) {
        mpz_sub(f->left, f->left, houses);
        return TN_OK;
    }
    tn_furnish_at(v->furnisher, f->left);
    *f->house = v->house;
    f->house->known = NULL;
    v->house = (tn_house){0};
    return TN_OK;
}

tn_status tn_house_listing_at(tn_house_listing *v, const tn_tray *trays, size_t length, const mpz_t number,
                              tn_house *house, tn_error *error)
{
    finding f = {.house = house};
    *house = (tn_house){0};
    mpz_init_set(f.left, number);
    tn_status status = go_through(v, trays, length, take_house, &f, error);
    if (status == TN_OK && !f.found) {
        mpz_sub(f.left, number, f.left); /* all that there are were passed over */
        status = tn_house_too_few(f.left, error);
    }
    mpz_clear(f.left);
    return status;
}

typedef struct seeking {
    mpz_ptr before;
    const tn_house *wanted;
    bool found;
} seeking;

/* In all but tiles. */
static bool is_same(const tn_house *a, const tn_house *b)
{
    bool same = memcmp(a->shapes, b->shapes, sizeof a->shapes) == 0 && a->cell_count == b->cell_count &&
                a->face_count == b->face_count;
    for (size_t i = 0; same && i < a->cell_count; i++)
        same = a->cells[i].function == b->cells[i].function;
    for (size_t i = 0; same && i < a->face_count; i++)
        same = a->faces[i].kind == b->faces[i].kind;
    return same;
}

static tn_status seek(tn_house_listing *v, void *context, const mpz_t houses, bool *stop, tn_error *error)
{
    seeking *s = context;
    mpz_t here;
    (void)error;
    *stop = is_same(&v->house, s->wanted);
    if (!*stop) {
        mpz_add(s->before, s->before, houses);
        return TN_OK;
    }
    mpz_init(here);
    tn_furnish_before(v->furnisher, s->wanted, here);
    mpz_add(s->before, s->before, here);
    mpz_clear(here);
    s->found = tn_furnish_has(v->furnisher, s->wanted);
    return TN_OK;
}

tn_status tn_house_listing_number(tn_house_listing *v, const tn_house *house, mpz_t number, tn_error *error)
{
    seeking s = {.before = number, .wanted = house};
    mpz_set_ui(number, 0);
    tn_status status = go_through(v, house->trays, house->length, seek, &s, error);
    return status == TN_OK && !s.found ? tn_house_not_kept(error) : status;
}

/* ---- making */

tn_status tn_house_listing_new(const tn_house_form *form, const tn_house_library_record *library, uint64_t work,
                               tn_house_listing **out, tn_error *error)
{
    tn_house_listing *v = *out = calloc(1, sizeof *v);
    if (!v)
        return tn_fail_memory(error);
    *v = (tn_house_listing){.form = form, .library = library, .work_limit = work > 0 ? work : TN_LISTING_WORK_DEFAULT};
    mpz_init(v->houses);
    v->stages = calloc((size_t)library->clause_count + 1, sizeof *v->stages);
    v->runs = calloc((size_t)library->clause_count + 1, sizeof *v->runs);
    tn_status status = v->stages && v->runs ? tn_clause_stages(form, library, v->stages, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_house_known_begin(form, &v->known, error);
    if (status == TN_OK)
        status = tn_furnisher_new(form, library, &v->furnisher, error);
    if (status == TN_OK)
        status = tn_sections_begin(form, &v->sections, error);
    if (status == TN_OK && (tn_furnisher_prices(v->furnisher) || tn_furnisher_walks(v->furnisher)))
        v->sections.apart = true; /* each section has its own costs, and roofs that people walk below */
    if (status == TN_OK)
        status = tn_house_rules_new(form, 0, &v->rules, error);
    if (status != TN_OK) {
        tn_house_listing_free(v);
        *out = NULL;
    }
    return status;
}

void tn_house_listing_free(tn_house_listing *v)
{
    if (!v)
        return;
    tn_house_rules_free(v->rules);
    tn_house_clear(&v->house);
    tn_house_known_clear(&v->known);
    tn_furnisher_free(v->furnisher);
    tn_wheels *const wheels[] = {&v->functions, &v->faces};
    for (size_t i = 0; i < sizeof wheels / sizeof *wheels; i++) {
        free(wheels[i]->items);
        free(wheels[i]->choices);
    }
    free(v->stages);
    free(v->runs);
    mpz_clear(v->houses);
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
