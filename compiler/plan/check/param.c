/* Params: constants, and words of a choice, whose values --set and the heads of tests may give. */
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/expand.h"
#include "runtime/base/nearest.h"

/* ---- kinds and ranges */

static bool is_below(tn_check *check, const char *value, const char *bound)
{
    const char *more = tn_amount_apply(check, TN_EXPR_MINUS, value, bound);
    return more && *more == '-';
}

/* The text of the author's own between two places. */
static const char *text_of(const tn_check *check, tn_span span)
{
    const char *text = check->diagnostics->sources->files[span.file].text;
    return tn_arena_copy(check->arena, text + span.begin, span.end - span.begin);
}

static void note_param(tn_check *check, tn_diagnostic *d, const tn_checked_rule *param)
{
    tn_note(check->diagnostics, d, &param->ast->name->node.span, "param `%s` is here", param->name);
}

/* The words of a param, "`left`, `right`". */
static const char *words_text(const tn_ast_rule *ast, char *text, size_t size)
{
    size_t used = 0;
    for (TN_EACH(const tn_ast_word, word, ast->words))
        if (used < size)
            used += (size_t)snprintf(text + used, size - used, "%s`%s`", used ? ", " : "", word->text);
    return text;
}

static bool is_broken(const tn_ast_expr *expr)
{
    bool broken = expr->kind == TN_EXPR_BROKEN;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        broken = broken || is_broken(part);
    return broken;
}

/* What the values of a param are in words, "a length", and how one is written. */
static void help_kind(tn_check *check, tn_diagnostic *d, const tn_checked_rule *param)
{
    static const char *const examples[] = {"`3`, without a unit", "`12m` or `40'`", "`96ft2` or `120m2`",
                                           "`100m3` or `900ft3`"};
    char kind[48];
    int power = param->param->kind.power;
    tn_help(check->diagnostics, d, "write %s, such as %s", tn_power_name(power, kind, sizeof kind),
            power >= 0 && power <= 3 ? examples[power] : text_of(check, param->ast->body->node.span));
}

static void report_no_constant(tn_check *check, const tn_checked_rule *param, tn_span span)
{
    tn_span own = param->ast->top.node.span;
    bool declared = span.file == own.file && own.begin <= span.begin && span.end <= own.end;
    char kind[48];
    if (declared) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_VALUE, span,
                                     "a param has a constant, or one of several words, and this is neither");
        tn_help(check->diagnostics, d, "write `param %s = 12m in 9m..20m` or `param %s = left | right`", param->name,
                param->name);
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_VALUE, span, "`%s` is %s, and this is no constant",
                                 param->name, tn_power_name(param->param->kind.power, kind, sizeof kind));
    note_param(check, d, param);
    help_kind(check, d, param);
}

/* What a constant comes to, written in the file numbered `unit`. false: it is none, which is reported unless something
 * else was. */
static bool read_constant(tn_check *check, const tn_checked_rule *param, tn_ast_expr *value, size_t unit,
                          tn_sum_amount *amount)
{
    size_t before = check->unit;
    tn_span span = value->node.span;
    check->unit = unit;
    tn_expand(check, &value);
    check->unit = before;
    if (is_broken(value))
        return false;
    if (tn_is_constant(value))
        return tn_check_figure(check, NULL, value, amount) && amount->value;
    report_no_constant(check, param, span);
    return false;
}

/* Has the value, written at `span`, the kind of the param? */
static bool same_kind(tn_check *check, const tn_checked_rule *param, tn_sum_amount amount, tn_span span)
{
    char one[48], other[48];
    tn_sum_amount kind = param->param->kind;
    if (kind.any || amount.any || kind.power == amount.power)
        return true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_PARAM_VALUE, span, "`%s` is %s, and this is %s", param->name,
                  tn_power_name(kind.power, one, sizeof one), tn_power_name(amount.power, other, sizeof other));
    note_param(check, d, param);
    help_kind(check, d, param);
    return false;
}

static bool in_range(tn_check *check, const tn_checked_param *param, const char *value)
{
    return !param->low || (!is_below(check, value, param->low) && !is_below(check, param->high, value));
}

static void report_range(tn_check *check, const tn_checked_rule *param, tn_span span, bool is_default)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_VALUE, span, "%s is outside the range of `%s`",
                                 is_default ? "the default" : text_of(check, span), param->name);
    tn_note(check->diagnostics, d, &param->param->range, "its range is here");
    tn_help(check->diagnostics, d, is_default ? "choose a default in `%s`, or a wider range" : "give a value in `%s`",
            text_of(check, param->param->range));
}

