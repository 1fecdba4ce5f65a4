"""The modules of the studio's page in node, without a browser."""

import json
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

import pytest

from drivewright.report import html
from drivewright.studio import app

WEB = Path(app.__file__).parent / "web"
STUB = Path(__file__).parent / "page_stub.js"

# What a panel is made with: a store with data.state, and tools that note what is said to the server and to the clock.
STORE = """
    const said = [];
    const store = createStore({design: {opened: 1, kind: "toy", title: "Toy", form: {groups: []}, locks: []}, jobs: {}, theme: "light",
      ...data.state});
    const clock = {playing: false, phase: 0, told: [], set(phase) { clock.phase = phase; clock.told.push(phase);
    }, pause() { clock.told.push("pause"); },
      subscribe() { return () => {}; }};
    const tools = {store, say: message => said.push(message), t, clock};
    const typed = (part, text, name = "input") => { part.value = text; part.fire(name); };
    const ticked = (part, on) => { part.checked = on; part.fire("change"); };
"""


@cache
def served():
    """(what removes it, a folder with the modules as the studio serves them, and a page for them)."""
    folder = tempfile.TemporaryDirectory(prefix="drivewright-modules-")
    for path in (*WEB.glob("*.js"), *Path(html.__file__).parent.glob("*.js"), STUB):
        shutil.copy(path, folder.name)
    (Path(folder.name) / "package.json").write_text('{"type": "module"}', encoding="utf-8")
    return folder, Path(folder.name)


def in_node(body, data=None, **imports):
    """What a piece of JavaScript answers with `return`; `data` is at hand, and imports={module: "names"} from the page's modules."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed: modules of the page cannot run")
    lines = [
        f"import {{ {names} }} from './{module}.js';" for module, names in {"page_stub": "Part, nextFrame, resized, t", **imports}.items()
    ]
    script = "\n".join([*lines, 'import { readFileSync } from "node:fs";', 'const data = JSON.parse(readFileSync(0, "utf8"));'])
    script += f"\nconsole.log(JSON.stringify(await (async () => {{ {body} }})() ?? null));"
    command = [node, "--input-type=module", "-e", script]
    found = subprocess.run(command, input=json.dumps(data), capture_output=True, encoding="utf-8", timeout=60, cwd=served()[1])
    assert found.returncode == 0, found.stderr
    return json.loads(found.stdout)
