/* The beginning of exported Prolog programs, and the names that they may not define. */
#include <string.h>

#include "runtime/plan/text/prolog_writing.h"

/* The judgements of docs/plan-language.md that are not a rule's own. w(N, Plan) is a plan of N trays, [I, J) a stretch
 * of it. */
const char tn_prolog_prelude[] =
    "plan_of(Trays, w(N, Plan)) :- Plan =.. [plan|Trays], functor(Plan, _, N).\n"
    "tray_at(w(_, Plan), I, Tray) :- K is I + 1, arg(K, Plan, Tray).\n"
    "\n"
    "from_to(I, J, I) :- I =< J.\n"
    "from_to(I, J, K) :- I < J, I1 is I + 1, from_to(I1, J, K).\n"
    "\n"
    "one_of(X, [X|_]) :- !.\n"
    "one_of(X, [_|Xs]) :- one_of(X, Xs).\n"
    "\n"
    "stretch(I, J, A, B) :- Last is J - 1, from_to(I, Last, A), A1 is A + 1, from_to(A1, J, B).\n"
    "somewhere(Part, W, I, J) :- stretch(I, J, A, B), call(Part, W, A, B), !.\n"
    "\n"
    "% Parts side by side; may(Part) can be left out.\n"
    "side_by_side([], _, I, I).\n"
    "side_by_side([may(Part)|Parts], W, I, J) :- side_by_side([Part|Parts], W, I, J), !.\n"
    "side_by_side([may(_)|Parts], W, I, J) :- !, side_by_side(Parts, W, I, J).\n"
    "side_by_side([Part|Parts], W, I, J) :-\n"
    "    needed(Parts, R), Last is J - R, I1 is I + 1, from_to(I1, Last, C), call(Part, W, I, C),\n"
    "    side_by_side(Parts, W, C, J), !.\n"
    "needed([], 0).\n"
    "needed([may(_)|Parts], R) :- !, needed(Parts, R).\n"
    "needed([_|Parts], R) :- needed(Parts, R1), R is R1 + 1.\n"
    "\n"
    "at_beginning(_, I, _) :- I =:= 0.\n"
    "at_end(w(N, _), _, J) :- J =:= N.\n"
    "\n"
    "mirrored(Part, w(N, Plan), I, J) :-\n"
    "    Plan =.. [plan|Trays], reversed(Trays, [], Back), plan_of(Back, W), A is N - J, B is N - I, call(Part, W, A, "
    "B).\n"
    "reversed([], Back, Back).\n"
    "reversed([T|Ts], Done, Back) :- reversed(Ts, [T|Done], Back).\n"
    "\n"
    "every_tray(Part, W, I, J) :-\n"
    "    I < J, Last is J - 1, \\+ (from_to(I, Last, K), K1 is K + 1, \\+ call(Part, W, K, K1)).\n"
    "\n"
    "% The part several times side by side; each takes a tray at least.\n"
    "repeated(Least, Most, Part, W, I, J) :- repeated(Least, Most, 0, Part, W, I, J), !.\n"
    "repeated(Least, _, N, _, _, J, J) :- N >= Least.\n"
    "repeated(Least, Most, N, Part, W, I, J) :-\n"
    "    ( Most == inf -> true ; N < Most ), I < J, N1 is N + 1, R is max(0, Least - N1), Last is J - R, I1 is I + 1,\n"
    "    from_to(I1, Last, C), call(Part, W, I, C), repeated(Least, Most, N1, Part, W, C, J).\n"
    "\n"
    "count(_, _, J, J, 0) :- !.\n"
    "count(Part, W, I, J, N) :-\n"
    "    I1 is I + 1, count(Part, W, I1, J, M), ( call(Part, W, I, I1) -> N is M + 1 ; N = M ).\n"
    "\n"
    "sum(_, _, _, J, J, 0) :- !.\n"
    "sum(Field, Part, W, I, J, S) :-\n"
    "    I1 is I + 1, sum(Field, Part, W, I1, J, R),\n"
    "    ( call(Part, W, I, I1) -> tray_at(W, I, Tray), arg(Field, Tray, V), length_of(Field, V, L), S is R + L ; S = "
    "R ).\n"
    "\n"
    "% Single trays, each with what its tally says.\n"
    "singles(_, _, _, J, J, 0) :- !.\n"
    "singles(Part, Tally, W, I, J, S) :-\n"
    "    I1 is I + 1, singles(Part, Tally, W, I1, J, R),\n"
    "    ( call(Part, W, I, I1) -> tray_at(W, I, Tray), call(Tally, Tray, L), S is R + L ; S = R ).\n"
    "\n"
    "present(Part, W, I, J, N) :- ( somewhere(Part, W, I, J) -> N = 1 ; N = 0 ).\n"
    "\n"
    "same_both_ways(_, _, I, J) :- I + 1 >= J, !.\n"
    "same_both_ways(Field, W, I, J) :-\n"
    "    I1 is I + 1, J1 is J - 1, tray_at(W, I, A), tray_at(W, J1, B), arg(Field, A, V), arg(Field, B, V),\n"
    "    same_both_ways(Field, W, I1, J1).\n"
    "\n"
    "starts(Part, W, I, J, N) :- starts(Part, W, I, I, J, N).\n"
    "starts(_, _, _, J, J, 0) :- !.\n"
    "starts(Part, W, I, K, J, N) :-\n"
    "    K1 is K + 1, starts(Part, W, I, K1, J, M),\n"
    "    ( from_to(K1, J, B), call(Part, W, K, B) -> N is M + 1 ; N = M ).\n"
    "\n"
    "% Some source such that what separates it from every destination meets the separator.\n"
    "distance(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J), W = w(N, _),\n"
    "    \\+ ( stretch(0, N, A, B), call(Destination, W, A, B), gap(I, J, A, B, G, H), \\+ call(Separator, W, G, H) "
    ").\n"
    "% Some destination, or every one, that shares no tray with the source is at a gap that meets the separator.\n"
    "near(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J), around(Destination, W, I, J, G, H), call(Separator, W, G, H), !.\n"
    "far(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J),\n"
    "    \\+ ( around(Destination, W, I, J, G, H), \\+ call(Separator, W, G, H) ).\n"
    "around(Destination, W, I, J, G, H) :-\n"
    "    W = w(N, _), stretch(0, N, A, B), ( B =< I ; J =< A ), call(Destination, W, A, B), gap(I, J, A, B, G, H).\n"
    "gap(I, _, _, B, B, I) :- B =< I, !.\n"
    "gap(_, J, A, _, J, A) :- J =< A, !.\n"
    "gap(I, _, _, _, I, I).\n";

/* Built-in predicates of one argument (ISO/IEC 13211-1, Cor. 1 to 3), which a program may not define. */
static const char *const built_in[] = {
    "abolish",       "acyclic_term",    "assert",        "asserta",    "assertz",      "atom",
    "atomic",        "callable",        "call",          "close",      "compound",     "consult",
    "discontiguous", "dynamic",         "ensure_loaded", "float",      "flush_output", "get_byte",
    "get_char",      "get_code",        "ground",        "halt",       "include",      "initialization",
    "integer",       "is_list",         "listing",       "multifile",  "nl",           "nonvar",
    "not",           "number",          "once",          "op",         "peek_byte",    "peek_char",
    "peek_code",     "print",           "put_byte",      "put_char",   "put_code",     "read",
    "retract",       "retractall",      "set_input",     "set_output", "throw",        "var",
    "write",         "write_canonical", "writeq",
};

bool tn_prolog_built_in(const char *name)
{
    for (size_t i = 0; i < sizeof built_in / sizeof *built_in; i++)
        if (strcmp(built_in[i], name) == 0)
            return true;
    return false;
}
