// Filters of the gallery, pictures that move under the pointer, and texts to copy.  #cam+life in the address sets the filters.
(() => {
  const root = document.querySelector(".ex-gallery"), form = root.querySelector(".ex-filters"), cards = [...root.querySelectorAll(".ex-card")];
  const chosen = name => [...form.elements[name]].filter(box => box.checked).map(box => box.value);

  /** Show the cards of any of the chosen kinds that answer every chosen question. */
  function filter() {
    const kinds = chosen("kind"), questions = chosen("question");
    let shown = 0;
    for (const card of cards) {
      const asked = card.dataset.questions.split(" ");
      card.hidden = kinds.length > 0 && !kinds.includes(card.dataset.kind) || !questions.every(tag => asked.includes(tag));
      shown += !card.hidden;
    }
    root.querySelector(".ex-count").textContent = shown ? `${shown} of ${cards.length} examples` : "No example answers all of this; clear a question.";
  }

  const wanted = new Set(decodeURIComponent(location.hash.slice(1)).split("+"));
  for (const box of form.querySelectorAll("input")) box.checked = wanted.has(box.value);
  form.addEventListener("change", () => {
    filter();
    history.replaceState(null, "", `#${[...chosen("kind"), ...chosen("question")].join("+")}`);
  });
  form.addEventListener("submit", event => event.preventDefault());
  filter();

  // A moving picture begins anew each time it is shown; where the reader wants no motion, it stays still.
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  for (const image of root.querySelectorAll("img[data-moving]")) {
    const source = image.src, card = image.closest(".ex-card");
    const show = moving => { if (!moving || !still.matches) image.src = moving ? image.dataset.moving : source; };
    card.addEventListener("pointerenter", () => show(true));
    card.addEventListener("pointerleave", () => show(false));
    card.addEventListener("focusin", () => show(true));
    card.addEventListener("focusout", () => show(false));
  }

  for (const button of root.querySelectorAll(".ex-copy")) button.addEventListener("click", async () => {
    const code = button.parentElement.querySelector("code");
    try {
      await navigator.clipboard.writeText(code.textContent);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    } catch {
      getSelection().selectAllChildren(code);  // the reader copies it by hand
    }
  });
})();
