"""Mends files by the program's own diagnostics: what the grammar allows is often wrong in meaning."""
from program import Wrong, read_json, run
from tree import Text, at, nodes_at, offset_of, replaced

ROUNDS = 14
TAKEN_OUT = 10        # from this round on parts are not made anew


def errors(path):
    """The errors that `check` finds in a file, in the order in which it says them: those of analysing if there are no others."""
    return errors_by(path, "--no-analysis") or errors_by(path)


def errors_by(path, *options):
    code, _, err = run("check", *options, "--diagnostics=json", path)
    found = [d for d in read_json("check --diagnostics=json", err or "[]") if d["severity"] == "error"]
    if bool(found) != (code == 1):
        raise Wrong("check", f"exit code {code}, {len(found)} errors", "1 with errors, and only then")
    return found


def mended(maker, root, path):
    """(tree, errors that are left); the file at `path` has the tree's text. A tree on which `check` fails is kept as maker.last."""
    for attempt in range(ROUNDS + 1):
        text = Text(root, maker.notation.indents)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.text)
        maker.last = root
        found = errors(path)
        if not found or attempt == ROUNDS:
            return root, found
        root = mend_all(maker, root, text, found, attempt)


def mend_all(maker, root, text, errors_found, attempt):
    """Makes the smallest part at each error's place anew that can be; in later rounds what is around it, and at last takes it out."""
    before, done = root, []
    for error in errors_found:
        path = place_of(maker, before, text, error, attempt)
        if path is None or any(path[:len(p)] == p or p[:len(path)] == path for p in done):
            continue
        done.append(path)
        old = at(before, path)
        if attempt >= TAKEN_OUT or not may_be_remade(maker, old):
            return without(before, path, max(attempt - TAKEN_OUT, 0))
        root = replaced(root, path, maker.make(old.symbol, maker.random.choice([0, 1, 2]), old.context))
    return root


def place_of(maker, root, text, error, attempt):
    if error["line"] is None:
        return None
    begin = min(offset_of(text.text, error["line"], error["column"]), len(text.text) - 2)
    end = min(max(begin + 1, offset_of(text.text, error["end_line"], error["end_column"])), len(text.text) - 1)
    around = nodes_at(text, begin, end)
    places = [path for path in around if may_be_remade(maker, at(root, path))]
    return places[min(attempt // 3, len(places) - 1)] if places else (around or [()])[0]


def may_be_remade(maker, node):
    return node.symbol in maker.notation.remade and node.context is not None


def without(root, path, outward):
    """Without the element of a list that this is part of; `outward` lists farther out where that does not help."""
    lists = [path[:n] for n in range(len(path), -1, -1) if drops_last(at(root, path[:n]))]
    inner = [p for p in lists if path[len(p):len(p) + 1] != (0,)]
    if not inner:
        return root
    chosen = inner[min(outward, len(inner) - 1)]
    return replaced(root, chosen, at(root, chosen).children[0])


def drops_last(node):
    """Is it a list with a shorter list before its last element?"""
    return node.production is not None and node.children and node.children[0].symbol == node.symbol
