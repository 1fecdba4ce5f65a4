"""Life around a plate: the worst point is a uniaxial one, whose life the strain-life curve gives by itself."""

from functools import cache

import numpy as np
import pytest

from drivewright import fatigue
from drivewright.chains.link import design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.stress.life import life_table, plate_life
from drivewright.chains.stress.plate import Loads, amounts, plate_basis, plate_body, worst
from drivewright.errors import InputError

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]


@cache
def steel():
    return fatigue.uniform_material_law(980e6, 206e9)


@cache
def basis():
    plate = design_plate(design_link(9.525e-3, 1.2e-3, np.radians(30), 2.6e-3))
    return plate_basis(plate, plate_body(plate, 206e9, 0.3, order=3))


def pull(sizes):
    force = np.asarray(sizes, float)[:, None] * [1.0, 0.0]
    return Loads(np.stack([-force, force], axis=1), np.zeros((len(sizes), 2)), np.zeros((len(sizes), 2)))


def test_the_crotch_breaks_first_after_the_curve_s_cycles():
    loads, material = pull([0.0, 500.0]), steel()
    found = plate_life(basis(), loads, material, least=0.9)
    first, peak = int(np.argmin(found.life)), worst(basis(), loads)
    assert found.stress[first] == pytest.approx(peak.stress, rel=0.01)
    assert np.abs(basis().body.rim.points[found.rows[first]]) == pytest.approx([1.57e-3, 1.44e-3], abs=0.1e-3)
    # Brown and Miller on the 45 deg plane of a pulsating uniaxial stress s: 1.65 s/(2 E), with the mean normal stress s/4
    cycles = 2 * found.life[first]
    right = (
        1.65 * (material.fatigue_strength - peak.stress / 4) / material.youngs_modulus * cycles**material.fatigue_strength_exponent
        + 1.75 * material.fatigue_ductility * cycles**material.fatigue_ductility_exponent
    )
    assert right == pytest.approx(1.65 * peak.stress / (2 * material.youngs_modulus), rel=0.01)


def test_more_pull_shortens_the_life_and_least_leaves_only_cold_points_out():
    all_points = plate_life(basis(), pull([0.0, 500.0]), steel())
    some = plate_life(basis(), pull([0.0, 500.0]), steel(), least=0.5)
    assert some.life.min() == all_points.life.min()
    assert len(some.rows) < len(all_points.rows) / 2
    assert plate_life(basis(), pull([0.0, 550.0]), steel(), least=0.9).life.min() < some.life.min()
    assert np.all(basis().bare[all_points.rows])


def test_yielding_is_neuber_s():
    """Beyond the cyclic yield stress plastic strain is added: the life is shorter than that of the elastic history."""
    loads = pull([0.0, 900.0])
    assert worst(basis(), loads).stress > steel().cyclic_yield
    found = plate_life(basis(), loads, steel(), least=0.95)
    row = [int(found.rows[found.life.argmin()])]
    stress = fatigue.superpose(amounts(basis(), loads), basis().stress[:, row])
    local = fatigue.neuber_history(stress[0], steel())
    assert fatigue.brown_miller(local.strain, local.stress, steel()).life == pytest.approx(found.life.min(), rel=1e-9)
    assert local.stress.max() < stress.max()


def test_a_steady_pull_does_no_damage_and_the_table_says_so():
    found = plate_life(basis(), pull([100.0, 100.0]), steel(), least=0.9)
    assert np.all(np.isinf(found.life))
    table = life_table(basis(), found)
    assert np.allclose(np.column_stack([table["x"].data, table["y"].data]), basis().body.rim.points[found.rows])
    assert np.all(table["damage"].data == 0)


def test_messages():
    with pytest.raises(InputError, match="`least` = 1; it is a share"):
        plate_life(basis(), pull([0.0, 1.0]), steel(), least=1.0)
