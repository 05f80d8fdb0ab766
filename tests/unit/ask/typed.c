/* Houses that are typed in part, beside all houses of a small form gone through: the first that has what is typed, else
 * the first value that leaves none, and what it could be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/house/typed.h"
#include "runtime/base/random.h"
#include "runtime/house/rank/rank.h"
#include "tests/support/test_house.h"
#include "tests/support/test_schema.h"

static const char text[] =
    "schema hut { width role length = 8' | 12' zone body role band = room(10') role void\n"
    "  zone yard role band = none role absent | flag(6') role void }\n"
    "form huts of hut {\n"
    "  storey ground 9' storey loft 8' spine body wall 6\" partition 4\" floor 10\" roof 8\"\n"
    "  option body storeys = 1 | 2 option yard storeys = 1\n"
    "  option cladding = boards | bricks\n"
    "  forbid option(body storeys 2) and option(cladding boards)\n"
    "  void cell(body, loft, 8')\n"
    "  function bed at cell(body) function hall at cell(body, ground) function deck at cell(yard)\n"
    "  opening window wide 3' high 4' sill 2'8\"\n"
    "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"
    "  face cell(hall) beside cell(any) = open | door\n"
    "  face cell(bed) beside cell(bed) = door | wall\n"
    "  face cell(hall) outside front = door\n"
    "  face cell(bed) outside back = window | wall\n"
    "  tile cot for bed { against wall item cot left 1'..4', back 0..6', up 0..2' }\n"
    "  tile desk for bed { against window item desk left 0..right 0, back 0..2', up 0..3' }\n"
    "  material pine \"#c9c1ae\" price 10 per each for cot\n"
    "  material oak \"#c9c1ae\" price 25 per each for desk\n"
    "}\n"
    "measure price = sum(cost)\n"
    "library rows using hut { trays 1..2 prune neighbour(tray(8'), tray(8')) }\n"
    "library some from rows in huts { require cell(hall) prune quantity(room(bed), n > 2)\n"
    "  prune room(bed, not by window, not by door or open) }\n"
    "library dear from rows in huts { require price <= 40 require cell(bed) }\n";

enum { LINES_MAX = 200000, WORDS_MAX = 64 };

/* A line as its words, part by part. */
typedef struct words {
    char *line;
    const char *at[TN_LINE_PARTS][WORDS_MAX];
    size_t size[TN_LINE_PARTS][WORDS_MAX], count[TN_LINE_PARTS];
} words;

typedef struct listing {
    words *items;
    size_t count;
} listing;

/* Splits a line that the words borrow. */
static void split(char *line, words *w)
{
    int part = 0;
    *w = (words){.line = line};
    for (char *c = line; *c;) {
        size_t size = strcspn(c, " ;|");
        part += *c == ';';
        if (size > 0 && !(size == 1 && *c == '-')) {
            assert_true(part < TN_LINE_PARTS && w->count[part] < WORDS_MAX);
            w->at[part][w->count[part]] = c;
            w->size[part][w->count[part]++] = size;
        }
        c += size > 0 ? size : 1;
    }
}

static tn_status add(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    listing *l = context;
    tn_buffer line = {0};
    (void)stop;
    assert_true(l->count < LINES_MAX);
    tn_status status = tn_house_write(house, &line, error);
    split(line.data, &l->items[l->count++]);
    return status;
}

/* library: NULL: all houses of the form. */
static void list(const test_house *made, const tn_house_library_record *library, const tn_library *plans,
                 const tn_plan *plan, listing *l)
{
    const tn_house_library_record none = {0};
    const tn_houses_what what = {.only = plan->trays, .length = (uint32_t)plan->length};
    tn_houses *houses;
    tn_plan_houses *on_plan;
    tn_error error;
    mpz_t from, rank;
    mpz_inits(from, rank, NULL);
    *l = (listing){malloc(LINES_MAX * sizeof *l->items), 0};
    if (!library || tn_library_rank(plans, plan->trays, (uint32_t)plan->length, rank)) {
        test_ok(tn_houses_of(&made->form, library ? library : &none, library ? plans : NULL, &what, 0, &houses, &error),
                &error);
        test_ok(tn_plan_houses_new(houses, plan->trays, (uint32_t)plan->length, &on_plan, &error), &error);
        test_ok(tn_plan_houses_each(on_plan, from, add, l, &error), &error);
        tn_plan_houses_free(on_plan);
        tn_houses_free(houses);
    }
    mpz_clears(from, rank, NULL);
}

