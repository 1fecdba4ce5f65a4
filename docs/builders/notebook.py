"""A notebook of the documentation: executed, stripped of what belongs to a machine, and written as a page.

The page is Markdown with the notebook's cells and outputs, so that the site needs no extension that loads scripts from elsewhere.
"""

import base64
import json
from pathlib import Path
from typing import Any

KEPT_METADATA = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}, "language_info": {"name": "python"}}
PICTURES = {"image/svg+xml": "svg", "image/png": "png"}
PLAIN = "text/plain"


def read(path: Path) -> dict[str, Any]:
    """The notebook as data."""
    return json.loads(path.read_text(encoding="utf-8"))


def write(path: Path, notebook: dict[str, Any]) -> None:
    """The notebook as Jupyter writes it."""
    path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def executed(path: Path, folder: Path) -> dict[str, Any]:
    """The notebook with the outputs of a run in `folder`; needs nbclient and ipykernel."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(folder)}}).execute()
    return stripped(json.loads(nbformat.writes(notebook)))


def stripped(notebook: dict[str, Any]) -> dict[str, Any]:
    """Without times, versions, and representations of an output beside the one that is shown."""
    notebook["metadata"] = KEPT_METADATA
    for cell in notebook["cells"]:
        cell["metadata"] = {}
        for output in cell.get("outputs", ()):
            output.pop("metadata", None) if output["output_type"] == "stream" else output.update(metadata={})
            if "data" in output:
                output["data"] = {kind: data for kind, data in output["data"].items() if kind in {*PICTURES, PLAIN, "text/html"}}
    return notebook


def printed(cell: dict[str, Any]) -> list[str]:
    """The lines of text that a cell gives on stdout and as its value; of a picture none, for its text names an object in memory."""
    lines: list[str] = []
    stream = ""  # arrives in pieces, which may end within a line
    for output in cell.get("outputs", ()):
        if output["output_type"] == "stream":
            stream += _text(output["text"]) if output["name"] == "stdout" else ""
            continue
        lines, stream = lines + stream.splitlines(), ""
        if not PICTURES.keys() & output.get("data", {}).keys():
            lines += _text(output.get("data", {}).get(PLAIN, "")).splitlines()
    return lines + stream.splitlines()


def pictures(cell: dict[str, Any]) -> list[tuple[str, bytes]]:
    """(ending, content) of the pictures of a cell."""
    found = []
    for output in cell.get("outputs", ()):
        for kind, data in output.get("data", {}).items():
            if kind in PICTURES:
                text = _text(data)
                found.append((PICTURES[kind], text.encode() if kind.endswith("xml") else base64.b64decode(text)))
    return found


def page(notebook: dict[str, Any], name: str) -> tuple[str, dict[str, bytes]]:
    """(Markdown, {file beside it: content}) of a notebook."""
    parts: list[str] = []
    files: dict[str, bytes] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            parts.append(_text(cell["source"]))
            continue
        parts.append(f"```python\n{_text(cell['source'])}\n```")
        if lines := printed(cell):
            parts.append("```text\n" + "\n".join(lines) + "\n```")
        for ending, content in pictures(cell):
            file = f"img/{name}-{len(files) + 1}.{ending}"
            files[file] = content
            parts.append(f"![Output of the cell above]({file})")
    return "\n\n".join(parts) + "\n", files


def _text(source: str | list[str]) -> str:
    return source if isinstance(source, str) else "".join(source)
