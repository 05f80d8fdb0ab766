/* Prints help and writes manual pages: of a command, and of all. */
#include "cli/common/help.h"

#include <string.h>

#include "compiler/compile.h"

/* ---- manual pages */

/* Writes text so that roff takes none of it for its own: backslashes, minus signs, and dots or quotes that start a
 * line. */
static void write_text(const char *text, size_t size, FILE *out)
{
    for (size_t i = 0; i < size; i++) {
        bool starts_line = i == 0 || text[i - 1] == '\n';
        if (starts_line && (text[i] == '.' || text[i] == '\''))
            fputs("\\&", out);
        if (text[i] == '\\')
            fputs("\\e", out);
        else if (text[i] == '-')
            fputs("\\-", out);
        else
            fputc(text[i], out);
    }
}

static void write_all(const char *text, FILE *out)
{
    write_text(text, strlen(text), out);
}

/* Each line of `text` that is not empty with a macro or words before it, and what stands between two of them. */
static void write_manual_lines(const char *before, const char *text, const char *between, FILE *out)
{
    for (bool first = true; *text;) {
        size_t size = strcspn(text, "\n");
        if (size) {
            fputs(first ? "" : between, out);
            fputs(before, out);
            write_text(text, size, out);
            fputc('\n', out);
            first = false;
        }
        text += size + (text[size] == '\n');
    }
}

static void write_head(const char *page, const char *name, const char *summary, FILE *out)
{
    fprintf(out, ".TH %s 1 \"" TARTAN_DATE "\" \"tartan " TARTAN_VERSION "\"\n.SH NAME\n", page);
    write_all(name, out);
    fputs(" \\- ", out);
    write_all(summary, out);
    fputs("\n.SH SYNOPSIS\n", out);
}

static void write_manual_option(const tn_option *option, FILE *out)
{
    fputs(".TP\n", out);
    if (option->letter)
        fprintf(out, "\\fB\\-%c\\fR, ", option->letter);
    fputs("\\fB\\-\\-", out);
    write_all(option->name, out);
    fputs("\\fR", out);
    if (option->argument)
        fprintf(out, " \\fI%s\\fR", option->argument);
    fputc('\n', out);
    write_all(option->help, out);
    fputc('\n', out);
}

/* What is to be read beside a page: tartan(1) where it is not that one, and the notations. */
static void write_see_also(bool overview, FILE *out)
{
    fputs(".SH SEE ALSO\n", out);
    if (!overview)
        fputs(".BR tartan (1),\n", out);
    for (size_t i = 0; i < tn_notation_count; i++)
        if (tn_notations[i].manual[0])
            fprintf(out, ".BR tartan\\-%s (5),\n", tn_notations[i].manual);
    fputs(".BR tartan\\-house (5),\n", out); /* the part of .plan files that is about houses */
    fputs(".BR tartan\\-plans (5)\n", out);  /* of files that are no rules */
}

void tn_manual_overview(const tn_commands *commands, FILE *out)
{
    write_head("TARTAN", "tartan", "rules for plans, compiled and run", out);
    fputs(".B tartan\n.I COMMAND\n[options] \\fIFILE\\fR...\n.SH COMMANDS\n", out);
    for (size_t i = 0; i < commands->count; i++) {
        fprintf(out, ".TP\n\\fBtartan\\-%s\\fR(1)\n", commands->items[i]->name);
        write_all(commands->items[i]->summary, out);
        fputc('\n', out);
    }
    fputs(".SH ENVIRONMENT\n.TP\n.B TARTAN_PATH\nfolders, separated by colons, where\n.B use \\(dqname\\(dq\nlooks "
          "before the "
          "installed rule files\n.TP\n.B NO_COLOR\nno colours, where it is not empty\n.SH EXIT STATUS\n0 done; 1 the "
          "rules or the input "
          "are wrong, or a test failed; 2 wrong usage, or a part that this build lacks; 3 a file could not be read or "
          "written; 4 a limit was reached; "
          "70 an internal "
          "error; 130 interrupted.\n",
          out);
    write_see_also(true, out);
}

