"""A machine of rigid bodies, measured line by line at other places and tools, and predicted from that."""

from itertools import product

import numpy as np
import pytest

from machines.exact import exact_deviation
from zlmreport.machines.kinematics import COMPONENTS, SQUARENESS, TRANSLATIONS, find_square_slope
from zlmreport.machines.reading import read_machine
from zlmreport.machines.volume import Space, map_volume, predict_diagonals
from zlmreport.plugin.registry import find_plugins

ARCSECOND = np.radians(1 / 3600)
NODES = np.linspace(0.0, 0.4, 5)
TOOL = (0.02, -0.03, 0.11)


class ExactMachine:
    """Carriages with errors so small that what is of second order is nothing: 0.1 µm, 0.2 µrad."""

    def __init__(self, chain, random):
        self.chain = chain
        self.errors = {
            name: (1e-7 if name in TRANSLATIONS else 2e-7) * random.standard_normal(5).cumsum()
            for name in COMPONENTS
        }

    def deviate(self, place, tool):
        here = {
            name: np.interp(place["XYZ".index(name[2])], NODES, each) for name, each in self.errors.items()
        }
        return exact_deviation(self.chain, tuple(place), tool, here)

    def read_line(self, axis, direction, place, tool):
        """Return Δ in a direction along an axis, the others at a place."""
        places = np.tile(place, (len(NODES), 1))
        places[:, "XYZ".index(axis)] = NODES
        return np.array([self.deviate(each, tool)["XYZ".index(direction)] for each in places])

    def measure(self, name, place, tool):
        if name in SQUARENESS:
            leaning, along, sign = find_square_slope(name)
            lines = (self.read_line(*axes, place, tool) for axes in ((along, leaning), (leaning, along)))
            return sign * sum(np.polyfit(NODES, line, 1)[0] for line in lines) / ARCSECOND
        if name in TRANSLATIONS:
            values = self.read_line(name[2], name[1], place, tool) * 1e6
        else:
            values = self.errors[name] / ARCSECOND
        return {float(1e3 * node): float(value) for node, value in zip(NODES, values, strict=True)}


def remove_pose(points, deviation):
    """Return what no shift and no turn of the workpiece takes away."""
    columns = [np.tile(each, (len(points), 1)).ravel() for each in np.eye(3)]
    columns += [np.cross(each, points).ravel() for each in np.eye(3)]
    base, _ = np.linalg.qr(np.column_stack(columns))
    return deviation.ravel() - base @ (base.T @ deviation.ravel())


@pytest.mark.parametrize("chain", ["XYFZ", "FYXZ", "ZXFY", "YZFX", "FXZY", "ZFYX"])
def test_a_machine_is_predicted_from_lines_at_any_places_but_for_its_pose(tmp_path, chain):
    random = np.random.default_rng(17)
    machine = ExactMachine(chain, random)
    items = []
    for name in (*COMPONENTS, *SQUARENESS):
        place, tool = random.integers(0, 400, 3) / 1e3, random.integers(-150, 150, 3) / 1e3
        others = {axis: each for axis, each in zip("XYZ", place, strict=True) if name[2] != axis}
        if name in SQUARENESS:
            others = dict(zip("XYZ", place, strict=True))
        at = ", ".join(f"{axis}: {1e3 * each:g}" for axis, each in others.items())
        where = f"{at}, tool: [{', '.join(f'{1e3 * each:g}' for each in tool)}]"
        value = machine.measure(name, place, tuple(tool))
        shown = (
            f"{{{', '.join(f'{k}: {v!r}' for k, v in value.items())}}}" if isinstance(value, dict) else value
        )
        items.append(f"  - {{{name}: {shown}, expanded_uncertainty: 1, at: {{{where}}}}}")
    head = f"schema: zlmreport/machine/1\nchain: {chain}\ntool: {[1e3 * each for each in TOOL]}\nerrors:"
    path = tmp_path / "machine.yaml"
    path.write_text("\n".join([head, *items]) + "\n", encoding="utf-8")
    model, space = read_machine(path, find_plugins()).machine, Space(np.zeros(3), np.full(3, 0.4))

    found = map_volume(model, space)
    points = np.array(list(product(*found.grids)))
    true = np.array([machine.deviate(each, TOOL) for each in points])
    left = remove_pose(points, true - found.deviation.reshape(-1, 3))
    assert np.abs(left).max() < 1e-5 * np.abs(remove_pose(points, true)).max()

    for each in predict_diagonals(model, space):  # a length knows no pose
        way = np.array([1.0 if letter == "P" else -1.0 for letter in each.name]) / np.sqrt(3)
        begin = np.where(way > 0, 0.0, 0.4)
        along = [machine.deviate(begin + at * way, TOOL) @ way for at in each.at]
        assert each.deviation == pytest.approx(np.array(along) - along[0], abs=1e-5 * np.ptp(along))
