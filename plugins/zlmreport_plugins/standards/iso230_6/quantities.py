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
    title=Words(en="Positioning accuracy", de="Positioniergenauigkeit"),
    definition=Words(
        en="the actual displacement along the diagonal minus the nominal one",
        de="die Istverlagerung längs der Diagonalen minus der Sollverlagerung",
    ),
    is_position=True,
    sign=Words(
        en="actual − nominal displacement along the diagonal",
        de="Istverlagerung − Sollverlagerung längs der Diagonalen",
    ),
    subject=Words("{name} along the diagonal {axis}", "{name} längs der Diagonalen {axis}"),
    bearer=Words(en="Diagonal {axis}", de="Diagonale {axis}"),
)
#: Of all of them.
DIAGONALS = Measurand(
    identifier="diagonals",
    title=Words(en="Diagonal displacement test", de="Prüfung der Diagonalen"),
    definition=Words(
        en="the deviations of displacements along diagonals of the work space",
        de="die Abweichungen der Verlagerungen längs der Diagonalen des Arbeitsraums",
    ),
    sign=DIAGONAL.sign,
    joins_tests=True,
    of_lines=DIAGONAL,
    test_names=(*BODY, *FACE),
    subject=Words("{name}", "{name}"),
    bearer=Words(en="Diagonals {axis}", de="Diagonalen {axis}"),
)

_SYSTEMATIC = QuantityGroup.SYSTEMATIC
_WHOLE = (
    Quantity(
        "E_d",
        "E_{d}",
        Words("Diagonal systematic deviation", "Systematische Abweichung der Diagonalen"),
        _SYSTEMATIC,
        "max(E_{PPP}; E_{NPP}; E_{PNP}; E_{NNP})",
        Words(
            "The largest of the four body diagonals: an index of the volume, and no diagnosis.",
            "Die größte der vier Raumdiagonalen: eine Kennzahl des Raums, keine Diagnose.",
        ),
    ),
    Quantity(
        "B_d",
        "B_{d}",
        Words("Diagonal reversal value", "Umkehrspanne der Diagonalen"),
        _SYSTEMATIC,
        "max(B_{PPP}; B_{NPP}; B_{PNP}; B_{NNP})",
        Words(
            "The largest reversal value of the four body diagonals.",
            "Die größte Umkehrspanne der vier Raumdiagonalen.",
        ),
    ),
)


def _of_one(name: str) -> Iterator[Quantity]:
    """Yield the parameters of a diagonal."""
    for way, arrow, of in (
        ("", "", Words("both directions", "beide Richtungen")),
        ("_fwd", "↑", Words("positive direction", "positive Richtung")),
        ("_bwd", "↓", Words("negative direction", "negative Richtung")),
    ):
        means = f"x̄_{{i}}{arrow}" if arrow else "x̄_{i}↑; x̄_{i}↓"
        yield Quantity(
            f"E_{name}{way}",
            f"E_{{{name}}}{arrow}",
            Words(
                "Systematic deviation of diagonal {name}, {of}",
                "Systematische Abweichung der Diagonalen {name}, {of}",
            ).given(name=name, of=of),
            _SYSTEMATIC,
            f"max({means}) − min({means})",
            Words(
                "The largest error of a distance between two positions on this diagonal.",
                "Der größte Fehler eines Abstands zweier Positionen auf dieser Diagonalen.",
            ),
        )
    yield Quantity(
        f"B_{name}",
        f"B_{{{name}}}",
        Words("Reversal value of diagonal {name}", "Umkehrspanne der Diagonalen {name}").given(name=name),
        _SYSTEMATIC,
        "max(abs(x̄_{i}↑ − x̄_{i}↓))",
        Words(
            "What the lost motion of all axes does along this diagonal.",
            "Was die Umkehrspannen aller Achsen längs dieser Diagonalen ausmachen.",
        ),
    )


def _of_a_face(symbol: str, pair: tuple[str, str]) -> Quantity:
    """Return the squareness error that both diagonals of a face show."""
    sign = "" if symbol == "B0Z" else "−"
    first, second = pair
    return Quantity(
        symbol,
        f"{symbol[0]}_{{{symbol[1:]}}}",
        Words("Squareness error from face diagonals", "Rechtwinkligkeitsabweichung aus Flächendiagonalen"),
        _SYSTEMATIC,
        f"{sign}(ε_{{{first}}} − ε_{{{second}}})·D²/(2·a·b)",
        Words(
            "A square face has diagonals of one length: ε is by how much of its length each is too long.",
            "Eine rechtwinklige Fläche hat gleich lange Diagonalen: ε ist, um welchen Teil ihrer Länge jede "
            "zu lang ist.",
        ),
        unit=ARCSECOND,
    )


QUANTITIES = (
    *_WHOLE,
    *(each for name in (*BODY, *FACE) for each in _of_one(name)),
    *(_of_a_face(symbol, pair) for symbol, pair in FACES.items()),
)
