/* How long houses take. Files are modules; the library is the last of the file's libraries of houses.
 *
 *   house count FILE...             all houses of each: seconds of all files together, then a line for each
 *   house plan FILE PLAN RUNS       the houses on one plan: without tiles, with tiles, seconds
 *   house unrank FILE RUNS          seconds of counting the library, and of a house by its rank when that is done
 *   house solids FILE LINE RUNS     seconds of a house's solids and their union's mesh; solids, triangles
 *   house vary FILE LINE RUNS       seconds of all its changes, and of one run of the interpreter for each alternative;
 *                                   alternatives, changes; where the plan has at most a million houses, the changes
 *                                   that change nothing else, and the houses that differ in one choice
 *   house glb FILE COUNT FOLDER     seconds of so many houses to GLB files, of drawing them at random before, and of
 *                                   writing the same bytes again; bytes
 *
 * Seconds are medians of the process's own time. */
#include <gmp.h>
#include <string.h>

#include "bench/bench.h"
#include "runtime/geometry/write.h"
#include "runtime/house/model/model.h"
#include "runtime/house/rank/rank.h"
#include "runtime/house/rule/change.h"

#define CLOCK CLOCK_PROCESS_CPUTIME_ID

typedef struct subject {
    tn_module *module;
    tn_schema *schema;
    tn_house_form form;
    const tn_house_library_record *library;
    tn_library *plans;
} subject;

static void must(tn_status status, const tn_error *error)
{
    if (status != TN_OK)
        stop(error->message);
}

static void read_subject(const char *path, subject *s)
{
    tn_error error = {0};
    *s = (subject){.module = load_module(path)};
    if (s->module->HOUSE_LIBRARY_count == 0)
        stop("the file has no library of houses");
    s->library = &s->module->HOUSE_LIBRARY_records[s->module->HOUSE_LIBRARY_count - 1];
    must(tn_schema_new(s->module, s->module->FORM_records[s->library->form].schema, 0, &s->schema, &error), &error);
    tn_form_ready(s->module, s->library->form, s->schema, &s->form);
}

static void make_plans(subject *s)
{
    tn_error error = {0};
    const tn_library_options options = {.threads = 1};
    must(tn_library_new(s->schema, s->library->plans, &options, &s->plans, &error), &error);
}

static void close_subject(subject *s)
{
    tn_library_free(s->plans);
    tn_schema_free(s->schema);
    tn_module_free(s->module);
}

static int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double median(double *times, size_t count)
{
    qsort(times, count, sizeof *times, compare);
    return times[count / 2];
}

static double *new_times(size_t count)
{
    double *times = malloc((count + 1) * sizeof *times);
    if (!times)
        stop("out of memory");
    return times;
}

static tn_houses *count_all(const subject *s)
{
    tn_houses *houses;
    tn_error error = {0};
    must(tn_houses_new(&s->form, s->library, s->plans, 0, &houses, &error), &error);
    return houses;
}

/* ---- count */

static void count_houses(const subject *s, mpz_t count)
{
    tn_houses *houses = count_all(s);
    tn_houses_count(houses, TN_ALL_LENGTHS, count);
    tn_houses_free(houses);
}

/* With the library of plans, which the reference makes too; it has read the files before. */
static double time_count(const char *path, mpz_t count)
{
    subject s;
    read_subject(path, &s);
    double begun = seconds(CLOCK);
    make_plans(&s);
    count_houses(&s, count);
    double took = seconds(CLOCK) - begun;
    close_subject(&s);
    return took;
}

static void bench_count(char **paths, size_t files)
{
    enum { RUNS = 101 }; /* some of them are much slower than others */
    double times[RUNS] = {0};
    mpz_t *counts = malloc(files * sizeof *counts);
    if (!counts)
        stop("out of memory");
    for (size_t f = 0; f < files; f++)
        mpz_init(counts[f]);
    for (int i = 0; i < RUNS; i++)
        for (size_t f = 0; f < files; f++)
            times[i] += time_count(paths[f], counts[f]);
    printf("%.9f\n", median(times, RUNS));
    for (size_t f = 0; f < files; f++) {
        gmp_printf("%Zd\n", counts[f]);
        mpz_clear(counts[f]);
    }
    free(counts);
}

/* ---- plan */

static tn_houses *count_on(const subject *s, const tn_plan *plan)
{
    const tn_houses_what what = {.only = plan->trays, .length = (uint32_t)plan->length};
    tn_houses *houses;
    tn_error error = {0};
    must(tn_houses_of(&s->form, s->library, s->plans, &what, 0, &houses, &error), &error);
    return houses;
}

