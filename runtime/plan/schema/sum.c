/* Sums over plans: what their trays count, exactly, and then in whole steps. */
#include "runtime/plan/schema/sum.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/number/rational.h"

tn_sum_kind tn_term_counts(uint32_t kind)
{
    bool singles = kind == TN_SUM_SINGLES_BEFORE || kind == TN_SUM_SINGLES_AFTER;
    bool starts = kind == TN_SUM_STARTS_BEFORE || kind == TN_SUM_STARTS_AFTER;
    return singles ? TN_SUM_SINGLES : starts ? TN_SUM_STARTS : (tn_sum_kind)kind;
}

tn_sum_region tn_term_region(uint32_t kind)
{
    bool before = kind == TN_SUM_SINGLES_BEFORE || kind == TN_SUM_STARTS_BEFORE;
    bool after = kind == TN_SUM_SINGLES_AFTER || kind == TN_SUM_STARTS_AFTER;
    return before ? TN_REGION_BEFORE : after ? TN_REGION_AFTER : TN_REGION_STRETCH;
}

bool tn_term_is_gap(uint32_t kind)
{
    return kind == TN_SUM_LONGEST_GAP || kind == TN_SUM_SHORTEST_GAP;
}

bool tn_term_of_whole(uint32_t kind)
{
    return kind == TN_SUM_MATCHES || kind == TN_SUM_NEEDED || tn_term_is_gap(kind);
}

/* ---- what a tray counts */

/* A number on the stack. What has divided by zero has no value; nor has what is made of it. */
typedef struct tally {
    mpq_t value;
    uint32_t divided; /* where in the code that was, or NOWHERE */
} tally;

static const uint32_t NOWHERE = UINT32_MAX;

static void operate(tn_opcode opcode, tally *lower, const tally *upper, uint32_t offset)
{
    if (lower->divided == NOWHERE)
        lower->divided = upper->divided;
    switch (opcode) {
    case TN_OP_PLUS:
        mpq_add(lower->value, lower->value, upper->value);
        break;
    case TN_OP_MINUS:
        mpq_sub(lower->value, lower->value, upper->value);
        break;
    case TN_OP_TIMES:
        mpq_mul(lower->value, lower->value, upper->value);
        break;
    case TN_OP_OVER:
        if (mpq_sgn(upper->value) != 0)
            mpq_div(lower->value, lower->value, upper->value);
        else if (lower->divided == NOWHERE)
            lower->divided = offset;
        break;
    default: /* LESSER, LARGER */
        if ((mpq_cmp(upper->value, lower->value) < 0) == (opcode == TN_OP_LESSER))
            mpq_set(lower->value, upper->value);
        break;
    }
}

/* Runs one instruction; what has grown past all measure becomes 0, which tn_sum_new then refuses to have a step for. */
static void run(const tn_schema *schema, const tn_instruction *op, uint32_t offset, tn_tray tray, tally *stack,
                size_t *top)
{
    switch (op->opcode) {
    case TN_OP_FIGURE:
        stack[*top].divided = NOWHERE;
        mpq_set_str(stack[(*top)++].value, tn_text(schema->module, (tn_string)op->first), 10);
        return;
    case TN_OP_EXTENT: {
        uint32_t field = (uint32_t)op->first - schema->record->field_first;
        stack[*top].divided = NOWHERE;
        mpq_set_si(stack[(*top)++].value, tn_tray_value_record(schema, tray, field)->length, 1);
        return;
    }
    case TN_OP_PICK:
        --*top;
        if (tn_spec_meets(schema, (uint32_t)op->first, tray)) {
            mpq_swap(stack[*top - 1].value, stack[*top].value);
            stack[*top - 1].divided = stack[*top].divided;
        }
        return;
    default:
        --*top;
        operate(op->opcode, &stack[*top - 1], &stack[*top], offset);
        if (!tn_rational_fits(stack[*top - 1].value))
            mpq_set_si(stack[*top - 1].value, 0, 1);
        return;
    }
}

/* The exact value of a tally function for a tray: in nanometres to its power. false, and 0, where it divides by zero:
 * *divided is where. */
