/* What a request says of growing as a study of its own, so that both mean the same and are checked and explained
 * alike. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/growth/grow.h"

static void say_quoted(tn_buffer *out, const char *text)
{
    tn_buffer_append(out, "\"", 1);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            tn_buffer_append(out, "\\", 1);
        tn_buffer_append(out, text, 1);
    }
    tn_buffer_append(out, "\"\n", 2);
}

/* Words of studies have hyphens. */
static void say_word(tn_buffer *out, const char *member)
{
    for (; *member; member++)
        tn_buffer_append(out, *member == '_' ? "-" : member, 1);
}

static void say_texts(tn_buffer *out, const char *member, const tn_texts *texts)
{
    bool whole = strcmp(member, "statements") == 0;
    for (size_t i = 0; i < texts->count; i++) {
        if (!whole)
            say_word(out, member);
        tn_buffer_printf(out, "%s%s\n", whole ? "" : " ", texts->items[i]);
    }
}

static void say_text(tn_buffer *out, const char *member, const char *text)
{
    if (!text)
        return;
    say_word(out, member);
    tn_buffer_append(out, " ", 1);
    if (strcmp(member, "distance_to") == 0)
        say_quoted(out, text);
    else
        tn_buffer_printf(out, "%s\n", text);
}

static void say_member(tn_buffer *out, const tn_message_member *m, const tn_grow_statements *said)
{
    const char *value = (const char *)said + m->offset;
    switch (m->kind) {
    case TN_MESSAGE_TEXTS:
        say_texts(out, m->name, (const tn_texts *)(const void *)value);
        break;
    case TN_MESSAGE_TEXT:
        say_text(out, m->name, *(const char *const *)(const void *)value);
        break;
    case TN_MESSAGE_COUNT:
        if (*((const char *)said + m->has))
            tn_buffer_printf(out, "%s %" PRIu64 "\n", m->name, *(const uint64_t *)(const void *)value);
        break;
    default: /* a flag */
        if (*(const bool *)(const void *)value) {
            say_word(out, m->name);
            tn_buffer_append(out, "\n", 1);
        }
    }
}

tn_status tn_grow_study_text(const tn_grow_statements *said, const char *path, bool rules, char **text, size_t *size,
                             tn_error *error)
{
    const tn_message *message = &tn_message_grow_statements;
    tn_buffer out = {0};
    *text = NULL;
    tn_buffer_printf(&out, "%s", rules ? "rules " : "use ");
    say_quoted(&out, path);
    size_t begun = out.size;
    for (size_t i = 0; i < message->member_count; i++)
        say_member(&out, &message->members[i], said);
    if (out.failed || out.size == begun) {
        free(out.data);
        return out.failed ? tn_fail_memory(error) : TN_OK;
    }
    *text = out.data;
    *size = out.size;
    return TN_OK;
}
