/* The constructors of the syntax tree of studies that breed (.study). */
#include <string.h>

#include "compiler/common/lexical.h"
#include "compiler/evolution/evolution.h"

void tn_evolution_block(tn_evolution_reader *reader, tn_span head)
{
    reader->open = head;
    if (reader->blocks++) {
        tn_diagnostic *diagnostic =
            tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, head, "a study has one evolution block");
        tn_note(reader->diagnostics, diagnostic, &reader->head, "the first is here");
        return;
    }
    reader->head = head;
}

void tn_evolution_outside(tn_evolution_reader *reader, tn_span span)
{
    if (reader->outside.end == 0)
        reader->outside = span;
}

void tn_evolution_setting_new(tn_evolution_reader *reader, tn_span span, tn_evolution_text name,
                              tn_evolution_value *values)
{
    tn_evolution_setting *setting = TN_NEW(reader->arena, tn_evolution_setting);
    char *copy = tn_arena_copy(reader->arena, name.text, name.length);
    if (!setting || !copy)
        return;
    setting->name = copy;
    setting->span = span;
    setting->values = values;
    TN_CHAIN(reader, setting);
}

tn_evolution_value *tn_evolution_value_new(tn_evolution_reader *reader, tn_evolution_value_kind kind, tn_span span,
                                           tn_evolution_text text)
{
    tn_evolution_value *value = TN_NEW(reader->arena, tn_evolution_value);
    char *copy = kind == TN_EVOLUTION_STRING ? tn_string_lex(reader->arena, text.text + 1, text.length - 2)
                                             : tn_arena_copy(reader->arena, text.text, text.length);
    if (!value || !copy)
        return NULL;
    value->kind = kind;
    value->span = span;
    value->text = copy;
    value->last = value;
    return value;
}

tn_evolution_value *tn_evolution_value_add(tn_evolution_value *list, tn_evolution_value *value)
{
    if (!list || !value)
        return list ? list : value;
    list->last->next = value;
    list->last = value;
    return list;
}

void tn_evolution_unexpected(tn_evolution_reader *reader, tn_span span, const char *token)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "%s does not belong here", token);
    tn_help(reader->diagnostics, diagnostic, "write one setting a line, as `population 500`");
}

void tn_evolution_unclosed_text(tn_evolution_reader *reader, tn_span span)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "this text has no closing quote");
    tn_help(reader->diagnostics, diagnostic, "a text ends with `\"` on the line that it begins on");
}

void tn_evolution_unclosed_block(tn_evolution_reader *reader, tn_span span)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, span, "the evolution block is not closed");
    tn_note(reader->diagnostics, diagnostic, &reader->open, "it begins here");
    tn_help(reader->diagnostics, diagnostic, "write `}` after the last setting");
}

bool tn_has_evolution(const char *text)
{
    text += tn_text_mark(text, strlen(text));
    for (const char *at = text; (at = strcasestr(at, "evolution")); at++) {
        const char *next = at + 9, *line = at;
        while (*next == ' ' || *next == '\t' || *next == '\r' || *next == '\n')
            next++;
        while (line > text && (line[-1] == ' ' || line[-1] == '\t'))
            line--;
        if (*next == '{' && (line == text || line[-1] == '\n'))
            return true;
    }
    return false;
}

bool tn_is_evolution(const char *path, const char *text)
{
    size_t length = strlen(path);
    return length >= 6 && strcmp(path + length - 6, ".study") == 0 && tn_has_evolution(text);
}
