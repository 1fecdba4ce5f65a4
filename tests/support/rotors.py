"""Rotors of the literature and of our own making as plain data, for our own code and for ROSS.

Each: sections [length, outer diameter, bore], discs [place, mass, polar, diametral], bearings [place, ((kxx, kxy), (kyx, kyy)),
((cxx, cxy), (cyx, cyy))], modulus, density, theory ("timoshenko" or "rayleigh"), speed [rad/s] of whirl and speeds of the response to an
unbalance [place, kg m].  All SI.
"""

import numpy as np

from drivewright import shafts

RPM = np.pi / 30
STEEL = {"modulus": 211e9, "density": 7810.0, "theory": "timoshenko"}
RESPONSE = (50.0, 4000 * RPM, 700.0)


def disc(place, outer, inner, width, density):
    """A disc by its geometry [m]."""
    mass = density * np.pi / 4 * (outer**2 - inner**2) * width
    return [place, mass, mass / 8 * (outer**2 + inner**2), mass / 16 * (outer**2 + inner**2) + mass / 12 * width**2]


def two_discs(stiffness, damping):
    """Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines 2010, example 5.9.1, as ROSS' documentation has it."""
    bearings = [[place, stiffness, damping] for place in (0.0, 1.5)]
    discs = [disc(place, outer, 0.05, 0.07, 7810.0) for place, outer in ((0.5, 0.28), (1.0, 0.35))]
    return STEEL | {
        "sections": [[1.5, 0.05, 0.0]],
        "discs": discs,
        "bearings": bearings,
        "speed": 4000 * RPM,
        "unbalance": [0.5, 1e-3],
        "speeds": RESPONSE,
    }


def matrix(xx, yy=None, cross=0.0):
    """((xx, cross), (-cross, yy))."""
    return ((xx, cross), (-cross, xx if yy is None else yy))


NELSON_PLACES = 1e-2 * np.array(
    [0, 1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67, 28.70, 30.48, 31.50, 34.54, 35.81]
)
NELSON_OUTER = 2e-2 * np.array([0.51, 1.02, 0.76, 2.03, 2.03, 3.3, 3.3, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27, 3.81, 2.03, 2.03])
NELSON_INNER = 2e-2 * np.array([0, 0, 0, 0, 0, 0, 1.52, 1.78, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.52])


def nelson_mcvaugh(stiffness=((4.378e7, 0.0), (0.0, 4.378e7))):
    """Nelson & McVaugh, The dynamics of rotor-bearing systems using finite elements, 1976, second hand: data of a public repository of
    rotor-dynamics exercises; Rayleigh's beam."""
    return {
        "modulus": 2.078e11,
        "density": 7806.0,
        "theory": "rayleigh",
        "sections": np.stack([np.diff(NELSON_PLACES), NELSON_OUTER, NELSON_INNER], axis=1).tolist(),
        "discs": [[NELSON_PLACES[4], 1.401, 0.00203, 0.00136]],
        "bearings": [[NELSON_PLACES[n], stiffness, matrix(0.0)] for n in (10, 14)],
        "speed": 70000 * RPM,
        "unbalance": [NELSON_PLACES[4], 1.401 * 0.635e-3],
        "speeds": (2000.0, 5000.0),
    }


def lalanne_ferraris():
    """Lalanne & Ferraris, Rotordynamics Prediction in Engineering, the rotor with three discs (recalled)."""
    discs = [(0.2, 0.24, 0.05), (0.5, 0.40, 0.05), (1.0, 0.40, 0.06)]
    return {
        "modulus": 2e11,
        "density": 7800.0,
        "theory": "timoshenko",
        "sections": [[1.3, 0.1, 0.0]],
        "discs": [disc(place, outer, 0.1, width, 7800.0) for place, outer, width in discs],
        "bearings": [[place, matrix(5e7, 7e7), matrix(5e2, 7e2)] for place in (0.0, 1.3)],
        "speed": 25000 * RPM,
        "unbalance": [0.5, 200e-6],
        "speeds": (300.0, 1000.0),
    }


CASES = {
    "isotropic": two_discs(matrix(1e6), matrix(0.0)),
    "anisotropic": two_discs(matrix(1e6, 0.8e6), matrix(100.0, 80.0)),
    "cross-coupled": two_discs(matrix(1e6, cross=2e5), matrix(100.0, cross=30.0)),
    "skewed": two_discs(((1e6, 3e5), (1e5, 0.8e6)), ((200.0, 40.0), (10.0, 100.0))),
    "nelson-mcvaugh": nelson_mcvaugh(),
    "nelson-mcvaugh-orthotropic": nelson_mcvaugh(((3.503e7, -0.8756e7), (-0.8756e7, 3.503e7))),
    "lalanne-ferraris": lalanne_ferraris(),
}


def our_shaft(case):
    """The `shafts.Shaft` of a case."""
    supports = []
    for number, (place, stiffness, damping) in enumerate(case["bearings"]):
        (xx, xy), (yx, yy) = stiffness
        support = shafts.spring_support(f"bearing {number}", place, (xx, yy), cross=(xy, yx), damping=damping)
        supports.append(support)
    stations = tuple(shafts.Station(f"disc {n}", place, *inertia) for n, (place, *inertia) in enumerate(case["discs"]))
    sections = tuple(shafts.Section(length, outer, outer, bore) for length, outer, bore in case["sections"])
    shear = shafts.COWPER if case["theory"] == "timoshenko" else shafts.EULER_BERNOULLI
    return shafts.Shaft(sections, case["modulus"], 0.3, case["density"], tuple(supports), stations, shear, True)


def our_rotor(case, elements=60, kept=12, places=None):
    """(equilibrium, `shafts.Rotor`) of a case; exact under slow forces at its unbalance unless `places` says where."""
    shaft = our_shaft(case)
    at_rest = shafts.refined_equilibrium(shafts.apply_loads(shaft, shafts.ShaftLoads()).equilibrium, shaft.length / elements)
    return at_rest, shafts.reduced_rotor(at_rest, [case["unbalance"][0]] if places is None else places, kept)


__all__ = ["CASES", "RPM", "disc", "matrix", "our_rotor", "our_shaft", "two_discs"]
