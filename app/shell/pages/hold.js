// What is held: the enabling switch and one motion button, by pointer or key, and by a gamepad (pad.js). Said at every change, and again
// and again while anything is held; when this page falls silent, the server stops the arm.
import { say } from "./link.js";

const AGAIN = 33; // ms between two words while something is held
const enabling = new Set();
const jogs = new Map(); // what holds it -> [axis, sign, number of the press]
let press = 0;
let chosen = 0;
let count = 7; // axes that are there
let dropped = 0;
let timer = null;
let shown = () => {};

export function onShown(listener) { shown = listener; }
export function chosenAxis() { return chosen; }
export function choose(axis) { chosen = Math.max(0, Math.min(count - 1, axis)); shown(); }
export function held() { return { enabling: enabling.size > 0, jogs: [...jogs.values()] }; }

function word() {
  const one = jogs.size === 1 ? [...jogs.values()][0] : null; // two at once: none
  const beat = { t: "beat", en: enabling.size > 0 };
  if (one) { beat.axis = one[0]; beat.sign = one[1]; beat.press = one[2]; }
  say(beat);
}

function changed() {
  word();
  shown();
  const any = enabling.size > 0 || jogs.size > 0;
  if (any && timer === null) timer = setInterval(word, AGAIN);
  if (!any && timer !== null) { clearInterval(timer); timer = null; }
}

export function enable(who, on) {
  if (on === enabling.has(who)) return;
  on ? enabling.add(who) : enabling.delete(who);
  changed();
}

export function jog(who, axis, sign) {
  if (sign === 0) { if (jogs.delete(who)) changed(); return; }
  const before = jogs.get(who);
  if (before && before[0] === axis && before[1] === sign) return;
  jogs.set(who, [axis, sign, ++press]);
  changed();
}

// The buttons are gone, or mean another way now: a finger that is still on one holds nothing, wherever it is lifted.
export function dropJogs() {
  if (!jogs.size) return;
  dropped += 1;
  jogs.clear();
  changed();
}

// Other axes: their buttons are new.
export function axesAre(number) {
  count = number;
  dropJogs();
  choose(chosen);
}

// How often everything was let go of: who is still held then, and says so again and again, has to be let go first.
export function drops() { return dropped; }

export function drop() {
  dropped += 1;
  if (!enabling.size && !jogs.size) return;
  enabling.clear();
  jogs.clear();
  changed();
}

// A button that is held by a pointer or by Enter; several pointers may each hold one.
export function holdable(button, down, up) {
  button.classList.add("hold");
  button.addEventListener("contextmenu", (event) => event.preventDefault());
  button.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    event.preventDefault();
    button.setPointerCapture(event.pointerId);
    down("p" + event.pointerId);
  });
  for (const kind of ["pointerup", "pointercancel", "lostpointercapture"])
    button.addEventListener(kind, (event) => up("p" + event.pointerId));
  // Enter holds the button that has the focus: with Space on the switch, all can be done without a pointer.
  button.addEventListener("keydown", (event) => {
    if (event.code !== "Enter") return;
    event.preventDefault();
    if (!event.repeat) down("enter");
  });
  button.addEventListener("keyup", (event) => { if (event.code === "Enter") up("enter"); });
  button.addEventListener("blur", () => up("enter"));
}

const SIGNS = { KeyQ: -1, KeyW: 1 };
const TYPED = /^(text|number|search|)$/;

function typing(target) {
  const name = target?.tagName;
  return name === "TEXTAREA" || name === "SELECT" || (name === "INPUT" && TYPED.test(target.type));
}

// Keys with press and release, in our window and in the scene's.
export function keys(where) {
  where.addEventListener("keydown", (event) => {
    if (event.code === "Escape") { event.preventDefault(); event.stopPropagation(); say({ t: "stop" }); drop(); return; }
    if (typing(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
    const digit = /^(?:Digit|Numpad)([1-7])$/.exec(event.code);
    if (event.code !== "Space" && !(event.code in SIGNS) && !digit) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat) return;
    if (event.code === "Space") enable("space", true);
    else if (digit) choose(Number(digit[1]) - 1);
    else jog(event.code, chosen, SIGNS[event.code]);
  }, true);
  where.addEventListener("keyup", (event) => {
    if (event.code === "Space" && !typing(event.target)) event.preventDefault();
    if (event.code === "Space") enable("space", false);
    else if (event.code in SIGNS) jog(event.code, 0, 0);
  }, true);
  // The scene taking the focus is no reason to let go; another window is.
  where.addEventListener("blur", () => setTimeout(() => { if (!document.hasFocus()) drop(); }, 0));
  where.addEventListener("pagehide", drop);
}

document.addEventListener("visibilitychange", () => { if (document.hidden) drop(); });
