/* Goes through the houses on one plan: sections, functions, faces, each like the wheels of a counter. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/variant/furnish.h"
#include "runtime/house/variant/parts.h"
#include "runtime/house/variant/section.h"

/* ---- wheels */

void tn_wheels_clear(tn_wheels *w)
{
    w->count = w->choice_count = 0;
}

tn_status tn_wheels_add(tn_wheels *w, uint32_t of, const uint32_t *choices, uint32_t count, tn_error *error)
{
    if (!tn_array_reserve(&w->items, &w->room, w->count, 1, sizeof *w->items) ||
        !tn_array_reserve(&w->choices, &w->choice_room, w->choice_count, count, sizeof *w->choices))
        return tn_fail_memory(error);
    w->items[w->count++] = (tn_wheel){.of = of, .first = (uint32_t)w->choice_count, .count = count};
    memcpy(w->choices + w->choice_count, choices, count * sizeof *choices);
    w->choice_count += count;
    return TN_OK;
}

bool tn_wheels_turn(tn_wheels *w, size_t first, size_t end)
{
    for (size_t i = end; i-- > first;) {
        if (++w->items[i].at < w->items[i].count)
            return true;
        w->items[i].at = 0;
    }
    return false;
}

/* ---- clauses */

/* The clause that was run most often; NULL where none was. */
static const tn_house_clause_record *dearest(const tn_house_variants *v)
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

tn_status tn_variants_spend(tn_house_variants *v, uint64_t steps, tn_error *error)
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
                      "leave fewer choices: require more of cells and sections (--where), or take a shorter plan");
    return TN_LIMIT;
}

/* Runs a clause, on a house that the rules have started on or, the first time, start on now. */
static tn_status run_clause(tn_house_variants *v, uint32_t clause, bool *started, bool *drops, tn_error *error)
{
    tn_status status = *started ? TN_OK : tn_house_rules_start(v->rules, &v->house, error);
    *started = true;
    if (v->stages[clause] == TN_STAGE_TILES)
        tn_house_rules_price(v->rules, v->price);
    v->runs[clause]++;
    return status == TN_OK ? tn_house_rules_drop(v->rules, v->library, clause, drops, error) : status;
}

tn_status tn_variants_keep(tn_house_variants *v, tn_clause_stage stage, bool *kept, tn_error *error)
{
    tn_status status = tn_variants_spend(v, 1, error);
    bool started = false;
    *kept = true;
    for (uint32_t i = 0; status == TN_OK && *kept && i < v->library->clause_count; i++) {
        bool drops = false;
        if (v->stages[i] != stage)
            continue;
        uint8_t *answer = stage == TN_STAGE_FUNCTIONS ? tn_memo_answer(v, i) : NULL;
        if (answer && *answer != TN_MEMO_UNKNOWN)
            drops = *answer == TN_MEMO_DROPS;
        else
            status = run_clause(v, i, &started, &drops, error);
        if (answer && status == TN_OK)
            *answer = drops ? TN_MEMO_DROPS : TN_MEMO_KEEPS;
        if (answer && drops)
            v->turn_end = tn_memo_end(v, i);
        *kept = !drops;
    }
    return status;
}

/* ---- tiles */

tn_status tn_variants_count_tiles(tn_house_variants *v, bool *fit, tn_error *error)
{
    tn_status status = TN_OK;
    *fit = true;
    for (uint32_t i = 0; status == TN_OK && *fit && i < v->house.cell_count; i++) {
        v->tiles[i] = 1;
        if (tn_fits_wanted(&v->fits, &v->house.cells[i]))
            status = tn_fits_count(&v->fits, &v->house, i, &v->tiles[i], error);
        *fit = v->tiles[i] > 0;
    }
    return status;
}

/* ---- stages */

/* What may be in a face depends on its cells alone: most of them have functions that they had before. */
static size_t face_options(tn_house_variants *v, size_t i, uint32_t kinds[TN_FACE_KINDS_MAX])
{
    const tn_face *face = &v->house.faces[i];
    uint32_t first = v->house.cells[face->first].function;
    uint32_t second = face->second == TN_NO_CELL ? TN_NO_FUNCTION : v->house.cells[face->second].function;
    tn_known_face *known = &v->known_faces[TN_KNOWN_WAYS * i + (first + 3 * second) % TN_KNOWN_WAYS];
    if (known->count > 0 && known->first == first && known->second == second) {
        memcpy(kinds, known->kinds, known->count * sizeof *kinds);
        return known->count;
    }
    size_t count = tn_face_options(&v->house, face, kinds);
    *known = (tn_known_face){.first = first, .second = second};
    if (count <= TN_KNOWN_KINDS_MAX) {
        known->count = (uint32_t)count;
        memcpy(known->kinds, kinds, count * sizeof *kinds);
    }
    return count;
}

