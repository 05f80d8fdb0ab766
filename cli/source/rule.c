/* tartan rule: a rule as a tree of its parts, its picture, and edits of it. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "compiler/common/lexical.h"
#include "compiler/common/source.h"

typedef struct rule_settings {
    tn_settings common;
    const char *output, *field, *by, *text;
    int operation; /* 0: none; otherwise one more than that of the request */
    bool depth, before, json;
    tn_option_number part, item, from, at, dpi;
} rule_settings;

static const rule_settings *settings_of(const tn_job *job)
{
    return (const rule_settings *)job->settings;
}

static const char *rule_of(const tn_job *job)
{
    return job->settings->operands.items[1];
}

/* ---- the tree */

/* A part, as deep as it is nested. */
static unsigned depth_of(const tn_rule_shown *shown, uint64_t part)
{
    unsigned depth = 0;
    while (shown->parts.items[part].has_parent) {
        part = shown->parts.items[part].parent;
        depth++;
    }
    return depth;
}

static void write_part(const tn_rule_shown *shown, const tn_rule_part_shown *part, FILE *out)
{
    fprintf(out, "%*s%" PRIu64 " %s", 2 * (int)depth_of(shown, part->number), "", part->number, part->kind);
    for (size_t i = 0; part->has_binds && i < part->binds.count; i++)
        fprintf(out, "%s %s", i ? "," : "", part->binds.items[i]);
    if (part->has_binds)
        fputs(" in", out);
    if (part->has_name)
        fprintf(out, " %s (%s)", part->name, part->means);
    if (part->has_relation)
        fprintf(out, " %s", part->relation);
    if (part->has_condition)
        fprintf(out, ": %s", part->condition);
    for (size_t i = 0; i < part->items.count; i++)
        fprintf(out, "%s%s", i ? ", " : ": ", part->items.items[i].text);
    if (strcmp(part->kind, "text") == 0)
        fprintf(out, ": %s", part->text);
    fputc('\n', out);
}

