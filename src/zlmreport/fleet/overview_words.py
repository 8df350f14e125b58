"""The words of the overview."""

from __future__ import annotations

from zlmreport.fleet.records import About
from zlmreport.language import Words

TITLE = Words(en="Fleet overview", de="Flottenübersicht")

# Headline

LAST_RUN = Words(en="Last run", de="Letzter Lauf")
NEVER = Words(en="not yet", de="noch keiner")
INTERRUPTED = Words(en="{began}, interrupted", de="{began}, abgebrochen")
AT_WORK = Words(en="{began}, at work: {done} jobs so far", de="{began}, läuft noch: bisher {done} Aufträge")
RAN = Words(en="{began}, {duration}", de="{began}, {duration}")
SECONDS = Words(en="{number} s", de="{number} s")
MINUTES = Words(en="{minutes} min {seconds} s", de="{minutes} min {seconds} s")
JOBS = Words(en="Jobs", de="Aufträge")
JOBS_DONE = Words(
    en="{jobs}: {made} made, {unchanged} unchanged, {draft} as drafts, {failed} failed",
    de="{jobs}: {made} erstellt, {unchanged} unverändert, {draft} als Entwurf, {failed} fehlgeschlagen",
)
CERTIFICATES = Words(en="Certificates", de="Kalibrierscheine")
HEADLINE = Words(en="The fleet in numbers", de="Die Flotte in Zahlen")
AXES = Words(en="Axes", de="Achsen")

# What needs you

