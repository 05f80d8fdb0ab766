/* Lowers rule functions to automata. */
#include "runtime/plan/match/lower.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/marked.h"
#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/circle.h"
#include "runtime/plan/match/image.h"
#include "runtime/plan/match/postfix.h"
#include "runtime/plan/match/summing.h"
#include "runtime/plan/match/tray_relations.h"

/* The forms in which a function may be needed: of the plan as a whole (PLAIN: over the classes), or as a relation (over
 * marked words); each as it is written or with the plan reversed. */
typedef enum tn_form { FORM_PLAIN = 1, FORM_REVERSED = 2, FORM_COUNT = 4 } tn_form;

typedef struct tn_lowered {
    tn_dfa *dfa;     /* NULL: not yet, or failed */
    tn_error *error; /* why it failed; NULL otherwise */
} tn_lowered;

/* All rules of a lowering together may take this many times the work of one. */
#define RULES_WORK 8

struct tn_lowering {
    const tn_module *module;
    const tn_classes *classes;
    tn_bounds bounds;
    tn_marked marked;
    uint32_t max_trays;       /* of the plans that the automata are asked about; 0: not known */
    uint8_t *local;           /* [FUNCTION records]: tn_summing_is_local's */
    tn_sum **sums;            /* [SUM records], NULL where not met yet */
    uint64_t spent;           /* work on the rules before */
    const uint32_t *disabled; /* code offsets of instructions that give nothing */
    size_t disabled_count;
    tn_lowering_ask *ask; /* about houses, or NULL */
    void *house;
    tn_lowered *lowered; /* [functions][FORM_COUNT] */
};

tn_status tn_lowering_new(const tn_classes *classes, uint32_t max_states, tn_lowering **out, tn_error *error)
{
    tn_lowering *lowering = calloc(1, sizeof *lowering);
    if (!lowering)
        return tn_fail_memory(error);
    lowering->module = classes->schema->module;
    lowering->classes = classes;
    lowering->bounds = tn_bounds_make(max_states ? max_states : TN_STATES_DEFAULT);
    lowering->bounds.letters = classes->count;
    lowering->bounds.watch = lowering->module->watch;
    lowering->lowered = calloc(lowering->module->FUNCTION_count * FORM_COUNT + 1, sizeof *lowering->lowered);
    lowering->local = calloc(lowering->module->FUNCTION_count + 1, 1);
    tn_status status = lowering->lowered && lowering->local
                           ? tn_marked_make(&lowering->marked, classes->count, &lowering->bounds, error)
                           : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_lowering_free(lowering);
        return status;
    }
    *out = lowering;
    return TN_OK;
}

void tn_lowering_free(tn_lowering *lowering)
{
    if (!lowering)
        return;
    for (size_t i = 0; lowering->lowered && i < lowering->module->FUNCTION_count * FORM_COUNT; i++) {
        tn_dfa_free(lowering->lowered[i].dfa);
        free(lowering->lowered[i].error);
    }
    for (size_t i = 0; lowering->sums && i < lowering->module->SUM_count; i++)
        tn_sum_free(lowering->sums[i]);
    free(lowering->sums);
    free(lowering->local);
    free(lowering->lowered);
    tn_marked_clear(&lowering->marked);
    free(lowering);
}

void tn_lowering_within(tn_lowering *lowering, uint32_t max_trays)
{
    lowering->max_trays = max_trays > 0 ? max_trays : 1; /* 0 says that it is not known */
}

void tn_lowering_disable(tn_lowering *lowering, const uint32_t *offsets, size_t count)
{
    lowering->disabled = offsets;
    lowering->disabled_count = count;
}

void tn_lowering_house(tn_lowering *lowering, tn_lowering_ask *ask, void *house)
{
    lowering->ask = ask;
    lowering->house = house;
}

static bool is_disabled(const tn_lowering *lowering, uint32_t offset)
{
    for (size_t i = 0; i < lowering->disabled_count; i++)
        if (lowering->disabled[i] == offset)
            return true;
    return false;
}

/* ---- lowering instructions */

