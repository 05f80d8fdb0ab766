/* The tables of requests, answers and questions. */
#include "ask/session/requests.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/nearest.h"
#include "runtime/place/count/count.h"

/* ---- messages by their tables */

static void *at(void *value, size_t offset)
{
    return (char *)value + offset;
}

static const void *look(const void *value, size_t offset)
{
    return (const char *)value + offset;
}

static bool is_said(const tn_message_member *m, const void *value)
{
    switch (m->presence) {
    case TN_OPTIONAL:
    case TN_SOMETIMES:
    case TN_NULLABLE:
        return *(const bool *)look(value, m->has);
    case TN_UNSAID:
        return false;
    default:
        return true;
    }
}

/* ---- made and freed */

void tn_message_init(const tn_message *message, void *value)
{
    memset(value, 0, message->size);
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        void *member = at(value, m->offset);
        if (m->kind == TN_MESSAGE_BIG)
            mpz_init(*(mpz_t *)member);
        else if (m->kind == TN_MESSAGE_EXACT)
            mpq_init(*(mpq_t *)member);
        else if (m->kind == TN_MESSAGE_NESTED || m->kind == TN_MESSAGE_PART)
            tn_message_init(m->of, member);
    }
}

static void clear_list(const tn_message *message, tn_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        tn_message_clear(message, (char *)list->items + i * message->size);
    free(list->items);
}

static void clear_exacts(tn_exacts *exacts)
{
    for (size_t i = 0; i < exacts->count; i++)
        mpq_clear(exacts->items[i]);
    free(exacts->items);
}

static void clear_owneds(tn_owneds *texts)
{
    for (size_t i = 0; i < texts->count; i++)
        free(texts->items[i]);
    free(texts->items);
}

void tn_boxed_free(tn_boxed *boxed)
{
    if (boxed->value)
        boxed->free(boxed->value);
    *boxed = (tn_boxed){0};
}

static void clear_member(const tn_message_member *m, void *member)
{
    switch (m->kind) {
    case TN_MESSAGE_OWNED:
    case TN_MESSAGE_WRITTEN:
        free(*(char **)member);
        break;
    case TN_MESSAGE_TEXTS:
        free(((tn_texts *)member)->items);
        break;
    case TN_MESSAGE_COUNTS:
        free(((tn_counts *)member)->items);
        break;
    case TN_MESSAGE_OWNEDS:
        clear_owneds(member);
        break;
    case TN_MESSAGE_BIG:
        mpz_clear(*(mpz_t *)member);
        break;
    case TN_MESSAGE_EXACT:
        mpq_clear(*(mpq_t *)member);
        break;
    case TN_MESSAGE_EXACTS:
        clear_exacts(member);
        break;
    case TN_MESSAGE_NESTED:
    case TN_MESSAGE_PART:
        tn_message_clear(m->of, member);
        break;
    case TN_MESSAGE_LIST:
    case TN_MESSAGE_MAP:
        clear_list(m->of, member);
        break;
    case TN_MESSAGE_BOXED:
        tn_boxed_free(member);
        break;
    case TN_MESSAGE_BYTES:
        free(((tn_bytes *)member)->items);
        break;
    case TN_MESSAGE_TEXT:
    case TN_MESSAGE_FLAG:
    case TN_MESSAGE_CHOICE:
    case TN_MESSAGE_COUNT:
    case TN_MESSAGE_WHOLE:
    case TN_MESSAGE_REAL:
    case TN_MESSAGE_TRAYS:
        break;
    }
}

void tn_message_clear(const tn_message *message, void *value)
{
    for (size_t i = 0; i < message->member_count; i++)
        clear_member(&message->members[i], at(value, message->members[i].offset));
    memset(value, 0, message->size);
}

tn_status tn_message_list(const tn_message *message, size_t count, tn_list *list, tn_error *error)
{
    list->items = calloc(count + 1, message->size);
    if (!list->items)
        return tn_fail_memory(error);
    list->count = count;
    for (size_t i = 0; i < count; i++)
        tn_message_init(message, (char *)list->items + i * message->size);
    return TN_OK;
}

/* Room for one more: there is room for a power of two, which needs no number of its own. `items` points to the array's
 * pointer. */
