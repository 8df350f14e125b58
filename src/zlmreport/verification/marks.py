"""Reads a page's drawing mark by mark: paths, text, images, with tolerances; whatever library wrote it.

Only the operators that the project's renderers use are understood; any other is refused. So two pages that
were written by other libraries can be compared by what they show: each glyph by its outline and its text,
each line by its points, each picture by its pixels, every one in its place and its colour.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

from zlmreport.verification.fonts import read_glyphs

#: Points: half of the narrowest character's width, so that no decimal point passes a digit unseen.
TOLERANCE = 0.7
_STROKING = frozenset({"S", "B", "B*"})
#: Of sizes and widths of lines, relative to one.
_TOLERANCE_OF_SCALE = 0.02
_MOST_MARKS = 500_000
_MOST_STATES = 200

#: a, b, c, d, e, f of a transformation, as a PDF has it.
_Matrix: TypeAlias = tuple[float, float, float, float, float, float]
_UNIT: _Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


class ForeignError(ValueError):
    """Something is drawn in a way in which none of the project's renderers draws."""


@dataclass(frozen=True, slots=True)
class DrawnMark:
    """Something that is drawn."""

    what: tuple[Any, ...]  #: What it is: the glyph, the kind of line, the picture, and how it is coloured.
    scale: tuple[float, ...] = ()  #: Its size, or the width of its line.
    place: tuple[float, ...] = ()  #: Where it stands: x and y of each of its points, in points of the page.

    def is_as(self, other: DrawnMark) -> bool:
        """Whether the same is drawn: another place is no other mark, and another shape is."""
        return (
            self.what == other.what
            and _are_close(self.scale, other.scale, _TOLERANCE_OF_SCALE)
            and _are_close(self._shape, other._shape, TOLERANCE)
        )

    def is_where(self, other: DrawnMark) -> bool:
        """Whether both stand at the same place."""
        return _are_close(self.place, other.place, TOLERANCE)

    @property
    def _shape(self) -> tuple[float, ...]:
        return tuple(each - self.place[index % 2] for index, each in enumerate(self.place))


def _are_close(one: tuple[float, ...], other: tuple[float, ...], tolerance: float) -> bool:
    return len(one) == len(other) and all(
        abs(left - right) <= tolerance for left, right in zip(one, other, strict=True)
    )


@dataclass(frozen=True, slots=True)
class _State:
    matrix: _Matrix = _UNIT
    fill: tuple[Any, ...] = ()
    stroke: tuple[Any, ...] = ()
    alpha: str = ""
    width: float = 1.0
    style: tuple[Any, ...] = ()
    font: str = ""
    size: float = 0.0
    rise: float = 0.0
    spacing: float = 0.0


@dataclass(slots=True)
class _Pen:
    """The state of the drawing, and what is drawn so far."""

    resources: Mapping[str, Any]
    digest: Callable[[Any], str]
    known_fonts: dict[str, Any]
    state: _State = field(default_factory=_State)
    kept: list[_State] = field(default_factory=list)
    path: list[tuple[str, tuple[float, ...]]] = field(default_factory=list)
    clip: str = ""
    line: _Matrix = _UNIT
    text: _Matrix = _UNIT
    marks: list[DrawnMark] = field(default_factory=list)

    def change_state(self, **changed: Any) -> None:
        self.state = replace(self.state, **changed)

    def find_resource(self, kind: str, name: Any) -> Any:
        entries = self.resources.get(kind)
        found = entries.get_object().raw_get(str(name)) if entries is not None else None
        if found is None:
            raise ForeignError(f"draws by {kind}{name}, which it does not have")
        return found

    def draw_mark(self, *what: Any, scale: tuple[float, ...] = (), place: tuple[float, ...] = ()) -> None:
        if len(self.marks) >= _MOST_MARKS:
            raise ForeignError("draws more than any page of a certificate")
        self.marks.append(DrawnMark(what, scale, place))


