/* The tables of requests, answers and questions. */
#include "ask/session/requests.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/nearest.h"
#include "runtime/place/count/count.h"

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
