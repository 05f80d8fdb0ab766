/* Draws forms of huts, with libraries and measures of them. */
#include "tests/support/drawn_house.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static uint32_t draw(drawn_house *d, uint32_t below)
{
    d->state = d->state * UINT64_C(6364136223846793005) + 1442695040888963407u;
    return (uint32_t)(d->state >> 33) % below;
}

static void put(drawn_house *d, const char *piece)
{
    size_t size = strlen(piece);
    assert_true(d->size + size < sizeof d->text);
    memcpy(d->text + d->size, piece, size + 1);
    d->size += size;
}

#define ONE_OF(D, ...) ONE_OF_LIST(D, ((const char *const[]){__VA_ARGS__}))
#define ONE_OF_LIST(D, LIST) put(D, (LIST)[draw(D, sizeof(LIST) / sizeof *(LIST))])

static void put_cell(drawn_house *d)
{
    ONE_OF(d, "cell(living)", "cell(bed)", "cell(stair)", "cell(seat)", "cell(void)", "cell(any)",
           "cell(bed or living)", "cell(body, loft)", "cell(not bed, ground)", "cell(area < 90sf)", "cell(8')",
           "cell(bed, 10')", "cell(bay)");
}

static void put_room(drawn_house *d)
{
    put(d, "room(");
    ONE_OF(d, "bed", "living", "any", "not stair", "body", "seat");
    if (draw(d, 2))
        ONE_OF(d, ", glazing < 1:9", ", glazing >= 1:11", ", not by window", ", by window", ", by door",
               ", not by open", ", by wall", ", by floor");
    if (draw(d, 2))
        ONE_OF(d, ", area < 100sf", ", area >= 160sf", ", cells > 1", ", cells = 2", ", cells <= 1");
    put(d, ")");
}

static void put_by(drawn_house *d)
{
    ONE_OF(d, "", "", " by open", " by door", " by stair", " by wall or door", " by floor");
    put(d, ")");
}

static void put_expression(drawn_house *d, int depth);

static void put_simple(drawn_house *d)
{
    switch (draw(d, 10)) {
    case 0:
        put_cell(d);
        return;
    case 1:
        put_room(d);
        return;
    case 2:
        put(d, "touch(");
        put_cell(d);
        put(d, ", ");
        put_cell(d);
        put_by(d);
        return;
    case 3:
    case 4:
        put(d, "apart(");
        put_cell(d);
        put(d, ", from ");
        put_cell(d);
        if (draw(d, 2)) {
            put(d, ", through ");
            put_cell(d);
        }
        put(d, ")");
        return;
    case 5:
        put(d, "quantity(");
        put_cell(d);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n in 1..3)", ", n mod 2 = 0)");
        return;
    case 6:
        put(d, "quantity(");
        put_room(d);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n < 2)", ", n = 0)");
        return;
    case 7:
        put(d, "sum(area of ");
        put_cell(d);
        ONE_OF(d, ", a < 200sf)", ", a >= 150sf)", ", a > 300sf)");
        return;
    case 8:
        ONE_OF(d, "option(body storeys 1)", "option(cladding board)", "option(body roof gable)");
        return;
    default:
        ONE_OF(d, "tray(8')", "tray(bay open)", "neighbour(tray(8'), tray(10'))", "neighbour(beginning, tray(10'))");
        return;
    }
}

static void put_walk(drawn_house *d)
{
    put(d, "apart(");
    put_cell(d);
    put(d, ", from ");
    put_cell(d);
    if (draw(d, 2)) {
        put(d, ", through ");
        put_cell(d);
    }
    put(d, ")");
}

