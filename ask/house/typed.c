/* Finds houses by what is typed of them, and says which typed value leaves none. */
#include "ask/house/typed.h"

#include <stdlib.h>
#include <string.h>

#include "driver/house/change_text.h"
#include "runtime/house/rank/rank.h"

void tn_typed_told_clear(tn_typed_told *told)
{
    free(told->told.data);
    *told = (tn_typed_told){0};
}

tn_status tn_keep_first_mistake(void *context, tn_error *error)
{
    tn_first_mistake *first = context;
    if (!first->any)
        first->error = *error;
    first->any = true;
    return TN_OK;
}

/* ---- asking whether there is a house */

/* The houses on the line's plan, of the library or of the form. */
typedef struct asking {
    const tn_house_line *line;
    tn_houses *houses;
    tn_plan_houses *on_plan;
    tn_house_listing *listing; /* in place of both: the library asks for walks */
    uint64_t work;
} asking;

static void end_asking(asking *a)
{
    tn_plan_houses_free(a->on_plan);
    tn_houses_free(a->houses);
    tn_house_listing_free(a->listing);
}

/* plans: NULL, of all houses of the form. */
static tn_status begin_asking(asking *a, const tn_typed_among *among, const tn_house_line *line,
                              const tn_house_library_record *library, const tn_library *plans, tn_error *error)
{
    static const tn_tray none[1];
    const tn_tray *trays = line->plan.length > 0 ? line->plan.trays : none;
    const tn_houses_what what = {.only = trays, .length = (uint32_t)line->plan.length};
    *a = (asking){.line = line, .work = TN_TYPED_WORK};
    tn_status status = tn_houses_check_walks(among->form, library, NULL, error);
    if (status == TN_LIMIT)
        return tn_house_listing_new(among->form, library, 0, &a->listing, error);
    if (status == TN_OK)
        status = tn_houses_of(among->form, library, plans, &what, among->options.max_states, &a->houses, error);
    return status == TN_OK ? tn_plan_houses_new(a->houses, trays, (uint32_t)line->plan.length, &a->on_plan, error)
                           : status;
}

/* The first house of a listing that has what is typed. */
typedef struct seeking {
    const tn_line_asked *asked;
    uint64_t *work;
    tn_buffer line;
    tn_house *house;
    bool *found;
} seeking;

static tn_status look_at(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    seeking *s = context;
    s->line.size = 0;
    tn_status status = tn_typed_try(s->work, error);
    if (status == TN_OK)
        status = tn_house_write(house, &s->line, error);
    if (status == TN_OK && tn_typed_line_fits(s->asked, s->line.data)) {
        *stop = *s->found = true;
        status = tn_house_copy(house, s->house, error);
    }
    return status;
}

static tn_status seek(asking *a, const tn_line_asked *asked, tn_house *house, bool *found, tn_error *error)
{
    seeking s = {.asked = asked, .work = &a->work, .house = house, .found = found};
    const tn_plan *plan = &a->line->plan;
    mpz_t first;
    *house = (tn_house){0};
    *found = false;
    mpz_init(first);
    tn_status status = tn_house_listing_each(a->listing, plan->trays, plan->length, first, look_at, &s, error);
    mpz_clear(first);
    free(s.line.data);
    return status;
}

/* The first house with the first so many typed values, `other` in place of the last (NULL: itself). */
static tn_status ask(asking *a, size_t count, const char *other, tn_house *house, bool *found, tn_error *error)
{
    const tn_line_asked asked = {a->line, count, other};
    if (a->listing)
        return seek(a, &asked, house, found, error);
    return tn_plan_houses_typed(a->on_plan, &asked, &a->work, house, found, error);
}

static tn_status has(asking *a, size_t count, const char *other, bool *found, tn_error *error)
{
    tn_house house = {0};
    tn_status status = ask(a, count, other, &house, found, error);
    tn_house_clear(&house);
    return status;
}

/* ---- the first value that leaves none */

