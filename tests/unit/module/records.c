/* Records by their rows: for every section and every field of records.def, a module whose one record of it is wrong in
 * one way is refused, and the bounds themselves are right. A new row or field is covered by itself. And what other
 * versions of Tartan write: unknown sections, longer records, shorter ones. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/bytes.h"
#include "runtime/load.h"
#include "runtime/module/builder.h"
#include "runtime/module/engine.h"
#include "runtime/module/layout.h"
#include "runtime/module/read.h"
#include "runtime/module/records.h"
#include "runtime/module/verify.h"

/* ---- an engine that has all sections, and stops the loader once all fields were found right */

static double seen_weight; /* of the goal that was verified last */

static tn_status fields_are_right(const tn_checker *checker)
{
    if (checker->module->GOAL_count > 0)
        seen_weight = checker->module->GOAL_records[0].weight;
    return tn_refuse(checker, "its fields are right");
}

static const tn_section all_sections[] = {
#define SECTION(NAME, NUMBER, TYPE, FIELDS) TN_SECTION_##NAME,
#include "runtime/module/records.def"
    TN_SECTION_STRINGS};
static const tn_engine engine = {.name = "all", .sections = all_sections, .verify = fields_are_right};
static const tn_engine *const engine_items[] = {&engine};
static const tn_engines engines = {engine_items, 1};

/* ---- a module with one record in each section, right in every field but perhaps one */

typedef struct wrong {
    tn_section section;
    const tn_member *member; /* NULL: none is wrong */
    int64_t whole;
    double real;
} wrong;

/* A short text, and the one that places are in. */
typedef struct texts {
    tn_string good, source;
} texts;

static void put(void *record, const tn_member *member, int64_t whole, double real)
{
    char *at = (char *)record + member->at;
    uint32_t small = (uint32_t)whole;
    if (member->storage == TN_STORAGE_U32)
        memcpy(at, &small, sizeof small);
    else if (member->storage == TN_STORAGE_I64)
        memcpy(at, &whole, sizeof whole);
    else
        memcpy(at, &real, sizeof real);
}

static void fill(void *record, tn_section section, const texts *strings, const wrong *change)
{
    tn_members members = tn_section_describe(section).members;
    for (size_t i = 0; i < members.count; i++) {
        const tn_member *member = &members.items[i];
        int64_t whole = member->low > 0 || member->kind == TN_MEMBER_WHOLE ? member->low : 0;
        if (member->kind == TN_MEMBER_TEXT)
            whole = section == TN_SECTION_SOURCE ? strings->source : strings->good;
        else if (member->kind == TN_MEMBER_COUNT)
            whole = 1;
        else if (member->kind == TN_MEMBER_END)
            whole = change->section != TN_SECTION_SOURCE; /* whose text may be empty */
        bool is_wrong = change->member == member;
        put(record, member, is_wrong ? change->whole : whole, is_wrong ? change->real : member->least);
    }
}

