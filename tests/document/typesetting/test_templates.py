"""Templates run in a sandbox, and come from one package."""

from __future__ import annotations

import pytest
from jinja2 import TemplateNotFound
from jinja2.exceptions import SecurityError, UndefinedError

from zlmreport.document.typesetting.templates import make_environment


@pytest.mark.parametrize(
    "attack",
    [
        "{{ ''.__class__.__mro__[1].__subclasses__() }}",
        "{{ words.append('x') }}",
        "{{ words.clear() }}",
        "{{ call.__globals__ }}",
        "{{ '{0.__class__.__init__.__globals__}'.format(call) }}",
        "{{ range(10**9) | list }}",
    ],
)
def test_a_template_reaches_nothing_but_what_it_is_given(attack: str) -> None:
    words = ["a"]
    with pytest.raises((SecurityError, OverflowError)):
        make_environment().from_string(attack).render(words=words, call=lambda: None)
    assert words == ["a"]


@pytest.mark.parametrize("name", ["/etc/passwd", "../styles/A4.css", "../../../../etc/passwd", "none.html"])
def test_a_template_of_elsewhere_is_not_found(name: str) -> None:
    with pytest.raises(TemplateNotFound):
        make_environment().from_string("{% include name %}").render(name=name)


def test_a_value_that_is_missing_is_a_mistake_and_no_blank() -> None:
    with pytest.raises(UndefinedError):
        make_environment().from_string("{{ nothing }}").render()


def test_a_value_is_escaped() -> None:
    text = make_environment().from_string("<p title='{{ text }}'>{{ text }}</p>").render(text="<b>'&\"")
    assert text == "<p title='&lt;b&gt;&#39;&amp;&#34;'>&lt;b&gt;&#39;&amp;&#34;</p>"
