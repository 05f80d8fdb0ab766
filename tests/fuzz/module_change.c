/* Chooses changes of modules: what is changed, where, and into what. */
#include "tests/fuzz/module_change.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"
#include "runtime/load.h"

typedef struct fuzz_dice {
    uint64_t seed, count;
} fuzz_dice;

static uint64_t roll(fuzz_dice *dice, uint64_t sides)
{
    return sides ? tn_random64(dice->seed, 0x6d6f64756c65u, dice->count++) % sides : 0;
}

/* ---- values */

/* A number: within the bounds, at them, beyond them, or near what it was. */
static int64_t another_whole(fuzz_dice *dice, int64_t was, int64_t low, int64_t high)
{
    static const int64_t some[] = {0,   1,         2,         3,          63,        64,        65, 255,
                                   256, INT32_MAX, INT32_MIN, UINT32_MAX, INT64_MAX, INT64_MIN, -1, 1000000};
    uint64_t span = (uint64_t)high - (uint64_t)low;
    switch (roll(dice, 8)) {
    case 0:
        return low;
    case 1:
        return high;
    case 2:
        return (int64_t)((uint64_t)was + 1);
    case 3:
        return (int64_t)((uint64_t)was - 1);
    case 4:
        return some[roll(dice, sizeof some / sizeof *some)];
    case 5:
        return (int64_t)((uint64_t)was ^ (UINT64_C(1) << roll(dice, 64)));
    default: /* mostly small ones: large numbers only make engines give up */
        return (int64_t)((uint64_t)low + roll(dice, span < 12 ? span + 1 : 12));
    }
}

static double another_real(fuzz_dice *dice, double was, double least, double most)
{
    static const double some[] = {0,       -0.0,    1,    -1,    0.5, 2,   1e-300, 1e300,
                                  DBL_MIN, DBL_MAX, 1e12, -1e12, 90,  180, 360,    1e-9};
    switch (roll(dice, 8)) {
    case 0:
        return least;
    case 1:
        return most;
    case 2:
        return -was;
    case 3:
        return was * 2;
    case 4:
        return was / 3;
    case 5:
        return nextafter(was, roll(dice, 2) ? DBL_MAX : -DBL_MAX);
    case 6:
        return some[roll(dice, sizeof some / sizeof *some)];
    default:
        return (double)(int64_t)roll(dice, 21) - 10;
    }
}

/* A text that is there, one with something put in, or one that other notations stumble over. */
static int64_t another_text(draft *d, fuzz_dice *dice, int64_t was)
{
    static const char *const some[] = {
        "",         "-",     "a",   "'",    "\\",      "\"", "<b>&", "%s%n", "a b",          "\xc3\xa9",
        "\x1b[31m", "0",     "12'", "]]>",  "\n",      ":-", "A",    "_",    "[]",           "{}",
        "=cmd",     "Edge0", "<x>", "tray", "fill:4'", ",",  "|",    "../x", "\xe2\x80\xae", "total",
    };
    const char *text = draft_text(d, was);
    size_t size = strlen(text), at = size ? (size_t)roll(dice, size + 1) : 0;
    const char *piece = some[roll(dice, sizeof some / sizeof *some)];
    if (roll(dice, 4) == 0)
        return draft_add_text(d, piece, strlen(piece));
    if (roll(dice, 32) == 0) /* as long as a name may be */
        size = size > 0 ? 255 : 0;
    size_t room = strlen(piece) + (size > strlen(text) ? size : strlen(text));
    char *made = malloc(room + 1);
    if (!made)
        return was;
    size_t used = 0;
    while (used < at) {
        made[used] = text[used];
        used++;
    }
    while (*piece)
        made[used++] = *piece++;
    for (const char *rest = text + at; *rest && used < room; rest++)
        made[used++] = *rest;
    while (used < size)
        made[used++] = 'x';
    tn_string added = draft_add_text(d, made, used);
    free(made);
    return added;
}

static int64_t another_index(const draft *d, fuzz_dice *dice, tn_section section)
{
    return (int64_t)roll(dice, d->tables[section].count);
}

/* ---- fields */

static bool choose_record(const draft *d, fuzz_dice *dice, tn_section *section, size_t *index)
{
    for (int tries = 0; tries < 64; tries++) {
        *section = (tn_section)roll(dice, TN_SECTION_COUNT);
        if (d->tables[*section].count == 0)
            continue;
        *index = (size_t)roll(dice, d->tables[*section].count);
        return true;
    }
    return false;
}