/* ---- words */

static const tn_ast_word *word_of(const tn_ast_rule *ast, const char *text)
{
    for (TN_EACH(const tn_ast_word, word, ast->words))
        if (strcmp(word->text, text) == 0)
            return word;
    return NULL;
}

static void report_no_word(tn_check *check, const tn_checked_rule *param, const tn_ast_expr *value)
{
    char words[240];
    const char **names = TN_NEW_ARRAY(check->arena, const char *, param->ast->words.count);
    size_t count = 0;
    for (TN_EACH(const tn_ast_word, word, param->ast->words))
        if (names)
            names[count++] = word->text;
    words_text(param->ast, words, sizeof words);
    if (value->kind == TN_EXPR_BROKEN)
        return;
    bool name = value->kind == TN_EXPR_NAME;
    const char *near = name && names ? tn_nearest(value->name->text, names, count) : NULL;
    tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_VALUE, value->node.span,
                                 "`%s` is none of the words of `%s`", text_of(check, value->node.span), param->name);
    note_param(check, d, param);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "its words are %s", words);
}

static bool is_word(const tn_checked_rule *param, const tn_ast_expr *value)
{
    return value->kind == TN_EXPR_NAME && word_of(param->ast, value->name->text);
}

static void check_words(tn_check *check, const tn_checked_rule *param)
{
    for (TN_EACH(const tn_ast_word, word, param->ast->words)) {
        const tn_ast_word *first = word_of(param->ast, word->text);
        if (first == word)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_NAME, word->node.span,
                                     "`%s` is twice among the words of `%s`", word->text, param->name);
        tn_note(check->diagnostics, d, &first->node.span, "it is here, too");
        tn_help(check->diagnostics, d, "leave one of them out");
    }
}

/* ---- a param */

/* Reads its range. false: reported. */
static bool read_range(tn_check *check, tn_checked_rule *param)
{
    const tn_ast_rule *ast = param->ast;
    tn_checked_param *to = param->param;
    tn_sum_amount low, high;
    if (!ast->low)
        return true;
    to->range = tn_span_join(ast->low->node.span, ast->high->node.span);
    if (!read_constant(check, param, ast->low, param->unit, &low) ||
        !read_constant(check, param, ast->high, param->unit, &high))
        return false;
    to->kind = to->kind.any ? low : to->kind;
    to->kind = to->kind.any ? high : to->kind;
    if (!same_kind(check, param, low, ast->low->node.span) || !same_kind(check, param, high, ast->high->node.span))
        return false;
    if (is_below(check, high.value, low.value)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_VALUE, to->range,
                                     "the range of `%s` goes from a greater value to a lesser one", param->name);
        tn_help(check->diagnostics, d, "write `%s..%s`", text_of(check, ast->high->node.span),
                text_of(check, ast->low->node.span));
        return false;
    }
    to->low = low.value;
    to->high = high.value;
    return true;
}

/* Can the param have the value, which is written in the file numbered check->unit? Reports where not. */
static bool takes(tn_check *check, const tn_checked_rule *param, tn_ast_expr *value)
{
    tn_sum_amount amount;
    tn_span span = value->node.span;
    if (!param->param->good)
        return false;
    if (param->ast->words.first) {
        if (!is_word(param, value))
            report_no_word(check, param, value);
        return is_word(param, value);
    }
    if (!read_constant(check, param, value, check->unit, &amount) || !same_kind(check, param, amount, span))
        return false;
    if (!in_range(check, param->param, amount.value)) {
        report_range(check, param, span, false);
        return false;
    }
    return true;
}

void tn_check_param(tn_check *check, tn_checked_rule *param)
{
    tn_checked_param *to = param->param;
    tn_ast_rule *ast = param->ast;
    tn_sum_amount amount;
    if (to->seen)
        return;
    to->seen = true;
    check->schema = NULL;
    tn_let_value(check, param);
    if (ast->words.first) {
        check_words(check, param);
        to->good = true;
    } else if (!param->failed && read_constant(check, param, ast->body, param->unit, &amount)) {
        to->kind = amount;
        to->good = read_range(check, param);
        if (to->good && !in_range(check, to, amount.value))
            report_range(check, param, ast->body->node.span, true);
    }
}

/* ---- where words stand */

