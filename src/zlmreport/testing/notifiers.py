"""What every notifier must do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from zlmreport.errors import AccessError
from zlmreport.plugin.kinds import NOTIFIER
from zlmreport.plugin.protocols import Message, Notifier, Occasion
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_options,
    guard_subject,
    list_checks_of,
    run_all,
)

#: How many lines a message of the kit has: as after a bad night, some thousand characters.
_LINES = 60
#: With what is easily lost on the way: letters beyond ASCII, a dot alone on a line, what looks like markup.
SAMPLE = Message(
    Occasion.DIGEST,
    "Hall Süd: 1 failed, 1 changed",
    "Failed\n- jobs/x.yaml: <b> & 'Lagerweg' too short\n.\n\nUnchanged\n"
    + "".join(f"- MC {number}, Y: nothing new since the last night\n" for number in range(100, 100 + _LINES))
    + "\nChanged\n- MC 800, X: A + 4.2 µm, R − 0.3 µm\n",
)


@dataclass(frozen=True, slots=True)
class NotifierTrial:
    """Where the kit may send to.

    Attributes
    ----------
    keys
        By which a message arrives.
    taken
        Returns all that arrived there so far, as one text.
    to_nobody
        Keys by which nobody takes it: a closed port, an unknown address.
    secrets
        Passwords, and addresses that hold them, which no message may show.
    to_another
        Keys by which somebody else is told, of whose messages `taken` returns nothing; without them the kit
        cannot tell a notifier that knows one receiver only, and does not pass.
    """

    keys: Mapping[str, Any]
    taken: Callable[[], str]
    to_nobody: Mapping[str, Any]
    secrets: tuple[str, ...] = field(default=())
    to_another: Mapping[str, Any] | None = None


def _make_options(notifier: Notifier, keys: Mapping[str, Any]) -> Any:
    return notifier.options.model_validate(dict(keys))


@check
def is_named(notifier: Notifier, _trial: NotifierTrial) -> None:
    """Check its identifier and its title."""
    expect_named(notifier, NOTIFIER)


@check
def options_are_described(notifier: Notifier, _trial: NotifierTrial) -> None:
    """Check that its keys are described, and none is a key of the core."""
    expect_options(notifier, NOTIFIER)


@check
def names_who_is_told(notifier: Notifier, trial: NotifierTrial) -> None:
    """Check that the receiver is one line, always the same, and no secret."""
    guarded = guard_subject(notifier, NOTIFIER)
    named = [guarded.receiver(_make_options(notifier, trial.keys)) for _ in range(2)]
    expect(named[0] == named[1], f"{notifier.identifier}: receiver gives another name each time: {named}")
    _check_shows_no_secret(notifier, named[0], trial)


@check
def tells_all_of_it_once(notifier: Notifier, trial: NotifierTrial) -> None:
    """Check that title and text arrive letter by letter, one time."""
    before = trial.taken()
    notifier.tell(SAMPLE, _make_options(notifier, trial.keys))
    taken = trial.taken().removeprefix(before)
    expect(taken, f"{notifier.identifier}: nothing arrived, and tell raised nothing")
    lines = [line for line in (SAMPLE.title, *SAMPLE.text.splitlines()) if line]
    lost = [line for line in lines if line not in taken]
    expect(
        not lost,
        f"{notifier.identifier}: {lost[:1]} did not arrive as it is ({len(lost)} of {len(lines)} lines of a "
        f"message of {len(SAMPLE.text)} characters are not there); what arrived ends with {taken[-80:]!r}",
    )
    marked = SAMPLE.text.splitlines()[-1]
    expect(
        taken.count(marked) == 1, f"{notifier.identifier}: the message arrived {taken.count(marked)} times"
    )


@check
def tells_whom_its_keys_name(notifier: Notifier, trial: NotifierTrial) -> None:
    """Check that other keys name another receiver, and that what another is told does not come here."""
    name = notifier.identifier
    expect(
        trial.to_another,
        f"{name}: say by which keys somebody else is told: NotifierTrial(…, to_another={{…}}); nobody else "
        "can see a notifier that tells always the same",
    )
    one, another = _make_options(notifier, trial.keys), _make_options(notifier, trial.to_another or {})
    expect(
        notifier.receiver(one) != notifier.receiver(another),
        f"{name}: receiver is {notifier.receiver(one)!r} for other keys too; what was told to one receiver "
        "is not told to it again, so the second would hear nothing",
    )
    before = trial.taken()
    notifier.tell(SAMPLE, another)
    expect(
        trial.taken() == before, f"{name}: what somebody else is told arrives at {notifier.receiver(one)!r}"
    )


@check
def says_when_nobody_takes_it(notifier: Notifier, trial: NotifierTrial) -> None:
    """Check that what nobody took is an `AccessError` whose message shows no secret."""
    try:
        notifier.tell(SAMPLE, _make_options(notifier, trial.to_nobody))
    except AccessError as error:
        _check_shows_no_secret(notifier, str(error), trial)
    else:
        message = f"{notifier.identifier}: nobody took the message, and tell did not raise AccessError"
        raise AssertionError(message)


def _check_shows_no_secret(notifier: Notifier, text: str, trial: NotifierTrial) -> None:
    shown = any(secret in text for secret in trial.secrets)
    expect(not shown, f"{notifier.identifier}: what it says for others to read shows a secret")


#: Every check of a notifier, each called with it and a trial.
NOTIFIER_CHECKS = list_checks_of(__name__)


def check_notifier(notifier: Notifier, trial: NotifierTrial) -> None:
    """Run every check on a notifier; raise `AssertionError` with a line for every check that fails."""
    run_all(NOTIFIER, NOTIFIER_CHECKS, notifier, trial)