static void change_bits(const draft *d, fuzz_dice *dice, tn_section section, char *record, const tn_member *member)
{
    uint64_t was = (uint64_t)tn_member_whole(record, member);
    size_t other = (size_t)another_index(d, dice, section);
    uint64_t bits = (uint64_t)tn_member_whole(draft_record(d, section, other), member);
    switch (roll(dice, 6)) {
    case 0:
        bits = 0;
        break;
    case 1:
        bits |= was;
        break;
    case 2:
        bits &= was;
        break;
    case 3: /* all that any of them has */
        for (size_t i = 0; i < d->tables[section].count; i++)
            bits |= (uint64_t)tn_member_whole(draft_record(d, section, i), member);
        break;
    default:
        bits = was ^ UINT64_C(1) << roll(dice, 16);
        break;
    }
    draft_set_whole(record, member, (int64_t)bits);
}

/* Moves the border between a run and the next record's. */
static void move_border(const draft *d, fuzz_dice *dice, tn_section section, size_t index, const tn_member *run)
{
    if (index + 1 >= d->tables[section].count)
        return;
    char *record = draft_record(d, section, index), *next = draft_record(d, section, index + 1);
    int64_t by = roll(dice, 2) ? 1 : -1;
    draft_set_whole(record, run + 1, tn_member_whole(record, run + 1) + by);
    draft_set_whole(next, run, tn_member_whole(next, run) + by);
    draft_set_whole(next, run + 1, tn_member_whole(next, run + 1) - by);
}

static void change_slice(const draft *d, fuzz_dice *dice, char *record, const tn_member *slice)
{
    int64_t count = (int64_t)d->tables[slice->section].count, first = (int64_t)roll(dice, (uint64_t)count + 1);
    draft_set_whole(record, slice, first);
    draft_set_whole(record, slice + 1, (int64_t)roll(dice, (uint64_t)(count - first) + 1));
}

static void change_member(draft *d, fuzz_dice *dice, tn_section section, size_t index, const tn_member *member)
{
    char *record = draft_record(d, section, index);
    switch (member->kind) {
    case TN_MEMBER_TEXT:
        draft_set_whole(record, member, another_text(d, dice, tn_member_whole(record, member)));
        break;
    case TN_MEMBER_REAL:
        draft_set_real(record, member, another_real(dice, tn_member_real(record, member), member->least, member->most));
        break;
    case TN_MEMBER_BITS:
        change_bits(d, dice, section, record, member);
        break;
    case TN_MEMBER_FLAGS:
        draft_set_whole(record, member, (int64_t)roll(dice, (uint64_t)member->high + 1));
        break;
    case TN_MEMBER_REF:
        draft_set_whole(record, member, another_index(d, dice, member->section));
        break;
    case TN_MEMBER_REF_OR_NONE:
    case TN_MEMBER_REF_AT_TIMES:
        draft_set_whole(record, member, roll(dice, 3) ? another_index(d, dice, member->section) : TN_NO_RECORD);
        break;
    case TN_MEMBER_RUN:
        move_border(d, dice, section, index, member);
        break;
    case TN_MEMBER_SLICE:
        change_slice(d, dice, record, member);
        break;
    case TN_MEMBER_COUNT:
    case TN_MEMBER_CODE:
    case TN_MEMBER_CODE_END:
        break; /* with what they belong to */
    case TN_MEMBER_WHOLE:
    case TN_MEMBER_FILE:
    case TN_MEMBER_BEGIN:
    case TN_MEMBER_END:
        d->keep_stack = roll(dice, 4) == 0;
        draft_set_whole(record, member,
                        another_whole(dice, tn_member_whole(record, member), member->low, member->high));
        break;
    }
}

static void change_field(draft *d, fuzz_dice *dice)
{
    tn_section section;
    size_t index;
    if (!choose_record(d, dice, &section, &index))
        return;
    tn_members members = d->tables[section].info.members;
    change_member(d, dice, section, index, &members.items[roll(dice, members.count)]);
}

/* A field becomes what it is in another record. */
static void copy_field(draft *d, fuzz_dice *dice)
{
    tn_section section;
    size_t index;
    if (!choose_record(d, dice, &section, &index))
        return;
    tn_members members = d->tables[section].info.members;
    const tn_member *member = &members.items[roll(dice, members.count)];
    const char *from = draft_record(d, section, (size_t)another_index(d, dice, section));
    if (member->kind == TN_MEMBER_REAL)
        draft_set_real(draft_record(d, section, index), member, tn_member_real(from, member));
    else if (member->kind < TN_MEMBER_RUN)
        draft_set_whole(draft_record(d, section, index), member, tn_member_whole(from, member));
}

/* ---- records */

