"use strict";
// The slider: two of a scene's pictures, one over the other. Without it the page shows them side by side all the same.
(() => {
  const pairs = [["fixed", "reference"], ["reference", "truth"], ["fixed", "truth"], ["before", "after"]];

  const make = (name, properties, ...children) => {
    const element = Object.assign(document.createElement(name), properties);
    element.append(...children);
    return element;
  };

  const addViewer = (scene) => {
    const source = (name) => scene.querySelector(`img[data-picture="${name}"]`);
    const left = source("fixed").cloneNode(), right = source("truth").cloneNode();
    for (const image of [left, right]) image.removeAttribute("data-picture");
    const leftTag = make("span", { className: "tag left" }), rightTag = make("span", { className: "tag right" });
    const slider = make("input", { type: "range", min: 0, max: 1000, value: 500 });
    const stage = make("div", { className: "stage" }, left, right, make("div", { className: "edge" }), leftTag, rightTag, slider);
    let pair = pairs[2], withError = false;

    const show = (image, name) => { image.src = source(name).src; image.alt = source(name).alt; };
    const update = () => {
      const fits = withError && pair[0] === "before"; // each has its error
      show(left, fits ? "error_before" : pair[0]);
      show(right, fits ? "error_after" : withError ? `error_${pair[0]}_${pair[1]}` : pair[1]);
      leftTag.textContent = fits ? "error before, ×8" : pair[0];
      rightTag.textContent = fits ? "error after, ×8" : withError ? `error against ${pair[1]}, ×8` : pair[1];
      slider.setAttribute("aria-label", `Edge between ${leftTag.textContent} on the left and ${rightTag.textContent} on the right`);
    };
    slider.addEventListener("input", () => stage.style.setProperty("--at", `${slider.value / 10}%`));

    const choices = make("fieldset", { ariaLabel: "Which pictures" }, ...pairs.map((p) => {
      const radio = make("input", { type: "radio", name: `pair-${scene.id}`, checked: p === pair });
      radio.addEventListener("change", () => { pair = p; update(); });
      return make("label", {}, radio, `${p[0]} | ${p[1]}`);
    }));
    const toggle = (text, change) => {
      const button = make("button", { type: "button", textContent: text, ariaPressed: "false" });
      button.addEventListener("click", () => {
        const on = button.ariaPressed !== "true";
        button.ariaPressed = String(on);
        change(on);
      });
      return button;
    };
    const bar = make("div", { className: "bar" }, choices,
      toggle("error", (on) => { withError = on; update(); }), toggle("blink", (on) => stage.classList.toggle("blink", on)));
    scene.querySelector(".pictures").before(make("div", { className: "viewer" }, bar, stage));
    update();
  };

  document.querySelectorAll(".scene").forEach(addViewer);
})();
