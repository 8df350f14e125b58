"""A data class that is made on use is what the standard library would have made."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from dataclasses import FrozenInstanceError, field
from typing import Any

import pytest

from zlmreport.values import dataclass


@dataclass(frozen=True, slots=True)
class _Reading:
    """What both make."""

    position: float
    runs: list[int] = field(default_factory=list)
    remark: str = field(default="none", compare=False)
    content: bytes = field(default=b"", repr=False)

    def __post_init__(self) -> None:
        if self.position < 0:
            raise ValueError("before the datum")


@dataclass(frozen=True, slots=True)
class _Warm(_Reading):
    """An heir."""

    temperature: float = 20.0


@dataclasses.dataclass(frozen=True)
class _OfTheStandardLibrary(_Reading):
    """An heir as a plugin's author would write it."""

    humidity: float = 50.0


class _WithMore(_Reading):
    """An heir that is no data class."""

    def __init__(self) -> None:
        super().__init__(1.0)
        self.more = 2.0


def test_fields_are_given_in_order_or_by_name_and_have_their_defaults() -> None:
    reading = _Warm(1.0, remark="cold")
    assert (reading.position, reading.runs, reading.remark, reading.temperature) == (1.0, [], "cold", 20.0)


def test_a_default_is_made_for_each_object() -> None:
    assert _Reading(1.0).runs is not _Reading(1.0).runs


def test_what_is_missing_is_named() -> None:
    with pytest.raises(TypeError, match=r"^_Reading\.__init__\(\) missing 1 required .* 'position'"):
        _Reading()  # type: ignore[call-arg]


def test_an_object_is_checked_when_it_is_made() -> None:
    with pytest.raises(ValueError, match="before the datum"):
        _Warm(-1.0)


def test_objects_are_alike_by_what_is_compared() -> None:
    assert _Reading(1.0, remark="a") == _Reading(1.0, remark="b") != _Reading(2.0)


def test_objects_of_two_classes_are_not_alike() -> None:
    assert _Reading(1.0) != _Warm(1.0)


def test_a_hash_is_of_what_is_compared() -> None:
    one, other = _Reading(1.0, (), "a"), _Reading(1.0, (), "b")  # type: ignore[arg-type]
    assert hash(one) == hash(other)


def test_it_prints_as_it_is_made() -> None:
    assert repr(_Reading(1.0, content=b"long")) == "_Reading(position=1.0, runs=[], remark='none')"


@pytest.mark.parametrize("reading", [_Reading(1.0), _Warm(1.0), _OfTheStandardLibrary(1.0), _WithMore()])
def test_it_is_frozen(reading: Any) -> None:
    with pytest.raises(FrozenInstanceError, match="cannot assign to field 'position'"):
        reading.position = 2.0
    with pytest.raises(FrozenInstanceError, match="cannot delete field 'position'"):
        del reading.position


def test_it_has_no_room_for_more() -> None:
    with pytest.raises(FrozenInstanceError):
        _Warm(1.0).more = 1.0  # type: ignore[attr-defined]
    assert not hasattr(_Warm(1.0), "__dict__")


def test_an_heir_that_is_no_data_class_can_have_more() -> None:
    reading = _WithMore()
    assert (reading.position, reading.more) == (1.0, 2.0)


@pytest.mark.parametrize("cls", [_Warm, _OfTheStandardLibrary])
def test_the_standard_library_knows_its_fields(cls: Any) -> None:
    reading = cls(1.0, [1])
    assert [each.name for each in dataclasses.fields(reading)][:2] == ["position", "runs"]
    assert dataclasses.replace(reading, position=2.0) == cls(2.0, [1])
    assert dataclasses.asdict(reading)["runs"] == [1]
    assert cls.__match_args__[0] == "position"


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda each: pickle.loads(pickle.dumps(each))])
def test_it_can_be_copied_and_sent_to_another_process(again: Any) -> None:
    assert again(_Warm(1.0, [1])) == _Warm(1.0, [1])
