/* What ranks agree on, by hearing what all have to say. */
#include "runtime/ranks/ranks.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define PIECE ((size_t)256 << 20) /* bytes that rank 0 tells at once */

void tn_gathered_clear(tn_gathered *all)
{
    free(all->bytes);
    free(all->begins);
    *all = (tn_gathered){0};
}

bool tn_ranks_any(const tn_ranks *ranks, bool so)
{
    if (!tn_ranks_several(ranks))
        return so;
    tn_gathered all;
    uint8_t mine = so;
    ranks->gather(ranks->context, &mine, 1, &all);
    bool any = memchr(all.bytes, 1, ranks->count) != NULL;
    tn_gathered_clear(&all);
    return any;
}

tn_status tn_ranks_agree(const tn_ranks *ranks, tn_status status, tn_error *error)
{
    if (!tn_ranks_several(ranks))
        return status;
    tn_gathered all;
    tn_error first = {0};
    if (status != TN_OK)
        first = *error;
    first.status = status;
    ranks->gather(ranks->context, &first, status == TN_OK ? 0 : sizeof first, &all);
    for (unsigned r = 0; r < ranks->count; r++) {
        if (all.begins[r + 1] == all.begins[r])
            continue;
        memcpy(error, all.bytes + all.begins[r], sizeof *error);
        status = error->status;
        break;
    }
    tn_gathered_clear(&all);
    return status;
}

/* ---- telling */

/* A piece of rank 0's bytes, which all get. */
static void tell_piece(const tn_ranks *ranks, uint8_t *bytes, size_t size)
{
    tn_gathered all;
    bool lead = ranks->rank == 0;
    ranks->gather(ranks->context, bytes, lead ? size : 0, &all);
    if (!lead)
        memcpy(bytes, all.bytes, size);
    tn_gathered_clear(&all);
}

tn_status tn_ranks_tell(const tn_ranks *ranks, uint8_t **bytes, size_t *size, tn_error *error)
{
    if (!tn_ranks_several(ranks))
        return TN_OK;
    uint64_t whole = *size;
    tell_piece(ranks, (uint8_t *)&whole, sizeof whole);
    uint8_t *told = ranks->rank == 0 ? *bytes : tn_array_new(whole, 1);
    tn_status status = told || whole == 0 ? TN_OK : tn_fail_memory(error);
    status = tn_ranks_agree(ranks, status, error);
    if (status != TN_OK) {
        if (ranks->rank != 0)
            free(told);
        return status;
    }
    for (size_t at = 0; at < whole; at += PIECE)
        tell_piece(ranks, told + at, whole - at < PIECE ? (size_t)(whole - at) : PIECE);
    if (ranks->rank != 0)
        free(*bytes);
    *bytes = told;
    *size = (size_t)whole;
    return TN_OK;
}

/* ---- comparing */

/* Each says its text and, behind a zero, the name of its machine. */
static tn_status compare(const tn_ranks *ranks, const tn_gathered *all, const char *what, tn_error *error)
{
    const char *first = (const char *)all->bytes;
    for (unsigned r = 1; r < ranks->count; r++) {
        const char *other = first + all->begins[r];
        if (strcmp(first, other) == 0)
            continue;
        tn_fail(error, TN_INVALID, E_RANKS_DIFFER,
                "%s is not the same on all ranks: rank 0 on %.60s has `%.100s`, and rank %u on %.60s has `%.100s`",
                what, first + strlen(first) + 1, first, r, other + strlen(other) + 1, other);
        tn_error_help(error, "give all machines the same files and the same Tartan");
        return TN_INVALID;
    }
    return TN_OK;
}

tn_status tn_ranks_same(const tn_ranks *ranks, const char *what, const char *text, tn_error *error)
{
    if (!tn_ranks_several(ranks))
        return TN_OK;
    tn_gathered all;
    size_t length = strlen(text) + 1, host = strlen(ranks->host) + 1;
    char *mine = malloc(length + host);
    tn_status status = mine ? TN_OK : tn_fail_memory(error);
    if (mine) {
        memcpy(mine, text, length);
        memcpy(mine + length, ranks->host, host);
    }
    status = tn_ranks_agree(ranks, status, error);
    if (status == TN_OK) {
        ranks->gather(ranks->context, mine, length + host, &all);
        status = compare(ranks, &all, what, error);
        tn_gathered_clear(&all);
    }
    free(mine);
    return status;
}
