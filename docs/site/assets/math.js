// Draws the formulas of a page, which pymdownx.arithmatex has put into \( \) and \[ \].
document.addEventListener("DOMContentLoaded", () => {
  if (typeof renderMathInElement !== "function") return; // KaTeX is not there: formulas stay as they are written
  renderMathInElement(document.body, {
    delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}],
    throwOnError: false,
  });
});