static void clear(listing *l)
{
    for (size_t i = 0; i < l->count; i++)
        free(l->items[i].line);
    free(l->items);
}

static bool same(const words *a, const words *b, int part, size_t at)
{
    return a->size[part][at] == b->size[part][at] && memcmp(a->at[part][at], b->at[part][at], a->size[part][at]) == 0;
}

static bool is_out(const words *typed, int part, size_t at)
{
    return typed->size[part][at] == 1 && typed->at[part][at][0] == '_';
}

/* Has the house the first so many typed values; free: the last of these may be anything. */
static bool matches(const words *house, const words *typed, size_t count, bool last_free)
{
    size_t number = 0;
    for (int part = TN_LINE_SECTION; part < TN_LINE_PARTS; part++)
        for (size_t i = 0; i < typed->count[part]; i++) {
            if (is_out(typed, part, i))
                continue;
            if (number++ >= count)
                return true;
            if (house->count[part] != typed->count[part])
                return false;
            if (!same(house, typed, part, i) && !(last_free && number == count))
                return false;
        }
    return true;
}

static size_t typed_values(const words *typed)
{
    size_t count = 0;
    for (int part = TN_LINE_SECTION; part < TN_LINE_PARTS; part++)
        for (size_t i = 0; i < typed->count[part]; i++)
            count += !is_out(typed, part, i);
    return count;
}

static const words *first(const listing *l, const words *typed, size_t count)
{
    for (size_t i = 0; i < l->count; i++)
        if (matches(&l->items[i], typed, count, false))
            return &l->items[i];
    return NULL;
}

/* Which value of the line is the so manyeth that is typed? */
static void find_value(const words *typed, size_t number, int *part, size_t *at)
{
    for (*part = TN_LINE_SECTION; *part < TN_LINE_PARTS; ++*part)
        for (*at = 0; *at < typed->count[*part]; ++*at)
            if (!is_out(typed, *part, *at) && number-- == 0)
                return;
}

/* Is the error about the first value that leaves none, and names what it can be, each and nothing else? */
static void expect_refused(const listing *form, const words *typed, const tn_error *error)
{
    size_t count = 0, at = 0, could = 0, named = 1;
    int part = 0;
    while (first(form, typed, count))
        count++;
    assert_true(count > 0);
    find_value(typed, count - 1, &part, &at);
    assert_int_equal(error->column, typed->at[part][at] - typed->line + 1);
    const char *names[LINES_MAX / 100];
    for (size_t i = 0; i < form->count; i++) {
        const words *house = &form->items[i];
        char word[80];
        bool known = false;
        if (!matches(house, typed, count, true))
            continue;
        snprintf(word, sizeof word, "%.*s", (int)house->size[part][at], house->at[part][at]);
        for (size_t k = 0; k < could; k++)
            known |= strcmp(names[k], word) == 0;
        if (known)
            continue;
        if (!strstr(error->help, word))
            fail_msg("%s: %s, and not %s (%s)", error->message, error->help, word, typed->line);
        names[could++] = strdup(word);
    }
    for (const char *c = error->help; could > 0 && *c; c++)
        named += *c == ',';
    if (could > 0)
        assert_int_equal(named, could);
    else
        assert_non_null(strstr(error->help, "another number"));
    for (size_t k = 0; k < could; k++)
        free((char *)(uintptr_t)names[k]);
}

/* Has a part words, and none that is typed? How many these are is a mistake, though they ask nothing. */
static bool asks_nothing(const words *typed)
{
    bool any = false;
    for (int part = TN_LINE_SECTION; part < TN_LINE_PARTS; part++) {
        bool out = typed->count[part] > 0;
        for (size_t i = 0; i < typed->count[part]; i++)
            out &= is_out(typed, part, i);
        any |= out;
    }
    return any;
}