/* The value, what it is about (in a house with the values before it), and what it can be there. */
typedef struct lacking {
    int part;
    size_t at; /* in the part */
    const tn_line_value *value;
    tn_buffer place, could;
} lacking;

static void clear_lacking(lacking *l)
{
    free(l->place.data);
    free(l->could.data);
}

static const tn_line_value *value_of(const tn_house_line *line, size_t number, int *part, size_t *at)
{
    for (*part = TN_LINE_SECTION; *part < TN_LINE_PARTS; ++*part)
        for (*at = 0; *at < line->parts[*part].count; ++*at) {
            const tn_line_value *value = &line->parts[*part].values[*at];
            if (!value->left_out && value->number == number)
                return value;
        }
    return NULL;
}

/* The number of values up to and with the first that leaves no house; 0: the plan has none. There is none with all. */
static tn_status find_first(asking *a, size_t *count, tn_error *error)
{
    size_t low = 0, high = a->line->typed; /* none with `high`; with fewer than `low` there is one */
    bool found = false;
    tn_status status = TN_OK;
    while (status == TN_OK && low < high) {
        size_t middle = low + (high - low) / 2;
        status = has(a, middle, NULL, &found, error);
        if (found)
            low = middle + 1;
        else
            high = middle;
    }
    *count = high;
    return status;
}

/* Calls back with each text that the value could be at all. */
typedef tn_status could_be(void *context, const char *text, tn_error *error);

static tn_status each_shape(const tn_house_form *form, size_t choice, could_be *seen, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    if (choice >= form->record->choice_count)
        return TN_OK;
    const tn_choice_record *record = tn_form_choice(form, (uint32_t)choice);
    for (uint32_t s = 0; status == TN_OK && s < record->shape_count; s++)
        status =
            seen(context, tn_text(form->module, form->module->SHAPE_records[record->shape_first + s].spelling), error);
    return status;
}

static tn_status each_function(const tn_house_form *form, could_be *seen, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < tn_form_functions(form); i++)
        status = seen(context, tn_text(form->module, tn_form_rule(form, i)->name), error);
    return status == TN_OK ? seen(context, "void", error) : status;
}

static tn_status each_kind(const tn_house_form *form, could_be *seen, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < TN_FACE_KIND_COUNT + form->record->opening_count; k++)
        status = seen(context, tn_form_kind_text(form, k), error);
    return status;
}

static tn_status each_tile(const tn_house_form *form, could_be *seen, void *context, tn_error *error)
{
    static const tn_house_side sides[] = {TN_HOUSE_BACK, TN_HOUSE_FRONT, TN_HOUSE_LEFT, TN_HOUSE_RIGHT};
    char text[TN_VARIANT_TEXT];
    tn_status status = TN_OK;
    for (uint32_t t = 0; t < form->record->tile_count; t++)
        for (size_t i = 0; status == TN_OK && i < 2 * sizeof sides / sizeof *sides; i++) {
            const tn_tile_variant variant = {
                .tile = form->record->tile_first + t, .side = sides[i / 2], .mirrored = i % 2 == 1};
            tn_variant_text(form, &variant, text);
            status = seen(context, text, error);
        }
    return status;
}

/* Of the texts that a value could be, those with which there is a house. */
typedef struct trying {
    asking *asking;
    size_t count; /* of values, with this one */
    lacking *to;
} trying;

static tn_status try_other(void *context, const char *text, tn_error *error)
{
    const trying *t = context;
    bool found = false;
    tn_status status = has(t->asking, t->count, text, &found, error);
    if (status == TN_OK && found)
        tn_buffer_printf(&t->to->could, "%s%s", t->to->could.data ? ", " : "", text);
    return status;
}

