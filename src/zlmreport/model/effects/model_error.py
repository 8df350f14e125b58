"""What is raised of a model that readings cannot carry."""

from __future__ import annotations

from collections.abc import Sequence


class ModelError(Exception):
    """A model that these readings cannot carry.

    `sentences`: What is wrong and what would be right, each fit to stand behind a place in a file.
    """

    def __init__(self, sentences: Sequence[str]) -> None:
        self.sentences = tuple(sentences)
        super().__init__("; ".join(self.sentences))

    def __reduce__(self) -> tuple[type[ModelError], tuple[tuple[str, ...]]]:
        """Let the error reach another process as it is."""
        return type(self), (self.sentences,)