/* The functions called, in the form in which the caller wants them. */
static tn_lowered *called(const tn_lowering *lowering, const tn_postfix_node *node, uint32_t form, uint32_t *wanted)
{
    uint32_t other = (form & FORM_REVERSED) ^ (node->code.opcode == TN_OP_MIRROR ? FORM_REVERSED : 0);
    *wanted = (uint32_t)node->code.first * FORM_COUNT + (other | (node->plain ? FORM_PLAIN : 0));
    return &lowering->lowered[*wanted];
}

static tn_status lower_boolean(tn_lowering *lowering, const tn_postfix_node *node, tn_dfa *const *in, tn_dfa **out,
                               tn_error *error)
{
    switch (node->code.opcode) {
    case TN_OP_AND:
        return tn_dfa_product(in[0], in[1], TN_DFA_AND, "and", &lowering->bounds, out, error);
    case TN_OP_OR:
        return tn_dfa_product(in[0], in[1], TN_DFA_OR, "or", &lowering->bounds, out, error);
    default:
        return node->plain ? tn_dfa_complement(in[0], out, error) : tn_marked_not(&lowering->marked, in[0], out, error);
    }
}

static tn_status lower_where(const tn_marked *marked, tn_dfa *const *in, tn_dfa **out, tn_error *error)
{
    tn_dfa *both = NULL;
    tn_status status = tn_dfa_product(in[0], in[1], TN_DFA_AND, "where", marked->bounds, &both, error);
    if (status == TN_OK)
        status = tn_dfa_product(both, marked->nonempty, TN_DFA_AND, "where", marked->bounds, out, error);
    tn_dfa_free(both);
    return status;
}

/* The relation of an instruction whose operands are relations. */
static tn_status lower_relation(const tn_lowering *lowering, const tn_postfix_node *node, bool reversed,
                                tn_dfa *const *in, tn_dfa **out, tn_error *error)
{
    const tn_marked *marked = &lowering->marked;
    const tn_classes *classes = lowering->classes;
    uint32_t first = (uint32_t)node->code.first, second = (uint32_t)node->code.second;
    switch (node->code.opcode) {
    case TN_OP_TRAY:
        return tn_relate_tray(marked, classes, first, out, error);
    case TN_OP_ONCE:
        *out = tn_dfa_share(in[0]);
        return TN_OK;
    case TN_OP_NONEMPTY:
        return tn_dfa_product(in[0], marked->nonempty, TN_DFA_AND, "rule", marked->bounds, out, error);
    case TN_OP_OPTIONAL:
        return tn_dfa_product(in[0], marked->empty, TN_DFA_OR, "optional", marked->bounds, out, error);
    case TN_OP_CHAIN:
        return tn_marked_chain(marked, in[reversed], in[!reversed], out, error);
    case TN_OP_BEGINNING:
    case TN_OP_END: {
        const tn_dfa *place = (node->code.opcode == TN_OP_BEGINNING) != reversed ? marked->beginning : marked->end;
        return tn_dfa_product(in[0], place, TN_DFA_AND, "neighbour", marked->bounds, out, error);
    }
    case TN_OP_MANY:
        return tn_marked_many(marked, in[0], out, error);
    case TN_OP_REPEATED:
        return tn_marked_repeat(marked, in[0], first, second, out, error);
    case TN_OP_QUANTITY:
        return tn_relate_count(marked, classes, in[0], TN_TALLY_SINGLES, first, TN_NO_FIELD, out, error);
    case TN_OP_SUM:
        first -= classes->schema->record->field_first;
        return tn_relate_count(marked, classes, in[0], TN_TALLY_SINGLES, second, first, out, error);
    case TN_OP_OCCURRENCES:
        return tn_relate_count(marked, classes, in[0], reversed ? TN_TALLY_ENDS : TN_TALLY_STARTS, first, TN_NO_FIELD,
                               out, error);
    case TN_OP_DISTANCE:
        return tn_marked_distance(marked, in[0], in[1], in[2], reversed, out, error);
    case TN_OP_WHERE:
        return lower_where(marked, in, out, error);
    case TN_OP_MIRRORED:
        return tn_relate_mirrored(marked, classes, first - classes->schema->record->field_first, lowering->max_trays,
                                  out, error);
    case TN_OP_NEAR:
        return tn_marked_near(marked, in[0], in[1], in[2], out, error);
    case TN_OP_FAR:
        return tn_marked_far(marked, in[0], in[1], in[2], out, error);
    default:
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "an instruction that makes no relation");
    }
}

