% LaHave houses on one plan as a Prolog programmer would count them: swipl -q -g main house.pl FACTS.pl
%
% Functions of cells, then what is in the faces, as lahave-form says; then the clauses of lahave-complete, each as soon as it can be
% asked. The facts are of house_facts.py. Tiles are left out. Prints how many houses there are and the seconds that counting took.

:- use_module(library(assoc)).
:- use_module(library(aggregate)).

% may(Function, Zone, Dense, Storey, Wide, Great, Public)
may(entry, machine, yes, 0, W, _, _) :- W >= 96.
may(kitchen, machine, yes, 0, W, _, _) :- W >= 96.
may(bath, machine, yes, _, W, _, _) :- W >= 96.
may(store, machine, yes, _, _, _, _).
may(hearth, body, yes, 0, _, _, _).
may(stair, body, yes, _, _, _, _).
may(cabinet, body, yes, _, _, _, _).
may(hall, body, no, 0, _, yes, _).
may(passage, body, no, _, 48, no, _).
may(dining, body, no, 0, W, no, _) :- W >= 96.
may(living, body, no, 0, W, no, _) :- W >= 96.
may(bedroom, body, no, _, W, no, no) :- W >= 96.
may(study, body, no, _, W, no, _) :- W >= 96.
may(gallery, body, no, 1, _, yes, _).
may(seat, bay, no, _, _, _, _).

% Functions in order of cells: a list of Cell-Function, void where the cell is open to the one below.
functions(S, Functions) :-
    findall(I, cell(S, I, _, _, _, _, _, _, _, _), Cells),
    foldl(function(S), Cells, [], Reversed),
    reverse(Reversed, Functions).

function(S, I, Before, [I-F|Before]) :-
    cell(S, I, Zone, Storey, Wide, _, Dense, Great, Public, Open),
    ( Open == yes -> F = void ; may(F, Zone, Dense, Storey, Wide, Great, Public) ).

% ---- what is in a face: the first line that applies and of whose kinds one fits

two(A, B, List1, List2) :- memberchk(A, List1), memberchk(B, List2), !.
two(A, B, List1, List2) :- memberchk(B, List1), memberchk(A, List2).
one(A, B, List) :- ( memberchk(A, List) -> true ; memberchk(B, List) ).
body_open(F) :- memberchk(F, [hall, passage, dining, living, bedroom, study, gallery]).
machine(F) :- memberchk(F, [entry, kitchen, bath, store]).

line(A, B, [open]) :- two(A, B, [hall], [hall, gallery]).
line(seat, B, [open]) :- body_open(B).
line(A, seat, [open]) :- body_open(A).
line(A, B, [wall]) :- one(A, B, [seat]).
line(A, B, [wall]) :- one(A, B, [hearth]), \+ two(A, B, [hearth], [hall, living, dining]).
line(A, B, [open]) :- two(A, B, [hearth], [hall, living, dining]).
line(A, B, [open]) :- two(A, B, [passage, stair], [hall, living, dining, gallery, passage, stair]).
line(A, B, [open, door]) :- two(A, B, [kitchen], [dining, hall]).
line(A, B, [door]) :- two(A, B, [bath], [bedroom, passage, stair]).
line(A, B, [wall]) :- one(A, B, [bath]).
line(A, B, [door]) :- two(A, B, [bedroom], [passage, gallery, stair]).
line(A, B, [wall]) :- one(A, B, [bedroom]).
line(A, B, [wall]) :- two(A, B, [store, cabinet], [store, cabinet]).
line(A, B, [wall]) :- machine(A), machine(B).
line(_, _, [door]).

line_outside(entry, back, [entrance]).
line_outside(store, _, [wall]).
line_outside(F, _, [strip]) :- machine(F).
line_outside(seat, _, [glass, window]).
line_outside(hall, front, [glass, window]).
line_outside(F, _, [wall]) :- memberchk(F, [hearth, cabinet]).
line_outside(_, _, [window]).

% Every opening is low enough for both storeys.
fits(Long, Kind) :- wide(Kind, Wide), !, Long >= Wide + 6.
fits(_, _).
wide(entrance, 36).
wide(door, 32).
wide(window, 36).
wide(strip, 24).
wide(glass, 72).

kinds(Goal, Long, Kinds) :- call(Goal, All), include(fits(Long), All, Kinds), Kinds \== [], !.
kinds(_, _, [wall]).

between(A, B, _, [open]) :- A == void, memberchk(B, [void, gallery, passage]), !.
between(A, B, _, [open]) :- B == void, memberchk(A, [gallery, passage]), !.
between(A, B, _, [wall]) :- one(A, B, [void]), !.
between(A, B, Long, Kinds) :- kinds(line(A, B), Long, Kinds).