static bool tally_value(const tn_schema *schema, uint32_t function, tn_tray tray, mpq_t value, uint32_t *divided)
{
    tally stack[TN_TALLY_STACK_MAX];
    const tn_function_record *record = &schema->module->FUNCTION_records[function];
    size_t top = 0;
    for (uint32_t i = 0; i < record->stack_max; i++)
        mpq_init(stack[i].value);
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction op = tn_code_read(schema->module->code, offset);
        if (op.opcode == TN_OP_TALLY)
            break;
        run(schema, &op, offset, tray, stack, &top);
        offset += op.length;
    }
    *divided = stack[0].divided;
    if (*divided == NOWHERE)
        mpq_set(value, stack[0].value);
    else
        mpq_set_si(value, 0, 1);
    for (uint32_t i = 0; i < record->stack_max; i++)
        mpq_clear(stack[i].value);
    return *divided == NOWHERE;
}

/* ---- trays that a term does not count */

enum { STACK = 64, WORK = 10000 };

/* May a rule function match the tray alone? Decided of specifiers joined by `and`, `or`, `not` and calls; where there
 * is more in it, or it takes long, it may. `work`: instructions that may still be run. */
static bool may_match(const tn_schema *schema, uint32_t function, tn_tray tray, uint32_t *work)
{
    const tn_function_record *record = &schema->module->FUNCTION_records[function];
    bool stack[STACK];
    size_t top = 0;
    if (record->stack_max > STACK)
        return true;
    for (uint32_t offset = record->code_begin;;) {
        tn_instruction op = tn_code_read(schema->module->code, offset);
        if (*work == 0)
            return true;
        --*work;
        switch (op.opcode) {
        case TN_OP_TRAY:
            stack[top++] = tn_spec_meets(schema, (uint32_t)op.first, tray);
            break;
        case TN_OP_CALL:
            stack[top++] = may_match(schema, (uint32_t)op.first, tray, work);
            break;
        case TN_OP_AND:
            top--;
            stack[top - 1] = stack[top - 1] && stack[top];
            break;
        case TN_OP_OR:
            top--;
            stack[top - 1] = stack[top - 1] || stack[top];
            break;
        case TN_OP_NOT:
            stack[top - 1] = !stack[top - 1];
            break;
        case TN_OP_SOMEWHERE:
            break;
        case TN_OP_RETURN:
            return stack[0];
        default:
            return true;
        }
        offset += op.length;
    }
}

static tn_status divided_by_zero(const tn_schema *schema, uint32_t offset, tn_tray tray, tn_error *error)
{
    char text[200] = "";
    for (uint32_t f = 0; f < schema->field_count; f++) {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%s", used ? " " : "",
                 tn_text(schema->module, tn_tray_value_record(schema, tray, f)->spelling));
    }
    tn_fail(error, TN_INVALID, E_DIVIDED_BY_ZERO, "this divides by 0 for the tray `%s`", text);
    tn_error_help(error, "say which trays are meant, after `of`: `sum(... of tray(...))`, or in a number's `where`");
    if (error)
        error->code_offset = offset;
    return TN_INVALID;
}

/* ---- kinds of trays, where trays are not listed */

/* Splits the kinds by the specifiers that may_match asks. */
static tn_status split_by_part(tn_kinds *kinds, uint32_t function, uint32_t *work, tn_error *error)
{
    const tn_module *module = kinds->schema->module;
    const tn_function_record *record = &module->FUNCTION_records[function];
    tn_status status = TN_OK;
    for (uint32_t offset = record->code_begin; status == TN_OK && offset<record->code_end && * work> 0; --*work) {
        tn_instruction op = tn_code_read(module->code, offset);
        if (op.opcode == TN_OP_TRAY)
            status = tn_kinds_by_spec(kinds, (uint32_t)op.first, error);
        else if (op.opcode == TN_OP_CALL)
            status = split_by_part(kinds, (uint32_t)op.first, work, error);
        offset += op.length;
    }
    return status;
}

/* Trays of one kind count the same in the term, and are counted or not alike if that divides. */
static tn_status split_by_term(tn_kinds *kinds, const tn_term_record *term, tn_error *error)
{
    const tn_module *module = kinds->schema->module;
    const tn_function_record *record = &module->FUNCTION_records[term->tally];
    bool divides = false;
    tn_status status = TN_OK;
    for (uint32_t offset = record->code_begin; status == TN_OK && offset < record->code_end;) {
        tn_instruction op = tn_code_read(module->code, offset);
        if (op.opcode == TN_OP_PICK)
            status = tn_kinds_by_spec(kinds, (uint32_t)op.first, error);
        else if (op.opcode == TN_OP_EXTENT)
            status = tn_kinds_by_lengths(kinds, (uint32_t)op.first - kinds->schema->record->field_first, error);
        divides |= op.opcode == TN_OP_OVER;
        offset += op.length;
    }
    uint32_t work = WORK;
    return status == TN_OK && divides ? split_by_part(kinds, term->part, &work, error) : status;
}

