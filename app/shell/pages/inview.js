// The key that is pressed next, the first of its screen, comes up from below the edge; who has scrolled past it is left
// where he reads.
const work = document.getElementById("work");
const SCROLLS = new Set(["PageUp", "PageDown", "Home", "End", "ArrowUp", "ArrowDown"]);
let followed = null; // the screen whose key stays in view while what stands above it still grows

function look() {
  const key = [...(followed?.querySelectorAll("button.main") ?? [])].find((one) => one.checkVisibility());
  const edge = work.getBoundingClientRect().bottom;
  if (key && key.getBoundingClientRect().bottom > edge) key.closest(".w").scrollIntoView({ block: "nearest" });
}

export function comeUp(screen) {
  followed = screen;
  requestAnimationFrame(look);
}

// A verdict, a table or a font may come after the key and push it down again, and so may what a motion brings. Whoever
// scrolls, or opens a screen himself, reads where he will, and nothing moves under him until the next key comes.
export function stay() {
  followed = null;
}
const grown = new ResizeObserver(look);
grown.observe(work);
grown.observe(document.getElementById("screens"));
const begun = { capture: true, passive: true };
addEventListener("wheel", stay, begun);
addEventListener("touchmove", stay, begun);
addEventListener("keydown", (event) => { if (SCROLLS.has(event.key)) stay(); }, begun);
work.addEventListener("pointerdown", (event) => { if (event.target === work) stay(); }, begun); // its scroll bar
