// The key that is pressed next, the first of its screen, comes up from below the edge. Who has scrolled past it is left
// where he reads; who has pressed a key since, or never scrolled, is shown the next one above as well: a result stands
// above the procedure that led to it.
const work = document.getElementById("work");
const SCROLLS = new Set(["PageUp", "PageDown", "Home", "End", "ArrowUp", "ArrowDown"]);
let above = false; // it is looked for above the edge, too
let followed = null; // the screen whose key stays in view while what stands above it still grows

function look() {
  const key = [...(followed?.querySelectorAll("button.main") ?? [])].find((one) => one.checkVisibility());
  if (!key) return;
  const edge = work.getBoundingClientRect().bottom, box = key.getBoundingClientRect();
  const tabs = document.getElementById("tabs").getBoundingClientRect().bottom;
  if (box.bottom > edge) key.closest(".w").scrollIntoView({ block: "nearest" });
  else if (above && box.top < tabs) work.scrollTop -= tabs - box.top + verdict(key);
}

// What stands right above a key says why it is pressed, and comes into view with it.
function verdict(key) {
  const before = key.closest(".w").previousElementSibling;
  return before && before.checkVisibility() && before.querySelector(".light") ? before.offsetHeight + 20 : 10;
}

export function comeUp(screen) {
  above = followed === screen;
  followed = screen;
  requestAnimationFrame(look);
}

// A verdict, a table or a font may come after the key and push it down again, and so may what a motion brings. Whoever
// scrolls, or opens a screen himself, reads where he will, and nothing moves under him until the next key comes.
export function stay() {
  followed = null;
}

// Who presses a key has read what he wanted to read.
work.addEventListener("click", (event) => {
  if (event.target.closest(".w button")) followed = event.target.closest(".screen");
});
const grown = new ResizeObserver(look);
grown.observe(work);
grown.observe(document.getElementById("screens"));
const begun = { capture: true, passive: true };
addEventListener("wheel", stay, begun);
addEventListener("touchmove", stay, begun);
addEventListener("keydown", (event) => { if (SCROLLS.has(event.key)) stay(); }, begun);
work.addEventListener("pointerdown", (event) => { if (event.target === work) stay(); }, begun); // its scroll bar
