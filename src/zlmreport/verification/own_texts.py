"""Finds free texts of a laboratory in a certificate, quoted because nobody can verify them.

No reading gives them, and nothing computes them again. So they may say anything; what says a result, or that
one is met, leaves a certificate undecided, and whoever reads it decides.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from functools import cache

from pydantic import BaseModel

from zlmreport.document.certificate.document import Certificate
from zlmreport.document.certificate.own_words import fill_in
from zlmreport.errors import InputError, describe_character
from zlmreport.job.choices import Choice, ExtensionChoice
from zlmreport.job.job import Job
from zlmreport.job.parse import list_invisible
from zlmreport.job.types import list_free_texts
from zlmreport.language import Words
from zlmreport.verification.findings import QuotedText

_WORD = re.compile(r"[^\W\d_]+")
#: What looks like a number and has letters among its digits: ``l,O`` and ``1O``.
_AMONG_DIGITS = re.compile(
    r"(?<![^\W_])(?=[\d.,]*[lIO|o])(?:[lIO|o]*\d[\dlIO|o]*(?:[.,][\dlIO|o]+)*|[lIO|o]+[.,][\dlIO|o]+)(?![^\W_])"
)
_AS_DIGITS = str.maketrans("lI|Oo", "11100")
_MICRO = str.maketrans("µμ", "uu")
#: What stands for a sign of a number, whatever its length.
_DASHES = str.maketrans(dict.fromkeys("‐‑‒–—−﹣－", "-"))
#: Scripts that one word may have together (UTS #39, highly restrictive).
_TOGETHER = (
    {"HAN", "HIRAGANA", "KATAKANA", "LATIN"},
    {"HAN", "HANGUL", "LATIN"},
    {"HAN", "BOPOMOFO", "LATIN"},
)
_OF_ALL = frozenset({"COMMON", "INHERITED"})
_MIXED = Words("'{word}' mixes letters of {scripts}")
_WHOLLY = Words("'{word}' is written in {scripts} letters that look like '{like}'")
_DIGITS = Words("'{word}' has letters where digits belong")
_OTHER_DIGITS = Words("'{word}' has digits of another script: {like}")
_UNSEEN = Words("has an {character}")


def read_as(text: str) -> str:
    """Return what a reader takes a text for: Latin letters, ASCII digits, and nothing that is not seen.

    Letters that look like digits, among digits, are digits.

    >>> read_as("\N{CYRILLIC CAPITAL LETTER A} = 1,0"), read_as("l,O \N{MICRO SIGN}m"), read_as("10⁻³")
    ('A = 1,0', '1,0 um', '10-3')
    """
    seen = "".join(each for each in text if not list_invisible(each))
    plain = unicodedata.normalize("NFKC", seen).translate(_DASHES).translate(_MICRO)
    latin = "".join(map(_find_latin, plain))
    return _AMONG_DIGITS.sub(lambda found: found[0].translate(_AS_DIGITS), latin)


@cache
def _find_latin(letter: str) -> str:
    """Return the ASCII letter or digit that a letter looks like; itself where it looks like none."""
    if letter.isascii():
        return letter
    digit = unicodedata.decimal(letter, None)
    if digit is not None:
        return str(digit)
    from confusable_homoglyphs import confusables  # noqa: PLC0415 - slow to load

    alike = (each["c"] for each in confusables.confusables_data.get(letter, ()))
    return next((each for each in alike if len(each) == 1 and each.isascii() and each.isalnum()), letter)


def find_oddities(text: str) -> Iterator[Words]:
    """Yield what nobody can tell by looking: mixed scripts, look-alikes, invisible characters."""
    for character in dict.fromkeys(list_invisible(text)):
        yield _UNSEEN.given(character=describe_character(character))
    for word in dict.fromkeys(_WORD.findall(text)):
        yield from _find_in_word(word)
    for number in dict.fromkeys(re.findall(r"[\w.,]+", text)):
        if _AMONG_DIGITS.fullmatch(number):
            yield _DIGITS.given(word=number)
        elif any(each.isdecimal() and not each.isascii() for each in number):
            yield _OTHER_DIGITS.given(word=number, like=read_as(number))


def _find_in_word(word: str) -> Iterator[Words]:
    from confusable_homoglyphs import categories  # noqa: PLC0415 - slow to load

    if word.translate(_MICRO).isascii():  # a micro sign is written in two ways
        return
    scripts = set(map(str, categories.unique_aliases(word))) - _OF_ALL
    named = ", ".join(sorted(each.title() for each in scripts))
    if len(scripts) > 1 and not any(scripts <= allowed for allowed in _TOGETHER):
        yield _MIXED.given(word=word, scripts=named)
    elif "LATIN" not in scripts and (like := "".join(map(_find_latin, word))).isascii():
        yield _WHOLLY.given(word=word, scripts=named, like=like)


#: The last steps of keys whose texts name installed things, files and hosts, and say nothing to a reader.
_NAMES_OF_THINGS = frozenset(
    {
        *("axis", "chain", "controller", "effects", "error", "extends", "formats", "host", "plugin"),
        *("program", "standard"),
    }
)
#: Where lengths are what is asked for: how the measurement was set up, what was adjusted, why a contribution
#: is negligible.
_OF_LENGTHS = frozenset({"adjustment", "line", "negligible", "sensors"})
#: A device is called by its range: ``Laser triangulation sensor, range 100 mm``.
_OF_DEVICES = frozenset({"model", "name"})
_RANGE = re.compile(r"(?<![\d.,])[1-9]\d*(?:[.,]\d+)?\s*[mc]m(?![A-Za-z])")
#: Texts that come with the files, and are no key of the job.
_OF_FILES = frozenset({"files", "readings"})
#: Under which name a remark on readings has what an operator said.
_SAID = "text"
_NUMBER_OF_DOCUMENT = "certificate.number"
_MARGINS = frozenset({"certificate.style.footer", "certificate.style.header", "certificate.title"})

_COUNT = (
    r"(?:one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|half|quarter|tenths?|hundredths?|"
    r"thousandths?|ein(?:e[nmrs]?)?|zwei|drei|vier|fünf|sechs|sieben|acht|neun|zehn|elf|zwölf|halbe[nrs]?|"
    r"zehntel|hundertstel|tausendstel)(?:\s+(?:of\s+)?an?|\s+eine[rs])?"
)
#: Lengths and angles in which a deviation may be stated; a metre and a degree are of travels.
_UNIT = (
    r"(?:u\s*m|(?-i:n)\s?m|m\s*m|c\s*m|мкм|мм|нм|微米|毫米|u\s*inch|inch(?:es)?|mils?|thou|zoll|"
    r"(?:micro|nano|milli|centi|mikro|zenti)[\s-]*met(?:er|re)s?n?|microns?|mikron|"
    r"arc[\s-]*sec(?:onds?)?|(?:bogen|winkel)sekunden?|″|′′|u\s*rad|m\s*rad)(?![A-Za-z])"
)
#: What a length by another unit is: an expansion (µm/(m·K)), a feed (mm/min).
_OF_ELSE = r"(?!\s*(?:/|per|je)\s*\(?\s*(?:(?:m\s*[·*.]?\s*)?K|min|s|rev|U)\b)"
_AMOUNT = re.compile(
    rf"(?:\d[\d.,]*(?:[eE^]?[+-]?\d+)?|(?<![^\W_])[lIO|o]{{1,4}}|\b{_COUNT})[\s-]*{_UNIT}{_OF_ELSE}"
    r"|\b0[.,]000\d*\s*m\b|\d\s*[·×x*]\s*10\^?-\d+\s*m\b|\d[eE]-\d+\s*m\b",
    re.IGNORECASE,
)
_VERDICT = re.compile(
    r"[✓✔☑✅✗✘✖❌☒👍👎]|(?<![^\W_])(?:"
    r"(?:non-?)?conform(?:s|ed|ing|ity|ance|ant)?|compl(?:y|ies|ied|iant|iance)|pass(?:es|ed)?|fail(?:s|ed)?|"
    r"accept(?:ed|able|s)?|reject(?:ed)?|approved|"
    r"(?:tolerances?|limits?|specifications?|requirements?)\s+(?:\w+\s+)?(?:is|are|was|were)\s+(?:\w+\s+)?"
    r"(?:met|kept|held|satisfied|fulfilled|exceeded)|(?:within|inside|out\s+of|outside)\s+(?:\w+\s+){0,2}"
    r"(?:tolerances?|limits?|specifications?|spec)|"
    r"(?:nicht\s?)?konform(?:e[nrs]?|ität)?|(?:nicht\s+)?bestanden|(?:nicht\s+)?erfüllt|eingehalten|"
    r"überschritten|(?:un)?zulässig|freigegeben|angenommen|abgelehnt|in\s+ordnung|n?\.?\s?i\.\s?o\.|"
    r"innerhalb\s+(?:\w+\s+){0,2}(?:toleranz(?:en)?|grenzen|grenzwerte)"
    r")(?![^\W_])",
    re.IGNORECASE,
)
#: A number of a page or of a document where those of this one stand.
_OF_A_DOCUMENT = re.compile(
    r"\b(?:page|seite|sheet|blatt)\s+\w+\s*(?:/|of|von)\s*\w+"
    r"|\b(?:certificate|report|\w*schein|\w*zertifikat|\w*bericht)\s*(?:no\.?|nr\.?|number|nummer)?\s*:?\s*"
    r"[A-Za-z-]*\d",
    re.IGNORECASE,
)
_LONGEST = 80

_STATED = Words("'{text}' is the laboratory's own word: no reading gives its numbers")
_NUMBERED = Words(
    "'{text}' is the laboratory's own word: it numbers pages or documents where this one's number stands"
)


def quote_own_texts(certificate: Certificate, job: Job) -> tuple[QuotedText, ...]:
    """Return the words of a job that are printed as they stand, each once.

    A text that nobody sees the claim of, for its letters only look like it, makes that claim too.
    """
    symbols = {
        parameter.quantity.symbol.split("_")[0]
        for evaluation in certificate.evaluations
        for parameter in evaluation.parameters
    }
    return _quote_texts(_list_texts(certificate, job), symbols)


def quote_own_texts_of(keys: BaseModel) -> tuple[QuotedText, ...]:
    """Return the words of a file's keys, of which no job is made."""
    return _quote_texts(_list_free(keys), set())


