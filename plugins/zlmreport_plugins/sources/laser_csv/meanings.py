"""Guesses what a column of an unknown table is, by its name in one of six languages and its numbers."""

from __future__ import annotations

import itertools
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from zlmreport.plugin import Approach, DecimalSign
from zlmreport.plugin.source import parse_number
from zlmreport.plugin.table import folded, without_thousands
from zlmreport_plugins.logged_columns import LOGGED, list_spellings
from zlmreport_plugins.sources.laser_csv.layouts import read_heading
from zlmreport_plugins.sources.laser_csv.options import (
    CHINESE_DIRECTIONS,
    COLUMN_NAMES,
    names_direction,
    run_and_direction,
)

#: How columns are called by the difference that they hold, folded, by the key ``sign``.
DIFFERENCES = MappingProxyType(
    {
        f"{first}{between}{second}": sign
        for actual, nominal in (("actual", "nominal"), ("actual", "target"), ("ist", "soll"))
        for sign, first, second in (("actual-nominal", actual, nominal), ("nominal-actual", nominal, actual))
        for between in ("_", "−", "_−_", "–", "_–_", "_minus_")
    }
)
#: What a name may mean beside the columns: a target or an actual position; a deviation or a position;
#: a reading of a run; nothing that is measured.
PLACE, VALUE, READING, NUMBER = "a position", "a value", "a reading", "a number of rows"
#: How columns are called in files, folded, by what they are.
_CALLED = MappingProxyType(
    dict(LOGGED)
    | {
        name: column
        for column, names in {
            "target": "soll sollposition soll_position soll_pos sollwert sollmaß nominal nominal_position "
            "nominal_value target_position target_pos zielposition pos_soll p_soll soll_pos. pos._soll "
            "cnc_position machine_position commanded_position programmed_position nc_position nominal_pos "
            "command commanded programmed setpoint set_position soll_x soll_y soll_z messpunkt zielpunkt "
            "soll_winkel sollwinkel target_angle x_soll y_soll z_soll cible position_cible consigne "
            "position_de_consigne position_visée position_nominale valeur_nominale quota_nominale "
            "posizione_nominale valore_nominale nominale posizione_target posizione_obiettivo "
            "quota_teorica posizione_teorica obiettivo objetivo posición_objetivo posición_nominal "
            "valor_nominal posición_de_consigna posición_programada cota_nominal "
            "目标位置 目标 目标点 目标值 理论位置 理论值 指令位置 指令值 指令 名义位置 "
            "名义值 标称位置 标称值 设定位置 设定值 "
            "目標位置 目標 目標値 目標值 理論位置 指令値 設定値 設定位置 標稱位置",
            PLACE: "position pos pos. x y z a b c winkel angle weg strecke distance place location punkt "
            "axis_position achsposition position_x position_y position_z "
            "abscisse posizione quota angolo distanza punto posición ángulo distancia cota "
            "位置 坐标 座標 测点 测量点 位置点 角度 距离 距離 测试位置",
            "position": "ist istposition ist_position ist_pos istwert actual actual_position actual_value "
            "measured measured_position pos_ist p_ist laser laserwert interferometer istmaß istwinkel "
            "ist_winkel x_ist y_ist z_ist measured_value position_réelle position_mesurée valeur_réelle "
            "valeur_mesurée posizione_reale posizione_effettiva posizione_misurata valore_misurato "
            "quota_misurata quota_reale posición_real posición_medida valor_medido valor_real cota_medida "
            "实际位置 实测位置 实际值 实测值 测量位置 測量位置 實際位置 實測位置 実測位置 実測値 測定位置",
            "deviation": "abweichung abw abw. fehler error dev dev. deviations positionsabweichung "
            "messabweichung differenz difference delta residual positionierabweichung positioning_error "
            "error_value δ positional_deviation position_error abweichungen lagefehler écart écarts erreur "
            "écart_de_position erreur_de_position différence déviation scostamento scostamenti scarto "
            "errore scostamento_di_posizione errore_di_posizione differenza deviazione desviación "
            "desviaciones desvío error_de_posición desviación_de_posición diferencia "
            "偏差 误差 偏差值 误差值 位置偏差 位置误差 定位误差 定位偏差 誤差 偏差値 位置誤差 定位誤差",
            VALUE: "wert value messwert reading anzeige display ergebnis result y_wert valeur mesure "
            "lecture affichage valore misura lettura indicazione valor medida lectura indicación "
            "测量值 测量结果 测值 读数 示值 数值 測量值 測定値",
            "direction": "richtung dir dir. approach anfahrrichtung verfahrrichtung sense anfahrt "
            "fahrtrichtung approach_direction sinn "
            "sens sens_d'approche sens_de_déplacement senso direzione verso senso_di_avvicinamento "
            "direzione_di_avvicinamento sentido dirección sentido_de_aproximación sentido_de_avance "
            "方向 运动方向 趋近方向 测量方向 移动方向 運動方向 測定方向 移動方向",
            "run": "lauf messlauf zyklus durchlauf durchgang cycle run_number run_no run_no. repetition "
            "rep wiederholung lauf_nr lauf_nr. run_# reihe messreihe passe parcours passage série essai "
            "répétition passata ciclo prova serie ripetizione recorrido pasada ensayo repetición "
            "次数 次 循环 循环次数 循环号 测量次数 测试次数 运行次数 轮次 遍数 "
            "次數 測量次數 循環 循環次數 回数 測定回数",
            NUMBER: "nr nr. no no. # index lfd lfd. lfd._nr. lfd_nr id i n zeile row line pos.nr. number "
            "point n° nº numéro ligne numero riga número fila "
            "序号 编号 点号 行号 序號 編號 番号",
        }.items()
        for name in list_spellings(names)
    }
)
#: The same in Chinese, where no blank parts words.
_CHINESE = (
    *("测量", "循环", "运行", "次数", "偏差", "误差", "读数", "位置", "第", "次", "遍", "值"),
    *("測量", "誤差"),
)
#: Words that stand beside run and direction in the name of a column of readings.
_BESIDE = frozenset(
    (
        *("run", "runs", "cycle", "pass", "meas", "measurement", "test", "series", "no", "number"),
        *("position", "pos"),
        *("lauf", "messlauf", "durchlauf", "durchgang", "zyklus", "messung", "messreihe", "reihe", "serie"),
        *("versuch", "nr", "nummer", "m", "x", "xi", "dev", "deviation", "abw", "abweichung", "ist"),
        *("actual", "wert", "value", "richtung", "direction", "fahrt"),
        *list_spellings("passe parcours passage essai mesure série numéro écart valeur sens lecture"),
        *list_spellings("passata ciclo prova misura serie numero scostamento valore senso direzione lettura"),
        *list_spellings("recorrido pasada ensayo medida medición número desviación valor sentido lectura"),
        *_CHINESE,
    )
)
#: Letters that say nothing more where the direction is told: ``R1 (+)``, ``j=1 ↑``.
_BESIDE_DIRECTIONS = frozenset({"r", "j"})
#: More digits than a number has that counts are several numbers, which no name of a column has.
_TOKENS = re.compile(
    rf"{'|'.join(sorted((*_CHINESE, *CHINESE_DIRECTIONS), key=len, reverse=True))}"
    r"|[^\W\d_]+|[0-9]{1,9}|[+−↑↓→←-]"
)
#: The number of a run in Chinese.
_NUMERALS = "一二三四五六七八九十"
_NUMERAL = re.compile(f"第([{_NUMERALS}])次")
#: Initials of the two directions, in several languages, that stand before the number of a run or behind it.
_PAIRS = ("fr", "fb", "vr", "hr", "ud", "ar", "pn")
_LETTERED = re.compile(r"([a-z])[\s_.-]?([1-9][0-9]?)|([1-9][0-9]?)[\s_.-]?([a-z])")
_MOST_RUNS = 99
_AXES = "axis|achse|(?<![^\\W_])(?:axe|asse|eje)|轴|軸"
_AXIS = re.compile(
    rf"(?:^|[^a-z])([xyzabcuvw])[\s_-]*(?:axis|achse|轴|軸)"
    rf"|(?:{_AXES})[\s:：;,=_-]*([xyzabcuvw])(?![a-z])",
    re.IGNORECASE,
)
#: The letter of an axis before or behind a name, folded.
_OF_AN_AXIS = re.compile(r"^[xyzabcuvw]_|_[xyzabcuvw]$")
_UNIT_BEHIND = re.compile(r"(.*?[0-9.,])\s*[^0-9.,\s+−-]{1,8}")
_ANGLE = re.compile(r"([+−-]?[0-9]+)\s*°.*")


