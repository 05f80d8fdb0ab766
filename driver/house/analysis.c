/* Counts what clauses of libraries of houses and rules about houses do, and says what comes to nothing. */
#include "driver/house/analysis.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"
#include "driver/house/counter.h"
#include "driver/house/survey_parts.h"
#include "driver/open/findings.h"
#include "runtime/base/integers.h"
#include "runtime/house/rule/asked.h"

/* A library that is looked at. */
typedef struct looking {
    tn_finder finder;
    const tn_module *module;
    const tn_house_library_record *record;
    const tn_house_clause_record *clauses; /* of the library: the counter's */
    uint32_t count;
    tn_house_counter counter;
    tn_house_clause_record *some; /* [count + 2]: those that are counted by */
    bool rules;                   /* is it the first library in its form? Then rules are looked at, too */
    mpz_t kept, houses;           /* of the library; of the last count */
    bool limited;                 /* something was left out: */
    tn_error limit;
} looking;

static tn_diagnostics *list_of(const looking *l)
{
    return &l->finder.opened->compilation.diagnostics;
}

/* ---- names and places */

static tn_found_item library_item(const looking *l)
{
    const char *name = tn_text(l->module, l->record->name);
    return (tn_found_item){name, tn_finding_name_span(&l->finder, TN_SURVEY_SPAN(l->record), "library", name), false};
}

static tn_found_item clause_item(const looking *l, uint32_t i)
{
    return (tn_found_item){tn_text(l->module, l->clauses[i].name), TN_SURVEY_SPAN(&l->clauses[i]), false};
}

static tn_found_item rule_item(const looking *l, uint32_t i)
{
    const tn_house_rule_record *rule = &l->module->HOUSE_RULE_records[i];
    const char *name = tn_text(l->module, rule->name);
    return (tn_found_item){name, tn_finding_name_span(&l->finder, TN_SURVEY_SPAN(rule), "rule", name),
                           rule->flags & TN_IMPORTED};
}

/* Written in the library itself, not taken over from another one. */
static bool is_own(const looking *l, uint32_t i)
{
    const tn_house_clause_record *clause = &l->clauses[i];
    return clause->file == l->record->file && clause->begin >= l->record->begin && clause->end <= l->record->end;
}

static bool is_settable(const looking *l, tn_span span)
{
    return tn_program_settable(l->finder.opened->compilation.program, span);
}

/* May other values of params change which houses there are? */
static bool any_settable(const looking *l)
{
    const tn_library_record *plans = &l->module->LIBRARY_records[l->record->plans];
    bool any = false;
    for (uint32_t i = 0; i < l->count; i++)
        any |= is_settable(l, TN_SURVEY_SPAN(&l->clauses[i]));
    for (uint32_t i = 0; i < plans->clause_count; i++)
        any |= is_settable(l, TN_SURVEY_SPAN(&l->module->CLAUSE_records[plans->clause_first + i]));
    return any;
}

/* ---- counting */

/* What passes a limit, or cannot be counted, is left out: *known is false then. */
static tn_status leave(looking *l, tn_status status, const tn_error *why, bool *known, tn_error *error)
{
    *known = status == TN_OK;
    if (status == TN_OK)
        return TN_OK;
    if (status != TN_LIMIT && status != TN_INVALID) {
        if (error)
            *error = *why;
        return status;
    }
    if (why->code == E_WALKS_OF_ALL) /* it is no matter of how many states there may be */
        return TN_OK;
    if (!l->limited)
        l->limit = *why;
    l->limited = true;
    return TN_OK;
}

/* l->houses := how many houses the first `count` of l->some keep. */
static tn_status count_some(looking *l, uint32_t count, bool *known, tn_error *error)
{
    tn_error why = {0};
    tn_status status = tn_house_counter_count(&l->counter, l->some, count, NULL, l->houses, &why);
    return leave(l, status, &why, known, error);
}

/* The first house that these keep, as a line; the caller frees it. It is judged, too: *keeps[i] is what clause i makes
 * of it. */
static tn_status show_some(looking *l, uint32_t count, tn_buffer *line, tn_house *house, tn_error *error)
{
    bool found, known;
    tn_error why = {0};
    *line = (tn_buffer){0};
    tn_status status = tn_house_counter_first(&l->counter, l->some, count, &found, house, &why);
    status = leave(l, status, &why, &known, error);
    if (status == TN_OK && known && found)
        status = tn_house_write(house, line, error);
    return status;
}

