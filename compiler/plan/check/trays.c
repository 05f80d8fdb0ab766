/* What a schema says of its trays: which are forbidden, and their numbers. What an older schema says holds too. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"

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

/* ---- forbidden trays */

static bool is_legal(const tn_checked_schema *schema, const uint8_t *values)
{
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        if (tn_check_meets(schema, schema->forbids[i], values))
            return false;
    return true;
}

/* Looks for one legal tray, among so many combinations at most: a schema that needs longer has legal ones. */
static bool has_legal_tray(const tn_checked_schema *schema)
{
    enum { LEGAL_TRIES = 1 << 16 };
    uint8_t values[TN_FIELDS_MAX] = {0};
    for (int tries = 0; tries < LEGAL_TRIES; tries++) {
        if (is_legal(schema, values))
            return true;
        if (!next(schema, values))
            return false;
    }
    return true;
}

/* A legal tray that meets `a` (NULL: any), and meets `b` as wanted. */
static bool find_tray(const tn_checked_spec *a, const tn_checked_spec *b, bool wanted, uint8_t *values)
{
    enum { BOTH_TRIES = 1 << 16 };
    const tn_checked_schema *schema = b->schema;
    memset(values, 0, schema->field_count);
    for (int tries = 0; tries < BOTH_TRIES; tries++) {
        if ((!a || tn_check_meets(schema, a, values)) && tn_check_meets(schema, b, values) == wanted &&
            is_legal(schema, values))
            return true;
        if (!next(schema, values))
            return false;
    }
    return false;
}

bool tn_check_both(const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values)
{
    return find_tray(a, b, true, values);
}

bool tn_check_one_alone(const tn_checked_spec *a, const tn_checked_spec *b, uint8_t *values)
{
    return find_tray(a, b, false, values);
}

/* Those that `of` declares: the schema, or one that it is made from. False: no more can be added. */
static bool add_forbids(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *of)
{
    for (TN_EACH(const tn_ast_forbid, forbid, of->ast->body.forbids)) {
        if (!tn_check_room(check, schema->forbid_count, TN_FORBIDS_MAX, "`forbid`", forbid->node.span,
                           "forbid several trays at once, with `or` between values: `forbid tray(a or b)`")) {
            schema->broken = true;
            return false;
        }
        tn_checked_spec *spec = tn_check_spec(check, schema, of == schema ? NULL : of, forbid->tray);
        if (!spec)
            return false;
        schema->broken |= spec->broken;
        schema->forbid_places[schema->forbid_count] = forbid->node.span;
        schema->forbids[schema->forbid_count++] = spec;
    }
    return true;
}

void tn_check_forbids(tn_check *check, tn_checked_schema *schema)
{
    size_t room = 0;
    for (const tn_checked_schema *of = schema; of; of = of->base)
        room += of->ast->body.forbids.count;
    room = room < TN_FORBIDS_MAX ? room : TN_FORBIDS_MAX;
    schema->forbids = TN_NEW_ARRAY(check->arena, tn_checked_spec *, room);
    schema->forbid_places = TN_NEW_ARRAY(check->arena, tn_span, room);
    if (!schema->forbids || !schema->forbid_places)
        return;
    check->allow = tn_ast_empty();
    for (const tn_checked_schema *of = schema; of; of = of->base)
        if (!add_forbids(check, schema, of))
            return;
    if (schema->broken || schema->forbid_count == 0 || has_legal_tray(schema))
        return;
    bool known = schema->base && schema->base->broken; /* said of the older schema */
    schema->broken = true;
    if (known)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOTHING_LEGAL, schema->ast->name->node.span,
                                 "schema `%s` forbids every tray", schema->name);
    tn_note(check->diagnostics, d, &schema->forbids[schema->forbid_count - 1]->span, "the last `forbid` is here");
    tn_help(check->diagnostics, d, "leave one `forbid` out, or narrow it with more items");
}

/* ---- numbers */

static bool uses_number(const tn_ast_expr *figure)
{
    bool uses = figure->number != NULL;
    for (TN_EACH(const tn_ast_expr, part, figure->parts))
        uses = uses || uses_number(part);
    return uses;
}

static bool check_case(tn_check *check, tn_checked_schema *schema, tn_checked_number *number,
                       const tn_ast_number_case *c, size_t i, tn_sum_amount *all)
{
    tn_sum_amount amount;
    const tn_checked_schema *older = number->of == schema ? NULL : number->of;
    number->specs[i] =
        c->tray ? tn_check_spec(check, schema, older, c->tray) : tn_check_any(check, schema, c->node.span);
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
    return (i == 0 || tn_same_power(check, *all, first, amount, c->sum->node.span, "an alternative to", all)) &&
           number->specs[i] && !number->specs[i]->broken;
}

static void report_tray(tn_check *check, const tn_checked_schema *schema, const tn_checked_number *number,
                        const uint8_t *values)
{
    char tray[400] = "";
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const char *words = schema->fields[f].values[values[f]].spelling;
        if (strcmp(words, "-") != 0 && strlen(tray) + strlen(words) + 2 < sizeof tray)
            snprintf(tray + strlen(tray), sizeof tray - strlen(tray), "%s%s", tray[0] ? " " : "", words);
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_NUMBER, number->ast->name->node.span,
                                 "`%s` says nothing of some trays, such as `%s`", number->name, tray);
    if (number->of != schema)
        tn_note(check->diagnostics, d, &schema->ast->from->node.span, "schema `%s` has more trays", schema->name);
    tn_help(check->diagnostics, d, "end it with what all other trays have: `... | 0`");
}

/* Does every legal tray meet a case? Decided by trying trays; schemas with too many of them must end with a case for
 * all. */
static bool covers(tn_check *check, const tn_checked_schema *schema, const tn_checked_number *number)
{
    if (!((const tn_ast_number_case *)number->ast->cases.last)->tray)
        return true;
    uint8_t values[TN_FIELDS_MAX] = {0};
    int tries = 0;
    do {
        bool met = false;
        for (uint32_t i = 0; i < schema->forbid_count && !met; i++)
            met = tn_check_meets(schema, schema->forbids[i], values);
        for (size_t i = 0; i < number->ast->cases.count && !met; i++)
            met = tn_check_meets(schema, number->specs[i], values);
        if (!met || ++tries == TRIES) {
            report_tray(check, schema, number, values);
            return false;
        }
    } while (next(schema, values));
    return true;
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
    number.specs = TN_NEW_ARRAY(check->arena, tn_checked_spec *, ast->cases.count);
    if (!number.specs)
        return;
    bool good = name_is_new(check, schema, ast->name) &&
                tn_check_room(check, ast->cases.count, TN_NUMBER_CASES_MAX, "alternative", ast->node.span,
                              "join some of them by `or`");
    size_t i = 0;
    for (TN_EACH(const tn_ast_number_case, c, ast->cases))
        good &= check_case(check, schema, &number, c, i++, &all);
    number.power = all.power;
    number.broken = !good || schema->broken || !covers(check, schema, &number);
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
