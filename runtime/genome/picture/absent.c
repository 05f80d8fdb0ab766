/* Pictures of breeding in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/genome/picture/plot.h"
#include "runtime/genome/picture/sheet.h"
#include "runtime/genome/picture/tree_draw.h"

tn_status tn_tree_draw(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, tn_picture *to,
                       tn_error *error)
{
    (void)grammar, (void)events, (void)tree, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a derivation", error);
}

tn_status tn_stats_plot(const tn_generation_stats *stats, size_t count, const char *title, tn_picture *to,
                        tn_error *error)
{
    (void)stats, (void)count, (void)title, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing how a run went", error);
}

tn_status tn_sentences_draw(const tn_individual *const *members, size_t count, const char *title, tn_picture *to,
                            tn_error *error)
{
    (void)members, (void)count, (void)title, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a generation", error);
}