/* Those of the clauses that are `in` (NULL: all), but for one (TN_NO_RECORD: none). Returns how many. */
static uint32_t take_some(looking *l, const bool *in, uint32_t but)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < l->count; i++)
        if (i != but && (!in || in[i]))
            l->some[count++] = l->clauses[i];
    return count;
}

static tn_house_clause_record turned(const tn_house_clause_record *clause, tn_clause_kind kind)
{
    tn_house_clause_record other = *clause;
    other.kind = kind;
    return other;
}

/* ---- libraries without houses */

/* No clause is needed for that. */
static void report_barren(const looking *l)
{
    const tn_found_item library = library_item(l);
    if (tn_finding_allowed(&l->finder, W_EMPTY_LIBRARY, library.span))
        return;
    tn_diagnostic *d = tn_report(list_of(l), W_EMPTY_LIBRARY, library.span,
                                 "`%s` holds no house: form `%s` has none on any plan of `%s`", library.name,
                                 tn_text(l->module, l->counter.form.record->name),
                                 tn_text(l->module, l->module->LIBRARY_records[l->record->plans].name));
    tn_help(list_of(l), d, "`tartan explain FILE PLAN --library %s` says of one plan which cells can have no house",
            library.name);
}

/* Takes out what is not needed for there to be no house. */
static tn_status reduce(looking *l, bool *in, bool *whole, tn_error *error)
{
    tn_status status = TN_OK;
    *whole = true;
    for (uint32_t i = 0; status == TN_OK && i < l->count; i++) {
        bool known;
        status = count_some(l, take_some(l, in, i), &known, error);
        in[i] = !known || mpz_sgn(l->houses) > 0;
        *whole &= known;
    }
    return status;
}

/* in: clauses that leave no house together. lines: [count]. */
static tn_status report_empty(looking *l, const bool *in, bool whole, tn_found_item *reasons, tn_buffer *lines,
                              const char **examples, tn_error *error)
{
    const tn_found_item library = library_item(l);
    tn_found_empty empty = {.reasons = reasons, .examples = examples, .why = whole ? NULL : l->limit.message};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < l->count; i++) {
        tn_house house = {0};
        if (!in[i])
            continue;
        size_t at = empty.reason_count++;
        reasons[at] = clause_item(l, i);
        status = show_some(l, take_some(l, in, i), &lines[at], &house, error);
        examples[at] = lines[at].data;
        tn_house_clear(&house);
    }
    if (status == TN_OK)
        tn_report_empty(&l->finder, &library, &empty);
    return status;
}

static tn_status explain_empty(looking *l, tn_error *error)
{
    bool *in = malloc(l->count + 1), whole = true, known;
    tn_found_item *reasons = malloc((l->count + 1) * sizeof *reasons);
    tn_buffer *lines = calloc(l->count + 1, sizeof *lines);
    const char **examples = calloc(l->count + 1, sizeof *examples);
    tn_status status = in && reasons && lines && examples ? count_some(l, 0, &known, error) : tn_fail_memory(error);
    if (status == TN_OK && known && mpz_sgn(l->houses) == 0) {
        report_barren(l);
    } else if (status == TN_OK) {
        memset(in, true, l->count);
        status = reduce(l, in, &whole, error);
        if (status == TN_OK)
            status = report_empty(l, in, whole, reasons, lines, examples, error);
    }
    for (uint32_t i = 0; lines && i < l->count; i++)
        free(lines[i].data);
    free(lines);
    free(examples);
    free(reasons);
    free(in);
    return status;
}

/* ---- clauses that change nothing */

/* The other prunes that keep the house out, too. */
static tn_status find_droppers(const looking *l, uint32_t prune, const tn_house *house, tn_found_item *reasons,
                               size_t *count, tn_error *error)
{
    tn_house_rules *rules = NULL;
    tn_status status = tn_house_rules_new(&l->counter.form, 0, &rules, error);
    if (status == TN_OK)
        status = tn_house_rules_start(rules, house, error);
    for (uint32_t i = 0; status == TN_OK && i < l->count; i++) {
        bool drops = false;
        if (i == prune || l->clauses[i].kind != TN_CLAUSE_PRUNE)
            continue;
        status = tn_house_rules_drop(rules, l->record, i, &drops, error);
        if (drops)
            reasons[(*count)++] = clause_item(l, i);
    }
    tn_house_rules_free(rules);
    return status;
}