static tn_status grow(void *items, size_t count, size_t size, tn_error *error)
{
    bool full = (count & (count - 1)) == 0;
    return !full || tn_array_resize(items, count ? 2 * count : 1, size) ? TN_OK : tn_fail_memory(error);
}

void *tn_message_add(const tn_message *message, tn_list *list, tn_error *error)
{
    if (grow(&list->items, list->count, message->size, error) != TN_OK)
        return NULL;
    void *added = (char *)list->items + list->count++ * message->size;
    tn_message_init(message, added);
    return added;
}

tn_status tn_exacts_room(tn_exacts *exacts, size_t count, tn_error *error)
{
    exacts->items = calloc(count + 1, sizeof *exacts->items);
    if (!exacts->items)
        return tn_fail_memory(error);
    for (; exacts->count < count; exacts->count++)
        mpq_init(exacts->items[exacts->count]);
    return TN_OK;
}

tn_status tn_owneds_add(tn_owneds *texts, char *text, tn_error *error)
{
    tn_status status = text ? grow(&texts->items, texts->count, sizeof *texts->items, error) : tn_fail_memory(error);
    if (status == TN_OK)
        texts->items[texts->count++] = text;
    else
        free(text);
    return status;
}

/* ---- written */

static void write_members(const tn_message *message, const void *value, tn_json *json);

static void write_exact(const char *key, mpq_srcptr number, tn_json *json)
{
    char *text = mpq_get_str(NULL, 10, number);
    tn_json_string(json, key, text);
    free(text);
}

static void write_texts(const char *key, const char *const *items, size_t count, tn_json *json)
{
    tn_json_list(json, key);
    for (size_t i = 0; i < count; i++)
        tn_json_string(json, NULL, items[i]);
    tn_json_list_end(json);
}

static void write_counts(const char *key, const tn_counts *counts, tn_json *json)
{
    tn_json_list(json, key);
    for (size_t i = 0; i < counts->count; i++)
        tn_json_count(json, NULL, counts->items[i]);
    tn_json_list_end(json);
}

/* The members of a message, or the value of a listing. */
static void write_written(const tn_message_member *m, const char *key, const char *text, tn_json *json)
{
    if (m->of->form == TN_MESSAGE_LISTING)
        tn_json_written_value(json, key, text);
    else
        tn_json_written(json, text, text ? strlen(text) : 0);
}

static void write_list(const tn_message_member *m, const char *key, const tn_list *list, tn_json *json)
{
    tn_json_list(json, key);
    for (size_t i = 0; i < list->count; i++)
        tn_message_write(m->of, (const char *)list->items + i * m->of->size, NULL, json);
    tn_json_list_end(json);
}

static void write_value(const tn_message_member *m, const char *key, const void *member, tn_json *json);

static void write_map(const tn_message_member *m, const char *key, const tn_list *list, tn_json *json)
{
    const tn_message_member *name = &m->of->members[0], *what = &m->of->members[1];
    tn_json_object(json, key);
    for (size_t i = 0; i < list->count; i++) {
        const char *item = (const char *)list->items + i * m->of->size;
        write_value(what, *(const char *const *)look(item, name->offset), look(item, what->offset), json);
    }
    tn_json_object_end(json);
}

