// A gamepad in the standard layout: a shoulder button enables, cross or left stick choose the axis (up, down) and move
// it (left, right), the round button on the right stops.
import { choose, chosenAxis, drop, drops, enable, jog } from "./hold.js";
import { say } from "./link.js";

const LOOK = 16; // ms; a timer as the words have it: with frames that fail to come a pad that is let go would stay held
const OUT = 0.6, BACK = 0.4; // share of a stick's way from which it counts, and below which no longer
const stick = [0, 0]; // -1, 0 or 1: across, along
let timer = null;
let index = null; // of the pad that is read
let seen = 0; // drops
let spent = true; // all of it has to be let go before anything counts
let crossed = 0;
let stopping = false;

function pushed(pad) {
  for (const k of [0, 1]) {
    const way = pad.axes?.[k] ?? 0;
    if (Math.abs(way) < BACK) stick[k] = 0;
    else if (Math.abs(way) > OUT) stick[k] = Math.sign(way);
  }
}

function letGo() {
  enable("pad", false);
  jog("pad", 0, 0);
}

function end() {
  clearInterval(timer);
  timer = index = null;
  letGo();
}

function look() {
  const pad = [...navigator.getGamepads()].find((one) => one?.connected && (index === null || one.index === index));
  if (!pad) { end(); begin(); return; }
  index = pad.index;
  const down = (number) => Boolean(pad.buttons[number]?.pressed);
  pushed(pad);
  if (down(1) && !stopping) { say({ t: "stop" }); drop(); }
  stopping = down(1);
  const shoulder = down(4) || down(5) || down(6) || down(7);
  const across = down(15) ? 1 : down(14) ? -1 : stick[0];
  const along = down(13) ? 1 : down(12) ? -1 : stick[1];
  // What was held when the page let go of everything (a stop, another window, a lost link, another pad) moves nothing.
  if (drops() !== seen || !document.hasFocus()) { seen = drops(); spent = true; }
  if (spent) {
    letGo();
    spent = shoulder || across !== 0 || along !== 0;
    return;
  }
  if (along && !crossed && !across) choose(chosenAxis() + along);
  crossed = along;
  enable("pad", shoulder);
  jog("pad", chosenAxis(), across);
}

function begin() {
  if (timer !== null || ![...navigator.getGamepads()].some((one) => one?.connected)) return;
  spent = true;
  timer = setInterval(look, LOOK);
  look();
}

export function pads() {
  window.addEventListener("gamepadconnected", begin);
  window.addEventListener("gamepaddisconnected", () => { if (timer !== null) look(); });
}