static void show_tree(tn_job *job)
{
    const tn_rule_tree_request request = {.rule = rule_of(job)};
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, tn_ask_rule_tree(&job->session, &request, &answer)) && tn_job_output(job, NULL, &output)) {
        const tn_rule_shown *shown = answer.value;
        if (settings_of(job)->json)
            tn_job_write_json(&answer, output.stream);
        for (size_t i = 0; !settings_of(job)->json && i < shown->parts.count; i++)
            write_part(shown, &shown->parts.items[i], output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

/* ---- the picture */

static void draw(tn_job *job, const char *path)
{
    const rule_settings *settings = settings_of(job);
    const tn_rule_draw_request request = {.rule = rule_of(job),
                                          .format = tn_picture_choice(path),
                                          .has_dpi = settings->dpi.given,
                                          .dpi = (uint64_t)settings->dpi.value};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &path, 1, false);
    tn_job_answered(job, tn_ask_rule_draw(&job->session, &request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

/* ---- an edit */

static tn_rule_edit_request request_of(tn_job *job)
{
    const rule_settings *s = settings_of(job);
    return (tn_rule_edit_request){.rule = rule_of(job),
                                  .operation = (unsigned)s->operation - 1,
                                  .has_part = s->part.given,
                                  .part = (uint64_t)s->part.value,
                                  .has_item = s->item.given,
                                  .item = (uint64_t)s->item.value,
                                  .field = s->field,
                                  .depth = s->depth,
                                  .by = s->by,
                                  .text = s->text,
                                  .has_from = s->from.given,
                                  .from = (uint64_t)s->from.value,
                                  .has_at = s->at.given,
                                  .at = (uint64_t)s->at.value,
                                  .before = s->before};
}

static size_t offset_of(const tn_lines *lines, const tn_text_position *position)
{
    return tn_lines_offset(lines, (size_t)position->line, (size_t)position->character);
}

/* The file's text with the edits, which are in its order. False where out of memory. */
static bool write_changed(const tn_source *source, const tn_changed_rule *changed, FILE *out)
{
    size_t mark = tn_text_mark(source->text, source->size), at = 0;
    tn_lines lines;
    if (!tn_lines_make(&lines, source->text + mark, source->size - mark))
        return false;
    fwrite(source->text, 1, mark, out);
    for (size_t i = 0; i < changed->edits.count; i++) {
        const tn_text_edit *edit = &changed->edits.items[i];
        fwrite(lines.text + at, 1, offset_of(&lines, &edit->range.start) - at, out);
        fputs(edit->newText, out);
        at = offset_of(&lines, &edit->range.end);
    }
    fwrite(lines.text + at, 1, lines.size - at, out);
    tn_lines_clear(&lines);
    return true;
}

static void deliver(tn_job *job, const tn_reply *answer)
{
    const rule_settings *settings = settings_of(job);
    const tn_changed_rule *changed = answer->value;
    tn_output output;
    if (changed->has_why_not && !settings->json) {
        tn_error error;
        tn_fail(&error, TN_INVALID, E_USAGE, "%.400s", changed->why_not);
        tn_job_fail(job, &error);
        return;
    }
    if (!tn_job_output(job, settings->output, &output))
        return;
    bool written = true;
    if (settings->json)
        tn_job_write_json(answer, output.stream);
    else
        written = write_changed(&job->opened.compilation.sources.files[0], changed, output.stream);
    if (written) {
        tn_job_commit(job, &output);
        return;
    }
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    tn_output_discard(&output);
}

static void edit(tn_job *job)
{
    const tn_rule_edit_request request = request_of(job);
    tn_reply answer;
    if (tn_job_answered(job, tn_ask_rule_edit(&job->session, &request, &answer)))
        deliver(job, &answer);
    tn_reply_clear(&answer);
}

/* ---- the command */

/* The changed text is one of plans, whatever other rule files there are. */
static bool names_plan(tn_job *job)
{
    const char *path = settings_of(job)->output, *ending = path ? strrchr(path, '.') : NULL;
    if (!path || (ending && strcmp(ending, ".plan") == 0))
        return true;
    tn_diagnostic *said = tn_job_usage(job, "the changed text cannot be written as %.200s", path);
    tn_help(tn_job_diagnostics(job), said, "end its name in .plan");
    return false;
}

/* Is what is given about an edit, or about a picture, and is that asked for? */
static bool goes_together(tn_job *job)
{
    const rule_settings *s = settings_of(job);
    const char *stray = s->part.given   ? "part"
                        : s->item.given ? "item"
                        : s->field      ? "field"
                        : s->depth      ? "depth"
                        : s->by         ? "by"
                        : s->text       ? "text"
                        : s->from.given ? "from"
                        : s->at.given   ? "at"
                        : s->before     ? "before"
                                        : NULL;
    if (!s->operation && stray)
        tn_job_usage(job, "--%s says how a rule is edited: give --edit OPERATION too", stray);
    else if (!s->operation && s->json && s->output)
        tn_job_usage(job, "with -o the rule is drawn, and --json lists its parts: give one of them");
    else if (s->dpi.given && (s->operation || !s->output))
        tn_job_usage(job, "--dpi is of a picture in pixels: give -o FILE.png too");
    else if (s->operation)
        return s->json || names_plan(job);
    else
        return !s->output || tn_job_writes(job, "the picture of a rule", s->output, TN_WRITES_PICTURES);
    return false;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    if (goes_together(&job) && tn_job_open(&job, common->operands.items[0])) {
        if (settings_of(&job)->operation)
            edit(&job);
        else if (settings_of(&job)->output)
            draw(&job, settings_of(&job)->output);
        else
            show_tree(&job);
    }
    return tn_job_end(&job);
}

#define SETTINGS rule_settings
static const tn_option options[] = {
    OUTPUT(output, TN_WRITES_PICTURES | TN_WRITES(RULES),
           "draw the rule, by the file's ending .svg, .png or .pdf; with --edit, write the changed text to FILE"),
    CHOICE("edit", 0, "OPERATION", operation,
           "none|step|set|clear|add|wrap|unwrap|join|insert|move|remove|condition|text|new",
           "edit the rule as a picture of it is edited"),
    NUMBER("part", 0, "N", part, 0, UINT32_MAX - 1,
           "the part that is edited, by its number; the whole rule unless given"),
    NUMBER("item", 0, "N", item, 0, UINT32_MAX - 1, "of set, clear and add: which item of the tray, from 0"),
    TEXT("field", 0, "NAME", field, "of step: the field whose next value the tray asks for"),
    FLAG("depth", 0, depth, "of step: the next depth of the zone, instead of its next fill"),
    TEXT("by", 0, "WORD", by, "of wrap: the box, such as not; of join: and, or"),
    TEXT("text", 0, "TEXT", text, "what is put or written there"),
    NUMBER("from", 0, "N", from, 0, UINT32_MAX - 1, "of move and join: the part that is moved there"),
    NUMBER("at", 0, "N", at, 0, UINT32_MAX - 1,
           "of insert and move: which of the parts it becomes, from 0; of unwrap: which stays; of new: the place in "
           "the text"),
    FLAG("before", 0, before, "of join: in front of the part, or above it"),
    NUMBER("dpi", 0, "N", dpi, 10, 2400, "of a .png: pixels an inch; 150 unless given"),
    OPTION_SET,
    FLAG("json", 0, json, "write JSON"),
};

const tn_command tn_command_rule = {
    .name = "rule",
    .summary = "show a rule as parts, draw them, edit it as a picture is edited",
    .usage = "FILE RULE [-o FILE.svg] [--edit OPERATION --part N ...] [--json]",
    .description =
        "Lists the parts of a rule with their numbers, each below the part that it is in; with -o draws the rule, "
        "where "
        "each part of an .svg has its number (data-part), and each sign of a tray the number of its field (data-item, "
        "data-depth). With --edit changes the rule's text as a click on its picture does, keeps its layout and its "
        "comments, and writes the whole file: step (a tray's next value of a field), set, clear and add (an item of a "
        "tray), wrap and unwrap (a box around a part), join (another part beside or below it), insert, move, remove, "
        "condition, text, new (a rule).",
    .example = "$ tartan rule lahave stranded\n"
               "$ tartan rule rules.plan stranded --edit wrap --part 3 --by not -o rules.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "FILE and RULE",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