@lru_cache(maxsize=4096)
def find_meaning(name: str) -> str | None:
    """Return what a column is by its name: one of `COLUMN_NAMES`, `PLACE`, `VALUE`; None if open."""
    called = folded(read_heading(name).name)
    without_axis = _OF_AN_AXIS.sub("", called)
    if called in _CALLED or without_axis in _CALLED:
        return _CALLED.get(called) or _CALLED[without_axis]
    if called in DIFFERENCES:
        return "deviation"
    if called in COLUMN_NAMES:
        return called
    return READING if find_reading_of(name) else None


@lru_cache(maxsize=4096)
def find_reading_of(name: str) -> tuple[int, Approach | None] | None:
    """Return the run, and the direction if it is named, of a column of readings: ``M1 (auf)``, ``2. Lauf ↓``.

    >>> find_reading_of("2. Lauf ab"), find_reading_of("Hin"), find_reading_of("Mittelwert 1")
    ((2, <Approach.NEGATIVE: -1>), (1, <Approach.POSITIVE: 1>), None)
    """
    called = _NUMERAL.sub(lambda match: f"第{_NUMERALS.index(match[1]) + 1}次", read_heading(name).name)
    told = run_and_direction(called)
    if told:
        return told
    tokens = _TOKENS.findall(called.casefold())
    directions = [token for token in tokens if names_direction(token)]
    numbers = [int(token) for token in tokens if token.isdecimal()]
    others = {token for token in tokens if token not in directions and not token.isdecimal()}
    beside = _BESIDE | _BESIDE_DIRECTIONS if directions else _BESIDE
    if not tokens or not others <= beside or len(directions) > 1 or len(numbers) > 1:
        return None
    if not directions and not (numbers and others):
        return None
    run = numbers[0] if numbers else 1
    told = run_and_direction(f"1{directions[0]}") if directions else (1, None)
    return (run, told[1]) if told and 1 <= run <= _MOST_RUNS else None