NEEDS = Words(en="What needs you", de="Was auf Sie wartet")
NOTHING = Words(
    en="Nothing: every job was made, every limit that is stated is met, no parameter drifts, and no test "
    "is overdue.",
    de="Nichts: Alle Aufträge sind erstellt, alle Grenzwerte eingehalten, keine Kenngröße driftet, und keine "
    "Messung ist überfällig.",
)
NO_NIGHT = Words(
    en="The ledger is empty: the fleet has not run yet.",
    de="Noch ist nichts verzeichnet: Die Flotte ist noch nicht gelaufen.",
)
NOTICED = Words(en="Notices on the run", de="Hinweise zum Lauf")
NOTICED_CAPTION = Words(
    en="What concerns the last run as a whole",
    de="Was den letzten Lauf als ganzen betrifft",
)
ABOUT = Words(en="About", de="Betrifft")
ABOUTS = {
    About.JOBS: Words(en="Jobs are missing", de="Aufträge fehlen"),
    About.FOLDER: Words(en="Folder of certificates", de="Ordner der Kalibrierscheine"),
    About.LEDGER: Words(en="Ledger", de="Verzeichnis"),
    About.CLOCK: Words(en="Clock", de="Uhr"),
    About.UNTOLD: Words(en="News that was not sent", de="Nicht zugestellte Meldungen"),
    About.PRIORS: Words(en="Priors from the tests", de="Vorwissen aus den Messungen"),
    About.STUCK: Words(en="A run that hung", de="Ein Lauf, der hing"),
    About.BROKEN: Words(en="A run that was broken off", de="Ein abgebrochener Lauf"),
    About.LEFT: Words(en="Jobs that are left", de="Übrige Aufträge"),
    About.DOCUMENTS: Words(en="Issued certificates", de="Ausgestellte Kalibrierscheine"),
}
FAILED = Words(en="Failed", de="Fehlgeschlagen")
FAILED_CAPTION = Words(
    en="Jobs of which no certificate could be made, or whose file is gone; the next run tries again",
    de="Aufträge, aus denen kein Kalibrierschein entstehen konnte oder deren Datei fehlt; der nächste Lauf "
    "versucht es erneut",
)
OVERDUE = Words(en="Overdue", de="Überfällig")
OVERDUE_CAPTION = Words(
    en="Axes that should have been measured again by now",
    de="Achsen, die inzwischen erneut gemessen sein sollten",
)
DUE_SOON = Words(en="Due soon", de="Bald fällig")
DUE_CAPTION = Words(
    en="Axes that are to be measured within {days} days of the last run",
    de="Achsen, die innerhalb von {days} Tagen nach dem letzten Lauf zu messen sind",
)
NOTHING_DUE = Words(
    en="Nothing is due within {days} days of the last run.",
    de="Innerhalb von {days} Tagen nach dem letzten Lauf wird nichts fällig.",
)
SHARED = Words(en="Shared by machines of one type", de="Maschinen eines Typs gemeinsam")
SHARED_CAPTION = Words(
    en="Parameters of the error model whose mean over {least} or more machines of a type is not zero: the "
    "cause is in their construction or common set-up rather than in one machine",
    de="Parameter des Fehlermodells, deren Mittel über {least} oder mehr Maschinen eines Typs nicht null "
    "ist: Die Ursache liegt eher in Konstruktion oder gemeinsamer Einrichtung als in einer Maschine",
)
TYPE = Words(en="Axis and type", de="Achse und Typ")
EFFECT = Words(en="Effect", de="Effekt")
MEAN = Words(en="Mean ± U", de="Mittel ± U")
MACHINES_OF_TYPE = Words(en="Machines", de="Maschinen")
MEASURED_ON = Words(en="Measured", de="Gemessen")
DUE = Words(en="Due", de="Fällig")
NOT_MET = Words(en="Limit not met", de="Grenzwert nicht eingehalten")
NOT_MET_CAPTION = Words(
    en="Parameters whose latest certificate states that the limit is not met",
    de="Kenngrößen, deren Grenzwert laut letztem Kalibrierschein nicht eingehalten ist",
)
UNDECIDED = Words(en="Undecided", de="Ohne Aussage")
UNDECIDED_CAPTION = Words(
    en="Parameters so near to their limit that the decision rule states nothing",
    de="Kenngrößen so nahe am Grenzwert, dass die Entscheidungsregel keine Aussage zulässt",
)
CHANGED = Words(en="Changed", de="Verändert")
CHANGED_CAPTION = Words(
    en="Parameters of which the latest test shows a step, or whose latest tests scatter more than before",
    de="Kenngrößen, die in der letzten Messung einen Sprung zeigen oder zuletzt stärker streuen als zuvor",
)
DRIFTING = Words(en="Drifting", de="Drift")
DRIFTING_CAPTION = Words(
    en="Parameters that drift, those first that meet their limit soonest",
    de="Kenngrößen mit signifikanter Drift; zuerst die, die ihren Grenzwert am frühesten erreichen",
)
DRAFTS = Words(en="Drafts", de="Entwürfe")
DRAFTS_CAPTION = Words(
    en="Contents that differ from what was issued under their number: issue an amendment, or undo the change",
    de="Inhalte, die vom ausgestellten Kalibrierschein gleicher Nummer abweichen: eine Änderung dazu "
    "ausstellen oder den Eingriff zurücknehmen",
)

# Machines

MACHINES = Words(en="Machines and axes", de="Maschinen und Achsen")
MACHINE_CAPTION = Words(
    en="Latest values and their course since {first}",
    de="Letzte Werte und ihr Verlauf seit {first}",
)
NO_MACHINE = Words(en="Machine not named", de="Maschine nicht benannt")
COUNTED_AXES = Words(en="{number} axes", de="{number} Achsen")
ONE_AXIS = Words(en="1 axis", de="1 Achse")
DUE_ON = Words(en="due {due}", de="fällig {due}")
SEARCH = Words(en="Search machine, axis or certificate", de="Maschine, Achse oder Kalibrierschein suchen")
CHOICE = Words(en="Show", de="Anzeigen")
ALL_AXES = Words(en="All axes", de="Alle Achsen")
ORDER = Words(en="In the order of", de="Geordnet nach")
BY_MACHINE = Words(en="machine and axis", de="Maschine und Achse")
BY_USE = Words(en="share of the limit, largest first", de="Anteil am Grenzwert, größter zuerst")
BY_DUE = Words(en="date by which it is due", de="Fälligkeit")
BY_MEASURED = Words(en="last measurement, oldest first", de="letzter Messung, älteste zuerst")
FOUND = Words(en="{shown} of {all} axes", de="{shown} von {all} Achsen")

