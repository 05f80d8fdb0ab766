/* In how many ways plans are derived: random rules, rules that use themselves among them, against a count straight from
 * the equations of docs/plan-language.md, plan by plan; and numbers that are known. */
#include "runtime/plan/ways/library_ways.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/buffer.h"
#include "runtime/load.h"
#include "runtime/plan/ways/plan_ways.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_rule.h"

/* ---- rules as trees */

typedef enum word { TRAY, OR, AND, NEIGHBOUR, REPEAT, SYMMETRIC, NAME, NOT, IMPLIES, BESIDE, MANY, KINDS } word;

enum { LETTERS = 3, PARTS = 3, NODES = 400, RULES = 3, LONGEST = 4 };

typedef struct node {
    word kind;
    uint32_t letters; /* tray: those allowed, a bit each */
    struct node *parts[PARTS];
    uint32_t count;
    bool optional[PARTS];
    bool beginning, end;
    uint32_t least, most; /* most 0: any number */
    uint32_t rule;        /* name */
} node;

typedef struct grammar {
    node nodes[NODES];
    uint32_t count;
    node *rules[RULES];
    node *generate;
    test_random random;
    tn_buffer text;
} grammar;

static uint32_t below(grammar *g, uint32_t bound)
{
    return test_random_below(&g->random, bound);
}

static node *make(grammar *g, word kind)
{
    assert_true(g->count < NODES);
    node *made = &g->nodes[g->count++];
    *made = (node){.kind = kind};
    return made;
}

static node *with(node *made, node *part)
{
    made->parts[made->count++] = part;
    return made;
}

static node *tray(grammar *g)
{
    node *made = make(g, TRAY);
    made->letters = 1 + below(g, (1u << LETTERS) - 1);
    return made;
}

static node *name(grammar *g, uint32_t rule)
{
    node *made = make(g, NAME);
    made->rule = rule;
    return made;
}

static node *expression(grammar *g, unsigned depth, bool names);

/* One of its parts, at least, is not optional. */
static node *neighbour(grammar *g, unsigned depth, bool names)
{
    node *made = make(g, NEIGHBOUR);
    uint32_t count = 1 + below(g, PARTS), sure = below(g, count);
    for (uint32_t i = 0; i < count; i++) {
        with(made, expression(g, depth, names));
        made->optional[i] = i != sure && below(g, 3) == 0;
    }
    made->beginning = below(g, 8) == 0;
    made->end = below(g, 8) == 0;
    return made;
}

static node *repeat(grammar *g, node *part)
{
    node *made = with(make(g, REPEAT), part);
    made->least = 1 + below(g, 2);
    made->most = below(g, 2) ? 0 : made->least + below(g, 2);
    return made;
}

static node *expression(grammar *g, unsigned depth, bool names)
{
    uint32_t choice = below(g, 22);
    if (depth == 0 || choice < 3)
        return tray(g);
    depth--;
    if (choice < 8)
        return neighbour(g, depth, names);
    if (choice < 12)
        return with(with(make(g, OR), expression(g, depth, names)), expression(g, depth, names));
    if (choice < 14)
        return with(with(make(g, AND), expression(g, depth, names)), expression(g, depth, names));
    if (choice < 16)
        return repeat(g, expression(g, depth, names));
    if (choice == 16)
        return with(make(g, SYMMETRIC), neighbour(g, depth, names));
    if (choice == 17)
        return with(make(g, NOT), expression(g, depth, names));
    if (choice == 18)
        return with(with(make(g, IMPLIES), expression(g, depth, names)), expression(g, depth, names));
    if (choice == 19)
        return with(with(make(g, BESIDE), expression(g, depth, names)), expression(g, depth, names));
    if (choice == 20)
        return with(make(g, MANY), tray(g));
    return names ? name(g, below(g, RULES)) : tray(g);
}

