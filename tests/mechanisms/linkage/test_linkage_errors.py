"""What a linkage is refused for: the key, the number, the remedy."""

import copy

import pytest

from drivewright.errors import SpecError
from drivewright.mechanisms.linkage.describe import describe
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.spec import from_document, set_key

pytestmark = pytest.mark.error

TABLES = {
    "mechanism": "linkage",
    "ground": {"points": {"O2": ["0 mm", "0 mm"], "O4": ["120 mm", "0 mm"]}},
    "bodies": {
        "crank": {"mass": "0.2 kg", "inertia": "1e-4 kg m^2", "points": {"O2": ["0 mm", "0 mm"], "A": ["40 mm", "0 mm"]}},
        "coupler": {"mass": "0.3 kg", "inertia": "2e-4 kg m^2", "points": {"A": ["0 mm", "0 mm"], "B": ["100 mm", "0 mm"]}},
        "rocker": {"mass": "0.4 kg", "inertia": "3e-4 kg m^2", "points": {"O4": ["0 mm", "0 mm"], "B": ["90 mm", "0 mm"]}},
    },
    "joints": [
        {"name": "O2", "connects": ["ground.O2", "crank.O2"]},
        {"name": "A", "connects": ["crank.A", "coupler.A"]},
        {"name": "B", "connects": ["coupler.B", "rocker.B"], "model": "dry", "clearance": "0.1 mm"},
        {"name": "O4", "connects": ["ground.O4", "rocker.O4"]},
    ],
    "drive": {"joint": "O2", "speed": "300 rpm"},
    "simulate": {"turns": 6, "discard": 1},
    "outputs": [{"name": "swing", "body": "rocker", "point": "B"}],
}
LINK = {"model": "massless-link", "clearance": "0.1 mm"}


def spec_with(*changes, folder="."):
    tables = copy.deepcopy(TABLES)
    for key, value in changes:
        set_key(tables, key, value)
    return from_document(tables, LinkageSpec, folder)


def complaint(*changes, folder="."):
    with pytest.raises(SpecError) as caught:
        describe(spec_with(*changes, folder=folder))
    return caught.value.key, str(caught.value)


def test_the_plain_spec_is_fine():
    assert len(describe(spec_with()).joints) == 4


