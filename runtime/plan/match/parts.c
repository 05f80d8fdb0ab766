/* Reads a rule's tree of parts back from its code. */
#include "runtime/plan/match/parts.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"

/* Code is in postfix order: a part is made when its last instruction is read, of the parts on the stack. A child so has
 * a lower number than its parent until, at the end, all are numbered from the root. */
typedef struct reading {
    tn_parts *parts;
    const tn_module *module;
    uint32_t *stack; /* of the function at hand */
    uint32_t depth;
    size_t capacity;
    unsigned nesting; /* of functions */
    bool houses;      /* may be asked about */
    tn_error *error;
} reading;

static tn_status foreign(const reading *r, uint32_t offset)
{
    tn_status status = tn_fail(r->error, TN_INVALID, E_REFUSED_MODULE, "this is not what the compiler makes of a rule");
    if (r->error)
        r->error->code_offset = offset;
    return status;
}

static tn_status read_function(reading *r, uint32_t function);

uint32_t tn_function_rule(const tn_module *module, uint32_t function)
{
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (module->RULE_records[i].whole == function || module->RULE_records[i].holds == function)
            return i;
    return UINT32_MAX;
}

static tn_status push(reading *r, tn_part part)
{
    tn_parts *parts = r->parts;
    if (parts->count >= r->module->code_size)
        return foreign(r, part.root);
    if (!tn_array_reserve_from(&parts->parts, &parts->capacity, 32, parts->count, 1, sizeof *parts->parts) ||
        !tn_array_reserve_from(&r->stack, &r->capacity, 32, r->depth, 1, sizeof *r->stack))
        return tn_fail_memory(r->error);
    parts->parts[parts->count] = part;
    r->stack[r->depth++] = parts->count++;
    return TN_OK;
}

static tn_part leaf(tn_part_kind kind, uint32_t offset, uint32_t length)
{
    return (tn_part){.kind = kind,
                     .code_begin = offset,
                     .code_end = offset + length,
                     .root = offset,
                     .rule = UINT32_MAX,
                     .parent = TN_NO_PART,
                     .first = TN_NO_PART,
                     .next = TN_NO_PART};
}

static tn_part *top(const reading *r)
{
    return &r->parts->parts[r->stack[r->depth - 1]];
}

static void adopt(reading *r, uint32_t parent, uint32_t child)
{
    tn_part *parts = r->parts->parts;
    uint32_t *link = &parts[parent].first;
    while (*link != TN_NO_PART)
        link = &parts[*link].next;
    *link = child;
    parts[child].parent = parent;
    parts[parent].child_count++;
}

/* A new part of the last `count` ones on the stack, one to three. */
static tn_status wrap(reading *r, tn_part part, uint32_t count)
{
    uint32_t children[3] = {0};
    for (uint32_t i = count; i-- > 0;)
        children[i] = r->stack[--r->depth];
    part.code_begin = r->parts->parts[children[0]].code_begin;
    tn_status status = push(r, part);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        adopt(r, r->parts->count - 1, children[i]);
    return status;
}

static void extend(tn_part *part, uint32_t offset, uint32_t length)
{
    part->root = offset;
    part->code_end = offset + length;
}

/* Do two instructions come from the same stretch of a source (or is nothing known of them)? */
static bool same_place(const tn_module *module, uint32_t a, uint32_t b)
{
    const tn_source_map_record *x = tn_module_place(module, a), *y = tn_module_place(module, b);
    return !x || !y || (x->file == y->file && x->begin == y->begin && x->end == y->end);
}

/* Does the instruction go on with a comparison? `a <= b` is "not above", `in A..B` is two of them joined: the author
 * wrote all of it in one place. */
static bool goes_on(const reading *r, const tn_part *part, uint32_t offset)
{
    return part->kind == TN_PART_COMPARISON && !part->somewhere && tn_module_place(r->module, offset) &&
           same_place(r->module, part->root, offset);
}

/* A call and the mirrored call of the same function: symmetric. What it mirrors is a rule's, or a function of its own,
 * which nothing else calls: so there are never more parts than instructions. */
static tn_status read_symmetric(reading *r, uint32_t offset, uint32_t length)
{
    tn_part made = leaf(TN_PART_SYMMETRIC, offset, length);
    r->depth--; /* the mirrored half */
    r->parts->count--;
    tn_part call = *top(r);
    made.code_begin = call.code_begin;
    if (call.rule == UINT32_MAX) {
        r->depth--;
        r->parts->count--;
        tn_status status = read_function(r, call.function);
        if (status != TN_OK)
            return status;
    }
    uint32_t begin = made.code_begin;
    tn_status status = wrap(r, made, 1);
    if (status == TN_OK)
        top(r)->code_begin = begin;
    return status;
}

