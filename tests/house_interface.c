/* Asks a library of houses through the C interface, as a program outside would: house_interface STDLIB FILE LIBRARY
 * Each line of standard input is a question: a word, and what it is asked with, tabs between. Answers are written as
 * the command writes them, as tests/cli/house_interface.sh holds them to that; an error is "error " and its sentence.
 */
#include "include/tartan/tartan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 4 };

/* A question, its words, and the library that it is asked. */
typedef struct question {
    tartan_house_library *library;
    char *words[WORDS];
} question;

typedef tartan_status answer(const question *q, tartan_error *error);

static void print_text(char *text)
{
    puts(text);
    tartan_text_free(text);
}

static tartan_status print_line(const tartan_house *house, tartan_error *error)
{
    char *line = NULL;
    tartan_status status = tartan_house_write(house, &line, error);
    if (status == TARTAN_OK)
        print_text(line);
    return status;
}

static tartan_status house_of(const question *q, const char *text, tartan_house **house, tartan_error *error)
{
    return strchr(text, ';') ? tartan_house_read(q->library, text, strlen(text), house, error)
                             : tartan_house_unrank(q->library, text, NULL, house, error);
}

/* count [LENGTH] */
static tartan_status count(const question *q, tartan_error *error)
{
    char *text = NULL;
    uint32_t length = q->words[1] ? (uint32_t)strtoul(q->words[1], NULL, 10) : TARTAN_ANY_LENGTH;
    tartan_status status = tartan_house_library_count(q->library, length, NULL, &text, error);
    if (status == TARTAN_OK)
        print_text(text);
    return status;
}

/* A plan that is asked about, if `text` is one. */
typedef struct asked_plan {
    uint32_t trays[64];
    tartan_on_plan plan;
    const tartan_on_plan *on; /* NULL: all plans */
} asked_plan;

static tartan_status read_plan(const question *q, const char *text, asked_plan *asked, tartan_error *error)
{
    *asked = (asked_plan){0};
    if (!text)
        return TARTAN_OK;
    asked->plan.trays = asked->trays;
    asked->on = &asked->plan;
    return tartan_plan_read(tartan_house_library_schema(q->library), text, strlen(text), asked->trays, 64,
                            &asked->plan.length, error);
}

/* on PLAN: how many houses are on it. */
static tartan_status count_on(const question *q, tartan_error *error)
{
    char *text = NULL;
    asked_plan asked;
    tartan_status status = read_plan(q, q->words[1], &asked, error);
    if (status == TARTAN_OK)
        status = tartan_house_library_count_on(q->library, asked.on, NULL, &text, error);
    if (status == TARTAN_OK)
        print_text(text);
    return status;
}

/* house HOUSE: its line. */
static tartan_status show(const question *q, tartan_error *error)
{
    tartan_house *house = NULL;
    tartan_status status = house_of(q, q->words[1], &house, error);
    if (status == TARTAN_OK)
        status = print_line(house, error);
    tartan_house_free(house);
    return status;
}

/* rank HOUSE, number HOUSE */
static tartan_status number(const question *q, tartan_error *error)
{
    tartan_house *house = NULL;
    char *text = NULL;
    tartan_status status = house_of(q, q->words[1], &house, error);
    if (status == TARTAN_OK)
        status = strcmp(q->words[0], "rank") == 0 ? tartan_house_rank(house, NULL, &text, error)
                                                  : tartan_house_number(house, NULL, &text, error);
    if (status == TARTAN_OK)
        print_text(text);
    tartan_house_free(house);
    return status;
}

static tartan_status print_all(const tartan_houses *houses, tartan_error *error)
{
    tartan_status status = TARTAN_OK;
    for (size_t i = 0; status == TARTAN_OK && i < tartan_houses_count(houses); i++)
        status = print_line(tartan_houses_house(houses, i), error);
    return status;
}

/* sample SEED COUNT [PLAN] */
static tartan_status sample(const question *q, tartan_error *error)
{
    tartan_houses *houses = NULL;
    asked_plan asked;
    tartan_status status = read_plan(q, q->words[3], &asked, error);
    if (status == TARTAN_OK)
        status = tartan_house_sample(q->library, asked.on, strtoull(q->words[1], NULL, 10),
                                     strtoul(q->words[2], NULL, 10), NULL, &houses, error);
    if (status == TARTAN_OK)
        status = print_all(houses, error);
    tartan_houses_free(houses);
    return status;
}

