"""Templates and their documented contexts are the same."""

from __future__ import annotations

import dataclasses
from importlib.resources import files

import pytest
from jinja2 import UndefinedError, meta, nodes

from zlmreport.document.certificate import document
from zlmreport.document.typesetting import overview, templates
from zlmreport.document.typesetting.resources import PACKAGE
from zlmreport.document.typesetting.templates import make_environment
from zlmreport.language.formatting import Span
from zlmreport.plugin.renderer import Facts

#: By name: a class with slots stands beside the one that it was made from, until that is collected.
CONTEXTS = list({each.__name__: each for each in templates.Context.__subclasses__()}.values())
TEMPLATES = sorted(file.name for file in (files(PACKAGE) / "templates").iterdir())
#: Templates that others import: they have no context of their own.
MACROS = ["overview_cell.html"]

#: What templates may look into, beside the contexts themselves.
PARTS = (
    templates.CellContext,
    templates.RowGroupContext,
    Facts,
    document.Certificate,
    document.Letterhead,
    document.Look,
    document.PageWords,
    document.Party,
    overview.LinkContext,
    overview.OverviewCellContext,
    overview.OverviewGroupContext,
    overview.OverviewMachineContext,
    overview.OverviewRowContext,
    overview.TileContext,
    Span,
)


def parsed(template: str) -> nodes.Template:
    loader = make_environment().loader
    assert loader is not None
    return make_environment().parse(loader.get_source(make_environment(), template)[0])


def test_each_template_has_one_context_and_each_context_its_template() -> None:
    assert sorted([*(each.template for each in CONTEXTS), *MACROS]) == TEMPLATES


@pytest.mark.parametrize("context", CONTEXTS, ids=lambda each: each.template)
def test_a_template_uses_what_its_context_documents_and_all_of_it(context: type[templates.Context]) -> None:
    used = meta.find_undeclared_variables(parsed(context.template))
    assert used == {field.name for field in dataclasses.fields(context)}


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_template_looks_only_into_fields_that_a_part_documents(template: str) -> None:
    of_loop = {"index", "first", "last", "revindex"}
    documented = (
        {field.name for part in PARTS for field in dataclasses.fields(part)} | of_loop | {"running_head"}
    )
    looked_at = {node.attr for node in parsed(template).find_all(nodes.Getattr)}
    assert looked_at <= documented


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_template_holds_layout_and_no_words(template: str) -> None:
    text = "".join(node.data for node in parsed(template).find_all(nodes.TemplateData))
    between_tags = "".join(part.rpartition(">")[2] for part in text.split("<"))
    assert not [character for character in between_tags if character.isalpha()]


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_template_never_trusts_a_value_of_its_context(template: str) -> None:
    trusted = [
        node.node for node in parsed(template).find_all(nodes.Filter) if node.name in {"safe", "forceescape"}
    ]
    assert all(isinstance(node, nodes.CondExpr | nodes.Const) for node in trusted)


def test_a_template_that_asks_for_what_it_is_not_given_fails() -> None:
    with pytest.raises(UndefinedError, match="nothing_such"):
        make_environment().from_string("{{ nothing_such }}").render()
