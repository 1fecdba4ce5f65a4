"""Chains that cannot be closed: the message says what, where, how much and what to try."""

import numpy as np
import pytest

from drivewright.chains.closure import Drive, close, departure, phased, states_at, tracking
from drivewright.chains.link import Link, design_link
from drivewright.errors import DoesNotAssemble, InputError, SolverError, UnknownName

pytestmark = pytest.mark.error

JOINT = design_link(9.525e-3, 1.2e-3, np.pi / 6, 2.6e-3)
GOOD = Drive(JOINT, 35, 37, 82)

CASES = [
    ({"links": 30}, DoesNotAssemble, "30 links do not reach around the sprocket with 37 teeth and the other one. Take at least 59, with"),
    ({"driver_teeth": 37, "links": 38}, DoesNotAssemble, "38 links around 37 and 37 teeth leave no free plate in a strand, at a centre d"),
    ({"driven_teeth": 5, "links": 40}, DoesNotAssemble, "40 links around 35 and 5 teeth leave fewer than two plates on a sprocket"),
    ({"links": 82.0}, InputError, "chain: links = 82.0; it must be a whole number from 1 up"),
    ({"driver_teeth": 4}, InputError, "chain: driver_teeth = 4; it must be a whole number from 5 up"),
    ({"driven_teeth": True}, InputError, "chain: driven_teeth = true; it must be a whole number from 5 up"),
    ({"driven_teeth": np.nan}, InputError, "chain: driven_teeth = nan"),
    ({"strands": "strait"}, UnknownName, "no form of the strands is called 'strait' (did you mean 'straight'?); known: equilibrium, str"),
    ({"link": Link(9e-3, 4.5e-3, 0.5, 3e-3)}, InputError, "hole pitch 9 mm and rolling radius 4.5 mm; the radius must be at least"),
    ({"link": Link(9e-3, -1e-3, 0.5, 3e-3)}, InputError, "rolling radius -1 mm"),
    ({"link": Link(np.nan, 1e-3, 0.5, 3e-3)}, InputError, "hole pitch nan mm"),
    ({"link": Link(np.inf, 1e-3, 0.5, 3e-3)}, InputError, "hole pitch inf mm"),
]


@pytest.mark.parametrize("change, kind, message", CASES, ids=[message[:40] for _, _, message in CASES])
def test_what_cannot_close_is_refused_with_numbers(change, kind, message):
    with pytest.raises(kind) as caught:
        close(GOOD._replace(**change))
    assert message in str(caught.value)
    assert type(caught.value) is kind


def test_the_numbers_in_the_messages_hold():
    """With the links a message asks for the chain closes, its pitch circles just clear of each other."""
    found = close(GOOD._replace(links=59))
    radii = sum(0.5 * JOINT.pitch / np.sin(np.pi / teeth) for teeth in (35, 37))
    assert radii < found.mean < radii + JOINT.pitch
    assert close(GOOD._replace(links=58)).mean < radii  # computed all the same; whether it can be built is for others to check
    assert close(GOOD._replace(driven_teeth=8, links=39)).states.wrap.min() < np.radians(110)


def test_positions_and_angles_are_checked():
    with pytest.raises(InputError, match="positions = 3; it must be a whole number from 4 up"):
        close(GOOD, 3)
    found = close(GOOD, 4)
    for angle in (np.nan, [[0.1]], [0.1, np.inf]):
        with pytest.raises(InputError, match="states_at: the driver's angles must be finite numbers in one row"):
            states_at(found, angle)
    for share in (-0.1, 1.5, np.nan):
        with pytest.raises(InputError, match="phased: share = .* of a pitch; it must be from 0 to 1"):
            phased(found, share)


@pytest.mark.parametrize("teeth, strands, kind, message", [(4, "straight", InputError, "teeth = 4"), (17, "bent", UnknownName, "'bent'")])
def test_a_departure_checks_its_input(teeth, strands, kind, message):
    with pytest.raises(kind, match=message):
        departure(JOINT, teeth, strands)


@pytest.mark.parametrize(
    "outcome, what", [(tracking.LOST, "position of the plates is not found"), (tracking.RESTLESS, "seats of the plates do not converge")]
)
def test_a_solver_that_gives_up_says_where_and_hands_over_what_it_had(monkeypatch, outcome, what):
    follow = tracking.follow

    def interrupted(*given):
        track = follow(*given)
        track.outcome[0], track.length[0] = outcome, 20
        return track

    monkeypatch.setattr(tracking, "follow", interrupted)
    with pytest.raises(SolverError) as caught:
        close(GOOD)
    angle = np.degrees(caught.value.partial.driver_angle[-1])
    words = f"the {what} beyond a driver angle of {angle:.4f}°, after 20 samples, at a centre distance of about 219.1 mm"
    assert words in str(caught.value)
    assert len(caught.value.partial.driver_angle) == 20
    monkeypatch.setattr(tracking, "solve_at", lambda *given: np.inf)
    with pytest.raises(SolverError, match="states_at: a position between two samples is not found"):
        states_at(caught.value.partial, 0.01)
