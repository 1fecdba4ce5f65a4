"""Tutorials and how-to pages: their commands run, their pictures and shown outputs kept true.

`python docs/builders/tutorials.py` runs every page and tells where one shows what is not printed; with `--refresh` it writes the outputs
and the pictures of today into the pages. Names of pages, or parts of them, run those alone.
"""

import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2] / "src")]

from builders import notebook
from builders.page_commands import Command, Outcome, PageRun, difference, page_steps, refreshed

DOCS = Path(__file__).parents[1]
FOLDERS = ("tutorials", "how-to")
LARGEST_PICTURE = 150_000  # bytes


def pages(docs: Path = DOCS) -> list[Path]:
    """All pages with commands."""
    found = [page for folder in FOLDERS for page in sorted((docs / folder).glob("*.md"))]
    return [page for page in found if any(isinstance(step, Command) for step in page_steps(page.read_text(encoding="utf-8")))]


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Nothing is computed for the site: pages and pictures are kept in the tree, and a test runs them; this says what is missing."""
    for page in pages(docs):
        for picture in (step for step in page_steps(page.read_text(encoding="utf-8")) if not isinstance(step, Command)):
            target = getattr(picture, "target", None)
            if target and not (page.parent / target).is_file():
                raise FileNotFoundError(f"{page}: no {target}; run python docs/builders/tutorials.py --refresh {page.stem}")
    progress(f"{len(pages(docs))} tutorials and how-to pages")


def faults(page: Path, folder: Path) -> list[str]:
    """What the page shows and its commands do not print; and pictures that are missing or too large."""
    run = PageRun(page, folder)
    found = [f"$ {each.command.text}\n{text}" for each in run.outcomes() if (text := difference(each.command.shown, each.printed))]
    found += run.missing
    for target in run.pictures:
        if not (page.parent / target).is_file():
            found.append(f"{target} is not in the tree")
        elif (page.parent / target).stat().st_size > LARGEST_PICTURE:
            found.append(f"{target} has more than {LARGEST_PICTURE} bytes")
    return found


def refresh(page: Path, folder: Path) -> list[str]:
    """Write outputs and pictures of today into the page; returns what it could not place."""
    run = PageRun(page, folder)
    text, at, complaints = page.read_text(encoding="utf-8"), 0, []
    for outcome in run.outcomes():
        text, at, more = _with_output(text, at, outcome)
        complaints += more
    page.write_text(text, encoding="utf-8")
    for target, made in run.pictures.items():
        (page.parent / target).parent.mkdir(exist_ok=True)
        (page.parent / target).write_bytes(compact(made.read_bytes()))
    return complaints + run.missing


def compact(picture: bytes) -> bytes:
    """An SVG with coordinates of two decimals, a hundredth of a pixel; its texts and the scales of its letters stay as they are."""

    def shorter(tag: re.Match[bytes]) -> bytes:
        return re.sub(rb"(scale\([^)]*\))|(\d\.\d\d)\d+", lambda found: found[1] or found[2], tag[0])

    return re.sub(rb"<[^>]*>", shorter, picture)


def notebooks(docs: Path = DOCS) -> list[Path]:
    """All notebooks; each has a page of its name beside it."""
    return [path for folder in FOLDERS for path in sorted((docs / folder).glob("*.ipynb"))]


def notebook_faults(path: Path, folder: Path) -> list[str]:
    """What the notebook shows and its cells do not give."""
    shown, real = notebook.read(path), notebook.executed(path, folder)
    found = []
    for old, new in zip(shown["cells"], real["cells"], strict=True):
        if text := difference(notebook.printed(old), notebook.printed(new)):
            found.append(f"{''.join(new['source'])}\n{text}")
        if len(notebook.pictures(old)) != len(notebook.pictures(new)):
            found.append(f"{''.join(new['source'])}\nanother number of pictures")
    return found + stale_files(path)


def stale_files(path: Path) -> list[str]:
    """Page and pictures that are not those of the notebook."""
    text, files = notebook.page(notebook.read(path), path.stem)
    wanted = {path.with_suffix(".md"): text.encode(), **{path.parent / name: content for name, content in files.items()}}
    return [f"{each.name} is not that of the notebook" for each, content in wanted.items() if not _has(each, content)]


def _has(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes().replace(b"\r\n", b"\n") == content


def refresh_notebook(path: Path, folder: Path) -> list[str]:
    """Execute the notebook, keep its outputs in it, and write its page."""
    new = notebook.executed(path, folder)
    notebook.write(path, new)
    text, files = notebook.page(new, path.stem)
    path.with_suffix(".md").write_text(text, encoding="utf-8", newline="\n")
    for name, content in files.items():
        (path.parent / name).write_bytes(content)
    return []


def _with_output(text: str, at: int, outcome: Outcome) -> tuple[str, int, list[str]]:
    """(page with the lines below a command replaced, where that ends, complaints)."""
    command = outcome.command
    head = f"$ {command.text}\n"
    start = text.index(head, at) + len(head)
    old = "".join(f"{line}\n" for line in command.shown)
    lines, complaints = refreshed(command, outcome.printed)
    new = "".join(f"{line}\n" for line in lines)
    assert text.startswith(old, start), f"the lines below `{command.text}` are indented; start console blocks at the margin"
    return text[:start] + new + text[start + len(old) :], start + len(new), complaints


def main(arguments: list[str]) -> int:
    """Run the pages named, or all; exit code 1 where one shows what is not so."""
    names = [each for each in arguments if not each.startswith("-")]
    refreshing = "--refresh" in arguments
    failed = False
    for page in [*pages(), *notebooks()]:
        if names and not any(name in page.stem for name in names):
            continue
        of_notebook = page.suffix == ".ipynb"
        work = (refresh_notebook if of_notebook else refresh) if refreshing else (notebook_faults if of_notebook else faults)
        with tempfile.TemporaryDirectory(prefix="page-") as folder:
            told = work(page, Path(folder))
        failed |= bool(told)
        print(page.relative_to(DOCS), "-", "\n".join(told) or "good", flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
