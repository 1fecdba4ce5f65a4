"""Specs, the input of every computation: frozen, unit-checked tables, read from and written to TOML.

A mechanism's spec is a tree of `Spec` classes under one `MechanismSpec`.  The tree is its own documentation: the commented
template, the JSON schema and every error message are read off the fields.
"""

from drivewright.spec.commented_template import preset_path, template
from drivewright.spec.fields import DataFile, Field, Flag, Integer, Name, Named, Number, Text, dimension_at, value_at
from drivewright.spec.json_schema import schema
from drivewright.spec.keys import set_key
from drivewright.spec.machining import Machining
from drivewright.spec.mechanism_spec import MechanismSpec, Spec
from drivewright.spec.optimise_table import Optimise
from drivewright.spec.parsing import change_key, from_document, load, parse_document, read_document, read_value
from drivewright.spec.serialisation import document
from drivewright.spec.study_table import Study, Vary

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