def list_marks(page: Any, digest: Callable[[Any], str], known_fonts: dict[str, Any]) -> list[DrawnMark]:
    """Return what a page of pypdf draws.

    `known_fonts`: The glyphs of fonts that were met, by their digests; it is added to.

    Raises `ForeignError` if it draws in a way in which no certificate is drawn.
    """
    from pypdf.generic import ContentStream  # noqa: PLC0415 - slow to load

    resources = page.get("/Resources", {}).get_object()
    contents = page.get_contents()
    pen = _Pen(resources, digest, known_fonts)
    for operands, operator in ContentStream(contents, page.pdf).operations if contents is not None else ():
        draw = _OPERATORS.get(operator)
        if draw is None:
            raise ForeignError(
                f"draws by the operator {operator.decode('latin-1')!r}, as no certificate does"
            )
        try:
            draw(pen, *operands)
        except (TypeError, KeyError, IndexError, AttributeError) as error:
            raise ForeignError(f"draws by {operator.decode('latin-1')!r} as no certificate does") from error
    return pen.marks


def _multiply(one: _Matrix, other: _Matrix) -> _Matrix:
    a, b, c, d, e, f = one
    g, h, i, j, k, m = other
    return (a * g + b * i, a * h + b * j, c * g + d * i, c * h + d * j, e * g + f * i + k, e * h + f * j + m)


def _take_numbers(values: Any) -> Any:
    return tuple(float(each) for each in values)


def _save(pen: _Pen) -> None:
    if len(pen.kept) >= _MOST_STATES:
        raise ForeignError("keeps more states than any certificate")
    pen.kept.append(pen.state)
    pen.draw_mark("save")


def _restore(pen: _Pen) -> None:
    pen.state = pen.kept.pop()
    pen.draw_mark("restore")


def _transform(pen: _Pen, *values: Any) -> None:
    pen.change_state(matrix=_multiply(_take_numbers(values), pen.state.matrix))


def _make_style(name: str) -> Callable[..., None]:
    def draw(pen: _Pen, *values: Any) -> None:
        others = tuple(each for each in pen.state.style if each[0] != name)
        pen.change_state(style=tuple(sorted((*others, (name, repr(values))))))

    return draw


def _set_graphics_state(pen: _Pen, name: Any) -> None:
    pen.change_state(alpha=pen.digest(pen.find_resource("/ExtGState", name)))


def _set_colour(which: str, space: str = "") -> Callable[..., None]:
    def draw(pen: _Pen, *values: Any) -> None:
        rounded = tuple(round(value, 4) for value in _take_numbers(values))
        pen.change_state(**{which: (space or getattr(pen.state, which)[0], rounded)})

    return draw


def _set_colour_space(which: str) -> Callable[..., None]:
    def draw(pen: _Pen, name: Any) -> None:
        is_device = name in {"/DeviceGray", "/DeviceRGB"}
        space = str(name) if is_device else pen.digest(pen.find_resource("/ColorSpace", name))
        pen.change_state(**{which: (space, ())})

    return draw


def _add_segment(kind: str) -> Callable[..., None]:
    def draw(pen: _Pen, *values: Any) -> None:
        a, b, c, d, e, f = pen.state.matrix
        numbers = _take_numbers(values)
        pairs = zip(numbers[::2], numbers[1::2], strict=True)
        pen.path.append((kind, tuple(v for x, y in pairs for v in (a * x + c * y + e, b * x + d * y + f))))

    return draw


def _add_rectangle(pen: _Pen, *values: Any) -> None:
    x, y, width, height = _take_numbers(values)
    corners = ((x, y), (x + width, y), (x + width, y + height), (x, y + height), ())
    for kind, corner in zip("mlllh", corners, strict=True):
        _add_segment(kind)(pen, *corner)


def _paint(operator: str) -> Callable[..., None]:
    def draw(pen: _Pen) -> None:
        state = pen.state
        kinds = "".join(kind for kind, _ in pen.path)
        place = tuple(value for _, points in pen.path for value in points)
        if pen.clip:
            pen.draw_mark("clip", pen.clip, kinds, place=place)
        if operator != "n":
            a, b, c, d, *_ = state.matrix
            scale = tuple(state.width * each for each in (a, b, c, d)) if operator in _STROKING else ()
            colours = state.fill if operator != "S" else (), state.stroke if operator in _STROKING else ()
            pen.draw_mark(
                operator, kinds, colours, state.alpha, state.style if scale else (), scale=scale, place=place
            )
        pen.path, pen.clip = [], ""

    return draw


def _clip(rule: str) -> Callable[..., None]:
    def draw(pen: _Pen) -> None:
        pen.clip = rule

    return draw


def _set_text_matrix(pen: _Pen, *values: Any) -> None:
    pen.line = pen.text = _take_numbers(values)