CASES = [
    ("bodies.crank.mass", "-1 kg", "bodies.crank.mass", "must be at least 0 kg, got -1 kg"),
    ("bodies.crank.mass", "1 m", "bodies.crank.mass", "wants a mass, got '1 m' (length)"),
    ("bodies.crank.points.A", ["40 mm", "0 kg"], "bodies.crank.points.A.1", "wants a length, got '0 kg' (mass)"),
    ("bodies.crank.points.A", ["40 mm"], "bodies.crank.points.A.1", "is missing"),
    ("bodies.crank.mas", "1 kg", "bodies.crank.mas", "unknown key (did you mean 'mass'?)"),
    ("bodies.crank.points.centroid", ["0 mm", "0 mm"], "bodies.crank.points.centroid", "every body already has this point"),
    ("bodies.ground", {}, "bodies.ground", "reserved for the fixed frame"),
    ("bodies.two words", {}, 'bodies."two words"', "is no name here"),
    ("bodies", {}, "bodies", "must have at least 1 entries, got 0"),
    ("bodies", 7, "bodies", "must be a table, got 7"),
    ("bodies.crank", 7, "bodies.crank", "must be a table, got 7"),
    ("bodies.crank.inertia_about", "B", "bodies.crank.inertia_about", "no point of 'crank' is called 'B'; there are: centroid, O2, A"),
    ("gravity", ["0 m/s^2", "-9.81 m/s"], "gravity.1", "wants an acceleration, got '-9.81 m/s' (velocity)"),
    ("joints.A.connects", ["crnk.A", "coupler.A"], "joints.A.connects.0", "no body is called 'crnk' (did you mean 'crank'?)"),
    ("joints.A.connects", ["crank.A", "coupler.a"], "joints.A.connects.1", "no point of 'coupler' is called 'a' (did you mean 'A'?)"),
    ("joints.A.connects", ["crank.A", "coupler"], "joints.A.connects.1", 'no point of it; write e.g. "coupler.A"'),
    ("joints.A.connects", ["crank.A", "crank.O2"], "joints.A.connects", "connects 'crank' with itself"),
    ("joints.A.connects", ["ground.O2", "ground.O4"], "joints.A.connects", "connects 'ground' with itself"),
    ("joints.A.name", "B", "joints.2.name", "two joints are called 'B'"),
    ("joints.A.name", "B.1", "joints.1.name", "'B.1' is no name here: letters, digits, _ and - only"),
    ("joints.A.kind", "revolut", "joints.1.kind", "(did you mean 'revolute'?)"),
    ("joints.A.axis", [0, 1], "joints.A.axis", "a revolute joint has no axis in the plane"),
    ("joints.A.axis", [0, 0], "joints.A.axis", "[0, 0] has no direction"),
    ("joints.B.kind", "prismatic", "joints.B.model", "a prismatic joint cannot have model 'dry'"),
    ("joints.A.kind", "gear", "joints.A.connects.0", "must be a body without a point, got 'crank.A'; write 'crank'"),
    ("joints.A.kind", "rolling", "joints.A.radius", "is missing: 'rolling' requires it (rolling: radius of the wheel)"),
    (
        "joints.A.model",
        "massless-link",
        "joints.A.clearance",
        "is missing: 'massless-link' requires it (radial clearance: bearing radius minus",
    ),
    ("joints.A.model", "bushing", "joints.A.stiffness", "is missing: 'bushing' requires it"),
    ("joints.B.restitution", 0, "joints.2.restitution", "must be greater than 0, got 0"),
    ("joints.B.restitution", 1.01, "joints.2.restitution", "must be at most 1, got 1.01"),
    ("joints.B.friction", -0.1, "joints.2.friction", "must be at least 0, got -0.1"),
    ("joints.B.friction_law", "ambrosia", "joints.2.friction_law", "did you mean 'ambrosio'"),
    ("joints.B.normal", "flores", "joints.2.normal", "did you mean 'flores-2011'"),
    ("joints.B.normal", "kelvin-voigt", "joints.B.stiffness", "requires a linear contact stiffness"),
    ("joints.B.clearance", "10 mm", "joints.B.clearance", "10 mm must be less than the bearing radius, 10 mm"),
    (
        "joints.B.link_damping",
        "0.1 N s/rad",
        "joints.2.link_damping",
        "wants a rotational damping, got '0.1 N s/rad'; write N m s/rad, a torque per angular speed",
    ),
    ("joints.B.link_damping", "0.1 N s/m", "joints.2.link_damping", "(damping); write N m s/rad"),
    ("joints.B.viscosity", "40 mm^2/s", "joints.2.viscosity", "wants a viscosity, got '40 mm^2/s' (kinematic viscosity); write Pa s"),
    ("joints.B.diametral_clearance", "0.2 mm", "joints.2.diametral_clearance", "unknown key; known here: name, kind, "),
    ("drive.joint", "o4", "drive.joint", "no joint is called 'o4' (did you mean 'O4'?); there are: O2, A, B, O4"),
    ("drive.speed", "0 rpm", "drive.speed", "must not be 0"),
    ("drive.speed", "5 1/s", "drive.speed", "a frequency counts events"),
    ("drive", {"joint": "O2"}, "drive.speed", "give exactly one of speed, profile and motor, got none"),
    ("simulate.discard", 6, "simulate.discard", "6 turns must be fewer than those of the run, 6"),
    ("simulate", {}, "simulate.turns", 'is missing: give turns, or duration = "0.5 s"'),
    ("outputs.0.body", "rockre", "outputs.swing.body", "no body is called 'rockre' (did you mean 'rocker'?)"),
    ("outputs.0.point", "A", "outputs.swing.point", "no point of 'rocker' is called 'A'"),
    ("outputs.0.name", "a.b", "outputs.0.name", "is no name here"),
    ("poincare", {"output": "swnig"}, "poincare.output", "no output is called 'swnig' (did you mean 'swing'?)"),
    ("wear", {"joint": "X", "cycles": 10}, "wear.joint", "no joint is called 'X'"),
    ("springs", [{"connects": ["rocker.B", "ground.C"]}], "springs.0.connects.1", "no point of 'ground' is called 'C'"),
    ("springs", [{"connects": ["rocker.B", "ground.O2"], "stiffness": "1 N m/rad"}], "springs.0.stiffness", "wants a stiffness"),
    ("torques", [{"body": "rocker", "on": "rocker", "torque": "1 N m"}], "torques.0.on", "body and reaction body are both 'rocker'"),
    ("torques", [{"body": "rocker", "name": "load"}], "torques.load.torque", "give torque or file, exactly one of them"),
    ("torques", [{"body": "ground", "torque": "1 N m"}], "torques.0.body", "no body is called 'ground'"),
    ("forces", [{"body": "rocker", "point": "C", "force": ["1 N", "0 N"]}], "forces.0.point", "no point of 'rocker' is called 'C'"),
    ("rotational_springs", [{"body": "rocker", "damping": "0.1 N s/rad"}], "rotational_springs.0.damping", "write N m s/rad"),
    ("tolerances", {"dimensions": [{"at": "rocker.C", "tolerance": "1 um"}]}, "tolerances.dimensions.0.at", "no point of 'rocker'"),
]