/* The bytes of such a module, which the caller frees. */
static uint8_t *build(const wrong *change, size_t *size)
{
    uint8_t *bytes;
    tn_builder *builder = tn_builder_new();
    texts strings = {.good = tn_builder_string(builder, "x"), .source = tn_builder_string(builder, "text")};
    tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    {                                                                                                                  \
        TYPE record;                                                                                                   \
        memset(&record, 0, sizeof record);                                                                             \
        fill(&record, TN_SECTION_##NAME, &strings, change);                                                            \
        tn_builder_add_##NAME(builder, &record);                                                                       \
    }
#include "runtime/module/records.def"
    char *endless = malloc(TN_SPELLING_MAX + 2);
    memset(endless, 'n', TN_SPELLING_MAX + 1);
    endless[TN_SPELLING_MAX + 1] = '\0';
    tn_builder_string(builder, endless);
    free(endless);
    assert_int_equal(tn_builder_finish(builder, &bytes, size, NULL), TN_OK);
    tn_builder_free(builder);
    return bytes;
}

/* Loads bytes; NULL where their fields were found right, and the reason of the refusal otherwise. */
static const char *load(uint8_t *bytes, size_t size, tn_error *error)
{
    tn_module *module;
    tn_module_rehash(bytes, size);
    tn_status status = tn_module_read(bytes, size, &engines, NULL, &module, error);
    assert_true(status == TN_INVALID || status == TN_LIMIT);
    return strstr(error->message, "its fields are right") ? NULL : error->message;
}

static void expect(const tn_section_info *info, const wrong *change, bool right)
{
    size_t size;
    tn_error error = {0};
    uint8_t *bytes = build(change, &size);
    const char *reason = load(bytes, size, &error);
    if (right && reason)
        fail_msg("%s.%s = %lld or %g is refused: %s", info->name, change->member->name, (long long)change->whole,
                 change->real, reason);
    if (!right && !reason)
        fail_msg("%s.%s = %lld or %g is not refused", info->name, change->member->name, (long long)change->whole,
                 change->real);
    free(bytes);
}

/* ---- every field wrong in each way that its kind has */

static void whole_is(const tn_section_info *info, wrong change, int64_t whole, bool right)
{
    if (change.member->storage == TN_STORAGE_U32 && (whole < 0 || whole > UINT32_MAX))
        return;
    change.whole = whole;
    expect(info, &change, right);
}

static void real_is(const tn_section_info *info, wrong change, double real, bool right)
{
    change.real = real;
    expect(info, &change, right);
}

static void check_text(const tn_section_info *info, wrong change)
{
    const tn_member *member = change.member;
    tn_builder *builder = tn_builder_new();
    tn_string good = tn_builder_string(builder, "x"), source = tn_builder_string(builder, "text");
    tn_string endless = source + 5; /* build() adds it last */
    tn_builder_free(builder);
    whole_is(info, change, good, true);
    whole_is(info, change, source + 1, false); /* the tail of another text */
    whole_is(info, change, 1 << 20, false);
    whole_is(info, change, 0, member->low == 0);
    whole_is(info, change, endless, member->high > TN_SPELLING_MAX);
}

static void check_whole(const tn_section_info *info, wrong change)
{
    const tn_member *member = change.member;
    whole_is(info, change, member->low, true);
    whole_is(info, change, member->high, true);
    if (member->low > INT64_MIN)
        whole_is(info, change, member->low - 1, false);
    if (member->high < INT64_MAX)
        whole_is(info, change, member->high + 1, false);
}

static void check_real(const tn_section_info *info, wrong change)
{
    real_is(info, change, change.member->least, true);
    real_is(info, change, change.member->most, true);
    real_is(info, change, nextafter(change.member->least, -INFINITY), false);
    real_is(info, change, nextafter(change.member->most, INFINITY), false);
    real_is(info, change, NAN, false);
}

static void check_flags(const tn_section_info *info, wrong change)
{
    whole_is(info, change, change.member->high, true);
    for (int bit = 0; bit < 32; bit++)
        whole_is(info, change, (int64_t)1 << bit, change.member->high >> bit & 1);
}

static void check_member(const tn_section_info *info, wrong change)
{
    switch (change.member->kind) {
    case TN_MEMBER_TEXT:
        check_text(info, change);
        break;
    case TN_MEMBER_WHOLE:
        check_whole(info, change);
        break;
    case TN_MEMBER_REAL:
        check_real(info, change);
        break;
    case TN_MEMBER_FLAGS:
        check_flags(info, change);
        break;
    case TN_MEMBER_REF:
    case TN_MEMBER_REF_OR_NONE:
        whole_is(info, change, 0, true);
        whole_is(info, change, 1, false);
        whole_is(info, change, UINT32_MAX, change.member->kind == TN_MEMBER_REF_OR_NONE);
        break;
    case TN_MEMBER_RUN:
    case TN_MEMBER_FILE:
        whole_is(info, change, 1, false);
        whole_is(info, change, UINT32_MAX, false);
        break;
    case TN_MEMBER_SLICE: /* its count is 1 */
        whole_is(info, change, 1, false);
        break;
    case TN_MEMBER_COUNT:
        whole_is(info, change, 0, change.member[-1].kind == TN_MEMBER_SLICE);
        whole_is(info, change, 2, false);
        whole_is(info, change, UINT32_MAX, false);
        break;
    case TN_MEMBER_BEGIN:
        whole_is(info, change, 1, true);
        whole_is(info, change, 2, false);
        break;
    case TN_MEMBER_END:
        whole_is(info, change, 4, true);
        whole_is(info, change, 5, false);
        break;
    case TN_MEMBER_BITS:
        whole_is(info, change, INT64_MIN, true);
        break;
    case TN_MEMBER_REF_AT_TIMES: /* its engine's to check */
    case TN_MEMBER_CODE:         /* with the code */
    case TN_MEMBER_CODE_END:
        break;
    }
}

static void test_every_field_is_held_to_its_row(void **state)
{
    (void)state;
    size_t fields = 0;
    for (tn_section section = TN_SECTION_CODE + 1; section < TN_SECTION_COUNT; section++) {
        tn_section_info info = tn_section_describe(section);
        for (size_t i = 0; i < info.members.count; i++, fields++)
            check_member(&info, (wrong){.section = section,
                                        .member = &info.members.items[i],
                                        .whole = info.members.items[i].low,
                                        .real = info.members.items[i].least});
    }
    assert_true(fields > 100);
}

/* ---- rows */

static void test_rows_ascend_and_have_one_engine(void **state)
{
    (void)state;
    uint32_t above = 0;
    for (tn_section section = 0; section < TN_SECTION_COUNT; section++) {
        tn_section_info info = tn_section_describe(section);
        assert_true(info.number >= above);
        above = info.number + 1u;
        assert_int_equal(tn_section_numbered(info.number), section);
        char title[TN_TITLE_MAX];
        tn_section_title(section, title);
        assert_int_equal(strlen(title), strlen(info.name)); /* it is not cut */
        size_t owners = 0;
        const tn_engines *all = tn_engines_all();
        for (size_t i = 0; i < all->count; i++)
            for (const tn_section *own = all->items[i]->sections; own && *own != TN_SECTION_STRINGS; own++)
                owners += *own == section;
        bool common = section == TN_SECTION_STRINGS || section == TN_SECTION_CODE || section == TN_SECTION_FUNCTION ||
                      section == TN_SECTION_SOURCE || section == TN_SECTION_SOURCE_MAP ||
                      section == TN_SECTION_PRODUCER;
        if (owners != !common)
            fail_msg("section %s belongs to %zu engines", info.name, owners);
    }
}

static void test_every_code_has_one_engine(void **state)
{
    (void)state;
    const tn_engines *all = tn_engines_all();
    for (tn_code_kind code = 0; code < TN_CODE_KIND_COUNT; code++) {
        size_t owners = 0;
        for (size_t i = 0; i < all->count; i++)
            owners += all->items[i]->codes >> code & 1;
        assert_int_equal(owners, 1);
    }
}

static void test_a_section_without_engine_is_refused(void **state)
{
    (void)state;
    static const tn_engines none = {NULL, 0};
    size_t size;
    tn_module *module;
    tn_error error = {0};
    uint8_t *bytes = build(&(wrong){0}, &size);
    assert_int_equal(tn_module_read(bytes, size, &none, NULL, &module, &error), TN_INVALID);
    assert_non_null(strstr(error.message, "this program lacks the engine of its section SCHEMA"));
    free(bytes);
}

/* ---- modules of other versions */

/* Where in the table of sections this one is. */
static uint8_t *entry_of(uint8_t *bytes, uint32_t number)
{
    uint32_t count = tn_get_u32(bytes + TN_HEADER_SECTIONS);
    for (uint32_t i = 0; i < count; i++) {
        uint8_t *entry = bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES;
        if ((tn_get_u32(entry) & 0xffff) == number)
            return entry;
    }
    fail_msg("there is no section %u", number);
    return NULL;
}

/* Where a section's records begin. */
static size_t place_of(const uint8_t *bytes, const uint8_t *wanted)
{
    size_t at = TN_HEADER_BYTES + (size_t)tn_get_u32(bytes + TN_HEADER_SECTIONS) * TN_ENTRY_BYTES;
    for (const uint8_t *entry = bytes + TN_HEADER_BYTES; entry < wanted; entry += TN_ENTRY_BYTES)
        at += (size_t)(tn_get_u32(entry) >> 16) * tn_get_u32(entry + TN_ENTRY_COUNT);
    return at;
}

/* Gives the one record of a section `stored` bytes: cuts its end off, or adds zeros. Returns the new size. */
static size_t resize(uint8_t *bytes, size_t size, tn_section section, uint32_t stored)
{
    uint32_t number = tn_section_describe(section).number, known = tn_section_stored(section);
    uint8_t *entry = entry_of(bytes, number);
    size_t at = place_of(bytes, entry);
    memmove(bytes + at + stored, bytes + at + known, size - at - known);
    if (stored > known)
        memset(bytes + at + known, 0, stored - known);
    tn_put_u32(entry, number | stored << 16);
    size = size - known + stored;
    tn_put_u64(bytes + TN_HEADER_SIZE, size);
    return size;
}

/* What loading says of a section whose record has this size; NULL: all fields are right. */
static const char *resized(tn_section section, uint32_t stored, tn_error *error)
{
    size_t size;
    uint8_t *bytes = build(&(wrong){0}, &size);
    bytes = realloc(bytes, size + 64);
    *error = (tn_error){0};
    const char *reason = load(bytes, resize(bytes, size, section, stored), error);
    free(bytes);
    return reason;
}

static void test_records_of_other_sizes(void **state)
{
    (void)state;
    tn_error error;
    for (tn_section section = TN_SECTION_CODE + 1; section < TN_SECTION_COUNT; section++) {
        tn_members members = tn_section_describe(section).members;
        uint32_t known = tn_section_stored(section), end = 0;
        assert_null(resized(section, known, &error));
        assert_non_null(strstr(resized(section, known + 4, &error), "was it made by a newer Tartan?"));
        assert_int_equal(error.code, E_DAMAGED_MODULE);
        assert_non_null(strstr(error.help, "with the Tartan that made it"));
        assert_non_null(strstr(resized(section, 0, &error), "is damaged"));
        for (size_t i = 0; i + 1 < members.count; i++) {
            uint32_t bytes = tn_storage_bytes(members.items[i].storage);
            assert_non_null(strstr(resized(section, end + bytes - 1, &error), "is damaged"));
            end += bytes;
            const char *reason = resized(section, end, &error); /* right with its defaults, or refused for one */
            assert_true(!reason || error.code == E_REFUSED_MODULE);
        }
    }
}

static void test_missing_fields_have_their_defaults(void **state)
{
    (void)state;
    tn_error error;
    seen_weight = -1;
    assert_null(resized(TN_SECTION_GOAL, tn_section_stored(TN_SECTION_GOAL) - 20, &error));
    assert_true(seen_weight == 1); /* DEFAULT(weight, 1) */
    seen_weight = -1;
    assert_null(resized(TN_SECTION_GOAL, tn_section_stored(TN_SECTION_GOAL), &error));
    assert_true(seen_weight == 0);
    tn_grammar_record grammar;
    memset(&grammar, 7, sizeof grammar);
    static const uint8_t stored[4] = {0};
    tn_records_read(TN_SECTION_GRAMMAR, stored, 1, 4, &grammar);
    assert_int_equal(grammar.rewrite_rule, TN_NO_RECORD);
    assert_int_equal(grammar.successor, TN_NO_RECORD);
    assert_int_equal(grammar.max_depth, 0);
}

static void test_unknown_sections(void **state)
{
    (void)state;
    size_t size;
    tn_error error = {0};
    uint8_t *bytes = build(&(wrong){0}, &size);
    uint8_t *last = bytes + TN_HEADER_BYTES + (tn_get_u32(bytes + TN_HEADER_SECTIONS) - 1) * TN_ENTRY_BYTES;
    uint32_t kept = tn_get_u32(last);
    tn_put_u32(last, 999 | (kept & 0xffff0000));
    assert_string_equal(load(bytes, size, &error),
                        "the module has a section 999, which this program does not know: was it made by a newer "
                        "Tartan?");
    assert_int_equal(error.code, E_DAMAGED_MODULE);
    tn_put_u32(last, kept & 0xffff0000); /* a number again */
    assert_non_null(strstr(load(bytes, size, &error), "out of order or names an empty section"));
    tn_put_u32(last, kept);
    tn_put_u32(last + TN_ENTRY_COUNT, 0);
    assert_non_null(strstr(load(bytes, size, &error), "out of order or names an empty section"));
    tn_put_u32(last + TN_ENTRY_COUNT, UINT32_MAX);
    assert_non_null(strstr(load(bytes, size, &error), "does not fit its contents"));
    tn_put_u32(last + TN_ENTRY_COUNT, 1);
    tn_put_u32(bytes + TN_HEADER_SECTIONS, UINT32_MAX);
    assert_non_null(strstr(load(bytes, size, &error), "ends within its table of sections"));
    free(bytes);
}

static void test_an_empty_module_is_small(void **state)
{
    (void)state;
    uint8_t *bytes;
    size_t size;
    tn_builder *builder = tn_builder_new();
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);
    assert_int_equal(size, TN_HEADER_BYTES + TN_ENTRY_BYTES + 1); /* the strings' one byte */
    tn_builder_free(builder);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_field_is_held_to_its_row),
        cmocka_unit_test(test_rows_ascend_and_have_one_engine),
        cmocka_unit_test(test_every_code_has_one_engine),
        cmocka_unit_test(test_a_section_without_engine_is_refused),
        cmocka_unit_test(test_records_of_other_sizes),
        cmocka_unit_test(test_missing_fields_have_their_defaults),
        cmocka_unit_test(test_unknown_sections),
        cmocka_unit_test(test_an_empty_module_is_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
