"""Keys of a job on the measurement: machine, axis, source, instrument, environment, corrections."""

from typing import Annotated, Any, Literal, Self, TypeAlias

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from zlmreport.errors import did_you_mean, quoted
from zlmreport.job.evaluation_keys import UncertaintyKeys
from zlmreport.job.types import (
    Date,
    Finite,
    Humidity,
    InstrumentUncertainty,
    InWords,
    JobPart,
    JobPath,
    Lines,
    NotNegative,
    Positive,
    Pressure,
    Temperature,
    Text,
    optional,
    parse_along_the_length,
)
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.error_symbol import LINEAR_AXES, ROTARY_AXES, find_letter_of


class AirKeys(JobPart):
    """The refractive index of the air, which the instrument did not know."""

    assumed: Literal["vacuum", "standard air"] | Positive = Field(
        description="What the instrument took the index to be: that of vacuum, of air at 20 °C, 1013.25 hPa "
        "and 50 %, or the number that it was set to.",
        examples=["standard air", 1.00027],
    )
    wavelength: Positive = Field(
        632.991, description="Of the laser in vacuum, nm; that of a helium-neon laser.", examples=[632.991]
    )


class DeadPathKeys(JobPart):
    """The path in air that the instrument does not count: before the datum."""

    length: Positive = Field(
        description="From the interferometer to the reflector at the datum, mm.", examples=[150]
    )
    measured_path: Literal["grows", "shrinks"] = Field(
        "grows", description="What the path between them does while the position rises."
    )


class MaterialKeys(JobPart):
    """The expansion of the material, back to 20 °C."""

    expansion_coefficient: Positive | None = optional(
        "Micrometres/(m K); without it environment.expansion_coefficient.", example=11.5
    )
    temperature: Literal["material_temperature", "axis_temperature"] = Field(
        "material_temperature", description="The logged or stated temperature that the material has."
    )


class CorrectionKeys(JobPart):
    """What the readings are corrected for; without these keys they are taken as they are."""

    air: AirKeys | None = optional("The refractive index of the air along the measured length.")
    dead_path: DeadPathKeys | None = optional("Changes of the air along the dead path; only beside air.")
    material: MaterialKeys | None = optional("Thermal expansion of the material.")
    datum: Finite | None = optional(
        "Position at which the instrument was set to zero, mm. Without it as the readings tell, "
        "or else the first target position.",
        example=0,
    )


_SPELLINGS = {"up": "+", "↑": "+", "1": "+", "down": "-", "↓": "-", "-1": "-", "−": "-"}


def _take_sign(value: Any) -> Any:
    return _SPELLINGS.get(str(value).strip().lower(), value)


class ExclusionKeys(JobPart):
    """A reading that is set aside, as if it had not been taken; the document names it with the reason."""

    target: Finite = Field(description="Its target position, mm or degrees.", examples=[213.4])
    direction: Annotated[Literal["+", "-"], BeforeValidator(_take_sign)] = Field(
        description="Direction of approach: + or -, in quotes.", examples=["+"]
    )
    run: int = Field(ge=1, description="Number of its run, from 1.", examples=[3])
    reason: Text = Field(
        description="Why, as the document states it.", examples=["Air hose touched the reflector."]
    )


def is_same_serial(one: str, other: str) -> bool:
    """Whether two serial numbers are one, be it in capitals or in small letters.

    >>> is_same_serial("vm-4711a", "VM-4711A"), is_same_serial("VM-4711", "VM-4712")
    (True, False)
    """
    return one.strip().casefold() == other.strip().casefold()


class MachineUnderTest(JobPart):
    """The machine under test."""

    manufacturer: Text | None = optional("Who built it.")
    model: Text | None = optional("Type designation.")
    serial: Text | None = optional("Serial number or other identification.")
    kind: Literal["machine tool", "coordinate measuring machine", "surface plate"] | None = optional(
        "What the results mean is said for a part made, or measured, on it. Without it a machine "
        "tool, and of flatness a surface plate.",
        example="machine tool",
    )
    location: Text | None = optional("Where it stands.")
    condition: Text | None = optional("Condition in which it was found.")

    @property
    def type(self) -> str:
        """Who built it, and what: as far as it is stated."""
        return " ".join(filter(None, (self.manufacturer, self.model)))

    def is_other_than(self, machine: Self) -> bool:
        """Whether serial numbers are stated of both, and tell them apart."""
        return bool(self.serial and machine.serial and not is_same_serial(self.serial, machine.serial))


