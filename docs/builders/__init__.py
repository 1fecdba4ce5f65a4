"""Builders of the pages and pictures that are made from the code.

Each module has `build(docs: Path, progress: Callable[[str], None]) -> None`, which writes below `docs` and tells what it is doing.
`docs/generate.py` names the modules in the order in which they run.
"""