/* A rule of the circle beside something that takes a tray. */
static node *go_round(grammar *g, uint32_t rule, uint32_t side)
{
    node *made = make(g, NEIGHBOUR), *other = expression(g, 1, false), *again = name(g, rule);
    bool several = below(g, 5) == 0;
    if (several)
        again = repeat(g, again);
    if (side == 0)
        return with(with(made, other), again);
    if (side == 1)
        return with(with(made, again), other);
    with(with(made, tray(g)), again);
    with(made, below(g, 2) ? name(g, rule) : expression(g, 1, false));
    made->optional[2] = below(g, 3) == 0;
    return made;
}

/* The first rule uses itself; the others use each other, and one of these may be the other as it stands. */
static void make_rules(grammar *g)
{
    for (uint32_t r = 0; r < RULES; r++) {
        uint32_t side = below(g, 3), other = r == 0 ? 0 : 3 - r;
        node *body = with(with(make(g, OR), tray(g)), go_round(g, below(g, 3) ? other : r, side));
        if (r == 1 && below(g, 2))
            with(body, name(g, 2));
        else if (below(g, 2))
            with(body, go_round(g, other, below(g, 2) ? side : below(g, 3)));
        g->rules[r] = body;
    }
    g->generate = below(g, 4) ? expression(g, 3, true) : name(g, below(g, RULES));
}

/* ---- as text */

static void print(grammar *g, const node *n);

static void print_parts(grammar *g, const node *n, const char *between)
{
    for (uint32_t i = 0; i < n->count; i++) {
        tn_buffer_printf(&g->text, "%s%s", i ? between : "", n->optional[i] ? "optional(" : "");
        print(g, n->parts[i]);
        tn_buffer_printf(&g->text, "%s", n->optional[i] ? ")" : "");
    }
}

static void print(grammar *g, const node *n)
{
    static const char *const before[KINDS] = {
        [OR] = "(",     [AND] = "(",     [SYMMETRIC] = "symmetric (", [NOT] = "(not ", [IMPLIES] = "(",
        [BESIDE] = "(", [MANY] = "many("};
    static const char *const sets[] = {"tray(a)",     "tray(b)",     "tray(not c)", "tray(c)",
                                       "tray(not b)", "tray(not a)", "any"};
    static const char *const between[KINDS] = {
        [OR] = " or ", [AND] = " and ", [IMPLIES] = " implies ", [BESIDE] = " beside "};
    if (n->kind == TRAY) {
        tn_buffer_printf(&g->text, "%s", sets[n->letters - 1]);
    } else if (n->kind == NAME) {
        tn_buffer_printf(&g->text, "r%u", n->rule);
    } else if (n->kind == NEIGHBOUR) {
        tn_buffer_printf(&g->text, "neighbour(%s", n->beginning ? "beginning, " : "");
        print_parts(g, n, ", ");
        tn_buffer_printf(&g->text, "%s)", n->end ? ", end" : "");
    } else if (n->kind == REPEAT) {
        tn_buffer_printf(&g->text, "repeat(");
        print_parts(g, n, "");
        tn_buffer_printf(&g->text, n->most ? ", %u..%u)" : ", %u..)", n->least, n->most);
    } else {
        tn_buffer_printf(&g->text, "%s", before[n->kind]);
        print_parts(g, n, between[n->kind]);
        tn_buffer_printf(&g->text, ")");
    }
}

static void print_file(grammar *g, bool prunes)
{
    g->text.size = 0;
    tn_buffer_printf(&g->text, "schema s { use = a | b | c }\n");
    for (uint32_t r = 0; r < RULES; r++) {
        tn_buffer_printf(&g->text, "rule r%u = ", r);
        print_parts(g, g->rules[r], " or ");
        tn_buffer_printf(&g->text, "\n");
    }
    tn_buffer_printf(&g->text, "library l using s {\n  trays 0..%d\n  generate ", LONGEST);
    print(g, g->generate);
    tn_buffer_printf(&g->text, "%s\n}\n", prunes ? "\n  prune neighbour(tray(a), tray(a))" : "");
}

/* ---- judged: M and H, and D in how many ways */

typedef struct plan {
    const grammar *g;
    uint32_t letters[LONGEST];
    uint32_t length;
    const struct plan *turned;
} plan;

static uint64_t ways(const plan *p, const node *n, uint32_t i, uint32_t j);

