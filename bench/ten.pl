% The ten rules as a Prolog programmer would write them, timed over plan/1 facts: swipl -q -g main ten.pl FOLDER
%
% A tray is tray(Width, Height, Public, Great, Machine, Body, Bay). Prints seconds a plan, and writes each plan's bits to FOLDER/prolog.txt.

width(tray(W, _, _, _, _, _, _), W).
single(tray(_, single, _, _, _, _, _)).
public(tray(_, _, public, _, _, _, _)).
great(tray(_, _, _, great, _, _, _)).
machine_dense(tray(_, _, _, _, 'dense:4\'', _, _)).
machine_empty(tray(_, _, _, _, empty, _, _)).
body_dense(tray(_, _, _, _, _, 'dense:12\'', _)).
body_open(tray(_, _, _, _, _, 'open:12\'', _)).

narrow(T) :- width(T, '4\'').
main(T) :- width(T, '12\'').
dense(T) :- machine_dense(T), !.
dense(T) :- body_dense(T).
clear_main(T) :- main(T), machine_empty(T), body_open(T).

adjacent(A, B, Plan) :- append(_, [A, B|_], Plan).
count(Goal, Plan, N) :- include(Goal, Plan, Found), length(Found, N).

rule(0, P) :- adjacent(A, B, P), narrow(A), narrow(B).
rule(1, [T|_]) :- body_dense(T).
rule(1, P) :- last(P, T), body_dense(T).
rule(2, P) :- \+ ( member(T, P), main(T), body_dense(T) ), count(main_empty, P, N), N > 1.
rule(3, P) :- append(Before, [T|After], P), single(T), \+ dense(T), reverse(Before, Back), clear_way(Back), clear_way(After).
rule(4, P) :- append(_, [A, B, C|_], P), machine_empty(A), machine_empty(B), machine_empty(C).
rule(5, P) :- adjacent(A, B, P), ( great(A), body_dense(B) ; body_dense(A), great(B) ).
rule(6, P) :- count(public, P, N), N =\= 1.
rule(7, P) :- append(_, [_, T, _|_], P), public(T).
rule(8, P) :- append(_, [A|Rest], P), main(A), machine_dense(A), next_main(Rest).
rule(9, P) :- append(Before, [T|After], P), great(T), \+ public(T), reverse(Before, Back), far_from_public(Back), far_from_public(After).

main_empty(T) :- main(T), machine_empty(T).

% No dense tray this way, or two clear main trays before it.
clear_way(Way) :- append(Between, [D|_], Way), dense(D), !, count(clear_main, Between, N), N >= 2.
clear_way(_).

next_main([T|_]) :- main(T), machine_dense(T), !.
next_main([T|Rest]) :- \+ narrow(T), next_main(Rest).

far_from_public(Way) :- append(Between, [T|_], Way), public(T), !, length(Between, N), N >= 3.
far_from_public(_).

mask(Plan, Mask) :- findall(Bit, ( between(0, 9, I), once(rule(I, Plan)), Bit is 1 << I ), Bits), sum_list(Bits, Mask).

any(Plan, Any) :- ( rule(_, Plan) -> Any = 1 ; Any = 0 ).

main :-
    current_prolog_flag(argv, [Folder|_]),
    atom_concat(Folder, '/plans.pl', Facts),
    consult(Facts),
    findall(P, plan(P), Plans),
    length(Plans, Count),
    time_goal(all, mask, Plans, Count),
    time_goal(any, any, Plans, Count),
    maplist(mask, Plans, Masks),
    atom_concat(Folder, '/prolog.txt', Out),
    setup_call_cleanup(open(Out, write, Stream), forall(member(M, Masks), format(Stream, "~d~n", [M])), close(Stream)),
    halt.

% Prints the work, "prolog" and the median seconds a plan of three runs.
time_goal(Work, Goal, Plans, Count) :-
    findall(Seconds, ( between(1, 3, _), run(Goal, Plans, Seconds) ), Times),
    msort(Times, [_, Median, _]),
    Each is Median / Count,
    format("~w prolog ~12f~n", [Work, Each]).

run(Goal, Plans, Seconds) :-
    statistics(cputime, Start),
    maplist(Goal, Plans, _),
    statistics(cputime, End),
    Seconds is End - Start.