static tn_status summed(tn_lowering *lowering, uint32_t index, const tn_sum **sum, tn_error *error)
{
    if (!lowering->sums && !(lowering->sums = calloc(lowering->module->SUM_count + 1, sizeof(tn_sum *))))
        return tn_fail_memory(error);
    tn_status status =
        lowering->sums[index] ? TN_OK : tn_sum_new(lowering->classes->schema, index, &lowering->sums[index], error);
    if (status == TN_OK)
        *sum = lowering->sums[index];
    return status;
}

/* Is the term's automaton needed, or does each tray decide alone? */
static bool needs_part(const tn_lowering *lowering, const tn_term_record *term)
{
    return tn_term_counts(term->kind) == TN_SUM_STARTS ||
           !tn_summing_is_local(lowering->module, term->part, lowering->local);
}

static uint32_t part_wanted(const tn_term_record *term, uint32_t form)
{
    return term->part * FORM_COUNT + (form & FORM_REVERSED);
}

/* BELOW, ZERO, ABOVE, MULTIPLE: the parts are lowered. */
static tn_status lower_comparison(tn_lowering *lowering, const tn_postfix_node *node, uint32_t form, tn_dfa **out,
                                  tn_error *error)
{
    const tn_sum *sum = NULL;
    tn_status status = summed(lowering, (uint32_t)node->code.first, &sum, error);
    if (status != TN_OK)
        return status;
    tn_dfa **parts = calloc((size_t)sum->count + 1, sizeof(tn_dfa *));
    if (!parts)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < sum->count; i++) {
        const tn_term_record *term = &lowering->module->TERM_records[sum->record->term_first + i];
        if (needs_part(lowering, term))
            parts[i] = lowering->lowered[part_wanted(term, form)].dfa;
    }
    status = tn_relate_sum(&lowering->marked, lowering->classes, sum, parts, form & FORM_REVERSED, &node->code,
                           lowering->max_trays, out, error);
    free(parts);
    return status;
}

static tn_status lower_house(const tn_lowering *lowering, const tn_postfix_node *node, bool reversed, tn_dfa **out,
                             tn_error *error)
{
    if (!lowering->ask)
        return tn_fail(error, TN_INVALID, E_NOT_A_HOUSE, "a rule about houses was asked about a plan alone");
    return lowering->ask(lowering->house, &lowering->marked, &node->code, reversed, out, error);
}

/* IMAGE: of the plan as a whole. */
static tn_status lower_image(const tn_lowering *lowering, const tn_postfix_node *node, bool reversed, tn_dfa **out,
                             tn_error *error)
{
    tn_image_options options = {
        .max_states = lowering->bounds.max_states, .max_trays = lowering->max_trays, .reversed = reversed};
    tn_dfa *words = NULL;
    tn_status status = tn_image_lower(lowering->classes, &node->code, &options, &words, error);
    if (status != TN_OK || node->plain) {
        *out = words;
        return status;
    }
    status = tn_marked_words(&lowering->marked, words, out, error);
    tn_dfa_free(words);
    return status;
}

static tn_status somewhere(const tn_lowering *lowering, bool plain, const tn_dfa *relation, tn_dfa **out,
                           tn_error *error)
{
    return (plain ? tn_marked_anywhere : tn_marked_somewhere)(&lowering->marked, relation, out, error);
}

static tn_status either_operand(tn_lowering *lowering, uint32_t function, uint32_t form, tn_dfa **parts, size_t *count,
                                tn_error *error);

/* SOMEWHERE of what a called function ends with OR of, as `symmetric` does: one or the other stretch is somewhere. Sets
 * of guesses about both at once can be very many while those about each are few. TN_LIMIT: the call is of no such
 * function, or one of them passes the bounds, too. */
