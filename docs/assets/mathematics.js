// Formulas: MathJax is loaded by pages that have some, and by no other.
(() => {
  if (!document.querySelector(".arithmatex")) return;
  const smallest = 0.75; // of the size of the text: a formula that is still too wide scrolls
  const fit = () => document.querySelectorAll("div.arithmatex").forEach(box => {
    const formula = box.querySelector("mjx-container"), share = box.clientWidth / box.scrollWidth;
    if (formula && share < 1) formula.style.fontSize = `${100 * Math.max(smallest, share - 0.005)}%`;
  });
  window.MathJax = {
    tex: { inlineMath: [["\\(", "\\)"]], displayMath: [["\\[", "\\]"]], processEscapes: true, processEnvironments: true },
    svg: { fontCache: "global" },
    startup: { pageReady: () => MathJax.startup.defaultPageReady().then(fit) },
    options: { enableMenu: false, ignoreHtmlClass: ".*|", processHtmlClass: "arithmatex" },
  };
  const script = document.createElement("script");
  script.src = new URL("mathjax/tex-svg-full.js", document.currentScript.src).href;
  document.head.append(script);
})();