static tn_status find_kinds(tn_sum *sum, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; sum->schema->legal && status == TN_OK && i < sum->count; i++) {
        const tn_term_record *term = &sum->schema->module->TERM_records[sum->record->term_first + i];
        sum->terms[i].kinds.schema = sum->schema;
        if (term->tally != TN_NO_RECORD)
            status = split_by_term(&sum->terms[i].kinds, term, error);
    }
    return status;
}

/* ---- steps */

/* The numbers of a sum one after another: its constant, and what each term counts for each tray. */
typedef struct walk {
    mpz_t common, divisor; /* of denominators; of what is then whole */
    mpq_t value, factor;
} walk;

static const tn_term_record *term_of(const tn_sum *sum, uint32_t i)
{
    return &sum->schema->module->TERM_records[sum->record->term_first + i];
}

/* How many trays, or kinds of trays, there are in a term. */
static uint32_t trays_of(const tn_sum *sum, uint32_t i)
{
    return sum->schema->legal ? tn_kinds_of(&sum->terms[i].kinds)->labels : sum->schema->tray_count;
}

/* The tray, or the first tray of the kind. */
static tn_tray tray_of(const tn_sum *sum, uint32_t i, uint32_t t)
{
    return sum->schema->legal ? tn_kinds_of(&sum->terms[i].kinds)->first[t] : t;
}

/* value := the number of tray (or kind) t in term i; of a tray that the term does not count it may be anything. */
static void number(const tn_sum *sum, walk *w, uint32_t i, uint32_t t)
{
    uint32_t divided;
    const tn_term_record *term = term_of(sum, i);
    if (term->tally == TN_NO_RECORD) {
        mpq_set(w->value, w->factor);
        return;
    }
    tally_value(sum->schema, term->tally, tray_of(sum, i, t), w->value, &divided);
    mpq_mul(w->value, w->value, w->factor);
}

/* What is needed counts nothing. */
static uint32_t numbers(const tn_sum *sum, uint32_t i)
{
    const tn_term_record *term = term_of(sum, i);
    return term->kind == TN_SUM_NEEDED ? 0 : term->tally == TN_NO_RECORD ? 1 : trays_of(sum, i);
}

static void constant(const tn_sum *sum, walk *w)
{
    mpq_set_str(w->value, tn_text(sum->schema->module, sum->record->constant), 10);
}

static tn_status too_fine(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_FINE, "the numbers of a sum have no step in common that they are few times of");
    tn_error_help(error, "use rounder numbers: prices in steps of 10 or 50, lengths in whole units");
    return TN_LIMIT;
}

/* No tray that is counted divides by zero. */
static tn_status check_divisions(const tn_sum *sum, walk *w, tn_error *error)
{
    uint32_t divided;
    for (uint32_t i = 0; i < sum->count; i++) {
        const tn_term_record *term = term_of(sum, i);
        for (uint32_t t = 0; term->tally != TN_NO_RECORD && t < trays_of(sum, i); t++) {
            uint32_t work = WORK;
            tn_tray tray = tray_of(sum, i, t);
            if (!tally_value(sum->schema, term->tally, tray, w->value, &divided) &&
                may_match(sum->schema, term->part, tray, &work))
                return divided_by_zero(sum->schema, divided, tray, error);
        }
    }
    return TN_OK;
}

static tn_status find_unit(tn_sum *sum, walk *w, tn_error *error)
{
    constant(sum, w);
    mpz_set(w->common, mpq_denref(w->value));
    for (uint32_t i = 0; i < sum->count; i++) {
        mpq_set_str(w->factor, tn_text(sum->schema->module, term_of(sum, i)->factor), 10);
        for (uint32_t t = 0; t < numbers(sum, i); t++) {
            number(sum, w, i, t);
            mpz_lcm(w->common, w->common, mpq_denref(w->value));
            if (mpz_sizeinbase(w->common, 2) > TN_RATIONAL_BITS)
                return too_fine(error);
        }
    }
    return TN_OK;
}

