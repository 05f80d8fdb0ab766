/* What a schema says of its trays: which there are, and their numbers. What an older schema says holds too. */
#include <inttypes.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"
#include "runtime/choices/labelling.h"

enum { TRIES = 1 << 18 };

bool tn_check_meets(const tn_checked_schema *schema, const tn_checked_spec *spec, const uint8_t *values)
{
    for (uint32_t f = 0; f < schema->field_count; f++) {
        uint32_t bit = schema->fields[f].first_bit + values[f];
        if (!(spec->mask[bit / 64] >> (bit % 64) & 1))
            return false;
    }
    return true;
}

static bool next(const tn_checked_schema *schema, uint8_t *values)
{
    uint32_t f = schema->field_count;
    while (f > 0 && ++values[f - 1] == schema->fields[f - 1].value_count)
        values[--f] = 0;
    return f > 0;
}

/* Can the combinations of values be gone through one by one? */
static bool is_small(const tn_checked_schema *schema, uint64_t limit)
{
    uint64_t combinations = 1;
    for (uint32_t f = 0; f < schema->field_count && combinations <= limit; f++)
        combinations *= schema->fields[f].value_count;
    return combinations <= limit;
}

void tn_say_tray(const tn_checked_schema *schema, const uint8_t *values, char *text, size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const char *words = schema->fields[f].values[values[f]].spelling;
        if (strcmp(words, "-") != 0 && used + strlen(words) + 2 < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " " : "", words);
    }
}

/* ---- forbidden trays */

static bool is_legal(const tn_checked_schema *schema, const uint8_t *values)
{
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        if (tn_check_meets(schema, schema->forbids[i], values))
            return false;
    return true;
}

/* A schema of which that takes too long to find out has legal trays. */
static bool has_legal_tray(tn_check *check, tn_checked_schema *schema)
{
    uint8_t values[TN_FIELDS_MAX] = {0};
    if (!is_small(schema, TRIES))
        return tn_legal_set(check, schema) != TN_CHOICE_NONE;
    do {
        if (is_legal(schema, values))
            return true;
    } while (next(schema, values));
    return false;
}

/* The same as find_tray, of a schema of very many combinations. */
static bool find_in_set(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, bool wanted,
                        uint8_t *values)
{
    tn_checked_schema *schema = b->schema;
    tn_choice_set set = tn_legal_set(check, schema);
    if (set == TN_CHOICE_LOST)
        return false;
    tn_choice_set second = tn_choices_box(schema->choices, b->mask);
    if (a)
        set = tn_choices_and(schema->choices, set, tn_choices_box(schema->choices, a->mask));
    set = tn_choices_and(schema->choices, set, wanted ? second : tn_choices_not(schema->choices, second));
    check->out_of_memory |= set == TN_CHOICE_LOST && !tn_choices_full(schema->choices);
    return set != TN_CHOICE_LOST && tn_choices_first(schema->choices, set, values);
}

/* A legal tray that meets `a` (NULL: any), and meets `b` as wanted. */
static bool find_tray(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, bool wanted, uint8_t *values)
{
    enum { BOTH_TRIES = 1 << 16 };
    const tn_checked_schema *schema = b->schema;
    if (!is_small(schema, BOTH_TRIES))
        return find_in_set(check, a, b, wanted, values);
    memset(values, 0, schema->field_count);
    do {
        if ((!a || tn_check_meets(schema, a, values)) && tn_check_meets(schema, b, values) == wanted &&
            is_legal(schema, values))
            return true;
    } while (next(schema, values));
    return false;
}

bool tn_check_both(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values)
{
    return find_tray(check, a, b, true, values);
}

bool tn_check_one_alone(tn_check *check, const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values)
{
    return find_tray(check, a, b, false, values);
}

/* ---- `forbid` and `only` */

/* Limits whose sets were made, until all are: what they divide by 0 is then said of legal trays. */
typedef struct limits {
    tn_check *check;
    tn_checked_schema *schema;
    tn_tray_set *sets; /* of each limit; `yes` and `no` are all trays where it is a plain specifier */
    tn_span *spans;
    size_t count;
} limits;

static bool has_room(limits *l, size_t more, tn_span span)
{
    tn_checked_schema *schema = l->schema;
    if (schema->forbid_count + more <= schema->forbid_room)
        return true;
    size_t room = 2 * (schema->forbid_count + more);
    tn_checked_spec **forbids = TN_NEW_ARRAY(l->check->arena, tn_checked_spec *, room);
    tn_span *places = TN_NEW_ARRAY(l->check->arena, tn_span, room);
    if (!forbids || !places)
        return false;
    if (schema->forbid_count > 0) {
        memcpy(forbids, schema->forbids, schema->forbid_count * sizeof *forbids);
        memcpy(places, schema->forbid_places, schema->forbid_count * sizeof *places);
    }
    schema->forbids = forbids;
    schema->forbid_places = places;
    schema->forbid_room = room;
    return tn_check_room(l->check, schema->forbid_count, TN_FORBID_BOXES_MAX, "kind of forbidden trays", span,
                         "forbid trays by fewer fields at once");
}

