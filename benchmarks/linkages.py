"""Linkages with play: work against precision beside Exudyn and SciPy, the impact load table, a bifurcation diagram."""

import time

import numpy as np

TURN = 2 * np.pi
SPEED, CRANK, ROD, HALF, ROD_MASS, ROD_INERTIA, SLIDER_MASS = 5000 / 60 * TURN, 0.05, 0.12, 0.06, 0.21, 2.5e-4, 0.14
BEARING, LOSS = 0.01, 0.15  # bearing radius [m]; h of F = K d^1.5 (1 + h d'/d0'), which Exudyn has as Hunt and Crossley's e = 0.9
OFFSET = -1e-4  # of the slider at the start: Exudyn's contact cannot start centred
PERIOD = TURN / SPEED
APART = 1e-13  # [m]


def slider_crank(clearance=0.5e-3):
    """The Model of the field's common slider-crank with a dry wrist pin."""
    from drivewright import contact
    from drivewright import multibody as mb

    modulus = contact.effective_modulus(207e9, 0.3, 207e9, 0.3)
    dry = mb.Dry(clearance, BEARING, float(contact.journal_stiffness(BEARING, BEARING - clearance, modulus)), 1.5, LOSS)
    bodies = (
        mb.Body("crank", 0.3, 1e-4, (CRANK / 2, 0.0)),
        mb.Body("rod", ROD_MASS, ROD_INERTIA, (HALF, 0.0)),
        mb.Body("slider", SLIDER_MASS, 1e-4),
    )
    joints = (
        mb.Revolute("main", mb.Marker("ground"), mb.Marker("crank")),
        mb.Revolute("crank_pin", mb.Marker("crank", CRANK), mb.Marker("rod")),
        mb.Revolute("wrist", mb.Marker("rod", ROD), mb.Marker("slider"), dry),
        mb.Prismatic("guide", mb.Marker("slider"), mb.Marker("ground")),
    )
    return mb.MultibodyModel(bodies, joints, drives=(mb.JointDrive("main", mb.line(0.0, SPEED)),))


def started(model):
    """(assembly, state) with the slider off the centre of its play."""
    from drivewright import multibody as mb

    assembly = mb.assemble(model)
    state = assembly.state
    slide = assembly.tree.link("slider").slide
    state[list(assembly.system.stored).index(slide)] += OFFSET
    return assembly, state


def ours(rtol, turns):
    """(slider position at the end, seconds, steps)."""
    from drivewright import multibody as mb

    assembly, state = started(slider_crank())
    began = time.perf_counter()
    run = mb.simulate(assembly, turns * PERIOD, mb.Settings(rtol), samples=np.empty(0), state=state)
    seconds = time.perf_counter() - began
    slide = list(assembly.system.stored).index(assembly.tree.link("slider").slide)
    return run.end[2][slide], seconds, run.steps


def scipys(method, rtol, turns):
    """The same for a method of SciPy on equations written for this mechanism alone, compiled, stopped at every touch and release."""
    from scipy.integrate import solve_ivp

    right_side, gap = _by_hand(slider_crank().joints[2].model)
    state, t, memory, steps = np.array([CRANK + ROD + OFFSET, 0.0, 0.0, -SPEED * CRANK / ROD]), 0.0, 0.0, 0
    began = time.perf_counter()
    while t < turns * PERIOD:

        def event(t, y, memory):
            return gap(t, y)[0] + (APART if memory > 0.0 else -APART)  # lest SciPy meets the same event again at once

        event.terminal, event.direction = True, 1.0 if memory == 0.0 else -1.0
        run = solve_ivp(right_side, (t, turns * PERIOD), state, method, events=event, rtol=rtol, atol=1e-3 * rtol, args=(memory,))
        steps, t, state = steps + len(run.t), run.t[-1], run.y[:, -1]
        if run.status == 1:
            memory = max(gap(t, state)[1], 1e-4) if memory == 0.0 else 0.0
    return state[0], time.perf_counter() - began, steps


