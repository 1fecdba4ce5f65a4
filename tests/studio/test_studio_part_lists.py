"""Lists of bought parts that a field is chosen from."""

import pytest

from drivewright.bearings.catalogue import entry
from drivewright.errors import UnknownName
from drivewright.studio.field_info import field_info_at
from drivewright.studio.part_lists import LISTS, entries

pytestmark = pytest.mark.interface


def test_bearings_are_told_by_their_size_and_rating():
    found = dict(entries(None, "bearings"))
    assert len(found) > 400 and found["6406"].startswith("30 × 90 × 23 mm, C ")
    bores = [entry(name).bore for name in found]
    assert bores == sorted(bores)


def test_a_list_that_is_not_there_is_refused():
    with pytest.raises(UnknownName, match="list of parts"):
        entries(None, "__class__")


def test_fields_name_lists_and_keys_that_there_are():
    import drivewright.mechanisms.indexer.spec as indexer
    from drivewright.mechanisms.shaft.bearing_table import Bearing

    for table in (Bearing, indexer.IndexerBearings):
        info = field_info_at(table, ["bearing"])
        assert info.listed in LISTS and info.overrides
        assert all(field_info_at(table, [name]) for name in info.overrides)