static void write_value(const tn_message_member *m, const char *key, const void *member, tn_json *json)
{
    const tn_texts *texts = member;
    const tn_exacts *exacts = member;
    switch (m->kind) {
    case TN_MESSAGE_TEXT:
    case TN_MESSAGE_OWNED:
        tn_json_string(json, key, *(const char *const *)member);
        break;
    case TN_MESSAGE_TEXTS:
        write_texts(key, texts->items, texts->count, json);
        break;
    case TN_MESSAGE_OWNEDS:
        write_texts(key, (const char *const *)((const tn_owneds *)member)->items, texts->count, json);
        break;
    case TN_MESSAGE_FLAG:
        tn_json_bool(json, key, *(const bool *)member);
        break;
    case TN_MESSAGE_COUNT:
        tn_json_count(json, key, *(const uint64_t *)member);
        break;
    case TN_MESSAGE_COUNTS:
        write_counts(key, member, json);
        break;
    case TN_MESSAGE_WHOLE:
        tn_json_whole(json, key, *(const int64_t *)member);
        break;
    case TN_MESSAGE_REAL:
        tn_json_number(json, key, *(const double *)member);
        break;
    case TN_MESSAGE_BIG:
        tn_json_digits(json, key, (mpz_srcptr)member);
        break;
    case TN_MESSAGE_EXACT:
        write_exact(key, (mpq_srcptr)member, json);
        break;
    case TN_MESSAGE_EXACTS:
        tn_json_list(json, key);
        for (size_t i = 0; i < exacts->count; i++)
            write_exact(NULL, exacts->items[i], json);
        tn_json_list_end(json);
        break;
    case TN_MESSAGE_NESTED:
        tn_message_write(m->of, member, key, json);
        break;
    case TN_MESSAGE_PART:
        write_members(m->of, member, json);
        break;
    case TN_MESSAGE_LIST:
        write_list(m, key, member, json);
        break;
    case TN_MESSAGE_MAP:
        write_map(m, key, member, json);
        break;
    case TN_MESSAGE_WRITTEN:
        write_written(m, key, *(const char *const *)member, json);
        break;
    case TN_MESSAGE_BYTES:
        tn_json_base64(json, key, ((const tn_bytes *)member)->items, ((const tn_bytes *)member)->count);
        break;
    case TN_MESSAGE_CHOICE: /* no answer has one */
    case TN_MESSAGE_TRAYS:
    case TN_MESSAGE_BOXED:
        break;
    }
}

static void write_members(const tn_message *message, const void *value, tn_json *json)
{
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        const char *key = message->form == TN_MESSAGE_TUPLE ? NULL : m->name;
        if (is_said(m, value))
            write_value(m, key, look(value, m->offset), json);
        else if (m->presence == TN_NULLABLE)
            tn_json_null(json, key);
    }
}

void tn_message_write(const tn_message *message, const void *value, const char *key, tn_json *json)
{
    switch (message->form) {
    case TN_MESSAGE_OBJECT:
        tn_json_object(json, key);
        write_members(message, value, json);
        tn_json_object_end(json);
        break;
    case TN_MESSAGE_TUPLE:
        tn_json_list(json, key);
        write_members(message, value, json);
        tn_json_list_end(json);
        break;
    case TN_MESSAGE_LISTING:
        write_value(&message->members[0], key, look(value, message->members[0].offset), json);
        break;
    }
}

/* ---- read */

static const char *article(const char *name)
{
    return strchr("aeiou", name[0]) ? "an" : "a";
}

static const char *wanted(const tn_message_member *m)
{
    switch (m->kind) {
    case TN_MESSAGE_TEXTS:
        return "a list of texts";
    case TN_MESSAGE_FLAG:
        return "true or false";
    case TN_MESSAGE_REAL:
        return "a number";
    case TN_MESSAGE_COUNT:
        return "a whole number from 0";
    case TN_MESSAGE_COUNTS:
        return "a list of whole numbers from 0";
    case TN_MESSAGE_NESTED:
        return "an object";
    case TN_MESSAGE_LIST:
        return m->of->form == TN_MESSAGE_TUPLE ? "a list of lists" : "a list of objects";
    default:
        return "a text";
    }
}

static tn_status read_texts(json_t *list, tn_texts *texts, tn_error *error)
{
    texts->items = calloc(json_array_size(list) + 1, sizeof *texts->items);
    if (!texts->items)
        return tn_fail_memory(error);
    for (size_t i = 0; i < json_array_size(list); i++) {
        texts->items[i] = json_string_value(json_array_get(list, i));
        if (!texts->items[i])
            return TN_INVALID;
        texts->count = i + 1;
    }
    return TN_OK;
}

static bool is_count(json_t *from)
{
    return json_is_integer(from) && json_integer_value(from) >= 0;
}

static tn_status read_counts(json_t *list, tn_counts *counts, tn_error *error)
{
    counts->items = calloc(json_array_size(list) + 1, sizeof *counts->items);
    if (!counts->items)
        return tn_fail_memory(error);
    for (; counts->count < json_array_size(list); counts->count++) {
        json_t *item = json_array_get(list, counts->count);
        if (!is_count(item))
            return TN_INVALID;
        counts->items[counts->count] = (uint64_t)json_integer_value(item);
    }
    return TN_OK;
}

static tn_status read_value(const tn_message_member *m, json_t *from, void *member, tn_error *error);