tn_status tn_variants_set_faces(tn_house_variants *v, tn_error *error)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    tn_status status = TN_OK;
    tn_wheels_clear(&v->faces);
    v->faces_set = 0;
    for (uint32_t i = 0; status == TN_OK && i < v->house.face_count; i++) {
        size_t count = face_options(v, i, kinds);
        v->house.faces[i].kind = kinds[0];
        if (count > 1)
            status = tn_wheels_add(&v->faces, i, kinds, (uint32_t)count, error);
    }
    return status;
}

static void set_kinds(tn_house_variants *v)
{
    for (size_t i = 0; i < v->faces_set; i++)
        v->house.faces[v->faces.items[i].of].kind = tn_wheel_chosen(&v->faces, i);
}

/* Shows how many houses there are with the faces that are set. */
static tn_status show_set(tn_house_variants *v, const tn_house_visitor *seen_by, bool *taken, tn_error *error)
{
    tn_house_counts counts;
    if (!seen_by->by_faces || !*seen_by->by_faces || v->faces_set == 0)
        return TN_OK;
    tn_house_counts_init(&counts);
    tn_status status = tn_variants_count_set(v, &counts, error);
    set_kinds(v);
    if (status == TN_OK)
        seen_by->count(v, seen_by->context, PART_FACES, &counts, taken);
    tn_house_counts_clear(&counts);
    return status;
}

/* Shows the house whose faces are all set, if it is kept and each cell has a tile. */
static tn_status show_house(tn_house_variants *v, const tn_house_visitor *seen_by, bool *stop, tn_error *error)
{
    bool kept = false, fit = false;
    set_kinds(v);
    tn_status status = tn_variants_keep(v, TN_STAGE_FACES, &kept, error);
    if (status == TN_OK && kept)
        status = tn_variants_count_tiles(v, &fit, error);
    if (status == TN_OK && kept && fit)
        status = tn_furnish(v, error);
    return status == TN_OK && kept && fit ? seen_by->visit(v, seen_by->context, stop, error) : status;
}

/* The next choice of the last wheel that is set, or of one before it. False: all have come round. */
static bool turn_set(tn_house_variants *v)
{
    for (; v->faces_set > 0; v->faces_set--) {
        tn_wheel *last = &v->faces.items[v->faces_set - 1];
        if (++last->at < last->count)
            return true;
        last->at = 0;
    }
    return false;
}

/* Wheel by wheel, so that whole parts can be taken at once. */
static tn_status go_through_faces(tn_house_variants *v, const tn_house_visitor *seen_by, bool *stop, tn_error *error)
{
    bool kept = false, more = true;
    tn_status status = tn_variants_keep(v, TN_STAGE_FUNCTIONS, &kept, error);
    if (status == TN_OK && kept)
        status = tn_variants_set_faces(v, error);
    while (status == TN_OK && kept && more && !*stop) {
        bool taken = false;
        status = show_set(v, seen_by, &taken, error);
        if (status == TN_OK && !taken && v->faces_set < v->faces.count) {
            v->faces_set++;
            continue;
        }
        if (status == TN_OK && !taken)
            status = show_house(v, seen_by, stop, error);
        more = turn_set(v);
    }
    return status;
}

/* A wheel for each cell; *possible: is there a function for each? */
static tn_status set_functions(tn_house_variants *v, bool *possible, tn_error *error)
{
    uint32_t functions[TN_CELL_RULES_MAX];
    tn_status status = TN_OK;
    tn_wheels_clear(&v->functions);
    *possible = true;
    for (uint32_t i = 0; status == TN_OK && *possible && i < v->house.cell_count; i++) {
        uint32_t count = 0;
        for (uint32_t f = 0; f < tn_form_functions(v->form); f++)
            if (tn_cell_may(&v->house, &v->house.cells[i], f))
                functions[count++] = f;
        *possible = count > 0 || v->house.cells[i].open;
        if (count > 0)
            status = tn_wheels_add(&v->functions, i, functions, count, error);
    }
    return status;
}

/* The wheels after those that a clause looked at, which dropped the house, are turned back: their other choices are
 * dropped too. Returns where turning starts. */
static size_t skip_rest(tn_house_variants *v)
{
    for (size_t i = v->turn_end; i < v->functions.count; i++)
        v->functions.items[i].at = 0;
    return v->turn_end;
}