static tn_status somewhere_apart(tn_lowering *lowering, const tn_postfix_node *call, uint32_t form, bool plain,
                                 tn_dfa **out, tn_error *error)
{
    tn_dfa *parts[TN_OPERANDS_MAX] = {NULL}, *found[2] = {NULL};
    size_t count = 0;
    uint32_t wanted;
    if (call->code.opcode != TN_OP_CALL && call->code.opcode != TN_OP_MIRROR)
        return TN_LIMIT;
    called(lowering, call, form, &wanted);
    tn_status status = either_operand(lowering, wanted / FORM_COUNT, wanted % FORM_COUNT, parts, &count, error);
    for (size_t i = 0; status == TN_OK && i < 2; i++)
        status = somewhere(lowering, plain, parts[i], &found[i], error);
    if (status == TN_OK)
        status = tn_dfa_product(found[0], found[1], TN_DFA_OR, "or", &lowering->bounds, out, error);
    for (size_t i = 0; i < count; i++)
        tn_dfa_free(parts[i]);
    tn_dfa_free(found[0]);
    tn_dfa_free(found[1]);
    return status;
}

/* What makes the operand stands before the node. */
static tn_status lower_somewhere(tn_lowering *lowering, const tn_postfix_node *node, uint32_t form, tn_dfa *const *in,
                                 tn_dfa **out, tn_error *error)
{
    tn_error ignored;
    tn_status status = somewhere(lowering, node->plain, in[0], out, error);
    if (status != TN_LIMIT)
        return status;
    status = somewhere_apart(lowering, node - 1, form, node->plain, out, &ignored);
    if (status != TN_OK && status != TN_LIMIT && error)
        *error = ignored;
    return status;
}

static tn_status lower_node(tn_lowering *lowering, const tn_postfix_node *node, uint32_t form, tn_dfa *const *in,
                            tn_dfa **out, tn_error *error)
{
    uint32_t wanted;
    if (is_disabled(lowering, node->offset))
        return tn_dfa_constant(lowering->classes->count + !node->plain, false, out, error);
    switch (node->code.opcode) {
    case TN_OP_CALL:
    case TN_OP_MIRROR:
    case TN_OP_AGAIN:
        *out = tn_dfa_share(called(lowering, node, form, &wanted)->dfa);
        return TN_OK;
    case TN_OP_AND:
    case TN_OP_OR:
    case TN_OP_NOT:
        return lower_boolean(lowering, node, in, out, error);
    case TN_OP_IMAGE:
        return lower_image(lowering, node, form & FORM_REVERSED, out, error);
    case TN_OP_SOMEWHERE:
        return lower_somewhere(lowering, node, form, in, out, error);
    default:
        break;
    }
    tn_dfa *relation = NULL;
    bool reversed = form & FORM_REVERSED;
    tn_status status = tn_code_compares(node->code.opcode) ? lower_comparison(lowering, node, form, &relation, error)
                       : tn_code_asks_house(node->code.opcode)
                           ? lower_house(lowering, node, reversed, &relation, error)
                           : lower_relation(lowering, node, reversed, in, &relation, error);
    if (status != TN_OK || !node->plain) {
        *out = relation;
        return status;
    }
    status = tn_marked_whole(&lowering->marked, relation, out, error);
    tn_dfa_free(relation);
    return status;
}

typedef struct tn_lowering_code {
    tn_lowering *lowering;
    uint32_t form;
} tn_lowering_code;

static tn_status make_node(void *context, const tn_postfix_node *node, tn_dfa *const *in, tn_dfa **out, tn_error *error)
{
    const tn_lowering_code *at = context;
    return lower_node(at->lowering, node, at->form, in, out, error);
}

static bool is_left_out(const void *context, uint32_t offset)
{
    return is_disabled(((const tn_lowering_code *)context)->lowering, offset);
}

/* Lowers a function whose callees are lowered. */
static tn_status lower_code(tn_lowering *lowering, tn_postfix *code, uint32_t form, tn_dfa **out, tn_error *error)
{
    return tn_postfix_fold(code, make_node, &(tn_lowering_code){lowering, form}, out, error);
}