static tn_status try_others(trying *t, const tn_house_form *form, tn_error *error)
{
    switch (t->to->part) {
    case TN_LINE_SECTION:
        return each_shape(form, t->to->at, try_other, t, error);
    case TN_LINE_FUNCTIONS:
        return each_function(form, try_other, t, error);
    case TN_LINE_FACES:
        return each_kind(form, try_other, t, error);
    default:
        return each_tile(form, try_other, t, error);
    }
}

/* Which face of the house is the so manyeth that leaves a choice? UINT32_MAX: none. */
static uint32_t face_of(const tn_house *house, size_t at)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    for (uint32_t i = 0; i < house->face_count; i++)
        if (tn_face_options(house, &house->faces[i], kinds) > 1 && at-- == 0)
            return i;
    return UINT32_MAX;
}

static tn_status tile_cell(const tn_house *house, size_t at, uint32_t *cell, tn_error *error)
{
    tn_status status = TN_OK;
    *cell = TN_NO_CELL;
    for (uint32_t i = 0; status == TN_OK && *cell == TN_NO_CELL && i < house->cell_count; i++) {
        tn_variants tiles;
        status = tn_tile_variants(house, i, &tiles, error);
        if (tiles.count > 0 && at-- == 0)
            *cell = i;
        tn_variants_clear(&tiles);
    }
    return status;
}

/* What the value is about, in a house with those before it. */
static tn_status name_place(const tn_house *house, lacking *l, tn_error *error)
{
    char text[256] = "";
    uint32_t cell = l->part == TN_LINE_FUNCTIONS && l->at < house->cell_count ? (uint32_t)l->at : TN_NO_CELL;
    tn_status status = TN_OK;
    if (l->part == TN_LINE_SECTION && l->at < house->form->record->choice_count)
        snprintf(text, sizeof text, "`%.200s`",
                 tn_text(house->form->module, tn_form_choice(house->form, (uint32_t)l->at)->name));
    uint32_t face = l->part == TN_LINE_FACES ? face_of(house, l->at) : UINT32_MAX;
    if (face != UINT32_MAX)
        tn_face_text(house, face, text, sizeof text);
    if (l->part == TN_LINE_TILES)
        status = tile_cell(house, l->at, &cell, error);
    if (cell != TN_NO_CELL)
        tn_cell_text(house, cell, text, sizeof text);
    tn_buffer_printf(&l->place, "%s", text);
    return status;
}

/* None: no house is on the plan at all. */
static tn_status find_lacking(asking *a, const tn_house_form *form, lacking *l, tn_error *error)
{
    tn_house before = {0};
    size_t count = 0;
    bool found = false;
    tn_status status = find_first(a, &count, error);
    l->value = count > 0 ? value_of(a->line, count - 1, &l->part, &l->at) : NULL;
    if (status == TN_OK && l->value)
        status = ask(a, count - 1, NULL, &before, &found, error);
    if (status == TN_OK && found)
        status = name_place(&before, l, error);
    tn_house_clear(&before);
    trying t = {a, count, l};
    if (status == TN_OK && l->value)
        status = try_others(&t, form, error);
    return status == TN_OK && (l->place.failed || l->could.failed) ? tn_fail_memory(error) : status;
}

/* ---- in words */

/* "in the faces, `door` (1.body.ground, back) is the first value with which it has no house; it can be wall or window"
 */
static void tell_lacking(const lacking *l, tn_buffer *out)
{
    tn_buffer_printf(out, "in the %s, `%.*s`", tn_house_line_part(l->part), (int)l->value->size, l->value->text);
    if (l->place.size > 0)
        tn_buffer_printf(out, " (%s)", l->place.data);
    tn_buffer_printf(out, " leaves none with what stands before it");
    if (l->could.data)
        tn_buffer_printf(out, ": it can be %s", l->could.data);
    else
        tn_buffer_printf(out, ": houses with that have another number of %s", tn_house_line_part(l->part));
}

