/* Walks a library in rank order: an odometer of trays that steps only to where a kept plan still follows. */
#include <stdlib.h>

#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"

struct tn_cursor {
    const tn_library *library;
    tn_tray *trays;   /* [max] */
    uint32_t *states; /* [max + 1]: after so many trays */
    uint32_t length;
    bool started;
    mpz_t left; /* plans still to give */
};

tn_status tn_cursor_new(const tn_library *library, const mpz_t from, const mpz_t to, tn_cursor **out, tn_error *error)
{
    tn_cursor *cursor = calloc(1, sizeof *cursor);
    if (!cursor)
        return tn_fail_memory(error);
    mpz_init(cursor->left);
    cursor->library = library;
    cursor->trays = calloc((size_t)library->max + 1, sizeof *cursor->trays);
    cursor->states = calloc((size_t)library->max + 1, sizeof *cursor->states);
    if (!cursor->trays || !cursor->states) {
        tn_cursor_free(cursor);
        return tn_fail_memory(error);
    }
    mpz_srcptr all = library->before[library->max + 1];
    mpz_sub(cursor->left, mpz_cmp(to, all) < 0 ? to : all, from);
    if (mpz_sgn(cursor->left) <= 0 || !tn_library_unrank(library, from, cursor->trays, &cursor->length))
        mpz_set_ui(cursor->left, 0);
    for (uint32_t i = 0; i < cursor->length; i++)
        cursor->states[i + 1] = tn_library_step(library, cursor->states[i], cursor->trays[i]);
    *out = cursor;
    return TN_OK;
}

void tn_cursor_free(tn_cursor *cursor)
{
    if (!cursor)
        return;
    mpz_clear(cursor->left);
    free(cursor->trays);
    free(cursor->states);
    free(cursor);
}

/* Where trays are not listed: does a kept plan follow the trays of a class? */
typedef struct following {
    const tn_library *library;
    const uint32_t *next; /* of the state */
    uint32_t left;
} following;

static bool is_followed(void *context, uint32_t class)
{
    const following *f = context;
    return tn_library_alive(f->library, f->left, f->next[f->library->kept->column[class]]);
}

static tn_tray followed_tray(const tn_cursor *cursor, uint32_t i, tn_tray from)
{
    const tn_library *library = cursor->library;
    following f = {library, library->kept->delta + (size_t)cursor->states[i] * library->kept->columns,
                   cursor->length - 1 - i};
    return tn_labelling_next(tn_kinds_of(&library->classes->kinds), from, is_followed, &f);
}

/* The first tray at place i, from `tray` on, after which a kept plan follows; false where there is none. */
static bool set_tray(tn_cursor *cursor, uint32_t i, tn_tray tray)
{
    const tn_library *library = cursor->library;
    if (library->schema->legal)
        tray = followed_tray(cursor, i, tray);
    while (tray < library->schema->tray_count) {
        uint32_t state = tn_library_step(library, cursor->states[i], tray);
        if (!tn_library_alive(library, cursor->length - 1 - i, state)) {
            tray = library->run_end[tray];
            continue;
        }
        cursor->trays[i] = tray;
        cursor->states[i + 1] = state;
        return true;
    }
    return false;
}

/* Completes the plan from place i on with the first trays that do. */
static void fill(tn_cursor *cursor, uint32_t i)
{
    for (; i < cursor->length; i++)
        set_tray(cursor, i, 0);
}

static void advance(tn_cursor *cursor)
{
    for (uint32_t i = cursor->length; i-- > 0;) {
        if (set_tray(cursor, i, cursor->trays[i] + 1)) {
            fill(cursor, i + 1);
            return;
        }
    }
    do
        cursor->length++;
    while (cursor->length < cursor->library->max && !tn_library_alive(cursor->library, cursor->length, 0));
    fill(cursor, 0);
}

bool tn_cursor_next(tn_cursor *cursor, const tn_tray **trays, uint32_t *length)
{
    if (mpz_sgn(cursor->left) == 0)
        return false;
    if (cursor->started)
        advance(cursor);
    cursor->started = true;
    mpz_sub_ui(cursor->left, cursor->left, 1);
    *trays = cursor->trays;
    *length = cursor->length;
    return true;
}
