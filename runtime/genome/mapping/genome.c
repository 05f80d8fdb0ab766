/* Keeps genomes, and reads and writes them as text. */
#include "runtime/genome/mapping/genome.h"

#include <inttypes.h>
#include <stdlib.h>

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

/* Reads the digits at *at; false where there is no number, or one past 64 bits. */
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
