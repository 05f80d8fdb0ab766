/* The grammar of .plan for editors, for tree-sitter. Its rules go by the names and in the order of grammar/plan.y, and its tokens are those
 * of grammar/plan.l. It is looser than the compiler where a narrower rule would colour and fold nothing better: rules, sums and
 * conditions on numbers are one kind of expression, and what a word in a tray means is left to the schema.
 *
 * Words are kept to the places where they mean something: elsewhere the lexer of tree-sitter reads them as names. Where a word
 * and a name may both stand, the word is listed as a name, too (`soft`).
 */

/* A word of the language, in small letters or capitals; queries find it by its small letters. */
const word = (text) => alias(token(new RegExp([...text].map((c) => `[${c}${c.toUpperCase()}]`).join(""))), text);
const words = (...texts) => choice(...texts.map(word));

/* Words that are names here. */
const soft = ($, ...texts) => alias(words(...texts), $.name);

const list = (separator, rule) => seq(rule, repeat(seq(separator, rule)));
const parenthesized = (...rules) => seq("(", ...rules, ")");

/* How strongly operators bind, as in the order of grammar/plan.y from `expression` to `primary`. */
const BINDS = { implies: 1, or: 2, and: 3, not: 4, every: 5, compare: 6, remainder: 7, near: 8, add: 9, multiply: 10, sign: 11, symmetric: 12 };

const pattern = (text) => new RegExp(text, "u");
const DIGITS = "[0-9]+";
const DECIMAL = `${DIGITS}(\\.${DIGITS})?`;
const INCHES = `(${DECIMAL}|${DIGITS}/${DIGITS}|${DIGITS}[- ]${DIGITS}/${DIGITS})["\\u{201D}\\u{2033}]`;
/* A dash between feet and inches has no blank beside it: with one it is a minus. */
const FEET = `${DECIMAL}['\\u{2019}\\u{2032}]((-|[ \\t]*)${INCHES})?`;
/* Letters of other alphabets, too, but no typographic signs. */
const LETTER = "A-Za-z_\\u{C0}-\\u{1FFF}\\u{3000}-\\u{EFFF}\\u{10000}-\\u{10FFFF}";

/* and, or, not over what `leaf` is. */
function logic(self, leaf) {
  return {
    [self]: ($) => choice($[leaf], parenthesized($[self]), alias($[self + "_not"], $.negation), alias($[self + "_and"], $.conjunction),
      alias($[self + "_or"], $.disjunction)),
    [self + "_not"]: ($) => prec(BINDS.not, seq(word("not"), $[self])),
    [self + "_and"]: ($) => prec.left(BINDS.and, seq($[self], word("and"), $[self])),
    [self + "_or"]: ($) => prec.left(BINDS.or, seq($[self], word("or"), $[self])),
  };
}