/* Of exactly so many values as it has members. */
static tn_status read_tuple(const tn_message *of, json_t *from, void *value, tn_error *error)
{
    tn_status status = json_array_size(from) == of->member_count ? TN_OK : TN_INVALID;
    for (size_t i = 0; status == TN_OK && i < of->member_count; i++)
        status = read_value(&of->members[i], json_array_get(from, i), at(value, of->members[i].offset), error);
    return status;
}

/* In its form; TN_INVALID without a sentence if it is in another one. */
static tn_status read_message(const tn_message *of, json_t *from, void *value, tn_error *error)
{
    if (of->form == TN_MESSAGE_TUPLE)
        return read_tuple(of, from, value, error);
    return json_is_object(from) ? tn_message_read(of, from, value, error) : TN_INVALID;
}

static tn_status read_list(const tn_message *of, json_t *from, tn_list *list, tn_error *error)
{
    tn_status status = tn_message_list(of, json_array_size(from), list, error);
    for (size_t i = 0; status == TN_OK && i < list->count; i++)
        status = read_message(of, json_array_get(from, i), (char *)list->items + i * of->size, error);
    return status;
}

static tn_status in_bounds(const tn_message_member *m, uint64_t number, tn_error *error)
{
    if ((number >= m->least && number <= m->most) || m->most == 0)
        return TN_OK;
    return tn_fail(error, TN_INVALID, E_USAGE, "`%s` is from %" PRIu64 " to %" PRIu64 ", not %" PRIu64, m->name,
                   m->least, m->most, number);
}

/* The first of the words at `words`, with | between them; NULL behind the last one. */
const char *tn_message_word(const char **words, size_t *size)
{
    const char *word = *words;
    *size = strcspn(word, "|");
    *words = word + *size + (word[*size] == '|');
    return *word ? word : NULL;
}

/* a|b|c: "a, b or c" */
static tn_status refuse_word(const tn_message_member *m, const char *text, tn_error *error)
{
    enum { WORDS_MAX = 40, WORD_SIZE = 32 };
    char known[WORDS_MAX][WORD_SIZE], list[400];
    const char *names[WORDS_MAX], *words = m->words, *word;
    size_t size, count = 0;
    while (count < WORDS_MAX && (word = tn_message_word(&words, &size)) != NULL) {
        snprintf(known[count], WORD_SIZE, "%.*s", (int)size, word);
        names[count] = known[count];
        count++;
    }
    const char *near = tn_nearest(text, names, count);
    tn_fail(error, TN_INVALID, E_USAGE, "`%s` cannot be `%.60s`", m->name, text);
    tn_word_list(names, count, list, sizeof list);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    else
        tn_error_help(error, "it is one of %s", list);
    return TN_INVALID;
}

static tn_status read_choice(const tn_message_member *m, const char *text, unsigned *choice, tn_error *error)
{
    const char *words = m->words, *word;
    size_t size;
    for (*choice = 0; text && (word = tn_message_word(&words, &size)) != NULL; ++*choice)
        if (strlen(text) == size && strncmp(text, word, size) == 0)
            return TN_OK;
    *choice = 0;
    return text ? refuse_word(m, text, error) : TN_INVALID;
}

/* TN_INVALID without a sentence if the value is of another type. */
static tn_status read_value(const tn_message_member *m, json_t *from, void *member, tn_error *error)
{
    switch (m->kind) {
    case TN_MESSAGE_TEXT:
        *(const char **)member = json_string_value(from);
        return json_is_string(from) ? TN_OK : TN_INVALID;
    case TN_MESSAGE_TEXTS:
        return json_is_array(from) ? read_texts(from, member, error) : TN_INVALID;
    case TN_MESSAGE_FLAG:
        *(bool *)member = json_is_true(from);
        return json_is_boolean(from) ? TN_OK : TN_INVALID;
    case TN_MESSAGE_CHOICE:
        return read_choice(m, json_string_value(from), member, error);
    case TN_MESSAGE_REAL:
        *(double *)member = json_number_value(from);
        return json_is_number(from) ? TN_OK : TN_INVALID;
    case TN_MESSAGE_COUNT:
        *(uint64_t *)member = is_count(from) ? (uint64_t)json_integer_value(from) : 0;
        return is_count(from) ? in_bounds(m, *(uint64_t *)member, error) : TN_INVALID;
    case TN_MESSAGE_COUNTS:
        return json_is_array(from) ? read_counts(from, member, error) : TN_INVALID;
    case TN_MESSAGE_NESTED:
        return read_message(m->of, from, member, error);
    case TN_MESSAGE_LIST:
        return json_is_array(from) ? read_list(m->of, from, member, error) : TN_INVALID;
    default: /* no request has others */
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "requests have no member of this kind: %s", m->name);
    }
}