static void remove_record(draft *d, fuzz_dice *dice)
{
    tn_section section;
    size_t index;
    if (choose_record(d, dice, &section, &index))
        draft_remove(d, section, index);
}

/* The copy gets a name of its own. */
static void double_record(draft *d, fuzz_dice *dice)
{
    tn_section section;
    size_t index;
    if (!choose_record(d, dice, &section, &index))
        return;
    draft_double(d, section, index);
    if (d->failed)
        return;
    tn_members members = d->tables[section].info.members;
    for (size_t i = 0; i < members.count && i < 2; i++) {
        char *copy = draft_record(d, section, index + 1);
        if (members.items[i].kind == TN_MEMBER_TEXT)
            draft_set_whole(copy, &members.items[i], another_text(d, dice, tn_member_whole(copy, &members.items[i])));
    }
}

static void empty_section(draft *d, fuzz_dice *dice)
{
    tn_section section;
    size_t index;
    if (!choose_record(d, dice, &section, &index))
        return;
    while (d->tables[section].count > 0)
        draft_remove(d, section, d->tables[section].count - 1);
}

/* ---- code */

/* Some record's code, with at least one instruction. */
static draft_code *choose_code(const draft *d, fuzz_dice *dice)
{
    size_t all = 0;
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        all += d->tables[i].has_code ? d->tables[i].count : 0;
    if (all == 0)
        return NULL;
    size_t chosen = (size_t)roll(dice, all);
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        if (!d->tables[i].has_code)
            continue;
        if (chosen < d->tables[i].count)
            return d->tables[i].code[chosen].count > 0 ? &d->tables[i].code[chosen] : NULL;
        chosen -= d->tables[i].count;
    }
    return NULL;
}

/* Another opcode of the same code; `alike`: with the same operands and effect on the stack. */
static uint8_t another_opcode(fuzz_dice *dice, uint8_t was, bool alike)
{
    const tn_opcode_info *info = tn_opcode_describe(was);
    for (int tries = 0; tries < 200; tries++) {
        uint8_t opcode = (uint8_t)roll(dice, TN_OPCODE_COUNT);
        const tn_opcode_info *other = tn_opcode_describe(opcode);
        if (!other) /* a number that no row has */
            continue;
        bool fits = other->operands == info->operands && other->pops == info->pops && other->pushes == info->pushes;
        if (opcode != was && other->code == info->code && (fits || !alike))
            return opcode;
    }
    return was;
}

static int64_t another_operand(draft *d, fuzz_dice *dice, const tn_slot *slot, int64_t was)
{
    switch (slot->kind) {
    case TN_SLOT_INDEX:
        return roll(dice, 3) ? another_index(d, dice, slot->section) : (int64_t)roll(dice, (uint64_t)was + 1);
    case TN_SLOT_STRING:
        return another_text(d, dice, was);
    case TN_SLOT_F64:
        return (int64_t)tn_bits_of(another_real(dice, tn_double_of((uint64_t)was), -DBL_MAX, DBL_MAX));
    case TN_SLOT_U32:
        return another_whole(dice, was, 0, 8);
    case TN_SLOT_I64:
        return another_whole(dice, was, 0, 8);
    case TN_SLOT_NOTHING:
        break;
    }
    return was;
}

static void change_opcode(draft *d, fuzz_dice *dice)
{
    draft_code *code = choose_code(d, dice);
    if (!code)
        return;
    draft_instruction *instruction = &code->items[roll(dice, code->count)];
    instruction->opcode = another_opcode(dice, instruction->opcode, roll(dice, 4) > 0);
}

static void change_operand(draft *d, fuzz_dice *dice)
{
    draft_code *code = choose_code(d, dice);
    if (!code)
        return;
    draft_instruction *instruction = &code->items[roll(dice, code->count)];
    const tn_slot *slots = tn_operand_slots[tn_code_operands(instruction->opcode)];
    instruction->first = another_operand(d, dice, &slots[0], instruction->first);
    instruction->second = another_operand(d, dice, &slots[1], instruction->second);
}

/* Where the term begins whose last instruction is at `end`; SIZE_MAX where that ends none. */
static size_t term_begin(const draft_code *code, size_t end)
{
    int64_t wanted = 1;
    for (size_t i = end + 1; i-- > 0;) {
        tn_opcode_effect effect = tn_code_effect(code->items[i].opcode);
        if (effect.pushes != 1)
            return SIZE_MAX;
        wanted += effect.pops - 1;
        if (wanted == 0)
            return i;
    }
    return SIZE_MAX;
}