/* With a house that the requirements let in and the prune keeps out. */
static tn_status report_prune(looking *l, uint32_t prune, tn_error *error)
{
    const tn_found_item library = library_item(l), clause = clause_item(l, prune);
    tn_found_item *reasons = malloc((l->count + 1) * sizeof *reasons);
    tn_buffer line = {0};
    tn_house house = {0};
    size_t reason_count = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < l->count; i++)
        if (l->clauses[i].kind != TN_CLAUSE_PRUNE)
            l->some[count++] = l->clauses[i];
    l->some[count++] = turned(&l->clauses[prune], TN_CLAUSE_REQUIRE);
    tn_status status = reasons ? show_some(l, count, &line, &house, error) : tn_fail_memory(error);
    if (status == TN_OK && line.data)
        status = find_droppers(l, prune, &house, reasons, &reason_count, error);
    if (status == TN_OK)
        tn_report_idle_prune(&l->finder, &library, &clause, reasons, reason_count, line.data);
    tn_house_clear(&house);
    free(line.data);
    free(reasons);
    return status;
}

static tn_status find_idle(looking *l, tn_error *error)
{
    const tn_found_item library = library_item(l);
    bool settable = any_settable(l);
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < l->count; i++) {
        const tn_found_item clause = clause_item(l, i);
        bool known;
        if (!is_own(l, i))
            continue;
        status = count_some(l, take_some(l, NULL, i), &known, error);
        if (status != TN_OK || !known || mpz_cmp(l->houses, l->kept) != 0)
            continue;
        if (l->clauses[i].kind == TN_CLAUSE_PRUNE)
            status = report_prune(l, i, error);
        else if (!settable)
            tn_report_idle_requirement(&l->finder, &library, &clause);
    }
    return status;
}

/* ---- values that no house has */

static void report_value(const looking *l, const tn_choice_record *choice, const tn_shape_record *shape)
{
    const tn_found_item library = library_item(l);
    const tn_span place = TN_SURVEY_SPAN(shape);
    if (tn_finding_allowed(&l->finder, W_VALUE_NEVER, library.span) ||
        tn_finding_allowed(&l->finder, W_VALUE_NEVER, place))
        return;
    tn_diagnostic *d = tn_report(list_of(l), W_VALUE_NEVER, library.span, "no house of `%s` has `option(%s %s)`",
                                 library.name, tn_text(l->module, choice->name), tn_text(l->module, shape->spelling));
    tn_note(list_of(l), d, &place, "the value is here");
    tn_help(list_of(l), d,
            "all houses with it are kept out, or no plan can have one; if that is meant, write `allow W213` in the "
            "library");
}

static tn_status find_values(looking *l, tn_error *error)
{
    mpz_t *houses = tn_integers_new(l->module->SHAPE_count);
    bool *stands = calloc((size_t)l->module->SHAPE_count + 1, sizeof *stands), known;
    tn_error why = {0};
    tn_status status =
        houses && stands ? tn_house_counter_values(&l->counter, houses, stands, &why) : tn_fail_memory(&why);
    status = leave(l, status, &why, &known, error);
    for (uint32_t i = 0; status == TN_OK && known && i < l->counter.form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&l->counter.form, i);
        for (uint32_t k = choice->shape_first; k < choice->shape_first + choice->shape_count; k++)
            if (stands[k] && mpz_sgn(houses[k]) == 0)
                report_value(l, choice, &l->module->SHAPE_records[k]);
    }
    if (houses)
        tn_integers_free(houses, l->module->SHAPE_count);
    free(stands);
    return status;
}

/* ---- rules */

/* A rule about houses in the library's form, and how many of them match it, whatever clauses say. */
typedef struct counted_rule {
    uint32_t number; /* a HOUSE_RULE record */
    tn_house_clause_record clause;
    bool known;
    mpz_t *matched;
} counted_rule;

static bool is_clause(const looking *l, uint32_t holds)
{
    for (uint32_t i = 0; i < l->count; i++)
        if (l->clauses[i].holds == holds)
            return true;
    return false;
}

