"""ROSS' answer for turning rotors: run as a script, JSON in, JSON in the last line out (its import prints too).

In: {"rotors": [...] as in rotors.py, with "places" of the nodes}; out: for each rotor `frequency` [rad/s], `log_decrement` and `whirl` of
its lateral and other modes at its speed, and `amplitude` (speeds, discs): major semi-axes of the response to its unbalance; `seconds` of a
Campbell diagram of 50 speeds.
"""

import json
import sys
import time

import numpy as np


def rotor(ross, case):
    steel = ross.Material(name="shaft", rho=case["density"], E=case["modulus"], Poisson=0.3)
    nodes, ends = np.array(case["places"]), np.concatenate([[0.0], np.cumsum([section[0] for section in case["sections"]])])
    shear, parts = case["theory"] == "timoshenko", []
    for start, end in zip(nodes[:-1], nodes[1:], strict=True):
        _, outer, bore = case["sections"][np.searchsorted(ends, 0.5 * (start + end)) - 1]
        parts.append(ross.ShaftElement(L=end - start, idl=bore, odl=outer, material=steel, shear_effects=shear, rotary_inertia=True))
    discs = [ross.DiskElement(n=node(nodes, place), m=m, Ip=polar, Id=diametral) for place, m, polar, diametral in case["discs"]]
    bearings = []
    for place, ((kxx, kxy), (kyx, kyy)), ((cxx, cxy), (cyx, cyy)) in case["bearings"]:
        stiff = {"kxx": kxx, "kxy": kxy, "kyx": kyx, "kyy": kyy}
        bearings.append(ross.BearingElement(n=node(nodes, place), **stiff, cxx=cxx, cxy=cxy, cyx=cyx, cyy=cyy))
    return nodes, ross.Rotor(parts, discs, bearings)


def node(nodes, place):
    return int(np.argmin(np.abs(nodes - place)))


def answer(ross, case):
    nodes, model = rotor(ross, case)
    modal = model.run_modal(case["speed"], num_modes=16)
    place, moment = case["unbalance"]
    found = model.run_unbalance_response(
        node=node(nodes, place), unbalance_magnitude=moment, unbalance_phase=0.0, frequency=np.array(case["speeds"])
    )
    at = model.number_dof * np.array([node(nodes, disc[0]) for disc in case["discs"]])
    x, y = found.forced_resp[at], found.forced_resp[at + 1]
    return {
        "frequency": modal.wd.tolist(),
        "log_decrement": modal.log_dec.tolist(),
        "whirl": modal.whirl_direction().tolist(),
        "amplitude": (0.5 * (np.abs(x + 1j * y) + np.abs(x - 1j * y))).T.tolist(),
    }


def seconds(ross, case):
    model, started = rotor(ross, case)[1], time.perf_counter()
    model.run_campbell(np.linspace(0.0, case["speed"], 50), frequencies=8)
    return time.perf_counter() - started


if __name__ == "__main__":
    import ross

    asked = json.load(sys.stdin)
    answers = [answer(ross, case) for case in asked["rotors"]]
    if asked.get("campbell"):
        answers[0]["seconds"] = seconds(ross, asked["rotors"][0])
    print("\n" + json.dumps(answers))
