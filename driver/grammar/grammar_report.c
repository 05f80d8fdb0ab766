/* Reports what analysing a grammar finds, at its places. */
#include "driver/grammar/grammar_report.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/grammar/analysis.h"

#define GROWS 1.0005        /* above it a mean multiplication is not a matter of rounding */
#define DEPTHS_SHOWN 8u     /* levels for which derivations are counted, from the shallowest sentence on */
#define CODONS_SHOWN 24u    /* likewise numbers of codons */
#define RULES_COUNTED 2000u /* of larger grammars, derivations are not counted */
#define DIGITS_SHOWN 24u

static tn_span span_of(const tn_rule *rule)
{
    return (tn_span){rule->file, rule->begin, rule->end};
}

static void warn_of_growth(tn_opened *opened, const tn_grammar *g, const tn_analysis *a)
{
    if (a->growing_rule == TN_NO_RECORD || a->growth <= GROWS)
        return;
    tn_diagnostics *list = &opened->compilation.diagnostics;
    const tn_rule *rule = &g->rules[a->growing_rule];
    tn_diagnostic *diagnostic = tn_report(
        list, W_GRAMMAR_EXPLODES, span_of(rule),
        "sentences tend to grow without end: random choices turn each %s into %.2f recursive non-terminals on average",
        tn_rule_name(g, a->growing_rule), a->growth);
    tn_help(list, diagnostic, "add alternatives that end (an alternative may stand several times), or set %%max-depth");
}

/* "1446", or "3.65e27" where it has many digits. */
static void write_count(const mpz_t count, char *text, size_t size)
{
    char *digits = mpz_get_str(NULL, 10, count);
    size_t length = digits ? strlen(digits) : 0;
    if (!digits)
        snprintf(text, size, "?");
    else if (length <= DIGITS_SHOWN)
        snprintf(text, size, "%s", digits);
    else
        snprintf(text, size, "%c.%.2se%zu", digits[0], digits + 1, length - 1);
    free(digits);
}

static tn_status count_at(const tn_grammar *g, uint32_t depth, bool *by_codons, char *text, size_t size,
                          tn_error *error)
{
    mpz_t count;
    mpz_init(count);
    tn_status status = tn_count_derivations(g, depth, by_codons, count, error);
    if (status == TN_OK)
        write_count(count, text, size);
    mpz_clear(count);
    return status;
}

static tn_status note_counts(tn_opened *opened, const tn_grammar *g, uint32_t shallowest, tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    bool by_codons = tn_grammar_has_loops(g);
    uint32_t from = by_codons ? 1 : shallowest, to = by_codons ? CODONS_SHOWN : shallowest + DEPTHS_SHOWN;
    for (uint32_t n = from; n < to; n++) {
        char text[64];
        tn_status status = count_at(g, n, &by_codons, text, sizeof text, error);
        if (status == TN_LIMIT)
            return TN_OK; /* what there was room for has been said */
        if (status != TN_OK)
            return status;
        if (!by_codons)
            tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "derivations of at most %u levels: %s", n, text);
        else if (strcmp(text, "0") != 0)
            tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "derivations of %u codons, edge types not told apart: %s", n,
                           text);
    }
    return TN_OK;
}

static tn_status note_figures(tn_opened *opened, const tn_grammar *g, const tn_analysis *a, tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "%zu rules with %zu alternatives, %zu different terminals",
                   g->rule_count, g->production_count, g->terminal_count);
    tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "the shallowest sentence has %u levels", a->rule_depth[0]);
    if (a->growing_rule == TN_NO_RECORD)
        tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "no rule leads back to itself");
    else
        tn_report_bare(list, TN_NOTE, TN_CODE_NONE,
                       "random choices multiply recursive non-terminals by %.3f a round, most of all %s", a->growth,
                       tn_rule_name(g, a->growing_rule));
    return g->rule_count <= RULES_COUNTED ? note_counts(opened, g, a->rule_depth[0], error) : TN_OK;
}

tn_status tn_grammar_report(tn_opened *opened, bool figures, tn_error *error)
{
    tn_grammar *grammar = NULL;
    tn_analysis analysis = {0};
    tn_status status = tn_grammar_new(opened->module, 0, &grammar, error);
    if (status == TN_OK)
        status = tn_analyse(grammar, &analysis, error);
    if (status == TN_OK) {
        warn_of_growth(opened, grammar, &analysis);
        if (figures && analysis.rule_depth[0] != TN_DEPTH_ENDLESS)
            status = note_figures(opened, grammar, &analysis, error);
    }
    tn_analysis_clear(&analysis);
    tn_grammar_free(grammar);
    return status;
}