static tn_status read_member(const tn_message *message, const tn_message_member *m, json_t *object, void *value,
                             tn_error *error)
{
    if (m->kind == TN_MESSAGE_PART) {
        for (size_t i = 0; i < m->of->member_count; i++) {
            tn_status status = read_member(message, &m->of->members[i], object, at(value, m->offset), error);
            if (status != TN_OK)
                return status;
        }
        return TN_OK;
    }
    json_t *from = json_object_get(object, m->name);
    if (!from || json_is_null(from))
        return m->presence == TN_PRESENT ? tn_fail(error, TN_INVALID, E_USAGE, "%s %s needs `%s`: %s",
                                                   article(message->name), message->name, m->name, m->doc)
                                         : TN_OK;
    if (m->presence == TN_OPTIONAL)
        *(bool *)at(value, m->has) = true;
    error->message[0] = '\0';
    tn_status status = read_value(m, from, at(value, m->offset), error);
    if (status == TN_INVALID && !error->message[0])
        tn_fail(error, TN_INVALID, E_USAGE, "`%s` is %s: %s", m->name, wanted(m), m->doc);
    return status;
}

/* The names of a message's members, those of its parts too; how many there are. names: NULL, or room for all. */
static size_t name_members(const tn_message *message, const char **names)
{
    size_t count = 0;
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        if (m->kind == TN_MESSAGE_PART) {
            count += name_members(m->of, names ? names + count : NULL);
            continue;
        }
        if (names)
            names[count] = m->name;
        count++;
    }
    return count;
}

static tn_status refuse_unknown(const tn_message *message, const char *key, const char *const *names, size_t count,
                                tn_error *error)
{
    const char *near = tn_nearest(key, names, count);
    tn_fail(error, TN_INVALID, E_USAGE, "%s %s has no `%.80s`", article(message->name), message->name, key);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    return TN_INVALID;
}

static tn_status check_keys(const tn_message *message, json_t *object, tn_error *error)
{
    size_t count = name_members(message, NULL);
    const char **names = calloc(count + 1, sizeof *names), *key;
    json_t *value;
    if (!names)
        return tn_fail_memory(error);
    name_members(message, names);
    tn_status status = TN_OK;
    json_object_foreach(object, key, value)
    {
        bool known = false;
        for (size_t i = 0; i < count; i++)
            known |= strcmp(names[i], key) == 0;
        if (!known && status == TN_OK)
            status = refuse_unknown(message, key, names, count, error);
    }
    free(names);
    return status;
}

tn_status tn_message_read(const tn_message *message, json_t *object, void *value, tn_error *error)
{
    tn_status status = check_keys(message, object, error);
    for (size_t i = 0; i < message->member_count && status == TN_OK; i++)
        status = read_member(message, &message->members[i], object, value, error);
    return status;
}

/* ---- messages */

#define HAS_PRESENT(OWNER, NAME) 0
#define HAS_UNSAID(OWNER, NAME) 0
#define HAS_DEFAULTED(OWNER, NAME) 0
#define HAS_OPTIONAL(OWNER, NAME) offsetof(tn_##OWNER, has_##NAME)
#define HAS_SOMETIMES(OWNER, NAME) offsetof(tn_##OWNER, has_##NAME)
#define HAS_NULLABLE(OWNER, NAME) offsetof(tn_##OWNER, has_##NAME)