/* ---- functions: callees first, on a stack of our own */

static tn_status push_callee(const tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    const tn_lowered *callee = &lowering->lowered[wanted];
    if (callee->error) {
        if (error)
            *error = *callee->error;
        return callee->error->status;
    }
    return callee->dfa || tn_key_push(pending, wanted) ? TN_OK : tn_fail_memory(error);
}

static tn_status push_parts(const tn_lowering *lowering, const tn_postfix_node *node, uint32_t form, tn_key *pending,
                            tn_error *error)
{
    const tn_sum_record *sum = &lowering->module->SUM_records[node->code.first];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < sum->term_count; i++) {
        const tn_term_record *term = &lowering->module->TERM_records[sum->term_first + i];
        if (needs_part(lowering, term))
            status = push_callee(lowering, part_wanted(term, form), pending, error);
    }
    return status;
}

/* Pushes the callees that are not lowered yet. A callee that failed is reported. */
static tn_status push_callees(tn_lowering *lowering, const tn_postfix *code, uint32_t form, tn_key *pending,
                              tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < code->count; i++) {
        const tn_postfix_node *node = &code->nodes[i];
        uint32_t wanted;
        if (tn_code_compares(node->code.opcode)) {
            status = push_parts(lowering, node, form, pending, error);
        } else if (node->code.opcode == TN_OP_CALL || node->code.opcode == TN_OP_MIRROR) {
            called(lowering, node, form, &wanted);
            status = push_callee(lowering, wanted, pending, error);
        }
    }
    return status;
}

/* Keeps a failure for the other callers, since it would only be found again. */
static tn_status keep_failure(tn_lowered *lowered, const tn_error *error)
{
    lowered->error = malloc(sizeof *lowered->error);
    if (lowered->error)
        *lowered->error = *error;
    return error->status;
}

/* A function that calls lower ones only, or pushes those that are not lowered yet. */
static tn_status lower_function(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    uint32_t form = wanted % FORM_COUNT;
    size_t before = pending->size;
    tn_postfix code;
    tn_status status = tn_postfix_read(lowering->module, wanted / FORM_COUNT, form & FORM_PLAIN, &code, error);
    if (status != TN_OK)
        return status;
    status = push_callees(lowering, &code, form, pending, error);
    if (status == TN_OK && pending->size == before)
        status = lower_code(lowering, &code, form, &lowering->lowered[wanted].dfa, error);
    tn_postfix_clear(&code);
    return status;
}

/* What takes too many states for plans of every length may take fewer for those that are asked about. */
static bool may_be_shorter(const tn_lowering *lowering, tn_status status)
{
    const tn_bounds *bounds = &lowering->bounds;
    return status == TN_LIMIT && lowering->max_trays > 0 && bounds->longest == 0 && bounds->work <= bounds->max_work;
}

/* Lowers a circle whose callees outside of it are lowered; a failure that stays is kept for all of its functions. */
static tn_status lower_circle(tn_lowering *lowering, tn_circle *circle, uint32_t form, tn_error *error)
{
    tn_lowering_code at = {lowering, form};
    const tn_circle_means means = {.module = lowering->module,
                                   .marked = &lowering->marked,
                                   .max_trays = lowering->max_trays,
                                   .reversed = form & FORM_REVERSED,
                                   .make = make_node,
                                   .left_out = is_left_out,
                                   .context = &at};
    tn_dfa **found = calloc(circle->count, sizeof(tn_dfa *));
    tn_status status = found ? tn_circle_lower(circle, &means, found, error) : tn_fail_memory(error);
    for (uint32_t i = 0; i < circle->count; i++) {
        tn_lowered *lowered = &lowering->lowered[circle->members[i] * FORM_COUNT + form];
        if (status == TN_OK)
            lowered->dfa = found[i];
        else if (i > 0 && !may_be_shorter(lowering, status)) /* of the first it is kept like that of other functions */
            keep_failure(lowered, error);
    }
    free(found);
    return status;
}