/* What has a place in the row, rooms and walks above all. */
static void put_placed(drawn_house *d, int depth)
{
    switch (draw(d, depth > 0 ? 13 : 6)) {
    case 0:
    case 1:
    case 2:
        put_room(d);
        return;
    case 3:
        put_walk(d);
        return;
    case 4:
        put(d, "quantity(");
        put_room(d);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n < 2)", ", n = 0)", ", n mod 2 = 0)");
        return;
    case 5:
        ONE_OF(d, "tray(8')", "tray(bay open)", "cell(bed)", "touch(cell(bed), cell(living))");
        return;
    case 6:
        put(d, "many(");
        put_placed(d, depth - 1);
        put(d, ")");
        return;
    case 7:
        put(d, "not ");
        put_placed(d, depth - 1);
        return;
    case 8:
        put(d, "(");
        put_placed(d, depth - 1);
        ONE_OF(d, " and ", " or ", " implies ");
        put_placed(d, depth - 1);
        put(d, ")");
        return;
    case 9:
        put(d, "quantity(");
        put_placed(d, depth - 1);
        ONE_OF(d, ", n > 1)", ", n = 1)", ", n mod 2 = 0)");
        return;
    case 10:
        put(d, "distance(from ");
        put_placed(d, depth - 1);
        put(d, ", to ");
        put_placed(d, depth - 1);
        ONE_OF(d, ", by quantity(any, n >= 1))", ", by sum(width, w > 9'))", ", by quantity(tray(8'), n = 0))");
        return;
    case 11:
        put(d, "occurrences(");
        put_placed(d, depth - 1);
        ONE_OF(d, ", n > 1)", ", n = 1)");
        return;
    default:
        ONE_OF(d, "neighbour(", "symmetric neighbour(");
        ONE_OF(d, "beginning, ", "", "", "optional(tray(8')), ");
        put_placed(d, depth - 1);
        put(d, ", ");
        put_placed(d, depth - 1);
        ONE_OF(d, ")", ")", ", end)");
    }
}

static void put_row(drawn_house *d)
{
    put(d, draw(d, 3) ? "neighbour(" : "symmetric neighbour(");
    put_cell(d);
    put(d, ", ");
    switch (draw(d, 4)) {
    case 0:
        put(d, "many(");
        put_cell(d);
        put(d, ")");
        break;
    case 1:
        put(d, "end");
        break;
    case 2:
        put(d, "touch(");
        put_cell(d);
        put(d, ", ");
        put_cell(d);
        put_by(d);
        break;
    default:
        put_cell(d);
    }
    put(d, ")");
}

static void put_expression(drawn_house *d, int depth)
{
    uint32_t kind = depth > 0 ? draw(d, 7) : 6;
    if (kind == 0)
        put(d, "not (");
    if (kind < 3) {
        put(d, kind == 0 ? "" : "(");
        put_expression(d, depth - 1);
        if (kind > 0) {
            put(d, kind == 1 ? " and " : " or ");
            put_expression(d, depth - 1);
        }
        put(d, ")");
    } else if (kind == 3) {
        put_row(d);
    } else {
        put_simple(d);
    }
}

static void put_roofs(drawn_house *d)
{
    ONE_OF(d,
           "  option body roof = gable(9:12, eaves 1'6\", open)\n  option bay roof = shed(front, 3:12, eaves 1')\n",
           "  option body roof = vault(3', across) | gable(6:12, across)\n",
           "  option body roof = shed(back, 4:12, eaves 2') | flat\n  option bay roof = vault(1')\n",
           "  option body roof = gable(7:12, across, open)\n  option bay roof = gable(12:12)\n");
}

static void put_materials(drawn_house *d)
{
    put(d, "  material brick \"#888888\" price 12.35 per ");
    ONE_OF(d, "sf", "m2", "cf", "each");
    put(d, " for wall, post where option(cladding board)\n  material shingles \"#888888\" price 9.10 per ");
    ONE_OF(d, "sf", "m3", "cf");
    put(d, " for wall, party\n  material planks \"#888888\" price 41.7 per ");
    ONE_OF(d, "sf for partition, floor\n", "cf for partition\n", "each for floor, partition\n", "m2 for floor, post\n");
    put(d, "  material slates \"#888888\" price 17 per ");
    ONE_OF(d, "sf", "sf", "m3", "each");
    put(d, " for roof\n");
    ONE_OF(d, "  material glass \"#888888\" price 333.33 per each for window, door\n",
           "  material glass \"#888888\" price 80 per sf for window\n");
    if (strstr(d->text, "item cot"))
        ONE_OF(d, "  material pine \"#888888\" price 55.5 per sf for cot\n",
               "  material pine \"#888888\" price 55.5 per each for cot\n",
               "  material pine \"#888888\" price 7 per cf for cot where option(cladding board)\n", "");
}

