"""Measurements that tell effects apart: each is described once, for both effects of every pair."""

from __future__ import annotations

from zlmreport.plugin import Words

BEAM_REALIGNED = Words(
    en="align the beam anew until it returns to the same spot along the whole travel, and repeat",
    de="den Strahl neu ausrichten, bis er über den ganzen Verfahrweg denselben Punkt trifft, und wiederholen",
)
BEAM_SHIELDED = Words(
    en="shield the beam, log the air, and measure a while at a single position",
    de="den Strahl abschirmen, die Luft aufzeichnen und eine Zeit lang an einer einzigen Position messen",
)
CALIBRATED_BLOCK = Words(
    en="measure a calibrated gauge block or ring with both faces",
    de="ein kalibriertes Endmaß oder einen Einstellring mit beiden Flächen messen",
)
COLD_RESTART = Words(
    en="let the axis cool down and begin again, or pause half-way and measure on",
    de="die Achse abkühlen lassen und neu beginnen, oder auf halbem Weg pausieren und weitermessen",
)
DEAD_PATH_CHANGED = Words(
    en="preset with the optics close together, or change the dead path by a known length",
    de="mit dicht zusammenstehenden Optiken nullen oder die Totstrecke um ein bekanntes Stück ändern",
)
DENSER_TARGETS = Words(
    en="repeat with more targets, at random fractions of the suspected period",
    de="mit mehr Zielpositionen wiederholen, an zufälligen Bruchteilen der vermuteten Periode",
)
DRIFT_RUN = Words(
    en="record the reading over time at a single position",
    de="den Messwert an einer einzigen Position über der Zeit aufzeichnen",
)
FINE_RUN = Words(
    en="a fine run of at least 20 targets over two pitches",
    de="ein Feinlauf mit mindestens 20 Zielpositionen über zwei Steigungen",
)
FULL_TURN = Words(
    en="measure a full turn, with targets at random fractions of the spacing",
    de="eine volle Umdrehung messen, mit Zielpositionen an zufälligen Bruchteilen des Abstands",
)
GAUGE_REALIGNED = Words(
    en="align the gauge anew, or take the lengths along its own measured direction",
    de="den Prüfkörper neu ausrichten oder die Längen entlang seiner eigenen, gemessenen Richtung nehmen",
)
GAUGE_REPLACED_BY_LASER = Words(
    en="repeat with an aligned laser beam in place of the gauge",
    de="mit einem ausgerichteten Laserstrahl statt des Prüfkörpers wiederholen",
)
LINEAR_METHOD = Words(
    en="repeat by the linear method, which parts position from time",
    de="nach dem Linearverfahren wiederholen, das Position und Zeit voneinander trennt",
)
MORE_RUNS = Words(
    en="measure more runs, and check the preset after the first",
    de="mehr Durchläufe messen und die Nullung nach dem ersten prüfen",
)
OTHER_AIR = Words(
    en="repeat with another environmental sensor unit, or with the air conditioning switched",
    de="mit einer anderen Umwelterfassung wiederholen oder bei umgeschalteter Klimaanlage",
)
OTHER_HEIGHT = Words(
    en="repeat the line at another height or side: an Abbe error grows with the offset",
    de="die Messlinie in anderer Höhe oder seitlich wiederholen: ein Abbe-Fehler wächst mit dem Versatz",
)
OTHER_OVERRUN = Words(
    en="repeat with another overrun, and note the distance from each reversal",
    de="mit einem anderen Überlauf wiederholen und den Abstand von jeder Umkehr festhalten",
)
PRESET_AGAIN = Words(
    en="preset the instrument again, against an independent datum",
    de="das Messgerät gegen eine unabhängige Nulllage neu nullen",
)
PRESET_CHECKED = Words(
    en="repeat the test and check the preset at its end",
    de="die Prüfung wiederholen und an ihrem Ende die Nullung prüfen",
)
SCREW_SENSOR = Words(
    en="log the temperature of the nut or the screw as well, and change the feed",
    de="auch die Temperatur der Mutter oder Spindel aufzeichnen und den Vorschub ändern",
)
STEP_SEARCHED = Words(
    en="a fine run around the place, and the drawing of the scale's joints",
    de="ein Feinlauf um die Stelle herum, dazu die Zeichnung der Maßstabstöße",
)
TABLE_OFF = Words(
    en="repeat with the compensation table switched off",
    de="mit abgeschalteter Kompensationstabelle wiederholen",
)
TABLE_READ_BACK = Words(
    en="read the compensation table back from the control",
    de="die Kompensationstabelle aus der Steuerung zurücklesen",
)
TURNING_TEMPERATURE = Words(
    en="measure on until the temperature turns back",
    de="weitermessen, bis sich der Temperaturverlauf umkehrt",
)
TWO_HEADS = Words(
    en="read the angle with two heads 180° apart: their mean is free of odd harmonics",
    de="den Winkel mit zwei um 180° versetzten Köpfen ablesen: ihr Mittel hat keine ungeraden Harmonischen",
)
WARMER_AXIS = Words(
    en="a second test with the axis at least 3 K warmer or colder",
    de="eine zweite Prüfung mit einer um mindestens 3 K wärmeren oder kälteren Achse",
)