class AxisKeys(JobPart):
    """The axis under test."""

    name: Text = Field(description="As on the machine.", examples=["X"])
    kind: AxisKind = Field(AxisKind.LINEAR, description="linear (mm) or rotary (degrees).")
    travel: tuple[Finite, Finite] | None = optional(
        "First and last position of the travel, mm or degrees.", example=[0, 1000]
    )
    screw_pitch: Positive | None = optional("Pitch of the screw or gear, mm or degrees.", example=10)
    signal_period: Positive | None = optional("Period of the scale's signal, mm or degrees.", example=0.02)
    scale_element: Positive | None = optional(
        "Length of one element of a scale made of several, mm or degrees."
    )
    pole_pitch: Positive | None = optional(
        "Distance of like poles of a linear or torque motor, mm or degrees.", example=24
    )
    compensation_table: Literal["none"] | JobPath | None = optional(
        "CSV file of the compensation table that was active during the test: columns position and deviation "
        "(actual - target), or forward and reverse, mm and micrometres (degrees and arc seconds); or none.",
        example="x-compensation.csv",
        union_mode="left_to_right",
    )
    angular_errors: JobPath | None = optional(
        "CSV file of the axis's pitch or yaw: columns position and angle, mm and microradians.",
        example="x-pitch.csv",
    )
    abbe_offset: Finite | None = optional("Distance of the measuring line from the scale, mm.", example=200)


class SourceKeys(BaseModel):
    """Where the readings come from; the plugin's own keys follow `plugin`."""

    model_config = ConfigDict(defer_build=True, extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed data source.", examples=["laser-csv"])


#: The name of one of several tests, which symbols and pages then carry.
TestName: TypeAlias = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,19}$")]
#: What `measurement.at` may name beside axes.
_TOOL = "tool"


def _read_places(at: dict[str, Any]) -> dict[str, Any]:
    for name, value in at.items():
        is_tool = name == _TOOL
        if not is_tool and not find_letter_of(name):
            near = did_you_mean(name, [*LINEAR_AXES, *ROTARY_AXES, _TOOL])
            raise ValueError(f"{quoted(name)} is no axis; {near}")
        if is_tool != isinstance(value, tuple):
            expected = "three offsets, mm: [0, 0, 120]" if is_tool else "one position"
            raise ValueError(f"{name} is {expected}")
    return at


class LineOfPlane(JobPart):
    """Where the measuring line lies in a plane of two axes."""

    axis: Text = Field(description="Name of the second axis.", examples=["Y"])
    at: Finite = Field(description="Its position while the line was measured, mm.", examples=[200])