static tn_status go_through_functions(tn_house_variants *v, const tn_house_visitor *seen_by, bool *stop,
                                      tn_error *error)
{
    bool kept = false, possible = false;
    if (!tn_array_resize(&v->tiles, v->house.cell_count + 1, sizeof *v->tiles))
        return tn_fail_memory(error);
    tn_status status = tn_variants_keep(v, TN_STAGE_SECTION, &kept, error);
    if (status == TN_OK && kept)
        status = set_functions(v, &possible, error);
    if (status == TN_OK && kept && possible)
        status = tn_memos_make(v, error);
    if (status != TN_OK || !kept || !possible)
        return status;
    do {
        for (size_t i = 0; i < v->functions.count; i++)
            v->house.cells[v->functions.items[i].of].function = tn_wheel_chosen(&v->functions, i);
        v->turn_end = v->functions.count;
        bool taken = false;
        tn_house_counts counts;
        tn_house_counts_init(&counts);
        status = tn_variants_count_faces(v, &counts, error);
        if (status == TN_OK)
            seen_by->count(v, seen_by->context, PART_FUNCTIONS, &counts, &taken);
        tn_house_counts_clear(&counts);
        if (status == TN_OK && !taken)
            status = go_through_faces(v, seen_by, stop, error);
    } while (status == TN_OK && !*stop && tn_wheels_turn(&v->functions, 0, skip_rest(v)));
    return status;
}

/* A wheel of one function for each cell. */
static tn_status take_functions(tn_house_variants *v, const tn_house *like, tn_error *error)
{
    tn_status status = TN_OK;
    tn_wheels_clear(&v->functions);
    for (uint32_t i = 0; status == TN_OK && i < v->house.cell_count; i++) {
        v->house.cells[i].function = like->cells[i].function;
        if (!like->cells[i].open)
            status = tn_wheels_add(&v->functions, i, &like->cells[i].function, 1, error);
    }
    return status;
}

/* A step is as much as a house of so many cells takes; each cell may be asked about each. */
enum { USUAL_CELLS = 16 };

static void begin_work(tn_house_variants *v)
{
    v->work = v->work_limit;
    memset(v->runs, 0, v->library->clause_count * sizeof *v->runs);
}

static tn_status stand(tn_house_variants *v, const tn_tray *trays, size_t length, const uint32_t *shapes,
                       tn_error *error)
{
    tn_status status = tn_house_stand_again(v->form, trays, length, shapes, &v->house, error);
    if (status == TN_OK &&
        !tn_array_resize((void **)&v->known_faces, TN_KNOWN_WAYS * v->house.face_count + 1, sizeof *v->known_faces))
        return tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    v->step = 1 + (uint64_t)v->house.cell_count * v->house.cell_count / (USUAL_CELLS * USUAL_CELLS);
    memset(v->known_faces, 0, TN_KNOWN_WAYS * v->house.face_count * sizeof *v->known_faces);
    return tn_house_known_use(&v->known, &v->house, error);
}

/* Of the house at hand only the section is known until more is asked for. */
static tn_status stand_up(tn_house_variants *v, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX];
    if (v->stands)
        return TN_OK;
    memcpy(shapes, v->house.shapes, sizeof shapes);
    v->stands = true;
    return stand(v, v->counted, v->counted_length, shapes, error);
}

/* The house at hand stands like this one, with its functions. */
static tn_status begin_like(tn_house_variants *v, const tn_house *like, tn_error *error)
{
    begin_work(v);
    tn_status status = stand(v, like->trays, like->length, like->shapes, error);
    if (status == TN_OK && !tn_array_resize(&v->tiles, v->house.cell_count + 1, sizeof *v->tiles))
        status = tn_fail_memory(error);
    return status == TN_OK ? take_functions(v, like, error) : status;
}

tn_status tn_variants_take(tn_house_variants *v, const tn_house *like, tn_error *error)
{
    tn_status status = begin_like(v, like, error);
    for (size_t i = 0; status == TN_OK && i < v->house.face_count; i++)
        v->house.faces[i].kind = like->faces[i].kind;
    return status;
}

static void add_counts(tn_house_variants *v, void *context, tn_house_part part, const tn_house_counts *counts,
                       bool *taken)
{
    tn_house_counts *sum = context;
    (void)v;
    (void)part;
    sum->zoned += counts->zoned;
    sum->faced += counts->faced;
    mpz_add(sum->houses, sum->houses, counts->houses);
    *taken = true;
}

/* The houses of the section at hand: as many as with others that nothing tells apart from it. */
static tn_status count_section(tn_house_variants *v, tn_house_counts *counts, tn_error *error)
{
    const tn_section_count *known = tn_sections_find(v->sections, &v->house);
    bool stop = false;
    if (known) {
        counts->zoned = known->zoned;
        counts->faced = known->faced;
        mpz_set(counts->houses, known->houses);
        return TN_OK;
    }
    tn_status status = stand_up(v, error);
    if (status == TN_OK)
        status = go_through_functions(v, &(tn_house_visitor){.count = add_counts, .context = counts}, &stop, error);
    return status == TN_OK ? tn_sections_keep(v->sections, &v->house, counts, error) : status;
}

