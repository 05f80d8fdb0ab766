/* Walks and ways out, as the terms of numbers of houses ask for them: of which cells, and how long or how many. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/form/form.h"
#include "runtime/house/rule/asked_data.h"

/* ---- the walks of the house at hand */

/* With one way in, whatever stands in a cell makes no walk longer. */
static tn_status tiles_matter(const tn_walks *w, uint32_t cell, bool *matter, tn_error *error)
{
    tn_variants tiles = {0};
    tn_status status = w->cells[cell].count > 1 ? tn_tile_variants(w->house, cell, &tiles, error) : TN_OK;
    *matter = tiles.count > 1;
    tn_variants_clear(&tiles);
    return status;
}

/* A line may leave the tiles out where they make no difference. */
static tn_status check_tiles(const tn_walks *w, tn_error *error)
{
    tn_status status = TN_OK;
    bool matter = false;
    for (uint32_t i = 0; w->house->tiles_left_out && status == TN_OK && !matter && i < w->house->cell_count; i++)
        status = tiles_matter(w, i, &matter, error);
    if (status != TN_OK || !matter)
        return status;
    tn_fail(error, TN_INVALID, E_COST_OF_TILES,
            "how one walks through this house depends on its tiles, which the line leaves out");
    tn_error_help(error, "write them after a last `;`: `tartan unrank` and `tartan sample` give whole lines");
    return TN_INVALID;
}

static tn_status gather(tn_house_rules *rules, tn_error *error)
{
    if (rules->walked)
        return TN_OK;
    tn_walks_clear(&rules->walks);
    tn_status status = tn_walks_find(rules->house, &rules->floors, &rules->walks, error);
    if (status == TN_OK)
        status = check_tiles(&rules->walks, error);
    rules->walked = status == TN_OK;
    return status;
}

/* ---- what is asked of them */

/* A question and its answers; owns its arrays. */
typedef struct tn_walk_question {
    tn_walk_asked asked;
    bool *to, *through, *by;
    int64_t *lengths; /* [points] */
    uint32_t *next;   /* [points] */
} tn_walk_question;

static void question_clear(tn_walk_question *q)
{
    free(q->to);
    free(q->through);
    free(q->by);
    free(q->lengths);
    free(q->next);
}

static void fill_question(const tn_house *house, const tn_meeting_record *walk, tn_walk_question *q)
{
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        q->to[i] = walk->second != TN_NO_RECORD && !cell->open && tn_house_decide(house, walk->second, cell);
        q->through[i] = walk->through == TN_NO_RECORD || tn_house_decide(house, walk->through, cell);
    }
    for (size_t i = 0; i < house->face_count; i++)
        q->by[i] = tn_meeting_has(house->form->module, walk, house->faces[i].kind);
    q->asked = (tn_walk_asked){walk->second == TN_NO_RECORD ? NULL : q->to, q->through, q->by};
}

static tn_status ask(tn_house_rules *rules, const tn_meeting_record *walk, tn_walk_question *q, tn_error *error)
{
    const tn_house *house = rules->house;
    tn_status status = gather(rules, error);
    *q = (tn_walk_question){0};
    if (status != TN_OK)
        return status;
    size_t points = (size_t)rules->walks.count + 1;
    q->to = tn_array_new(house->cell_count + 1, sizeof *q->to);
    q->through = tn_array_new(house->cell_count + 1, sizeof *q->through);
    q->by = tn_array_new(house->face_count + 1, sizeof *q->by);
    q->lengths = tn_array_new(points, sizeof *q->lengths);
    q->next = tn_array_new(points, sizeof *q->next);
    if (!q->to || !q->through || !q->by || !q->lengths || !q->next)
        return tn_fail_memory(error);
    fill_question(house, walk, q);
    return tn_walks_lengths(&rules->walks, &q->asked, q->lengths, q->next, error);
}

static const tn_meeting_record *walk_of(const tn_house_rules *rules, const tn_house_term_record *term)
{
    return &rules->house->form->module->MEETING_records[term->walk];
}

/* ---- numbers */

/* Takes the number of one cell more. */
static void take(tn_walked *walked, uint32_t cell, int64_t number, bool greatest)
{
    bool first = walked->worth != TN_HAS_WORTH;
    if (first || (greatest ? number > walked->number : number < walked->number))
        *walked = (tn_walked){TN_HAS_WORTH, number, cell};
}

static tn_status walk(tn_house_rules *rules, const tn_house_term_record *term, tn_walked *walked, tn_error *error)
{
    const tn_house *house = rules->house;
    const tn_meeting_record *meeting = walk_of(rules, term);
    bool longest = term->kind == TN_HOUSE_LONGEST_WALK;
    tn_walk_question q;
    tn_status status = ask(rules, meeting, &q, error);
    *walked = (tn_walked){longest ? TN_BELOW_ALL : TN_ABOVE_ALL, 0, TN_NO_CELL};
    for (uint32_t i = 0; status == TN_OK && walked->worth != TN_NO_WORTH && i < house->cell_count; i++) {
        if (house->cells[i].open || !tn_house_decide(house, meeting->first, &house->cells[i]))
            continue;
        bool there = tn_walks_is_there(&rules->walks, &q.asked, i);
        uint32_t from = there ? TN_NO_POINT : tn_walks_from(&rules->walks, &q.asked, q.lengths, i);
        if (there || from != TN_NO_POINT)
            take(walked, i, there ? 0 : q.lengths[from], longest);
        else
            *walked = (tn_walked){TN_NO_WORTH, 0, i};
    }
    question_clear(&q);
    return status;
}

static tn_status exits(tn_house_rules *rules, const tn_house_term_record *term, tn_walked *walked, tn_error *error)
{
    const tn_house *house = rules->house;
    tn_status status = gather(rules, error);
    *walked = (tn_walked){TN_ABOVE_ALL, 0, TN_NO_CELL};
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++) {
        uint32_t number;
        if (house->cells[i].open || !tn_house_decide(house, term->part, &house->cells[i]))
            continue;
        status = tn_walks_exits(&rules->walks, i, &number, error);
        if (status == TN_OK && number != UINT32_MAX)
            take(walked, i, number, false);
    }
    return status;
}

tn_status tn_house_walked(tn_house_rules *rules, const tn_house_term_record *term, tn_walked *walked, tn_error *error)
{
    return (term->kind == TN_HOUSE_EXITS ? exits : walk)(rules, term, walked, error);
}

/* ---- places */

tn_status tn_house_walk_lines(tn_house_rules *rules, const tn_house_term_record *term, uint32_t cell,
                              tn_walk_line **lines, size_t *count, tn_error *error)
{
    tn_walk_question q;
    *lines = NULL;
    *count = 0;
    tn_status status = ask(rules, walk_of(rules, term), &q, error);
    bool there = status == TN_OK && tn_walks_is_there(&rules->walks, &q.asked, cell);
    uint32_t from = status == TN_OK && !there ? tn_walks_from(&rules->walks, &q.asked, q.lengths, cell) : TN_NO_POINT;
    if (from != TN_NO_POINT)
        status = tn_walks_lines(&rules->walks, q.lengths, q.next, from, lines, count, error);
    question_clear(&q);
    return status;
}