/* No house of the form has what is typed. */
static tn_status refuse(const tn_house_line *line, const lacking *l, tn_error *error)
{
    if (!l->value) {
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "no house stands on this plan");
        tn_error_help(error, "`tartan explain` with the plan and --library says which cells keep all houses off it");
        return TN_INVALID;
    }
    tn_fail(error, TN_INVALID, E_BAD_HOUSE, "in the %s, no house has `%.*s`%s%.200s%s with what stands before it",
            tn_house_line_part(l->part), (int)(l->value->size < 80 ? l->value->size : 80), l->value->text,
            l->place.size > 0 ? " (" : "", l->place.size > 0 ? l->place.data : "", l->place.size > 0 ? ")" : "");
    if (l->could.data)
        tn_error_help(error, "it can be %.280s", l->could.data);
    else
        tn_error_help(error, "houses with what stands before it have another number of %s than the line",
                      tn_house_line_part(l->part));
    tn_house_line_place(line, l->value->column, l->value->column + l->value->size, error);
    return TN_INVALID;
}

/* What drops the house: the names of clauses. */
static tn_status name_clauses(const tn_typed_among *among, const tn_house *house, tn_buffer *out, tn_error *error)
{
    tn_house_judge judge;
    tn_house_clause *clauses = NULL;
    size_t count = 0, named = 0;
    tn_status status = tn_house_judge_open(among->form->module, among->form_number, among->max_length, &judge, error);
    if (status == TN_OK)
        status = tn_house_judge_clauses(&judge, among->library, house, &clauses, &count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        if (clauses[i].drops)
            tn_buffer_printf(out, "%s`%s`", named++ ? ", " : "", clauses[i].name);
    free(clauses);
    tn_house_judge_close(&judge);
    return status == TN_OK && out->failed ? tn_fail_memory(error) : status;
}

/* ---- finding */

typedef struct finding {
    const tn_typed_among *among;
    const tn_house_line *line;
    const tn_library *plans; /* or NULL */
    tn_library *own;
    bool on_plan; /* the library has the line's plan */
    lacking lacks;
} finding;

static tn_status find_plans(finding *f, tn_error *error)
{
    const tn_typed_among *among = f->among;
    f->plans = among->plans;
    if (f->plans)
        return TN_OK;
    tn_status status = tn_library_new(among->form->schema, among->library->plans, &among->options, &f->own, error);
    f->plans = f->own;
    return status;
}

/* In the library. If it has none, it is found out which value leaves none. */
static tn_status find_kept(finding *f, tn_house *house, bool *found, tn_error *error)
{
    asking a = {0};
    mpz_t rank;
    tn_status status = find_plans(f, error);
    mpz_init(rank);
    f->on_plan =
        status == TN_OK && tn_library_rank(f->plans, f->line->plan.trays, (uint32_t)f->line->plan.length, rank);
    mpz_clear(rank);
    if (status != TN_OK || !f->on_plan)
        return status;
    status = begin_asking(&a, f->among, f->line, f->among->library, f->plans, error);
    if (status == TN_OK)
        status = ask(&a, f->line->typed, NULL, house, found, error);
    if (status == TN_OK && !*found)
        status = find_lacking(&a, f->among->form, &f->lacks, error);
    end_asking(&a);
    return status;
}

static tn_status find_of_form(finding *f, tn_house *house, bool *found, tn_error *error)
{
    const tn_house_library_record none = {.form = f->among->form_number};
    asking a;
    lacking lacks = {0};
    tn_status status = begin_asking(&a, f->among, f->line, &none, NULL, error);
    if (status == TN_OK)
        status = ask(&a, f->line->typed, NULL, house, found, error);
    if (status == TN_OK && !*found) {
        status = find_lacking(&a, f->among->form, &lacks, error);
        status = status == TN_OK ? refuse(f->line, &lacks, error) : status;
    }
    clear_lacking(&lacks);
    end_asking(&a);
    return status;
}

/* Only the form has the house: what drops it, and what would not have to be typed otherwise. */
static tn_status tell(const finding *f, const tn_house *house, tn_typed_told *told, tn_error *error)
{
    const char *name = tn_text(f->among->form->module, f->among->library->name);
    tn_buffer by = {0};
    tn_status status = name_clauses(f->among, house, &by, error);
    tn_buffer_printf(&told->told, "`%s` has no house with what is typed; the first of the form is dropped by %s", name,
                     by.data ? by.data : "its plan");
    if (f->lacks.value) {
        tn_buffer_printf(&told->told, "; ");
        tell_lacking(&f->lacks, &told->told);
    }
    free(by.data);
    return status == TN_OK && told->told.failed ? tn_fail_memory(error) : status;
}

static tn_status refuse_dropped(const finding *f, const tn_house *house, const tn_typed_told *told, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "%.470s", told->told.data);
        tn_error_help(error, "that house is: %.300s", line.data);
        if (f->lacks.value)
            tn_house_line_place(f->line, f->lacks.value->column, f->lacks.value->column + f->lacks.value->size, error);
    }
    free(line.data);
    return status;
}