static bool is(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    return ways(p, n, i, j) > 0;
}

static bool inside(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    for (uint32_t a = i; a < j; a++)
        for (uint32_t b = a + 1; b <= j; b++)
            if (is(p, n, a, b))
                return true;
    return false;
}

static bool holds(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    switch (n->kind) {
    case NAME:
        return holds(p, p->g->rules[n->rule], i, j);
    case AND:
        return holds(p, n->parts[0], i, j) && holds(p, n->parts[1], i, j);
    case NOT:
        return !holds(p, n->parts[0], i, j);
    case IMPLIES:
        return !holds(p, n->parts[0], i, j) || holds(p, n->parts[1], i, j);
    case OR:
        for (uint32_t k = 0; k < n->count; k++)
            if (holds(p, n->parts[k], i, j))
                return true;
        return false;
    default:
        return inside(p, n, i, j);
    }
}

/* The parts from the k-th on, each a tray at least; some of them may be left out, but not all. */
static uint64_t cuts(const plan *p, const node *n, uint32_t k, bool any, uint32_t i, uint32_t j)
{
    uint64_t sum = 0;
    if (k == n->count)
        return i == j && any;
    for (uint32_t c = i + 1; c <= j; c++) {
        uint64_t rest = cuts(p, n, k + 1, true, c, j);
        sum += rest > 0 ? rest * ways(p, n->parts[k], i, c) : 0;
    }
    return sum + (n->optional[k] ? cuts(p, n, k + 1, any, i, j) : 0);
}

static uint64_t times(const plan *p, const node *n, uint32_t done, uint32_t i, uint32_t j)
{
    if (i == j)
        return done >= n->least && done > 0 && (n->most == 0 || done <= n->most);
    uint64_t sum = 0;
    for (uint32_t c = i + 1; c <= j; c++) {
        uint64_t rest = times(p, n, done + 1, c, j);
        sum += rest > 0 ? rest * ways(p, n->parts[0], i, c) : 0;
    }
    return sum;
}

static bool is_beside(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    bool beside = false;
    if (i == j || !is(p, n->parts[0], i, j))
        return false;
    for (uint32_t a = 0; a < i; a++)
        beside |= is(p, n->parts[1], a, i);
    for (uint32_t b = j + 1; b <= p->length; b++)
        beside |= is(p, n->parts[1], j, b);
    return beside;
}

static bool all_are(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    for (uint32_t k = i; k < j; k++)
        if (!is(p, n, k, k + 1))
            return false;
    return i < j;
}

static uint64_t ways(const plan *p, const node *n, uint32_t i, uint32_t j)
{
    uint64_t sum = n->kind == AND;
    switch (n->kind) {
    case TRAY:
        return j == i + 1 && (n->letters >> p->letters[i] & 1);
    case NAME:
        return ways(p, p->g->rules[n->rule], i, j);
    case NOT:
        return !holds(p, n->parts[0], i, j);
    case IMPLIES:
        return !holds(p, n->parts[0], i, j) || is(p, n->parts[1], i, j);
    case BESIDE:
        return is_beside(p, n, i, j);
    case MANY:
        return all_are(p, n->parts[0], i, j);
    case NEIGHBOUR:
        return (n->beginning && i > 0) || (n->end && j < p->length) ? 0 : cuts(p, n, 0, false, i, j);
    case REPEAT:
        return times(p, n, 0, i, j);
    case SYMMETRIC:
        return ways(p, n->parts[0], i, j) + ways(p->turned, n->parts[0], p->length - j, p->length - i);
    default:
        for (uint32_t k = 0; k < n->count; k++)
            sum = n->kind == OR ? sum + ways(p, n->parts[k], i, j) : sum * ways(p, n->parts[k], i, j);
        return sum;
    }
}

/* ---- both */

typedef struct opened {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
    tn_library *library;
    tn_derivation derivation;
    tn_plan_vm *vm;
} opened;

