/* What lies around a vertex of the old map: may two branches be joined, or does an edge link their vertices already, or
 * could another face link them in the same pass (internal to the growth engine). */
#ifndef TARTAN_GROWTH_JOIN_AROUND_H
#define TARTAN_GROWTH_JOIN_AROUND_H

#include "runtime/growth/join/join.h"

/* Before this pass's joins: does an edge link the branches' vertices? Both lie in one face. */
bool tn_linked_before(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                      const tn_loop_branch *b);

/* Does another interior face touch both vertices, so that a join there would link them? */
bool tn_share_another_face(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                           const tn_loop_branch *b);

#endif
