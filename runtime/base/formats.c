/* Tells formats by the endings of files' names. */
#include "runtime/base/formats.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "runtime/base/nearest.h"

static const struct {
    const char *word, *endings;
    enum { CONTENT_TEXT, CONTENT_BINARY } content;
} formats[TN_FILE_FORMATS] = {
#define FORMAT(NAME, WORD, ENDINGS, CONTENT, HOLDS) {WORD, ENDINGS, CONTENT_##CONTENT},
#include "runtime/base/formats.def"
#undef FORMAT
};

/* Is it one of these words, which blanks separate? */
static bool is_among(const char *word, const char *words)
{
    for (size_t size = strlen(word), length; *words; words += length + (words[length] == ' ')) {
        length = strcspn(words, " ");
        if (length == size && strncasecmp(words, word, size) == 0)
            return true;
    }
    return false;
}

tn_file_format tn_file_format_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    for (int i = 0; dot && i < TN_FILE_FORMATS; i++)
        if (is_among(dot + 1, formats[i].endings))
            return (tn_file_format)i;
    return TN_FILE_OTHER;
}

const char *tn_file_format_word(tn_file_format format)
{
    return format < TN_FILE_FORMATS ? formats[format].word : "";
}

bool tn_file_format_is_text(tn_file_format format)
{
    return format < TN_FILE_FORMATS && formats[format].content == CONTENT_TEXT;
}

tn_status tn_file_format_named(const char *word, tn_file_formats among, tn_file_format *format, tn_error *error)
{
    const char *words[TN_FILE_FORMATS];
    char list[300];
    size_t count = 0;
    for (int i = 0; i < TN_FILE_FORMATS; i++) {
        if (!(among >> i & 1) || !formats[i].word[0])
            continue;
        words[count++] = formats[i].word;
        if (strcmp(formats[i].word, word) == 0) {
            *format = (tn_file_format)i;
            return TN_OK;
        }
    }
    tn_fail(error, TN_INVALID, E_USAGE, "there is no `%.60s` of this", word);
    tn_word_list(words, count, list, sizeof list);
    tn_error_help(error, "it is made as %s", list);
    return TN_INVALID;
}

/* ".svg, .png or .pdf": the first ending of each. */
static void list_endings(tn_file_formats writes, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < TN_FILE_FORMATS && used < size; i++) {
        tn_file_formats rest = (writes & ((UINT64_C(1) << TN_FILE_FORMATS) - 1)) >> i;
        if (rest & 1)
            used += (size_t)snprintf(text + used, size - used, "%s.%.*s",
                                     used == 0   ? ""
                                     : rest == 1 ? " or "
                                                 : ", ",
                                     (int)strcspn(formats[i].endings, " "), formats[i].endings);
    }
}

/* list: the endings of what is written. picture: is one asked for? */
static void help_endings(const char *list, tn_file_formats writes, bool picture, tn_error *error)
{
    bool text = writes & TN_WRITES_TEXT;
    const char *draws = text && picture ? "; plans and rules are drawn by `tartan draw`" : "";
    if (list[0])
        tn_error_help(error, "end its name in %s%s%s%s", list,
                      writes & TN_OF_PLANS_ALONE ? "; of plans also in .dxf" : "",
                      text                        ? "; text has another ending, or none"
                      : writes & TN_WRITES_FOLDER ? "; or name a folder"
                                                  : "",
                      draws);
    else if (text)
        tn_error_help(error, "what it writes is text: give the name another ending, or none%s", draws);
    else
        tn_error_help(error, "what it writes is a folder: name one");
}

tn_status tn_file_ending_check(const char *what, const char *path, tn_file_formats writes, tn_error *error)
{
    char list[240];
    tn_file_format format = tn_file_format_of(path);
    bool other = format == TN_FILE_OTHER, standard = strcmp(path, "-") == 0;
    tn_file_formats others = TN_WRITES_TEXT | TN_WRITES_ASKED | (standard ? TN_WRITES_STANDARD : TN_WRITES_FOLDER);
    if (other ? writes & others : writes >> format & 1)
        return TN_OK;
    if (other)
        tn_fail(error, TN_INVALID, E_USAGE, "the name %.200s does not say what is to be written", path);
    else
        tn_fail(error, TN_INVALID, E_USAGE, "%s cannot be written as %.200s", what, path);
    list_endings(writes & TN_OF_PLANS_ALONE ? writes & ~TN_WRITES(DXF) : writes, list, sizeof list);
    help_endings(list, writes, !other && TN_WRITES_PICTURES >> format & 1, error);
    return TN_INVALID;
}
