/* Ranks by MPI: the one place that calls it. */
#ifndef TARTAN_MPI_RANKS_H
#define TARTAN_MPI_RANKS_H

#include "runtime/ranks/ranks.h"

/* Joins the other processes of the job. NULL where MPI cannot be used; it says why itself. Leave by tn_mpi_leave. */
const tn_ranks *tn_mpi_join(void);

/* Together: leaves the job. NULL is fine. */
void tn_mpi_leave(const tn_ranks *ranks);

#endif
