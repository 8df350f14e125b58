"""Worked values of all standards on the published readings, in µm (″), from an independent calculation."""

from __future__ import annotations

import pytest

from plugins.standards.test_published import parameter

ISO = "iso230-2:2014"
ISO_1988 = "iso230-2:1988"
VDI_DGQ = "vdi-dgq-3441"
VDI_VDE = "vdi-vde-2617"
NMTBA = "nmtba"

WORKED = {
    "ecmc_13e6c326": {
        ISO: "A 125.7126, A_fwd 111.3896, A_bwd 104.0007, R 46.8677, R_fwd 32.5446, R_bwd 38.0828, "
        "E 100.052, E_fwd 88.498, E_bwd 80.030, M 84.264, B 20.022, B_mean 12.7678",
        ISO_1988: "A 138.5429, A_fwd 122.8353, A_bwd 115.9861, R 64.5246, R_fwd 48.8170, R_bwd 57.1242",
        VDI_DGQ: "P 135.1987, Pa 84.264, Ps_max 52.9706, Ps_mean 32.4159, U_max 20.022, U_mean 12.7678",
        VDI_VDE: "P 123.4831, Ps_max 35.3137, Ps_mean 21.6106",
        NMTBA: "P 147.9813, Pa 84.264, Ps_max 65.9710, Ps_mean 52.4973, O -9.4720",
    },
    "ecmc_1139bca6": {
        ISO: "A 204.7502, R 204.7502, E 74.774, M 48.095, B 43.462, B_mean 7.1856",
        ISO_1988: "A 307.1252, R 307.1252",
        VDI_DGQ: "P 168.6424, Ps_max 157.8504, U_max 43.462, U_mean 19.5504",
        VDI_VDE: "P 116.0256",
        NMTBA: "P 207.6535, O -7.0180",
    },
    "ecmc_2845f959": {
        ISO: "A 201.1460, R 201.1460, E 57.032, M 26.757, B 35.052, B_mean 0.7356",
        ISO_1988: "A 301.7107, R 301.7107",
        VDI_DGQ: "P 298.0966, U_mean 14.3780",
        VDI_VDE: "P 217.7418",
        NMTBA: "P 276.2162, O -8.0545",
    },
    "avs_bifrost_FAT_rotary": {
        ISO: "A 230.9698, R 147.9243, E 221.400, M 83.772, B 140.544, B_mean -124.8984",
        ISO_1988: "A 235.7548, R 151.6145",
        VDI_DGQ: "P 233.5983, Ps_max 17.6471, U_mean 124.8984",
        VDI_VDE: "P 229.5322",
        NMTBA: "P 507.5798, O -34.1275",
    },
}


def worked_values() -> list[object]:
    return [
        pytest.param(name, standard, symbol, value, id=f"{standard}/{name}/{symbol}")
        for name, by_standard in WORKED.items()
        for standard, values in by_standard.items()
        for symbol, value in (pair.split() for pair in values.split(", "))
    ]


@pytest.mark.parametrize(("name", "standard", "symbol", "value"), worked_values())
def test_parameter_is_the_worked_one(name: str, standard: str, symbol: str, value: str) -> None:
    half_a_digit = 0.5 * 10.0 ** -len(value.partition(".")[2])

    # What lies on the edge between two digits may have gone either way: a part of a millionth of a digit.
    assert parameter(name, standard, symbol) == pytest.approx(float(value), abs=half_a_digit * (1 + 1e-6))
