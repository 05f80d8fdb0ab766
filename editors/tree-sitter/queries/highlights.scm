; Each node is captured once, so that the order of the patterns does not matter: editors differ in which of two wins.

(comment) @comment
(string) @string
[(length) (area) (number) (decimal) (fraction)] @constant.numeric
(house) @string.special

; ---- words

"use" @keyword.import

[
  "form" "let" "library" "measure" "param" "rule" "schema" "test"
  "allow" "as" "using" "with" "onto"
] @keyword

[
  "trays" "total" "require" "prune" "generate" "prefer" "worth" "weight"
  "match" "reject" "keep" "drop" "value" "todo"
] @keyword

[
  "zone" "number" "forbid" "only" "flag" "role"
] @keyword

[
  "storey" "spine" "wall" "partition" "floor" "deck" "roof" "option" "section" "void" "no" "function" "opening" "flight" "beam" "face"
  "tile" "way" "headroom" "guard" "material" "classification"
  "across" "against" "along" "back" "clear" "deep" "for" "front" "glazed" "going" "high" "item" "leafless" "left" "line" "near" "outdoor"
  "outside" "passage" "per" "price" "right" "rise" "sill" "sliding" "span" "symbol" "turn" "under" "up" "wide" "winders"
] @keyword

[
  "after" "and" "at" "before" "beside" "by" "from" "gap" "implies" "in" "least" "mod" "not" "of" "or" "some" "symmetric" "through" "to" "where"
  "within"
] @keyword.operator

[
  "any" "apart" "beginning" "cell" "distance" "end" "every" "exits" "many" "matches" "max" "min" "neighbor" "neighbour" "occurrences"
  "optional" "plan" "quantity" "room" "sum" "touch" "tray" "walk"
] @function.builtin

; ---- what is named

(schema name: (name) @type)
(form name: (name) @type)
(library name: (name) @type)
(_ base: (name) @type)

(rule name: (name) @function)
(measure name: (name) @function)
(call name: (name) @function)
(test name: (name) @function)
(said (name) @function)
(let name: (name) @constant)
(param name: (name) @constant)
(setting name: (name) @constant)
(parameters (name) @variable.parameter)
(reference (name) @variable)
(quantified name: (name) @variable.parameter)

(field_head name: (name) @variable.other.member)
(tally_field (name) @variable.other.member)
(total_clause (name) @variable.other.member)
(spine (name) @variable.other.member)
(option name: (name) @variable.other.member)
(_ of: (name) @variable.other.member)
(role (name) @attribute)

(field_value (name) @constant)
(spec_item (name) @constant)
(spec_range (name) @constant)
(plan_tray (name) @constant)
(words (name) @constant)
(option_is (name) @constant)
(shape argument: (name) @constant)
(_ value: (name) @constant)
(_ code: (name) @constant)
(shape name: (name) @function.builtin)

(prune_clause name: (name) @label)
(prefer_clause name: (name) @label)
(case (name) @label)
(clause_name) @label
(storey name: (name) @label)
(thickness (name) @label)
(layers (name) @label)
(function name: (name) @label)
(opening name: (name) @label)
(flight name: (name) @label)
(beam name: (name) @label)
(face (name) @label)
(way (name) @label)
(material (name) @label)
(class name: (name) @label)
(tile (name) @label)
(tile_against (name) @label)
(tile_item name: (name) @label)
(symbol (name) @label)
(touch (name) @label)
(apart (name) @label)
(walk (name) @label)
(extreme (name) @label)

; ---- signs

["<" "<=" "=" "!=" ">=" ">" "+" "-" "*" "/" ".." "..." "?"] @operator
["|" "," ":"] @punctuation.delimiter
["(" ")" "[" "]" "{" "}"] @punctuation.bracket
