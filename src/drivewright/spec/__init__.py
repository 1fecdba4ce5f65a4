"""What the user says: frozen, unit-checked tables, read from and written to TOML.

A mechanism's spec is a tree of `Spec` classes under one `MechanismSpec`.  The tree is its own documentation: the commented
template, the JSON schema and every error message are read off the fields.
"""

from drivewright.spec.describing import preset_path, schema, template
from drivewright.spec.fields import DataFile, Field, Flag, Integer, Name, Named, Number, Text, dimension_at, value_at
from drivewright.spec.keys import set_key
from drivewright.spec.machining import Machining
from drivewright.spec.model import MechanismSpec, Spec
from drivewright.spec.reading import change_key, from_document, load, parse_document, read_document, read_value
from drivewright.spec.searching import Optimise
from drivewright.spec.studying import Study, Vary
from drivewright.spec.writing import document

__all__ = [
    "DataFile",
    "Field",
    "Flag",
    "Integer",
    "Machining",
    "MechanismSpec",
    "Name",
    "Named",
    "Number",
    "Optimise",
    "Spec",
    "Study",
    "Text",
    "Vary",
    "change_key",
    "dimension_at",
    "document",
    "from_document",
    "load",
    "parse_document",
    "preset_path",
    "read_document",
    "read_value",
    "schema",
    "set_key",
    "template",
    "value_at",
]
