/* Numbers the rooms of a house, storey by storey, and tags the kinds of its doors and windows. */
#include "runtime/house/model/designations.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/utf8.h"
#include "runtime/house/model/model.h"

void tn_designations_clear(tn_designations *names)
{
    free(names->rooms);
    free(names->numbered);
    free(names->openings);
    *names = (tn_designations){0};
}

/* ---- rooms */

/* Words with blanks between them: what the room is for or, as long as that is not known, its zone. */
static void write_name(const tn_house *house, const tn_cell *cell, char *text, size_t size)
{
    const tn_schema *schema = house->form->schema;
    const char *name = cell->function == TN_NO_FUNCTION
                           ? tn_text(schema->module, schema->fields[cell->zone].name)
                           : tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name);
    tn_utf8_copy(name, size, text);
    for (char *c = text; *c; c++)
        *c = (char)(*c == '-' || *c == '_' ? ' ' : *c);
}

static double net_of(const tn_house *house, uint32_t cell)
{
    tn_rectangle r = tn_cell_clear(house, cell);
    return (double)(r.x1 - r.x0) * (double)(r.y1 - r.y0);
}

/* What of a room is in a storey; false if nothing is. */
static bool measure(const tn_house *house, const uint32_t *rooms, tn_numbered_room *found)
{
    double most = -1;
    found->gross = found->net = 0;
    for (uint32_t i = found->room; i < house->cell_count; i++) {
        if (rooms[i] != found->room || house->cells[i].storey != found->storey || house->cells[i].open)
            continue;
        double net = net_of(house, i);
        found->gross += (double)tn_cell_area(&house->cells[i]);
        found->net += net;
        found->largest = net > most ? i : found->largest;
        most = net > most ? net : most;
    }
    return most >= 0;
}

static void number_storey(const tn_house *house, uint32_t storey, bool us, tn_designations *names)
{
    unsigned number = 0;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        tn_numbered_room found = {.room = i, .storey = storey};
        if (names->rooms[i] != i || !measure(house, names->rooms, &found))
            continue;
        number++;
        if (us)
            snprintf(found.number, sizeof found.number, "%u", (storey + 1) * 100 + number);
        else
            snprintf(found.number, sizeof found.number, "%u.%02u", storey, number);
        write_name(house, &house->cells[found.largest], found.name, sizeof found.name);
        names->numbered[names->room_count++] = found;
    }
}

/* ---- openings */

static size_t count_of(const tn_house *house, uint32_t kind)
{
    size_t count = 0;
    for (size_t i = 0; i < house->face_count; i++)
        count += house->faces[i].kind == kind && house->faces[i].relation != TN_FACE_UNDER;
    return count;
}

static void tag_openings(const tn_house *house, tn_designations *names)
{
    unsigned doors = 0, windows = 0;
    for (uint32_t i = 0; i < house->form->record->opening_count; i++) {
        uint32_t kind = TN_FACE_KIND_COUNT + i;
        const tn_opening_record *opening = tn_form_opening(house->form, kind);
        size_t count = opening && !(opening->flags & TN_LEAFLESS) ? count_of(house, kind) : 0;
        if (count == 0)
            continue;
        tn_tagged_opening *tagged = &names->openings[names->opening_count++];
        *tagged = (tn_tagged_opening){.kind = kind, .count = count};
        if (opening->flags & TN_PASSAGE)
            snprintf(tagged->tag, sizeof tagged->tag, "D%u", ++doors);
        else
            snprintf(tagged->tag, sizeof tagged->tag, "W%u", ++windows);
    }
}

tn_status tn_designations_find(const tn_house *house, bool us, tn_designations *names, tn_error *error)
{
    *names = (tn_designations){0};
    tn_status status = tn_house_rooms(house, &names->rooms, error);
    if (status != TN_OK)
        return status;
    names->numbered = malloc((house->cell_count + 1) * sizeof *names->numbered);
    names->openings = malloc((house->form->record->opening_count + 1) * sizeof *names->openings);
    if (!names->numbered || !names->openings)
        return tn_fail_memory(error);
    for (uint32_t storey = 0; storey < house->form->record->storey_count; storey++)
        number_storey(house, storey, us, names);
    tag_openings(house, names);
    return TN_OK;
}

const char *tn_designation_of(const tn_designations *names, const tn_face *face)
{
    for (size_t i = 0; face->relation != TN_FACE_UNDER && i < names->opening_count; i++)
        if (names->openings[i].kind == face->kind)
            return names->openings[i].tag;
    return NULL;
}
