"""Specs, the input of every computation: frozen, unit-checked tables, read from and written to TOML.

A mechanism's spec is a tree of `Spec` classes under one `MechanismSpec`.  The tree is its own documentation: the commented
template, the JSON schema and every error message are read off the fields.

base                the base class of all tables of a spec
commented_template  the commented template of a spec
csv_columns         two columns of a CSV file by name, each with its unit in brackets in the header
csv_table           tables in CSV files, whoever wrote them: separators, decimal signs, comments, rows of units
csv_headings        headings of their columns: names and units in several spellings
csv_words           names of quantities in headings of other languages
csv_numbers         numbers in their cells, and the digits they were printed to
csv_text            CSV files as text: read within limits, and texts that no spreadsheet takes for a formula
designs             many designs in one spec
differences         in which keys specs differ
document_limits     how much the text of a spec may hold, checked in one pass before it is parsed
error_messages      validation errors of pydantic as `SpecError`: the dotted key, the value, what would be right
json_schema         the JSON schema of a kind's spec files, read off the fields
keys                dotted keys of raw tables: set, or taken out, in place
length_or_angle     a quantity that is a length, or an angle
length_or_rule      a quantity that is a length, or the word for a rule that gives it
machining           how flat parts are milled and measured: shared by every kind whose drawings go to a workshop
mechanism_spec      the whole spec of one drive: what all kinds have in common
optimise_table      the [optimise] table: unknowns, requirements and objectives
parsing             from TOML files and "key=value" texts to raw tables, and from raw tables to a spec
readings            what a quantity that could be meant otherwise was read as, key by key
report_table        the [report] table: company, logo, author and templates of the reports
sample_values       values that the keys of a spec could have: for the commented template and for forms
serialisation       a spec as raw tables, as TOML text, and as the canonical text under its digest
shared_tables       many specs that differ in a few keys, all other tables validated once
study_table         the [study] table: what varies from case to case, how it is sampled, what is kept
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