def find_meanings(names: Sequence[str]) -> list[str | None]:
    """Return what columns are by their names; an initial and a number is a reading beside its opposite."""
    lettered = find_lettered(names)
    return [READING if index in lettered else find_meaning(name) for index, name in enumerate(names)]


def find_lettered(names: Sequence[str]) -> dict[int, tuple[int, Approach]]:
    """Return run and direction of columns by their places that initials tell: each run has both.

    >>> [approach.sign for _, approach in find_lettered(["Target", "F1", "R1"]).values()]
    ['+', '-']
    """
    matches = [_LETTERED.fullmatch(read_heading(name).name.casefold()) for name in names]
    told = [
        (index, match[1] or match[4], match[2] or match[3]) for index, match in enumerate(matches) if match
    ]
    for pair in _PAIRS:
        runs = [{run for _, letter, run in told if letter == each} for each in pair]
        if runs[0] and runs[0] == runs[1]:
            return {
                index: (int(run), Approach(1 if letter == pair[0] else -1))
                for index, letter, run in told
                if letter in pair
            }
    return {}


def find_axis_in(text: str) -> str:
    """Return the letter of the axis that a text names; empty if it names none.

    >>> find_axis_in("Achse: y"), find_axis_in("x-axis, 2nd test"), find_axis_in("axe Z"), find_axis_in("max")
    ('Y', 'X', 'Z', '')
    """
    match = _AXIS.search(text)
    return (match[1] or match[2]).upper() if match else ""


