"""A shaft as a solid against the beam: the paper's two shafts, steps, bores, cones, the shear coefficient, statics, the surface."""

import re
from functools import cache

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.shafts.sections import area, cowper_coefficient, second_moment
from drivewright.shafts.solid_check import solid_flexibility, surface_table
from drivewright.solids.elastic import Response, spring_supported
from drivewright.solids.turning import Band, split_rings

pytestmark = pytest.mark.property

E, NU = 206e9, 0.3
needs_fe = pytest.mark.needs_fe
PAPER = [(0.34, 0.02, 0.02, 0.0)]
SEATS = ((0.0565, 0.002, 3e7), (0.1365, 0.002, 3e7))
PLACES = (0.0, 0.245)
UPPER = np.triu_indices(2)


@cache
def solid(sections=tuple(PAPER), seats=SEATS, places=PLACES, **options):
    return solid_flexibility(sections, E, NU, seats, places, **options)


def beam(sections, seats, places, shear=True):
    """Unit-load integral of a shaft on two springs: int M_i M_j/EI + V_i V_j/(kappa G A) dx + r_i r_j/k, Gauss between all breaks."""
    ends = np.concatenate([[0.0], np.cumsum([section[0] for section in sections])])
    (a, _, ka), (b, _, kb) = seats
    s = np.array(places)
    right = (s - a) / (b - a)
    left = 1 - right
    found = np.outer(left, left) / ka + np.outer(right, right) / kb
    nodes, weights = np.polynomial.legendre.leggauss(16)
    breaks = np.unique([*ends, a, b, *s])
    for low, high in zip(breaks[:-1], breaks[1:], strict=True):
        number = int(np.searchsorted(ends, (low + high) / 2)) - 1
        length, start, end, bore = sections[number]
        for node, weight in zip(nodes, weights, strict=True):
            x, part = (low + high) / 2 + node * (high - low) / 2, weight * (high - low) / 2
            d = start + (end - start) * (x - ends[number]) / length
            moment = left * max(x - a, 0) + right * max(x - b, 0) - np.maximum(x - s, 0)
            force = left * (x > a) + right * (x > b) - (x > s)
            found += part * np.outer(moment, moment) / (E * second_moment(d, bore))
            found += shear * part * np.outer(force, force) * 2 * (1 + NU) / (E * cowper_coefficient(d, bore, NU) * area(d, bore))
    return found


def gap(found, wanted):
    """Relative differences of the entries 11, 12, 22."""
    return (found / wanted - 1)[UPPER]


@needs_fe
def test_the_papers_pressure_roller_shaft():
    found = solid().flexibility
    timoshenko = np.array([[2.078127e-7, -8.556052e-8], [-8.556052e-8, 7.151497e-7]])
    assert np.abs(gap(found, timoshenko)).max() < 2e-3
    assert np.abs(gap(found, np.array([[2.0791e-7, -8.5604e-8], [-8.5604e-8, 7.1527e-7]]))).max() < 2e-3  # another finite-element program
    euler = np.array([[2.034432e-7, -8.208730e-8], [-8.208730e-8, 7.035621e-7]])
    assert gap(euler, found) == pytest.approx([-0.021, -0.041, -0.016], abs=1.5e-3)  # the beam without shear is too stiff
    assert np.abs(found - found.T).max() < 1e-14 * found.max()
    assert beam(PAPER, SEATS, PLACES) == pytest.approx(timoshenko, rel=2e-5)  # with I = 7854 mm^4
    assert 5_000 < solid().unknowns < 15_000 and solid().seconds > 0


@needs_fe
@pytest.mark.slow
def test_the_papers_rubber_roller_shaft():
    seats = ((0.135, 0.002, 3e7), (0.461, 0.002, 3e7))
    found = solid(((0.49, 0.02, 0.02, 0.0),), seats, (0.053, 0.2015)).flexibility
    assert np.abs(gap(found, np.array([[6.241800e-7, -2.303044e-7], [-2.303044e-7, 2.131081e-7]]))).max() < 2e-3
    euler = np.array([[6.195285e-7, -2.303044e-7], [-2.303044e-7, 2.107088e-7]])
    assert gap(euler, found) == pytest.approx([-0.0076, -0.0005, -0.0115], abs=1.5e-3)  # the cross entry has no shear part


