"""The door: all that a plugin imports of zlmreport.

A name is looked up when it is used, and loads its own module only: so the door costs next to nothing, and a
plugin pays for what it needs. A name that says too little outside its module has a fuller one here.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from zlmreport.capture.events import Closed as DatumClosed
    from zlmreport.capture.events import Commented as OperatorCommented
    from zlmreport.capture.events import DatumHolds, DatumMoved, DatumTaken, ZeroLost
    from zlmreport.capture.events import Ended as CaptureEnded
    from zlmreport.capture.events import Recorded as ReadingRecorded
    from zlmreport.capture.events import Resumed as CaptureResumed
    from zlmreport.capture.events import Retake as OperatorRetake
    from zlmreport.capture.events import Skipped as OperatorSkipped
    from zlmreport.capture.history import Entry as JournalEntry
    from zlmreport.capture.history import History as JournalHistory
    from zlmreport.capture.history import read_history as read_journal
    from zlmreport.capture.options import CaptureOptions
    from zlmreport.capture.records import Header as JournalHeader
    from zlmreport.certificate.attachments import Attachment, Relationship
    from zlmreport.certificate.attachments import Source as CertificateSource
    from zlmreport.certificate.circumstances import Fact
    from zlmreport.certificate.columns import GatheredBlock, decimal_padding, gather_facts, table_layout
    from zlmreport.certificate.columns import side_by_side as facts_side_by_side
    from zlmreport.certificate.conditions import Described
    from zlmreport.certificate.conformity import STATEMENTS as CONFORMITY_STATEMENTS
    from zlmreport.certificate.cover import lines as address_lines
    from zlmreport.certificate.cover import place_of_work
    from zlmreport.certificate.document import (
        Align,
        Block,
        Cell,
        Certificate,
        Column,
        Explained,
        Facts,
        Formulas,
        Graph,
        Letterhead,
        Mark,
        Notice,
        PageWords,
        Paragraph,
        RowGroup,
        Section,
        Symbol,
        Table,
        Verdict,
    )
    from zlmreport.certificate.information import Information
    from zlmreport.certificate.statements import TRACEABLE
    from zlmreport.compensation.curve import CompensationTable
    from zlmreport.correction.refractive_index import (
        STANDARD_HUMIDITY,
        STANDARD_PRESSURE,
        index_change,
        refractive_index,
    )
    from zlmreport.emulation.emulator import Emulator, Scene, Trouble
    from zlmreport.errors import AccessError, InputError, Place, Problem, did_you_mean, quoted
    from zlmreport.evaluation.checks.positions import (
        exceeds,
        measured_length,
        positions_by_angle,
        positions_in_all,
        positions_over_travel,
        positions_per_metre,
        positions_per_scale_element,
        principal_angles,
    )
    from zlmreport.evaluation.checks.readings import (
        both_directions,
        fewest_runs,
        mean_interval,
        no_missing_readings,
        number_of_runs,
        random_fractions,
        spacing_against_periods,
    )
    from zlmreport.evaluation.conformity import Conformity, Decision
    from zlmreport.evaluation.decision import decided, decision_rule
    from zlmreport.evaluation.evaluate import evaluate
    from zlmreport.evaluation.evaluation import Arithmetic, Evaluation
    from zlmreport.evaluation.evaluation import Parameter as EvaluatedParameter
    from zlmreport.evaluation.printed import deviation as deviation_in_words
    from zlmreport.evaluation.printed import position as position_in_words
    from zlmreport.evaluation.printed import positions as positions_in_words
    from zlmreport.evaluation.printed import runs as runs_in_words
    from zlmreport.evaluation.quantity import Group as QuantityGroup
    from zlmreport.evaluation.quantity import PositionQuantity, Quantity
    from zlmreport.evaluation.report import report_evaluation
    from zlmreport.evaluation.requirements import Basis, Finding
    from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
    from zlmreport.evaluation.statistics import average as mean_over_positions
    from zlmreport.evaluation.statistics import largest as largest_over_positions
    from zlmreport.evaluation.statistics import smallest as smallest_over_positions
    from zlmreport.evaluation.statistics import span as span_over_positions
    from zlmreport.evaluation.statistics import width as range_over_positions
    from zlmreport.figures.alternatives import graph_of as graph_in_words
    from zlmreport.figures.alternatives import marks as marks_in_words
    from zlmreport.figures.alternatives import range_of as range_in_words
    from zlmreport.figures.alternatives import text as alternative_text
    from zlmreport.figures.canvas import Canvas, Colour, Fill, Segment, Stroke
    from zlmreport.figures.canvas import Face as FontFace
    from zlmreport.figures.canvas import Label as TextLabel
    from zlmreport.figures.canvas import Run as TextRun
    from zlmreport.figures.draw import draw as draw_figure
    from zlmreport.figures.draw import to_svg as figure_to_svg
    from zlmreport.figures.figure import Arrow, Band, Bracket, Curve, Figure, Level, Panel, Role
    from zlmreport.figures.layout import WIDTH as GRAPH_WIDTH
    from zlmreport.figures.layout import figure_size
    from zlmreport.figures.metrics import advance as text_advance
    from zlmreport.figures.metrics import has_letter, mark_offset, plain_label
    from zlmreport.figures.prescribed import DIRECTIONS as APPROACH_TITLES
    from zlmreport.figures.prescribed import LIMITS as LIMIT_ROLES
    from zlmreport.figures.prescribed import MEANS as MEAN_ROLES
    from zlmreport.figures.prescribed import Diagram
    from zlmreport.figures.prescribed import panel as diagram_panel
    from zlmreport.figures.prescribed import worst as worst_position
    from zlmreport.figures.scale import round_ticks
    from zlmreport.figures.style import INK as INK_COLOUR
    from zlmreport.figures.style import ROLES as ROLE_STYLES
    from zlmreport.figures.style import TEXT_SIZE as GRAPH_TEXT_SIZE
    from zlmreport.figures.svg import SvgCanvas
    from zlmreport.figures.svg import hexadecimal as hexadecimal_colour
    from zlmreport.files import Appended, take_names, unwritable
    from zlmreport.job.document_keys import Customer, Laboratory
    from zlmreport.job.extends import FileFormat
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys
    from zlmreport.job.loading import KeysFile, read_keys_file
    from zlmreport.job.measurement_keys import Instrument as JobInstrument
    from zlmreport.job.plan_keys import ProgramKeys
    from zlmreport.job.tree import Step as KeyStep
    from zlmreport.job.types import Date, Finite, JobPart, JobPath, NotNegative, Options, Positive
    from zlmreport.job.types import Text as TextLine
    from zlmreport.language import Language, Words
    from zlmreport.language import same as same_in_all_languages
    from zlmreport.live.dialogue import Lines as WholeLines
    from zlmreport.live.dialogue import Patience, WrongDeviceError
    from zlmreport.live.dialogue import ask as ask_instrument
    from zlmreport.live.dialogue import at_rate as readings_at_rate
    from zlmreport.live.dialogue import streamed as streamed_readings
    from zlmreport.live.dialogue import unreadable as unreadable_reading
    from zlmreport.live.port import Framing, LiveConnection, PolledOptions, Port, PortOptions
    from zlmreport.live.reading import NO_CONDITIONS, NO_FAULT, Fault, LiveReading
    from zlmreport.measurement.approach import Approach
    from zlmreport.measurement.axis import Axis, AxisKind, position_units
    from zlmreport.measurement.collect import Reading
    from zlmreport.measurement.collect import collect as collect_readings
    from zlmreport.measurement.collect import is_run as is_run_number
    from zlmreport.measurement.collect import no_run as no_run_number
    from zlmreport.measurement.measurement_set import (
        CONDITION_NAMES,
        CONDITIONS,
        STATE_OF_AIR,
        MeasurementSet,
    )
    from zlmreport.measurement.provenance import Correction, Provenance, SourceFile
    from zlmreport.measurement.text_file import TextFile, known_encoding, parse_number, read_text
    from zlmreport.model.design import Design
    from zlmreport.model.effect import (
        Confusion,
        Dimension,
        Effect,
        Parameter,
        Shape,
        needs_both_directions,
        needs_linear_axis,
        needs_logged,
        needs_passing_time,
        needs_rotary_axis,
        needs_runs,
        needs_stated,
        needs_targets,
        needs_whole_period,
    )
    from zlmreport.model.harmonic import harmonic_columns, harmonic_parameters
    from zlmreport.model.report import report_error, report_model
    from zlmreport.planning.programs import Motion, ProgramOptions, axis_address, program_number
    from zlmreport.planning.programs import heading as program_heading
    from zlmreport.planning.programs import remark as reading_remark
    from zlmreport.plugin.extension import (
        Command,
        CommandHost,
        CommandOption,
        Extension,
        ExtensionPlan,
        Happening,
        LiveRun,
    )
    from zlmreport.plugin.kinds import hookimpl
    from zlmreport.plugin.protocols import (
        Connection,
        Controller,
        DataSource,
        Instrument,
        Message,
        Notifier,
        Occasion,
        PartProgram,
        Renderer,
        SourceContext,
        SourceProposal,
        Standard,
    )
    from zlmreport.presenting.writer import Writer
    from zlmreport.quantities.arrays import BoolArray, FloatArray, read_only_floats
    from zlmreport.quantities.formatting import MINUS as MINUS_SIGN
    from zlmreport.quantities.formatting import DecimalSign, fixed_number, general_number
    from zlmreport.quantities.notation import spans as notation_spans
    from zlmreport.quantities.temperature import REFERENCE_TEMPERATURE
    from zlmreport.quantities.temperature import above_reference as above_reference_temperature
    from zlmreport.quantities.units import (
        CELSIUS,
        DEGREE,
        HECTOPASCAL,
        INCH,
        LENGTH_UNITS,
        MICROMETRE,
        MICROMETRE_PER_METRE_KELVIN,
        MICRORADIAN,
        MILLIMETRE,
        MILLIRADIAN,
        PERCENT,
        POSITION_UNITS,
        SECOND,
        TIME_UNITS,
        Unit,
        unit_named,
    )
    from zlmreport.quantities.units import Scale as ReadingScale
    from zlmreport.typesetting.compose import GRAPH_ADDRESS, LOGO_ADDRESS
    from zlmreport.typesetting.compose import Setting as HtmlSetting
    from zlmreport.typesetting.compose import compose as compose_html
    from zlmreport.typesetting.linked import fingerprint as script_fingerprint
    from zlmreport.typesetting.linked import script as linked_script
    from zlmreport.typesetting.linked import style as linked_style
    from zlmreport.typesetting.resources import FACES as FONT_FACES
    from zlmreport.typesetting.resources import font as font_file
    from zlmreport.typesetting.resources import font_faces as font_face_rules
    from zlmreport.typesetting.resources import style_sheet
    from zlmreport.uncertainty.budget import COVERAGE_PROBABILITY, Budget, NoBudget
    from zlmreport.uncertainty.contribution import Acts, Contribution, Distribution
    from zlmreport.uncertainty.expanded import with_uncertainty
    from zlmreport.uncertainty.wording import STATED as STATED_IN_THE_JOB
    from zlmreport.uncertainty.wording import USUAL as USUAL_CONTRIBUTIONS
    from zlmreport.uncertainty.wording import calibration as calibration_in_words

__all__ = [
    "APPROACH_TITLES",
    "CELSIUS",
    "CONDITIONS",
    "CONDITION_NAMES",
    "CONFORMITY_STATEMENTS",
    "COVERAGE_PROBABILITY",
    "DEGREE",
    "FONT_FACES",
    "GRAPH_ADDRESS",
    "GRAPH_TEXT_SIZE",
    "GRAPH_WIDTH",
    "HECTOPASCAL",
    "INCH",
    "INK_COLOUR",
    "LENGTH_UNITS",
    "LIMIT_ROLES",
    "LOGO_ADDRESS",
    "MEAN_ROLES",
    "MICROMETRE",
    "MICROMETRE_PER_METRE_KELVIN",
    "MICRORADIAN",
    "MILLIMETRE",
    "MILLIRADIAN",
    "MINUS_SIGN",
    "NO_CONDITIONS",
    "NO_FAULT",
    "PERCENT",
    "POSITION_UNITS",
    "REFERENCE_TEMPERATURE",
    "ROLE_STYLES",
    "SECOND",
    "STANDARD_HUMIDITY",
    "STANDARD_PRESSURE",
    "STATED_IN_THE_JOB",
    "STATE_OF_AIR",
    "TIME_UNITS",
    "TRACEABLE",
    "USUAL_CONTRIBUTIONS",
    "AccessError",
    "Acts",
    "Align",
    "Appended",
    "Approach",
    "Arithmetic",
    "Arrow",
    "Attachment",
    "Axis",
    "AxisKind",
    "Band",
    "Basis",
    "Block",
    "BoolArray",
    "Bracket",
    "Budget",
    "Canvas",
    "CaptureEnded",
    "CaptureOptions",
    "CaptureResumed",
    "Cell",
    "Certificate",
    "CertificateSource",
    "Colour",
    "Column",
    "Command",
    "CommandHost",
    "CommandOption",
    "CompensationTable",
    "Conformity",
    "Confusion",
    "Connection",
    "Contribution",
    "Controller",
    "Correction",
    "Curve",
    "Customer",
    "DataSource",
    "Date",
    "DatumClosed",
    "DatumHolds",
    "DatumMoved",
    "DatumTaken",
    "DecimalSign",
    "Decision",
    "Described",
    "Design",
    "Diagram",
    "Dimension",
    "Distribution",
    "Effect",
    "Emulator",
    "EvaluatedParameter",
    "Evaluation",
    "Explained",
    "Extension",
    "ExtensionPlan",
    "Fact",
    "Facts",
    "Fault",
    "Figure",
    "FileFormat",
    "Fill",
    "Finding",
    "Finite",
    "FloatArray",
    "FontFace",
    "Formulas",
    "Framing",
    "GatheredBlock",
    "Graph",
    "Happening",
    "HtmlSetting",
    "Information",
    "InputError",
    "Instrument",
    "Job",
    "JobInstrument",
    "JobKeys",
    "JobPart",
    "JobPath",
    "JournalEntry",
    "JournalHeader",
    "JournalHistory",
    "KeyStep",
    "KeysFile",
    "Laboratory",
    "Language",
    "Letterhead",
    "Level",
    "LiveConnection",
    "LiveReading",
    "LiveRun",
    "Mark",
    "MeasurementSet",
    "Message",
    "Motion",
    "NoBudget",
    "NotNegative",
    "Notice",
    "Notifier",
    "Occasion",
    "OperatorCommented",
    "OperatorRetake",
    "OperatorSkipped",
    "Options",
    "PageWords",
    "Panel",
    "Paragraph",
    "Parameter",
    "PartProgram",
    "Patience",
    "Place",
    "PolledOptions",
    "Port",
    "PortOptions",
    "PositionQuantity",
    "PositionStatistics",
    "Positive",
    "Problem",
    "ProgramKeys",
    "ProgramOptions",
    "Provenance",
    "Quantity",
    "QuantityGroup",
    "Reading",
    "ReadingRecorded",
    "ReadingScale",
    "Relationship",
    "Renderer",
    "Role",
    "RowGroup",
    "Scene",
    "Section",
    "Segment",
    "Shape",
    "SourceContext",
    "SourceFile",
    "SourceProposal",
    "Standard",
    "Stroke",
    "SvgCanvas",
    "Symbol",
    "Table",
    "TextFile",
    "TextLabel",
    "TextLine",
    "TextRun",
    "Trouble",
    "Unit",
    "Verdict",
    "WholeLines",
    "Words",
    "Writer",
    "WrongDeviceError",
    "ZeroLost",
    "above_reference_temperature",
    "address_lines",
    "alternative_text",
    "ask_instrument",
    "axis_address",
    "both_directions",
    "calibration_in_words",
    "collect_readings",
    "compose_html",
    "decided",
    "decimal_padding",
    "decision_rule",
    "deviation_in_words",
    "diagram_panel",
    "did_you_mean",
    "draw_figure",
    "evaluate",
    "exceeds",
    "facts_side_by_side",
    "fewest_runs",
    "figure_size",
    "figure_to_svg",
    "fixed_number",
    "font_face_rules",
    "font_file",
    "gather_facts",
    "general_number",
    "graph_in_words",
    "harmonic_columns",
    "harmonic_parameters",
    "has_letter",
    "hexadecimal_colour",
    "hookimpl",
    "index_change",
    "is_run_number",
    "known_encoding",
    "largest_over_positions",
    "linked_script",
    "linked_style",
    "mark_offset",
    "marks_in_words",
    "mean_interval",
    "mean_over_positions",
    "measured_length",
    "needs_both_directions",
    "needs_linear_axis",
    "needs_logged",
    "needs_passing_time",
    "needs_rotary_axis",
    "needs_runs",
    "needs_stated",
    "needs_targets",
    "needs_whole_period",
    "no_missing_readings",
    "no_run_number",
    "notation_spans",
    "number_of_runs",
    "parse_number",
    "place_of_work",
    "plain_label",
    "position_in_words",
    "position_statistics",
    "position_units",
    "positions_by_angle",
    "positions_in_all",
    "positions_in_words",
    "positions_over_travel",
    "positions_per_metre",
    "positions_per_scale_element",
    "principal_angles",
    "program_heading",
    "program_number",
    "quoted",
    "random_fractions",
    "range_in_words",
    "range_over_positions",
    "read_journal",
    "read_keys_file",
    "read_only_floats",
    "read_text",
    "reading_remark",
    "readings_at_rate",
    "refractive_index",
    "report_error",
    "report_evaluation",
    "report_model",
    "round_ticks",
    "runs_in_words",
    "same_in_all_languages",
    "script_fingerprint",
    "smallest_over_positions",
    "spacing_against_periods",
    "span_over_positions",
    "streamed_readings",
    "style_sheet",
    "table_layout",
    "take_names",
    "text_advance",
    "unit_named",
    "unreadable_reading",
    "unwritable",
    "with_uncertainty",
    "worst_position",
]

#: Where each name lives; ``new=old`` where it has another one there.
_ROOMS = {
    "zlmreport.uncertainty.wording": (
        "USUAL_CONTRIBUTIONS=USUAL STATED_IN_THE_JOB=STATED calibration_in_words=calibration"
    ),
    "zlmreport.plugin.extension": (
        "Command CommandHost CommandOption Extension ExtensionPlan Happening LiveRun"
    ),
    "zlmreport.job.tree": "KeyStep=Step",
    "zlmreport.job.plan_keys": "ProgramKeys",
    "zlmreport.job.keys": "JobKeys",
    "zlmreport.job.measurement_keys": "JobInstrument=Instrument",
    "zlmreport.job.loading": "KeysFile read_keys_file",
    "zlmreport.job.extends": "FileFormat",
    "zlmreport.files": "Appended take_names unwritable",
    "zlmreport.figures.style": "INK_COLOUR=INK GRAPH_TEXT_SIZE=TEXT_SIZE ROLE_STYLES=ROLES",
    "zlmreport.figures.scale": "round_ticks",
    "zlmreport.presenting.writer": "Writer",
    "zlmreport.certificate.circumstances": "Fact",
    "zlmreport.compensation.curve": "CompensationTable",
    "zlmreport.certificate.conditions": "Described",
    "zlmreport.capture.events": (
        "CaptureEnded=Ended CaptureResumed=Resumed DatumClosed=Closed DatumHolds DatumMoved DatumTaken "
        "OperatorCommented=Commented OperatorRetake=Retake OperatorSkipped=Skipped ReadingRecorded=Recorded "
        "ZeroLost"
    ),
    "zlmreport.capture.history": "JournalEntry=Entry JournalHistory=History read_journal=read_history",
    "zlmreport.capture.options": "CaptureOptions",
    "zlmreport.capture.records": "JournalHeader=Header",
    "zlmreport.certificate.attachments": "Attachment CertificateSource=Source Relationship",
    "zlmreport.certificate.columns": (
        "GatheredBlock decimal_padding facts_side_by_side=side_by_side gather_facts table_layout"
    ),
    "zlmreport.certificate.conformity": "CONFORMITY_STATEMENTS=STATEMENTS",
    "zlmreport.certificate.document": (
        "Align Block Cell Certificate Column Explained Facts Formulas Graph Letterhead Mark Notice "
        "PageWords Paragraph RowGroup Section Symbol Table Verdict"
    ),
    "zlmreport.certificate.cover": "address_lines=lines place_of_work",
    "zlmreport.certificate.information": "Information",
    "zlmreport.certificate.statements": "TRACEABLE",
    "zlmreport.correction.refractive_index": (
        "STANDARD_HUMIDITY STANDARD_PRESSURE index_change refractive_index"
    ),
    "zlmreport.emulation.emulator": "Emulator Scene Trouble",
    "zlmreport.errors": "AccessError InputError Place Problem did_you_mean quoted",
    "zlmreport.evaluation.checks.positions": (
        "exceeds measured_length positions_by_angle positions_in_all positions_over_travel "
        "positions_per_metre positions_per_scale_element principal_angles"
    ),
    "zlmreport.evaluation.checks.readings": (
        "both_directions fewest_runs mean_interval no_missing_readings number_of_runs random_fractions "
        "spacing_against_periods"
    ),
    "zlmreport.evaluation.conformity": "Conformity Decision",
    "zlmreport.evaluation.decision": "decided decision_rule",
    "zlmreport.evaluation.evaluate": "evaluate",
    "zlmreport.evaluation.evaluation": "Arithmetic EvaluatedParameter=Parameter Evaluation",
    "zlmreport.evaluation.printed": (
        "deviation_in_words=deviation position_in_words=position positions_in_words=positions "
        "runs_in_words=runs"
    ),
    "zlmreport.evaluation.quantity": "PositionQuantity Quantity QuantityGroup=Group",
    "zlmreport.evaluation.report": "report_evaluation",
    "zlmreport.evaluation.requirements": "Basis Finding",
    "zlmreport.evaluation.statistics": (
        "PositionStatistics position_statistics "
        "largest_over_positions=largest mean_over_positions=average range_over_positions=width "
        "smallest_over_positions=smallest span_over_positions=span"
    ),
    "zlmreport.figures.alternatives": (
        "alternative_text=text graph_in_words=graph_of marks_in_words=marks range_in_words=range_of"
    ),
    "zlmreport.figures.canvas": "Colour Fill FontFace=Face Segment Stroke TextRun=Run Canvas TextLabel=Label",
    "zlmreport.figures.draw": "draw_figure=draw figure_to_svg=to_svg",
    "zlmreport.figures.figure": "Arrow Band Bracket Curve Figure Level Panel Role",
    "zlmreport.figures.layout": "figure_size GRAPH_WIDTH=WIDTH",
    "zlmreport.figures.metrics": "has_letter mark_offset text_advance=advance plain_label",
    "zlmreport.figures.prescribed": (
        "APPROACH_TITLES=DIRECTIONS Diagram LIMIT_ROLES=LIMITS MEAN_ROLES=MEANS diagram_panel=panel "
        "worst_position=worst"
    ),
    "zlmreport.figures.svg": "hexadecimal_colour=hexadecimal SvgCanvas",
    "zlmreport.planning.programs": (
        "Motion ProgramOptions axis_address program_heading=heading program_number reading_remark=remark"
    ),
    "zlmreport.job.document_keys": "Customer Laboratory",
    "zlmreport.job.job": "Job",
    "zlmreport.job.types": "Finite JobPath Options Date JobPart NotNegative Positive TextLine=Text",
    "zlmreport.language": "Language Words same_in_all_languages=same",
    "zlmreport.live.dialogue": (
        "Patience WholeLines=Lines WrongDeviceError ask_instrument=ask readings_at_rate=at_rate "
        "streamed_readings=streamed unreadable_reading=unreadable"
    ),
    "zlmreport.live.port": "Framing LiveConnection PolledOptions Port PortOptions",
    "zlmreport.live.reading": "Fault LiveReading NO_CONDITIONS NO_FAULT",
    "zlmreport.measurement.approach": "Approach",
    "zlmreport.measurement.axis": "Axis AxisKind position_units",
    "zlmreport.measurement.collect": (
        "Reading collect_readings=collect is_run_number=is_run no_run_number=no_run"
    ),
    "zlmreport.measurement.measurement_set": "CONDITIONS CONDITION_NAMES MeasurementSet STATE_OF_AIR",
    "zlmreport.measurement.provenance": "Provenance SourceFile Correction",
    "zlmreport.measurement.text_file": "TextFile known_encoding parse_number read_text",
    "zlmreport.model.design": "Design",
    "zlmreport.model.effect": (
        "Confusion Dimension Effect Parameter Shape needs_both_directions needs_linear_axis needs_logged "
        "needs_passing_time needs_rotary_axis needs_runs needs_stated needs_targets needs_whole_period"
    ),
    "zlmreport.model.harmonic": "harmonic_columns harmonic_parameters",
    "zlmreport.model.report": "report_error report_model",
    "zlmreport.plugin.kinds": "hookimpl",
    "zlmreport.plugin.protocols": (
        "Connection Controller DataSource Instrument Message Notifier Occasion PartProgram Renderer "
        "SourceContext SourceProposal Standard"
    ),
    "zlmreport.quantities.arrays": "BoolArray FloatArray read_only_floats",
    "zlmreport.quantities.formatting": "DecimalSign MINUS_SIGN=MINUS fixed_number general_number",
    "zlmreport.quantities.notation": "notation_spans=spans",
    "zlmreport.quantities.temperature": "REFERENCE_TEMPERATURE above_reference_temperature=above_reference",
    "zlmreport.quantities.units": (
        "CELSIUS HECTOPASCAL INCH LENGTH_UNITS MICROMETRE MILLIMETRE MILLIRADIAN PERCENT POSITION_UNITS "
        "ReadingScale=Scale SECOND TIME_UNITS Unit unit_named DEGREE MICROMETRE_PER_METRE_KELVIN "
        "MICRORADIAN"
    ),
    "zlmreport.typesetting.compose": "GRAPH_ADDRESS HtmlSetting=Setting LOGO_ADDRESS compose_html=compose",
    "zlmreport.typesetting.linked": "linked_script=script linked_style=style script_fingerprint=fingerprint",
    "zlmreport.typesetting.resources": (
        "FONT_FACES=FACES font_face_rules=font_faces font_file=font style_sheet"
    ),
    "zlmreport.uncertainty.budget": "Budget COVERAGE_PROBABILITY NoBudget",
    "zlmreport.uncertainty.contribution": "Acts Contribution Distribution",
    "zlmreport.uncertainty.expanded": "with_uncertainty",
}
_HOMES = {
    offered: (room, own or offered)
    for room, names in _ROOMS.items()
    for offered, _, own in (name.partition("=") for name in names.split())
}

if not TYPE_CHECKING:  # a type checker knows the names from above, and reports one that is not among them

    def __getattr__(name: str) -> object:
        """Load what a name stands for."""
        if name not in _HOMES:
            message = f"module {__name__!r} has no attribute {name!r}"
            raise AttributeError(message)
        room, own = _HOMES[name]
        value = globals()[name] = getattr(import_module(room), own)
        return value


def home_of(name: str) -> tuple[str, str]:
    """Return the module in which a name of the door lives, and its name there."""
    return _HOMES[name]


def __dir__() -> list[str]:
    """Return the names of the door."""
    return sorted(__all__)
