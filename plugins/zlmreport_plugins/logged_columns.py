"""Names of columns that loggers write, in six languages and without accents: times, air and machine."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from types import MappingProxyType


def list_spellings(names: str) -> Iterator[str]:
    """Yield names that stand in a row, each as it is written with accents and as keyboards without them do.

    >>> list(list_spellings("écart run"))
    ['écart', 'ecart', 'run']
    """
    for name in names.split():
        parted = unicodedata.normalize("NFD", name)
        yield from dict.fromkeys((name, "".join(each for each in parted if not unicodedata.combining(each))))


#: Names as files write them, folded, by what they are.
LOGGED: Mapping[str, str] = MappingProxyType(
    {
        name: column
        for column, names in {
            "time": "zeit timestamp uhrzeit zeitstempel t messzeit clock date_time datum_zeit datum/zeit "
            "datum_uhrzeit datum/uhrzeit datum_und_uhrzeit datetime date/time zeitpunkt "
            "temps heure horodatage date_heure date/heure tempo ora orario data_ora data/ora "
            "tiempo hora fecha_hora fecha/hora "
            "时间 日期 日期时间 测量时间 采样时间 時間",
            "air_temperature": "lufttemperatur air_temp air_temp. t_luft t_air luft_temp raumtemperatur "
            "hallentemperatur umgebungstemperatur room_temperature ambient_temperature température_de_l'air "
            "température_air température_ambiante temp_air temperatura_dell'aria temperatura_aria "
            "temperatura_ambiente temp_aria t_aria temperatura_del_aire temperatura_aire temp_aire t_aire "
            "空气温度 环境温度 气温 室温 環境溫度",
            "material_temperature": "materialtemperatur material_temp t_mat werkstofftemperatur mat_temp "
            "t_material werkstücktemperatur température_du_matériau température_matériau température_matière "
            "température_de_la_pièce temperatura_del_materiale temperatura_materiale temperatura_del_pezzo "
            "temperatura_pezzo temperatura_del_material temperatura_material temperatura_de_la_pieza "
            "材料温度 工件温度 材料溫度",
            "axis_temperature": "maßstabstemperatur scale_temperature t_achse scale_temp "
            "température_de_la_règle température_règle temperatura_della_riga temperatura_riga "
            "temperatura_de_la_regla temperatura_regla "
            "光栅尺温度 标尺温度",
            "screw_temperature": "spindeltemperatur screw_temp t_spindel température_de_la_vis "
            "température_vis temperatura_della_vite temperatura_vite temperatura_del_husillo "
            "temperatura_husillo "
            "丝杠温度 丝杆温度",
            "air_pressure": "luftdruck pressure druck p_luft air_press pression pression_de_l'air "
            "pression_air pression_atmosphérique pressione pressione_dell'aria pressione_aria "
            "pressione_atmosferica presión presión_del_aire presión_atmosférica "
            "气压 大气压 大气压力 空气压力 氣壓",
            "relative_humidity": "luftfeuchte luftfeuchtigkeit humidity feuchte rel._feuchte rh "
            "rel._humidity relative_luftfeuchte rel._luftfeuchte humidité humidité_relative hygrométrie "
            "umidità umidità_relativa humedad humedad_relativa "
            "湿度 相对湿度 空气湿度 相對濕度",
        }.items()
        for name in list_spellings(names)
    }
)
#: A temperature of which its name does not tell whose it is, folded.
SOME_TEMPERATURE = frozenset(list_spellings("temperatur température temperatura temp temp. 温度 溫度"))
