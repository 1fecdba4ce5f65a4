"""What the results of a chain drive obey exactly."""

from drivewright.claims import Balance, Claims, Scaling
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec

REASONS = {
    "derivatives": "no table holds a place beside its rate; the running chain's energy balance tests the rates of its equations",
    "mirror": "the sense of travel along the plates' x is a convention: the mirror image is the same drive seen from behind",
    "limits": "the limit of stiff plates is that of the chain at rest under load, which no preset computes",
}


def claims(spec: SilentChainSpec) -> Claims:
    """The rates of the layout over the speed of the drive."""
    powers = {"layout.mesh_frequency": 1, "layout.meeting_velocity": 1, "layout.centre_distance": 0, "layout.strand_length": 0}
    balances = (Balance("energy_drift", 1e-3, ("dynamics",)),)
    return Claims(balances=balances, speed=(Scaling("drive.speed", powers, ("layout",)),), reasons=REASONS)
