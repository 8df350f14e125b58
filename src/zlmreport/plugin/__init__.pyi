"""The door for type checkers; ``python docs/generate`` writes it."""

from zlmreport.capture.events import Ended as CaptureEnded, Resumed as CaptureResumed, Closed as DatumClosed, DatumHolds, DatumMoved, DatumTaken, Commented as OperatorCommented, Retake as OperatorRetake, Skipped as OperatorSkipped, Recorded as ReadingRecorded, ZeroLost
from zlmreport.capture.journal import Entry as JournalEntry, History as JournalHistory, read_history as read_journal
from zlmreport.capture.of_job import CaptureOptions
from zlmreport.capture.records import Header as JournalHeader
from zlmreport.certificate.attachments import Attachment, Source as CertificateSource, Relationship
from zlmreport.certificate.circumstances import Fact
from zlmreport.certificate.columns import NumberedBlock, decimal_padding, side_by_side as facts_side_by_side, numbered as numbered_blocks, table_layout
from zlmreport.certificate.conditions import Described
from zlmreport.certificate.conformity import STATEMENTS as CONFORMITY_STATEMENTS
from zlmreport.certificate.cover import lines as address_lines, place_of_work
from zlmreport.certificate.document import Align, Block, Cell, Certificate, Column, Explained, Facts, Formulas, Graph, Letterhead, Look, Mark, Notice, PageWords, Paragraph, RowGroup, Section, Symbol, Table, Verdict
from zlmreport.certificate.information import Information
from zlmreport.certificate.statements import TRACEABLE
from zlmreport.compensation.curve import CompensationTable
from zlmreport.correction.refractive_index import STANDARD_HUMIDITY, STANDARD_PRESSURE, index_change, refractive_index
from zlmreport.emulation.emulator import Emulator, Scene, Trouble
from zlmreport.errors import AccessError, InputError, Place, Problem, did_you_mean, quoted
from zlmreport.evaluation.checks import both_directions, deviation_in_words, exceeds, fewest_runs, mean_interval, measured_length, no_missing_readings, number_of_runs, position_in_words, positions_by_angle, positions_in_all, positions_in_words, positions_over_travel, positions_per_metre, positions_per_scale_element, principal_angles, random_fractions, runs_in_words, spacing_against_periods
from zlmreport.evaluation.decision import decided, decision_rule
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.evaluation import Arithmetic, Basis, Change, Conformity, Decision, Parameter as EvaluatedParameter, Evaluation, Finding, PositionQuantity, Quantity, Group as QuantityGroup, changes
from zlmreport.evaluation.report import report_changes, report_evaluation
from zlmreport.evaluation.statistics import PositionStatistics, largest as largest_over_positions, average as mean_over_positions, position_statistics, width as range_over_positions, smallest as smallest_over_positions, span as span_over_positions
from zlmreport.figures.canvas import Canvas, Colour, Fill, Face as FontFace, Segment, Stroke, SvgCanvas, Label as TextLabel, Run as TextRun, hexadecimal as hexadecimal_colour
from zlmreport.figures.draw import draw as draw_figure, to_svg as figure_to_svg
from zlmreport.figures.figure import Arrow, Band, Bracket, Curve, Figure, Level, Panel, Role
from zlmreport.figures.layout import WIDTH as GRAPH_WIDTH, figure_size
from zlmreport.figures.metrics import has_letter, mark_offset, plain_label, advance as text_advance
from zlmreport.figures.prescribed import DIRECTIONS as APPROACH_TITLES, Diagram, LIMITS as LIMIT_ROLES, MEANS as MEAN_ROLES, alternative_text, panel as diagram_panel, graph_in_words, marks_in_words, range_in_words, worst as worst_position
from zlmreport.figures.scale import round_ticks
from zlmreport.figures.shapes import TEXT_SIZE as GRAPH_TEXT_SIZE, INK as INK_COLOUR, ROLES as ROLE_STYLES
from zlmreport.files import JournalFile, take_names, unwritable
from zlmreport.job.document_keys import Customer, Laboratory
from zlmreport.job.evaluation_keys import ProgramKeys
from zlmreport.job.extends import FileFormat
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.loading import KeysFile, read_keys_file
from zlmreport.job.measurement_keys import Instrument as JobInstrument
from zlmreport.job.tree import Step as KeyStep
from zlmreport.job.types import Date, Finite, JobPart, JobPath, NotNegative, Options, Positive, Text as TextLine
from zlmreport.language import Language, Words, same as same_in_all_languages
from zlmreport.live.dialogue import Patience, Lines as WholeLines, WrongDeviceError, ask as ask_instrument, at_rate as readings_at_rate, streamed as streamed_readings, unreadable as unreadable_reading
from zlmreport.live.port import Framing, LiveConnection, PolledOptions, Port, PortOptions
from zlmreport.live.reading import Fault, LiveReading, NO_CONDITIONS, NO_FAULT
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind, position_units
from zlmreport.measurement.collect import Reading, collect as collect_readings, is_run as is_run_number, no_run as no_run_number
from zlmreport.measurement.measurement_set import CONDITIONS, CONDITION_NAMES, MeasurementSet, STATE_OF_AIR
from zlmreport.measurement.provenance import Correction, Provenance, SourceFile
from zlmreport.measurement.text_file import TextCell, TextFile, known_encoding, parse_number, read_text
from zlmreport.model.design import Design
from zlmreport.model.effect import Confusion, Dimension, Effect, Parameter, Shape, needs_both_directions, needs_linear_axis, needs_logged, needs_passing_time, needs_rotary_axis, needs_runs, needs_stated, needs_targets, needs_whole_period
from zlmreport.model.formula import search_grid
from zlmreport.model.harmonic import harmonic_columns, harmonic_parameters
from zlmreport.model.report import report_error, report_model, report_precision
from zlmreport.planning.programs import Motion, ProgramOptions, axis_address, heading as program_heading, program_number, remark as reading_remark
from zlmreport.plugin.extension import Command, CommandHost, CommandOption, Extension, ExtensionPlan, Happening, LiveRun
from zlmreport.plugin.kinds import hookimpl
from zlmreport.plugin.protocols import Connection, Controller, DataSource, Instrument, Message, Notifier, Occasion, PartProgram, Renderer, SourceContext, SourceProposal, Standard
from zlmreport.presenting.writer import Writer
from zlmreport.quantities.arrays import BoolArray, FloatArray, read_only_floats
from zlmreport.quantities.formatting import DecimalSign, MINUS as MINUS_SIGN, fixed_number, general_number, held as held_together, spans as notation_spans
from zlmreport.quantities.units import CELSIUS, DEGREE, HECTOPASCAL, INCH, LENGTH_UNITS, MICROMETRE, MICROMETRE_PER_METRE_KELVIN, MICRORADIAN, MILLIMETRE, MILLIRADIAN, PERCENT, POSITION_UNITS, REFERENCE_TEMPERATURE, Scale as ReadingScale, SECOND, TIME_UNITS, Unit, above_reference as above_reference_temperature, unit_named
from zlmreport.typesetting.compose import GRAPH_ADDRESS, Setting as HtmlSetting, LOGO_ADDRESS, compose as compose_html
from zlmreport.typesetting.resources import FACES as FONT_FACES, font_faces as font_face_rules, font as font_file, linked_script, linked_style, own_style, fingerprint as script_fingerprint, style_sheet
from zlmreport.uncertainty.budget import Acts, Budget, COVERAGE_PROBABILITY, Contribution, Distribution, NoBudget
from zlmreport.uncertainty.expanded import with_uncertainty
from zlmreport.uncertainty.wording import STATED as STATED_IN_THE_JOB, USUAL as USUAL_CONTRIBUTIONS, calibration as calibration_in_words

