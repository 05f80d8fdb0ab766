#include "ask/rule/rule.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "compiler/compile.h"
#include "compiler/plan/syntax/program.h"
#include "runtime/base/nearest.h"

/* ---- reading */

tn_status tn_asked_rule_read(tn_session *session, tn_asked_rule *asked)
{
    const tn_opened *opened = session->opened;
    tn_error error;
    *asked = (tn_asked_rule){.rule = TN_NO_RECORD};
    if (!opened->compiled)
        return tn_session_refuse(session, "name the rule file that it was built from",
                                 "%.200s is a module, and only the text of a rule file has rules that are edited",
                                 opened->path);
    if (opened->compilation.notation != TN_NOTATION(plan))
        return tn_session_refuse(session, NULL, "%.200s is not a .plan file, and only those have rules with pictures",
                                 opened->path);
    asked->sources = &session->opened->compilation.sources;
    const tn_source *source = &asked->sources->files[0];
    tn_status status = tn_rule_text_read(source->text, source->size, &asked->text, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* The RULE record of a rule that stands in the file's own text. */
static uint32_t record_of(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED) &&
            strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return i;
    return TN_NO_RECORD;
}

/* The schema of a rule without a record: the one that it names, or the last that was declared. */
static uint32_t schema_named(const tn_module *module, const tn_ast_rule *rule)
{
    for (uint32_t i = 0; rule->using && i < module->SCHEMA_count; i++)
        if (strcmp(tn_text(module, module->SCHEMA_records[i].name), rule->using->text) == 0)
            return i;
    return (uint32_t)module->SCHEMA_count - 1;
}

static tn_status take_rule(tn_session *session, const tn_ast_rule *rule, tn_asked_rule *asked)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    asked->rule = record_of(module, rule->name->text);
    uint32_t schema =
        asked->rule != TN_NO_RECORD ? module->RULE_records[asked->rule].schema : schema_named(module, rule);
    tn_status status = tn_rule_tree_make(&asked->text, rule, &asked->tree, &error);
    if (status == TN_OK && module->SCHEMA_count == 0)
        return tn_session_refuse(session, NULL, "%.200s has no trays", session->opened->path);
    if (status == TN_OK)
        status = tn_schema_new(module, schema, 0, &asked->schema, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* Says that there is no such rule, and which may be meant. */
static tn_status refuse_name(tn_session *session, const tn_rule_text *text, const char *name)
{
    const char **names = calloc(text->tree->items.count + 1, sizeof *names);
    size_t count = 0;
    char help[TN_NAME_MAX + 40];
    for (TN_EACH(const tn_ast_top, item, text->tree->items))
        if (names && item->kind == TN_ITEM_RULE)
            names[count++] = ((const tn_ast_rule *)item)->name->text;
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    snprintf(help, sizeof help, "did you mean `%s`?", near ? near : "");
    tn_status status = tn_session_refuse(session, near ? help : NULL, "there is no rule `%.100s` in the text of %.200s",
                                         name, session->opened->path);
    free(names);
    return status;
}

tn_status tn_asked_rule_find(tn_session *session, const char *name, uint64_t at, tn_asked_rule *asked)
{
    tn_status status = tn_asked_rule_read(session, asked);
    if (status != TN_OK)
        return status;
    const tn_ast_rule *rule =
        name ? tn_rule_text_find(&asked->text, name) : tn_rule_text_at(&asked->text, tn_text_byte(&asked->text, at));
    if (!rule && name)
        return refuse_name(session, &asked->text, name);
    if (!rule)
        return tn_session_refuse(session, NULL, "no rule stands there");
    return take_rule(session, rule, asked);
}

void tn_asked_rule_clear(tn_asked_rule *asked)
{
    tn_rule_tree_clear(&asked->tree);
    tn_schema_free(asked->schema);
    if (asked->text.arena)
        tn_rule_text_clear(&asked->text);
}

/* ---- places and names */

size_t tn_text_byte(const tn_rule_text *text, uint64_t utf16)
{
    size_t at = tn_text_mark(text->text, text->size);
    while (at < text->size && utf16 > 0) {
        size_t size = tn_character_size(text->text + at, text->size - at);
        uint64_t units = size == 4 ? 2 : 1;
        utf16 -= units < utf16 ? units : utf16;
        at += size;
    }
    return at;
}

static bool is_among(tn_ast_list words, const char *name)
{
    for (TN_EACH(const tn_ast_word, word, words))
        if (strcmp(word->text, name) == 0)
            return true;
    return false;
}

static bool is_bound(const tn_rule_tree *tree, uint32_t part, const char *name)
{
    for (; part != TN_NO_RULE_PART; part = tree->parts[part].parent) {
        const tn_rule_part *it = &tree->parts[part];
        bool binds = it->kind == TN_RULE_PART_SOME || it->kind == TN_RULE_PART_EACH;
        if (binds && is_among(it->expr->names, name))
            return true;
    }
    return is_among(tree->rule->params, name);
}

/* Is it a rule with parameters of the text? */
static bool is_rule(const tn_rule_text *text, const char *name)
{
    const tn_ast_rule *rule = tn_rule_text_find(text, name);
    return rule != NULL;
}

const char *tn_asked_rule_means(const tn_session *session, const tn_asked_rule *asked, uint32_t part, const char *name)
{
    const tn_module *module = session->opened->module;
    const tn_program *program = session->opened->compilation.program;
    if (is_bound(&asked->tree, part, name))
        return "bound";
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return "rule";
    for (size_t i = 0; i < program->param_count; i++)
        if (strcmp(program->params[i].name, name) == 0)
            return "param";
    return is_rule(&asked->text, name) ? "rule" : "let";
}