def _quote_texts(texts: Iterable[tuple[str, str]], symbols: set[str]) -> tuple[QuotedText, ...]:
    letters = "|".join(map(re.escape, sorted(symbols | {"U"})))
    result = re.compile(
        rf"(?<![^\W_])(?:{letters})(?:_\w+|[↑↓])?\s*(?:(?:[=:≈<>≤≥]|is|ist)\s*[+±-]?\d|\d+[.,]\d)",
        re.IGNORECASE,
    )
    found = [
        QuotedText(key, text, tuple(find_oddities(text)), _find_claim(key, text, result))
        for key, text in dict.fromkeys(texts)
    ]
    return tuple(each for each in found if each.key not in _OF_FILES or _is_saying_something(each))


def _is_saying_something(text: QuotedText) -> bool:
    """Whether it is what somebody said, or odd: a file has a name, which says nothing else."""
    return bool(text.oddities or text.claim or text.key == "readings")


def _find_claim(key: str, text: str, result: re.Pattern[str]) -> Words | None:
    read, steps = read_as(text), key.split(".")
    amounts = _RANGE.sub("", read) if steps[-1] in _OF_DEVICES else read
    if result.search(read) or (_AMOUNT.search(amounts) and _OF_LENGTHS.isdisjoint(steps)):
        claimed = _STATED
    elif _VERDICT.search(read):
        claimed = Words("'{text}' is the laboratory's own word: no decision rule gives such a verdict")
    elif key in _MARGINS and _OF_A_DOCUMENT.search(read):
        claimed = _NUMBERED
    else:
        return None
    return claimed.given(text=text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…")


def _list_texts(certificate: Certificate, job: Job) -> Iterator[tuple[str, str]]:
    """Yield the key of each text, and the text as it is printed: of the job, then of the files it names."""
    yield from _list_stated(job)
    yield from (("files", source.file.name) for source in certificate.sources)
    sets = {id(each.measurements): each.measurements for each in certificate.evaluations}
    for measurements in sets.values():
        for remark in measurements.provenance.remarks:
            said = remark.values.get(_SAID)  # what an operator said
            if isinstance(said, str):
                yield "readings", said


def _list_stated(job: Job, within: str = "") -> Iterator[tuple[str, str]]:
    """Yield the texts of a job, then those of the measurements and lines of which it is made."""
    for key, text in _list_free(job.keys):
        yield f"{within}{key}", _fill_in(text, job, key)
    choices: list[tuple[Choice | ExtensionChoice, str]] = [
        (job.source, "measurement.source"),
        *((each, f"evaluate.{number}") for number, each in enumerate(job.standards)),
        *((each, each.identifier) for each in job.extensions),
    ]
    for choice, key in choices:
        if isinstance(choice.options, BaseModel):
            yield from _list_free(choice.options, f"{within}{key}.")
    for name, part in (*job.measurements.items(), *job.tests.items()):
        yield from _list_stated(part, f"{within}{name}.")


def _list_free(keys: BaseModel, within: str = "") -> Iterator[tuple[str, str]]:
    """Yield the texts of keys that say something to a reader."""
    for key, text in list_free_texts(keys, within):
        name = [step for step in key.split(".") if not step.isdecimal()][-1]
        if not key.endswith(_NUMBER_OF_DOCUMENT) and name not in _NAMES_OF_THINGS:
            yield key, text


def _fill_in(text: str, job: Job, key: str) -> str:
    """Return a text with what its keys in braces stand for, where it may have any."""
    if not key.startswith(("certificate.sections.", "certificate.style.", "certificate.title")):
        return text
    try:
        return fill_in(text, job, key)
    except InputError:
        return text