static bool open_text(opened *o, const char *text)
{
    const library_folders none = {0};
    tn_error error = {0};
    *o = (opened){0};
    if (compile_text("ways.plan", text, strlen(text), &none, &o->compilation) != TN_OK)
        return false;
    assert_int_equal(tn_module_load(o->compilation.module, o->compilation.module_size, NULL, &o->module, &error),
                     TN_OK);
    assert_int_equal(tn_schema_new(o->module, 0, 0, &o->schema, &error), TN_OK);
    if (tn_library_new(o->schema, 0, NULL, &o->library, &error) != TN_OK)
        fail_msg("%s: %s", text, error.message);
    uint32_t clause = tn_library_generator(o->library);
    assert_int_not_equal(clause, UINT32_MAX);
    assert_int_equal(tn_derivation_read(o->module, o->module->CLAUSE_records[clause].holds, &o->derivation, &error),
                     TN_OK);
    assert_int_equal(tn_plan_vm_new(o->schema, 0, &o->vm, &error), TN_OK);
    return true;
}

static void close_text(opened *o)
{
    tn_plan_vm_free(o->vm);
    tn_derivation_clear(&o->derivation);
    tn_library_free(o->library);
    tn_schema_free(o->schema);
    tn_module_free(o->module);
    tn_compilation_clear(&o->compilation);
}

/* What is found by going through all plans. */
typedef struct tally {
    uint64_t plans, ways, most;
    uint32_t first[LONGEST], length;
    uint64_t of[2000], with[2000]; /* numbers of ways, and how many plans have them */
    uint32_t count;
} tally;

static void add_plan(tally *t, const plan *p, uint64_t number)
{
    uint32_t k = 0;
    t->plans++;
    t->ways += number;
    if (number > t->most) {
        t->most = number;
        t->length = p->length;
        memcpy(t->first, p->letters, sizeof t->first);
    }
    while (k < t->count && t->of[k] != number)
        k++;
    t->of[k] = number;
    t->with[k]++;
    t->count += k == t->count;
}

/* Judged both ways: the plan alone. */
static uint64_t check_plan(const opened *o, const grammar *g, const plan *p)
{
    tn_tray trays[LONGEST];
    tn_error error = {0};
    mpz_t found;
    mpz_init(found);
    for (uint32_t i = 0; i < p->length; i++)
        trays[i] = p->letters[i];
    uint64_t number = ways(p, g->generate, 0, p->length);
    if (tn_plan_ways(&o->derivation, o->vm, trays, p->length, found, &error) != TN_OK)
        fail_msg("%s: %s", g->text.data, error.message);
    if (mpz_cmp_ui(found, number) != 0) {
        char *digits = mpz_get_str(NULL, 10, found);
        fail_msg("%sof %u trays, %u%u%u%u: %llu ways, found %s", g->text.data, p->length, p->letters[0], p->letters[1],
                 p->letters[2], p->letters[3], (unsigned long long)number, digits);
    }
    mpz_clear(found);
    return tn_library_has(o->library, trays, p->length) ? number : 0;
}

static void go_through(const opened *o, const grammar *g, tally *t)
{
    for (uint32_t length = 0, count = 1; length <= LONGEST; length++, count *= LETTERS)
        for (uint32_t k = 0; k < count; k++) {
            plan p = {.g = g, .length = length}, turned = p;
            uint32_t rest = k;
            for (uint32_t i = length; i-- > 0; rest /= LETTERS)
                p.letters[i] = turned.letters[length - 1 - i] = rest % LETTERS;
            p.turned = &turned;
            turned.turned = &p;
            uint64_t number = check_plan(o, g, &p);
            if (number > 0)
                add_plan(t, &p, number);
        }
}

static void expect(const char *text, const char *what, const mpz_t found, uint64_t number)
{
    if (mpz_cmp_ui(found, number) != 0) {
        char *digits = mpz_get_str(NULL, 10, found);
        fail_msg("%s%s: %llu, found %s", text, what, (unsigned long long)number, digits);
    }
}

