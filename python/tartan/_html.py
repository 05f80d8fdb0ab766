"""Tables for notebooks."""
import html


def table(heads, rows, foot=None):
    """A table, and a line below it."""

    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(_shown(cell))}</{tag}>" for cell in cells) + "</tr>"

    head = f"<thead>{line(heads, 'th')}</thead>" if any(heads) else ""
    body = "".join(line(row, "td") for row in rows)
    below = f"<p>{html.escape(foot)}</p>" if foot else ""
    return f"<table>{head}<tbody>{body}</tbody></table>{below}"


def _shown(cell, most=200):
    said = f"{cell:,}" if isinstance(cell, int) and not isinstance(cell, bool) else str(cell)
    return said if len(said) <= most else said[:most - 1] + "…"