@pytest.mark.parametrize(("change", "value", "key", "words"), CASES)
def test_nonsense_is_refused_by_key(change, value, key, words):
    where, message = complaint((change, value))
    assert where == key and words in message and message.startswith(key)


def test_a_pivot_inertia_below_the_mass_s_own_share_is_refused():
    given = [("bodies.rocker.centroid", ["45 mm", "0 mm"]), ("bodies.rocker.inertia_about", "O4")]
    key, message = complaint(*given, ("bodies.rocker.inertia", "8e-4 kg m^2"))
    assert key == "bodies.rocker.inertia" and "m d^2 = 0.4 kg x (45 mm)^2 = 0.00081 kg·m²" in message
    assert "leave inertia_about out" in message
    assert spec_with(*given, ("bodies.rocker.inertia", "8.1e-4 kg m^2"))  # all mass in the centroid


def test_a_link_of_zero_length_is_refused_and_a_block_on_a_slide_is_not():
    key, message = complaint(("bodies.coupler.points.B", ["0 mm", "0 mm"]))
    assert key == "bodies.coupler.points" and "joints 'A' and 'B' are at the same point, so this link has zero length" in message
    assert spec_with(("bodies.coupler.points.B", ["0 mm", "0 mm"]), ("joints.A.kind", "prismatic"))


def test_a_massless_body_between_two_massless_links_is_refused_with_the_reason():
    bare = [("bodies.coupler.mass", "0 kg"), ("bodies.coupler.inertia", "0 kg m^2")]
    links = [(f"joints.{joint}.{key}", value) for joint in "AB" for key, value in LINK.items()]
    key, message = complaint(*bare, *links)
    assert key == "bodies.coupler.mass" and "'A' and 'B': two clearances in series" in message and "are singular" in message
    for cure in (
        ("bodies.coupler.mass", "1 g"),
        ("bodies.coupler.inertia", "1e-9 kg m^2"),
        ("joints.A.model", "ideal"),
        ("joints.A.clearance", "0 mm"),
    ):
        assert spec_with(*bare, *links, cure)


def test_turns_want_a_constant_speed(tmp_path):
    (tmp_path / "motor.csv").write_text("speed [rpm],torque [N m]\n0,5\n3000,0\n")
    motor = ("drive", {"joint": "O2", "motor": "motor.csv"})
    key, message = complaint(motor, folder=tmp_path)
    assert key == "simulate.turns" and "requires a drive at constant speed" in message and "give duration instead" in message
    key, message = complaint(motor, ("simulate", {"duration": "1 s", "discard": 1}), folder=tmp_path)
    assert key == "simulate.discard" and "leave it out" in message
    timed = ("simulate", {"duration": "1 s"})
    assert spec_with(motor, timed, folder=tmp_path).period is None
    for study, table in {"poincare": {"output": "swing"}, "lyapunov": {}, "wear": {"joint": "B", "cycles": 5}}.items():
        assert complaint(motor, timed, (study, table), folder=tmp_path)[0] == study


def test_speed_and_motor_together_or_on_a_slide_are_refused(tmp_path):
    (tmp_path / "motor.csv").write_text("speed [rpm],torque [N m]\n0,5\n3000,0\n")
    key, message = complaint(("drive.motor", "motor.csv"), folder=tmp_path)
    assert key == "drive.speed" and "got speed and motor" in message
    key, message = complaint(("joints.O2.kind", "prismatic"))
    assert key == "drive.speed" and "give a profile of its travel" in message
    key, message = complaint(("joints.O2.kind", "pin-slot"))
    assert key == "drive.speed" and "is a pin-slot joint: give a profile" in message
    key, message = complaint(("joints.O2.kind", "rolling"), ("joints.O2.radius", "30 mm"))
    assert key == "drive.joint" and "is a rolling joint" in message