class LineKeys(JobPart):
    """How the readings of one measured line, or of one circle, were taken."""

    error: Text | None = optional(
        "What was measured, by ISO 230-1's symbol: EYX is straightness along Y of a motion along "
        "X, EBX an angle, C0Y the squareness of Y to X; without it the positioning of the axis, EXX. Or the "
        "name of a quantity that a standard brings.",
        example="EYX",
    )
    at: Annotated[dict[str, Finite | tuple[Finite, Finite, Finite]], AfterValidator(_read_places)] = Field(
        {},
        description="Where the other axes stood, mm or degrees, and the tool's offset from the spindle's "
        "nose, mm.",
        examples=[{"Y": 150, "Z": 80, "tool": [0, 0, 120]}],
    )
    source: SourceKeys | None = optional(
        "Where the readings come from; beside tests that of each which has none of its own.",
        example={"plugin": "laser-csv", "file": "x-axis.csv"},
    )
    date: Date | None = optional("Date of the measurement, or of its first day.", example="2026-11-18")
    end: Date | None = optional("Its last day, if it took more than one.", example="2026-11-19")
    method: Literal["linear", "unidirectional", "pendulum", "quasi-pilgrim"] | None = optional(
        "Positioning method."
    )
    feed: float | None = optional("Feed, mm/min or degrees/min.", example=2000, ge=1e-3, le=1e9)
    dwell: Positive | None = optional("Time at rest at each target, s.", example=5)
    warm_up: Lines | None = optional("Warm-up before the test, in words.")
    compensation: Lines | None = optional("State of the machine's compensation, in words.")
    line: Lines | None = optional("Place of the measuring line, positions of other axes.")
    plane: LineOfPlane | None = optional(
        "The measuring line as one of several over a plane, for `zlmreport surface`."
    )
    deviations_from_method: Lines | None = optional(
        "Additions to, deviations and exclusions from the method.",
        example="Three runs instead of five, for want of time.",
    )
    excluded: list[ExclusionKeys] = Field(
        [],
        description="Readings that are set aside, each with its reason.",
        examples=[
            [{"target": 213.4, "direction": "+", "run": 3, "reason": "Air hose touched the reflector."}]
        ],
    )
    operator: Text | None = optional("Who measured.")
    remarks: Lines | None = optional("Anything else that a reader should know.")


def _take_nothing(value: Any) -> Any:
    """Take the word for nothing as nothing: `material: none`."""
    return 0.0 if str(value).strip().lower() in {"none", "no", "false"} else value


class CompensatesKeys(JobPart):
    """What the instrument has corrected already, before it displayed a reading."""

    material: Annotated[NotNegative, BeforeValidator(_take_nothing)] | None = optional(
        "Coefficient by which it took the expansion of the material to 20 °C, micrometres/(m K); "
        "none or 0 if it did not.",
        example=11.5,
    )
    air: bool | None = optional(
        "Whether it knew the refractive index of the air; an interferometer that did not has an "
        "error of the whole length, which is then counted.",
        example=True,
    )


class SensorKeys(JobPart):
    """A thermometer or another sensor of the conditions, by its calibration."""

    name: Text = Field(description="Which it is.", examples=["Material sensor 1"])
    certificate: Text | None = optional("Its calibration certificate.", example="T-2026-114")
    calibrated: Date | None = optional("Date of that calibration.", example="2026-02-10")
    due: Date | None = optional("When it is due again.", example="2027-02-10")
    calibrated_range: tuple[Finite, Finite] | None = optional(
        "From where to where it is calibrated, in the unit of what it measures, °C for a "
        "thermometer: temperatures outside are marked.",
        example=[15, 25],
    )


class InstrumentKeys(JobPart):
    """The measuring instrument: the link to the national standard."""

    name: Text = Field(description="Type designation.", examples=["Laser interferometer LM 10"])
    manufacturer: Text | None = optional("Who built it.")
    serial: Text | None = optional("Serial number.")
    certificate: Text | None = optional("Its calibration certificate.")
    calibrated: Date | None = optional("Date of that calibration.", example="2026-03-01")
    due: Date | None = optional("When it is due to be calibrated again.", example="2027-03-01")
    calibrated_range: tuple[Finite, Finite] | None = optional(
        "From where to where it is calibrated: positions, mm (degrees); where it measures "
        "something else than positions along an axis, its readings, micrometres (arc seconds). Results over "
        "more than that are marked.",
        example=[0, 5000],
    )
    expanded_uncertainty: Positive | InstrumentUncertainty | None = optional(
        "Its expanded uncertainty (k = 2), micrometres (arc seconds); with a part that grows "
        "with the length, L in m: 0.6 + 0.3*L; in words in a report only, which then states no U.",
        example=0.3,
    )
    expanded_uncertainty_per_metre: Positive | None = optional(
        "What the expanded uncertainty gains with each metre of measured length, micrometres/m "
        "(arc seconds/m).",
        example=0.5,
    )
    expansion_coefficient: Finite | None = optional(
        "Of a device whose own expansion counts, micrometres/(m K).", example=8.0
    )
    compensation: Lines | None = optional(
        "What the instrument itself compensated, in words.",
        example="refractive index of the air; no material temperature",
    )
    compensates: CompensatesKeys | None = optional(
        "What it has corrected already, as numbers: the expansion is then not counted again.",
        example={"material": 11.5, "air": True},
    )

    @property
    def stated_uncertainty(self) -> tuple[float, float] | None:
        """U as a constant (µm or ″) and a part per metre (µm/m); None where no number is stated."""
        constant, per_metre = self.expanded_uncertainty, self.expanded_uncertainty_per_metre or 0.0
        if isinstance(constant, str):
            formula = parse_along_the_length(constant)
            return (formula[0], formula[1] + per_metre) if formula else None
        return (constant or 0.0, per_metre) if constant or per_metre else None