/* The rules of the file itself, and those that the library names. Returns how many. */
static uint32_t gather_rules(const looking *l, counted_rule *rules)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < l->module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &l->module->HOUSE_RULE_records[i];
        if (rule->form != l->record->form || (rule->flags & TN_IMPORTED && !is_clause(l, rule->holds)))
            continue;
        rules[count++] = (counted_rule){.number = i,
                                        .clause = {.name = rule->name,
                                                   .kind = TN_CLAUSE_REQUIRE,
                                                   .holds = rule->holds,
                                                   .file = rule->file,
                                                   .begin = rule->begin,
                                                   .end = rule->end}};
    }
    return count;
}

/* Of one that is a clause, and so is reported as one, nothing is said here. */
static void report_extreme(const looking *l, const counted_rule *rule, const mpz_t all)
{
    const tn_house_rule_record *record = &l->module->HOUSE_RULE_records[rule->number];
    const tn_found_item item = rule_item(l, rule->number);
    bool never = mpz_sgn(*rule->matched) == 0, always = mpz_cmp(*rule->matched, all) == 0;
    if ((never || always) && !item.imported && !is_clause(l, record->holds) &&
        !tn_finding_explained(&l->finder, TN_SURVEY_SPAN(record)))
        tn_report_extreme(&l->finder, &item, never);
}

/* As many match the one as the other: are they the same? */
static tn_status compare_rules(looking *l, const counted_rule *rule, const counted_rule *before, bool *same,
                               tn_error *error)
{
    bool known;
    l->some[0] = rule->clause;
    l->some[1] = turned(&before->clause, TN_CLAUSE_PRUNE);
    tn_status status = count_some(l, 2, &known, error);
    *same = status == TN_OK && known && mpz_sgn(l->houses) == 0;
    return status;
}

static tn_status report_equal(looking *l, const counted_rule *rule, const counted_rule *before, tn_error *error)
{
    const tn_found_item own = rule_item(l, rule->number), other = rule_item(l, before->number);
    tn_house house = {0};
    tn_buffer line;
    l->some[0] = rule->clause;
    tn_status status = show_some(l, 1, &line, &house, error);
    if (status == TN_OK)
        tn_report_equivalent(&l->finder, &own, &other, line.data);
    tn_house_clear(&house);
    free(line.data);
    return status;
}

/* Each rule of the file with those before it, and with those that it uses; the first that is equal is reported. */
static tn_status find_equal(looking *l, const counted_rule *rules, uint32_t count, uint32_t own, const mpz_t all,
                            tn_error *error)
{
    const counted_rule *rule = &rules[own];
    bool same = false;
    tn_status status = TN_OK;
    if (l->module->HOUSE_RULE_records[rule->number].flags & TN_IMPORTED || !rule->known ||
        mpz_sgn(*rule->matched) == 0 || mpz_cmp(*rule->matched, all) == 0)
        return TN_OK;
    for (uint32_t i = 0; status == TN_OK && !same && i < count; i++) {
        const counted_rule *before = &rules[i];
        bool imported = l->module->HOUSE_RULE_records[before->number].flags & TN_IMPORTED;
        if ((i >= own && !imported) || !before->known || mpz_cmp(*rule->matched, *before->matched) != 0)
            continue;
        status = compare_rules(l, rule, before, &same, error);
        if (status == TN_OK && same)
            status = report_equal(l, rule, before, error);
    }
    return status;
}

static tn_status count_rules(looking *l, counted_rule *rules, uint32_t count, mpz_t *matched, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        l->some[0] = rules[i].clause;
        status = count_some(l, 1, &rules[i].known, error);
        rules[i].matched = &matched[i];
        mpz_set(matched[i], l->houses);
    }
    return status;
}

static tn_status look_at_rules(looking *l, tn_error *error)
{
    counted_rule *rules = malloc(((size_t)l->module->HOUSE_RULE_count + 1) * sizeof *rules);
    uint32_t count = rules ? gather_rules(l, rules) : 0;
    mpz_t *matched = tn_integers_new((size_t)count + 1), *all = matched ? &matched[count] : NULL;
    bool known = false;
    tn_status status = rules && matched ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && count > 0)
        status = count_some(l, 0, &known, error);
    if (status == TN_OK && known) {
        mpz_set(*all, l->houses);
        status = count_rules(l, rules, count, matched, error);
    }
    for (uint32_t i = 0; status == TN_OK && known && i < count && mpz_sgn(*all) > 0; i++) {
        if (rules[i].known)
            report_extreme(l, &rules[i], *all);
        status = find_equal(l, rules, count, i, *all, error);
    }
    if (matched)
        tn_integers_free(matched, (size_t)count + 1);
    free(rules);
    return status;
}

