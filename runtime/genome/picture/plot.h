/* How a run went, as a picture. */
#ifndef TARTAN_GENOME_PICTURE_PLOT_H
#define TARTAN_GENOME_PICTURE_PLOT_H

#include "runtime/base/picture.h"
#include "runtime/genome/breeding/evolve.h"

/* Draws the best and the mean score as curves over the generations. */
tn_status tn_stats_plot(const tn_generation_stats *stats, size_t count, const char *title, tn_picture *to,
                        tn_error *error);

#endif
