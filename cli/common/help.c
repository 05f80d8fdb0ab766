/* Prints help: of a command, and the list of all. */
#include "cli/common/help.h"

#include <string.h>

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

void tn_help_overview(FILE *out)
{
    fputs("tartan: rules for plans, compiled and run\n\nUsage:\n  tartan COMMAND [options] FILE...\n  tartan help "
          "COMMAND\n  tartan --version\n\nCommands:\n",
          out);
    for (size_t i = 0; i < tn_commands_count; i++)
        fprintf(out, "  %-14s%s\n", tn_commands[i]->name, tn_commands[i]->summary);
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
