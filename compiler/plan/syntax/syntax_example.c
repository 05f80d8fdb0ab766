/* Finds the first word of a line, and how lines that begin with it are written. */
#include "compiler/plan/syntax/syntax_example.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *word, *example;
} examples[] = {
    {"storey", "storey ground 9'"},
    {"spine", "spine body"},
    {"wall", "wall 8\""},
    {"partition", "partition 4\""},
    {"deck", "deck 10\""},
    {"section", "section body roof = flat | gable(9:12)"},
    {"void", "void cell(body, loft)"},
    {"no", "no cell(body, loft)"},
    {"function", "function kitchen at cell(body, ground)"},
    {"opening", "opening door wide 2'8\" high 6'8\" passage"},
    {"allow", "allow W204"},
    {"flight", "flight stairs wide 3' rise 6\"..7 3/4\" going 10\""},
    {"face", "face cell(kitchen) beside cell(hall) = open | door"},
    {"tile", "tile bed for bedroom { against wall  item bed left 2'..7', back 0..6'8\" }"},
    {"item", "item bed left 2'..7', back 0..6'8\", up 0..2'"},
    {"material", "material brick \"#a05040\" price 12 per sf for wall"},
    {"rule", "rule wide = tray(width > 8')"},
    {"library", "library rows using shed { trays 2..4 }"},
    {"test", "test corner { match [8' | 4'] }"},
    {"schema", "schema shed { width = 4' | 8' }"},
    {"trays", "trays 2..4"},
    {"require", "require quantity(tray(8'), n >= 1)"},
    {"prune", "prune tray(4') as narrow"},
    {"measure", "measure cost = 1200 * quantity(any)"},
};

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
            return examples[i].example;
    return NULL;
}