/* An instruction of one operand and one result behind another, made of one that does so in this code. */
static void wrap_term(draft *d, fuzz_dice *dice)
{
    draft_code *code = choose_code(d, dice);
    if (!code)
        return;
    size_t at = (size_t)roll(dice, code->count);
    draft_instruction made = {
        .opcode = code->items[at].opcode, .mapped = code->items[at].mapped, .place = code->items[at].place};
    for (int tries = 0; tries < 20; tries++) {
        made.opcode = another_opcode(dice, code->items[at].opcode, false);
        tn_opcode_effect effect = tn_code_effect(made.opcode);
        if (effect.pops == effect.pushes)
            break;
    }
    const tn_slot *slots = tn_operand_slots[tn_code_operands(made.opcode)];
    made.first = another_operand(d, dice, &slots[0], 0);
    made.second = another_operand(d, dice, &slots[1], 0);
    draft_insert_code(d, code, at + roll(dice, 2), made);
}

static void remove_instruction(draft *d, fuzz_dice *dice)
{
    draft_code *code = choose_code(d, dice);
    if (!code)
        return;
    size_t at = (size_t)roll(dice, code->count);
    for (int tries = 0; tries < 20; tries++, at = (size_t)roll(dice, code->count)) {
        tn_opcode_effect effect = tn_code_effect(code->items[at].opcode);
        if (effect.pops == effect.pushes)
            break;
    }
    draft_remove_code(code, at);
}

/* A term becomes one of another place, of the same code, or is put behind it and joined to it by an instruction. */
static void replace_term(draft *d, fuzz_dice *dice)
{
    draft_code *to = choose_code(d, dice), *from = choose_code(d, dice);
    if (!to || !from)
        return;
    size_t end = (size_t)roll(dice, to->count), other = (size_t)roll(dice, from->count);
    size_t begin = term_begin(to, end), first = term_begin(from, other);
    if (begin == SIZE_MAX || first == SIZE_MAX || other - first > 30 ||
        tn_opcode_describe(to->items[end].opcode)->code != tn_opcode_describe(from->items[other].opcode)->code)
        return;
    draft_instruction term[32];
    size_t count = other - first + 1;
    memcpy(term, &from->items[first], count * sizeof *term);
    if (roll(dice, 2)) {
        while (end + 1 > begin)
            draft_remove_code(to, end--);
        end = begin;
    } else {
        end++;
        for (int tries = 0; tries < 60; tries++) {
            term[count] = (draft_instruction){.opcode = another_opcode(dice, term[0].opcode, false)};
            if (tn_code_effect(term[count].opcode).pops == 2)
                break;
        }
        count++;
    }
    for (size_t i = 0; i < count && !d->failed; i++)
        draft_insert_code(d, to, end + i, term[i]);
}

/* ---- choosing */

void change_draft(draft *d, uint64_t seed)
{
    typedef void change(draft *, fuzz_dice *);
    static change *const changes[] = {change_field,   change_field,  change_field,  copy_field,         remove_record,
                                      double_record,  empty_section, change_opcode, change_opcode,      change_operand,
                                      change_operand, wrap_term,     wrap_term,     remove_instruction, replace_term,
                                      replace_term,   replace_term};
    fuzz_dice dice = {.seed = seed};
    changes[roll(&dice, sizeof changes / sizeof *changes)](d, &dice);
}

static bool change_once(const tn_module *module, uint64_t seed, size_t most, uint8_t **bytes, size_t *size)
{
    draft d;
    uint64_t times = 1 + tn_random64(seed, 1, 0) % 4;
    bool written = draft_read(module, &d);
    for (uint64_t i = 0; i < times && written && !d.failed; i++)
        change_draft(&d, tn_random64(seed, 2, i));
    written = written && draft_write(&d, bytes, size);
    draft_clear(&d);
    if (written && *size > most) {
        free(*bytes);
        written = false;
    }
    return written;
}

/* Most changes lead to modules that are refused: it tries again, so that engines get to see many. */
bool change_module(const uint8_t *data, size_t size, uint64_t seed, size_t most, uint8_t **bytes, size_t *bytes_size)
{
    tn_module *module, *changed;
    if (tn_module_load(data, size, NULL, &module, NULL) != TN_OK)
        return false;
    bool written = false;
    for (uint64_t tries = 0; tries < 12 && !written; tries++) {
        written = change_once(module, tn_random64(seed, 3, tries), most, bytes, bytes_size);
        if (written && tn_module_load(*bytes, *bytes_size, NULL, &changed, NULL) == TN_OK)
            tn_module_free(changed);
        else if (written) {
            free(*bytes);
            written = false;
        }
    }
    tn_module_free(module);
    return written;
}