static tn_status find(const tn_typed_among *among, const tn_house_line *line, tn_house *house, tn_typed_told *told,
                      tn_error *error)
{
    finding f = {.among = among, .line = line};
    bool found = false;
    tn_status status = among->library ? find_kept(&f, house, &found, error) : TN_OK;
    if (status == TN_OK && !found) {
        tn_house_clear(house);
        status = find_of_form(&f, house, &found, error);
        if (status == TN_OK && among->library)
            status = tell(&f, house, told, error);
        if (status == TN_OK && among->library && among->kept)
            status = refuse_dropped(&f, house, told, error);
    }
    told->completed = status == TN_OK;
    clear_lacking(&f.lacks);
    tn_library_free(f.own);
    return status;
}

/* Of several mistakes all but the last are told before. */
typedef struct telling {
    tn_line_error *said;
    void *context;
    bool any;
    tn_error last;
} telling;

static tn_status keep_last(void *context, tn_error *error)
{
    telling *t = context;
    tn_status status = t->any ? t->said(t->context, &t->last) : TN_OK;
    t->any = true;
    t->last = *error;
    return status;
}

tn_status tn_typed_find(const tn_typed_among *among, const char *text, size_t size, tn_line_error *said, void *context,
                        tn_house *house, tn_typed_told *told, tn_error *error)
{
    telling t = {.said = said, .context = context};
    tn_house_line line;
    bool wrong = false;
    *told = (tn_typed_told){0};
    tn_status status = (among->tiles_free ? tn_house_read_open : tn_house_read)(among->form, text, size,
                                                                                among->max_length, house, error);
    if (status != TN_INVALID)
        return status;
    tn_house_clear(house);
    status = tn_house_line_read(among->form, text, size, among->max_length, keep_last, &t, &line, &wrong, error);
    if (status == TN_OK && wrong) {
        *error = t.last;
        status = TN_INVALID;
    } else if (status == TN_OK) {
        status = find(among, &line, house, told, error);
    }
    tn_house_line_clear(&line);
    return status;
}

/* ---- in a session */

typedef struct saying {
    tn_session *session;
    const char *text;
} saying;

static tn_status say(void *context, tn_error *error)
{
    const saying *s = context;
    tn_status status = tn_session_bad_text(s->session, error, "HOUSE", s->text);
    return status == TN_INVALID ? TN_OK : status;
}

tn_status tn_typed_house(tn_session *session, const tn_typed_among *among, const char *text, tn_house *house,
                         bool *completed)
{
    saying s = {session, text};
    tn_typed_told told;
    tn_error error = {0};
    tn_status status = tn_typed_find(among, text, strlen(text), say, &s, house, &told, &error);
    *completed = told.completed;
    if (status != TN_OK)
        tn_session_bad_text(session, &error, "HOUSE", text);
    else if (told.told.size > 0)
        tn_session_note(session, "%s", told.told.data);
    tn_typed_told_clear(&told);
    return status;
}
