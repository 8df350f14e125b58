"""Names of columns that loggers write, in English and German: times, days, air and machine."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

#: Names as files write them, folded, by what they are.
LOGGED: Mapping[str, str] = MappingProxyType(
    {
        name: column
        for column, names in {
            "time": "zeit timestamp uhrzeit zeitstempel t messzeit clock date_time datum_zeit datum/zeit "
            "datum_uhrzeit datum/uhrzeit datum_und_uhrzeit datetime date/time zeitpunkt",
            "air_temperature": "lufttemperatur air_temp air_temp. t_luft t_air luft_temp raumtemperatur "
            "hallentemperatur umgebungstemperatur room_temperature ambient_temperature",
            "material_temperature": "materialtemperatur material_temp t_mat werkstofftemperatur mat_temp "
            "t_material werkstücktemperatur",
            "axis_temperature": "maßstabstemperatur scale_temperature t_achse scale_temp",
            "screw_temperature": "spindeltemperatur screw_temp t_spindel",
            "air_pressure": "luftdruck pressure druck p_luft air_press",
            "relative_humidity": "luftfeuchte luftfeuchtigkeit humidity feuchte rel._feuchte rh "
            "rel._humidity relative_luftfeuchte rel._luftfeuchte",
        }.items()
        for name in names.split()
    }
)
#: A temperature of which its name does not tell whose it is, folded.
SOME_TEMPERATURE = frozenset({"temperatur", "temperature", "temp", "temp."})