# Columns

JOB = Words(en="Job", de="Auftrag")
MESSAGE = Words(en="What is wrong", de="Ursache")
SINCE = Words(en="Since", de="Seit")
AXIS = Words(en="Axis", de="Achse")
PARAMETER = Words(en="Parameter", de="Kenngröße")
VALUE = Words(en="Value ± U", de="Wert ± U")
LIMIT = Words(en="Limit", de="Grenzwert")
STATE = Words(en="State", de="Aussage")
COURSE = Words(en="Course", de="Verlauf")
DRIFT = Words(en="Drift ± U", de="Drift ± U")
CHANGE = Words(en="Change", de="Änderung")
CHANGE_OR_DRIFT = Words(en="Change, drift", de="Änderung, Drift")
CAME_WITH = Words(en="What changed with it", de="Was sich mit ihr änderte")
REACHED = Words(en="Limit reached", de="Grenzwert erreicht")
CERTIFICATE = Words(en="Certificate", de="Kalibrierschein")
REASON = Words(en="Why", de="Warum")

# States

MET = Words(en="met", de="eingehalten")
IS_NOT_MET = Words(en="not met", de="nicht eingehalten")
IS_OPEN = Words(en="undecided", de="ohne Aussage")
NO_LIMIT = Words(en="no limit", de="kein Grenzwert")

# Trends in full

CLOSE = Words(en="Back to the fleet", de="Zurück zur Flotte")
TREND = Words(en="{axis} of {machine}", de="{axis} von {machine}")
TESTS = Words(en="Tests", de="Messungen")
TESTS_CAPTION = Words(
    en="Every test that counts, the latest first", de="Alle gültigen Messungen, die letzte zuerst"
)
CHANGE_FACT = Words(en="Change", de="Änderung")
DRIFT_FACT = Words(en="Drift", de="Drift")
EFFECTS = Words(en="Effects", de="Einflüsse")
EFFECTS_CAPTION = Words(
    en="Parameters of this axis’s error model, by the latest test",
    de="Kenngrößen des Fehlermodells dieser Achse nach der letzten Messung",
)
INSTRUMENT_USED = Words(en="Instrument", de="Messgerät")

# Steps

STEP_SINCE = Words(en="since {since}; a step with {percent} %", de="seit {since}; zu {percent} % ein Sprung")
WILDER = Words(en="scatters more", de="streut stärker")
VISIBLE = Words(en="a step of {size} would be seen", de="ein Sprung von {size} fiele auf")
INSTRUMENT = Words(en="{after} in place of {before}", de="{after} statt {before}")

# Drift

PER_YEAR = Words(en="{change}/year", de="{change}/Jahr")
CHANCE = Words(en="{p}; {number} calibrations", de="{p}; {number} Kalibrierungen")
ALSO = Words(en="also {symbols}, without a limit", de="auch {symbols}, ohne Grenzwert")
WITHOUT_LIMIT = Words(en="no limit stated", de="kein Grenzwert angegeben")
BETWEEN = Words(en="95 %: {earliest} to {latest}", de="95 %: {earliest} bis {latest}")
NOT_BEFORE = Words(en="95 %: not before {earliest}", de="95 %: nicht vor {earliest}")
GETS_SMALLER = Words(en="moves away from it", de="entfernt sich davon")
FAR_AWAY = Words(en="not within {years} years", de="nicht innerhalb von {years} Jahren")
TOO_FEW = Words(en="{number} of {least} dates", de="{number} von {least} Terminen")
STEADY = Words(en="none found", de="keine erkennbar")

# How to read it

