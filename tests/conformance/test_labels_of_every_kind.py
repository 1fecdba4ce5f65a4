"""Every label of every kind stands alone - but for those listed in `labels_to_mend.txt`, which only gets shorter.

`python tests/conformance/test_labels_of_every_kind.py` writes the list anew from what it finds.
"""

from pathlib import Path

import pytest

from drivewright import registry
from drivewright.testing import label_faults

pytestmark = pytest.mark.conformance

LIST = Path(__file__).with_name("labels_to_mend.txt")


def listed():
    """{kind: lines} of the list."""
    kinds, lines = {}, []
    for line in LIST.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            lines = kinds.setdefault(line.strip("[]"), [])
        elif line and not line.startswith("#"):
            lines.append(line)
    return kinds


def found(kind):
    """The faults of all presets of a kind, each once, sorted."""
    return sorted({line for preset in registry.mechanism(kind).presets() for line in label_faults(kind, preset)})


@pytest.mark.parametrize("kind", registry.kinds())
def test_labels_stand_alone(kind):
    known, now = set(listed().get(kind, ())), set(found(kind))
    assert not now - known, f"labels that do not stand alone; reword them: {sorted(now - known)}"
    assert not known - now, f"these are mended; take them off {LIST.name}: {sorted(known - now)}"


def write():
    """The list of what does not pass today."""
    heading = "# Labels that do not stand alone yet, by kind; see test_labels_of_every_kind.py."
    blocks = ["\n".join([f"[{kind}]", *found(kind)]) for kind in registry.kinds()]
    LIST.write_text("\n\n".join([heading, *blocks]) + "\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    write()
