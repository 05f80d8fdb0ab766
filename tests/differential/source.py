"""A rule file as its text stands there: its items and what they are about. Nothing is worked out but names."""
import re
from dataclasses import dataclass

HEAD = re.compile(r"""^(?P<kind>schema|rule|measure|library|form|let|param)\s+(?P<name>[^\W\d][\w-]*)\s*(?P<params>\([^)]*\))?\s*(?:"(?:\\.|[^"\\])*")?
                      \s*(?:using\s+(?P<using>[\w-]+))?\s*(?:from\s+(?P<older>[\w-]+))?\s*(?:onto\s+(?P<onto>[\w-]+))?\s*(?:in\s+(?P<form>[\w-]+))?\s*(?:of\s+(?P<schema>[\w-]+))?""", re.X)


@dataclass
class Item:
    kind: str
    name: str
    params: bool
    using: str
    older: str
    onto: str
    form: str
    schema: str
    text: str

    def body(self):
        """What follows `=`, of a rule or measure."""
        return self.text.partition("=")[2].strip()


class Source:
    """Items begin in the first column."""

    def __init__(self, text):
        self.text = text
        self.items = [item for item in map(read_item, re.split(r"^(?=\w)", text, flags=re.M)) if item]
        self.by_name = {item.name: item for item in self.items}

    def of(self, kind):
        return [item for item in self.items if item.kind == kind]

    def about(self, item):
        """(schema, form or None) of a library, rule or measure."""
        if item.form:
            return self.by_name[item.form].schema, item.form
        if item.onto:
            return item.onto, None
        if item.kind == "library" and item.older in self.by_name:
            schema, form = self.about(self.by_name[item.older])
            return item.using or schema, form
        used = self.by_name.get(item.using)
        if used and used.kind == "form":
            return used.schema, used.name
        schemas = self.of("schema")
        return (used or schemas[0]).name if used or schemas else None, None

    def suiting(self, kind, library):
        """Names of the rules (without parameters) or measures that can be asked of a library."""
        schema, form = self.about(library)
        return [i.name for i in self.of(kind) if not i.params and self.about(i) in ((schema, form), (schema, None))]


def read_item(text):
    found = HEAD.match(text)
    if not found:
        return None
    return Item(found["kind"], found["name"], bool(found["params"]), found["using"], found["older"], found["onto"], found["form"], found["schema"], text)


def read_source(path):
    with open(path, encoding="utf-8") as file:
        return Source(file.read())
