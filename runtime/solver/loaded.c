/* The solver of the part `search`, which is loaded when the first plans are searched. */
#include "runtime/base/part.h"
#include "runtime/solver/solver.h"

const tn_solver_calls *tn_solver_cadical(tn_error *error)
{
    __typeof__(tn_solver_cadical) *find =
        (__typeof__(find))tn_part_find(TN_WITH_SEARCH, "tn_solver_cadical", "searching for plans", error);
    return find ? find(error) : NULL;
}
