% LaHave houses on one plan as a Prolog programmer would count them: swipl -q -g main house.pl FACTS.pl
%
% Functions of cells, then what is in the faces, as lahave-form says; then the clauses of lahave-complete, each as soon as it can be
% asked. The facts are of house_facts.py. Tiles and ways are left out. Prints how many houses there are and the seconds that counting took.

:- use_module(library(assoc)).
:- use_module(library(aggregate)).

% may(Function, Zone, Dense, Storey, Wide, Deep, Great, Public, Double)
may(entry, machine, yes, 0, W, _, _, _, _) :- W >= 96.
may(entry, bay, no, _, W, 48, _, _, _) :- W >= 96.
may(kitchen, machine, yes, 0, W, _, _, _, _) :- W >= 96.
may(bath, machine, yes, 0, W, _, _, _, _) :- W >= 96.
may(bath, machine, yes, 1, W, _, _, _, no) :- W >= 96.
may(bath, body, yes, 1, 96, _, _, _, _).
may(store, machine, yes, 0, _, _, _, _, _).
may(store, machine, yes, 1, _, _, _, _, no).
may(hearth, body, yes, 0, _, _, _, _, _).
may(stair, body, yes, _, _, 144, _, _, _).
may(cabinet, body, yes, _, _, _, _, _, _).
may(hall, body, no, 0, _, _, yes, _, _).
may(passage, body, no, _, 48, _, no, _, _).
may(dining, body, no, 0, W, _, no, _, _) :- W >= 96.
may(living, body, no, 0, W, _, no, _, _) :- W >= 96.
may(bedroom, body, no, _, W, _, no, no, _) :- W >= 96.
may(study, body, no, 1, W, _, no, _, _) :- W >= 96.
may(gallery, body, no, 1, _, _, yes, _, no).
may(seat, bay, no, _, _, _, _, _, _).

% Functions in order of cells: a list of Cell-Function, void where the cell is open to the one below.
functions(S, Functions) :-
    findall(I, cell(S, I, _, _, _, _, _, _, _, _), Cells),
    foldl(function(S), Cells, [], Reversed),
    reverse(Reversed, Functions).

function(S, I, Before, [I-F|Before]) :-
    cell(S, I, Zone, Storey, Wide, Deep, Dense, Great, Public, Double),
    ( is_void(Zone, Dense, Storey, Double) -> F = void ; may(F, Zone, Dense, Storey, Wide, Deep, Great, Public, Double) ).

is_void(body, no, 1, yes).

% ---- what is in a face: the first line that applies and of whose kinds one fits

two(A, B, List1, List2) :- memberchk(A, List1), memberchk(B, List2), !.
two(A, B, List1, List2) :- memberchk(B, List1), memberchk(A, List2).
one(A, B, List) :- ( memberchk(A, List) -> true ; memberchk(B, List) ).

% line(Relation, ZoneA-FunctionA, ZoneB-FunctionB, Kind)
line(along, machine-_, machine-_, wall).
line(along, Z-_, Y-_, wall) :- one(Z, Y, [bay]).
line(across, Z-F, Y-G, open) :- two(Z-F, Y-G, [bay-seat], [body-G, body-F]).
line(across, _-F, _-G, wall) :- one(F, G, [seat]).
line(across, _-F, _-G, open) :- two(F, G, [entry], [hall, living, dining, passage, stair, hearth, cabinet]).
line(across, _-F, _-G, open) :- two(F, G, [kitchen], [dining, hall]).
line(across, Z-F, Y-G, 'sliding-door') :- one(Z-F, Y-G, [machine-bath]), one(F, G, [passage, stair, hearth, cabinet, gallery]).
line(across, _-F, _-G, 'sliding-door') :- one(F, G, [store]).
line(across, Z-_, Y-_, wall) :- one(Z, Y, [machine]).
line(along, _-F, _-G, 'bath-door') :- two(F, G, [bath], [passage, stair, gallery, cabinet]).
line(_, _-F, _-G, wall) :- one(F, G, [bath]).
line(_, _-F, _-G, 'bed-door') :- two(F, G, [bedroom], [passage, gallery, stair, hearth, cabinet, living, study]).
line(_, _-F, _-G, wall) :- one(F, G, [bedroom]).
line(_, _-F, _-G, 'bed-door') :- one(F, G, [study]).
line(along, _-F, _-G, arch) :- one(F, G, [stair]).
line(along, body-_, body-_, open).

% line_outside(Zone, Storey, Function, Side, Kinds)
line_outside(machine, _, entry, back, [entrance]).
line_outside(bay, _, entry, front, [entrance]).
line_outside(_, _, entry, _, [strip]).
line_outside(_, _, store, _, [wall]).
line_outside(machine, _, _, _, [strip]).
line_outside(_, _, seat, front, [glass, window]).
line_outside(_, _, seat, _, [window]).
line_outside(_, _, F, _, [wall]) :- memberchk(F, [hearth, cabinet]).
line_outside(_, _, F, _, [strip]) :- memberchk(F, [stair, bath]).
line_outside(body, 1, _, back, [strip]).
line_outside(_, _, _, _, [window]).