static void bench_plan(const subject *s, const char *line, size_t runs)
{
    tn_plan plan = {0};
    tn_error error = {0};
    mpz_t count, faced;
    double *times = new_times(runs);
    mpz_inits(count, faced, NULL);
    must(tn_plan_parse_line(s->schema, line, strlen(line), 64, &plan, &error), &error);
    for (size_t i = 0; i < runs; i++) {
        double begun = seconds(CLOCK);
        tn_houses *houses = count_on(s, &plan);
        tn_houses_count(houses, TN_ALL_LENGTHS, count);
        tn_houses_faced(houses, faced);
        tn_houses_free(houses);
        times[i] = seconds(CLOCK) - begun;
    }
    gmp_printf("%Zd %Zd ", faced, count);
    printf("%.9f\n", median(times, runs));
    mpz_clears(count, faced, NULL);
    free(plan.trays);
    free(times);
}

/* ---- houses at random */

typedef struct drawn {
    tn_houses *all;
    tn_house_ranks *by_rank;
    mpz_t *ranks;
    size_t count;
    tn_tray *trays;
} drawn;

static void draw(const subject *s, size_t count, drawn *d)
{
    mpz_t bound;
    tn_error error = {0};
    mpz_init(bound);
    *d = (drawn){.all = count_all(s), .ranks = malloc((count + 1) * sizeof *d->ranks)};
    d->trays = malloc(((size_t)tn_library_max(s->plans) + 1) * sizeof *d->trays);
    if (!d->ranks || !d->trays)
        stop("out of memory");
    must(tn_house_ranks_new(d->all, &d->by_rank, &error), &error);
    for (size_t i = 0; i < count; i++)
        mpz_init(d->ranks[i]);
    tn_houses_count(d->all, TN_ALL_LENGTHS, bound);
    must(tn_ranks_sample(1, 0, bound, count, d->ranks, &d->count, &error), &error);
    if (d->count < count)
        stop("the library has not so many houses");
    mpz_clear(bound);
}

static void take(drawn *d, size_t i, tn_house *house)
{
    mpz_t rank;
    uint32_t length;
    tn_plan_houses *plan;
    tn_error error = {0};
    mpz_init_set(rank, d->ranks[i]);
    must(tn_house_ranks_find(d->by_rank, rank, d->trays, &length, &error), &error);
    must(tn_house_ranks_plan(d->by_rank, d->trays, length, &plan, &error), &error);
    must(tn_plan_houses_at(plan, rank, house, &error), &error);
    mpz_clear(rank);
}

static void drawn_clear(drawn *d)
{
    for (size_t i = 0; i < d->count; i++)
        mpz_clear(d->ranks[i]);
    free(d->ranks);
    free(d->trays);
    tn_house_ranks_free(d->by_rank);
    tn_houses_free(d->all);
}

/* Ranks ascend: they are taken in another order. */
static void bench_unrank(const subject *s, size_t runs)
{
    drawn d;
    double *times = new_times(runs), begun = seconds(CLOCK);
    draw(s, runs, &d);
    double counted = seconds(CLOCK) - begun; /* drawing numbers takes no time beside it */
    for (size_t i = 0; i < runs; i++) {
        tn_house house;
        begun = seconds(CLOCK);
        take(&d, i * 7919 % runs, &house);
        times[i] = seconds(CLOCK) - begun;
        tn_house_clear(&house);
    }
    printf("%.9f %.9f\n", counted, median(times, runs));
    drawn_clear(&d);
    free(times);
}

/* ---- solids */

static size_t make_mesh(const tn_house *house, tn_mesh *mesh)
{
    tn_solids solids = {0};
    tn_blocks blocks = {0};
    tn_error error = {0};
    must(tn_house_solids(house, &solids, &error), &error);
    must(tn_blocks_of(house, &solids, &blocks, &error), &error);
    must(tn_blocks_mesh(&blocks, TN_SOLID_COUNT, mesh, &error), &error);
    size_t count = solids.box_count + solids.prism_count;
    tn_blocks_clear(&blocks);
    tn_solids_clear(&solids);
    return count;
}

static void read_house(const subject *s, const char *line, tn_house *house)
{
    tn_error error = {0};
    must(tn_house_read(&s->form, line, strlen(line), 64, house, &error), &error);
}

static void bench_solids(const subject *s, const char *line, size_t runs)
{
    tn_house house;
    size_t solids = 0, triangles = 0;
    double *times = new_times(runs);
    read_house(s, line, &house);
    for (size_t i = 0; i < runs; i++) {
        tn_mesh mesh;
        double begun = seconds(CLOCK);
        solids = make_mesh(&house, &mesh);
        times[i] = seconds(CLOCK) - begun;
        triangles = mesh.face_count;
        tn_mesh_clear(&mesh);
    }
    printf("%.9f %zu %zu\n", median(times, runs), solids, triangles);
    tn_house_clear(&house);
    free(times);
}