/* divisor := gcd(divisor, value * common); value then has no denominator. */
static void divide(walk *w)
{
    mpz_t whole;
    mpz_init(whole);
    mpz_divexact(whole, w->common, mpq_denref(w->value));
    mpz_mul(whole, whole, mpq_numref(w->value));
    mpz_gcd(w->divisor, w->divisor, whole);
    mpz_clear(whole);
}

static void find_divisor(tn_sum *sum, walk *w)
{
    constant(sum, w);
    divide(w);
    for (uint32_t i = 0; i < sum->count; i++) {
        mpq_set_str(w->factor, tn_text(sum->schema->module, term_of(sum, i)->factor), 10);
        for (uint32_t t = 0; t < numbers(sum, i); t++) {
            number(sum, w, i, t);
            divide(w);
        }
    }
    if (mpz_sgn(w->divisor) == 0)
        mpz_set_ui(w->divisor, 1);
    mpz_set(mpq_numref(sum->unit), w->divisor);
    mpz_set(mpq_denref(sum->unit), w->common);
    mpq_canonicalize(sum->unit);
}

static bool to_steps(const tn_sum *sum, walk *w, int64_t *steps)
{
    mpq_div(w->value, w->value, sum->unit);
    bool fits = mpz_sizeinbase(mpq_numref(w->value), 2) < 45; /* TN_SUM_STEPS_MAX */
    *steps = fits ? mpz_get_si(mpq_numref(w->value)) : 0;
    return fits;
}

static tn_status fill(tn_sum *sum, walk *w, tn_error *error)
{
    constant(sum, w);
    if (!to_steps(sum, w, &sum->constant))
        return too_fine(error);
    for (uint32_t i = 0; i < sum->count; i++) {
        const tn_term_record *record = term_of(sum, i);
        tn_sum_term *term = &sum->terms[i];
        term->kind = tn_term_counts(record->kind);
        term->region = tn_term_region(record->kind);
        term->part = record->part;
        term->other = record->other;
        mpq_set_str(w->factor, tn_text(sum->schema->module, record->factor), 10);
        if (record->tally != TN_NO_RECORD &&
            !(term->weight = calloc((size_t)trays_of(sum, i) + 1, sizeof *term->weight)))
            return tn_fail_memory(error);
        for (uint32_t t = 0; t < numbers(sum, i); t++) {
            number(sum, w, i, t);
            if (!to_steps(sum, w, term->weight ? &term->weight[t] : &term->each))
                return too_fine(error);
        }
    }
    return TN_OK;
}

tn_status tn_sum_new(const tn_schema *schema, uint32_t index, tn_sum **out, tn_error *error)
{
    tn_sum *sum = calloc(1, sizeof *sum);
    if (!sum)
        return tn_fail_memory(error);
    sum->schema = schema;
    sum->record = &schema->module->SUM_records[index];
    sum->count = sum->record->term_count;
    mpq_init(sum->unit);
    sum->terms = calloc((size_t)sum->count + 1, sizeof *sum->terms);
    walk w;
    mpz_inits(w.common, w.divisor, NULL);
    mpq_inits(w.value, w.factor, NULL);
    tn_status status = sum->terms ? find_kinds(sum, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = check_divisions(sum, &w, error);
    if (status == TN_OK)
        status = find_unit(sum, &w, error);
    if (status == TN_OK) {
        find_divisor(sum, &w);
        status = fill(sum, &w, error);
    }
    mpz_clears(w.common, w.divisor, NULL);
    mpq_clears(w.value, w.factor, NULL);
    if (status != TN_OK) {
        tn_sum_free(sum);
        return status;
    }
    *out = sum;
    return TN_OK;
}

void tn_sum_free(tn_sum *sum)
{
    if (!sum)
        return;
    for (uint32_t i = 0; sum->terms && i < sum->count; i++) {
        free(sum->terms[i].weight);
        tn_labelling_free(sum->terms[i].kinds.made);
    }
    free(sum->terms);
    mpq_clear(sum->unit);
    free(sum);
}

/* steps * p / q is whole if q divides the steps, p and q having nothing in common. No sum has as many steps as the
 * greatest modulus but one: then only 0 is a multiple. */
int64_t tn_sum_modulus(const tn_sum *sum, int64_t number)
{
    mpq_t part;
    mpq_init(part);
    mpq_set_si(part, number, 1);
    mpq_div(part, sum->unit, part);
    int64_t modulus = mpz_fits_slong_p(mpq_denref(part)) ? mpz_get_si(mpq_denref(part)) : INT64_MAX;
    mpq_clear(part);
    return modulus;
}