__all__ = ["APPROACH_TITLES", "AccessError", "Acts", "Align", "Approach", "Arithmetic", "Arrow", "Attachment", "Axis", "AxisKind", "Band", "Basis", "Block", "BoolArray", "Bracket", "Budget", "CELSIUS", "CONDITIONS", "CONDITION_NAMES", "CONFORMITY_STATEMENTS", "COVERAGE_PROBABILITY", "Canvas", "CaptureEnded", "CaptureOptions", "CaptureResumed", "Cell", "Certificate", "CertificateSource", "Change", "Colour", "Column", "Command", "CommandHost", "CommandOption", "CompensationTable", "Conformity", "Confusion", "Connection", "Contribution", "Controller", "Correction", "Curve", "Customer", "DEGREE", "DataSource", "Date", "DatumClosed", "DatumHolds", "DatumMoved", "DatumTaken", "DecimalSign", "Decision", "Described", "Design", "Diagram", "Dimension", "Distribution", "Effect", "Emulator", "EvaluatedParameter", "Evaluation", "Explained", "Extension", "ExtensionPlan", "FONT_FACES", "Fact", "Facts", "Fault", "Figure", "FileFormat", "Fill", "Finding", "Finite", "FloatArray", "FontFace", "Formulas", "Framing", "GRAPH_ADDRESS", "GRAPH_TEXT_SIZE", "GRAPH_WIDTH", "Graph", "HECTOPASCAL", "Happening", "HtmlSetting", "INCH", "INK_COLOUR", "Information", "InputError", "Instrument", "Job", "JobInstrument", "JobKeys", "JobPart", "JobPath", "JournalEntry", "JournalFile", "JournalHeader", "JournalHistory", "KeyStep", "KeysFile", "LENGTH_UNITS", "LIMIT_ROLES", "LOGO_ADDRESS", "Laboratory", "Language", "Letterhead", "Level", "LiveConnection", "LiveReading", "LiveRun", "Look", "MEAN_ROLES", "MICROMETRE", "MICROMETRE_PER_METRE_KELVIN", "MICRORADIAN", "MILLIMETRE", "MILLIRADIAN", "MINUS_SIGN", "Mark", "MeasurementSet", "Message", "Motion", "NO_CONDITIONS", "NO_FAULT", "NoBudget", "NotNegative", "Notice", "Notifier", "NumberedBlock", "Occasion", "OperatorCommented", "OperatorRetake", "OperatorSkipped", "Options", "PERCENT", "POSITION_UNITS", "PageWords", "Panel", "Paragraph", "Parameter", "PartProgram", "Patience", "Place", "PolledOptions", "Port", "PortOptions", "PositionQuantity", "PositionStatistics", "Positive", "Problem", "ProgramKeys", "ProgramOptions", "Provenance", "Quantity", "QuantityGroup", "REFERENCE_TEMPERATURE", "ROLE_STYLES", "Reading", "ReadingRecorded", "ReadingScale", "Relationship", "Renderer", "Role", "RowGroup", "SECOND", "STANDARD_HUMIDITY", "STANDARD_PRESSURE", "STATED_IN_THE_JOB", "STATE_OF_AIR", "Scene", "Section", "Segment", "Shape", "SourceContext", "SourceFile", "SourceProposal", "Standard", "Stroke", "SvgCanvas", "Symbol", "TIME_UNITS", "TRACEABLE", "Table", "TextCell", "TextFile", "TextLabel", "TextLine", "TextRun", "Trouble", "USUAL_CONTRIBUTIONS", "Unit", "Verdict", "WholeLines", "Words", "Writer", "WrongDeviceError", "ZeroLost", "above_reference_temperature", "address_lines", "alternative_text", "ask_instrument", "axis_address", "both_directions", "calibration_in_words", "changes", "collect_readings", "compose_html", "decided", "decimal_padding", "decision_rule", "deviation_in_words", "diagram_panel", "did_you_mean", "draw_figure", "evaluate", "exceeds", "facts_side_by_side", "fewest_runs", "figure_size", "figure_to_svg", "fixed_number", "font_face_rules", "font_file", "general_number", "graph_in_words", "harmonic_columns", "harmonic_parameters", "has_letter", "held_together", "hexadecimal_colour", "hookimpl", "index_change", "is_run_number", "known_encoding", "largest_over_positions", "linked_script", "linked_style", "mark_offset", "marks_in_words", "mean_interval", "mean_over_positions", "measured_length", "needs_both_directions", "needs_linear_axis", "needs_logged", "needs_passing_time", "needs_rotary_axis", "needs_runs", "needs_stated", "needs_targets", "needs_whole_period", "no_missing_readings", "no_run_number", "notation_spans", "number_of_runs", "numbered_blocks", "own_style", "parse_number", "place_of_work", "plain_label", "position_in_words", "position_statistics", "position_units", "positions_by_angle", "positions_in_all", "positions_in_words", "positions_over_travel", "positions_per_metre", "positions_per_scale_element", "principal_angles", "program_heading", "program_number", "quoted", "random_fractions", "range_in_words", "range_over_positions", "read_journal", "read_keys_file", "read_only_floats", "read_text", "reading_remark", "readings_at_rate", "refractive_index", "report_changes", "report_error", "report_evaluation", "report_model", "report_precision", "round_ticks", "runs_in_words", "same_in_all_languages", "script_fingerprint", "search_grid", "smallest_over_positions", "spacing_against_periods", "span_over_positions", "streamed_readings", "style_sheet", "table_layout", "take_names", "text_advance", "unit_named", "unreadable_reading", "unwritable", "with_uncertainty", "worst_position"]

def home_of(name: str) -> tuple[str, str]: ...
