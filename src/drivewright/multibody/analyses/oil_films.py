"""Oil films of pins: accuracy of their closed form."""

import numpy as np

from drivewright.labels import in_words
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel
from drivewright.multibody.forces.contact import Lubricated
from drivewright.result import Answer, Value


def oil_films(model: SimulationModel) -> Answer:
    """How far the closed form of each film is from Reynolds' equation for the bearing's real length."""
    from drivewright.contact import closed_form_map, film_deviation, film_map, long_bearing, short_bearing

    values, findings = {}, []
    eccentricities, directions = np.array([0.2, 0.5, 0.8]), np.linspace(0.0, 0.5 * TURN, 7)[:-1]
    for joint in model.assembly.model.joints:
        oil = joint.play
        if isinstance(oil, Lubricated):
            slenderness = oil.contact.length / (2 * oil.contact.bearing_radius)
            if oil.film == "reynolds":
                continue
            form = long_bearing if oil.film == "long" else short_bearing
            solved = film_map(slenderness, eccentricities, directions)
            off = film_deviation(closed_form_map(form, slenderness, eccentricities, directions), solved)
            meaning = f"median relative deviation of the {oil.film}-bearing solution from Reynolds' equation, joint {in_words(joint.name)}"
            values[f"joints.{joint.name}.film_error"] = Value(
                float(np.median(off)), "-", meaning, label=f"oil film model error, joint {in_words(joint.name)}"
            )
            findings.append(
                f'joint {joint.name!r}: film = "{oil.film}" deviates from Reynolds\' equation for length/diameter = {slenderness:.3g} by '
                f'{np.median(off):.0%} in the median and by {off.max():.0%} at most; film = "reynolds" avoids this error'
            )
    return Answer(values, findings=tuple(findings))