#define TN_MESSAGE(NAME, DOC) static const tn_message_member NAME##_members[] = {
#define TN_NUMBER(OWNER, PRESENCE, NAME, LEAST, MOST, UNIT, DOC)                                                       \
    {.name = #NAME,                                                                                                    \
     .kind = TN_MESSAGE_COUNT,                                                                                         \
     .presence = TN_##PRESENCE,                                                                                        \
     .offset = offsetof(tn_##OWNER, NAME),                                                                             \
     .has = HAS_##PRESENCE(OWNER, NAME),                                                                               \
     .least = LEAST,                                                                                                   \
     .most = MOST,                                                                                                     \
     .unit = UNIT,                                                                                                     \
     .doc = DOC},
#define TN_FIELD(OWNER, PRESENCE, KIND, NAME, UNIT, DOC)                                                               \
    {.name = #NAME,                                                                                                    \
     .kind = TN_MESSAGE_##KIND,                                                                                        \
     .presence = TN_##PRESENCE,                                                                                        \
     .offset = offsetof(tn_##OWNER, NAME),                                                                             \
     .has = HAS_##PRESENCE(OWNER, NAME),                                                                               \
     .unit = UNIT,                                                                                                     \
     .doc = DOC},
#define TN_CHOICE(OWNER, NAME, WORDS, DOC)                                                                             \
    {.name = #NAME,                                                                                                    \
     .kind = TN_MESSAGE_CHOICE,                                                                                        \
     .presence = TN_DEFAULTED,                                                                                         \
     .offset = offsetof(tn_##OWNER, NAME),                                                                             \
     .words = WORDS,                                                                                                   \
     .unit = "",                                                                                                       \
     .doc = DOC},
#define TN_OF(OWNER, PRESENCE, KIND, OF, NAME, DOC)                                                                    \
    {.name = #NAME,                                                                                                    \
     .kind = TN_MESSAGE_##KIND,                                                                                        \
     .presence = TN_##PRESENCE,                                                                                        \
     .offset = offsetof(tn_##OWNER, NAME),                                                                             \
     .has = HAS_##PRESENCE(OWNER, NAME),                                                                               \
     .of = &tn_message_##OF,                                                                                           \
     .unit = "",                                                                                                       \
     .doc = DOC},
#define TN_END(NAME)                                                                                                   \
    }                                                                                                                  \
    ;
#include "ask/session/requests.def"

#define DEFINE(NAME, DOC, FORM)                                                                                        \
    const tn_message tn_message_##NAME = {                                                                             \
        #NAME, DOC, FORM, sizeof(tn_##NAME), NAME##_members, sizeof NAME##_members / sizeof *NAME##_members};
#define TN_MESSAGE(NAME, DOC) DEFINE(NAME, DOC, TN_MESSAGE_OBJECT)
#define TN_TUPLE(NAME, DOC) DEFINE(NAME, DOC, TN_MESSAGE_TUPLE)
#define TN_LISTING(NAME, DOC) DEFINE(NAME, DOC, TN_MESSAGE_LISTING)
#include "ask/session/requests.def"

const tn_message *const tn_messages[] = {
#define TN_MESSAGE(NAME, DOC) &tn_message_##NAME,
#include "ask/session/requests.def"
};

const size_t tn_message_count = sizeof tn_messages / sizeof *tn_messages;

const tn_message *tn_message_named(const char *name)
{
    for (size_t i = 0; i < tn_message_count; i++)
        if (strcmp(tn_messages[i]->name, name) == 0)
            return tn_messages[i];
    return NULL;
}

/* ---- answers */

tn_status tn_reply_new(const tn_message *message, tn_reply *answer, tn_error *error)
{
    void *value = malloc(message->size);
    if (!value)
        return tn_fail_memory(error);
    tn_message_init(message, value);
    *answer = (tn_reply){message, value};
    return TN_OK;
}

void tn_reply_clear(tn_reply *answer)
{
    if (answer->message)
        tn_message_clear(answer->message, answer->value);
    free(answer->value);
    *answer = (tn_reply){0};
}

tn_json_layout tn_reply_layout(const tn_reply *answer)
{
    const tn_message *const lines[] = {&tn_message_counted_plans, &tn_message_counted_values, &tn_message_relations,
                                       &tn_message_found_front,   &tn_message_completed,      &tn_message_completed_by,
                                       &tn_message_compared,      &tn_message_shown_file};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (answer->message == lines[i])
            return TN_JSON_LINES;
    if (answer->message == &tn_message_measured_mesh)
        return TN_JSON_SPACED;
    if (answer->message == &tn_message_grown_steps)
        return (tn_json_layout){.spaced = true, .lines = 1};
    return TN_JSON_TIGHT;
}