over(_, void, open) :- !.
over(stair, stair, stair) :- !.
over(_, _, floor).

% face(A, B, Kind), B of the outside: out(Side)
faces(S, Of, Faces) :-
    findall(choice(A, B, Kinds), ( beside(S, A, B, Long), get_assoc(A, Of, F), get_assoc(B, Of, G), between(F, G, Long, Kinds) ), Inner),
    findall(choice(A, out(Side), Kinds), ( outside(S, A, Side, Long), get_assoc(A, Of, F), outer(F, Side, Long, Kinds) ), Outer),
    findall(choice(A, B, [Kind]), ( above(S, A, B), get_assoc(A, Of, F), get_assoc(B, Of, G), over(F, G, Kind) ), Floors),
    append([Inner, Outer, Floors], Choices),
    maplist(choose, Choices, Faces).

outer(void, _, Long, Kinds) :- !, kinds(line_outside(any), Long, Kinds).
outer(F, Side, Long, Kinds) :- kinds(line_outside(F, Side), Long, Kinds).
line_outside(any, [window]).
choose(choice(A, B, Kinds), face(A, B, Kind)) :- member(Kind, Kinds).

% ---- clauses that ask for functions alone

number_of(F, Functions, N) :- aggregate_all(count, member(_-F, Functions), N).

programme(Functions) :-
    number_of(entry, Functions, 1), number_of(kitchen, Functions, 1),
    number_of(bath, Functions, Baths), Baths >= 1, Baths =< 2,
    number_of(bedroom, Functions, Beds), Beds >= 1, Beds =< 4.

stairs(S, Functions) :-
    section(S, _, Storeys, _, _),
    ( Storeys =:= 1 -> double(no), \+ member(_-stair, Functions)
    ; aggregate_all(count, ( member(I-stair, Functions), cell(S, I, _, 0, _, _, _, _, _, _) ), 1),
      once(( above(S, A, B), memberchk(A-stair, Functions), memberchk(B-stair, Functions) )) ),
    \+ half_stair(S, Functions).

half_stair(S, Functions) :-
    above(S, A, B), memberchk(A-F, Functions), memberchk(B-G, Functions), G \== void,
    ( F == stair, G \== stair ; G == stair, F \== stair ).

large(S, Functions) :- \+ ( member(I-bedroom, Functions), cell(S, I, _, _, _, Area, _, _, _, _), Area < 60 ).

% ---- clauses that ask for faces

linked(Faces, A, B, Kinds) :- ( member(face(A, B, Kind), Faces) ; member(face(B, A, Kind), Faces) ), memberchk(Kind, Kinds).

has(Faces, I, Kind) :- ( member(face(I, _, Kind), Faces) ; member(face(_, I, Kind), Faces) ), !.

served(Functions, Faces) :-
    member(K-kitchen, Functions), linked(Faces, K, B, [open, door]), memberchk(B-F, Functions), memberchk(F, [dining, hall]), !.
lit(Functions, Faces) :- \+ ( member(I-bedroom, Functions), \+ has(Faces, I, window) ).
closed(Functions, Faces) :- \+ ( member(I-bath, Functions), \+ has(Faces, I, door) ).

% Every cell but baths, stores and seats: a walk to the entry, between them not through bedrooms, baths and stores.
joined(Functions, Faces) :-
    memberchk(E-entry, Functions),
    reach([E], [E], Functions, Faces, Reached),
    \+ ( member(I-F, Functions), \+ memberchk(F, [void, bath, store, seat]), \+ memberchk(I, Reached) ).

reach([], Reached, _, _, Reached).
reach([A|Queue], Seen, Functions, Faces, Reached) :-
    findall(B, ( step(Faces, A, B), memberchk(B-F, Functions), F \== void, \+ memberchk(B, Seen) ), Found),
    sort(Found, New),
    append(Seen, New, Seen1),
    include(passable(Functions), New, On),
    append(Queue, On, Queue1),
    reach(Queue1, Seen1, Functions, Faces, Reached).

step(Faces, A, B) :- linked(Faces, A, B, [open, door, stair]), integer(B).
passable(Functions, I) :- memberchk(I-F, Functions), \+ memberchk(F, [bedroom, bath, store]).

% ---- all of them

house(S) :-
    section(S, _, _, _, _),
    functions(S, Functions),
    programme(Functions),
    stairs(S, Functions),
    large(S, Functions),
    list_to_assoc(Functions, Of),
    faces(S, Of, Faces),
    served(Functions, Faces),
    lit(Functions, Faces),
    closed(Functions, Faces),
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
