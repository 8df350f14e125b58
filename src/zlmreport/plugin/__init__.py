"""The door: all that a plugin imports of zlmreport.

A name is looked up when it is used, and loads its own module only: so the door costs next to nothing, and a
plugin pays for what it needs. A name that says too little outside its module has a fuller one here. Type
checkers read the same names in ``__init__.pyi``, which ``python docs/generate`` writes.
"""

from __future__ import annotations

from importlib import import_module

#: Where each name lives; ``new=old`` where it has another one there.
_ROOMS = {
    "zlmreport.capture.events": (
        "CaptureEnded=Ended CaptureResumed=Resumed DatumClosed=Closed DatumHolds DatumMoved DatumTaken "
        "OperatorCommented=Commented OperatorRetake=Retake OperatorSkipped=Skipped ReadingRecorded=Recorded "
        "ZeroLost"
    ),
    "zlmreport.capture.journal": "JournalEntry=Entry JournalHistory=History read_journal=read_history",
    "zlmreport.capture.of_job": "CaptureOptions",
    "zlmreport.capture.records": "JournalHeader=Header",
    "zlmreport.certificate.attachments": "Attachment CertificateSource=Source Relationship",
    "zlmreport.certificate.circumstances": "Fact",
    "zlmreport.certificate.columns": (
        "NumberedBlock decimal_padding facts_side_by_side=side_by_side numbered_blocks=numbered table_layout"
    ),
    "zlmreport.certificate.conditions": "Described",
    "zlmreport.certificate.conformity": "CONFORMITY_STATEMENTS=STATEMENTS",
    "zlmreport.certificate.cover": "address_lines=lines place_of_work",
    "zlmreport.certificate.document": (
        "Align Block Cell Certificate Column Explained Facts Formulas Graph Letterhead Look Mark Notice "
        "PageWords Paragraph RowGroup Section Symbol Table Verdict"
    ),
    "zlmreport.certificate.information": "Information",
    "zlmreport.certificate.statements": "TRACEABLE",
    "zlmreport.compensation.curve": "CompensationTable",
    "zlmreport.correction.refractive_index": (
        "STANDARD_HUMIDITY STANDARD_PRESSURE index_change refractive_index"
    ),
    "zlmreport.emulation.emulator": "Emulator Scene Trouble",
    "zlmreport.errors": "AccessError InputError Place Problem did_you_mean quoted",
    "zlmreport.evaluation.checks": (
        "both_directions deviation_in_words exceeds fewest_runs mean_interval measured_length "
        "no_missing_readings number_of_runs position_in_words positions_by_angle positions_in_all "
        "positions_in_words positions_over_travel positions_per_metre positions_per_scale_element "
        "principal_angles random_fractions runs_in_words spacing_against_periods"
    ),
    "zlmreport.evaluation.decision": "decided decision_rule",
    "zlmreport.evaluation.evaluate": "evaluate",
    "zlmreport.evaluation.evaluation": (
        "Arithmetic Basis Change Conformity Decision EvaluatedParameter=Parameter Evaluation Finding "
        "PositionQuantity Quantity QuantityGroup=Group changes"
    ),
    "zlmreport.evaluation.report": "report_changes report_evaluation",
    "zlmreport.evaluation.statistics": (
        "PositionStatistics largest_over_positions=largest mean_over_positions=average position_statistics "
        "range_over_positions=width smallest_over_positions=smallest span_over_positions=span"
    ),
    "zlmreport.figures.canvas": (
        "Canvas Colour Fill FontFace=Face Segment Stroke SvgCanvas TextLabel=Label TextRun=Run "
        "hexadecimal_colour=hexadecimal"
    ),
    "zlmreport.figures.draw": "draw_figure=draw figure_to_svg=to_svg",
    "zlmreport.figures.figure": "Arrow Band Bracket Curve Figure Level Panel Role",
    "zlmreport.figures.layout": "GRAPH_WIDTH=WIDTH figure_size",
    "zlmreport.figures.metrics": "has_letter mark_offset plain_label text_advance=advance",
    "zlmreport.figures.prescribed": (
        "APPROACH_TITLES=DIRECTIONS Diagram LIMIT_ROLES=LIMITS MEAN_ROLES=MEANS alternative_text "
        "diagram_panel=panel graph_in_words marks_in_words range_in_words worst_position=worst"
    ),
    "zlmreport.figures.scale": "round_ticks",
    "zlmreport.figures.shapes": "GRAPH_TEXT_SIZE=TEXT_SIZE INK_COLOUR=INK ROLE_STYLES=ROLES",
    "zlmreport.files": "JournalFile take_names unwritable",
    "zlmreport.job.document_keys": "Customer Laboratory",
    "zlmreport.job.evaluation_keys": "ProgramKeys",
    "zlmreport.job.extends": "FileFormat",
    "zlmreport.job.job": "Job",
    "zlmreport.job.keys": "JobKeys",
    "zlmreport.job.loading": "KeysFile read_keys_file",
    "zlmreport.job.measurement_keys": "JobInstrument=Instrument",
    "zlmreport.job.tree": "KeyStep=Step",
    "zlmreport.job.types": "Date Finite JobPart JobPath NotNegative Options Positive TextLine=Text",
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
    "zlmreport.measurement.provenance": "Correction Provenance SourceFile",
    "zlmreport.measurement.text_file": "TextCell TextFile known_encoding parse_number read_text",
    "zlmreport.model.design": "Design",
    "zlmreport.model.effect": (
        "Confusion Dimension Effect Parameter Shape needs_both_directions needs_linear_axis needs_logged "
        "needs_passing_time needs_rotary_axis needs_runs needs_stated needs_targets needs_whole_period"
    ),
    "zlmreport.model.formula": "search_grid",
    "zlmreport.model.harmonic": "harmonic_columns harmonic_parameters",
    "zlmreport.model.report": "report_error report_model report_precision",
    "zlmreport.planning.programs": (
        "Motion ProgramOptions axis_address program_heading=heading program_number reading_remark=remark"
    ),
    "zlmreport.plugin.extension": (
        "Command CommandHost CommandOption Extension ExtensionPlan Happening LiveRun"
    ),
    "zlmreport.plugin.kinds": "hookimpl",
    "zlmreport.plugin.protocols": (
        "Connection Controller DataSource Instrument Message Notifier Occasion PartProgram Renderer "
        "SourceContext SourceProposal Standard"
    ),
    "zlmreport.presenting.writer": "Writer",
    "zlmreport.quantities.arrays": "BoolArray FloatArray read_only_floats",
    "zlmreport.quantities.formatting": (
        "DecimalSign MINUS_SIGN=MINUS fixed_number general_number held_together=held notation_spans=spans"
    ),
    "zlmreport.quantities.units": (
        "CELSIUS DEGREE HECTOPASCAL INCH LENGTH_UNITS MICROMETRE MICROMETRE_PER_METRE_KELVIN MICRORADIAN "
        "MILLIMETRE MILLIRADIAN PERCENT POSITION_UNITS REFERENCE_TEMPERATURE ReadingScale=Scale SECOND "
        "TIME_UNITS Unit above_reference_temperature=above_reference unit_named"
    ),
    "zlmreport.typesetting.compose": "GRAPH_ADDRESS HtmlSetting=Setting LOGO_ADDRESS compose_html=compose",
    "zlmreport.typesetting.resources": (
        "FONT_FACES=FACES font_face_rules=font_faces font_file=font linked_script linked_style own_style "
        "script_fingerprint=fingerprint style_sheet"
    ),
    "zlmreport.uncertainty.budget": "Acts Budget COVERAGE_PROBABILITY Contribution Distribution NoBudget",
    "zlmreport.uncertainty.expanded": "with_uncertainty",
    "zlmreport.uncertainty.wording": (
        "STATED_IN_THE_JOB=STATED USUAL_CONTRIBUTIONS=USUAL calibration_in_words=calibration"
    ),
}
_HOMES = {
    offered: (room, own or offered)
    for room, names in _ROOMS.items()
    for offered, _, own in (name.partition("=") for name in names.split())
}

__all__ = list(_HOMES)


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