def _begin_next_line(pen: _Pen, x: Any, y: Any) -> None:
    pen.line = pen.text = _multiply((1.0, 0.0, 0.0, 1.0, float(x), float(y)), pen.line)


def _set_font(pen: _Pen, name: Any, size: Any) -> None:
    used = pen.find_resource("/Font", name)
    digest = pen.digest(used)
    if digest not in pen.known_fonts:
        pen.known_fonts[digest] = read_glyphs(used.get_object())
    pen.change_state(font=digest, size=float(size))


def _set(which: str) -> Callable[..., None]:
    def draw(pen: _Pen, value: Any) -> None:
        pen.change_state(**{which: float(value)})

    return draw


def _set_visibility(_: _Pen, mode: Any) -> None:
    if mode != 0:
        raise ForeignError("draws words that nobody sees")


def _show_all(pen: _Pen, items: Any) -> None:
    state = pen.state
    table = pen.known_fonts[state.font]
    for item in items:
        if isinstance(item, int | float) or hasattr(item, "as_numeric"):
            moved = -float(item) / 1000 * state.size
            pen.text = _multiply((1.0, 0.0, 0.0, 1.0, moved, 0.0), pen.text)
            continue
        codes = getattr(item, "original_bytes", item)
        for high, low in zip(codes[::2], codes[1::2], strict=True):
            _show_glyph(pen, table.get(high << 8 | low))


def _show_glyph(pen: _Pen, known: Any) -> None:
    if known is None:
        raise ForeignError("draws a glyph of which it says no text")
    text, width, outline = known
    state = pen.state
    a, b, c, d, e, f = _multiply(
        (state.size, 0.0, 0.0, state.size, 0.0, state.rise), _multiply(pen.text, state.matrix)
    )
    pen.draw_mark("glyph", text, outline, state.fill, state.alpha, scale=(a, b, c, d), place=(e, f))
    advance = width / 1000 * state.size + state.spacing
    pen.text = _multiply((1.0, 0.0, 0.0, 1.0, advance, 0.0), pen.text)


def _place_picture(pen: _Pen, name: Any) -> None:
    picture = pen.find_resource("/XObject", name)
    if picture.get_object().get("/Subtype") != "/Image":
        raise ForeignError("draws by a form, as no certificate does")
    a, b, c, d, e, f = pen.state.matrix
    pen.draw_mark("picture", pen.digest(picture), pen.state.alpha, place=(e, f, a + e, b + f, c + e, d + f))


def _begin_marked(pen: _Pen, tag: Any, properties: Any = None) -> None:
    entries = properties.items() if isinstance(properties, dict) else [("", repr(properties))]
    pen.draw_mark("tag", str(tag), tuple(sorted((key, repr(value)) for key, value in entries)))


_OPERATORS: dict[bytes, Callable[..., None]] = {
    b"q": _save,
    b"Q": _restore,
    b"cm": _transform,
    b"w": _set("width"),
    **{name.encode(): _make_style(name) for name in "JjMd"},
    b"gs": _set_graphics_state,
    b"rg": _set_colour("fill", "rgb"),
    b"RG": _set_colour("stroke", "rgb"),
    b"g": _set_colour("fill", "grey"),
    b"G": _set_colour("stroke", "grey"),
    **dict.fromkeys((b"sc", b"scn"), _set_colour("fill")),
    **dict.fromkeys((b"SC", b"SCN"), _set_colour("stroke")),
    b"cs": _set_colour_space("fill"),
    b"CS": _set_colour_space("stroke"),
    **{name.encode(): _add_segment(name) for name in "mlch"},
    b"re": _add_rectangle,
    **{name.encode(): _clip(name) for name in ("W", "W*")},
    **{name.encode(): _paint(name) for name in ("n", "S", "f", "f*", "B", "B*")},
    b"BT": lambda pen: _set_text_matrix(pen, *_UNIT),
    b"ET": lambda _: None,
    b"Tm": _set_text_matrix,
    b"Td": _begin_next_line,
    b"Tf": _set_font,
    b"Ts": _set("rise"),
    b"Tc": _set("spacing"),
    b"Tr": _set_visibility,
    b"Tj": lambda pen, text: _show_all(pen, [text]),
    b"TJ": _show_all,
    b"Do": _place_picture,
    **dict.fromkeys((b"BMC", b"BDC"), _begin_marked),
    b"EMC": lambda pen: pen.draw_mark("end of tag"),
}
