"""The conformance kit: what a plugin must do, as checks that its author runs.

Each kind of plugin has a tuple of checks, which the built-in plugins pass too, and a function that runs
all of them and reports everything at once::

    from zlmreport.testing import check_standard

    def test_conforms() -> None:
        check_standard(HouseAcceptance())

or, with pytest, one test for each check::

    @pytest.mark.parametrize("check", STANDARD_CHECKS)
    def test_conforms(check) -> None:
        check(HouseAcceptance(), HouseAcceptanceOptions())

A check that fails raises an `AssertionError` whose sentence names the plugin, the part of it, and what was
expected. The kit needs no test framework.
"""

from zlmreport.testing.certificates import sample_certificate
from zlmreport.testing.circle_effects import (
    CIRCLE_EFFECT_CHECKS,
    check_circle_effect,
    make_circle_designs as circle_designs,
)
from zlmreport.testing.circle_programs import (
    CIRCLE_PROGRAM_CHECKS,
    CircleMove,
    check_circle_program,
    sample_circle_path,
)
from zlmreport.testing.controllers import CONTROLLER_CHECKS, ControlExample, check_controller
from zlmreport.testing.cross_tables import CrossExample, sample_cross_tables
from zlmreport.testing.effects import EFFECT_CHECKS, check_effect
from zlmreport.testing.examples import WorkedExample
from zlmreport.testing.extensions import EXTENSION_CHECKS, check_extension
from zlmreport.testing.instruments import INSTRUMENT_CHECKS, InstrumentTraits, check_instrument
from zlmreport.testing.measurements import bidirectional_test, full_designs, simulated_test
from zlmreport.testing.notifiers import NOTIFIER_CHECKS, NotifierTrial, check_notifier
from zlmreport.testing.part_programs import PART_PROGRAM_CHECKS, check_part_program, sample_motion
from zlmreport.testing.renderers import RENDERER_CHECKS, check_renderer
from zlmreport.testing.sources import SOURCE_CHECKS, FileContents, check_source
from zlmreport.testing.standards import STANDARD_CHECKS, check_standard

__all__ = [
    "CIRCLE_EFFECT_CHECKS",
    "CIRCLE_PROGRAM_CHECKS",
    "CONTROLLER_CHECKS",
    "EFFECT_CHECKS",
    "EXTENSION_CHECKS",
    "INSTRUMENT_CHECKS",
    "NOTIFIER_CHECKS",
    "PART_PROGRAM_CHECKS",
    "RENDERER_CHECKS",
    "SOURCE_CHECKS",
    "STANDARD_CHECKS",
    "CircleMove",
    "ControlExample",
    "CrossExample",
    "FileContents",
    "InstrumentTraits",
    "NotifierTrial",
    "WorkedExample",
    "bidirectional_test",
    "check_circle_effect",
    "check_circle_program",
    "check_controller",
    "check_effect",
    "check_extension",
    "check_instrument",
    "check_notifier",
    "check_part_program",
    "check_renderer",
    "check_source",
    "check_standard",
    "circle_designs",
    "full_designs",
    "sample_certificate",
    "sample_circle_path",
    "sample_cross_tables",
    "sample_motion",
    "simulated_test",
]