@needs_fe
def test_reactions_are_those_of_statics_and_rigid_bearings_are_the_limit_of_stiff_ones():
    a, b = 0.0565, 0.1365
    right = (np.array(PLACES) - a) / (b - a)
    assert solid().reactions == pytest.approx(-np.array([1 - right, right]), abs=1e-5)
    rigid, stiff = (solid(seats=tuple((p, w, k) for p, w, _ in SEATS)).flexibility for k in (np.inf, 3e15))
    assert rigid == pytest.approx(stiff, rel=1e-6)
    share = np.outer(1 - right, 1 - right) / 3e7 + np.outer(right, right) / 3e7
    assert solid().flexibility - rigid == pytest.approx(share, rel=1e-4)  # springs in series


@needs_fe
@pytest.mark.parametrize(
    "sections, near",
    [
        (((0.34, 0.02, 0.03, 0.0),), 3e-3),  # a cone, both bands on its flank
        (((0.1, 0.02, 0.03, 0.008), (0.24, 0.03, 0.02, 0.008)), 4e-3),  # two hollow cones
        (((0.34, 0.02, 0.02, 0.01),), 6e-3),  # a tube gives way under narrow bands
    ],
    ids=["cone", "hollow cones", "tube"],
)
@pytest.mark.slow
def test_cones_and_bores_agree_with_the_beam(sections, near):
    found, wanted = solid(sections).flexibility, beam(sections, SEATS, PLACES)
    assert np.abs(gap(found, wanted)).max() < near
    assert np.abs(gap(beam(sections, SEATS, PLACES, shear=False), wanted)).max() > 4 * near  # so close only with the right shear


@needs_fe
def test_a_shoulder_is_softer_than_the_beam_says():
    # near a step the outer fibres of the thick part carry nothing: the beam counts them in full
    thick = ((0.16, 0.02, 0.02, 0.0), (0.06, 0.03, 0.03, 0.0), (0.12, 0.02, 0.02, 0.0))
    extra = gap(solid(thick).flexibility, beam(thick, SEATS, PLACES))
    assert abs(extra[0]) < 2e-3, "the step lies beyond both bearings and the load"
    assert 0.01 < extra[2] < 0.03
    assert solid(thick).flexibility[1, 1] < solid().flexibility[1, 1]


@needs_fe
@pytest.mark.slow
def test_a_band_across_a_step_holds_both_diameters():
    # the beam with the step in the middle of the bearing; the shoulder itself is not part of the seat
    sections = ((0.0565, 0.019, 0.019, 0.0), (0.2835, 0.02, 0.02, 0.0))
    assert np.abs(gap(solid(sections).flexibility, beam(sections, SEATS, PLACES))).max() < 8e-3


@needs_fe
def test_three_bearings_and_a_station_within_a_band():
    third = (*SEATS, (0.3, 0.002, 1.0))  # N/m: as good as none
    assert solid(seats=third).flexibility == pytest.approx(solid().flexibility, rel=2e-3)
    held_there = solid(seats=(*SEATS, (0.245, 0.002, 1e12)))
    assert held_there.flexibility[1, 1] < 1e-3 * solid().flexibility[1, 1]
    assert held_there.reactions[2, 1] == pytest.approx(-1.0, rel=2e-3)


@needs_fe
@pytest.mark.slow
def test_units_do_not_matter():
    sections, seats = [(0.05, 0.02, 0.02, 0.0)], [(0.01, 0.004, 1e8), (0.04, 0.004, 2e8)]
    one = solid_flexibility(sections, E, NU, seats, [0.025]).flexibility
    tenfold = [(10 * p, 10 * w, 10 * k) for p, w, k in seats]  # lengths times 10: flexibility through 10
    assert solid_flexibility(10 * np.array(sections), E, NU, tenfold, [0.25]).flexibility == pytest.approx(one / 10, rel=1e-6)
    softer = [(p, w, k / 7) for p, w, k in seats]
    assert solid_flexibility(sections, E / 7, NU, softer, [0.025]).flexibility == pytest.approx(7 * one, rel=1e-9)


