"""Large shafts as specs, written as TOML: many springs, many rolling bearings, many segments.

`python benchmarks/shaft_specs.py FOLDER` writes one file each.
"""

import sys
from pathlib import Path

PITCH = 100.0  # mm, from bearing to bearing
SPRING = 'radial_stiffness = "5e7 N/m"'
ROLLING = 'bearing = "61804"'


def large_shaft(bearings: int, segments: int, support: str, stations: int) -> str:
    """The text of a spec: a stepped shaft with bearings at even distances, loads at stations midway between two of them.

    support: the keys that say what each bearing is; the first bearing holds the shaft along its axis.
    """
    length = PITCH * bearings
    lines = ["format = 1", 'mechanism = "shaft"', 'material = { youngs_modulus = "206 GPa", density = "7850 kg/m^3" }']
    for number in range(segments):
        lines.append(f'[[segments]]\nlength = "{length / segments} mm"\ndiameter = "{(20, 22, 25, 21)[number % 4]} mm"')
    for number in range(bearings):
        lines.append(f'[[bearings]]\nname = "B{number}"\nposition = "{PITCH * (number + 0.45)} mm"\n{support}')
    for number in range(stations):
        place = PITCH * (0.9 + number * bearings // stations)
        lines.append(f'[[stations]]\nname = "p{number}"\nposition = "{place} mm"\nmass = "1 kg"')
        lines.append(f'[[loads]]\nstation = "p{number}"\nforce = "{300 + 100 * number} N"\nangle = "{-90 + 20 * number} deg"')
    return "\n".join(lines) + "\n"


SPECS = {  # text, seconds wanted for a run
    "20 springs, 20 segments, 20 stations": (large_shaft(20, 20, SPRING, 20), 1.0),
    "20 ball bearings, 20 segments, 20 stations": (large_shaft(20, 20, ROLLING, 20), 1.0),
    "40 ball bearings, 40 segments, 40 stations": (large_shaft(40, 40, ROLLING, 40), 10.0),
    "4 springs, 300 segments, 3 stations": (large_shaft(4, 300, SPRING, 3), 5.0),
}


if __name__ == "__main__":
    for title, (text, _) in SPECS.items():
        Path(sys.argv[1], f"{title.replace(', ', '_').replace(' ', '_')}.toml").write_text(text, encoding="utf-8")
