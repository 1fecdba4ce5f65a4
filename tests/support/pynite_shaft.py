"""PyNite's answer for shafts on linear bearings: a plane frame with a node at every feature, Euler-Bernoulli elements, springs."""

import numpy as np


def flexibility(shaft):
    """At the stations, from the deflections under a unit force at each; `shaft` as in ross_shaft.py."""
    from Pynite import FEModel3D

    modulus, poisson = shaft["modulus"], shaft["poisson"]
    ends = np.concatenate([[0.0], np.cumsum([section[0] for section in shaft["sections"]])])
    nodes = np.unique(np.round(np.concatenate([ends, shaft["supports"], shaft["stations"]]), 12))
    model = FEModel3D()
    model.add_material("steel", modulus, modulus / (2 + 2 * poisson), poisson, 0.0)
    for n, (_, diameter, bore) in enumerate(shaft["sections"]):
        second = np.pi / 64 * (diameter**4 - bore**4)
        model.add_section(f"s{n}", np.pi / 4 * (diameter**2 - bore**2), second, second, 2 * second)
    for n, x in enumerate(nodes):
        model.add_node(f"n{n}", x, 0.0, 0.0)
        # Only deflection and slope in the plane are free.
        model.def_support(f"n{n}", support_DX=True, support_DZ=True, support_RX=True, support_RY=True)
    for n, middle in enumerate(0.5 * (nodes[:-1] + nodes[1:])):
        model.add_member(f"m{n}", f"n{n}", f"n{n + 1}", "steel", f"s{np.searchsorted(ends, middle) - 1}")
    supports, stations = ([f"n{np.argmin(np.abs(nodes - x))}" for x in shaft[kind]] for kind in ("supports", "stations"))
    for place, stiffness in zip(supports, shaft["stiffness"], strict=True):
        model.def_support_spring(place, "DY", stiffness)
    for number, place in enumerate(stations):
        model.add_node_load(place, "FY", 1.0, case=f"c{number}")
        model.add_load_combo(f"at{number}", {f"c{number}": 1.0})
    model.analyze_linear()
    return np.array([[model.nodes[place].DY[f"at{number}"] for number in range(len(stations))] for place in stations])
