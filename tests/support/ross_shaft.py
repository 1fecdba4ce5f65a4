"""ROSS' answer for shafts on linear bearings: run as a script, JSON in, JSON in the last line out (its import prints too).

In: {"shafts": [{"sections": [[length, diameter, bore], ...], "supports", "stiffness", "stations", "modulus", "poisson", "timoshenko",
"mass"}, ...], "repeat": how often each flexibility is computed}; out: for each shaft its `flexibility` at the stations from the inverse
of the assembled stiffness matrix, the deflections at stations and supports that ROSS' own `run_static` gives for a disc of `mass` at the
first station, `gravity` of that, and `seconds` per flexibility.
"""

import json
import sys
import time

import numpy as np


def elements(ross, shaft):
    """(places of the nodes, shaft elements): nodes at every feature, and no others."""
    ends = np.concatenate([[0.0], np.cumsum([section[0] for section in shaft["sections"]])])
    nodes = np.unique(np.round(np.concatenate([ends, shaft["supports"], shaft["stations"]]), 12))
    steel = ross.Material(name="shaft", rho=1e-6, E=shaft["modulus"], Poisson=shaft["poisson"])  # next to no weight
    parts = []
    for start, end in zip(nodes[:-1], nodes[1:], strict=True):
        _, diameter, bore = shaft["sections"][np.searchsorted(ends, 0.5 * (start + end)) - 1]
        parts.append(ross.ShaftElement(L=end - start, idl=bore, odl=diameter, material=steel, shear_effects=shaft["timoshenko"]))
    return nodes, parts


def numbers(nodes, places):
    return [int(np.argmin(np.abs(nodes - place))) for place in places]


def rotor(ross, shaft, discs=()):
    nodes, parts = elements(ross, shaft)
    bearings = [ross.BearingElement(n=n, kxx=k, cxx=0) for n, k in zip(numbers(nodes, shaft["supports"]), shaft["stiffness"], strict=True)]
    return nodes, ross.Rotor(parts, [ross.DiskElement(n=n, m=m, Id=0, Ip=0) for n, m in discs], bearings)


def flexibility(ross, shaft):
    """From y and the rotation about x alone: six displacements a node, of which axial and torsional ones float."""
    nodes, model = rotor(ross, shaft)
    plane = np.sort(np.concatenate([np.arange(1, 6 * len(nodes), 6), np.arange(3, 6 * len(nodes), 6)]))
    at = 2 * np.array(numbers(nodes, shaft["stations"]))
    return np.linalg.inv(model.K(0)[np.ix_(plane, plane)])[np.ix_(at, at)]


def static(ross, shaft):
    nodes, _ = elements(ross, shaft)
    nodes, model = rotor(ross, shaft, [(numbers(nodes, shaft["stations"])[0], shaft["mass"])])
    deformation = np.asarray(model.run_static().deformation)
    return [deformation[numbers(nodes, shaft[places])].tolist() for places in ("stations", "supports")]


def answer(ross, shaft, repeat):
    started = time.perf_counter()
    for _ in range(repeat):
        delta = flexibility(ross, shaft)
    seconds = (time.perf_counter() - started) / repeat
    at_stations, at_supports = static(ross, shaft)
    return {"flexibility": delta.tolist(), "stations": at_stations, "supports": at_supports, "gravity": 9.8065, "seconds": seconds}


if __name__ == "__main__":
    import ross

    asked = json.load(sys.stdin)
    print("\n" + json.dumps([answer(ross, shaft, asked["repeat"]) for shaft in asked["shafts"]]))
