"""The plugin host: one plugin's trouble is told by name, and no other plugin suffers from it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from importlib.metadata import distribution
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from job.jobs import SOUND, loaded
from offers import exemplary_registry, offering
from refusals import refusal, refused
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from testing.exemplary_effect import ExemplaryEffect
from testing.exemplary_program import ExemplaryProgram
from zlmreport.plugin import AccessError, InputError, Options, Place, Words, hookimpl
from zlmreport.plugin.kinds import CONTROLLER, EFFECT, SOURCE, STANDARD
from zlmreport.plugin.registry import DISABLE, FILES, Plugin, Registry, collect, find_plugins
from zlmreport.plugin.registry.candidate import UnfitError, check
from zlmreport_plugins.controllers.linuxcnc import LinuxCnc

SOUND_PLUGIN = (Plugin("sound", "sound_module"), offering([ExemplaryStandard()]))


def _collected(module: object) -> Registry:
    """Return the registry of a sound plugin and another one."""
    return collect([(Plugin("other", "other_module"), module), SOUND_PLUGIN])


def _reason(module: object) -> str:
    """Return why a plugin failed; the sound one beside it must not."""
    registry = _collected(module)
    assert [standard.identifier for standard in registry.standards] == ["exemplary:1"]
    (failed,) = registry.failed
    assert failed.plugin.name == "other"
    return failed.reason


def test_what_plugins_offer_is_found_by_name() -> None:
    registry = exemplary_registry()
    assert registry.standard("exemplary:1").designation == "EX 1"
    assert registry.source("exemplary-text").identifier == "exemplary-text"
    assert registry.renderer("exemplary").suffix == ".json"
    assert registry.effect("exemplary-wave").equation == "A·sin(2πP/Λ)"
    assert registry.part_program("exemplary-steps").suffix == ".steps"
    assert registry.failed == ()


def test_origin_of_each_is_known() -> None:
    plugin = exemplary_registry().find_origin(STANDARD, "exemplary:1")
    assert plugin.release == "exemplary-plugins 1.2"


def test_versions_are_those_of_the_plugins_that_made_the_results(tmp_path: Path) -> None:
    release = "exemplary-plugins 1.2"
    versions = exemplary_registry().list_versions(loaded(SOUND, tmp_path))
    assert versions == {"exemplary-text": release, "exemplary:1": release}


def test_order_of_plugins_does_not_matter() -> None:
    one = (Plugin("a"), offering([ExemplaryStandard()], renderers=[ExemplaryRenderer()]))
    other = (Plugin("b"), offering(sources=[ExemplarySource()]))
    there, back = collect([one, other]), collect([other, one])
    assert [each.identifier for each in there.list_offers()] == [
        each.identifier for each in back.list_offers()
    ]


def test_unknown_name_is_answered_with_the_nearest_at_its_place() -> None:
    assert refusal(exemplary_registry().standard, "exemplary:l", Place("job.yaml", 3, 5)) == (
        "job.yaml:3:5: no plugin provides standard 'exemplary:l'; "
        "did you mean 'exemplary:1'? (known: exemplary:1)"
    )


def test_unknown_name_is_answered_with_the_plugins_that_might_have_had_it() -> None:
    registry = collect([(Plugin("broken"), offering([object()]))], disabled=["resting"])
    message = refused(registry.renderer, "pdf").problems[0].message
    assert "no plugin provides format 'pdf'; there is none to choose from" in message
    assert "\n  plugin broken was not loaded: standard 'object' lacks identifier" in message
    assert f"\n  plugin resting is switched off by {DISABLE}" in message


def test_object_that_lacks_parts_is_named_with_them() -> None:
    class Half(ExemplaryStandard):
        identifier = "half"
        arithmetic: Any = property()
        notes: Any = property()

    assert _reason(offering([Half()])) == "standard 'half' lacks notes, arithmetic"


def test_class_in_place_of_an_object_is_refused() -> None:
    reason = _reason(offering(sources=[ExemplarySource]))
    assert reason == "zlmreport_sources offers the class ExemplarySource; offer an object of it"


@pytest.mark.parametrize("identifier", ["", "a b", "a,b", "-a", "ä", 5, None])
def test_identifier_must_be_a_word(identifier: Any) -> None:
    class Odd(ExemplaryRenderer):
        pass

    Odd.identifier = identifier
    assert "needs an identifier of letters, digits" in _reason(offering(renderers=[Odd()]))


@pytest.mark.parametrize("suffix", ["", "pdf", "./pdf", ".", "../x"])
def test_suffix_must_be_one(suffix: str) -> None:
    class Odd(ExemplaryRenderer):
        pass

    Odd.suffix = suffix
    assert _reason(offering(renderers=[Odd()])) == "format 'exemplary' needs a suffix such as '.pdf'"


def test_suffix_of_a_part_program_must_be_one() -> None:
    class Odd(ExemplaryProgram):
        suffix = "ngc"

    reason = _reason(offering(part_programs=[Odd()]))
    assert reason == "part program 'exemplary-steps' needs a suffix such as '.ngc'"


def test_title_must_be_words_in_all_languages() -> None:
    class Odd(ExemplarySource):
        title: Any = "only English"

    assert _reason(offering(sources=[Odd()])) == "data source 'exemplary-text' needs a title in Words"


@pytest.mark.parametrize(
    ("members", "lacking"),
    [
        ({"designation": None}, "designation: str, not None"),
        ({"notes": "take care"}, "notes: tuple[Words, ...], not str"),
        ({"notes": ("take care",)}, "notes[0]: Words, not str"),
        ({"notes": (Words("k is {k}"),)}, "notes[0]: no value for {k}"),
        (
            {"position_index": 1, "notes": None},
            "position_index: str, not int; notes: tuple[Words, ...], not None",
        ),
    ],
)
def test_members_must_be_of_the_types_that_their_interface_declares(
    members: dict[str, Any], lacking: str
) -> None:
    odd = type("Odd", (ExemplaryStandard,), members)()
    assert _reason(offering(standards=[odd])) == f"standard 'exemplary:1' needs {lacking}"


@pytest.mark.parametrize(
    ("changes", "lacking"),
    [
        ({"name": "spread"}, "name: Words, not str"),
        ({"name": Words("spread {k}")}, "name: no value for {k}"),
        ({"group": "random"}, "group: QuantityGroup, not str"),
        ({"meaning": Words(None)}, "meaning.en: str, not None"),  # type: ignore[arg-type]
    ],
)
def test_parts_of_members_must_be_of_their_types(changes: dict[str, Any], lacking: str) -> None:
    class Odd(ExemplaryStandard):
        quantities = (replace(ExemplaryStandard.quantities[0], **changes),)

    assert _reason(offering(standards=[Odd()])) == f"standard 'exemplary:1' needs quantities[0].{lacking}"


def test_confidence_of_a_controller_must_be_a_known_one() -> None:
    odd = type("Odd", (LinuxCnc,), {"confidence": "confirmed"})()
    with pytest.raises(UnfitError, match="needs a confidence of verified, documented or unconfirmed"):
        check(CONTROLLER, odd)


def test_options_must_be_options() -> None:
    class Odd(ExemplarySource):
        options = dict

    assert "needs options that are a subclass of Options" in _reason(offering(sources=[Odd()]))


def test_options_must_say_types_that_are_known() -> None:
    class Unknown(Options):
        file: Nowhere  # type: ignore[name-defined]  # noqa: F821 - that is what is told

    class Odd(ExemplarySource):
        options = Unknown

    assert _reason(offering(sources=[Odd()])) == (
        "data source 'exemplary-text' has options that cannot be used, Unknown: name 'Nowhere' is not defined"
    )


def test_key_of_the_job_is_no_key_of_a_plugin() -> None:
    class Greedy(Options):
        plugin: str = ""

    class Odd(ExemplarySource):
        options = Greedy

    assert _reason(offering(sources=[Odd()])) == (
        "data source 'exemplary-text' cannot have the key 'plugin' of its own: the job has one"
    )


def test_effect_whose_key_is_called_like_its_parameter_is_refused() -> None:
    class Ambiguous(Options):
        height: float = 0.0

    class Odd(ExemplaryEffect):
        options: Any = Ambiguous

    assert _reason(offering(effects=[Odd()])) == (
        "effect 'exemplary-wave' has two parameters or keys called 'height'"
    )


def test_hook_that_raises_is_told_with_its_line() -> None:
    @hookimpl
    def zlmreport_sources() -> Any:
        raise ZeroDivisionError("by zero")

    reason = _reason(SimpleNamespace(zlmreport_sources=zlmreport_sources))
    assert reason.startswith("ZeroDivisionError: by zero (test_plugins.py, line ")


def test_hook_that_raises_half_way_offers_nothing() -> None:
    @hookimpl
    def zlmreport_sources() -> Iterator[Any]:
        yield ExemplarySource()
        raise KeyError("second")

    registry = _collected(SimpleNamespace(zlmreport_sources=zlmreport_sources))
    assert registry.sources == ()
    assert registry.failed[0].reason.startswith("KeyError: 'second'")


def test_hook_that_forgets_to_return_is_told() -> None:
    assert _reason(offering(renderers=None)) == "zlmreport_renderers returns nothing; return a list"


def test_hook_that_offers_no_list_is_told() -> None:
    reason = _reason(offering(renderers=ExemplaryRenderer()))
    assert reason == "zlmreport_renderers returns an object of type ExemplaryRenderer; return a list"


def test_hook_with_arguments_that_there_are_not_is_told() -> None:
    @hookimpl
    def zlmreport_sources(config: Any) -> Any:
        return [config]

    assert "config" in _reason(SimpleNamespace(zlmreport_sources=zlmreport_sources))


def test_misspelt_hook_refuses_to_start() -> None:
    @hookimpl
    def zlmreport_standard() -> Any:
        return []

    with pytest.raises(
        InputError, match="plugin other: zlmreport_standard is no hook; did you mean 'zlmreport_st"
    ):
        _collected(SimpleNamespace(zlmreport_standard=zlmreport_standard))


def test_hook_without_its_mark_refuses_to_start() -> None:
    with pytest.raises(InputError, match="zlmreport_sources is not marked as a hook; put @hookimpl above it"):
        _collected(SimpleNamespace(zlmreport_sources=lambda: [ExemplarySource()]))


def test_module_that_imports_the_package_of_the_built_in_plugins_is_no_misspelt_hook() -> None:
    assert _collected(SimpleNamespace(zlmreport_plugins=sys, zlmreport_version="1")).failed == ()


def test_what_two_plugins_provide_is_refused_to_who_names_it() -> None:
    registry = _collected(offering([ExemplaryStandard()], [ExemplarySource()]))
    assert registry.source("exemplary-text").identifier == "exemplary-text"
    assert refusal(registry.standard, "exemplary:1", Place("job.yaml", 3, 5)) == (
        "job.yaml:3:5: two plugins provide standard 'exemplary:1': other_module and sound_module; "
        "switch one off: ZLMREPORT_DISABLE_PLUGINS=sound"
    )


def test_two_plugins_of_one_name_are_not_told_to_be_switched_off_by_it() -> None:
    plugins = (Plugin("exemplary:1", f"{name}_module", name, "1") for name in ("north", "south"))
    registry = collect((plugin, offering([ExemplaryStandard()])) for plugin in plugins)
    assert refusal(registry.standard, "exemplary:1", Place("job.yaml", 3, 5)) == (
        "job.yaml:3:5: two plugins provide standard 'exemplary:1': north_module and south_module; "
        "uninstall north or south"
    )


def test_standard_and_source_may_share_a_name() -> None:
    class Namesake(ExemplarySource):
        identifier = "exemplary:1"

    assert _collected(offering(sources=[Namesake()])).source("exemplary:1").identifier == "exemplary:1"


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a function that installs a distribution with one module and its entry point."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def installed(name: str, code: str) -> None:
        module = f"zlm_test_{name}"
        (tmp_path / f"{module}.py").write_text(code, encoding="utf-8")
        metadata = tmp_path / f"{module}-3.0.dist-info"
        metadata.mkdir()
        (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 3.0\n")
        (metadata / "entry_points.txt").write_text(f"[zlmreport]\n{name} = {module}\n")
        monkeypatch.delitem(sys.modules, module, raising=False)

    return installed


def _failed(name: str, registry: Registry) -> str:
    return next(each.reason for each in registry.failed if each.plugin.name == name)


def test_installed_plugin_is_found(install: Any) -> None:
    install("mine", "from testing.exemplary import ExemplarySource\n"
        "from zlmreport.plugin import hookimpl\n"
        "@hookimpl\n"
        "def zlmreport_sources():\n"
        "    return [ExemplarySource()]\n")  # fmt: skip
    registry = find_plugins({})
    assert registry.source("exemplary-text").identifier == "exemplary-text"
    assert registry.find_origin(SOURCE, "exemplary-text") == Plugin(
        "mine", "zlm_test_mine", "zlm_test_mine", "3.0"
    )


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        ("import no_such_module_anywhere", "No module named 'no_such_module_anywhere'"),
        ("raise OSError('cannot load library\\n libpango')", "cannot load library libpango"),
        ("1 / 0", "ZeroDivisionError: division by zero (zlm_test_broken.py, line 1)"),
        ("raise RuntimeError", "RuntimeError (zlm_test_broken.py, line 1)"),
        ("import sys\nsys.exit(3)", "SystemExit: 3 (zlm_test_broken.py, line 2)"),
        ("def", "invalid syntax (zlm_test_broken.py, line 1)"),
    ],
)
def test_plugin_that_cannot_be_imported_is_told_with_the_reason(code: str, reason: str, install: Any) -> None:
    install("broken", code)
    assert _failed("broken", find_plugins({})) == reason


def test_plugin_can_be_switched_off(install: Any) -> None:
    install("broken", "1 / 0")
    registry = find_plugins({DISABLE: "another, broken ,"})
    assert registry.disabled == ("broken",)
    assert "broken" not in [each.plugin.name for each in registry.failed]


def test_built_in_plugins_are_found_by_their_entry_points() -> None:
    points = distribution("zlmreport").entry_points
    names = {point.name for point in points if point.group.startswith("zlmreport.")}
    registry = find_plugins({})
    found = {each.plugin.name for each in registry.list_offers() if each.plugin.distribution == "zlmreport"}
    assert registry.failed == ()
    assert found == names


@pytest.fixture
def file(tmp_path: Path) -> Any:
    """Return a function that writes a plugin in a file of its own."""

    def written(code: str, name: str = "mine.py") -> Path:
        path = tmp_path / name
        path.write_text(code, encoding="utf-8")
        return path

    return written


EFFECT_FILE = """\
from testing.exemplary_effect import ExemplaryEffect
from zlmreport.plugin import hookimpl

