"""What is measured of diagonals, their names, and the parameters of ISO 230-6.

A body diagonal is named by the signs of the directions of its axes from its first position to its last: NPP
runs in −X, +Y, +Z. A face diagonal has its two axes before their signs, which is this program's naming.
"""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.plugin import ARCSECOND, Measurand, Words
from zlmreport.plugin.standard import Quantity, QuantityGroup

BODY = ("PPP", "NPP", "PNP", "NNP")
#: Both face diagonals of a plane by the squareness error that they show; on the first one both axes rise.
FACES = {"C0Y": ("XYPP", "XYNP"), "B0Z": ("XZPP", "XZNP"), "A0Z": ("YZPP", "YZNP")}
FACE = tuple(name for pair in FACES.values() for name in pair)

#: Of one diagonal: a length, which expands and which air and misalignment change, as along an axis.
DIAGONAL = Measurand(
    identifier="diagonal",
    title=Words("Positioning accuracy"),
    definition=Words("the actual displacement along the diagonal minus the nominal one"),
    is_position=True,
    sign=Words("actual − nominal displacement along the diagonal"),
    subject=Words("{name} along the diagonal {axis}"),
    bearer=Words("Diagonal {axis}"),
)
#: Of all of them.
DIAGONALS = Measurand(
    identifier="diagonals",
    title=Words("Diagonal displacement test"),
    definition=Words("the deviations of displacements along diagonals of the work space"),
    sign=DIAGONAL.sign,
    joins_tests=True,
    of_lines=DIAGONAL,
    test_names=(*BODY, *FACE),
    subject=Words("{name}"),
    bearer=Words("Diagonals {axis}"),
)

_SYSTEMATIC = QuantityGroup.SYSTEMATIC
_WHOLE = (
    Quantity(
        "E_d",
        "E_{d}",
        Words("Diagonal systematic deviation"),
        _SYSTEMATIC,
        "max(E_{PPP}; E_{NPP}; E_{PNP}; E_{NNP})",
        Words("The largest of the four body diagonals: an index of the volume, and no diagnosis."),
        never_below=tuple(f"E_{name}" for name in BODY),
    ),
    Quantity(
        "B_d",
        "B_{d}",
        Words("Diagonal reversal value"),
        _SYSTEMATIC,
        "max(B_{PPP}; B_{NPP}; B_{PNP}; B_{NNP})",
        Words("The largest reversal value of the four body diagonals."),
        never_below=tuple(f"B_{name}" for name in BODY),
    ),
)


def _define_of_one(name: str) -> Iterator[Quantity]:
    for way, arrow, of in (
        ("", "", Words("both directions")),
        ("_fwd", "↑", Words("positive direction")),
        ("_bwd", "↓", Words("negative direction")),
    ):
        means = f"x̄_{{i}}{arrow}" if arrow else "x̄_{i}↑; x̄_{i}↓"
        yield Quantity(
            f"E_{name}{way}",
            f"E_{{{name}}}{arrow}",
            Words("Systematic deviation of diagonal {name}, {of}").given(name=name, of=of),
            _SYSTEMATIC,
            f"max({means}) − min({means})",
            Words("The largest error of a distance between two positions on this diagonal."),
            never_below=() if way else (f"E_{name}_fwd", f"E_{name}_bwd", f"B_{name}"),
        )
    yield Quantity(
        f"B_{name}",
        f"B_{{{name}}}",
        Words("Reversal value of diagonal {name}").given(name=name),
        _SYSTEMATIC,
        "max(abs(x̄_{i}↑ − x̄_{i}↓))",
        Words("What the lost motion of all axes does along this diagonal."),
    )


def _define_of_a_face(symbol: str, pair: tuple[str, str]) -> Quantity:
    """Return the squareness error that both diagonals of a face show."""
    sign = "" if symbol == "B0Z" else "−"
    first, second = pair
    return Quantity(
        symbol,
        f"{symbol[0]}_{{{symbol[1:]}}}",
        Words("Squareness error from face diagonals"),
        _SYSTEMATIC,
        f"{sign}(ε_{{{first}}} − ε_{{{second}}})·D²/(2·a·b)",
        Words("A square face has diagonals of one length: ε is by how much of its length each is too long."),
        unit=ARCSECOND,
    )


QUANTITIES = (
    *_WHOLE,
    *(each for name in (*BODY, *FACE) for each in _define_of_one(name)),
    *(_define_of_a_face(symbol, pair) for symbol, pair in FACES.items()),
)