static void add_forbid(tn_checked_schema *schema, tn_checked_spec *spec, tn_span place)
{
    schema->forbid_places[schema->forbid_count] = place;
    schema->forbids[schema->forbid_count++] = spec;
}

/* A specifier without sums is one as it stands. */
static bool is_plain(const tn_checked_schema *schema, const tn_ast_forbid *forbid)
{
    if (forbid->only || forbid->expr->kind != TN_EXPR_TRAY)
        return false;
    for (TN_EACH(const tn_ast_item, item, forbid->expr->items))
        if (tn_is_sum_item(schema, item, false))
            return false;
    return true;
}

static bool add_plain(limits *l, const tn_checked_schema *older, const tn_ast_forbid *forbid)
{
    tn_checked_spec *spec = tn_check_spec(l->check, l->schema, older, forbid->expr);
    if (!spec)
        return false;
    l->schema->broken |= spec->broken;
    if (has_room(l, 1, forbid->node.span))
        add_forbid(l->schema, spec, forbid->node.span);
    return true;
}

static void add_limit(limits *l, const tn_checked_schema *older, const tn_ast_forbid *forbid)
{
    tn_tray_set set;
    tn_checked_trays out;
    tn_span span = forbid->node.span;
    if (!tn_check_limit_set(l->check, l->schema, older, forbid->expr, &set) ||
        !tn_schema_choices(l->check, l->schema) ||
        !tn_check_boxes(l->check, l->schema, forbid->only ? set.no : set.yes, TN_FORBID_BOXES_MAX, span, &out)) {
        l->schema->broken = true;
        return;
    }
    for (size_t i = 0; i < out.count && has_room(l, 1, span); i++)
        add_forbid(l->schema, out.boxes[i], span);
    l->sets[l->count] = set;
    l->spans[l->count++] = span;
}

/* Trays that stand for no plan do not exist. */
static void add_rows(limits *l)
{
    tn_checked_trays out;
    tn_checked_schema *schema = l->schema;
    if (!tn_schema_census(schema) || schema->broken)
        return;
    schema->broken |= !tn_check_rows_legal(l->check, schema, &out);
    for (size_t i = 0; i < out.count && !schema->broken && has_room(l, 1, out.boxes[i]->span); i++)
        add_forbid(schema, out.boxes[i], out.boxes[i]->span);
}

/* Those that `of` declares: the schema, or one that it is made from. False: no more can be added. */
static bool add_limits(limits *l, const tn_checked_schema *of, size_t *declared)
{
    const tn_checked_schema *older = of == l->schema ? NULL : of;
    for (TN_EACH(const tn_ast_forbid, forbid, of->ast->body.forbids)) {
        if (!tn_check_room(l->check, (*declared)++, TN_FORBIDS_MAX, "`forbid`", forbid->node.span,
                           "forbid several trays at once, with `or` between values: `forbid tray(a or b)`")) {
            l->schema->broken = true;
            return false;
        }
        if (!is_plain(l->schema, forbid))
            add_limit(l, older, forbid);
        else if (!add_plain(l, older, forbid))
            return false;
    }
    return true;
}

static void report_nothing_legal(tn_check *check, tn_checked_schema *schema)
{
    bool known = schema->base && schema->base->broken; /* said of the older schema */
    schema->broken = true;
    if (known)
        return;
    bool only = false;
    for (const tn_checked_schema *of = schema; of; of = of->base)
        for (TN_EACH(const tn_ast_forbid, forbid, of->ast->body.forbids))
            only |= forbid->only;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOTHING_LEGAL, schema->ast->name->node.span,
                                 "schema `%s` forbids every tray", schema->name);
    tn_note(check->diagnostics, d, &schema->forbid_places[schema->forbid_count - 1], "the last %s is here",
            only ? "line that leaves trays out" : "`forbid`");
    tn_help(check->diagnostics, d,
            only ? "leave one `only` or `forbid` out, or change what it says"
                 : "leave one `forbid` out, or narrow it with more items");
}

/* Every legal tray has a number. What takes too long to count is said where it is asked about. */
static void check_tray_count(tn_check *check, tn_checked_schema *schema)
{
    uint64_t trays = 0;
    tn_choice_set legal = is_small(schema, TRIES) ? TN_CHOICE_NONE : tn_legal_set(check, schema);
    if (legal == TN_CHOICE_NONE || legal == TN_CHOICE_LOST)
        return;
    check->out_of_memory |= !tn_choices_count(schema->choices, legal, &trays);
    if (trays <= TN_LABELLED_MAX)
        return;
    schema->broken = true;
    char many[32] = "very many";
    if (trays < UINT64_MAX)
        snprintf(many, sizeof many, "%" PRIu64, trays);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_TOO_MANY_TRAYS, schema->ast->name->node.span,
                  "schema `%s` has %s legal trays, more than the limit of %u", schema->name, many, TN_LABELLED_MAX);
    tn_help(check->diagnostics, d,
            "name fewer values, or fewer fields, or say by `only` or `forbid` which trays there are");
}