class Mine(ExemplaryEffect):
    identifier = "my-effect"

@hookimpl
def zlmreport_effects():
    return [Mine()]
"""


def test_file_that_the_command_line_names_is_a_plugin(file: Any) -> None:
    path = file(EFFECT_FILE)
    registry = find_plugins({}, [path])
    assert registry.effect("my-effect").identifier == "my-effect"
    assert registry.find_origin(EFFECT, "my-effect") == Plugin("mine", str(path))


def test_file_that_the_environment_names_is_a_plugin(file: Any) -> None:
    path = file(EFFECT_FILE)
    assert find_plugins({FILES: f":{path}"}).effect("my-effect").identifier == "my-effect"


def test_file_that_is_named_twice_is_loaded_once(file: Any) -> None:
    path = file(EFFECT_FILE)
    assert find_plugins({FILES: str(path)}, [path, path]).effect("my-effect").identifier == "my-effect"


def test_file_may_use_options_of_its_own(file: Any) -> None:
    path = file(
        "from __future__ import annotations\n"
        "from pydantic import Field\n"
        "from zlmreport.job.types import Options\n"
        "class Own(Options):\n"
        "    order: Order = Field(3, description='x')\n"
        "Order = int\n"
        "Own.model_rebuild()\n"
    )
    assert find_plugins({}, [path]).failed == ()


def test_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(AccessError) as caught:
        find_plugins({}, [tmp_path / "none.py"])
    assert str(caught.value) == f"{tmp_path / 'none.py'}: there is no such plugin file"


def test_file_that_is_no_python_is_told(file: Any) -> None:
    path = file("", "mine.txt")
    with pytest.raises(InputError, match="is no Python file"):
        find_plugins({}, [path])


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("x = 1\n1 / 0\n", ":2:1: ZeroDivisionError: division by zero (mine.py, line 2)"),
        ("x = 1\ndef\n", ":2:1: invalid syntax (mine.py, line 2)"),
        ("import no_such_module_anywhere\n", ":1:1: No module named 'no_such_module_anywhere'"),
    ],
)
def test_file_that_does_not_load_ends_the_work_with_its_line(code: str, message: str, file: Any) -> None:
    path = file(code)
    assert refusal(find_plugins, {}, [path]) == f"{path}{message}"


def test_file_that_offers_what_is_no_effect_ends_the_work(file: Any) -> None:
    path = file(EFFECT_FILE.replace("[Mine()]", "[object()]"))
    assert refusal(find_plugins, {}, [path]).startswith(f"{path}: effect 'object' lacks identifier, title")


def test_file_that_offers_what_is_there_already_is_refused(file: Any, install: Any) -> None:
    install("installed", EFFECT_FILE)
    path = file(EFFECT_FILE)
    with pytest.raises(InputError, match="two plugins provide effect 'my-effect': zlm_test_installed and"):
        find_plugins({}, [path]).effect("my-effect")
