/* Takes a module apart, keeps what refers to what right while it is changed, and writes it back. */
#include "tests/fuzz/module_draft.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/builder.h"

void draft_set_whole(void *record, const tn_member *member, int64_t value)
{
    uint32_t small = (uint32_t)value;
    if (member->storage == TN_STORAGE_U32)
        memcpy((char *)record + member->at, &small, sizeof small);
    else
        memcpy((char *)record + member->at, &value, sizeof value);
}

void draft_set_real(void *record, const tn_member *member, double value)
{
    memcpy((char *)record + member->at, &value, sizeof value);
}

/* ---- reading */

static bool reserve(draft *d, void **items, size_t *capacity, size_t count, size_t size)
{
    if (count <= *capacity)
        return true;
    size_t more = count * 2 + 8;
    void *larger = realloc(*items, more * size);
    if (!larger) {
        d->failed = true;
        return false;
    }
    *items = larger;
    *capacity = more;
    return true;
}

static const tn_member *member_of_kind(const draft_table *table, tn_member_kind kind)
{
    for (size_t i = 0; i < table->info.members.count; i++)
        if (table->info.members.items[i].kind == kind)
            return &table->info.members.items[i];
    return NULL;
}

static void append_code(draft *d, draft_code *code, const draft_instruction *instruction)
{
    if (!reserve(d, (void **)&code->items, &code->capacity, code->count + 1, sizeof *code->items))
        return;
    code->items[code->count++] = *instruction;
}

static bool is_body(uint8_t opcode)
{
    return tn_code_operands(opcode) == TN_OPERANDS_BODY;
}

/* Bodies are stored by their bytes, and here by their instructions. */
static void count_bodies(draft_code *code)
{
    for (size_t i = 0; i < code->count; i++) {
        if (!is_body(code->items[i].opcode))
            continue;
        int64_t bytes = code->items[i].first, count = 0;
        for (size_t k = i + 1; k < code->count && bytes > 0; k++, count++)
            bytes -= tn_opcode_describe(code->items[k].opcode)->length;
        code->items[i].first = count;
    }
}

static void read_code(draft *d, draft_code *code, uint32_t begin, uint32_t end)
{
    size_t map = 0;
    while (map < d->module->SOURCE_MAP_count && d->module->SOURCE_MAP_records[map].offset < begin)
        map++;
    for (uint32_t at = begin; at < end;) {
        tn_instruction read = tn_code_read(d->module->code, at);
        draft_instruction instruction = {.opcode = (uint8_t)read.opcode, .first = read.first, .second = read.second};
        if (map < d->module->SOURCE_MAP_count && d->module->SOURCE_MAP_records[map].offset == at) {
            instruction.mapped = true;
            instruction.place = d->module->SOURCE_MAP_records[map++];
        }
        append_code(d, code, &instruction);
        at += read.length;
    }
    count_bodies(code);
}

static void read_table(draft *d, tn_section section)
{
    draft_table *table = &d->tables[section];
    const tn_table *from = &d->module->tables[section];
    table->info = tn_section_describe(section);
    if (table->info.members.count == 0 || section == TN_SECTION_SOURCE_MAP)
        return;
    const tn_member *code = member_of_kind(table, TN_MEMBER_CODE);
    table->has_code = code != NULL;
    table->capacity = from->count;
    table->records = malloc(from->count * table->info.size + 1);
    table->code = calloc(from->count + 1, sizeof *table->code);
    if (!table->records || !table->code) {
        d->failed = true;
        return;
    }
    table->count = from->count;
    if (from->count > 0)
        memcpy(table->records, from->records, from->count * table->info.size);
    for (size_t i = 0; code && i < table->count; i++) {
        const char *record = draft_record(d, section, i);
        read_code(d, &table->code[i], (uint32_t)tn_member_whole(record, code),
                  (uint32_t)tn_member_whole(record, code + 1));
    }
}

bool draft_read(const tn_module *module, draft *d)
{
    *d = (draft){.module = module};
    d->strings = malloc(module->strings_size + 1);
    if (!d->strings)
        return false;
    d->strings[0] = '\0';
    d->strings_size = module->strings_size ? module->strings_size : 1;
    if (module->strings_size > 0)
        memcpy(d->strings, module->strings, module->strings_size);
    for (tn_section i = 0; i < TN_SECTION_COUNT && !d->failed; i++)
        read_table(d, i);
    return !d->failed;
}