static tn_status count_mistakes(void *context, tn_error *error)
{
    (void)error;
    ++*(size_t *)context;
    return TN_OK;
}

typedef struct typed_tally {
    size_t kept, of_form, refused, wrong;
} typed_tally;

static void try_line(const tn_typed_among *among, const char *line, const listing *kept, const listing *form,
                     typed_tally *tally)
{
    char *copy = strdup(line);
    words typed;
    tn_house house = {0};
    tn_typed_told told;
    tn_error error = {0};
    size_t mistakes = 0;
    split(copy, &typed);
    size_t values = typed_values(&typed);
    tn_status status = tn_typed_find(among, line, strlen(line), count_mistakes, &mistakes, &house, &told, &error);
    const words *best = first(kept, &typed, values), *any = first(form, &typed, values);
    if (status == TN_OK) {
        tn_buffer found = {0};
        test_ok(tn_house_write(&house, &found, &error), &error);
        const char *expected = told.completed && best ? best->line : any ? any->line : "none";
        if (strcmp(found.data, expected) != 0)
            fail_msg("%s\nis %s\nand not %s", line, found.data, expected);
        assert_int_equal(told.told.size > 0, told.completed && !best);
        tally->kept += best != NULL;
        tally->of_form += best == NULL;
        free(found.data);
    } else {
        assert_int_equal(status, TN_INVALID);
        if (any && !asks_nothing(&typed))
            fail_msg("%s: %s", line, error.message);
        bool refused = strstr(error.message, ", no house has") != NULL;
        if (refused)
            expect_refused(form, &typed, &error);
        tally->refused += refused;
        tally->wrong += !refused;
    }
    tn_typed_told_clear(&told);
    tn_house_clear(&house);
    free(copy);
}

/* A line of the form, with some of its values left out, and perhaps some of another line. */
static void draw_line(const listing *form, uint64_t seed, char *line)
{
    uint64_t index = 0;
    const words *from = &form->items[tn_random64(seed, 0, index++) % form->count];
    const words *other = &form->items[tn_random64(seed, 0, index++) % form->count];
    size_t out = 2 + tn_random64(seed, 0, index++) % 5, strange = 3 + tn_random64(seed, 0, index++) % 20;
    size_t used = (size_t)sprintf(line, "%.*s", (int)strcspn(from->line, ";"), from->line);
    for (int part = TN_LINE_SECTION; part < TN_LINE_PARTS; part++) {
        used += (size_t)sprintf(line + used, "; ");
        bool none = tn_random64(seed, 0, index++) % 4 == 0;
        if (none || from->count[part] == 0)
            used += (size_t)sprintf(line + used, "- ");
        const char *bar = strchr(from->at[part][0] ? from->at[part][0] : "", '|');
        for (size_t i = 0; !none && i < from->count[part]; i++) {
            bool strangers = tn_random64(seed, 0, index++) % strange == 0 && i < other->count[part];
            const words *w = strangers ? other : from;
            if (part == TN_LINE_FUNCTIONS && i > 0 && bar && from->at[part][i] > bar && from->at[part][i - 1] < bar)
                used += (size_t)sprintf(line + used, "| ");
            if (tn_random64(seed, 0, index++) % out == 0)
                used += (size_t)sprintf(line + used, "_ ");
            else
                used += (size_t)sprintf(line + used, "%.*s ", (int)w->size[part][i], w->at[part][i]);
        }
    }
}

static void try_plan(const test_house *made, const tn_house_library_record *library, const tn_library *plans,
                     const char *plan_line, typed_tally *tally)
{
    tn_plan plan = test_house_plan(made, plan_line);
    const tn_typed_among among = {.form = &made->form, .library = library, .plans = plans, .max_length = 8};
    listing kept, form;
    char line[4096];
    list(made, library, plans, &plan, &kept);
    list(made, NULL, NULL, &plan, &form);
    for (uint64_t seed = 0; seed < 300; seed++) {
        draw_line(&form, seed, line);
        try_line(&among, line, &kept, &form, tally);
    }
    clear(&kept);
    clear(&form);
    free(plan.trays);
}