@needs_fe
@pytest.mark.parametrize("bore", [pytest.param(0.0, marks=pytest.mark.slow), 16.0])
def test_cowpers_coefficient_is_the_solids(bore):
    """Between two sections away from the loads  w' + phi = V/(kappa G A), w and phi the means of displacement and turn."""
    import ngsolve as ng

    diameter, length = 20.0, 90.0
    body, cuts = free_tube(diameter, bore, length)
    inertia, modulus = second_moment(diameter, bore), E * 1e-6
    lift = [body.mean(cut, (0, 1, 0)) for cut in cuts]
    turn = [body.weighted(cut, ng.CF((0, 0, ng.y)) / inertia) for cut in cuts]  # mean turn phi, for u_z = phi y
    load = lift[0].CreateVector()
    load.data = lift[-1] - lift[0] + length / 2 * turn[0] + length / 2 * turn[-1]  # unit shear force, in balance
    found = body.response([load, *lift[1:4], *turn[1:4]])
    assert np.abs(found.resultants[:, 0]).max() < 1e-3
    w, phi = 1e3 * found.flexibility[0, 1:4], 1e3 * found.flexibility[0, 4:]  # mm/N, 1/N
    slip = (w[2] - w[0]) / diameter + (phi[0] + 4 * phi[1] + phi[2]) / 6  # phi is a parabola: Simpson's rule is exact
    kappa = 2 * (1 + NU) / (modulus * area(diameter, bore) * slip)
    assert kappa == pytest.approx(cowper_coefficient(diameter, bore, NU), rel=0.01)
    assert abs(kappa / (6 * (1 + NU) ** 2 / (7 + 12 * NU + 4 * NU**2)) - 1) > 0.03  # another round-section coefficient, 0.925


def free_tube(diameter, bore, length):
    """(FreeBody, names of five cross-sections): the ends, the middle, and a radius before and behind it."""
    import ngsolve as ng
    from netgen import occ

    from drivewright.solids.elastic import FreeBody

    places = [0.0, (length - diameter) / 2, length / 2, (length + diameter) / 2, length]
    ends = zip(places[:-1], places[1:], strict=True)
    pieces = [occ.Cylinder(occ.Pnt(0, 0, low), occ.Z, r=diameter / 2, h=high - low) for low, high in ends]
    if bore:
        pieces = [piece - occ.Cylinder(occ.Pnt(0, 0, -1), occ.Z, r=bore / 2, h=length + 2) for piece in pieces]
    shape = occ.Glue(pieces)
    for face in shape.faces:
        low, high = face.bounding_box
        face.name = f"cut{places.index(round(face.center.z, 6))}" if high[2] - low[2] < 1e-3 else "skin"
    return FreeBody(ng.Mesh(occ.OCCGeometry(shape).GenerateMesh(maxh=6.0)).Curve(2), E, NU), [f"cut{n}" for n in range(5)]


@needs_fe
def test_a_free_body_moves_as_a_whole_only_where_it_is_held():
    body, cuts = free_tube(20.0, 0.0, 60.0)
    assert body.basis.shape == (6, 6)
    across, along = [body.mean(cut, (0, 1, 0)) for cut in cuts], body.mean("cut4", (0, 0, 1))
    assert spring_supported(body.response([across[0], across[4], across[2]]), [1e6, 3e6]).reactions.ravel() == pytest.approx(
        [-0.5, -0.5], rel=1e-6
    )
    with pytest.raises(InputError, match="load 1 pushes the body where no spring holds it .*add a support in that direction"):
        spring_supported(body.response([across[0], across[4], across[2], along]), [1e6, 3e6])
    pull = spring_supported(body.response([body.mean("cut0", (0, 0, 1)), along]), [np.inf]).flexibility[0, 0]
    assert pull == pytest.approx(0.06 / (E * area(0.02, 0.0)), rel=2e-3)  # l/EA
    with pytest.raises(InputError, match="no face of the mesh is called 'nope'; there are cut0, cut1"):
        body.mean("nope", (0, 1, 0))


def test_the_dense_system_of_a_rigid_bar_on_springs():
    # G = 0: levers only.  Motions: shift and turn about the middle, places at -1, 1 (springs) and 2 (load)
    bar = Response(np.zeros((3, 3)), np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, 2.0]]), ())
    found = spring_supported(bar, [10.0, 40.0])
    assert found.reactions[:, 0] == pytest.approx([0.5, -1.5])
    assert found.flexibility[0, 0] == pytest.approx(0.5**2 / 10 + 1.5**2 / 40)
    assert found.motions[:, 0] == pytest.approx([(-0.05 + 0.0375) / 2, (0.0375 + 0.05) / 2])
    with pytest.raises(InputError, match="load 0 pushes the body where no spring holds it"):
        spring_supported(Response(np.zeros((2, 2)), np.array([[1.0, 1.0], [1.0, 2.0]]), ()), [10.0])


@needs_fe
def test_the_surface_is_the_shaft_and_moves_as_the_flexibility_says():
    found = solid()
    a, b, c = np.moveaxis(found.surface.points[found.surface.triangles], 1, 0)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(np.pi * 0.01**2 * 0.34, rel=0.015)
    left, right = found.surface.points[:, 2] < 1e-9, found.surface.points[:, 2] > 0.34 - 1e-9
    assert found.surface.displacements[:, left, 1].mean(axis=1) == pytest.approx(-found.flexibility[:, 0], rel=2e-3)
    assert np.abs(found.surface.displacements[:, right, 0].mean(axis=1)).max() < 1e-20  # nothing sideways
    slope = -np.polyfit(found.surface.points[right, 1], found.surface.displacements[1, right, 2], 1)[0]  # plane sections: u_z = -w' y
    assert slope == pytest.approx((found.surface.displacements[1, right, 1].mean() + found.flexibility[1, 1]) / (0.34 - 0.245), rel=0.02)