void tn_check_forbids(tn_check *check, tn_checked_schema *schema)
{
    size_t room = 0, declared = 0;
    for (const tn_checked_schema *of = schema; of; of = of->base)
        room += of->ast->body.forbids.count;
    room = room < TN_FORBIDS_MAX ? room : TN_FORBIDS_MAX;
    schema->forbids = TN_NEW_ARRAY(check->arena, tn_checked_spec *, room);
    schema->forbid_places = TN_NEW_ARRAY(check->arena, tn_span, room);
    schema->forbid_room = room;
    limits l = {check, schema, TN_NEW_ARRAY(check->arena, tn_tray_set, room), TN_NEW_ARRAY(check->arena, tn_span, room),
                0};
    if (!schema->forbids || !schema->forbid_places || !l.sets || !l.spans)
        return;
    check->allow = tn_ast_empty();
    add_rows(&l);
    for (const tn_checked_schema *of = schema; of; of = of->base)
        if (!add_limits(&l, of, &declared))
            return;
    for (size_t i = 0; i < l.count && !schema->broken; i++)
        schema->broken |= !tn_check_undivided(check, schema, l.sets[i], l.spans[i]);
    if (!schema->broken && schema->forbid_count > 0 && !has_legal_tray(check, schema))
        report_nothing_legal(check, schema);
    if (!schema->broken)
        check_tray_count(check, schema);
}

/* ---- numbers */

static bool uses_number(const tn_ast_expr *figure)
{
    bool uses = figure->number != NULL;
    for (TN_EACH(const tn_ast_expr, part, figure->parts))
        uses = uses || uses_number(part);
    return uses;
}

/* Does an item of the specifier name a number of the schema? Then that is reported. */
static bool names_number(tn_check *check, const tn_checked_schema *schema, const tn_ast_item *item)
{
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
        for (TN_EACH(const tn_ast_word, word, alternative->words)) {
            bool number = word->kind == TN_WORD_NAME && tn_schema_number(schema, word->text);
            if (number) {
                tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_NUMBER, word->node.span,
                                             "which trays a number is of does not depend on another number");
                tn_help(check->diagnostics, d, "write out what `%s` means", word->text);
            }
            if (number || (word->group && names_number(check, schema, word->group)))
                return true;
        }
    return false;
}

/* The trays of a case. false: reported. */
static bool find_trays(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                       const tn_ast_number_case *c, tn_checked_trays *trays)
{
    bool sums = false;
    for (TN_EACH(const tn_ast_item, item, c->tray ? c->tray->items : tn_ast_empty())) {
        bool sum = tn_is_sum_item(schema, item, false);
        if (sum && names_number(check, schema, item))
            return false;
        sums |= sum;
    }
    tn_tray_set set;
    if (sums)
        return tn_check_tray_set(check, schema, older, c->tray, &set) &&
               tn_check_undivided(check, schema, set, c->tray->node.span) &&
               tn_check_boxes(check, schema, set.yes, TN_TRAY_BOXES_MAX, c->tray->node.span, trays);
    trays->boxes = TN_NEW_ARRAY(check->arena, tn_checked_spec *, 1);
    if (!trays->boxes)
        return false;
    trays->boxes[0] =
        c->tray ? tn_check_spec(check, schema, older, c->tray) : tn_check_any(check, schema, c->node.span);
    trays->count = trays->boxes[0] != NULL;
    return trays->boxes[0] && !trays->boxes[0]->broken;
}

static bool check_case(tn_check *check, tn_checked_schema *schema, tn_checked_number *number,
                       const tn_ast_number_case *c, size_t i, tn_sum_amount *all)
{
    tn_sum_amount amount;
    bool known = find_trays(check, schema, number->of == schema ? NULL : number->of, c, &number->cases[i]);
    if (!tn_check_figure(check, schema, c->sum, &amount))
        return false;
    if (uses_number(c->sum)) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_BAD_NUMBER, c->sum->node.span, "a number cannot be made of other numbers");
        tn_help(check->diagnostics, d, "write out what the other one means");
        return false;
    }
    tn_span first = ((const tn_ast_number_case *)number->ast->cases.first)->sum->node.span;
    if (i == 0)
        *all = amount;
    return (i == 0 || tn_same_power(check, *all, first, amount, c->sum->node.span, "an alternative to", all)) && known;
}