/* The param of words that a side of a comparison names, or NULL. */
static tn_checked_rule *words_named(tn_rule_expansion *expansion, const tn_ast_node *side, tn_bound_name *bound)
{
    const tn_ast_expr *expr = (const tn_ast_expr *)side;
    *bound = expr->kind == TN_EXPR_NAME ? tn_bound(expansion, expr->name) : (tn_bound_name){0};
    return bound->let && bound->let->param && bound->let->ast->words.first ? bound->let : NULL;
}

bool tn_decide_words(tn_rule_expansion *expansion, const tn_ast_expr *comparison, tn_expr_kind *decided)
{
    tn_check *check = expansion->check;
    const tn_ast_expr *sides[2] = {(const tn_ast_expr *)comparison->parts.first,
                                   (const tn_ast_expr *)comparison->parts.last};
    tn_bound_name bound[2];
    tn_checked_rule *params[2];
    for (int k = 0; k < 2; k++)
        params[k] = words_named(expansion, &sides[k]->node, &bound[k]);
    int k = params[0] ? 0 : 1;
    const tn_checked_rule *param = params[k];
    if (!param)
        return false;
    *decided = TN_EXPR_BROKEN;
    bool word = sides[1 - k]->kind == TN_EXPR_NAME || sides[1 - k]->kind == TN_EXPR_NUMBER;
    if (!word)
        return tn_refuse_words(expansion, bound[k], sides[k]->node.span);
    if (comparison->op != TN_EQUAL && comparison->op != TN_UNEQUAL) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_PLACE, comparison->node.span,
                                     "the words of `%s` have no order", param->name);
        note_param(check, d, param);
        tn_help(check->diagnostics, d, "compare them by `=` or `!=`");
    } else if (!is_word(param, sides[1 - k])) {
        report_no_word(check, param, sides[1 - k]);
    } else if (bound[k].value && bound[k].value->kind == TN_EXPR_NAME) {
        bool same = strcmp(bound[k].value->name->text, sides[1 - k]->name->text) == 0;
        *decided = tn_decided(comparison->op, same ? 0 : 1);
    }
    return true;
}

bool tn_refuse_words(tn_rule_expansion *expansion, tn_bound_name bound, tn_span place)
{
    tn_check *check = expansion->check;
    char words[240];
    if (!bound.let || !bound.let->param || !bound.let->ast->words.first)
        return false;
    const tn_checked_rule *param = bound.let;
    tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_PLACE, place, "`%s` is one of the words %s", param->name,
                                 words_text(param->ast, words, sizeof words));
    note_param(check, d, param);
    tn_help(check->diagnostics, d, "compare it: `%s = %s`", param->name,
            ((const tn_ast_word *)param->ast->words.first)->text);
    return true;
}

bool tn_refuse_param(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word)
{
    const tn_checked_name *name =
        check->in_schema && word->kind == TN_WORD_NAME ? tn_names_get(&check->names, word->text) : NULL;
    const tn_checked_rule *param = name && name->rule && name->rule->param ? name->rule : NULL;
    if (!param)
        return false;
    tn_diagnostic *d = tn_report(check->diagnostics, E_PARAM_PLACE, word->node.span,
                                 "`%s` is a param, and a schema has the same trays whatever params are", word->text);
    note_param(check, d, param);
    const tn_ast_word *first = (const tn_ast_word *)param->ast->words.first;
    if (first)
        tn_help(check->diagnostics, d, "ask for it in a rule: `%s = %s implies tray(...)`", word->text, first->text);
    else
        tn_help(check->diagnostics, d, "write its value here, or ask for it in a library: `require sum(%s) <= %s`",
                schema->length_field < schema->field_count ? schema->fields[schema->length_field].name : "FIELD",
                word->text);
    return true;
}

/* ---- what is given */

static const char *nearest_param(tn_check *check, const char *word)
{
    size_t count = 0, capacity = 0;
    for (size_t u = 0; u < check->imports->count; u++)
        capacity += ((const tn_ast_file *)check->imports->units[u]->tree)->items.count;
    const char **names = TN_NEW_ARRAY(check->arena, const char *, capacity);
    for (size_t u = 0; names && u < check->imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)check->imports->units[u]->tree)->items))
            if (item->kind == TN_ITEM_PARAM)
                names[count++] = ((const tn_ast_rule *)item)->name->text;
    return names && count ? tn_nearest(word, names, count) : NULL;
}