@dataclass(frozen=True, slots=True)
class Notation:
    """How the numbers of a table are written."""

    decimal: DecimalSign
    thousands: str = ""  #: What parts groups of three digits; empty where nothing does.
    is_open: bool = False  #: Whether no number tells the one sign from the other.

    @classmethod
    def of(cls, cells: Iterable[str], *, is_workbook: bool = False) -> Notation:
        """Return the notation that explains the numbers among cells; those of a workbook have a point."""
        decimals, groups, doubt = Counter[str](), Counter[str](), set[str]()
        for cell in cells:
            match = _DIGITS.match(cell.lstrip("+-−"))
            signs = [sign for sign in match[0] if not sign.isdecimal()] if match else []
            if match is None or not signs:
                continue
            *apart, last = signs
            before, _, _ = match[0].rpartition(last)
            if len(set(apart)) == 1 and last not in apart and last in ".," and _GROUPS.fullmatch(before):
                groups[apart[0]] += 1
                decimals[last] += 1
            elif _GROUPS.fullmatch(match[0]) and {*apart} <= {last}:
                if apart or last not in ".,":
                    groups[last] += 1
                else:
                    doubt.add(last)
            elif not apart and last in ".,":
                decimals[last] += 1
        if is_workbook and not decimals[","]:
            return cls(DecimalSign.POINT, groups.most_common(1)[0][0] if groups else "")
        of_groups = groups.most_common(1)[0][0] if groups else ""
        told = max(decimals, key=lambda sign: decimals[sign], default="")
        if not told and of_groups in {".", ","}:
            told = "," if of_groups == "." else "."
        other = "," if told == "." else "."
        if told:
            return cls(DecimalSign(told), of_groups or (other if other in doubt else ""))
        return cls(DecimalSign.COMMA if doubt == {","} else DecimalSign.POINT, "", is_open="," in doubt)


#: The digits of a number at the beginning of a cell, with all that parts them.
_DIGITS = re.compile(r"[0-9.,](?:[0-9.,'’ \u00a0\u202f]*[0-9])?")
_GROUPS = re.compile(r"[1-9][0-9]{0,2}(?:[.,'’ \u00a0\u202f][0-9]{3})+")


@lru_cache(maxsize=65536)
def read_number(cell: str, notation: Notation) -> float | None:
    """Return the number that a cell holds in a notation, its unit left out; None for anything else.

    >>> german = Notation(DecimalSign.COMMA, ".")
    >>> [read_number(cell, german) for cell in ("1.250,5", "0,002 mm", "−3", "kalt")]
    [1250.5, 0.002, -3.0, None]
    """
    angle = _ANGLE.fullmatch(cell)
    if angle:
        cell = angle[1]
    elif cell and not cell[-1].isdecimal() and (match := _UNIT_BEHIND.fullmatch(cell)):
        cell = match[1]
    plain = without_thousands(cell, notation.thousands) if notation.thousands else cell
    for sign in (notation.decimal, *DecimalSign) if "," not in cell else (notation.decimal,):
        try:
            return parse_number(plain, sign)
        except ValueError:
            continue
    return None


def resolve_meanings(names: Sequence[str], columns: Sequence[Sequence[float | None]]) -> list[str | None]:
    """Return what columns are, where one alone leaves it open: each of `COLUMN_NAMES` once, readings, None.

    `columns`: Their numbers, by row.
    """
    found = find_meanings(names)
    readings = found.count(READING)
    _settle(found, PLACE, "target")
    if "target" not in found and readings:
        rising = (index for index, each in enumerate(columns) if found[index] is None and _is_monotonic(each))
        index = next(rising, None)
        if index is not None:
            found[index] = "target"
    has_value = "deviation" in found or "position" in found
    if "target" in found and not has_value and not readings:
        _settle(found, PLACE, "position")
        if VALUE in found and "position" not in found:
            target = columns[found.index("target")]
            value = columns[found.index(VALUE)]
            _settle(found, VALUE, "position" if are_positions(target, value) else "deviation")
    taken: set[str] = set()
    for index, each in enumerate(found):
        if each in {PLACE, VALUE, NUMBER} or (each in taken and each != READING):
            found[index] = None
        elif each:
            taken.add(each)
    return found


def _settle(found: list[str | None], what: str, meant: str) -> None:
    """Say what the first column is whose name leaves it open, unless another one is that."""
    if meant not in found and what in found:
        found[found.index(what)] = meant


def _is_monotonic(values: Sequence[float | None]) -> bool:
    known = [value for value in values if value is not None]
    steps = [second - first for first, second in itertools.pairwise(known)]
    return len(known) > 1 and (all(step > 0 for step in steps) or all(step < 0 for step in steps))


def are_positions(targets: Sequence[float | None], values: Sequence[float | None]) -> bool:
    """Return whether values go with the targets: they are positions then, and no deviations."""
    pairs = [
        (target, value)
        for target, value in zip(targets, values, strict=False)
        if target is not None and value is not None
    ]
    travel = max((target for target, _ in pairs), default=0.0) - min(
        (target for target, _ in pairs), default=0.0
    )
    return travel > 0 and all(abs(value - target) < 0.01 * travel for target, value in pairs)