class Environment(JobPart):
    """Conditions during the measurement that the readings do not carry themselves."""

    air_temperature: Temperature | InWords | None = optional("°C", example=20.1)
    material_temperature: Temperature | InWords | None = optional("°C", example=20.3)
    axis_temperature: Temperature | InWords | None = optional("Of the machine's scale, °C", example=20.4)
    air_pressure: Pressure | InWords | None = optional("hPa", example=1013)
    relative_humidity: Humidity | InWords | None = optional("%", example=45)
    expansion_coefficient: Finite | InWords | None = optional(
        "Of the machine, µm/(m·K): for its expansion, corrected or not", example=11.5
    )
    sensors: Lines | None = optional(
        "Where the temperatures were measured.",
        example="air: beside the beam; machine: on the scale, in the middle",
    )
    thermometers: list[SensorKeys] = Field(
        [],
        description="Thermometers and other sensors whose readings enter results, with their calibrations.",
        examples=[[{"name": "Material sensor 1", "certificate": "T-2026-114", "calibrated": "2026-02-10"}]],
    )
    remarks: Lines | None = optional("Anything else: oil shower, sunlight, vibration.")


class NamedTest(LineKeys):
    """One of several measured lines; what is not said of it is as in the job's measurement."""

    axis: AxisKeys | None = optional(
        "The axis that moves; without it that of the error's symbol, or the job's.", example={"name": "X"}
    )
    instrument: InstrumentKeys | None = optional("Its instrument; without it that of the job.")
    environment: Environment | None = optional("Conditions during it; without them those of the job.")
    uncertainty: UncertaintyKeys | None = optional(
        "The uncertainty of its set-up; without it that of the job."
    )


class Measurement(LineKeys):
    """How the readings were taken: those of one line, or of several that are evaluated together."""

    tests: dict[TestName, NamedTest] = Field(
        {},
        description="Several measured lines that a standard evaluates together, by the names that it asks "
        "for, instead of source.",
        examples=[
            {
                "x": {"error": "EYX", "source": {"plugin": "laser-csv", "file": "x-straightness.csv"}},
                "y": {"error": "EXY", "source": {"plugin": "laser-csv", "file": "y-straightness.csv"}},
            }
        ],
    )
    symbols: Literal["iso230-1", "vdi-vde-2617-3"] = Field(
        "iso230-1",
        description="How errors are named in print: by ISO 230-1, or by VDI/VDE 2617 part 3 beside it.",
    )


class AsFound(JobPart):
    """The axis before it was adjusted or repaired; `measurement` is then the axis as left."""

    measurement: Measurement = Field(
        description="How the readings before were taken; what is not said here was as in measurement, "
        "but for days, excluded readings and remarks.",
        examples=[{"date": "2026-11-17", "source": {"plugin": "laser-csv", "file": "x-as-found.csv"}}],
    )
    work: Literal["adjustment", "repair"] = Field(
        "adjustment", description="What was done between the two measurements."
    )
    adjustment: Lines | None = optional(
        "What was adjusted or repaired, in words.",
        example="Backlash compensation of the control set from 0 to 4 µm.",
    )
    environment: Environment | None = optional(
        "Conditions during the measurement before; without it those of environment."
    )