module.exports = grammar({
  name: "plan",
  word: ($) => $.name,
  extras: ($) => [/[ \t\r\n\f\v\u{FEFF}]/u, $.comment],

  conflicts: ($) => [
    [$._value_name, $.said], /* `measure` is a value, or says where values come from */
    [$.field_value], /* `role` belongs to the value, or is the next field */
    [$.tally_field], /* a role behind a field, or the next field */
  ],

  supertypes: ($) => [$._item, $._clause, $._form_clause, $._expression],

  rules: {
    source_file: ($) => repeat($._item),

    _item: ($) => choice($.use, $.schema, $.let, $.param, $.measure, $.rule, $.library, $.form, $.test),

    use: ($) => seq(word("use"), $.string),
    schema: ($) => seq(word("schema"), field("name", $.name), optional($._doc), optional(seq(words("from", "of"), field("base", $.name))), field("body", $.schema_body)),
    let: ($) => seq(word("let"), field("name", $.name), "=", $._expression),
    param: ($) => seq(word("param"), field("name", $.name), optional($._doc), "=", choice($._expression, $.words)),
    measure: ($) => seq(word("measure"), field("name", $.name), optional($._doc), optional($._using), "=", $._expression),
    rule: ($) => seq(word("rule"), field("name", $.name), optional($.parameters), optional($._doc), optional($._using), optional($._allow), "=", $._expression),
    library: ($) => seq(word("library"), field("name", $.name), optional($._doc), optional($._using),
      optional(seq(word("from"), field("base", $.name), optional(seq(words("in", "onto"), field("base", $.name))))), field("body", $.library_body)),
    form: ($) => seq(word("form"), field("name", $.name), optional($._doc), word("of"), field("base", $.name), field("body", $.form_body)),
    test: ($) => seq(word("test"), list(",", field("name", $.name)), optional(seq(word("with"), list(",", $.setting))), field("body", $.test_body)),

    _doc: ($) => field("doc", $.string),
    _using: ($) => seq(word("using"), field("base", $.name)),
    _allow: ($) => seq(word("allow"), list(",", field("code", $.name))),
    _names: ($) => list(",", $.name),
    _or_names: ($) => list(word("or"), $.name),
    parameters: ($) => parenthesized($._names),
    words: ($) => seq($._operand_name, repeat1(seq("|", $.name))),
    setting: ($) => seq(field("name", $.name), "=", $._expression),

    /* ---- schemas */

    schema_body: ($) => seq("{", repeat(choice($.field, $.number_field, $.limit)), "}"),
    field: ($) => seq(optional(word("zone")), $.field_head, "=", choice($.flag, $.said, $._values)),
    field_head: ($) => seq(field("name", choice($.name, soft($, "zone", "number", "forbid", "only", "role"))), optional($._doc), optional($.role)),
    flag: ($) => prec(1, word("flag")),
    said: ($) => seq(words("measure", "rule"), $.name),
    role: ($) => seq(word("role"), $.name),
    _values: ($) => list(choice("|", "<"), choice($.field_value, "...")),
    field_value: ($) => seq(choice($._value_name, $.number, $.length, seq($._value_name, parenthesized(list(",", $._spec_word)))), optional($._doc), optional($.role)),
    _value_name: ($) => choice($.name, soft($, "flag", "measure", "rule")),
    number_field: ($) => seq(word("number"), $.field_head, "=", list("|", $.number_case)),
    number_case: ($) => seq($._tally, optional(seq(word("where"), $.tray))),
    limit: ($) => seq(words("forbid", "only"), $._limit),
    _limit_leaf: ($) => choice($.tray, $.any, alias($.limit_name, $.reference), alias($.limit_implies, $.implication)),
    limit_implies: ($) => prec.left(BINDS.implies, seq($._limit, word("implies"), $._limit)),
    limit_name: ($) => $.name,
    ...logic("_limit", "_limit_leaf"),

    /* ---- trays: what the words of an item mean depends on the schema */

    _specifier: ($) => list(",", $.spec_item),
    spec_item: ($) => list(word("or"), repeat1($._spec_word)),
    _spec_word: ($) => choice($.name, $._constant, word("not"), word("in"), $._comparison, $._spec_sign, $.spec_range, $.ratio, parenthesized(list(word("or"), repeat1($._spec_word)))),
    _spec_sign: () => choice("+", "-", "*", "/"), /* of sums that are compared: `width > 2 * body depth` */
    spec_range: ($) => seq(choice($.name, $._constant), "..", choice($.name, $._constant)),
    ratio: ($) => seq($.number, ":", $.number),
    tray: ($) => seq(word("tray"), parenthesized(optional($._specifier))),
    cell: ($) => seq(word("cell"), parenthesized(optional($._specifier))),
    room: ($) => seq(word("room"), parenthesized(optional($._specifier))),

    /* ---- rules */

    _expression: ($) => choice($.implication, $.disjunction, $.conjunction, $.negation, $.every_near, $.nearness, $.comparison, $.remainder, $.membership, $.sum_of_terms, $.product, $.sign,
      $.parenthesis, $.tray, $.cell, $.room, $.option_is, $.any, $.edge, $.trays, $.reference, $.call, $._constant, $.measured, $.extreme, $.quantified, $.every_tray, $.open_plan,
      $.neighbour, $.symmetric, $.repeated, $.touch, $.apart, $.walk, $.exits, $.distance),

    implication: ($) => prec.left(BINDS.implies, seq($._expression, words("implies", "where"), $._expression)),
    disjunction: ($) => prec.left(BINDS.or, seq($._expression, word("or"), $._expression)),
    conjunction: ($) => prec.left(BINDS.and, seq($._expression, word("and"), $._expression)),
    negation: ($) => prec(BINDS.not, seq(word("not"), $._expression)),
    every_near: ($) => prec(BINDS.every, seq(word("every"), $.nearness)),
    comparison: ($) => prec.left(BINDS.compare, seq($._expression, $._comparison, $._expression)),
    remainder: ($) => prec.left(BINDS.remainder, seq($._expression, word("mod"), $._expression)),
    membership: ($) => prec.left(BINDS.compare, seq($._expression, word("in"), $._expression, optional(seq("..", $._expression)))),
    nearness: ($) => prec.left(BINDS.near, seq($._expression, choice(
      seq(word("beside"), $._expression),
      seq(word("within"), $._expression, word("of"), $._expression),
      seq(word("at"), word("least"), $._expression, word("from"), word("every"), $._expression)))),
    sum_of_terms: ($) => prec.left(BINDS.add, seq($._expression, choice("+", "-"), $._expression)),
    product: ($) => prec.left(BINDS.multiply, seq($._expression, choice("*", "/"), $._expression)),
    sign: ($) => prec(BINDS.sign, seq("-", $._expression)),
    parenthesis: ($) => parenthesized($._expression),
    symmetric: ($) => prec(BINDS.symmetric, seq(word("symmetric"), $._expression)),

    any: ($) => word("any"),
    edge: ($) => words("beginning", "end"),
    trays: ($) => word("trays"),
    reference: ($) => $._operand_name,
    _operand_name: ($) => choice($.name, soft($, "cell", "room", "option", "section", "touch", "apart", "walk", "exits", "max", "min", "matches", "plan", "every", "some", "least")),
    call: ($) => seq(field("name", $.name), parenthesized(list(",", $._argument))),
    _argument: ($) => choice($._expression, seq($._expression, "..", optional($._expression)), /* a field, as in `values(use)` */
      field("of", soft($, "use", "schema", "rule", "library", "form", "test", "using", "from", "in", "of", "allow", "mod", "to", "by", "and", "or", "total", "require", "prune", "as", "match", "reject", "keep", "drop", "todo"))),

    measured: ($) => choice(
      seq(words("quantity", "occurrences"), parenthesized($._expression, optional($._region), optional(seq(",", $._expression)))),
      seq(word("sum"), parenthesized($._tally, optional(seq(word("of"), $._expression)), optional($._region), optional(seq(",", $._expression)))),
      seq(word("matches"), parenthesized($._expression))),
    _region: ($) => words("before", "after"),
    extreme: ($) => seq(words("max", "min"), parenthesized(choice(
      seq($._tally, optional(seq(word("of"), $._expression))),
      seq(word("gap"), word("from"), $._expression, word("to"), $._expression, optional(seq(word("by"), $.name)))))),
    quantified: ($) => seq(words("some", "every"), $._binders, word("in"), field("of", $.name), parenthesized($._expression)),
    _binders: ($) => prec(1, list(",", field("name", $.name))),
    every_tray: ($) => seq(word("every"), parenthesized($._expression, ",", $._expression)),
    open_plan: ($) => seq(word("plan"), "[", list("|", choice("?", "...", $._specifier, $.tray)), "]"),
    neighbour: ($) => seq(words("neighbour", "neighbor"), parenthesized(list(",", choice($._expression, "...")))),
    repeated: ($) => seq(words("many", "optional"), parenthesized($._expression)),
    touch: ($) => seq(word("touch"), parenthesized($._cells, ",", $._cells, optional($._by))),
    apart: ($) => seq(word("apart"), parenthesized($._cells, ",", word("from"), $._cells, optional($._passage))),
    walk: ($) => seq(optional(word("least")), word("walk"), parenthesized($._cells, ",", word("to"), choice($._cells, $.name), optional($._passage))),
    _passage: ($) => choice(seq(",", $._through), seq(",", $._by), seq(",", $._through, ",", $._by), seq(",", $._by, ",", $._through)),
    _through: ($) => seq(word("through"), $._cells),
    _by: ($) => seq(word("by"), $._or_names),
    exits: ($) => seq(word("exits"), parenthesized($._cells)),
    distance: ($) => seq(word("distance"), parenthesized(word("from"), $._expression, ",", word("to"), $._expression, ",", word("by"), $._expression)),

    /* Arithmetic over one tray. */
    _tally: ($) => choice($.tally_field, $._constant, parenthesized($._tally), alias($.tally_sum, $.sum_of_terms), alias($.tally_product, $.product), alias($.tally_sign, $.sign),
      alias($.tally_extreme, $.extreme)),
    tally_field: ($) => seq(choice($.name, soft($, "max", "min", "gap")), optional($.name)),
    tally_sum: ($) => prec.left(BINDS.add, seq($._tally, choice("+", "-"), $._tally)),
    tally_product: ($) => prec.left(BINDS.multiply, seq($._tally, choice("*", "/"), $._tally)),
    tally_sign: ($) => prec(BINDS.sign, seq("-", $._tally)),
    tally_extreme: ($) => seq(words("max", "min"), parenthesized($._tally, ",", $._tally)),

    _cells_leaf: ($) => $.cell,
    ...logic("_cells", "_cells_leaf"),
    _options_leaf: ($) => $.option_is,
    ...logic("_options", "_options_leaf"),
    option_is: ($) => seq(words("option", "section"), parenthesized(list(",", list(word("or"), repeat1(choice(word("not"), $._shape)))))),

    _comparison: ($) => choice("<", "<=", "=", "!=", ">=", ">"),
    _constant: ($) => choice($.number, $.length, $.area, $.decimal),
    range: ($) => seq($._signed, optional(seq(choice("..", "-"), $._signed))),
    _signed: ($) => seq(optional("-"), $._constant),

    /* ---- libraries */

    library_body: ($) => seq("{", repeat($._clause), "}"),
    _clause: ($) => choice($.trays_clause, $.total_clause, $.require_clause, $.prune_clause, $.generate_clause, $.prefer_clause, $.weight_clause, $.allow_clause),
    trays_clause: ($) => seq(word("trays"), $.range),
    total_clause: ($) => seq(word("total"), optional(seq($.name, optional($.name))), choice($.range, seq($._comparison, $._signed)), optional($._doc)),
    require_clause: ($) => seq(word("require"), list(",", seq($._expression, optional($._doc)))),
    prune_clause: ($) => seq(word("prune"), list(",", seq($._expression, optional(seq($._as, optional($._doc)))))),
    generate_clause: ($) => seq(word("generate"), $._expression, optional($._doc)),
    prefer_clause: ($) => seq(word("prefer"), list(",", seq($._expression, optional(seq(word("worth"), $._constant)), optional($._as), optional($._doc)))),
    weight_clause: ($) => seq(word("weight"), $._expression, optional($._constant)),
    allow_clause: ($) => $._allow,
    _as: ($) => seq(word("as"), field("name", $.name)),

    /* ---- forms */

    form_body: ($) => seq("{", repeat($._form_clause), "}"),
    _form_clause: ($) => choice($.storey, $.spine, $.thickness, $.option, $.forbid_options, $.no_cells, $.function, $.opening, $.flight, $.beam, $.face, $.tile, $.way, $.material, $.classification, $.allow_clause),
    storey: ($) => seq(word("storey"), field("name", $.name), optional($._doc), $._size),
    spine: ($) => seq(word("spine"), $.name),
    thickness: ($) => seq(choice(seq(word("wall"), optional(choice(word("outside"), $.name))), words("partition", "floor", "deck", "roof")), $._size, optional($.layers)),
    layers: ($) => seq("{", optional(list(",", seq($.name, $._size))), "}"),
    option: ($) => seq(words("option", "section"), field("name", $.name), optional(field("name", $.name)), "=", list("|", field("value", $._shape))),
    _shape: ($) => choice($.number, $.name, $.shape),
    shape: ($) => seq(field("name", $.name), parenthesized(list(",", choice(field("argument", $.name), $.length, $.ratio, seq(field("argument", $.name), $.length))))),
    forbid_options: ($) => seq(word("forbid"), $._options),
    no_cells: ($) => seq(words("void", "no"), $._cells),
    function: ($) => seq(word("function"), field("name", $.name), optional($._doc), optional(word("outdoor")), word("at"), $._cells),
    opening: ($) => seq(word("opening"), field("name", $.name), optional($._doc), word("wide"), $._size, word("high"), $._size, repeat($._opening_part)),
    _opening_part: ($) => choice(seq(words("sill", "clear"), $._size), seq(word("near"), $._side, $._size), words("passage", "glazed", "leafless", "sliding")),
    flight: ($) => seq(word("flight"), field("name", $.name), optional($._doc), word("wide"), $._size, word("rise"), $._sizes, optional(seq(word("going"), $._size)),
      optional(seq(word("turn"), field("value", $.name))), optional(seq(word("winders"), $._quantity))),
    beam: ($) => seq(word("beam"), field("name", $.name), optional($._doc), word("wide"), $._size, word("high"), $._size, word("span"), $._size),
    face: ($) => seq(word("face"), $._cells, choice(seq(words("beside", "along", "across", "under"), $._cells), seq(word("outside"), optional($._side))), "=", list("|", $.name)),
    way: ($) => choice(seq(word("way"), $._size, optional(seq(word("for"), $._names))), seq(words("headroom", "guard"), $._size)),
    material: ($) => seq(word("material"), field("name", $.name), $._doc, optional(seq(word("price"), $._quantity, word("per"), $.name)), word("for"), $._names,
      optional(seq(word("where"), $._options))),
    classification: ($) => seq(word("classification"), $.string, word("for"), list(",", $.class)),
    class: ($) => seq(field("name", $.name), field("code", $.string), optional($._doc)),
    tile: ($) => seq(word("tile"), field("name", $.name), optional($._doc), word("for"), $._names, field("body", $.tile_body)),
    tile_body: ($) => seq("{", repeat(choice($.tile_size, $.tile_against, $.tile_item)), "}"),
    tile_size: ($) => seq(words("wide", "deep"), $._sizes),
    tile_against: ($) => seq(word("against"), $._or_names),
    tile_item: ($) => seq(words("item", "keep"), field("name", $.name), optional($._doc), optional(list(",", $.reach)), optional($.symbol)),
    reach: ($) => seq($._box_side, $._size, "..", optional($._box_side), $._size),
    symbol: ($) => seq(word("symbol"), choice($.name, $.symbol_body)),
    symbol_body: ($) => seq("{", repeat1($.symbol_line), "}"),
    symbol_line: ($) => seq(word("line"), $._line_end, "..", $._line_end),
    _line_end: ($) => seq($._box_side, $._size, ",", $._box_side, $._size),
    _side: ($) => words("left", "right", "back", "front"),
    _box_side: ($) => words("left", "right", "back", "front", "up"),
    _size: ($) => choice($.length, $.number),
    _sizes: ($) => seq($._size, "..", $._size),
    _quantity: ($) => choice($.number, $.decimal),

    /* ---- tests */

    test_body: ($) => seq("{", repeat($.case), "}"),
    case: ($) => seq(optional(word("todo")), choice(
      seq(repeat1(words("match", "reject", "keep", "drop")), $.plan, optional($._doc), optional(seq(word("by"), list(",", $._clause_name), optional($._doc)))),
      seq(word("value"), $.plan, "=", $._expression, optional($._doc)))),
    _clause_name: ($) => choice($.name, $.clause_name, alias(words("trays", "total"), $.clause_name)),
    plan: ($) => seq("[", choice($.house, list("|", optional($.plan_tray))), "]"),
    plan_tray: ($) => repeat1(choice($.name, $._constant, $.fraction, word("not"), "-", ":")),

    /* ---- tokens */

    name: () => token(pattern(`[${LETTER}][${LETTER}0-9]*(-+[${LETTER}0-9]+)*`)),
    clause_name: () => token(pattern(`([rR][eE][qQ][uU][iI][rR][eE]|[pP][rR][uU][nN][eE]|[gG][eE][nN][eE][rR][aA][tT][eE])@${DECIMAL}`)),
    number: () => token(pattern(DIGITS)),
    decimal: () => token(pattern(`${DIGITS}\\.${DIGITS}|${DECIMAL}%`)),
    fraction: () => token(pattern(`${DIGITS}/${DIGITS}((m|ft)[23])?`)),
    length: () => token(pattern(`${FEET}|${INCHES}|${DECIMAL}(mm|cm|m)`)),
    area: () => token(pattern(`${DECIMAL}((m|ft)[23\\u{B2}\\u{B3}]|sqft|sf|cf)`)),
    string: () => token(/"([^"\\\r\n]|\\[^\r\n])*"|\u{201C}([^"\u{201D}\\\r\n]|\\[^\r\n])*["\u{201D}]|\u{201E}([^"\u{201C}\u{201D}\\\r\n]|\\[^\r\n])*["\u{201C}\u{201D}]/u),
    /* The line of a house, which has a `;`; it may go on in the next line of the file. */
    house: () => token(/[^\[\]{}#; \t\r\n][^\[\]{}#;]*;[^\[\]{}#]*/),
    comment: () => token(/#[^\r\n]*/),
  },
});
