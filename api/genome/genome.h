/* What the files of the C interface to genomes share. */
#ifndef TARTAN_API_GENOME_GENOME_H
#define TARTAN_API_GENOME_GENOME_H

#include "api/base/api.h"
#include "runtime/genome/mapping/mapper.h"
#include "runtime/genome/mapping/tree.h"

struct tartan_mapper {
    const tn_grammar *grammar; /* borrowed */
    tn_mapper *mapper;
    tn_mapping last;
    bool recorded; /* the last mapping has its derivation */
    tartan_node *nodes;
};

/* tartan_grammar is tn_grammar under its public name. */
static inline const tn_grammar *tn_api_grammar(const tartan_grammar *grammar)
{
    return (const tn_grammar *)(const void *)grammar;
}

/* The caller's options (NULL: the grammar's own) as the mapper's. */
tartan_status tn_api_map_options(const tn_grammar *grammar, const tartan_map_options *given,
                                 tn_mapping_options *options, tartan_error *error);

/* TARTAN_INVALID where the mapper's last mapping has no derivation. */
tartan_status tn_api_derivation(const tartan_mapper *mapper, tartan_error *error);

#endif