def _by_hand(dry):
    """(rates(t, y, memory), gap(t, y) -> depth and its rate) of y = slider, rod angle and their rates."""
    from drivewright._jit import kernel

    stiffness, loss, clearance = dry.stiffness, dry.hysteresis, dry.clearance

    @kernel
    def gap(t, y):
        c, s, cr, sr = np.cos(SPEED * t), np.sin(SPEED * t), np.cos(y[1]), np.sin(y[1])
        ex, ey = CRANK * c + ROD * cr - y[0], CRANK * s + ROD * sr
        vx, vy = -CRANK * SPEED * s - ROD * sr * y[3] - y[2], CRANK * SPEED * c + ROD * cr * y[3]
        distance = np.hypot(ex, ey)
        return distance - clearance, (ex * vx + ey * vy) / distance, ex / distance, ey / distance

    @kernel
    def rates(t, y, memory):
        depth, rate, nx, ny = gap(t, y)
        force = max(stiffness * depth * np.sqrt(depth) * (1 + loss * rate / memory), 0.0) if memory > 0.0 and depth > 0.0 else 0.0
        cr, sr, square = np.cos(y[1]), np.sin(y[1]), SPEED * SPEED * CRANK
        ax, ay = -square * np.cos(SPEED * t), -square * np.sin(SPEED * t)
        turning = -ROD * force * (cr * ny - sr * nx) - ROD_MASS * HALF * (cr * ay - sr * ax)
        return np.array([y[2], y[3], force * nx / SLIDER_MASS, turning / (ROD_INERTIA + ROD_MASS * HALF * HALF)])

    return rates, gap


def exudyns(step, turns):
    """The same for Exudyn's hollow contact, trapezoidal rule."""
    from drivewright.multibody import observe
    from drivewright.oracles.linkage import exudyn_model

    assembly, state = started(slider_crank())
    seen = observe(assembly.system, [0.0], state[None]).bodies[0]
    start = {name: tuple(seen[k, :6]) for k, name in enumerate(assembly.names) if k}
    began = time.perf_counter()
    run = exudyn_model.run(slider_crank(), start, turns * PERIOD, step, samples=2)
    return run.bodies["slider"][-1, 0], time.perf_counter() - began, round(turns * PERIOD / step)


def work_precision():
    """Time per turn, and error of the slider after a fifth of a turn, three impacts, before chaos takes over."""
    exact = ours(1e-12, 0.2)[0]
    rows = [(f"ours, rtol {rtol:g}", lambda turns, rtol=rtol: ours(rtol, turns)) for rtol in (1e-6, 1e-8, 1e-10)]
    rows += [
        (f"SciPy {method}, rtol {rtol:g}", lambda turns, method=method, rtol=rtol: scipys(method, rtol, turns))
        for rtol in (1e-6, 1e-8)
        for method in ("LSODA", "DOP853", "RK45")
    ]
    try:
        import exudyn  # noqa: F401

        rows += [(f"Exudyn, step {step:g} s", lambda turns, step=step: exudyns(step, turns)) for step in (1e-6, 2e-7)]
    except ImportError:
        pass
    for name, run in rows:
        run(0.2)
        error = abs(run(0.2)[0] - exact)
        turns = 20 if name.startswith("ours") else 1
        seconds = min(run(turns)[1] for _ in range(3 if turns > 1 else 1)) / turns
        steps = run(turns)[2] / turns if turns > 1 else run(turns)[2]
        yield (
            name,
            (seconds, seconds),
            f"a turn; error after 0.2 turn {error:.1e} m; {steps:.0f} steps"
            + ("; wanted under 1 ms" if name == "ours, rtol 1e-06" else ""),
        )


# -- studies -------------------------------------------------------------------------------------------------------------------

SPEEDS = (10_800, 14_400, 18_000, 21_600, 25_200, 28_800, 32_400, 36_000, 37_800, 39_600, 41_400)  # turns an hour
CALIBRATED = {0.01e-3: 1.49e-7, 0.05e-3: 5.55e-6, 0.1e-3: 2.71e-5, 0.2e-3: 8.89e-5, 0.4e-3: 1.95e-4}  # N m s/rad at 28 800