static void report_tray(tn_check *check, const tn_checked_schema *schema, const tn_checked_number *number,
                        const uint8_t *values)
{
    char tray[400];
    tn_say_tray(schema, values, tray, sizeof tray);
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_NUMBER, number->ast->name->node.span,
                                 "`%s` says nothing of some trays, such as `%s`", number->name, tray);
    if (number->of != schema)
        tn_note(check->diagnostics, d, &schema->ast->from->node.span, "schema `%s` has more trays", schema->name);
    tn_help(check->diagnostics, d, "end it with what all other trays have: `... | 0`");
}

static bool meets_case(const tn_checked_schema *schema, const tn_checked_number *number, const uint8_t *values)
{
    for (size_t i = 0; i < number->ast->cases.count; i++)
        for (size_t k = 0; k < number->cases[i].count; k++)
            if (tn_check_meets(schema, number->cases[i].boxes[k], values))
                return true;
    return false;
}

/* A legal tray that meets no case, in a schema of very many combinations. */
static bool find_uncovered(tn_check *check, tn_checked_schema *schema, const tn_checked_number *number, uint8_t *values)
{
    tn_choice_set rest = tn_legal_set(check, schema);
    for (size_t i = 0; i < number->ast->cases.count && rest != TN_CHOICE_LOST; i++)
        for (size_t k = 0; k < number->cases[i].count; k++) {
            tn_choice_set box = tn_choices_box(schema->choices, number->cases[i].boxes[k]->mask);
            rest = tn_choices_and(schema->choices, rest, tn_choices_not(schema->choices, box));
        }
    check->out_of_memory |= rest == TN_CHOICE_LOST && !(schema->choices && tn_choices_full(schema->choices));
    memset(values, 0, schema->field_count);
    return rest == TN_CHOICE_LOST || tn_choices_first(schema->choices, rest, values);
}

/* Does every legal tray meet a case? Where that takes too long to find out there must be a case for all. */
static bool covers(tn_check *check, tn_checked_schema *schema, const tn_checked_number *number)
{
    if (!((const tn_ast_number_case *)number->ast->cases.last)->tray)
        return true;
    uint8_t values[TN_FIELDS_MAX] = {0};
    bool found = false;
    if (is_small(schema, TRIES))
        do
            found = is_legal(schema, values) && !meets_case(schema, number, values);
        while (!found && next(schema, values));
    else
        found = find_uncovered(check, schema, number, values);
    if (found)
        report_tray(check, schema, number, values);
    return !found;
}

void tn_check_covered(tn_check *check, tn_checked_schema *schema)
{
    for (uint32_t n = 0; n < schema->number_count; n++) {
        tn_checked_number *number = &schema->numbers[n];
        number->broken |= schema->broken;
        number->broken = number->broken || !covers(check, schema, number);
    }
}

static bool name_is_new(tn_check *check, tn_checked_schema *schema, const tn_ast_word *word)
{
    return tn_check_new_word(check, schema, word, false) &&
           tn_name_fits(check->diagnostics, word->text, word->node.span);
}

static void check_number(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *of,
                         const tn_ast_number *ast)
{
    tn_checked_number number = {.ast = ast, .of = of, .name = ast->name->text, .doc = ast->doc ? ast->doc->text : NULL};
    tn_sum_amount all = {0};
    number.cases = TN_NEW_ARRAY(check->arena, tn_checked_trays, ast->cases.count);
    if (!number.cases)
        return;
    bool good = name_is_new(check, schema, ast->name) &&
                tn_check_room(check, ast->cases.count, TN_NUMBER_CASES_MAX, "alternative", ast->node.span,
                              "join some of them by `or`");
    size_t i = 0;
    for (TN_EACH(const tn_ast_number_case, c, ast->cases))
        good &= check_case(check, schema, &number, c, i++, &all);
    number.power = all.power;
    number.broken = !good;
    schema->numbers[schema->number_count++] = number;
}

/* Those that `of` declares: first the ones that it has from an older schema. */
static void add_numbers(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *of)
{
    if (of->base)
        add_numbers(check, schema, of->base);
    for (TN_EACH(const tn_ast_number, number, of->ast->body.numbers)) {
        if (!tn_check_room(check, schema->number_count, TN_FIELDS_MAX, "`number`", number->node.span,
                           "declare fewer numbers"))
            return;
        check_number(check, schema, of, number);
    }
}

void tn_check_numbers(tn_check *check, tn_checked_schema *schema)
{
    size_t room = 0;
    for (const tn_checked_schema *of = schema; of; of = of->base)
        room += of->ast->body.numbers.count;
    schema->numbers = TN_NEW_ARRAY(check->arena, tn_checked_number, room < TN_FIELDS_MAX ? room : TN_FIELDS_MAX);
    if (schema->numbers)
        add_numbers(check, schema, schema);
}
