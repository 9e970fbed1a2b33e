// The frame that nothing hides: status, jog panel, message line.
import { say } from "./link.js";
import { pairs, put } from "./text.js";
import { axesAre, choose, chosenAxis, dropJogs, enable, held, holdable, jog, onShown } from "./hold.js";

const $ = (id) => document.getElementById(id);
let texts = {};
let last = null;
let shape = ""; // which axes the rows were made for
let editing = -1;
let said = null;
let sound = localStorage.getItem("teachframe.sound") === "on";
let audio = null;

export const t = (key, fields = {}) =>
  (texts[key] ?? key).replace(/\{(\w+)\}/g, (whole, name) => fields[name] ?? whole);

// On a phone the top line has room for what must be seen; the keys for looks stand beside Home, under Jog.
const phone = matchMedia("(max-width:600px)");
function settle() {
  const line = document.querySelector("#jog .line");
  const moved = phone.matches ? ["sound", "theme"] : [];
  if (phone.matches && !$("beside").hidden) moved.unshift("language");
  for (const id of ["language", "sound", "theme"])
    if (moved.includes(id)) line.append($(id));
    else $("bar").insertBefore($(id), $("beside"));
}

// Words in the scene are laid out for its window, which only the page knows in its own measure.
const sized = () => {
  const { clientWidth, clientHeight } = $("scene");
  if (clientHeight) say({ t: "choose", what: "window", value: `${clientWidth} ${clientHeight}` });
};

function segment(place, keys, label, pick) {
  place.replaceChildren(...keys.map((key) => {
    const button = document.createElement("button");
    button.dataset.key = key;
    button.textContent = label(key);
    button.setAttribute("role", "radio");
    button.onclick = () => pick(key);
    return button;
  }));
}

function mark(place, key) {
  for (const button of place.children) {
    button.classList.toggle("on", button.dataset.key === key);
    button.setAttribute("aria-checked", String(button.dataset.key === key));
  }
}

export function greet(hello) {
  texts = hello.texts;
  const choices = hello.choices;
  document.documentElement.lang = choices.language;
  document.documentElement.dataset.theme = choices.dark ? "dark" : "light";
  const age = 400 * 24 * 3600;
  document.cookie = `teachframe_look=${encodeURIComponent(choices.look)}; path=${location.pathname.replace(/\/$/, "") || "/"}; max-age=${age}; samesite=strict`;
  for (const element of document.querySelectorAll("[data-t]")) element.textContent = t(element.dataset.t);
  for (const element of document.querySelectorAll("[data-label]")) {
    element.setAttribute("aria-label", t(element.dataset.label));
    if (element.tagName === "BUTTON") element.title = t(element.dataset.label);
  }
  $("scene").title = t("page.scene");
  $("beside").hidden = !hello.beside;
  if (hello.beside) { $("beside").href = hello.beside; $("beside").textContent = t("page." + hello.beside); }
  settle();
  $("person").hidden = !hello.person;
  $("person").textContent = [...hello.person][0] ?? "";
  $("person").title = `${hello.person} · ${t("people.account")}`;
  $("person").setAttribute("aria-label", $("person").title);
  $("language").replaceChildren(...Object.entries(choices.languages).map(([key, name]) => new Option(name, key)));
  $("language").value = choices.language;
  segment($("frames"), choices.frames, (key) => t("jog.frame_" + key), (key) => say({ t: "choose", what: "frame", value: key }));
  segment($("increments"), choices.increments, (key) => t("jog.step_" + key).replace(/mm\s/, "mm\n"), (key) => say({ t: "choose", what: "increment", value: key }));
  segment($("views"), choices.views, (key) => t("move.view_" + key), (key) => { say({ t: "choose", what: "view", value: key }); mark($("views"), key); });
  mark($("views"), "");
  segment($("handles"), ["both", "shift", "turn"], (key) => t("move.handle_" + key), (key) => { say({ t: "choose", what: "handle", value: key }); mark($("handles"), key); });
  mark($("handles"), "both");
  shape = "";
  said = null;
  sized();
  if (last) show(last);
}

function rows(axes) {
  $("axes").replaceChildren(...axes.map((axis, row) => {
    const line = document.createElement("div");
    line.className = "ax";
    const name = document.createElement("b");
    name.textContent = axis.name;
    name.onclick = () => choose(row);
    const value = document.createElement("button");
    value.className = "val";
    value.disabled = axis.low === null;
    value.setAttribute("aria-label", t("page.typed", { name: axis.name }));
    value.onclick = () => edit(row, value);
    line.append(name, pair(axis, -1), value, pair(axis, 1));
    return line;
  }));
  axesAre(axes.length);
}

function pair(axis, sign) {
  const button = document.createElement("button");
  button.className = "jk";
  button.textContent = sign < 0 ? "−" : "+";
  button.dataset.axis = axis.axis;
  button.dataset.sign = sign;
  button.setAttribute("aria-label", t(sign < 0 ? "page.minus" : "page.plus", { name: axis.name }));
  holdable(button, (who) => jog(who, axis.axis, sign), (who) => jog(who, 0, 0));
  return button;
}

// As a field has it; what rounds to nothing has no sign.
const typed = (axis) => axis.number.toFixed(2).replace(/^-(0\.00)$/, "$1");

