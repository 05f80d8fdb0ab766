/* CaDiCaL behind its C face: no exception leaves this file. */
extern "C" {
#include "runtime/solver/solver.h"
}

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <new>

#include <cadical.hpp>

struct tn_solver {
    CaDiCaL::Solver cadical;
    int largest = 0; /* variable that a clause or an assumption has had: CaDiCaL knows no other */
};

namespace
{

class stopper : public CaDiCaL::Terminator
{
  public:
    explicit stopper(const tn_solver_limits *limits) : limits_(limits)
    {
    }
    bool terminate() override
    {
        return limits_->stops && limits_->stops(limits_->context);
    }

  private:
    const tn_solver_limits *limits_;
};

/* Runs a call that may ask for memory. */
template <typename call> tn_status guarded(call run, tn_error *error)
{
    try {
        run();
        return TN_OK;
    } catch (const std::bad_alloc &) {
        return tn_fail_memory(error);
    } catch (...) {
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the solver failed");
    }
}

tn_status make_solver(tn_solver **solver, tn_error *error)
{
    return guarded(
        [&] {
            *solver = new tn_solver;
            (*solver)->cadical.set("quiet", 1);
            (*solver)->cadical.set("lucky", 0); /* what is preferred is guessed first */
        },
        error);
}

void free_solver(tn_solver *solver)
{
    delete solver;
}

tn_status add_clause(tn_solver *solver, const int *literals, size_t count, tn_error *error)
{
    return guarded(
        [&] {
            for (size_t i = 0; i < count; i++) {
                solver->largest = std::max(solver->largest, std::abs(literals[i]));
                solver->cadical.add(literals[i]);
            }
            solver->cadical.add(0);
        },
        error);
}

tn_status prefer(tn_solver *solver, int literal, tn_error *error)
{
    return guarded(
        [&] {
            solver->largest = std::max(solver->largest, std::abs(literal));
            solver->cadical.phase(literal);
        },
        error);
}

tn_status solve(tn_solver *solver, const int *assumed, size_t count, const tn_solver_limits *limits,
                tn_solver_answer *answer, tn_error *error)
{
    stopper stop(limits);
    int result = 0;
    tn_status status = guarded(
        [&] {
            for (size_t i = 0; i < count; i++) {
                solver->largest = std::max(solver->largest, std::abs(assumed[i]));
                solver->cadical.assume(assumed[i]);
            }
            solver->cadical.limit("conflicts", (int)std::min<uint64_t>(limits->conflicts, INT_MAX));
            solver->cadical.connect_terminator(&stop);
            result = solver->cadical.solve();
            solver->cadical.disconnect_terminator();
        },
        error);
    *answer = result == 10 ? TN_SOLVER_YES : result == 20 ? TN_SOLVER_NO : TN_SOLVER_UNDECIDED;
    return status;
}

bool value_of(tn_solver *solver, int literal)
{
    int variable = std::abs(literal);
    bool is_true = variable <= solver->largest && solver->cadical.val(variable) > 0;
    return is_true == (literal > 0);
}

bool has_failed(tn_solver *solver, int assumed)
{
    return solver->cadical.failed(assumed);
}

} // namespace

const tn_solver_calls *tn_solver_cadical(tn_error *error)
{
    static const tn_solver_calls calls = {make_solver, free_solver, add_clause, prefer, solve, value_of, has_failed};
    (void)error;
    return &calls;
}