def test_the_ramp_of_ambrosio_must_rise():
    ramp = [("joints.B.friction_law", "ambrosio"), ("joints.B.friction", 0.1), ("joints.B.friction_speed", "1 mm/s")]
    key, message = complaint(*ramp, ("joints.B.friction_dead_speed", "1 mm/s"))
    assert key == "joints.B.friction_dead_speed" and "0.001 m/s" in message
    assert spec_with(*ramp, ("joints.B.friction_dead_speed", "0.9 mm/s"))


def test_a_kelvin_voigt_restitution_needs_masses():
    linear = [("joints.B.normal", "kelvin-voigt"), ("joints.B.stiffness", "1e7 N/m")]
    key, message = complaint(*linear, ("bodies.coupler.mass", "0 kg"))
    assert key == "joints.B.damping" and "'coupler' has no mass" in message
    assert describe(spec_with(*linear, ("bodies.coupler.mass", "0 kg"), ("joints.B.damping", "5 N s/m")))


SWEEP = {"over": "joints.B.clearance", "start": "0.01 mm", "stop": "0.5 mm", "output": "swing"}


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ({"over": "joints.C.clearance"}, "bifurcation.over", "no joint is called 'C'"),
        ({"over": "bodies.crnk.mass"}, "bifurcation.over", "no body is called 'crnk' (did you mean 'crank'?)"),
        ({"over": "joints.B.clerance"}, "bifurcation.over", "is not a key of this spec"),
        ({"turns": 200}, "bifurcation.discard", "200 turns must be fewer than those of a run, 200"),
        ({"steps": 1}, "bifurcation.steps", "must be at least 2"),
        ({"output": "swnig"}, "bifurcation.output", "did you mean 'swing'"),
    ],
)
def test_a_bifurcation_of_nothing_is_refused(change, key, words):
    assert spec_with(("bifurcation", SWEEP))
    where, message = complaint(("bifurcation", SWEEP | change))
    assert where == key and words in message


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("time [s],force [N]\n0,1\n1,2\n", "no column 'torque [N m]' in the first line 'time [s],force [N]'"),
        ("phase [s],torque [N m]\n0,1\n1,2\n", "no column 'time [s]' or 'angle [deg]' or 'speed [rpm]'"),
        ("time [s],torque [N]\n0,1\n1,2\n", "column 'torque': wants a torque, got 'N' (force)"),
        ("time,torque [N m]\n0,1\n1,2\n", "column 'time': "),
        ("time [s],torque [N m]\n0,1\n1,x\n", "line 3: the torque is 'x', not a number"),
        ("time [s],torque [N m]\n0,1\n1\n", "line 3: the torque is missing"),
        ("time [s],torque [N m]\n0,1\n0,2\n", "row 2 (line 3): the time must increase"),
        ("time [s],torque [N m]\n0,1\n", "1 rows are too few"),
        ("", "is empty"),
    ],
)
def test_a_bad_load_table_is_refused_with_its_place(tmp_path, content, words):
    (tmp_path / "load.csv").write_text(content)
    _, message = complaint(("torques", [{"body": "rocker", "file": "load.csv"}]), folder=tmp_path)
    assert words in message and "load.csv" in message


def test_a_bad_profile_is_refused(tmp_path):
    profile = ("drive", {"joint": "O2", "profile": "p.csv"}), ("simulate", {"duration": "1 s"})
    (tmp_path / "p.csv").write_text("time [s],travel [mm]\n0,1\n1,2\n")
    assert "no column 'angle [deg]'" in complaint(*profile, folder=tmp_path)[1]
    (tmp_path / "p.csv").write_text("time [s],angle [deg]\n0,1\n1,2\n")
    assert "degree 3 needs at least 4 points, got 2" in complaint(*profile, folder=tmp_path)[1]


def test_a_lift_must_run_over_a_turn(tmp_path):
    cam = [("joints.A.kind", "cam"), ("joints.A.connects", ["crank", "coupler.A"]), ("joints.A.lift", "lift.csv")]
    rows = "".join(f"{angle},{angle * (180 - angle) / 1000}\n" for angle in range(0, 181, 20))
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n" + rows)
    assert "the angle covers 180°; give the cam's lift over 360°" in complaint(*cam, folder=tmp_path)[1]