static tn_status read_joined(reading *r, tn_part_kind kind, uint32_t offset, uint32_t length)
{
    tn_part *second = top(r), *first = &r->parts->parts[r->stack[r->depth - 2]];
    if (kind == TN_PART_OR && second->kind == TN_PART_KIND_COUNT)
        return first->kind == TN_PART_RULE && first->function == second->function && !first->somewhere
                   ? read_symmetric(r, offset, length)
                   : foreign(r, offset);
    if (first->kind == TN_PART_KIND_COUNT || second->kind == TN_PART_KIND_COUNT)
        return foreign(r, offset);
    if (goes_on(r, second, offset) && same_place(r->module, first->root, offset)) {
        first->kind = TN_PART_COMPARISON;
        first->first = TN_NO_PART;
        first->child_count = 0;
        extend(first, offset, length);
        r->depth--;
        return TN_OK;
    }
    if (first->kind != kind || first->somewhere || !same_place(r->module, first->root, offset))
        return wrap(r, leaf(kind, offset, length), 2);
    extend(first, offset, length);
    uint32_t child = r->stack[--r->depth];
    adopt(r, r->stack[r->depth - 1], child);
    return TN_OK;
}

/* What stands at the plan's beginning or end, or somewhere, has all its parts. */
static bool may_go_on(const tn_part *neighbour)
{
    return !neighbour->somewhere && !neighbour->beginning && !neighbour->end;
}

/* CHAIN: the second neighbour, of one part, goes on the first. */
static tn_status read_chain(reading *r, uint32_t offset, uint32_t length)
{
    tn_part *second = top(r), *first = &r->parts->parts[r->stack[r->depth - 2]];
    if (first->kind != TN_PART_NEIGHBOUR || second->kind != TN_PART_NEIGHBOUR || second->child_count != 1 ||
        !may_go_on(first) || !may_go_on(second))
        return foreign(r, offset);
    extend(first, offset, length);
    uint32_t child = second->first;
    r->depth--;
    second->kind = TN_PART_KIND_COUNT; /* left out when all are numbered */
    adopt(r, r->stack[r->depth - 1], child);
    return TN_OK;
}

/* An instruction that says more of the neighbour on the stack. */
static tn_status read_more(reading *r, tn_opcode opcode, uint32_t offset, uint32_t length)
{
    tn_part *part = top(r);
    if (part->kind != TN_PART_NEIGHBOUR || part->somewhere ||
        (opcode == TN_OP_OPTIONAL && (part->child_count != 1 || !may_go_on(part))))
        return foreign(r, offset);
    extend(part, offset, length);
    if (opcode == TN_OP_OPTIONAL)
        r->parts->parts[part->first].optional = true;
    else if (opcode == TN_OP_BEGINNING)
        part->beginning = true;
    else
        part->end = true;
    return TN_OK;
}

static tn_status read_counted(reading *r, tn_part_kind kind, uint32_t offset, const tn_instruction *code)
{
    tn_part made = leaf(kind, offset, code->length);
    made.condition = (uint32_t)(kind == TN_PART_SUM ? code->second : code->first);
    made.field = kind == TN_PART_SUM ? (uint32_t)code->first : 0;
    return wrap(r, made, 1);
}

/* Is the call a case of a comparison, `max(X of a) <= K` or `matches(a) > 0`: of a function that is written in it? */
static bool is_case(const reading *r, uint32_t offset, const tn_instruction *code)
{
    const tn_function_record *callee = &r->module->FUNCTION_records[code->first];
    const tn_source_map_record *outer = tn_module_place(r->module, offset),
                               *inner = tn_module_place(r->module, callee->code_begin);
    return code->opcode == TN_OP_CALL && callee->kind == TN_FUNCTION_HOLDS &&
           tn_function_rule(r->module, (uint32_t)code->first) == UINT32_MAX && outer && inner &&
           outer->file == inner->file && outer->begin <= inner->begin && inner->end <= outer->end;
}