def table():
    """The 55 cases of the folder's table, 16 turns each, coefficients included, on all cores."""
    from pathlib import Path

    from drivewright import cases, load
    from drivewright.mechanisms.linkage.build import build
    from drivewright.multibody.analyses.impact_load import ideal_acceleration_peak, impact_load_of_run
    from drivewright.numerics.ode.together import together
    from drivewright.units import SI

    spec = load(Path(__file__).parent.parent / "examples" / "knife_folder.toml")
    output = build(spec).outputs[0]

    def model(speed, clearance, rtol):
        changes = {"drive.speed": speed / 3600 * TURN, "simulate.relative_tolerance": rtol}
        for name in ("A", "B", "O4"):
            changes |= {f"joints.{name}.clearance": clearance, f"joints.{name}.link_damping": CALIBRATED[clearance] * speed / 28_800}
        return build(spec.replace({key: SI(value) for key, value in changes.items()}))

    points = [(speed, clearance) for speed in SPEEDS for clearance in CALIBRATED]
    with together(len(points), 1) as workers:
        cases.run(lambda case: impact_load_of_run(model(*case, 1e-4), output), points, workers)
    for rtol in (1e-5, 1e-6, 1e-8):
        began = time.perf_counter()
        peaks = {speed: ideal_acceleration_peak(model(speed, 0.2e-3, rtol), output) for speed in SPEEDS}
        with together(len(points), cases.worker_count(None)) as workers:
            found = cases.run(
                lambda case, rtol=rtol, peaks=peaks: impact_load_of_run(model(*case, rtol), output, peaks[case[0]])[0], points, workers
            )
        seconds = time.perf_counter() - began
        middle = [f"{row.value:.3f}" for row in found.rows if row.case[0] == 28_800]
        yield (
            f"55 cases x 16 turns, rtol {rtol:g}",
            (seconds, seconds),
            (f"wanted under {2 if rtol == 1e-6 else 3} s; coefficients at 28 800 an hour: {', '.join(middle)}"),
        )


def bifurcation(clearances=200, turns=300):
    """Points once a turn for many clearances, on all cores."""
    from drivewright import cases
    from drivewright import multibody as mb
    from drivewright.numerics.ode.together import together

    def one(clearance):
        assembly, state = started(slider_crank(clearance))
        times = PERIOD * np.arange(turns // 2, turns + 1)
        return mb.simulate(assembly, turns * PERIOD, mb.Settings(1e-6), samples=times, state=state).steps

    if turns > 10:
        next(bifurcation(32, 10))  # compiles
    began = time.perf_counter()
    with together(clearances, cases.worker_count(None)) as workers:
        found = cases.run(one, np.linspace(0.1e-3, 0.6e-3, clearances).tolist(), workers)
    seconds = time.perf_counter() - began
    steps = sum(row.value for row in found.rows)
    yield (
        f"{clearances} clearances x {turns} turns",
        (seconds, seconds),
        (f"wanted under 35 s; {steps / clearances / turns:.0f} steps a turn, {1e6 * seconds / steps:.2f} us a step"),
    )


def friction():
    """What friction in every ideal joint costs: a slider-crank with a dry wrist at constant speed, one without play under a motor."""
    import dataclasses

    from timing import best

    from drivewright import multibody as mb

    rub = mb.JointFriction(0.05, 0.08, arm=BEARING, guide=0.04)
    loose = slider_crank()
    tight = [dataclasses.replace(joint, model=mb.Ideal()) if joint.name == "wrist" else joint for joint in loose.joints]
    motor = mb.AppliedTorque("motor", "crank", mb.LoadCurve(mb.line(2.0, -0.004), "speed"))
    cases = (
        ("dry wrist, 5 turns at 5000 rpm", loose, 5 * PERIOD),
        ("motor of 2 N m, 0.2 s from rest", mb.MultibodyModel(loose.bodies, tuple(tight), (motor,), gravity=(0.0, -9.81)), 0.2),
    )
    for name, model, duration in cases:
        rubbing = [joint if joint.name == "wrist" and joint.play else dataclasses.replace(joint, friction=rub) for joint in model.joints]
        seconds = []
        for title, joints in (("ideal", model.joints), ("with friction", tuple(rubbing))):
            assembly = mb.assemble(dataclasses.replace(model, joints=joints))
            run = mb.simulate(assembly, duration)
            seconds.append(best(lambda assembly=assembly, duration=duration: mb.simulate(assembly, duration)))
            more = "" if len(seconds) == 1 else f"; {seconds[1][0] / seconds[0][0]:.2f} times as long"
            yield f"{name}: {title}", seconds[-1], f"{run.steps} steps, {1e6 * seconds[-1][0] / run.steps:.1f} us each{more}"
