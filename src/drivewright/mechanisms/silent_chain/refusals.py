"""What has no meaning, refused by name; what can be computed is left to the checks."""

from drivewright.errors import SpecError

LEAST_TEETH = 6  # below, a polygon is no sprocket


def refuse_nonsense(spec):
    """SpecError for the first thing that has no meaning."""
    for number, teeth in enumerate(spec.teeth):
        if teeth < LEAST_TEETH:
            raise SpecError(f"{teeth} teeth are too few for a sprocket; take {LEAST_TEETH} or more", f"teeth.{number}")
    if spec.links <= max(spec.teeth):
        raise SpecError(
            f"{spec.links} links are no more than the {max(spec.teeth)} teeth of a sprocket: the chain does not reach around two; "
            f"take {max(spec.teeth) + 4} or more",
            "links",
        )
    for table in ("guides", "sprockets"):
        names = [entry.name for entry in getattr(spec, table)]
        for name in names:
            if names.count(name) > 1:
                raise SpecError(f"the name {name!r} comes twice; names in {table} must differ", f"{table}.{name}.name")
    if min(spec.plate.lacing) < 1:
        raise SpecError(f"lacing {list(spec.plate.lacing)} has a pitch without a plate; count one or more in each", "plate.lacing")


def refuse_contradictions(spec):
    """SpecError for the first two keys that contradict each other, or one that lacks another."""
    joint, plate = spec.joint, spec.plate
    if joint.kind != "revolute" and joint.rolling_radius is None:
        raise SpecError('a rolling joint needs its radius: give rolling_radius, or take kind = "revolute"', "joint.rolling_radius")
    for guide in spec.guides:
        if (guide.force is None) != (guide.direction is None):
            raise SpecError(
                "a tensioner needs both force and direction; give both, or neither for a fixed rail", f"guides.{guide.name}.force"
            )
    if spec.roller is not None:
        if joint.kind != "revolute":
            raise SpecError(
                f'rollers turn on one pin, but kind is {joint.kind!r}; take kind = "revolute", or leave [roller] out', "joint.kind"
            )
        if spec.roller.diameter >= spec.pitch:
            raise SpecError("rollers as large as the pitch overlap; take a smaller one", "roller.diameter")
        return
    if (plate.apothem is None) == (plate.standard_apothem is None):
        how = "neither is" if plate.apothem is None else "both are"
        raise SpecError(f"give one of apothem (from the hole) and standard_apothem (from the pitch line); {how} given", "plate.apothem")


def unused(spec):
    """Findings for keys that have no effect here."""
    for guide in spec.guides:
        if guide.force is None and {"stiffness", "damping"} & guide.model_fields_set:
            yield f"guides.{guide.name}: stiffness and damping have no effect on a rail that does not move; give force and direction"
    if spec.roller:
        given = [key for key in ("apothem", "standard_apothem", "flank_angle") if key in spec.plate.model_fields_set]
        if given:
            yield f"plate.{', plate.'.join(given)} {'has' if len(given) == 1 else 'have'} no effect: rollers mesh, not plates"
    if spec.joint.kind == "revolute" and spec.joint.rolling_radius is not None:
        yield "joint.rolling_radius has no effect: a revolute joint does not roll"
    if spec.joint.kind != "revolute" and spec.joint.pin_diameter is not None:
        yield "joint.pin_diameter has no effect: the pins of a rolling joint have its rolling_radius"
