/* Counts the sentences of grammars that have few. */
#include "runtime/genome/mapping/sentences.h"

#include <stdlib.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

typedef struct odometer {
    tn_mapper *mapper;
    tn_mapping_options options;
    uint64_t codons[TN_SENTENCE_CODONS_MAX], choices[TN_SENTENCE_CODONS_MAX];
    size_t read; /* codons of the derivation */
    bool ended;  /* it reads too many */
} odometer;

/* How many choices each codon has that was read. */
static void read_events(odometer *o, const tn_mapping *mapping)
{
    o->read = 0;
    for (size_t i = 0; i < mapping->event_count; i++) {
        const tn_event *event = &mapping->events[i];
        if (event->read >= TN_SENTENCE_CODONS_MAX)
            continue; /* TN_NO_READ, too */
        o->choices[event->read] = event->modulus;
        o->read = event->read + 1 > o->read ? (size_t)event->read + 1 : o->read;
    }
}

static tn_status derive(odometer *o, tn_mapping *mapping, tn_error *error)
{
    tn_status status = tn_mapper_derive(o->mapper, o->codons, TN_SENTENCE_CODONS_MAX, &o->options, mapping, error);
    o->ended = mapping->reason == TN_MAPPING_OUT_OF_CODONS || mapping->reason == TN_MAPPING_REPAIR_OUT_OF_CODONS;
    if (status == TN_OK)
        read_events(o, mapping);
    return status;
}

/* False: that was the last. */
static bool turn(odometer *o)
{
    while (o->read > 0) {
        size_t last = o->read - 1;
        if (o->codons[last] + 1 < o->choices[last]) {
            o->codons[last]++;
            return true;
        }
        o->codons[last] = 0;
        o->read = last;
    }
    return false;
}

static int compare_hashes(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

static size_t count_different(uint64_t *hashes, size_t count)
{
    size_t different = 0;
    qsort(hashes, count, sizeof *hashes, compare_hashes);
    for (size_t i = 0; i < count; i++)
        different += i == 0 || hashes[i] != hashes[i - 1];
    return different;
}

static tn_status count(odometer *o, size_t most, uint64_t *hashes, size_t *different, tn_error *error)
{
    size_t derived = 0, valid = 0;
    do {
        tn_mapping mapping;
        tn_status status = derive(o, &mapping, error);
        if (status != TN_OK)
            return status;
        if (o->ended || derived++ == most) {
            *different = SIZE_MAX;
            return TN_OK;
        }
        if (mapping.valid) {
            size_t size;
            const char *sentence = tn_mapping_sentence(&mapping, &size);
            hashes[valid++] = XXH3_64bits(sentence, size);
        }
    } while (turn(o));
    *different = count_different(hashes, valid);
    return TN_OK;
}

tn_status tn_count_sentences(const tn_grammar *grammar, const tn_mapping_options *options, size_t most, size_t *sum,
                             tn_error *error)
{
    odometer *o = calloc(1, sizeof *o);
    uint64_t *hashes = calloc(most + 1, sizeof *hashes);
    if (o) {
        o->options = *options;
        o->options.record = true;
        o->options.wraps = 0;
        o->mapper = tn_mapper_new(grammar);
    }
    tn_status status = o && hashes && o->mapper ? count(o, most, hashes, sum, error) : tn_fail_memory(error);
    if (o)
        tn_mapper_free(o->mapper);
    free(hashes);
    free(o);
    return status;
}
