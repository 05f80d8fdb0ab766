/* Makes random rewrite systems. */
#include "tests/support/test_system.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/random.h"

enum { TEXT_MAX = 1 << 14 };

typedef struct maker {
    uint64_t number, draws;
    uint32_t labels;
    FILE *out;
} maker;

/* From 0 to n - 1. */
static uint32_t below(maker *m, uint32_t n)
{
    return (uint32_t)(tn_random64(m->number, 77, m->draws++) % n);
}

static void label(maker *m)
{
    fprintf(m->out, " Edge%u", below(m, m->labels));
}

static void edge(maker *m)
{
    static const char *const ages[] = {"", "", "", "_i", "_i+1", "_i-1"};
    fputs(below(m, 6) == 0 ? " ~" : "", m->out);
    label(m);
    fputs(ages[below(m, 6)], m->out);
}

static void turns(maker *m, char sign, uint32_t times)
{
    for (uint32_t i = 0; i < times; i++)
        fprintf(m->out, " %c", sign);
}

/* Branches to the left and right, or anywhere; one inside another, or one after another. */
static void branches(maker *m)
{
    uint32_t times = 1 + below(m, 3);
    switch (below(m, 4)) {
    case 0:
        fputs(" [ [", m->out), turns(m, '+', times), edge(m), fputs(" ]", m->out);
        turns(m, '-', times), edge(m), fputs(" ]", m->out);
        break;
    case 1:
        fputs(" [", m->out), turns(m, "+-&^\\/"[below(m, 6)], times), turns(m, "+-"[below(m, 2)], 1), edge(m);
        fputs(" ]", m->out);
        break;
    default:
        fputs(" [", m->out), turns(m, '+', times), edge(m), fputs(" ] [", m->out);
        turns(m, '-', times), edge(m), fputs(" ]", m->out);
    }
}

/* A path that ends in the direction in which it began. */
static void path(maker *m, uint32_t depth)
{
    static const char there[] = "+-&^\\/", back[] = "-+^&/\\";
    uint32_t items = 1 + below(m, 3);
    for (uint32_t i = 0; i < items; i++) {
        uint32_t kind = below(m, 5);
        if (kind < 2 && depth > 0) {
            uint32_t axis = kind == 0 ? below(m, 2) : below(m, 6), times = 1 + below(m, 2);
            turns(m, there[axis], times), path(m, depth - 1), turns(m, back[axis], times);
        } else {
            edge(m);
        }
        if (below(m, 2))
            branches(m);
    }
}

static void alternatives(maker *m)
{
    uint32_t kind = below(m, 6), count = kind < 3 ? 1 : 2 + below(m, 2);
    for (uint32_t i = 0; i < count; i++) {
        fputs(i ? "\n->" : " ->", m->out);
        path(m, 2);
        if (kind < 4 && count > 1 && below(m, 3))
            fprintf(m->out, " Weight %u", below(m, 4));
        else if (kind >= 4 && (i + 1 < count || below(m, 2)))
            fprintf(m->out, " If i %c %d", "<>="[below(m, 3)], (int)below(m, 4) - 1);
    }
    fputc('\n', m->out);
}

static void rule(maker *m)
{
    uint32_t kind = below(m, 12);
    label(m);
    if (kind == 0) /* a chain */
        label(m), fputs(below(m, 2) ? " Edge0" : "", m->out);
    else if (kind < 3)
        fputs(" <", m->out), label(m);
    else if (kind < 5)
        fputs(" >", m->out), label(m);
    else if (kind == 5)
        fputs(" <", m->out), label(m), fputs(" >", m->out), label(m);
    alternatives(m);
}

char *test_system_text(uint64_t number)
{
    static const uint32_t angles[] = {90, 90, 60, 60, 45, 30, 72, 37};
    char *text = calloc(1, TEXT_MAX);
    if (!text)
        abort();
    maker m = {.number = number, .out = fmemopen(text, TEXT_MAX, "w")};
    if (!m.out)
        abort();
    m.labels = 1 + below(&m, 4);
    uint32_t corners = 3 + below(&m, 4), rules = 1 + below(&m, 5);
    for (uint32_t i = 0; i < corners; i++) {
        fputs(i ? " +" : "", m.out);
        fputs(below(&m, 5) == 0 ? " ~" : "", m.out);
        label(&m);
    }
    fputc('\n', m.out);
    for (uint32_t i = 0; i < rules; i++)
        rule(&m);
    fprintf(m.out, "Angle %u\nBranchAngle %u\n%s", angles[below(&m, 8)], 30 * (1 + below(&m, 5)),
            below(&m, 2) ? "Sync\n" : "");
    fclose(m.out);
    return text;
}