void draft_clear(draft *d)
{
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        for (size_t k = 0; k < d->tables[i].count; k++)
            free(d->tables[i].code[k].items);
        free(d->tables[i].code);
        free(d->tables[i].records);
    }
    free(d->strings);
    *d = (draft){0};
}

tn_string draft_add_text(draft *d, const char *text, size_t size)
{
    size_t at = d->strings_size;
    char *larger = realloc(d->strings, at + size + 1);
    if (!larger) {
        d->failed = true;
        return 0;
    }
    d->strings = larger;
    memcpy(larger + at, text, size);
    larger[at + size] = '\0';
    d->strings_size = at + size + 1;
    return (tn_string)at;
}

/* ---- records that move */

/* What happens to the records of a section: one is there more, or less, at `index`; of a copy, it is the copy's. */
typedef struct shift {
    tn_section section;
    int64_t index;
    bool removed;
} shift;

/* A reference to a record that moved, or is gone: then to one beside it. */
static int64_t shifted(const shift *s, int64_t reference, int64_t left)
{
    if (!s->removed)
        return reference < s->index ? reference : reference + 1;
    reference -= reference > s->index;
    return left > 0 && reference >= left ? left - 1 : reference;
}

static void shift_member(const shift *s, char *record, const tn_member *member, int64_t left)
{
    int64_t value = tn_member_whole(record, member);
    if (member->kind != TN_MEMBER_RUN && member->kind != TN_MEMBER_SLICE) {
        if (value != TN_NO_RECORD)
            draft_set_whole(record, member, shifted(s, value, left));
        return;
    }
    int64_t count = tn_member_whole(record, member + 1);
    /* the copy of a run's last record is the run's too */
    bool inside =
        s->removed ? value <= s->index && s->index < value + count : value < s->index && s->index <= value + count;
    if (inside)
        draft_set_whole(record, member + 1, count + (s->removed ? -1 : 1));
    else if (value >= s->index && (!s->removed || value > s->index))
        draft_set_whole(record, member, value + (s->removed ? -1 : 1));
}

static void shift_code(const shift *s, draft_code *code, int64_t left)
{
    for (size_t i = 0; i < code->count; i++) {
        const tn_slot *slots = tn_operand_slots[tn_code_operands(code->items[i].opcode)];
        if (slots[0].kind == TN_SLOT_INDEX && slots[0].section == s->section)
            code->items[i].first = shifted(s, code->items[i].first, left);
        if (slots[1].kind == TN_SLOT_INDEX && slots[1].section == s->section)
            code->items[i].second = shifted(s, code->items[i].second, left);
    }
}

static bool refers(const tn_member *member, tn_section section)
{
    switch (member->kind) {
    case TN_MEMBER_REF:
    case TN_MEMBER_REF_OR_NONE:
    case TN_MEMBER_REF_AT_TIMES:
    case TN_MEMBER_RUN:
    case TN_MEMBER_SLICE:
    case TN_MEMBER_FILE:
        return member->section == section;
    default:
        return false;
    }
}

static void shift_all(draft *d, const shift *s)
{
    int64_t left = (int64_t)d->tables[s->section].count;
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        draft_table *table = &d->tables[i];
        for (size_t k = 0; k < table->count; k++) {
            char *record = draft_record(d, i, k);
            for (size_t m = 0; m < table->info.members.count; m++)
                if (refers(&table->info.members.items[m], s->section))
                    shift_member(s, record, &table->info.members.items[m], left);
            shift_code(s, &table->code[k], left);
        }
    }
}

/* ---- removing and doubling */

static void remove_alone(draft *d, tn_section section, size_t index)
{
    draft_table *table = &d->tables[section];
    free(table->code[index].items);
    table->count--;
    memmove(draft_record(d, section, index), draft_record(d, section, index + 1),
            (table->count - index) * table->info.size);
    memmove(&table->code[index], &table->code[index + 1], (table->count - index) * sizeof *table->code);
    shift_all(d, &(shift){section, (int64_t)index, true});
}