/* All functions of a circle, or pushes what they call outside of it. Of the plan as a whole: what its relation says. */
static tn_status lower_in_circle(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    uint32_t form = wanted % FORM_COUNT, relation = wanted & ~(uint32_t)FORM_PLAIN;
    size_t before = pending->size;
    tn_circle circle;
    if (form & FORM_PLAIN) {
        tn_status status = push_callee(lowering, relation, pending, error);
        return status != TN_OK || pending->size > before
                   ? status
                   : tn_marked_whole(&lowering->marked, lowering->lowered[relation].dfa, &lowering->lowered[wanted].dfa,
                                     error);
    }
    tn_status status = tn_circle_read(lowering->module, wanted / FORM_COUNT, &circle, error);
    for (uint32_t i = 0; status == TN_OK && i < circle.count; i++)
        status = push_callees(lowering, &circle.codes[i], form, pending, error);
    if (status == TN_OK && pending->size == before)
        status = lower_circle(lowering, &circle, form, error);
    tn_circle_clear(&circle);
    return status;
}

static tn_status lower_wanted(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    bool circle = lowering->module->FUNCTION_records[wanted / FORM_COUNT].kind == TN_FUNCTION_CIRCLE;
    return (circle ? lower_in_circle : lower_function)(lowering, wanted, pending, error);
}

/* The same, for plans that are no longer than asked about. */
static tn_status lower_within(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    lowering->bounds.longest = lowering->max_trays;
    tn_status status = lower_wanted(lowering, wanted, pending, error);
    lowering->bounds.longest = 0;
    return status;
}

/* Lowers the last pending function, or pushes what it needs first. */
static tn_status lower_pending(tn_lowering *lowering, tn_key *pending, tn_error *error)
{
    uint32_t wanted = pending->data[pending->size - 1];
    tn_lowered *lowered = &lowering->lowered[wanted];
    tn_error failure = {0};
    tn_status status = TN_OK;
    if (!lowered->dfa)
        status = lower_wanted(lowering, wanted, pending, &failure);
    if (may_be_shorter(lowering, status)) {
        failure = (tn_error){0};
        status = lower_within(lowering, wanted, pending, &failure);
    }
    if (lowered->dfa)
        pending->size--;
    if (status == TN_OK)
        return TN_OK;
    if (error)
        *error = failure;
    return keep_failure(lowered, &failure);
}

static tn_status too_much_work(const tn_lowering *lowering, uint32_t function, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
            "the automata of these rules take more than %llu steps to build together",
            (unsigned long long)lowering->bounds.max_work * RULES_WORK);
    tn_error_help(error, "split the rules over several files");
    if (error)
        error->code_offset = lowering->module->FUNCTION_records[function].code_begin;
    return TN_LIMIT;
}

/* Counts the work that was done before; each question has its own. */
static tn_status begin_work(tn_lowering *lowering, uint32_t function, tn_error *error)
{
    lowering->spent += lowering->bounds.work;
    lowering->bounds.work = 0;
    return lowering->spent > lowering->bounds.max_work * RULES_WORK ? too_much_work(lowering, function, error) : TN_OK;
}

static tn_status lower_form(tn_lowering *lowering, uint32_t function, uint32_t form, tn_dfa **out, tn_error *error)
{
    uint32_t wanted = function * FORM_COUNT + form;
    tn_lowered *lowered = &lowering->lowered[wanted];
    if (lowered->error) {
        if (error)
            *error = *lowered->error;
        return lowered->error->status;
    }
    tn_key pending = {0};
    tn_status status = begin_work(lowering, function, error);
    if (status == TN_OK && !tn_key_push(&pending, wanted))
        status = tn_fail_memory(error);
    while (status == TN_OK && pending.size > 0)
        status = lower_pending(lowering, &pending, error);
    free(pending.data);
    if (status != TN_OK)
        return status;
    *out = tn_dfa_share(lowered->dfa);
    return TN_OK;
}

tn_status tn_lower(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, FORM_PLAIN, out, error);
}

tn_status tn_lower_marked(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, 0, out, error);
}

