"""The steel of the tests of a shaft's strength."""

from drivewright.materials import Source, Strength

STEEL = Strength(1000e6, 800e6, Source("a steel of these tests", recalled=False))