void draft_remove(draft *d, tn_section section, size_t index)
{
    if (index >= d->tables[section].count)
        return; /* a change before this one made a run too long */
    tn_members members = d->tables[section].info.members;
    for (size_t m = 0; m < members.count; m++) {
        if (members.items[m].kind != TN_MEMBER_RUN)
            continue;
        int64_t first = tn_member_whole(draft_record(d, section, index), &members.items[m]);
        int64_t count = tn_member_whole(draft_record(d, section, index), &members.items[m] + 1);
        while (count-- > 0)
            draft_remove(d, members.items[m].section, (size_t)(first + count));
    }
    remove_alone(d, section, index);
}

static bool make_room(draft *d, tn_section section)
{
    draft_table *table = &d->tables[section];
    if (table->count < table->capacity)
        return true;
    size_t capacity = table->capacity * 2 + 8;
    char *records = realloc(table->records, capacity * table->info.size);
    if (records)
        table->records = records;
    draft_code *code = records ? realloc(table->code, (capacity + 1) * sizeof *code) : NULL;
    if (code)
        table->code = code;
    if (!code) {
        d->failed = true;
        return false;
    }
    table->capacity = capacity;
    return true;
}

/* Puts a copy of a record before the record `at`. */
static void insert_copy(draft *d, tn_section section, size_t from, size_t at)
{
    draft_table *table = &d->tables[section];
    draft_code code = {0};
    if (!make_room(d, section))
        return;
    char *copy = malloc(table->info.size);
    if (!copy) {
        d->failed = true;
        return;
    }
    memcpy(copy, draft_record(d, section, from), table->info.size);
    for (size_t i = 0; i < table->code[from].count; i++)
        append_code(d, &code, &table->code[from].items[i]);
    memmove(draft_record(d, section, at + 1), draft_record(d, section, at), (table->count - at) * table->info.size);
    memmove(&table->code[at + 1], &table->code[at], (table->count - at) * sizeof *table->code);
    table->count++;
    memcpy(draft_record(d, section, at), copy, table->info.size);
    table->code[at] = code;
    free(copy);
    shift_all(d, &(shift){section, (int64_t)at, false});
}

/* A copy's runs lie behind those of the record before it, and hold copies of what the original's hold. */
static void copy_runs(draft *d, tn_section section, size_t from, size_t to)
{
    tn_members members = d->tables[section].info.members;
    for (size_t m = 0; m < members.count && !d->failed; m++) {
        const tn_member *run = &members.items[m];
        if (run->kind != TN_MEMBER_RUN)
            continue;
        int64_t first = tn_member_whole(draft_record(d, section, from), run);
        int64_t count = tn_member_whole(draft_record(d, section, from), run + 1);
        int64_t before = tn_member_whole(draft_record(d, section, to - 1), run);
        int64_t length = tn_member_whole(draft_record(d, section, to - 1), run + 1);
        for (int64_t i = 0; i <= count && !d->failed; i++) {
            /* what was put there made the run before it larger */
            draft_set_whole(draft_record(d, section, to - 1), run, before);
            draft_set_whole(draft_record(d, section, to - 1), run + 1, length);
            draft_set_whole(draft_record(d, section, to), run, before + length);
            draft_set_whole(draft_record(d, section, to), run + 1, i);
            if (i == count)
                break;
            size_t child = (size_t)(first + i), at = (size_t)(before + length + i);
            if (child >= d->tables[run->section].count || at > d->tables[run->section].count || at == 0)
                return; /* likewise */
            insert_copy(d, run->section, child, at);
            if (!d->failed)
                copy_runs(d, run->section, child, at);
        }
    }
}

void draft_double(draft *d, tn_section section, size_t index)
{
    insert_copy(d, section, index, index + 1);
    if (!d->failed)
        copy_runs(d, section, index, index + 1);
}

void draft_insert_code(draft *d, draft_code *code, size_t at, draft_instruction instruction)
{
    append_code(d, code, &instruction);
    if (d->failed)
        return;
    memmove(&code->items[at + 1], &code->items[at], (code->count - 1 - at) * sizeof *code->items);
    code->items[at] = instruction;
    for (size_t i = 0; i < at; i++)
        if (is_body(code->items[i].opcode) && i + (uint64_t)code->items[i].first >= at)
            code->items[i].first++;
}

