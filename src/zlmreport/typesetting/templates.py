"""The Jinja environment: sandboxed, every value escaped, a missing one an error."""

from __future__ import annotations

import re
from dataclasses import fields
from functools import cache, lru_cache

from jinja2 import PackageLoader, StrictUndefined
from jinja2.sandbox import ImmutableSandboxedEnvironment
from markupsafe import Markup

from zlmreport.quantities.formatting import spans
from zlmreport.typesetting.contexts import Context, SymbolContext
from zlmreport.typesetting.resources import PACKAGE

#: Characters that XML 1.0 has no place for, not even escaped.
_NOT_IN_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


@cache
def environment() -> ImmutableSandboxedEnvironment:
    """Return the environment; templates are compiled once in a process."""
    return ImmutableSandboxedEnvironment(
        loader=PackageLoader(PACKAGE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        auto_reload=False,
    )


def render(context: Context) -> Markup:
    """Render the template that belongs to a context; characters that XML cannot hold are shown as U+FFFD."""
    values = {field.name: getattr(context, field.name) for field in fields(context)}
    text = environment().get_template(context.template).render(values)
    return Markup(_NOT_IN_XML.sub(_REPLACEMENT, text))  # noqa: S704 (the template has escaped every value)


@lru_cache(maxsize=1024)
def symbol(notation: str) -> Markup:
    """Set a symbol or a formula; the same few come again and again."""
    return render(SymbolContext(spans(notation)))