function edit(row, button) {
  const axis = last.axes[row];
  const field = document.createElement("input");
  Object.assign(field, { type: "number", min: axis.low, max: axis.high, step: "any", value: typed(axis) });
  field.setAttribute("aria-label", button.getAttribute("aria-label"));
  editing = row;
  button.replaceWith(field);
  field.select();
  let done = false;
  const end = (take) => {
    if (done) return;
    done = true;
    editing = -1;
    if (take && field.value !== "" && Number.isFinite(field.valueAsNumber))
      say({ t: "joint", axis: axis.axis, value: field.valueAsNumber });
    field.replaceWith(button);
  };
  field.onkeydown = (event) => { if (event.key === "Enter") end(true); };
  field.onblur = () => end(field.value !== typed(axis));
}

export function show(read) {
  last = read;
  const known = read.frame + read.axes.map((axis) => axis.name).join();
  if (known !== shape) { shape = known; editing = -1; rows(read.axes); }
  read.axes.forEach((axis, row) => {
    if (row === editing) return;
    const value = $("axes").children[row].querySelector(".val");
    put(value, axis.value);
    if (value.ariaDescription !== axis.value) value.ariaDescription = axis.value; // its name says what pressing it does
  });
  const state = $("state");
  put(state, read.state);
  state.className = "pill " + read.how;
  const enabled = $("enabled");
  put(enabled, t(read.tripped ? "page.let_go" : read.enabled ? "page.enabled" : "page.locked"));
  enabled.className = "pill" + (read.tripped ? " trip" : read.enabled ? " on" : "");
  $("enable").classList.toggle("trip", read.tripped);
  put($("robot"), read.robot);
  put($("tool"), read.tool);
  put($("base"), read.base);
  put($("speed"), read.override + " %");
  put($("touch"), read.touch);
  $("touch").classList.toggle("on", read.touching);
  put($("points"), read.points.replace(/^\D+/, ""));
  put($("task"), read.task);
  $("task").title = read.task;
  put($("clock"), read.clock);
  put($("override-said"), read.override + " %");
  if (document.activeElement !== $("override")) $("override").value = read.override;
  mark($("frames"), read.frame);
  mark($("increments"), read.increment);
  put($("of"), read.of);
  pairs($("pose"), read.pose);
  if (!read.own) dropJogs();
  for (const key of $("axes").querySelectorAll(".jk")) key.disabled = !read.own;
  $("home").disabled = !read.own;
  for (const value of $("axes").querySelectorAll(".val")) value.disabled = !read.own || read.frame !== "joint";
  $("handles").hidden = !read.handle || !read.own;
  const stop = $("estop");
  const latched = read.how === "stopped";
  stop.classList.toggle("latched", latched);
  put(stop, t(latched ? "page.release" : "page.stop"));
  stop.setAttribute("aria-label", t(latched ? "page.release_long" : "page.stop_long"));
  $("errand").hidden = read.how !== "waiting" && !(["moving", "measuring"].includes(read.how) && read.errand);
  put($("errand-said"), (read.how === "waiting" ? t("page.wait") + ": " : "") + read.errand);
  message(read);
  pressed();
}

function message(read) {
  if (read.said === said) return;
  const first = said === null;
  said = read.said;
  put($("message"), read.message);
  $("message").dataset.testid = "message-" + read.level;
  $("line").className = read.level;
  if (!first && sound && read.level !== "info") beep(read.level === "good" ? 880 : 330);
}

export function alone(words) {
  put($("message"), words);
  $("line").className = "error";
  said = null;
}

function beep(hertz) {
  audio ??= new AudioContext();
  const tone = audio.createOscillator();
  const volume = audio.createGain();
  volume.gain.value = 0.06;
  tone.frequency.value = hertz;
  tone.connect(volume).connect(audio.destination);
  tone.start();
  tone.stop(audio.currentTime + 0.12);
}

function pressed() {
  const now = held();
  $("enable").classList.toggle("down", now.enabling);
  $("enable").setAttribute("aria-pressed", String(now.enabling));
  for (const key of document.querySelectorAll(".jk"))
    key.classList.toggle("down", now.jogs.some(([axis, sign]) => key.dataset.axis === String(axis) && key.dataset.sign === String(sign)));
  [...$("axes").children].forEach((line, row) => line.classList.toggle("chosen", row === chosenAxis()));
}

export function begin() {
  phone.onchange = settle;
  new ResizeObserver(sized).observe($("scene"));
  settle();
  onShown(pressed);
  holdable($("enable"), (who) => enable(who, true), (who) => enable(who, false));
  $("estop").addEventListener("pointerdown", (event) => {
    if (event.button) return;
    say({ t: last?.how === "stopped" ? "release" : "stop" });
  });
  $("estop").addEventListener("keydown", (event) => {
    if (event.key === "Enter") say({ t: last?.how === "stopped" ? "release" : "stop" });
  });
  $("cancel").onclick = () => say({ t: "cancel" });
  $("help").onclick = () => {
    $("keys").hidden = !$("keys").hidden;
    $("help").setAttribute("aria-expanded", String(!$("keys").hidden));
  };
  $("home").onclick = () => say({ t: "home" });
  $("override").oninput = () => say({ t: "choose", what: "override", value: $("override").valueAsNumber });
  $("override").onchange = () => $("override").blur();
  $("theme").onclick = () => say({ t: "choose", what: "dark", value: document.documentElement.dataset.theme !== "dark" });
  $("language").onchange = () => say({ t: "choose", what: "language", value: $("language").value });
  $("sound").setAttribute("aria-pressed", String(sound));
  $("sound").onclick = () => {
    sound = !sound;
    localStorage.setItem("teachframe.sound", sound ? "on" : "off");
    $("sound").setAttribute("aria-pressed", String(sound));
    if (sound) beep(660);
  };
  for (const button of document.querySelectorAll("#switch button"))
    button.onclick = () => { document.body.dataset.part = button.dataset.part; };
}
