/* Changes a module as a hostile hand would: so that it still looks like one. */
#ifndef TARTAN_TESTS_FUZZ_MODULE_CHANGE_H
#define TARTAN_TESTS_FUZZ_MODULE_CHANGE_H

#include "tests/fuzz/module_draft.h"

/* One change of a kind, and at a place, that the seed decides: of an instruction, an operand, a term of code, a field,
 * a run's ends, a text; a record or a section gone, or a record twice. */
void change_draft(draft *d, uint64_t seed);

/* Changes a module's bytes a few times, most likely into another that verifies: *bytes, which the caller frees. false
 * where the bytes are no module that verifies, or nothing came of it. */
bool change_module(const uint8_t *data, size_t size, uint64_t seed, size_t most, uint8_t **bytes, size_t *bytes_size);

#endif
