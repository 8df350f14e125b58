"""Jobs whose list of effects is laid out in any way that YAML allows people to write it."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

HEAD = """\
# A laboratory's own remark: keep me.
schema: zlmreport/job/1
certificate: {number: "CAL-1",   kind: report}   # spaces, too
axis: {name: X}
measurement:
    source: {plugin: exemplary-text, file: 'six.txt'}
evaluate: [ "exemplary:1" ]
"""
TAIL = """\
# what comes after
output:
  directory: out
  formats: [exemplary]
"""
NAMES = ("offset", "scale-error", "backlash", "screw-pitch", "first-run", "dead-path", "abbe")


@dataclass(frozen=True)
class Layout:
    """A job before, in and after its list of effects.

    Attributes
    ----------
    head, listed, tail
        The three parts of its text.
    names
        The effects in the list, in order.
    comments
        Texts of comments that stand in lines of their own.
    """

    head: str
    listed: str
    tail: str
    names: tuple[str, ...]
    comments: tuple[str, ...]

    @property
    def text(self) -> str:
        return self.head + self.listed + self.tail


def _quoted(name: str, quote: str) -> str:
    return f"{quote}{name}{quote}"


@st.composite
def _items(draw: st.DrawFn, *, in_brackets: bool) -> list[tuple[str, list[str]]]:
    """Return effects with the lines in which each is written."""
    names = draw(st.lists(st.sampled_from(NAMES), unique=True, max_size=5))
    found = []
    for name in names:
        written = _quoted(name, draw(st.sampled_from(["", "", "'", '"'])))
        forms = [[written], [f"{{{written}: {{gain: 1.50}}}}"], [f"{written}: {{gain: 1e-3}}"]]
        if not in_brackets:
            forms += [[f"{written}:"], [f"{written}:", "  gain: 2  # of the effect"]]
            forms += [[f"&x{name} {written}"], [f"? {written}", ": {gain: 3}"]]
        found.append((name, draw(st.sampled_from(forms))))
    return found


@st.composite
def block_lists(draw: st.DrawFn) -> Layout:
    """Return a job with its effects one a line."""
    items = [item for item in draw(_items(in_brackets=False)) if item]
    indent = " " * draw(st.integers(2, 6))
    dash = "-" + " " * draw(st.integers(1, 3))
    lines, comments = [], []
    for number, (_, written) in enumerate(items):
        if draw(st.booleans()):
            comments.append(f"# above {number}")
            lines.append(" " * draw(st.integers(0, 8)) + comments[-1])
        if draw(st.integers(0, 4)) == 0:
            lines.append("")
        remark = draw(st.sampled_from(["", "", "  # beside", " # beside: [a, b", "   "]))
        lines.append(f"{indent}{dash}{written[0]}{remark}")
        lines.extend(f"{indent}{' ' * len(dash)}{line}" for line in written[1:])
    if not items:
        lines.append("")
    key = "  effects:" + draw(st.sampled_from(["", "  # the model", " "]))
    after = draw(st.sampled_from(["", "    # below\n", "\n"]))
    body = "\n".join([key, *lines]) + "\n" if items else f"{key.rstrip()}\n".replace(":", ": []", 1)
    return draw(_wrapped(f"model:\n{body}", after, [name for name, _ in items], comments))


@st.composite
def bracketed_lists(draw: st.DrawFn) -> Layout:
    """Return a job with its effects in brackets, in one line or several."""
    items = draw(_items(in_brackets=True))
    comments: list[str] = []
    if draw(st.booleans()) and items:
        lines = []
        for number, (_, (written,)) in enumerate(items):
            if draw(st.booleans()):
                comments.append(f"# above, {number}")
                lines.append(f"    {comments[-1]}")
            is_last = number + 1 == len(items)
            comma = "," if not is_last or draw(st.booleans()) else ""
            remark = draw(st.sampled_from(["", "  # beside, too", " "]))
            lines.append(f"    {written}{comma}{remark}")
        body = "[\n" + "\n".join(lines) + "\n  ]"
    else:
        space = draw(st.sampled_from(["", " "]))
        comma = draw(st.sampled_from(["", ","])) if items else ""
        body = f"[{space}{', '.join(written for _, (written,) in items)}{comma}{space}]"
    names = [name for name, _ in items]
    if draw(st.booleans()) and "\n" not in body:
        return draw(_wrapped(f"model: {{effects: {body}}}\n", "", names, comments))
    remark = draw(st.sampled_from(["", "  # after the list"]))
    return draw(_wrapped(f"model:\n  effects: {body}{remark}\n", "", names, comments))


@st.composite
def _wrapped(draw: st.DrawFn, listed: str, after: str, names: list[str], comments: list[str]) -> Layout:
    """Return a list in a whole job, with one kind of line break, and perhaps none at its end."""
    tail = after + draw(st.sampled_from([TAIL, ""]))
    line_break = draw(st.sampled_from(["\n", "\n", "\r\n", "\r"]))
    head, listed, tail = (part.replace("\n", line_break) for part in (HEAD, listed, tail))
    if not tail and draw(st.booleans()):
        listed = listed.removesuffix(line_break)
    return Layout(head, listed, tail, tuple(names), tuple(comments))


layouts = st.one_of(block_lists(), bracketed_lists())
