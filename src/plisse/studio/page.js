(() => {
  // without a graphics card smooth edges cost as much as everything else; pictures for the docs want them all the same
  const drawn = document.createElement("canvas").getContext("webgl2");
  const kind = drawn?.getExtension("WEBGL_debug_renderer_info");
  const card = kind ? drawn.getParameter(kind.UNMASKED_RENDERER_WEBGL) : "";
  drawn?.getExtension("WEBGL_lose_context")?.loseContext();
  if (/swiftshader|llvmpipe|softpipe|basic render/i.test(card) && !window.plisseSmooth) {
    const open = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (name, wishes) {
      return open.call(this, name, name.startsWith("webgl") ? { ...wishes, antialias: false } : wishes);
    };
  }
  let closed = false;  // on a phone the structure is seen first, the controls when their title is tapped
  const amend = () => {
    waiting = false;
    document.querySelectorAll("label[for]").forEach((label) => {
      const row = label.closest(".mantine-Flex-root");
      const words = label.textContent;
      if (!row || row.dataset.named === words) return;
      row.dataset.named = words;
      const slides = row.querySelector("[role=slider]");
      row.querySelectorAll("input:not([type=hidden]), textarea, [role=slider]").forEach((control, k) => {
        const name = k === 0 ? words : slides ? `${words}, as a number` : `${words}, ${k + 1}`;
        if (control.id !== label.htmlFor) control.setAttribute("aria-label", name);
      });
    });
    document.querySelectorAll("button:not([aria-label]) svg[class*='tabler-icon-']").forEach((icon) => {
      const button = icon.closest("button"), [, name] = /tabler-icon-([\w-]+)/.exec(icon.getAttribute("class"));
      if (!button.innerText) button.setAttribute("aria-label", name.replaceAll("-", " "));
    });
    document.querySelectorAll("img[src^='blob:']:not([alt])").forEach((picture) => {
      let around = picture.parentElement;
      while (around && !around.innerText) around = around.parentElement;
      if (around) picture.alt = around.innerText;
    });
    document.querySelectorAll(".mantine-Notification-closeButton").forEach((button) => {
      button.setAttribute("aria-label", "close the note");
    });
    const sheet = document.querySelector('[style*="max-height: 60%"]');
    if (sheet && !closed) {
      closed = true;
      [...sheet.querySelectorAll("div")].find((part) => part.style.cursor === "pointer")?.click();
    }
    document.querySelectorAll("canvas").forEach((canvas) => {
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "the folded structure and its flat sheet");
    });
  };
  // keys that set a control shall not turn the camera as well
  document.documentElement.addEventListener("keydown", (event) => {
    const used = event.target.closest("[role=slider], [role=tab], [role=option], input, textarea");
    if (used && !event.ctrlKey && !event.metaKey && !event.altKey) event.stopPropagation();
  });
  // what is typed is taken when the box is left, on Enter, or, where it is a number, after a rest: React does not see it
  // before. What is no number goes back to the one that holds, as all does on Escape
  const NUMBER = "input[inputmode=decimal], input[inputmode=numeric]", REST = 800, DIGITS = 6;
  const TYPED = `${NUMBER}, .mantine-TextInput-input, .mantine-Textarea-input`;
  const write = (box, text) => {
    const kind = box.matches("textarea") ? HTMLTextAreaElement : HTMLInputElement;
    Object.getOwnPropertyDescriptor(kind.prototype, "value").set.call(box, text);
  };
  const plain = (text) => {
    const [, number] = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)[^\d]*$/i.exec(text.replace(",", ".")) ?? [];
    return Number.isFinite(Number(number))
      ? Number(number).toLocaleString("en", { useGrouping: false, maximumFractionDigits: DIGITS }) : null;
  };
  const say = (box, sentence) => {
    hush();
    const note = document.createElement("div");
    Object.assign(note, { id: "plisse-note", role: "alert", textContent: sentence });
    box.closest(".mantine-Flex-root")?.append(note);
    document.querySelector("button:has(.icon-tabler-message)")?.click();  // what the status says of before is past
  };
  const hush = () => document.getElementById("plisse-note")?.remove();
  window.addEventListener("pointerdown", hush, true);
  window.addEventListener("keydown", ({ key }) => { if (key !== "Tab") hush(); }, true);
  let resting;
  const take = (box) => {
    clearTimeout(resting);
    if (box.value !== box.defaultValue) box.dispatchEvent(new Event("change", { bubbles: true }));
  };
  document.addEventListener("input", (event) => {
    const box = event.target;
    if (!box.matches(TYPED)) return;
    event.stopPropagation();
    clearTimeout(resting);
    if (box.matches(NUMBER)) resting = setTimeout(() => { if (plain(box.value) === box.value) take(box); }, REST);
  }, true);
  document.addEventListener("change", ({ target }) => {
    if (!target.matches(NUMBER)) return;
    const typed = target.value, number = plain(typed);
    write(target, number ?? target.defaultValue);
    if (number === null) say(target, `“${typed}” is no number that can be used; ${target.value} stays`);
  }, true);
  document.addEventListener("keydown", (event) => {
    const box = event.target;
    if (!box.matches(TYPED)) return;
    if (event.key === "Escape") write(box, box.defaultValue);
    const steps = box.matches(NUMBER) && ["ArrowUp", "ArrowDown"].includes(event.key);
    if (steps || (event.key === "Enter" && !box.matches("textarea"))) take(box);
    if (box.matches(NUMBER) && !steps) event.stopPropagation();
  }, true);
  // steps back and forth, which viser hears in no input, go from those in which one does not type as from everywhere else
  document.addEventListener("keydown", (event) => {
    const { target, code, key, ctrlKey, metaKey, shiftKey } = event;
    if (!target.matches(`input:not(${TYPED})`) || !(ctrlKey || metaKey) || key.toLowerCase() !== "z") return;
    event.preventDefault();
    event.stopPropagation();
    document.body.dispatchEvent(new KeyboardEvent("keydown", { code, key, ctrlKey, metaKey, shiftKey, bubbles: true }));
  }, true);
  document.addEventListener("focusout", (event) => {
    if (!event.target.matches(TYPED)) return;
    take(event.target);
    event.stopPropagation();  // viser would bring numbers within the limits of the slider, which are not those of the design
  }, true);
  // a window of the studio is closed by Escape and by a click beside it, as its own button does
  const shut = () => [...document.querySelectorAll(".mantine-Modal-content button")]
    .findLast((button) => button.innerText === "Close")?.click();
  document.addEventListener("keydown", ({ key }) => { if (key === "Escape") shut(); }, true);
  document.addEventListener("click", ({ target }) => { if (target.matches(".mantine-Modal-overlay, .mantine-Modal-inner")) shut(); });
  let waiting = false;
  new MutationObserver(() => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(amend);
  }).observe(document, { childList: true, subtree: true, characterData: true });
})();