static void put_form(drawn_house *d)
{
    put(d, "form huts of hut {\n  storey ground 9'\n  storey loft 8'\n  wall 8\"\n  partition 4\"\n  floor 10\"\n  roof "
           "8\"\n");
    ONE_OF(d, "  option body storeys = 1 | 2\n", "  option body storeys = 2 | 1\n",
           "  option bay storeys = 1\n  option body storeys = 1 | 2\n");
    if (d->priced)
        put_roofs(d);
    else
        put(d, "  option body roof = gable(9:12) | vault(3')\n");
    put(d, "  option cladding = shingle | board\n");
    ONE_OF(d, "", "  void cell(loft, 10')\n", "  void cell(body 12', loft)\n", "  no cell(bay, loft)\n");
    put(d, "  function living at cell(body, ground)\n");
    put(d, d->places ? "  function bed at cell(any)\n" : "  function bed at cell(body)\n");
    ONE_OF(d, "  function stair at cell(body)\n", "  function stair at cell(body, 8')\n");
    ONE_OF(d, "  function seat at cell(bay)\n", "  function seat at cell(bay)\n",
           "  function seat outdoor at cell(bay)\n",
           "  function seat outdoor at cell(bay)\n  face cell(bed) beside cell(seat) = window | door\n");
    put(d, "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"
           "  opening window wide 3' high 4' sill 2'8\" glazed\n  opening arch wide 4' high 7' passage leafless\n");
    if (d->ways)
        put(d, "  flight dogleg wide 2'6\" rise 6\"..9\" going 9\" turn half\n  way 2'4\"\n  way 2' for bed\n");
    if (d->places)
        put(d, "  face cell(bed) beside cell(bed) = open | wall\n");
    ONE_OF(d, "", "  face cell(bed) along cell(bed) = open | wall\n",
           "  face cell(living) along cell(any) = party | door\n");
    if (d->ways)
        ONE_OF(d, "  face cell(stair) under cell(stair) = dogleg\n",
               "  face cell(any) under cell(stair) = dogleg | floor\n", "");
    else
        ONE_OF(d, "  face cell(stair) under cell(stair) = stair\n",
               "  face cell(any) under cell(stair) = stair | floor\n", "");
    put(d, "  face cell(living) beside cell(living) = open | door\n");
    ONE_OF(d, "  face cell(seat) across cell(any) = open\n", "  face cell(seat) beside cell(any) = open | wall\n",
           "  face cell(seat) beside cell(any) = arch | wall\n", "");
    put(d, "  face cell(any) beside cell(any) = door\n");
    if (d->places) {
        put(d, "  face cell(any) outside left = wall | window\n  face cell(bed) outside back = window\n");
    } else {
        ONE_OF(d, "  face cell(bed) outside = window | wall\n", "  face cell(bed) outside front = window | wall\n",
               "  face cell(any) outside left = wall | window\n", "  face cell(bed) outside back = window | open\n");
        ONE_OF(d, "  face cell(seat) outside front = window | wall\n", "", "  face cell(seat) outside = open\n",
               "  face cell(seat) outside front = open | wall\n  face cell(any) outside right = open\n");
    }
    ONE_OF(
        d,
        "  tile cot for bed { against wall or window wide 7'..12' item cot left 1'..right 1', back 0..6', up 0..2' }\n",
        "  tile rug for bed, living { item rug left 2'..right 2', back 1'..4' keep edge left 0..1' }\n"
        "  tile cot for bed { against wall item cot right 3'..right 0, back 0..6'6\", up 0..2' }\n",
        "  tile bench for seat { against open or wall item bench left 0..right 0, back 0..1'6\" }\n"
        "  tile cot for bed { item cot left 0..3', back 0..6' }\n",
        "");
    if (d->priced)
        put_materials(d);
    put(d, "}\n");
}