/* All plans of the library: told apart, and the sum alone. */
static void check_library(const opened *o, const char *text, const tally *t)
{
    tn_derived_ways found;
    tn_error error = {0};
    for (uint32_t max_nodes = 0; max_nodes < 2; max_nodes++) {
        if (tn_library_count_ways(o->library, max_nodes, &found, &error) != TN_OK)
            fail_msg("%s: %s", text, error.message);
        expect(text, "plans", found.plans, t->plans);
        expect(text, "ways", found.ways, t->ways);
        assert_true(max_nodes || (found.has_rows && found.has_most));
        if (found.has_most)
            expect(text, "most", found.most, t->most);
        assert_int_equal(found.has_rows ? t->count : 0, found.count);
        for (size_t i = 0; i < found.count; i++) {
            uint32_t k = 0;
            while (k < t->count && mpz_cmp_ui(found.rows[i].ways, t->of[k]) != 0)
                k++;
            assert_true(k < t->count);
            expect(text, "row", found.rows[i].plans, t->with[k]);
        }
        if (found.has_most && t->plans > 0) {
            assert_int_equal(found.length, t->length);
            for (uint32_t i = 0; i < t->length; i++)
                assert_int_equal(found.first[i], t->first[i]);
        }
        tn_derived_ways_clear(&found);
    }
}

static void random_rules(void **state)
{
    (void)state;
    static grammar g;
    uint32_t compiled = 0;
    for (uint32_t seed = 0; seed < 400; seed++) {
        opened o;
        static tally t;
        g.count = 0;
        g.random = (test_random){.seed = 4401 + seed};
        make_rules(&g);
        print_file(&g, below(&g, 2));
        t = (tally){0};
        if (open_text(&o, g.text.data)) {
            compiled++;
            go_through(&o, &g, &t);
            check_library(&o, g.text.data, &t);
        }
        close_text(&o);
    }
    free(g.text.data);
    assert_true(compiled > 300);
}

static uint64_t sum_of(const char *text, uint64_t plans, uint64_t most)
{
    opened o;
    tn_error error = {0};
    tn_derived_ways found;
    assert_true(open_text(&o, text));
    assert_int_equal(tn_library_count_ways(o.library, 0, &found, &error), TN_OK);
    expect(text, "plans", found.plans, plans);
    expect(text, "most", found.most, most);
    uint64_t sum = mpz_get_ui(found.ways);
    tn_derived_ways_clear(&found);
    close_text(&o);
    return sum;
}

/* Trees of two branches: the Catalan numbers. */
static void catalan(void **state)
{
    (void)state;
    assert_int_equal(sum_of("schema s { use = x | y }\nrule q = tray(x) or neighbour(q, q)\n"
                            "library l using s {\n  trays 1..20\n  generate q\n}\n",
                            20, UINT64_C(1767263190)),
                     UINT64_C(2423307047));
}

/* Rows of ones and twos, Fibonacci numbers; by the left end and by the right one. */
static void fibonacci(void **state)
{
    (void)state;
    static const char *const rounds[] = {"neighbour(part, row)", "neighbour(row, part)"};
    for (int i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "schema s { use = x | y }\nrule part = tray(x) or neighbour(tray(x), tray(x))\n"
                 "rule row = part or %s\nlibrary l using s {\n  trays 80..80\n  generate row\n}\n",
                 rounds[i]);
        assert_int_equal(sum_of(text, 1, UINT64_C(37889062373143906)), UINT64_C(37889062373143906));
    }
}

/* Thirty doublings, of as many ways as there are no steps for. */
static void doublings(void **state)
{
    (void)state;
    tn_buffer text = {0};
    tn_buffer_printf(&text, "schema s { use = x | y }\nrule d0 = tray(x)\n");
    for (int i = 1; i <= 60; i++)
        tn_buffer_printf(&text, "rule d%d = d%d or d%d\n", i, i - 1, i - 1);
    tn_buffer_printf(&text, "library l using s {\n  trays 1..2\n  generate d60\n}\n");
    assert_int_equal(sum_of(text.data, 1, UINT64_C(1) << 60), UINT64_C(1) << 60);
    free(text.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_rules),
        cmocka_unit_test(catalan),
        cmocka_unit_test(fibonacci),
        cmocka_unit_test(doublings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
