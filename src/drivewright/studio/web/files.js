// Files of the user's disk that are chosen, or dropped on the page, and go to the server as text.

import { element } from "./player.js";

const LARGEST = 1_000_000;  // characters of opened files together; the server counts for itself
const TEXTS = [".toml", ".csv"];

/** {picker, drop}: the hidden input and the cover that is seen while files are dragged; `tell(message)` is called with a complaint. */
export function acceptFiles({say, t, tell}) {
  const picker = element("input", {type: "file", multiple: "", accept: TEXTS.join(","), hidden: "", "data-testid": "open-files"});
  const drop = element("div", {class: "st-drop", hidden: ""});
  let depth = 0;

  async function read(list) {
    const files = [...list], size = files.reduce((sum, file) => sum + file.size, 0);
    const strange = files.find(file => !TEXTS.some(end => file.name.toLowerCase().endsWith(end)));
    if (!files.length) return;
    if (strange) tell(`${strange.name}: ${t("only .toml and .csv files are opened here")}`);
    else if (size > LARGEST) tell(`${files.map(file => file.name).join(", ")}: ${(size / 1e6).toFixed(1)} MB; ${t("at most 1 MB is opened here")}`);
    else say({what: "open", files: await Promise.all(files.map(async file => ({name: file.name, text: await file.text()})))});
  }
  function cover(levels) { depth = Math.max(levels, 0); drop.hidden = !depth; }
  const carried = act => event => { if ([...event.dataTransfer?.types || []].includes("Files")) act(event); };
  const drags = {
    dragenter: carried(event => { event.preventDefault(); cover(depth + 1); }),
    dragover: carried(event => event.preventDefault()),
    dragleave: carried(() => cover(depth - 1)),
    drop: carried(event => { event.preventDefault(); cover(0); read(event.dataTransfer.files); }),
  };
  picker.addEventListener("change", () => { read(picker.files); picker.value = ""; });
  for (const [name, act] of Object.entries(drags)) window.addEventListener(name, act);
  return {
    picker, drop,
    pick() { picker.click(); },
    /** Its words, in the language of the page. */
    reword() { drop.textContent = t("Drop a design and its data files here"); },
    stop() { for (const [name, act] of Object.entries(drags)) window.removeEventListener(name, act); },
  };
}