static tn_status read_call(reading *r, uint32_t offset, const tn_instruction *code)
{
    if (is_case(r, offset, code))
        return push(r, leaf(TN_PART_COMPARISON, offset, code->length));
    tn_part made = leaf(code->opcode == TN_OP_MIRROR ? TN_PART_KIND_COUNT : TN_PART_RULE, offset, code->length);
    made.function = (uint32_t)code->first;
    made.again = code->opcode == TN_OP_AGAIN;
    made.rule = tn_function_rule(r->module, made.function);
    return push(r, made);
}

static tn_status read_instruction(reading *r, uint32_t offset, const tn_instruction *code)
{
    tn_part made;
    if (r->houses && tn_code_asks_house(code->opcode))
        return push(r, leaf(TN_PART_HOUSE, offset, code->length));
    switch (code->opcode) {
    case TN_OP_TRAY:
        made = leaf(TN_PART_TRAY, offset, code->length);
        made.spec = (uint32_t)code->first;
        return push(r, made);
    case TN_OP_CALL:
    case TN_OP_MIRROR:
    case TN_OP_AGAIN:
        return read_call(r, offset, code);
    case TN_OP_AND:
        return read_joined(r, TN_PART_AND, offset, code->length);
    case TN_OP_OR:
        return read_joined(r, TN_PART_OR, offset, code->length);
    case TN_OP_NOT:
        if (goes_on(r, top(r), offset)) {
            extend(top(r), offset, code->length);
            return TN_OK;
        }
        return wrap(r, leaf(TN_PART_NOT, offset, code->length), 1);
    case TN_OP_SOMEWHERE:
        if (top(r)->somewhere)
            return foreign(r, offset);
        top(r)->somewhere = true;
        return TN_OK;
    case TN_OP_ONCE:
        extend(top(r), offset, code->length);
        top(r)->once = true;
        return TN_OK;
    case TN_OP_NONEMPTY:
        return wrap(r, leaf(TN_PART_NEIGHBOUR, offset, code->length), 1);
    case TN_OP_OPTIONAL:
    case TN_OP_BEGINNING:
    case TN_OP_END:
        return read_more(r, code->opcode, offset, code->length);
    case TN_OP_CHAIN:
        return read_chain(r, offset, code->length);
    case TN_OP_MANY:
        return wrap(r, leaf(TN_PART_MANY, offset, code->length), 1);
    case TN_OP_REPEATED:
        made = leaf(TN_PART_REPEAT, offset, code->length);
        made.least = (uint32_t)code->first;
        made.most = (uint32_t)code->second;
        return wrap(r, made, 1);
    case TN_OP_QUANTITY:
        return read_counted(r, TN_PART_QUANTITY, offset, code);
    case TN_OP_SUM:
        return read_counted(r, TN_PART_SUM, offset, code);
    case TN_OP_OCCURRENCES:
        return read_counted(r, TN_PART_OCCURRENCES, offset, code);
    case TN_OP_DISTANCE:
        return wrap(r, leaf(TN_PART_DISTANCE, offset, code->length), 3);
    case TN_OP_NEAR:
        return wrap(r, leaf(TN_PART_NEAR, offset, code->length), 3);
    case TN_OP_FAR:
        return wrap(r, leaf(TN_PART_FAR, offset, code->length), 3);
    case TN_OP_WHERE:
        return wrap(r, leaf(TN_PART_WHERE, offset, code->length), 2);
    case TN_OP_BELOW:
    case TN_OP_ZERO:
    case TN_OP_ABOVE:
    case TN_OP_MULTIPLE:
    case TN_OP_MIRRORED:
        return push(r, leaf(TN_PART_COMPARISON, offset, code->length));
    case TN_OP_IMAGE:
        return push(r, leaf(TN_PART_IMAGE, offset, code->length));
    default:
        return foreign(r, offset);
    }
}

static tn_status read_function(reading *r, uint32_t function)
{
    const tn_function_record *record = &r->module->FUNCTION_records[function];
    if (++r->nesting > TN_PARTS_DEPTH_MAX)
        return foreign(r, record->code_begin);
    uint32_t offset = record->code_begin;
    tn_status status = TN_OK;
    for (;;) {
        tn_instruction code = tn_code_read(r->module->code, offset);
        if (code.opcode == TN_OP_RETURN)
            break;
        status = read_instruction(r, offset, &code);
        if (status != TN_OK)
            return status;
        offset += code.length;
    }
    r->nesting--;
    return top(r)->kind == TN_PART_KIND_COUNT ? foreign(r, record->code_begin) : TN_OK;
}

/* Does a function H only call its own judgement M? A rule with parameters has no record: its two functions have one
 * name. */