/* ---- vary */

/* How many other values there are, one choice at a time. */
static size_t alternatives(const tn_house *house)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    tn_error error = {0};
    size_t count = 0;
    for (uint32_t i = 0; i < house->form->record->choice_count; i++)
        count += tn_form_choice(house->form, i)->shape_count - 1;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        tn_variants v;
        for (uint32_t f = 0; !house->cells[i].open && f < tn_form_functions(house->form); f++)
            count += f != house->cells[i].function && tn_cell_may(house, &house->cells[i], f);
        must(tn_tile_variants(house, i, &v, &error), &error);
        count += v.count > 0 ? v.count - 1 : 0;
        tn_variants_clear(&v);
    }
    for (size_t i = 0; i < house->face_count; i++)
        count += tn_face_options(house, &house->faces[i], kinds) - 1;
    return count;
}

/* As a program would that knows only how to judge a house's line: reads it, and asks every clause. */
static double judge_once(const subject *s, tn_house_rules *rules, const char *line)
{
    tn_house house;
    bool kept;
    tn_error error = {0};
    double begun = seconds(CLOCK);
    read_house(s, line, &house);
    must(tn_house_rules_start(rules, &house, &error), &error);
    must(tn_house_rules_keep(rules, s->library, &kept, &error), &error);
    tn_house_clear(&house);
    if (!kept)
        stop("the house is not in its library");
    return seconds(CLOCK) - begun;
}

typedef struct near_houses {
    const tn_house *house;
    size_t seen;   /* changes */
    size_t listed; /* of these, which leave all else as it is */
    size_t found;  /* houses of the library that differ in one choice */
} near_houses;

/* In how many choices two houses on one plan differ; many, where the choices are not the same. Tiles are compared by
 * number, which is right where all else is the same. */
static size_t differences(const tn_house *a, const tn_house *b)
{
    size_t shapes = 0, others = 0, tiles = 0;
    if (a->cell_count != b->cell_count || a->face_count != b->face_count)
        return SIZE_MAX;
    for (uint32_t i = 0; i < a->form->record->choice_count; i++)
        shapes += a->shapes[i] != b->shapes[i];
    for (size_t i = 0; i < a->cell_count; i++) {
        others += a->cells[i].function != b->cells[i].function;
        tiles += a->cells[i].variant != b->cells[i].variant;
    }
    for (size_t i = 0; i < a->face_count; i++)
        others += a->faces[i].kind != b->faces[i].kind;
    return shapes + others + tiles;
}

static tn_status count_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    near_houses *n = context;
    (void)change;
    (void)error;
    n->seen++;
    n->listed += differences(n->house, changed) == 1;
    return TN_OK;
}

static tn_status count_near(void *context, const tn_house *house, bool *stop_here, tn_error *error)
{
    near_houses *n = context;
    (void)stop_here;
    (void)error;
    n->found += differences(n->house, house) == 1;
    return TN_OK;
}

/* False: the library has too many houses on the plan to look at all of them. */
static bool find_near(const subject *s, near_houses *n)
{
    const tn_plan plan = {.trays = n->house->trays, .length = n->house->length};
    mpz_t count, first;
    tn_error error = {0};
    tn_plan_houses *on_plan;
    tn_houses *houses = count_on(s, &plan);
    mpz_inits(count, first, NULL);
    tn_houses_count(houses, TN_ALL_LENGTHS, count);
    bool few = mpz_cmp_ui(count, 1000000) <= 0;
    must(tn_plan_houses_new(houses, plan.trays, (uint32_t)plan.length, &on_plan, &error), &error);
    if (few)
        must(tn_plan_houses_each(on_plan, first, count_near, n, &error), &error);
    tn_plan_houses_free(on_plan);
    tn_houses_free(houses);
    mpz_clears(count, first, NULL);
    return few;
}

