"""What the studio adds to viser's page: names of controls for assistive technology, keys, the colour of the table."""

import gzip

from plisse.draw.colours import BACKGROUND

__all__ = ["with_additions"]

# the ground is that of our pictures, and the status takes the room that it needs until one pulls at its edge
STYLE = f"""<style>
div:has(> div > [data-dock-root]) {{ background-color: {BACKGROUND} !important; }}
div[style^="flex: 0.5 1 0px"]:has(> [data-dock-leaf] #plisse-status) {{ flex: 0 1 40% !important; }}
div:has(> [data-dock-leaf] #plisse-status) ~ div[style^="flex: 0.5 1 0px"] {{ flex: 1 1 0px !important; }}
</style>"""

# viser puts words beside its controls without saying so to the browser: sliders and their numbers have no name
SCRIPT = """<script>
(() => {
  let closed = false;  // on a phone the structure is seen first, the controls when their title is tapped
  const amend = () => {
    waiting = false;
    document.querySelectorAll("label[for]").forEach((label) => {
      const row = label.closest(".mantine-Flex-root");
      const words = label.textContent;
      if (!row || row.dataset.named === words) return;
      row.dataset.named = words;
      row.querySelectorAll("input:not([type=hidden]), textarea, [role=slider]").forEach((control, k) => {
        if (control.id !== label.htmlFor) control.setAttribute("aria-label", k ? `${words}, ${k + 1}` : words);
      });
    });
    document.querySelectorAll("button:not([aria-label]) svg[class*='tabler-icon-']").forEach((icon) => {
      const button = icon.closest("button"), [, name] = /tabler-icon-([\\w-]+)/.exec(icon.getAttribute("class"));
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
  // a box for a number that is left with something else has its last number again
  document.addEventListener("focusin", ({ target }) => {
    if (target.matches("input[inputmode=decimal], input[inputmode=numeric]")) target.dataset.before = target.value;
  });
  document.addEventListener("focusout", ({ target }) => {
    const before = target.dataset?.before;
    if (!before || (target.value.trim() && Number.isFinite(Number(target.value)))) return;
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(target, before);
    target.dispatchEvent(new Event("input", { bubbles: true }));
  });
  let waiting = false;
  new MutationObserver(() => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(amend);
  }).observe(document, { childList: true, subtree: true, characterData: true });
})();
</script>"""


def with_additions(body: bytes, encoding: str) -> bytes:
    """The bytes of a page, packed as `encoding` says (gzip or identity), with the studio's additions in its head."""
    page = gzip.decompress(body) if encoding == "gzip" else body
    head, end, rest = page.partition(b"</head>")
    page = head + (STYLE + SCRIPT).encode() + end + rest if end else page
    return gzip.compress(page) if encoding == "gzip" else page