% Every opening is low enough for both storeys.
fits(Long, Kind) :- wide(Kind, Wide), !, Long >= Wide + 6.
fits(_, _).
wide(entrance, 36).
wide(arch, 36).
wide('bed-door', 32).
wide('bath-door', 32).
wide('sliding-door', 32).
wide(window, 36).
wide(strip, 24).
wide(glass, 72).

kinds(Goal, Long, Kinds) :- call(Goal, All), include(fits(Long), All, Kinds), Kinds \== [], !.
kinds(_, _, [wall]).

between(_, _-A, _-B, _, [open]) :- two(A, B, [void], [void, gallery, passage]), !.
between(_, _-A, _-B, _, [wall]) :- one(A, B, [void]), !.
between(Relation, A, B, Long, [Kind]) :- line(Relation, A, B, Kind), fits(Long, Kind), !.
between(_, _, _, _, [wall]).

over(_, void, open) :- !.
over(stair, stair, dogleg) :- !.
over(_, _, floor).

% face(A, B, Kind), B of the outside: out(Side)
faces(S, Of, Faces) :-
    findall(choice(A, B, Kinds), ( beside(S, A, B, Relation, Long), placed(S, Of, A, F), placed(S, Of, B, G), between(Relation, F, G, Long, Kinds) ), Inner),
    findall(choice(A, out(Side), Kinds), ( outside(S, A, Side, Long), outer(S, Of, A, Side, Long, Kinds) ), Outer),
    findall(choice(A, B, [Kind]), ( above(S, A, B), get_assoc(A, Of, F), get_assoc(B, Of, G), over(F, G, Kind) ), Floors),
    append([Inner, Outer, Floors], Choices),
    maplist(choose, Choices, Faces).

placed(S, Of, A, Zone-F) :- cell(S, A, Zone, _, _, _, _, _, _, _), get_assoc(A, Of, F).
outer(S, Of, A, Side, Long, Kinds) :-
    cell(S, A, Zone, Storey, _, _, _, _, _, _),
    get_assoc(A, Of, F),
    kinds(line_outside(Zone, Storey, F, Side), Long, Kinds).
choose(choice(A, B, Kinds), face(A, B, Kind)) :- member(Kind, Kinds).

% ---- clauses that ask for functions alone

number_of(F, Functions, N) :- aggregate_all(count, member(_-F, Functions), N).

programme(Functions) :-
    number_of(entry, Functions, 1), number_of(kitchen, Functions, 1),
    number_of(bath, Functions, Baths), Baths >= 1, Baths =< 2,
    number_of(bedroom, Functions, Beds), Beds >= 2.

stairs(S, Functions) :-
    section(S, _, Storeys, _, _),
    ( Storeys =:= 1 -> double(no) ; true ),
    aggregate_all(count, ( member(I-stair, Functions), cell(S, I, _, 0, _, _, _, _, _, _) ), Stairs),
    Stairs =< 1,
    \+ half_stair(S, Functions).

half_stair(S, Functions) :-
    above(S, A, B), memberchk(A-F, Functions), memberchk(B-G, Functions), G \== void,
    ( F == stair, G \== stair ; G == stair, F \== stair ).

% ---- clauses that ask for faces

linked(Faces, A, B, Kinds) :- ( member(face(A, B, Kind), Faces) ; member(face(B, A, Kind), Faces) ), memberchk(Kind, Kinds).

% Every cell but stores and seats: a walk to the entry, between them not through bedrooms, baths, stores and kitchens.
joined(Functions, Faces) :-
    memberchk(E-entry, Functions),
    reach([E], [E], Functions, Faces, Reached),
    \+ ( member(I-F, Functions), \+ memberchk(F, [void, store, seat]), \+ memberchk(I, Reached) ).

reach([], Reached, _, _, Reached).
reach([A|Queue], Seen, Functions, Faces, Reached) :-
    findall(B, ( step(Faces, A, B), memberchk(B-F, Functions), F \== void, \+ memberchk(B, Seen) ), Found),
    sort(Found, New),
    append(Seen, New, Seen1),
    include(passable(Functions), New, On),
    append(Queue, On, Queue1),
    reach(Queue1, Seen1, Functions, Faces, Reached).

step(Faces, A, B) :- linked(Faces, A, B, [open, arch, 'bed-door', 'bath-door', 'sliding-door', dogleg]), integer(B).
passable(Functions, I) :- memberchk(I-F, Functions), \+ memberchk(F, [bedroom, bath, store, kitchen]).

% ---- all of them

house(S) :-
    section(S, _, _, _, _),
    functions(S, Functions),
    programme(Functions),
    stairs(S, Functions),
    list_to_assoc(Functions, Of),
    faces(S, Of, Faces),
    joined(Functions, Faces).

main :-
    current_prolog_flag(argv, [Facts|_]),
    consult(Facts),
    statistics(cputime, Start),
    aggregate_all(count, house(_), Count),
    statistics(cputime, End),
    Seconds is End - Start,
    format("~d ~6f~n", [Count, Seconds]),
    halt.