static bool calls_own(const tn_module *module, uint32_t function, const tn_part *call)
{
    const tn_function_record *holds = &module->FUNCTION_records[function];
    uint32_t own = tn_function_rule(module, function);
    if (call->kind != TN_PART_RULE || call->rule != own)
        return false;
    const tn_function_record *whole = &module->FUNCTION_records[call->function];
    return own != UINT32_MAX ||
           (holds->kind == TN_FUNCTION_HOLDS && tn_function_is_whole(whole) && holds->name == whole->name);
}

/* The judgement H of a rule may be a call of its own judgement M: then that one's parts are the rule's. */
static tn_status read_rule(reading *r, uint32_t function)
{
    tn_status status = read_function(r, function);
    if (status != TN_OK)
        return status;
    tn_part call = *top(r);
    if (!calls_own(r->module, function, &call))
        return TN_OK;
    r->depth--;
    r->parts->count--;
    status = read_function(r, call.function);
    if (status == TN_OK)
        top(r)->somewhere = call.somewhere;
    return status;
}

/* Is a part something that an author can have written there? A mirrored call belongs to a symmetric; only `and`, `or`
 * and `not` ask for what is somewhere in the region. */
static bool belongs(const tn_part *part, const tn_part *parent)
{
    bool joined = !parent || parent->kind == TN_PART_AND || parent->kind == TN_PART_OR || parent->kind == TN_PART_NOT;
    return part->kind != TN_PART_KIND_COUNT && (joined || !part->somewhere);
}

/* Numbers the parts from the root, each before its children. */
static tn_status number(reading *r)
{
    tn_parts *parts = r->parts;
    tn_part *ordered = calloc((size_t)parts->count + 1, sizeof *ordered);
    uint32_t *old = malloc(((size_t)parts->count + 1) * sizeof *old), count = 1;
    unsigned *depth = calloc((size_t)parts->count + 1, sizeof *depth);
    tn_status status = ordered && old && depth ? TN_OK : tn_fail_memory(r->error);
    if (status == TN_OK) {
        old[0] = r->stack[0];
        ordered[0] = parts->parts[old[0]];
        ordered[0].parent = TN_NO_PART;
    }
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t *link = &ordered[i].first;
        if (!belongs(&ordered[i], i > 0 ? &ordered[ordered[i].parent] : NULL))
            status = foreign(r, ordered[i].root);
        for (uint32_t child = parts->parts[old[i]].first; child != TN_NO_PART; child = parts->parts[child].next) {
            ordered[count] = parts->parts[child];
            ordered[count].parent = i;
            depth[count] = depth[i] + 1;
            if (depth[count] > TN_PARTS_DEPTH_MAX)
                status = foreign(r, ordered[count].code_begin);
            old[count] = child;
            *link = count;
            link = &ordered[count++].next;
        }
        *link = TN_NO_PART;
    }
    free(old);
    free(depth);
    if (status != TN_OK) {
        free(ordered);
        return status;
    }
    free(parts->parts);
    parts->parts = ordered;
    parts->capacity = parts->count + 1;
    parts->count = count;
    return TN_OK;
}

static tn_status read_parts(const tn_module *module, uint32_t function, bool houses, tn_parts *parts, tn_error *error)
{
    *parts = (tn_parts){.module = module};
    reading r = {.parts = parts, .module = module, .houses = houses, .error = error};
    tn_status status = read_rule(&r, function);
    if (status == TN_OK)
        status = number(&r);
    free(r.stack);
    return status;
}

tn_status tn_parts_read(const tn_module *module, uint32_t function, tn_parts *parts, tn_error *error)
{
    return read_parts(module, function, false, parts, error);
}

tn_status tn_parts_read_house(const tn_module *module, uint32_t function, tn_parts *parts, tn_error *error)
{
    return read_parts(module, function, true, parts, error);
}

void tn_parts_clear(tn_parts *parts)
{
    free(parts->parts);
    *parts = (tn_parts){0};
}

/* ---- in words */

const char *tn_part_word(tn_part_kind kind)
{
    static const char *const words[TN_PART_KIND_COUNT] = {
        "tray", "rule",   "and",      "or",   "not", "neighbour", "symmetric",  "quantity", "sum",   "occurrences",
        "many", "repeat", "distance", "near", "far", "where",     "comparison", "onto",     "house",
    };
    return kind < TN_PART_KIND_COUNT ? words[kind] : "part";
}

/* How many of the `used` bytes stay when the text is cut before the byte `next`: none of a character that `next` goes
 * on with. */