READING = Words(en="How to read this page", de="Lesehilfe")
TERM_VALUE = Words(en="Diamonds and line", de="Rauten und Linie")
MEANING_VALUE = Words(
    en="the certified values, the last one larger; a cross where the limit was not met",
    de="die bescheinigten Werte, der letzte größer; ein Kreuz, wo der Grenzwert nicht eingehalten war",
)
TERM_BAND = Words(en="Shaded band", de="Band")
MEANING_BAND = Words(
    en="their expanded uncertainty",
    de="ihre erweiterte Messunsicherheit",
)
TERM_LIMIT = Words(en="Dashed line", de="Gestrichelte Linie")
MEANING_LIMIT = Words(
    en="the limit; the graph stands on zero",
    de="der Grenzwert; die Grundlinie ist null",
)
TERM_STEP = Words(en="Dotted upright line", de="Gepunktete senkrechte Linie")
MEANING_STEP = Words(
    en="a step: what was before has no part in a drift",
    de="ein Sprung: was davor war, zählt nicht zu einer Drift",
)
TERM_DRIFT = Words(en="Dash-dotted line", de="Strichpunktierte Linie")
MEANING_DRIFT = Words(
    en="a drift, and where it leads",
    de="eine Drift, und wohin sie führt",
)
STEP_METHOD = Words(
    en="A step is named if the latest test differs from the mean of those before it by more than the scatter "
    "between tests explains. Where {least} or more came before, a step of {scatters} scatters is seen at "
    "once in 95 % of all cases, and one test in {alarms}, or fewer, raises a false alarm. What is less than "
    "{small} % of the limit is no news, as a step or as a drift.",
    de="Ein Sprung wird genannt, wenn die letzte Messung vom Mittel der früheren weiter abweicht, als die "
    "Streuung zwischen den Messungen erklärt. Nach {least} oder mehr Messungen fällt ein Sprung um das "
    "{scatters}-Fache der Streuung in 95 % aller Fälle sofort auf; höchstens eine von {alarms} Messungen "
    "löst Fehlalarm aus. Was weniger als {small} % des Grenzwerts ausmacht, wird weder als Sprung noch als "
    "Drift gemeldet.",
)
DRIFT_METHOD = Words(
    en="A parameter drifts if a weighted regression through {least} or more dates is steeper than its "
    "scatter explains (Student’s t), and the order of the values bears it out (Mann and Kendall). All tests "
    "of the fleet are judged together: of the axes that are named, no more than {share} % are expected to be "
    "named by accident (Benjamini and Hochberg over the axes, Holm within an axis).",
    de="Eine Drift wird genannt, wenn eine gewichtete Ausgleichsgerade durch mindestens {least} Termine "
    "steiler ist, als ihre Streuung erklärt (Student-t-Test), und die Reihenfolge der Werte sie bestätigt "
    "(Mann und Kendall). Alle Tests der Flotte werden gemeinsam beurteilt: Von den genannten Achsen werden "
    "im Mittel höchstens {share} % zufällig genannt (Benjamini und Hochberg über die Achsen, Holm innerhalb "
    "einer Achse).",
)
FORECAST_METHOD = Words(
    en="A limit is reached where the line meets it, within the 95 % interval. That holds as long as the axis "
    "goes on as it has done, and nobody adjusts it.",
    de="Ein Grenzwert gilt als erreicht, wo die Gerade ihn schneidet, mit 95-%-Intervall. Das setzt voraus, "
    "dass die Achse sich weiter so verhält wie bisher und niemand sie justiert.",
)
ALTERNATIVE = Words(
    en="{number} values of {symbol} from {first} to {last}, the last {value}.",
    de="{number} Werte von {symbol} vom {first} bis {last}, zuletzt {value}.",
)
ALTERNATIVE_LIMIT = Words(en=" Limit {limit}.", de=" Grenzwert {limit}.")
ALTERNATIVE_DRIFT = Words(en=" Drift {change}/year.", de=" Drift {change}/Jahr.")
SAMPLE = Words(
    en="An example of the small graphs, explained beside it.",
    de="Ein Beispiel der kleinen Diagramme, daneben erklärt.",
)