void tn_manual_command(const tn_command *command, FILE *out)
{
    char page[64], before[96];
    snprintf(page, sizeof page, "tartan-%s", command->name);
    write_head(page, page, command->summary, out);
    snprintf(before, sizeof before, ".B tartan %s\n", command->name);
    write_manual_lines(before, command->usage, ".br\n", out);
    fputs(".SH DESCRIPTION\n", out);
    write_manual_lines("", command->description, ".PP\n", out);
    fputs(".SH OPTIONS\n", out);
    for (size_t i = 0; i < command->option_count; i++)
        write_manual_option(&command->options[i], out);
    for (size_t i = 0; i < tn_common_option_count; i++)
        write_manual_option(&tn_common_options[i], out);
    fputs(".SH EXAMPLE\n.nf\n", out);
    write_all(command->example, out);
    fputs("\n.fi\n", out);
    write_see_also(false, out);
}

/* ---- help */

enum { WIDTH = 80, OPTION_INDENT = 26 };

/* Writes words wrapped at WIDTH; the first line starts at `column`, further lines are indented by `indent`. A newline
 * in the text ends a paragraph. Widths are counted in characters, not in bytes. */
static void write_wrapped(const char *text, size_t column, size_t indent, FILE *out)
{
    size_t start = column;
    while (*text) {
        if (*text == '\n') {
            fputc('\n', out);
            column = start = 0;
            text++;
            continue;
        }
        size_t bytes = strcspn(text, " \n"), width = 0;
        for (size_t i = 0; i < bytes; i++)
            width += ((unsigned char)text[i] & 0xc0) != 0x80;
        if (column > start && column + 1 + width > WIDTH) {
            fprintf(out, "\n%*s", (int)indent, "");
            column = start = indent;
        } else if (column > start) {
            fputc(' ', out);
            column++;
        }
        fwrite(text, 1, bytes, out);
        column += width;
        text += bytes;
        text += *text == ' ';
    }
    fputc('\n', out);
}

static void write_option(const tn_option *option, FILE *out)
{
    char left[96];
    int size = option->letter ? snprintf(left, sizeof left, "  -%c, --%s", option->letter, option->name)
                              : snprintf(left, sizeof left, "      --%s", option->name);
    if (option->argument)
        size += snprintf(left + size, sizeof left - (size_t)size, " %s", option->argument);
    fputs(left, out);
    if (size + 2 > OPTION_INDENT) {
        fputc('\n', out);
        size = 0;
    }
    fprintf(out, "%*s", OPTION_INDENT - size, "");
    write_wrapped(option->help, OPTION_INDENT, OPTION_INDENT, out);
}

/* Each line of `text` with something before it. */
static void write_lines(const char *before, const char *text, FILE *out)
{
    do {
        size_t size = strcspn(text, "\n");
        fprintf(out, "%s%s%.*s\n", before, size ? " " : "", (int)size, text);
        text += size + (text[size] == '\n');
    } while (*text);
}

void tn_help_overview(const tn_commands *commands, FILE *out)
{
    fputs("tartan: rules for plans, compiled and run\n\nUsage:\n  tartan COMMAND [options] FILE...\n  tartan help "
          "COMMAND\n  tartan --version\n\nCommands:\n",
          out);
    for (size_t i = 0; i < commands->count; i++)
        fprintf(out, "  %-14s%s\n", commands->items[i]->name, commands->items[i]->summary);
    fputs("\nA file of the standard library is named without folder and extension: lahave, square, genr8.\n"
          "\nExit codes: 0 done; 1 the rules or the input are wrong, or a test failed; 2 wrong usage;\n"
          "3 a file could not be read or written; 4 a limit was reached; 70 an internal error; 130 interrupted.\n",
          out);
}

void tn_help_command(const tn_command *command, FILE *out)
{
    char before[64];
    fprintf(out, "tartan %s: %s\n\nUsage:\n", command->name, command->summary);
    snprintf(before, sizeof before, "  tartan %s", command->name);
    write_lines(before, command->usage, out);
    fputc('\n', out);
    write_wrapped(command->description, 0, 0, out);
    fputs("\nOptions:\n", out);
    for (size_t i = 0; i < command->option_count; i++)
        write_option(&command->options[i], out);
    for (size_t i = 0; i < tn_common_option_count; i++)
        write_option(&tn_common_options[i], out);
    fputs("\nExample:\n", out);
    write_lines(" ", command->example, out);
}
