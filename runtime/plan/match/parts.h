/* The parts of a rule, read back from its code: what an author wrote as tray, and, or, not, neighbour and so on, as a
 * tree. For explaining, drawing, coverage and export, which work on modules as on rule files.
 *
 * A tn_parts is immutable once read; it borrows the module. Parts are numbered from the root, 0; a part's own code (the
 * judgement M of docs/plan-language.md, or, for parts that are judged as a region, H) is one term: code_begin to
 * code_end. Where a part is asked for "somewhere in the region", an instruction SOMEWHERE follows that is not in it.
 */
#ifndef TARTAN_PLAN_MATCH_PARTS_H
#define TARTAN_PLAN_MATCH_PARTS_H

#include "runtime/module/module.h"

#define TN_NO_PART UINT32_MAX
#define TN_PARTS_DEPTH_MAX 1000u /* how deep parts may nest (E0703 past it); rule files nest less */

typedef enum tn_part_kind {
    TN_PART_TRAY,
    TN_PART_RULE, /* a rule by its name */
    TN_PART_AND,
    TN_PART_OR,
    TN_PART_NOT,
    TN_PART_NEIGHBOUR,
    TN_PART_SYMMETRIC, /* of its one part: as it is, or mirrored */
    TN_PART_QUANTITY,
    TN_PART_SUM,
    TN_PART_OCCURRENCES,
    TN_PART_MANY,
    TN_PART_REPEAT,     /* its one part, several times side by side */
    TN_PART_DISTANCE,   /* source, destination, separator */
    TN_PART_NEAR,       /* the same three: some destination that shares no tray with the source */
    TN_PART_FAR,        /* likewise: every such destination */
    TN_PART_WHERE,      /* a stretch, and what else it is */
    TN_PART_COMPARISON, /* of sums, or of a stretch with its mirror image: a leaf, what it counts is not opened */
    TN_PART_IMAGE,      /* a plan of another library lies above: a leaf, its clauses are not opened */
    TN_PART_HOUSE,      /* a question about a house (`cell`, `room`, `apart`): a leaf */
    TN_PART_KIND_COUNT
} tn_part_kind;

typedef struct tn_part {
    tn_part_kind kind;
    uint32_t code_begin, code_end; /* of its term */
    uint32_t root;                 /* offset of its last instruction, which has its place in the source */
    bool once;                     /* derived in one way, whatever it is made of */
    bool somewhere;                /* asked for somewhere in the region, not of the stretch as a whole */
    bool optional;                 /* in a neighbour: may be left out */
    bool beginning, end;           /* neighbour: tied to the plan's */
    uint32_t spec;                 /* tray: SPEC record */
    uint32_t rule;                 /* rule: RULE record; UINT32_MAX for a call of a rule with parameters */
    uint32_t function;             /* rule: the function called */
    uint32_t condition;            /* quantity, sum, occurrences: condition function */
    uint32_t field;                /* sum: FIELD record */
    uint32_t least, most;          /* repeat: how often; most 0: no matter how often */
    bool again;                    /* rule: of the same circle as the rule that it stands in */
    uint32_t parent, first, next;  /* parts; TN_NO_PART */
    uint32_t child_count;
} tn_part;

typedef struct tn_parts {
    const tn_module *module;
    tn_part *parts;
    uint32_t count;
    size_t capacity;
} tn_parts;

/* Reads the parts of a rule function (kind WHOLE or HOLDS). TN_INVALID (E0703) for code that is not what the compiler
 * makes of a rule. Clear in any case. */
tn_status tn_parts_read(const tn_module *module, uint32_t function, tn_parts *parts, tn_error *error);

/* The same of a rule that may ask about houses. A rule about houses that is named is a TN_PART_RULE without a record.
 */
tn_status tn_parts_read_house(const tn_module *module, uint32_t function, tn_parts *parts, tn_error *error);
void tn_parts_clear(tn_parts *parts);

/* The part's name in the language: "neighbour". */
const char *tn_part_word(tn_part_kind kind);

/* The part as its author wrote it, blanks and line ends as one blank each, cut off with "..." where it is too long;
 * what is not known is the part's word. */
#define TN_PART_TEXT_MAX 512u
void tn_part_text(const tn_parts *parts, uint32_t part, char *text, size_t size);

/* A stretch of a source file of the module's in the same way; empty where the module has no such text. */
void tn_source_text(const tn_module *module, uint32_t file, uint32_t begin, uint32_t end, char *text, size_t size);

/* Is the part's place in the source its parent's too, so that it is only there in the code (the trays that `total` or a
 * sum without `of` adds up, what is asked of the gap in `a within K of b`)? */
bool tn_part_unwritten(const tn_parts *parts, uint32_t part);

/* Is the part's place in the source its parent's too: a step of what is written as one (`implies`, `every`, `tray` with
 * numbers)? */
bool tn_part_is_step(const tn_parts *parts, uint32_t part);

/* The RULE record whose function (of either judgement) this is, or UINT32_MAX. */
uint32_t tn_function_rule(const tn_module *module, uint32_t function);

/* How many trays and rule names a part is made of, at least 1: the size that "largest part" goes by. */
uint32_t tn_part_size(const tn_parts *parts, uint32_t part);

#endif