tn_status tn_lower_reversed(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, FORM_PLAIN | FORM_REVERSED, out, error);
}

/* Lowers the nodes before the one at `offset`, and hands out what that one would take. */
static tn_status lower_until(tn_lowering *lowering, tn_postfix *code, uint32_t form, uint32_t offset, tn_dfa **parts,
                             size_t *count, tn_error *error)
{
    size_t at = 0;
    while (at < code->count && code->nodes[at].offset != offset)
        at++;
    if (at == code->count || (at > 0 && code->nodes[at - 1].plain)) /* at the plan's level operands are no relations */
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "an instruction that makes no relation");
    uint8_t pops = tn_code_effect((uint8_t)code->nodes[at].code.opcode).pops;
    code->count = at;
    tn_dfa *last = NULL;
    tn_status status = at > 0 ? lower_code(lowering, code, form, &last, error) : TN_OK;
    if (status != TN_OK)
        return status;
    for (size_t i = pops; i-- > 0; last = NULL)
        parts[i] = last ? last : code->stack[--code->depth];
    tn_dfa_free(last);
    *count = pops;
    return TN_OK;
}

/* The operands of the OR that a lowered function of a relation ends with; TN_LIMIT: it ends otherwise. */
static tn_status either_operand(tn_lowering *lowering, uint32_t function, uint32_t form, tn_dfa **parts, size_t *count,
                                tn_error *error)
{
    tn_postfix code;
    if (lowering->module->FUNCTION_records[function].kind == TN_FUNCTION_CIRCLE)
        return TN_LIMIT;
    tn_status status = tn_postfix_read(lowering->module, function, false, &code, error);
    if (status != TN_OK)
        return status;
    const tn_postfix_node *last = code.count > 0 ? &code.nodes[code.count - 1] : NULL;
    status = last && last->code.opcode == TN_OP_OR
                 ? lower_until(lowering, &code, form, last->offset, parts, count, error)
                 : TN_LIMIT;
    tn_postfix_clear(&code);
    return status;
}

tn_status tn_lower_operands(tn_lowering *lowering, uint32_t function, uint32_t offset, tn_dfa **parts, size_t *count,
                            tn_error *error)
{
    /* Where the whole function has been lowered, all that its instructions call has been too. */
    tn_function_kind kind = (tn_function_kind)lowering->module->FUNCTION_records[function].kind;
    uint32_t form = kind == TN_FUNCTION_HOLDS ? FORM_PLAIN : 0;
    tn_dfa *whole = NULL;
    *count = 0;
    tn_status status = lower_form(lowering, function, form, &whole, error);
    tn_dfa_free(whole);
    if (status != TN_OK)
        return status;
    tn_postfix code;
    status = tn_postfix_read(lowering->module, function, form, &code, error);
    if (status != TN_OK)
        return status;
    status = lower_until(lowering, &code, form, offset, parts, count, error);
    tn_postfix_clear(&code);
    return status;
}

tn_status tn_lower_term(tn_lowering *lowering, uint32_t function, uint32_t code_begin, uint32_t code_end, bool reversed,
                        tn_dfa **out, tn_error *error)
{
    uint32_t form = reversed ? FORM_REVERSED : 0;
    tn_key pending = {0};
    tn_postfix code = {0};
    tn_status status = begin_work(lowering, function, error);
    if (status == TN_OK)
        status = tn_postfix_read_range(lowering->module, code_begin, code_end,
                                       lowering->module->FUNCTION_records[function].stack_max, false, &code, error);
    if (status == TN_OK)
        status = push_callees(lowering, &code, form, &pending, error);
    while (status == TN_OK && pending.size > 0)
        status = lower_pending(lowering, &pending, error);
    if (status == TN_OK)
        status = lower_code(lowering, &code, form, out, error);
    tn_postfix_clear(&code);
    free(pending.data);
    return status;
}

const tn_marked *tn_lowering_marked(const tn_lowering *lowering)
{
    return &lowering->marked;
}

const tn_classes *tn_lowering_classes(const tn_lowering *lowering)
{
    return lowering->classes;
}