static size_t whole_characters(const char *text, size_t used, char next)
{
    while (used > 0 && ((unsigned char)next & 0xc0) == 0x80)
        next = text[--used];
    return used;
}

/* Copies source text with comments left out and every run of blanks as one. */
static void copy_text(const char *from, size_t length, char *text, size_t size)
{
    size_t used = 0;
    bool blank = false, quoted = false;
    for (size_t i = 0; i < length; i++) {
        char c = from[i];
        quoted = c == '"' && !(i > 0 && from[i - 1] >= '0' && from[i - 1] <= '9' && !quoted) ? !quoted : quoted;
        if (c == '#' && !quoted)
            while (i + 1 < length && from[i + 1] != '\n')
                i++;
        if (c == ' ' || c == '\n' || c == '\t' || c == '\r' || (c == '#' && !quoted)) {
            blank = used > 0;
            continue;
        }
        if (used + 6 > size) {
            memcpy(text + whole_characters(text, used, c), "...", 4);
            return;
        }
        if (blank)
            text[used++] = ' ';
        blank = false;
        text[used++] = c;
    }
    text[used] = '\0';
}

/* Parentheses are in no part's place: where one at the edge is missing, the stretch grows to it. */
static void balance(const char *source, size_t length, size_t *begin, size_t *end)
{
    int open = 0, missing = 0;
    for (size_t i = *begin; i < *end; i++) {
        open += source[i] == '(';
        open -= source[i] == ')';
        missing = -open > missing ? -open : missing;
    }
    for (open += missing; missing > 0; missing--) {
        size_t at = *begin;
        while (at > 0 && (source[at - 1] == ' ' || source[at - 1] == '\n' || source[at - 1] == '\t'))
            at--;
        if (at == 0 || source[at - 1] != '(')
            return;
        *begin = at - 1;
    }
    for (; open > 0; open--) {
        size_t at = *end + strspn(source + *end, " \n\t");
        if (at >= length || source[at] != ')')
            return;
        *end = at + 1;
    }
}

void tn_part_text(const tn_parts *parts, uint32_t part, char *text, size_t size)
{
    const tn_module *module = parts->module;
    const tn_source_map_record *map = tn_module_place(module, parts->parts[part].root);
    if (map && map->file < module->SOURCE_count) {
        const char *source = tn_text(module, module->SOURCE_records[map->file].text);
        size_t length = strlen(source);
        if (map->begin < map->end && map->end <= length) {
            size_t begin = map->begin, end = map->end;
            balance(source, length, &begin, &end);
            copy_text(source + begin, end - begin, text, size);
            return;
        }
    }
    const char *word = tn_part_word(parts->parts[part].kind);
    if (parts->parts[part].kind == TN_PART_RULE && parts->parts[part].rule != UINT32_MAX)
        word = tn_text(module, module->RULE_records[parts->parts[part].rule].name);
    copy_text(word, strlen(word), text, size);
}

void tn_source_text(const tn_module *module, uint32_t file, uint32_t begin, uint32_t end, char *text, size_t size)
{
    const char *source = file < module->SOURCE_count ? tn_text(module, module->SOURCE_records[file].text) : "";
    text[0] = '\0';
    if (begin < end && end <= strlen(source))
        copy_text(source + begin, end - begin, text, size);
}

bool tn_part_is_step(const tn_parts *parts, uint32_t part)
{
    uint32_t parent = parts->parts[part].parent, root = parts->parts[part].root;
    return parent != TN_NO_PART && tn_module_place(parts->module, root) &&
           same_place(parts->module, root, parts->parts[parent].root);
}

bool tn_part_unwritten(const tn_parts *parts, uint32_t part)
{
    if (!tn_part_is_step(parts, part))
        return false;
    tn_part_kind above = parts->parts[parts->parts[part].parent].kind;
    return above == TN_PART_SUM || above == TN_PART_NEAR || above == TN_PART_FAR;
}

uint32_t tn_part_size(const tn_parts *parts, uint32_t part)
{
    uint32_t size = 0, at = part;
    do { /* walks the subtree without a stack: down, then on, then up and on */
        size += parts->parts[at].first == TN_NO_PART;
        if (parts->parts[at].first != TN_NO_PART) {
            at = parts->parts[at].first;
            continue;
        }
        while (at != part && parts->parts[at].next == TN_NO_PART)
            at = parts->parts[at].parent;
        if (at != part)
            at = parts->parts[at].next;
    } while (at != part);
    return size;
}