static tn_status go_through_section(tn_house_variants *v, const tn_house_visitor *seen_by, bool *stop, tn_error *error)
{
    tn_house_counts counts;
    bool taken = false;
    tn_house_counts_init(&counts);
    tn_status status = count_section(v, &counts, error);
    if (status == TN_OK)
        seen_by->count(v, seen_by->context, PART_SECTION, &counts, &taken);
    tn_house_counts_clear(&counts);
    if (status == TN_OK && !taken)
        status = stand_up(v, error);
    return status == TN_OK && !taken ? go_through_functions(v, seen_by, stop, error) : status;
}

/* What was counted of the sections of the plan before is of no use, unless this is the same. */
static tn_status begin_plan(tn_house_variants *v, const tn_tray *trays, size_t length, tn_error *error)
{
    if (v->counted && v->counted_length == length && memcmp(v->counted, trays, length * sizeof *trays) == 0)
        return TN_OK;
    tn_sections_forget(v->sections);
    v->counted_length = 0;
    if (!tn_array_resize((void **)&v->counted, length + 1, sizeof *v->counted))
        return tn_fail_memory(error);
    memcpy(v->counted, trays, length * sizeof *trays);
    v->counted_length = length;
    return TN_OK;
}

tn_status tn_variants_go_through(tn_house_variants *v, const tn_tray *trays, size_t length,
                                 const tn_house_visitor *seen_by, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    bool stop = false;
    tn_status status;
    begin_work(v);
    status = begin_plan(v, trays, length, error);
    for (bool more = true; status == TN_OK && !stop && more; more = tn_form_next_section(v->form, shapes)) {
        tn_house_take_section(v->form, shapes, &v->house);
        v->stands = false;
        if (tn_house_section_stands(&v->house))
            status = go_through_section(v, seen_by, &stop, error);
    }
    return status;
}

/* ---- what is asked of them */

tn_status tn_house_variants_count(tn_house_variants *v, const tn_tray *trays, size_t length, tn_house_counts *counts,
                                  tn_error *error)
{
    return tn_variants_go_through(v, trays, length, &(tn_house_visitor){.count = add_counts, .context = counts}, error);
}

typedef struct tn_by_section {
    tn_section_each *each;
    void *context;
    tn_status status;
    tn_error *error;
} tn_by_section;

static void show_section(tn_house_variants *v, void *context, tn_house_part part, const tn_house_counts *counts,
                         bool *taken)
{
    tn_by_section *by = context;
    (void)part;
    if (by->status == TN_OK && mpz_sgn(counts->houses) > 0)
        by->status = by->each(by->context, v->house.shapes, counts, by->error);
    *taken = true;
}

tn_status tn_house_variants_sections(tn_house_variants *v, const tn_tray *trays, size_t length, tn_section_each *each,
                                     void *context, tn_error *error)
{
    tn_by_section by = {each, context, TN_OK, error};
    tn_status status =
        tn_variants_go_through(v, trays, length, &(tn_house_visitor){.count = show_section, .context = &by}, error);
    return status == TN_OK ? by.status : status;
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
    v->runs = calloc((size_t)library->clause_count + 1, sizeof *v->runs);
    tn_status status = v->stages && v->runs ? tn_clause_stages(form, library, v->stages, error) : tn_fail_memory(error);
    v->sections = calloc(1, sizeof *v->sections);
    mpq_init(v->price);
    if (status == TN_OK)
        status = v->sections ? tn_sections_begin(form, v->sections, error) : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++)
        v->asks_costs = v->asks_costs || v->stages[i] == TN_STAGE_TILES;
    if (v->asks_costs)
        v->sections->apart = true; /* each section has its own costs */
    if (status == TN_OK)
        status = tn_room_questions_find(form->module, &v->questions, error);
    if (status == TN_OK)
        status = tn_memos_begin(v, error);
    if (status == TN_OK)
        status = tn_house_known_begin(form, &v->known, error);
    if (status == TN_OK)
        status = tn_fits_begin(form, &v->fits, error);
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
    tn_house_known_clear(&v->known);
    tn_fits_clear(&v->fits);
    free(v->known_faces);
    tn_room_questions_clear(&v->questions);
    tn_wheels *const wheels[] = {&v->functions, &v->faces, &v->shared, &v->own};
    for (size_t i = 0; i < sizeof wheels / sizeof *wheels; i++) {
        free(wheels[i]->items);
        free(wheels[i]->choices);
    }
    if (v->sections)
        tn_sections_free(v->sections);
    free(v->sections);
    free(v->counted);
    tn_memos_free(v);
    free(v->stages);
    free(v->runs);
    tn_furnished_clear(v);
    mpq_clear(v->price);
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
