/* Keeps genomes, and reads and writes them as text. */
#include "runtime/genome/mapping/genome.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"

void tn_genome_clear(tn_genome *genome)
{
    free(genome->codons);
    *genome = (tn_genome){0};
}

bool tn_genome_reserve(tn_genome *genome, size_t count)
{
    return tn_array_reserve(&genome->codons, &genome->capacity, 0, count, sizeof *genome->codons);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == ',';
}

/* Reads the digits at *at; false if there is no number, or one past 64 bits. */
static bool read_codon(const char *line, size_t length, size_t *at, uint64_t *codon, bool *too_large)
{
    size_t begin = *at;
    *codon = 0;
    *too_large = false;
    while (*at < length && line[*at] >= '0' && line[*at] <= '9') {
        uint64_t digit = (uint64_t)(line[(*at)++] - '0');
        *too_large |= *codon > (UINT64_MAX - digit) / 10;
        *codon = *codon * 10 + digit;
    }
    return *at > begin && (*at == length || is_blank(line[*at])) && !*too_large;
}

static tn_status bad_codon(const char *line, size_t length, size_t begin, bool too_large, tn_error *error)
{
    size_t end = begin;
    while (end < length && !is_blank(line[end]))
        end++;
    int shown = end - begin > 40 ? 40 : (int)(end - begin);
    if (too_large)
        tn_fail(error, TN_INVALID, E_GENOME_CODON, "the codon %.*s does not fit 64 bits", shown, line + begin);
    else
        tn_fail(error, TN_INVALID, E_GENOME_SYNTAX, "`%.*s` is not a codon", shown, line + begin);
    tn_error_help(error, "codons are whole numbers from 0 to 18446744073709551615, separated by blanks");
    tn_error_place(error, 0, begin + 1, end + 1);
    return TN_INVALID;
}

tn_status tn_genome_read(const char *line, size_t length, tn_genome *genome, tn_error *error)
{
    genome->count = 0;
    for (size_t at = 0;;) {
        while (at < length && is_blank(line[at]))
            at++;
        if (at == length)
            return TN_OK;
        if (genome->count == TN_GENOME_CODONS_MAX) {
            tn_fail(error, TN_LIMIT, E_GENOME_TOO_LONG, "the genome has more than %u codons, the limit",
                    TN_GENOME_CODONS_MAX);
            return TN_LIMIT;
        }
        size_t begin = at;
        uint64_t codon;
        bool too_large;
        if (!read_codon(line, length, &at, &codon, &too_large))
            return bad_codon(line, length, begin, too_large, error);
        if (!tn_genome_reserve(genome, genome->count + 1))
            return tn_fail_memory(error);
        genome->codons[genome->count++] = codon;
    }
}

char *tn_genome_text(const tn_genome *genome)
{
    tn_buffer text = {0};
    tn_buffer_append(&text, "", 0);
    for (size_t i = 0; i < genome->count; i++)
        tn_buffer_printf(&text, i ? " %" PRIu64 : "%" PRIu64, genome->codons[i]);
    if (!text.failed && text.data)
        return text.data;
    free(text.data);
    return NULL;
}

/* ---- finds the stretches of a genome that the subtrees of its derivation read */

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

/* Which of the choices of its rule the production is, and of how many; false if it is none at that depth. */
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