/* The param of that name; NULL: reported. */
static tn_checked_rule *named(tn_check *check, const tn_ast_word *name)
{
    const tn_checked_name *found = tn_names_get(&check->names, name->text);
    tn_checked_rule *rule = found ? found->rule : NULL;
    if (rule && rule->param && tn_import_reaches(check->imports, check->unit, found->unit))
        return rule;
    if (rule && rule->param) {
        tn_check_name(check, name, TN_WANT_RULE); /* says that its file is not used */
        return NULL;
    }
    if (check->incomplete || name->broken)
        return NULL;
    const tn_sources *sources = check->diagnostics->sources;
    bool asked = strcmp(sources->files[name->node.span.file].path, TN_SETTING_SOURCE) == 0;
    tn_diagnostic *d =
        asked ? tn_report(check->diagnostics, E_UNKNOWN_PARAM, name->node.span, "%s has no param `%s`",
                          sources->files[0].path, name->text)
              : tn_report(check->diagnostics, E_UNKNOWN_PARAM, name->node.span, "there is no param `%s`", name->text);
    const char *near = nearest_param(check, name->text);
    if (found)
        tn_note(check->diagnostics, d, &found->span, "`%s` is here, and is none", name->text);
    if (rule && rule->is_let)
        tn_help(check->diagnostics, d, "write `param` instead of `let` before its name");
    else if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "a param is written `param %s = 12m in 9m..20m` or `param %s = left | right`",
                name->text, name->text);
    return NULL;
}

/* false: reported. */
static bool check_setting(tn_check *check, const tn_ast_list settings, const tn_ast_setting *setting)
{
    const tn_ast_setting *first = (const tn_ast_setting *)settings.first;
    while (first != setting && strcmp(first->name->text, setting->name->text) != 0)
        first = (const tn_ast_setting *)first->node.next;
    tn_checked_rule *param = named(check, setting->name);
    if (param && first != setting) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_NAME, setting->name->node.span,
                                     "`%s` is given twice", setting->name->text);
        tn_note(check->diagnostics, d, &first->node.span, "it is given here, too");
        tn_help(check->diagnostics, d, "leave one of them out");
        return false;
    }
    if (param)
        tn_check_param(check, param);
    return param && takes(check, param, setting->value);
}

void tn_check_with(tn_check *check, const tn_ast_test *test)
{
    check->schema = NULL;
    for (TN_EACH(const tn_ast_setting, setting, test->settings))
        check_setting(check, test->settings, setting);
}

void tn_check_settings(tn_check *check)
{
    check->unit = check->imports->count - 1;
    for (TN_EACH(const tn_ast_setting, setting, check->asked->settings)) {
        if (check_setting(check, check->asked->settings, setting))
            continue;
        const tn_checked_name *name = tn_names_get(&check->names, setting->name->text);
        if (!name || !name->rule || !name->rule->param)
            continue;
        name->rule->ast->given = NULL; /* what follows from a wrong value is not said */
        name->rule->state = 0;
        name->rule->failed = false;
    }
}

/* ---- for whoever lists them */

static void list_param(tn_check *check, const tn_ast_rule *ast, bool imported, tn_program_param *to)
{
    const tn_ast_expr *value = ast->given ? ast->given : ast->body;
    *to = (tn_program_param){.name = ast->name->text,
                             .doc = ast->doc ? ast->doc->text : NULL,
                             .value = text_of(check, value->node.span),
                             .place = ast->body->node.span,
                             .imported = imported};
    if (ast->low) {
        to->least = text_of(check, ast->low->node.span);
        to->most = text_of(check, ast->high->node.span);
    }
    to->words = ast->words.first ? TN_NEW_ARRAY(check->arena, const char *, ast->words.count) : NULL;
    for (TN_EACH(const tn_ast_word, word, ast->words)) {
        if (to->words)
            to->words[to->word_count++] = word->text;
        to->place = tn_span_join(((const tn_ast_node *)ast->words.first)->span, word->node.span);
    }
}

void tn_check_list_params(tn_check *check)
{
    const tn_imports *imports = check->imports;
    size_t count = 0;
    for (size_t u = 0; u < imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)imports->units[u]->tree)->items))
            count += item->kind == TN_ITEM_PARAM;
    tn_program *program = check->result->program;
    program->params = TN_NEW_ARRAY(check->arena, tn_program_param, count);
    for (size_t u = 0; program->params && u < imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)imports->units[u]->tree)->items))
            if (item->kind == TN_ITEM_PARAM)
                list_param(check, (const tn_ast_rule *)item, u + 1 < imports->count,
                           &program->params[program->param_count++]);
}