/* most MEASURE COUNT [PLAN], least MEASURE COUNT [PLAN]: each value and the house that has it. */
static tartan_status best(const question *q, tartan_error *error)
{
    tartan_houses *houses = NULL;
    const tartan_wish wish = {q->words[1], strcmp(q->words[0], "most") == 0};
    asked_plan asked;
    tartan_status status = read_plan(q, q->words[3], &asked, error);
    if (status == TARTAN_OK)
        status =
            tartan_house_best(q->library, asked.on, &wish, 1, strtoul(q->words[2], NULL, 10), NULL, &houses, error);
    for (size_t i = 0; status == TARTAN_OK && i < tartan_houses_count(houses); i++) {
        printf("%s\t", tartan_houses_value(houses, i, 0));
        status = print_line(tartan_houses_house(houses, i), error);
    }
    tartan_houses_free(houses);
    return status;
}

/* vary HOUSE [CELL]: each change, and the number of the house that it makes. */
static tartan_status vary(const question *q, tartan_error *error)
{
    static const char *const kinds[] = {"section", "function", "face", "tile"};
    tartan_house *house = NULL;
    tartan_houses *houses = NULL;
    tartan_status status = house_of(q, q->words[1], &house, error);
    if (status == TARTAN_OK)
        status = tartan_house_variants(house, q->words[2], NULL, &houses, error);
    for (size_t i = 0; status == TARTAN_OK && i < tartan_houses_count(houses); i++) {
        const tartan_house_change *change = tartan_houses_change(houses, i);
        char *made = NULL;
        status = tartan_house_number(tartan_houses_house(houses, i), NULL, &made, error);
        if (status == TARTAN_OK)
            printf("%s\t%s\t%s\t%s\t#%s\n", kinds[change->kind], change->where, change->from, change->to, made);
        tartan_text_free(made);
    }
    tartan_houses_free(houses);
    tartan_house_free(house);
    return status;
}

/* file FORMAT HOUSE [VIEW]: its bytes. */
static tartan_status file(const question *q, tartan_error *error)
{
    static const char *const formats[] = {"json", "csv", "parts.csv", "obj", "ply", "glb",
                                          "ifc",  "dxf", "svg",       "png", "pdf", "mtl"};
    tartan_house *house = NULL;
    tartan_house_drawing drawing = tartan_house_drawing_init();
    const char *view = q->words[3];
    void *bytes = NULL;
    size_t size = 0;
    int format = 0;
    while (strcmp(formats[format], q->words[1]) != 0)
        format++;
    drawing.views = &view;
    drawing.view_count = view != NULL;
    drawing.mtl = "written.mtl"; /* as beside written.obj of the command */
    tartan_status status = house_of(q, q->words[2], &house, error);
    if (status == TARTAN_OK)
        status = tartan_house_file(house, (tartan_house_format)format, &drawing, NULL, &bytes, &size, error);
    if (status == TARTAN_OK)
        fwrite(bytes, 1, size, stdout);
    tartan_bytes_free(bytes);
    tartan_house_free(house);
    return status;
}

static const struct {
    const char *word;
    answer *of;
} questions[] = {
    {"count", count},   {"on", count_on}, {"house", show}, {"rank", number}, {"number", number},
    {"sample", sample}, {"most", best},   {"least", best}, {"vary", vary},   {"file", file},
};

static void ask(question *q, char *line)
{
    tartan_error error = {0};
    line[strcspn(line, "\n")] = '\0';
    for (size_t i = 0; i < WORDS; i++) {
        q->words[i] = line && *line ? line : NULL;
        char *tab = line ? strchr(line, '\t') : NULL;
        if (tab)
            *tab = '\0';
        line = tab ? tab + 1 : NULL;
    }
    for (size_t i = 0; i < sizeof questions / sizeof *questions; i++)
        if (q->words[0] && strcmp(q->words[0], questions[i].word) == 0 && questions[i].of(q, &error) != TARTAN_OK)
            printf("error %s\n", error.message);
}

int main(int argc, char **argv)
{
    tartan_error error = {0};
    tartan_module *module = NULL;
    question q = {0};
    char line[4096];
    if (argc < 4 || argc > 5) {
        fputs("usage: house_interface STDLIB FILE LIBRARY [MAX-HOUSES]\n", stderr);
        return 2;
    }
    const char *folders[] = {argv[1]};
    tartan_compile_options options = tartan_compile_options_init();
    tartan_house_library_options which = tartan_house_library_options_init();
    options.folders = folders;
    options.folder_count = 1;
    which.name = argv[3];
    which.max_houses = argc > 4 ? strtoull(argv[4], NULL, 10) : 0;
    tartan_status status = tartan_compile_file(argv[2], &options, &module, &error);
    if (status == TARTAN_OK)
        status = tartan_house_library_open(module, &which, NULL, &q.library, &error);
    while (status == TARTAN_OK && fgets(line, sizeof line, stdin))
        ask(&q, line);
    if (status != TARTAN_OK)
        printf("error %s\n", error.message);
    tartan_house_library_free(q.library);
    tartan_module_free(module);
    return status == TARTAN_OK ? 0 : 1;
}