static void test_first_house(void **state)
{
    (void)state;
    static const char *const lines[] = {"12' room:10' flag:6'", "8' room:10' none | 12' room:10' none",
                                        "12' room:10' none | 8' room:10' flag:6'",
                                        "8' room:10' none | 8' room:10' none"};
    test_house made;
    tn_library *plans;
    tn_error error;
    const tn_library_options options = {0};
    typed_tally tally = {0};
    test_house_compile(&made, text);
    test_ok(tn_library_new(made.schema, made.some->plans, &options, &plans, &error), &error);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        try_plan(&made, made.some, plans, lines[i], &tally);
        try_plan(&made, made.all, plans, lines[i], &tally);
    }
    print_message("%zu kept, %zu of the form, %zu refused, %zu wrong\n", tally.kept, tally.of_form, tally.refused,
                  tally.wrong);
    assert_true(tally.kept > 100 && tally.of_form > 100 && tally.refused > 100 && tally.wrong > 10);
    tn_library_free(plans);
    test_house_clear(&made);
}

/* All mistakes of a line are said, each at its place; `_` is none. */
static void test_all_mistakes(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        size_t mistakes;
    } cases[] = {{"12' room:10' flag:6' ; 3 1 bricks ; bad _ deck ; door", 2},
                 {"12' room:10' flag:6' ; 1 1 boards ; bed deck ; wall window ; ", 1},
                 {"12' room:10' flag:6' ; _ 1 bricks ; bed bed stove ; wide ; cott.left", 3},
                 {"12' room:10' flag:6' ; 1 ; bed", 1},
                 {"12' room:10' _ ; 1 1 boards ; bed", 1},
                 {"{\"house\": \"12' room:10' flag:6' ; 5 1 boards ; bd deck\"}", 2},
                 {"{\"hose\": 1}", 1},
                 {";;;;;", 1}};
    test_house made;
    tn_error error = {0};
    test_house_compile(&made, text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const tn_typed_among among = {.form = &made.form, .max_length = 8};
        tn_house house = {0};
        tn_typed_told told;
        size_t mistakes = 1;
        assert_int_equal(tn_typed_find(&among, cases[i].line, strlen(cases[i].line), count_mistakes, &mistakes, &house,
                                       &told, &error),
                         TN_INVALID);
        if (mistakes != cases[i].mistakes)
            fail_msg("%zu mistakes in %s", mistakes, cases[i].line);
        tn_typed_told_clear(&told);
        tn_house_clear(&house);
    }
    test_house_clear(&made);
}

/* Choices that are tried are counted. */
static void test_limit(void **state)
{
    (void)state;
    static const char typed[] =
        "8' room:10' none | 12' room:10' none ; _ 1 bricks ; _ _ | _ _ ; - ; cot.left desk.back";
    const tn_house_library_record none = {0};
    test_house made;
    tn_house_line line;
    tn_houses *houses;
    tn_plan_houses *on_plan;
    tn_error error;
    bool wrong = true, found = true;
    size_t mistakes = 0;
    uint64_t work = 2;
    tn_house house = {0};
    test_house_compile(&made, text);
    test_ok(
        tn_house_line_read(&made.form, typed, sizeof typed - 1, 8, count_mistakes, &mistakes, &line, &wrong, &error),
        &error);
    assert_false(wrong);
    const tn_houses_what what = {.only = line.plan.trays, .length = (uint32_t)line.plan.length};
    const tn_line_asked asked = {&line, line.typed, NULL};
    test_ok(tn_houses_of(&made.form, &none, NULL, &what, 0, &houses, &error), &error);
    test_ok(tn_plan_houses_new(houses, line.plan.trays, (uint32_t)line.plan.length, &on_plan, &error), &error);
    assert_int_equal(tn_plan_houses_typed(on_plan, &asked, &work, &house, &found, &error), TN_LIMIT);
    assert_int_equal(error.code, E_VARIANTS);
    assert_non_null(strstr(error.message, "has what is typed takes more than 200000 choices"));
    assert_non_null(strstr(error.help, "type more"));
    tn_house_clear(&house);
    tn_plan_houses_free(on_plan);
    tn_houses_free(houses);
    tn_house_line_clear(&line);
    test_house_clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_first_house), cmocka_unit_test(test_all_mistakes),
                                       cmocka_unit_test(test_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
