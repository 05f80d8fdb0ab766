/* Finds the stretches of a genome that the subtrees of its derivation read. */
#include "runtime/genome/mapping/span.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

void tn_spans_clear(tn_spans *spans)
{
    free(spans->items);
    free(spans->open);
    *spans = (tn_spans){0};
}

static bool reserve(tn_spans *spans, size_t open)
{
    return tn_array_reserve(&spans->items, &spans->capacity, spans->count, 1, sizeof *spans->items) &&
           tn_array_reserve(&spans->open, &spans->open_capacity, open, 1, sizeof *spans->open);
}

bool tn_spans_find(const tn_mapping *mapping, tn_spans *spans)
{
    size_t open = 0;
    uint64_t read = 0;
    spans->count = 0;
    for (size_t i = 0; i < mapping->event_count; i++) {
        const tn_event *event = &mapping->events[i];
        if (event->kind == TN_EVENT_REPAIR)
            break;
        if (event->kind == TN_EVENT_END) {
            spans->items[spans->open[--open]].end = read;
            continue;
        }
        if (event->kind == TN_EVENT_PLACE) /* a subtree begins with its pair, which the next event reads the rest of */
            continue;
        uint64_t before = read;
        if (event->read != TN_NO_READ)
            read = event->read + 1;
        if (event->kind != TN_EVENT_EXPAND)
            continue;
        if (!reserve(spans, open))
            return false;
        spans->open[open++] = (uint32_t)spans->count;
        spans->items[spans->count++] = (tn_span_of){event->symbol, event->depth, (uint32_t)i, before, read};
    }
    return true;
}

bool tn_genome_straighten(const uint64_t *codons, size_t count, const tn_mapping *mapping, tn_genome *straight)
{
    size_t used = (size_t)mapping->used, length = used > count ? used : count;
    if (!tn_genome_reserve(straight, length))
        return false;
    for (size_t i = 0; i < length; i++)
        straight->codons[i] = codons[i % count];
    straight->count = length;
    return true;
}

bool tn_events_straighten(tn_event *events, size_t count, const uint64_t *codons, size_t codon_count, uint64_t used,
                          tn_genome *straight)
{
    size_t tail = used < codon_count ? codon_count - (size_t)used : 0;
    if (!tn_genome_reserve(straight, (size_t)used + tail))
        return false;
    straight->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (events[i].read == TN_NO_READ)
            continue;
        events[i].read = straight->count;
        straight->codons[straight->count++] = events[i].kind == TN_EVENT_PLACE ? 0 : events[i].codon;
    }
    if (tail)
        memcpy(straight->codons + straight->count, codons + used, tail * sizeof *codons);
    straight->count += tail;
    return true;
}

/* Which of the choices of its rule the production is, and of how many; false where it is none at that depth. */
static bool find_choice(const tn_grammar *g, uint32_t production, uint32_t depth, uint32_t max_depth, uint32_t *choice,
                        uint32_t *choices)
{
    const tn_rule *rule = &g->rules[g->productions[production].rule];
    *choice = production - rule->first;
    *choices = rule->count;
    if (g->dialect != TN_DIALECT_GENR8 || !max_depth || depth < max_depth || !rule->closed_count)
        return true;
    const uint32_t *closed = g->closed + rule->closed_first; /* ascending */
    uint32_t low = 0, high = *choices = rule->closed_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (closed[middle] < production)
            low = middle + 1;
        else
            high = middle;
    }
    *choice = low;
    return low < *choices && closed[low] == production;
}

bool tn_can_choose(const tn_grammar *g, uint32_t production, uint32_t depth, uint32_t max_depth)
{
    uint32_t choice, choices;
    return find_choice(g, production, depth, max_depth, &choice, &choices);
}

bool tn_choice_codon(const tn_grammar *g, uint32_t production, uint32_t depth, uint32_t max_depth, uint64_t *codon)
{
    uint32_t choice, choices;
    if (!find_choice(g, production, depth, max_depth, &choice, &choices))
        return false;
    if (*codon % choices == choice)
        return true;
    uint64_t base = *codon - *codon % choices;
    *codon = base > UINT64_MAX - choice ? choice : base + choice;
    return true;
}
