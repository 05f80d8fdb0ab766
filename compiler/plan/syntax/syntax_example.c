/* Finds the first word of a line, and how lines that begin with it are written. */
#include "compiler/plan/syntax/syntax_example.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *word, *feet, *metric; /* metric: NULL where it is the same */
} examples[] = {
    {"storey", "storey ground 9'", "storey ground 2.7m"},
    {"spine", "spine body", NULL},
    {"wall", "wall 8\"", "wall 200mm"},
    {"partition", "partition 4\"", "partition 100mm"},
    {"deck", "deck 10\"", "deck 250mm"},
    {"roof", "roof 8\"", "roof 200mm"},
    {"section", "section body roof = flat | gable(9:12)", NULL},
    {"void", "void cell(body, loft)", NULL},
    {"no", "no cell(body, loft)", NULL},
    {"function", "function kitchen at cell(body, ground)", NULL},
    {"opening", "opening door wide 2'8\" high 6'8\" passage", "opening door wide 800mm high 2m passage"},
    {"allow", "allow W204", NULL},
    {"flight", "flight stairs wide 3' rise 6\"..7 3/4\" going 10\"",
     "flight stairs wide 900mm rise 150mm..195mm going 250mm"},
    {"face", "face cell(kitchen) beside cell(hall) = open | door", NULL},
    {"tile", "tile bed for bedroom { against wall  item bed left 2'..7', back 0..6'8\" }",
     "tile bed for bedroom { against wall  item bed left 600mm..2.1m, back 0..2m }"},
    {"against", "against wall or window", NULL},
    {"keep", "keep side left 0..2', back 0..6'8\"", "keep side left 0..600mm, back 0..2m"},
    {"item", "item bed left 2'..7', back 0..6'8\", up 0..2'", "item bed left 600mm..2.1m, back 0..2m, up 0..600mm"},
    {"material", "material brick \"#a05040\" price 12 per sf for wall",
     "material brick \"#a05040\" price 120 per m2 for wall"},
    {"rule", "rule wide = tray(width > 8')", "rule wide = tray(width > 2.4m)"},
    {"library", "library rows using shed { trays 2..4 }", NULL},
    {"test", "test corner { match [8' | 4'] }", "test corner { match [2.4m | 1.2m] }"},
    {"schema", "schema shed { width = 4' | 8' }", "schema shed { width = 1.2m | 2.4m }"},
    {"trays", "trays 2..4", NULL},
    {"require", "require quantity(tray(8'), n >= 1)", NULL},
    {"prune", "prune tray(4') as narrow", "prune tray(1.2m) as narrow"},
    {"measure", "measure cost = 1200 * quantity(any)", NULL},
};

/* The unit that a length is spelt in which begins at a digit: 'f' for feet and inches, 'm' for metric ones, or 0. */
static char unit_of(const char *at)
{
    at += strspn(at, "0123456789.");
    if (*at == '\'' || *at == '"')
        return 'f';
    at += *at == 'c' || (*at == 'm' && at[1] == 'm');
    return *at == 'm' && !isalnum((unsigned char)at[1]) ? 'm' : 0;
}

/* Is the first length of the text metric? */
static bool is_metric(const char *text)
{
    char unit = 0, before = 0;
    for (const char *at = text; *at && !unit; before = *at++) {
        if (isdigit((unsigned char)*at) && !isalnum((unsigned char)before) && before != '.')
            unit = unit_of(at);
    }
    return unit == 'm';
}

const char *tn_syntax_example(const char *text, size_t at)
{
    size_t begin = at;
    while (begin > 0 && text[begin - 1] != '\n' && text[begin - 1] != '\r')
        begin--;
    while (text[begin] == ' ' || text[begin] == '\t')
        begin++;
    size_t size = 0;
    while (isalpha((unsigned char)text[begin + size]))
        size++;
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++)
        if (begin + size <= at && strlen(examples[i].word) == size &&
            strncasecmp(text + begin, examples[i].word, size) == 0)
            return examples[i].metric && is_metric(text) ? examples[i].metric : examples[i].feet;
    return NULL;
}