@needs_fe
def test_bending_squeezes_the_cross_section_sideways_on_the_stretched_side():
    # u_x = -nu M/EI x y in all four quarters, away from bands and loads
    found = solid()
    x, y, z = found.surface.points[np.abs(found.surface.points[:, 2] - 0.19) < 0.02].T
    u = found.surface.displacements[1, np.abs(found.surface.points[:, 2] - 0.19) < 0.02, 0]
    wanted = -NU * (0.245 - z) / (E * second_moment(0.02, 0.0)) * x * y
    for side in (x > 0, x < 0, y > 0, y < 0):
        assert u[side] == pytest.approx(wanted[side], abs=0.05 * np.abs(wanted).max())


@needs_fe
def test_the_table_of_the_deformed_surface():
    table = surface_table(solid(), 1, 500.0)
    z, y, x, size, rest_z, rest_y = (column.data for column in table.columns)
    assert len(z) == solid().surface.triangles.size and {column.unit for column in table.columns} == {"m"}
    assert size.max() == pytest.approx(500 * np.linalg.norm(solid().surface.displacements[1], axis=1).max())
    assert table["displacement"].meaning == "displacement, drawn 20 times as large"
    tip = rest_z > 0.34 - 1e-9
    end = solid().surface.points[:, 2] > 0.34 - 1e-9
    assert (y - rest_y)[tip].mean() == pytest.approx(20 * 500 * solid().surface.displacements[1, end, 1].mean(), rel=0.01)
    assert y[tip].mean() < rest_y[tip].mean() - 0.01, "a force acts downwards"
    assert surface_table(solid(), 0, 1.0, exaggeration=0.5)["displacement"].meaning.endswith("drawn 0.5 times as large")


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"bands": SEATS[:1]}, "solid check: 1 bearing; it needs two or more, since bands hold mean displacements but no tilt"),
        ({"bands": (SEATS[0], (0.3395, 0.002, 3e7))}, "band 1 reaches from 338.5 to 340.5 mm, beyond the shaft of 0 ... 340 mm"),
        ({"bands": (SEATS[0], (0.1, 0.0, 3e7))}, "band 1 at 100 mm has width 0 mm and stiffness 3e+07 N/m; both must be positive"),
        ({"bands": (SEATS[0], (0.1, 0.01, -1.0))}, "band 1 at 100 mm has width 10 mm and stiffness -1 N/m"),
        ({"bands": (SEATS[0], (0.0575, 0.002, 3e7))}, "the bands at 56.5 and 57.5 mm overlap; make them narrower"),
        ({"stations": (0.0, 0.4)}, "a station at 400 mm lies outside the shaft of 0 ... 340 mm"),
        ({"stations": ()}, "no station; give at least one position to load"),
        ({"poisson": 0.5}, "Poisson's ratio 0.5; a solid needs E > 0 and -1 < nu < 0.5"),
        ({"modulus": 0.0}, "modulus 0 Pa"),
        ({"max_size": 0.0}, "max_size 0 mm; elements need a positive size"),
        ({"sections": [(0.34, 0.02, 0.02, 0.02)]}, "shaft: ring 0 has length 340 mm, diameters 20 and 20 mm, bore 20 mm"),
    ],
)
def test_what_cannot_be_checked_is_refused(changes, message):
    given = {"sections": PAPER, "modulus": E, "poisson": NU, "bands": SEATS, "stations": PLACES} | changes
    with pytest.raises(InputError, match=re.escape(message)):
        solid_flexibility(**given)


def test_cuts_at_every_edge_once():
    pieces = split_rings([(0.1, 0.02, 0.03, 0.0), (0.1, 0.03, 0.03, 0.01)], [*Band(0.05, 0.02).edges, 0.0, 0.1 + 1e-9, 0.06])
    assert [piece.low for piece in pieces] == pytest.approx([0.0, 0.04, 0.06, 0.1]) and pieces[-1].high == pytest.approx(0.2)
    assert (pieces[1].start, pieces[1].end) == pytest.approx((0.024, 0.026))
    assert [piece.bore for piece in pieces] == [0, 0, 0, 0.01]
