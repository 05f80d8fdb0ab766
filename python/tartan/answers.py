"""Answers to questions: the JSON of `tartan_ask` as objects, by what requests.def says of their members.

Whole numbers of any size are ints, exact values Fractions, files bytes or texts, plan lines texts. What is absent is
None."""
import base64
import json
from fractions import Fraction

from tartan import _requests

__all__ = ["Answer", "QUESTIONS"]

#: What can be asked: each question with what it is about.
QUESTIONS = {name: doc for name, (_, _, doc) in _requests.QUESTIONS.items()}


class Answer:
    """A message of an answer. Its members are attributes; dict(answer) has those that are there."""

    diagnostics: list  #: what was said besides, of an answer as a whole

    def __init__(self, message, members):
        self._message = message
        self._members = members

    def __getattr__(self, name):
        members = self.__dict__.get("_members", {})
        if name in members:
            return members[name]
        if name.startswith("_") or name not in _members_of(self._message):
            raise AttributeError(f"`{self.__dict__.get('_message')}` has no member `{name}`")
        return None

    def __dir__(self):
        return sorted(set(super().__dir__()) | set(_members_of(self._message)))

    def keys(self):
        return self._members.keys()

    def __getitem__(self, name):
        return self._members[name]

    def __eq__(self, other):
        return isinstance(other, Answer) and self._members == other._members

    def __repr__(self):
        return f"{self._message}({', '.join(f'{name}={value!r}' for name, value in self._members.items())})"

    def _repr_html_(self):
        from tartan._html import table
        return table(["", ""], [(name, value) for name, value in self._members.items()])


def _members_of(message):
    """All members, by their names in JSON, those of parts among them."""
    found = _KNOWN.get(message)
    if found is None:
        found = _KNOWN[message] = {}
        for name, presence, kind, of, _ in _requests.MESSAGES[message][2]:
            if kind in ("part", "written") and of and _requests.MESSAGES[of][0] == "message":
                found.update(_members_of(of))
            elif presence != "unsaid" and kind != "boxed":
                found[name] = (kind, of, presence)
    return found


_KNOWN: dict = {}
_PLAIN = {"big": int, "exact": Fraction, "exacts": lambda items: [Fraction(item) for item in items],
          "bytes": base64.b64decode}


def _decode(kind, of, value):
    if value is None:
        return None
    if kind in _PLAIN:
        return _PLAIN[kind](value)
    if kind == "list":
        return [_message(of, item) for item in value]
    if kind in ("nested", "part", "written") and of:
        return _message(of, value)
    if kind == "map":
        _, (_, _, inner, inner_of, _) = _requests.MESSAGES[of][2][:2]
        return {name: _decode(inner, inner_of, item) for name, item in value.items()}
    return value


def _message(name, value):
    kind, _, members = _requests.MESSAGES[name]
    if kind == "tuple":
        return tuple(_decode(member[2], member[3], item) for member, item in zip(members, value))
    if kind == "listing":
        return _decode(members[0][2], members[0][3], value)
    if not isinstance(value, dict):
        return value
    known = _members_of(name)
    return Answer(name, {key: _decode(*known[key][:2], item) if key in known else item for key, item in value.items()})


def _fits(name, value):
    """May this be the message's JSON?"""
    kind, _, members = _requests.MESSAGES[name]
    if kind != "message":
        return isinstance(value, list)
    known = _members_of(name)
    return (isinstance(value, dict) and all(key in known for key in value) and
            all(key in value for key, (_, _, presence) in known.items() if presence == "present"))


def read(question, text):
    """The answer to a question, from its JSON."""
    value = json.loads(text)
    names = _requests.QUESTIONS[question][1]
    return _message(next((name for name in names if _fits(name, value)), names[0]), value)
