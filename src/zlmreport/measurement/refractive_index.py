"""The refractive index of air by its state, and standard air: by how much an interferometer errs.

The equation is Edlén's as updated by Birch and Downs (Metrologia 30, 1993, 155-162; 31, 1994, 315-316), its
term for water vapour scaled with temperature as NIST does, so that it holds on a shop floor too (Stone and
Zimmerman, Index of refraction of air, NIST Engineering Metrology Toolbox, appendix A-IV). The saturation
vapour pressure over water is that of IAPWS (the same, appendix A-I). Between 0 °C and 40 °C it agrees with
Ciddor's equation to 2 parts in 10⁸; good sensors of temperature and pressure do not come near that.
"""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import REFERENCE_TEMPERATURE, ZERO_CELSIUS

#: Vacuum wavelength of a helium-neon laser, m.
HELIUM_NEON = 632.991e-9
#: What an interferometer assumes that measures no air: 20 °C, 1013.25 hPa, 50 % relative humidity.
STANDARD_PRESSURE = 101_325.0
#: Relative humidity of standard air, as a share of 1.
STANDARD_HUMIDITY = 0.5


def refractive_index(
    temperature: FloatArray, pressure: FloatArray, humidity: FloatArray, wavelength: float = HELIUM_NEON
) -> FloatArray:
    """Return the refractive index n of air with 450 ppm carbon dioxide.

    Parameters
    ----------
    temperature
        Of the air, K.
    pressure
        Pa.
    humidity
        Relative humidity over water, 1.
    wavelength
        Of the light in vacuum, m.
    """
    celsius = temperature - ZERO_CELSIUS
    wavenumber = (1e-6 / wavelength) ** 2  # µm⁻²
    standard_air = 1e-8 * (8342.54 + 2_406_147 / (130 - wavenumber) + 15_998 / (38.9 - wavenumber))
    density = (1 + 1e-8 * (0.601 - 0.00972 * celsius) * pressure) / (1 + 0.003661 * celsius) / 96_095.43
    vapour = humidity * saturation_vapour_pressure(temperature)
    moisture = 1e-10 * (292.75 / temperature) * (3.7345 - 0.0401 * wavenumber) * vapour
    return 1 + pressure * standard_air * density - moisture


def saturation_vapour_pressure(temperature: FloatArray) -> FloatArray:
    """Return the pressure of saturated water vapour over water, Pa, at a temperature in kelvin (IAPWS)."""
    reduced = temperature - 0.238_555_575_678 / (temperature - 650.175_348_448)
    a = (reduced + 1_167.052_145_28) * reduced - 724_213.167_032
    b = (-17.073_846_940_1 * reduced + 12_020.824_702_5) * reduced - 3_232_555.032_23
    c = (14.915_108_613_5 * reduced - 4_823.265_736_16) * reduced + 405_113.405_421
    root = 2 * c / (np.sqrt(b * b - 4 * a * c) - b)
    return np.asarray(1e6 * root**4)


def index_change(temperature: FloatArray, pressure: FloatArray, humidity: FloatArray) -> FloatArray:
    """Return Δn, the index less that of the standard air that an uncompensated interferometer assumes.

    Such an interferometer reads a length too long by the factor 1 + Δn: in thin air, Δn < 0, too short.
    """
    return refractive_index(temperature, pressure, humidity) - compute_standard_index()


def compute_standard_index(wavelength: float = HELIUM_NEON) -> float:
    """Return the index of air at 20 °C, 1013.25 hPa and 50 %."""
    state = (REFERENCE_TEMPERATURE, STANDARD_PRESSURE, STANDARD_HUMIDITY)
    temperature, pressure, humidity = map(np.array, state)
    return float(refractive_index(temperature, pressure, humidity, wavelength))