static void put_measures(drawn_house *d)
{
    put(d, "measure first using huts = 3 * quantity(");
    put_cell(d);
    put(d, ") - 1/2 * quantity(");
    put_room(d);
    put(d, ") + 7\nmeasure second using huts = sum(area of ");
    put_cell(d);
    ONE_OF(d, ") + sum(width) * 1'", ") - 2 * sum(area of cell(bed))", ")");
    put(d, "\nmeasure third using huts = 10 * second / 1sf - first + 5 * quantity(tray(10')) + matches(");
    ONE_OF(d, "neighbour(tray(8'), tray(10'))", "tray(bay open)");
    put(d, ")\nmeasure fourth using hut = sum(width) + occurrences(tray(8')) * 1'\n");
}

static void put_small(drawn_house *d)
{
    if (d->places) {
        put(d, "  require option(cladding board), option(body roof gable)\n"
               "  require quantity(cell(any), n < 6) or (quantity(cell(any), n = 6) and not cell(living or loft))\n");
        put(d, "  prune cell(stair), quantity(cell(bed), n > 5)\n");
        return;
    }
    put(d, "  require quantity(cell(any), n < 4), option(cladding board)\n"
           "  prune cell(stair), quantity(cell(bed), n > 1)\n");
}

/* Clauses that compare what is added up over houses. */
static void put_comparisons(drawn_house *d)
{
    ONE_OF(d, "  require second >= 100sf\n", "  require first in 6..10\n", "  prune first > 8 and second < 90sf\n",
           "  require third > 20 or cell(bed)\n", "  prune 2 * second > 100sf + 4 * sum(width) * 1'\n", "");
    if (d->priced)
        ONE_OF(d, "  require fifth <= 5000\n", "  prune fifth in -4000..9000 as middle\n",
               "  require not fifth > 40 * second / 1sf\n", "  prune option(body storeys 1) implies fifth < 7000\n",
               "  require fifth + 1000 * quantity(tray(10')) in 1000..12000 or cell(seat)\n",
               "  require fifth >= 4000 and quantity(cell(bed)) = 1\n");
    else
        ONE_OF(d, "  require quantity(room(bed)) <= quantity(cell(living))\n",
               "  prune first != 7 and not cell(seat)\n");
}

void drawn_house_write(drawn_house *d)
{
    d->size = 0;
    d->ways = (d->state >> 40) % 3 == 0;
    put(d, "schema hut {\n  width role length = 8' | 10'\n  zone body role band = room(10', 12')\n"
           "  zone bay role band = empty role absent | open(4')\n}\n");
    put_form(d);
    put(d,
        d->priced || d->places ? "library rows using hut { trays 1..3 }\n" : "library rows using hut { trays 1..2 }\n");
    put(d, "library all from rows in huts {\n");
    if (d->compares || d->places)
        put_small(d);
    put(d, "}\nlibrary some from rows in huts {\n");
    if (d->priced || d->compares || d->places)
        put_small(d);
    if (d->compares)
        put_comparisons(d);
    for (uint32_t i = d->priced || d->places ? draw(d, 2) : 1 + draw(d, 3); i > 0; i--) {
        put(d, draw(d, 2) ? "  require " : "  prune ");
        put_expression(d, 2);
        put(d, "\n");
    }
    if (d->places) {
        ONE_OF(d, "  require ", "  prune ");
        put_placed(d, 2);
        put(d, "\n");
    }
    put(d, "}\n");
    put_measures(d);
    if (d->priced)
        ONE_OF(d, "measure fifth using huts = sum(cost)\n", "measure fifth using huts = 100 - 1.1 * sum(cost)\n",
               "measure fifth using huts = sum(cost) / 2 + 35.5 * quantity(cell(bed)) - 2 * sum(width) / 1'\n");
}
