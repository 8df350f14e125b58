"""Marks on what is not the laboratory's own: data of the customer, and results of external providers."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.job.keys import JobKeys

#: Behind the name of what the customer supplied, and of what an external provider did.
BY_CUSTOMER = "†"
EXTERNAL = "‡"


@dataclass(frozen=True, slots=True)
class Marks:
    """Whose the values of a job are, where they are not the laboratory's own.

    Attributes
    ----------
    by_customer, external
        Dotted job keys.
    """

    by_customer: frozenset[str] = frozenset()
    external: frozenset[str] = frozenset()

    @classmethod
    def of(cls, keys: JobKeys) -> Marks:
        """Return the marks that a job asks for."""
        return cls(
            frozenset(keys.provided_by_customer),
            frozenset(key for each in keys.external for key in each.keys),
        )

    def after(self, *keys: str) -> str:
        """Return the marks behind the name of what comes from these keys: ``' †'``; empty for most.

        Parameters
        ----------
        keys
            Dotted. A group is marked if anything in it is somebody else's, and a key if its group is.
        """
        found = [
            mark
            for mark, named in ((BY_CUSTOMER, self.by_customer), (EXTERNAL, self.external))
            if any(_related(key, each) for key in keys for each in named)
        ]
        return f" {''.join(found)}" if found else ""


def _related(key: str, other: str) -> bool:
    """Whether two keys are one, or one of them is a group that the other is in."""
    return f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}.")


#: Of a document whose every value is the laboratory's own.
NO_MARKS = Marks()
