// Texts to begin with: short, with comments that say what to change. Each compiles (tests/studio holds that).

export interface Start {
  title: string;
  about: string;
  name: string;
  text: string;
}

const ROWS = `# A row of rooms. Change a word here, and the plans on the right follow.

# What a tray, one slice of the row, can be.
schema bay "one bay of the row, from wall to wall" {
  use   "what it is for" = room | hall | stair
  width "along the row" role length = 3m | 4m | 6m
  zone depth "from front to back" role band = deep(6m) role void | shallow(4m) role void
}

# What can be set by the sliders above the plans.
param lot "how long the row may be" = 20m in 12m..30m

# What is good and what is not.
rule one-stair "there is one stair" =
  quantity(tray(stair)) = 1

rule wide-stair "a stair takes no more than 3 m" =
  tray(stair, width > 3m)

rule narrow-hall "a hall of 3 m" =
  tray(hall, 3m)

# Which plans there are, and which of them are kept.
library rows "rows of three to six bays" using bay {
  trays 3..6
  require one-stair, sum(width) <= lot
  prune wide-stair, narrow-hall
}

# What a plan comes to.
measure cost "in thousands" =
  9 * sum(width) / 1m + 25 * quantity(tray(stair))

# What must stay so, whatever is changed above.
test rows {
  keep [room 4m | stair 3m | hall 6m]
  drop [room 4m | room 4m | hall 6m] by one-stair
}
`;

const HOUSES = `# Houses in the manner of the LaHave House grammar: slices across one long axis.
use "lahave"

rule public-end "one end of the house is public" =
  symmetric neighbour(beginning, tray(public))

rule hall "a great hall of one or two trays" =
  quantity(tray(great)) in 1..2

rule low-hall "a great hall that nowhere rises through two storeys" =
  tray(great) and not tray(great, double)

library houses "small LaHave houses" using lahave {
  trays 3..6
  total width 28'..44'
  require public-end, hall
  prune low-hall, narrow-pair, dense-end
}

measure area "of floor, both zones" =
  sum(width * (machine + body))
`;

const GROWING = `// A surface that grows: every edge of a square becomes five.
A + A + A + A
A -> A + A - A - A + A
Angle 90
`;

const GRAMMAR = `# Sums of whole numbers: the first rule is where a sentence starts.
<sum>    ::= <number> | <number>"+"<sum>
<number> ::= <digit> | <digit><digit>
<digit>  ::= "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "9"
`;

const WALL = `# A dome of bricks of the standard library: change a number, and place it again.
use "bricks";

space dome = sphere(9 studs) and not sphere(7.5 studs);

rule brick at stud, tube = 3001 in 2 | 3003 in 3 | 3004 in 2 | 3005 in 1;

model dome "a small dome" {
  inside dome;
  start stud at (8.5 studs, 0, 0.5 studs) by brick;
}
`;

const FIELD = `# An implicit surface: the form is where the number is below 0.
let thickness = 0.2

surface shell "a hollow ball, cut open" =
  max(abs(sqrt(x*x + y*y + z*z) - 1) - thickness/2, z - 0.5)

box (-1.5, -1.5, -1.5)..(1.5, 1.5, 1.5)
grid 60
`;

const SOLID = `# A table: a top on four legs.
solid table {
  box top from (0, 7, 0) to (12, 8, 8);
  box leg from (0, 0, 0) to (1, 7, 1);
  box leg2 from (11, 0, 0) to (12, 7, 1);
  box leg3 from (0, 0, 7) to (1, 7, 8);
  box leg4 from (11, 0, 7) to (12, 7, 8);
  require parts = 1, stable > 1;
}
`;

export const STARTS: Start[] = [
  {title: "A row of rooms", about: "Rooms, halls and a stair along a row: the place to begin.", name: "rows.plan", text: ROWS},
  {title: "LaHave houses", about: "The houses of the paper behind the language, in its own trays.", name: "houses.plan", text: HOUSES},
  {title: "A growing surface", about: "A rewrite system (.hemls).", name: "island.hemls", text: GROWING},
  {title: "A grammar", about: "Sentences for genomes (.bnf).", name: "sums.bnf", text: GRAMMAR},
  {title: "A dome of bricks", about: "Parts and a model (.kit).", name: "dome.kit", text: WALL},
  {title: "A shell", about: "An implicit surface (.field).", name: "shell.field", text: FIELD},
  {title: "A table", about: "A design of boxes (.solid).", name: "table.solid", text: SOLID},
];
