"""What can go wrong, and what compiling says of a file."""
from dataclasses import dataclass
from typing import Optional

__all__ = ["Diagnostic", "Error"]


@dataclass(frozen=True)
class Diagnostic:
    """Something that is said of a rule file. Lines and columns count from 1, columns in bytes."""

    severity: str  # "error", "warning", "note"
    code: Optional[str]  # "E0301"
    message: str
    help: Optional[str] = None
    path: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None
    end_line: Optional[int] = None
    end_column: Optional[int] = None

    def __str__(self):
        place = f"{self.path}:{self.line}:{self.column}: " if self.path else ""
        code = f"[{self.code}]" if self.code else ""
        more = f"\n  help: {self.help}" if self.help else ""
        return f"{place}{self.severity}{code}: {self.message}{more}"


class Error(Exception):
    """What a call that failed says.

    kind: "invalid" (the rules, the input or an argument are wrong), "io" (a file could not be read or written),
    "limit" (an explicit limit was reached) or "internal" (a mistake of Tartan's own). column: the byte of the line
    given that it is about, from 1. diagnostics: of a file that does not compile, all that is said of it.
    """

    def __init__(self, message, *, code=None, help=None, column=None, kind="invalid", diagnostics=()):
        super().__init__(message)
        self.message = message
        self.code = code
        self.help = help
        self.column = column
        self.kind = kind
        self.diagnostics = tuple(diagnostics)

    def __str__(self):
        if self.diagnostics:
            return "\n".join(str(said) for said in self.diagnostics)
        code = f"{self.code}: " if self.code else ""
        return f"{code}{self.message}" + (f" ({self.help})" if self.help else "")