static void bench_vary(const subject *s, const char *line, size_t runs)
{
    tn_house house;
    tn_house_rules *rules;
    tn_error error = {0};
    double *varied = new_times(runs), *judged = new_times(runs);
    read_house(s, line, &house);
    near_houses n = {.house = &house};
    size_t others = alternatives(&house);
    must(tn_house_rules_new(&s->form, 0, &rules, &error), &error);
    for (size_t i = 0; i < runs; i++) {
        n.seen = n.listed = 0;
        double begun = seconds(CLOCK);
        must(tn_house_changes(&house, rules, s->library, TN_NO_CELL, count_change, &n, &error), &error);
        varied[i] = seconds(CLOCK) - begun;
        judged[i] = 0;
        for (size_t k = 0; k < others; k++)
            judged[i] += judge_once(s, rules, line);
    }
    printf("%.9f %.9f %zu %zu", median(varied, runs), median(judged, runs), others, n.seen);
    if (find_near(s, &n))
        printf(" %zu %zu", n.listed, n.found);
    puts("");
    tn_house_rules_free(rules);
    tn_house_clear(&house);
    free(varied);
    free(judged);
}

/* ---- GLB */

static char *path_of(const char *folder, size_t i)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%zu.glb", folder, i);
    return path;
}

static void write_glb(const tn_house *house, const char *path)
{
    tn_mesh mesh;
    tn_error error = {0};
    tn_mesh_style style = {.unit = TN_MESH_UNIT_M};
    FILE *out = fopen(path, "wb");
    make_mesh(house, &mesh);
    for (size_t i = 0; i < 3 * mesh.vertex_count; i++)
        mesh.positions[i] /= 1e9;
    mesh.group_names = calloc(mesh.group_count, sizeof *mesh.group_names);
    if (!out || !mesh.group_names)
        stop("cannot write");
    for (uint32_t i = 0; i < mesh.group_count; i++)
        snprintf(mesh.group_names[i], sizeof mesh.group_names[i], "%s", tn_solid_kind_text((tn_solid_kind)i));
    must(tn_mesh_write_glb(&mesh, &style, out, &error), &error);
    if (fclose(out) != 0)
        stop("cannot write");
    tn_mesh_clear(&mesh);
}

static double write_again(const char *folder, size_t count, size_t *bytes)
{
    double took = 0;
    *bytes = 0;
    for (size_t i = 0; i < count; i++) {
        uint8_t *data;
        size_t size;
        tn_error error = {0};
        must(tn_file_read(path_of(folder, i), SIZE_MAX, &data, &size, &error), &error);
        double begun = seconds(CLOCK);
        FILE *out = fopen(path_of(folder, i), "wb");
        if (!out || fwrite(data, 1, size, out) != size || fclose(out) != 0)
            stop("cannot write");
        took += seconds(CLOCK) - begun;
        *bytes += size;
        free(data);
    }
    return took;
}

static void bench_glb(const subject *s, size_t count, const char *folder)
{
    drawn d;
    size_t bytes;
    tn_house *houses = calloc(count + 1, sizeof *houses);
    if (!houses)
        stop("out of memory");
    draw(s, count, &d);
    double begun = seconds(CLOCK);
    for (size_t i = 0; i < count; i++)
        take(&d, i, &houses[i]);
    double taken = seconds(CLOCK);
    for (size_t i = 0; i < count; i++)
        write_glb(&houses[i], path_of(folder, i));
    double written = seconds(CLOCK);
    double again = write_again(folder, count, &bytes);
    printf("%.9f %.9f %.9f %zu\n", written - taken, taken - begun, again, bytes);
    for (size_t i = 0; i < count; i++)
        tn_house_clear(&houses[i]);
    free(houses);
    drawn_clear(&d);
}

static size_t number(const char *text)
{
    size_t n = strtoul(text, NULL, 10);
    if (n == 0)
        stop("a number of at least 1 is needed");
    return n;
}

int main(int argc, char **argv)
{
    if (argc > 2 && strcmp(argv[1], "count") == 0) {
        bench_count(argv + 2, (size_t)argc - 2);
        return 0;
    }
    if (argc < 4)
        stop("usage: house count FILE... | unrank FILE RUNS | plan, solids or vary FILE LINE RUNS | glb FILE COUNT "
             "FOLDER");
    subject s;
    read_subject(argv[2], &s);
    make_plans(&s);
    if (strcmp(argv[1], "unrank") == 0)
        bench_unrank(&s, number(argv[3]));
    else if (argc == 5 && strcmp(argv[1], "plan") == 0)
        bench_plan(&s, argv[3], number(argv[4]));
    else if (argc == 5 && strcmp(argv[1], "solids") == 0)
        bench_solids(&s, argv[3], number(argv[4]));
    else if (argc == 5 && strcmp(argv[1], "vary") == 0)
        bench_vary(&s, argv[3], number(argv[4]));
    else if (argc == 5 && strcmp(argv[1], "glb") == 0)
        bench_glb(&s, number(argv[3]), argv[4]);
    else
        stop("no such measurement");
    close_subject(&s);
    return 0;
}
