"""Write the factors in `unit_factors.toml` anew for the texts that stand there: when `units.DEFINITIONS` change or a text is added."""

import tomllib

from drivewright import units


def line(text: str) -> str:
    """`"unit" = [factor to SI, {base = exponent}]`."""
    factor, dimensionality = units.parsed_unit(text)
    bases = ", ".join(f'"{base}" = {power:g}' for base, power in sorted(dimensionality))
    return f'"{text}" = ["{factor}", {{ {bases} }}]'


if __name__ == "__main__":
    words = "# [exact factor to SI, {base = exponent}] of the units that people write most; factors by scripts/unit_factors.py."
    texts = tomllib.loads(units.FACTORS.read_text(encoding="utf-8"))
    units.FACTORS.write_text("\n".join([words, *map(line, texts)]) + "\n", encoding="utf-8")