void draft_remove_code(draft_code *code, size_t at)
{
    for (size_t i = 0; i < at; i++)
        if (is_body(code->items[i].opcode) && i + (uint64_t)code->items[i].first >= at)
            code->items[i].first--;
    code->count--;
    memmove(&code->items[at], &code->items[at + 1], (code->count - at) * sizeof *code->items);
}

/* ---- writing */

static int64_t rewrite_operand(const draft *d, tn_builder *builder, const tn_slot *slot, int64_t value)
{
    return slot->kind == TN_SLOT_STRING ? (int64_t)tn_builder_string(builder, draft_text(d, value)) : value;
}

static uint64_t body_bytes(const draft_code *code, size_t at)
{
    uint64_t bytes = 0;
    for (size_t i = at + 1; i < code->count && i - at <= (uint64_t)code->items[at].first; i++)
        bytes += tn_opcode_describe(code->items[i].opcode)->length;
    return bytes;
}

static void write_instruction(const draft *d, tn_builder *builder, const draft_code *code, size_t at)
{
    const draft_instruction *instruction = &code->items[at];
    const tn_slot *slots = tn_operand_slots[tn_code_operands(instruction->opcode)];
    int64_t first = rewrite_operand(d, builder, &slots[0], instruction->first);
    int64_t second = rewrite_operand(d, builder, &slots[1], instruction->second);
    if (is_body(instruction->opcode))
        first = (int64_t)body_bytes(code, at);
    uint32_t offset = tn_builder_emit(builder, (tn_opcode)instruction->opcode, first, second);
    tn_source_map_record place = instruction->place;
    place.offset = offset;
    if (instruction->mapped)
        tn_builder_add_SOURCE_MAP(builder, &place);
}

/* Writes the code and returns how deep its stack gets. */
static uint32_t write_code(const draft *d, tn_builder *builder, const draft_code *code)
{
    int64_t depth = 0, most = 0;
    for (size_t i = 0; i < code->count; i++) {
        tn_opcode_effect effect = tn_code_effect(code->items[i].opcode);
        depth += effect.pushes - effect.pops;
        most = depth > most ? depth : most;
        write_instruction(d, builder, code, i);
    }
    return (uint32_t)most;
}

static void add_record(tn_builder *builder, tn_section section, const void *record)
{
    switch (section) {
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    case TN_SECTION_##NAME:                                                                                            \
        tn_builder_add_##NAME(builder, record);                                                                        \
        break;
#include "runtime/module/records.def"
    default:
        break;
    }
}

static void write_record(const draft *d, tn_builder *builder, tn_section section, size_t index)
{
    const draft_table *table = &d->tables[section];
    _Alignas(max_align_t) char record[1024];
    if (table->info.size > sizeof record)
        abort();
    memcpy(record, draft_record(d, section, index), table->info.size);
    for (size_t m = 0; m < table->info.members.count; m++) {
        const tn_member *member = &table->info.members.items[m];
        if (member->kind == TN_MEMBER_TEXT)
            draft_set_whole(record, member, tn_builder_string(builder, draft_text(d, tn_member_whole(record, member))));
    }
    if (table->has_code) {
        const tn_member *code = member_of_kind(table, TN_MEMBER_CODE);
        draft_set_whole(record, code, tn_builder_offset(builder));
        uint32_t stack = write_code(d, builder, &table->code[index]);
        draft_set_whole(record, code + 1, tn_builder_offset(builder));
        if (section == TN_SECTION_FUNCTION && !d->keep_stack)
            ((tn_function_record *)record)->stack_max = stack;
    }
    add_record(builder, section, record);
}

bool draft_write(draft *d, uint8_t **bytes, size_t *size)
{
    tn_builder *builder = tn_builder_new();
    if (!builder || d->failed)
        return false;
    for (size_t i = 0; i < d->tables[TN_SECTION_FUNCTION].count; i++)
        write_record(d, builder, TN_SECTION_FUNCTION, i);
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        for (size_t k = 0; i != TN_SECTION_FUNCTION && k < d->tables[i].count; k++)
            write_record(d, builder, i, k);
    tn_status status = tn_builder_finish(builder, bytes, size, NULL);
    tn_builder_free(builder);
    return status == TN_OK;
}