/* ---- a library */

/* What was left out, once. */
static void report_limit(const looking *l)
{
    const tn_found_item library = library_item(l);
    if (!l->limited)
        return;
    tn_diagnostic *d = tn_report_bare(list_of(l), TN_NOTE, TN_CODE_NONE, "`%s` is not analysed to the end: %s",
                                      library.name, l->limit.message);
    d->limit = d->has_span = true;
    d->span = library.span;
    if (l->limit.help[0])
        tn_help(list_of(l), d, "%s", l->limit.help);
}

static tn_status look_at_houses(looking *l, tn_error *error)
{
    bool known;
    tn_status status = count_some(l, take_some(l, NULL, TN_NO_RECORD), &known, error);
    if (status != TN_OK || !known)
        return status;
    mpz_set(l->kept, l->houses);
    if (mpz_sgn(l->kept) == 0)
        return explain_empty(l, error);
    status = find_idle(l, error);
    if (status == TN_OK && !any_settable(l))
        status = find_values(l, error);
    return status == TN_OK && l->rules ? look_at_rules(l, error) : status;
}

/* Walls that cannot stand are an error of the library; houses are not counted then, nor if there are no plans. */
static tn_status look_at(looking *l, tn_error *error)
{
    tn_error why = {0};
    tn_status status = tn_houses_check_walls(&l->counter.form, l->record, l->counter.plans, &why);
    if (status == TN_INVALID) {
        tn_diagnostic *d = tn_report(list_of(l), why.code, TN_SURVEY_SPAN(l->record), "%s", why.message);
        tn_help(list_of(l), d, "%s", why.help);
        return TN_OK;
    }
    tn_library_kept(l->counter.plans, TN_ALL_LENGTHS, l->kept);
    if (status == TN_OK && mpz_sgn(l->kept) > 0)
        return look_at_houses(l, error);
    if (status != TN_OK && error)
        *error = why;
    return status == TN_LIMIT ? TN_OK : status;
}

/* Is it the first library of the file itself in its form? */
static bool is_first(const tn_module *module, uint32_t library)
{
    for (uint32_t i = 0; i < library; i++)
        if (!(module->HOUSE_LIBRARY_records[i].flags & TN_IMPORTED) &&
            module->HOUSE_LIBRARY_records[i].form == module->HOUSE_LIBRARY_records[library].form)
            return false;
    return true;
}

/* Of plans that pass a limit, that is said of their library. */
static tn_status analyse(tn_opened *opened, uint32_t library, uint32_t max_states, tn_error *error)
{
    const tn_module *module = opened->module;
    const tn_house_library_record *record = &module->HOUSE_LIBRARY_records[library];
    char among[TN_NAME_MAX + 32];
    looking l = {.finder = {opened, "house", "houses", among},
                 .module = module,
                 .record = record,
                 .rules = is_first(module, library),
                 .some = malloc(((size_t)record->clause_count + 2) * sizeof *l.some)};
    mpz_inits(l.kept, l.houses, NULL);
    snprintf(among, sizeof among, " on plans of `%s`", tn_text(module, module->LIBRARY_records[record->plans].name));
    tn_status status =
        l.some ? tn_house_counter_open(module, library, 0, max_states ? max_states : TN_HOUSE_ANALYSIS_STATES,
                                       &l.counter, error)
               : tn_fail_memory(error);
    l.clauses = l.counter.clauses;
    l.count = l.counter.clause_count;
    if (status == TN_OK)
        status = look_at(&l, error);
    if (status == TN_OK)
        report_limit(&l);
    tn_house_counter_close(&l.counter);
    mpz_clears(l.kept, l.houses, NULL);
    free(l.some);
    return status == TN_LIMIT ? TN_OK : status;
}

tn_status tn_house_analyse(tn_opened *opened, uint32_t max_states)
{
    tn_error error;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && opened->compiled && i < opened->module->HOUSE_LIBRARY_count; i++)
        if (!(opened->module->HOUSE_LIBRARY_records[i].flags & TN_IMPORTED))
            status = analyse(opened, i, max_states, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}
