// Draws whatever widgets the server has, and says what somebody does with them.
import { say } from "./link.js";
import { dropzone } from "./files.js";
import { t } from "./frame.js";
import { comeUp, stay } from "./inview.js";

const known = new Map(); // id -> {data, element, inside, update}
let active = sessionStorage.getItem("teachframe.screen") || "tool";

const make = (name, look = "", text = "") => {
  const element = document.createElement(name);
  if (look) element.className = look;
  if (text) element.textContent = text;
  return element;
};
const press = (data, value = null) => say({ t: "press", id: data.id, value });

function home(data) {
  if (data.kind === "strip") return document.getElementById("strip");
  if (data.kind === "screen") return document.getElementById("screens");
  if (data.kind === "dialog") return document.getElementById("dialogs");
  return known.get(data.parent)?.inside ?? null;
}

function field(data, input, look = "") {
  const label = make("label", "field " + look);
  input.setAttribute("aria-label", data.label); // the label alone: a select's own text would count as part of it
  label.append(make("span"), input);
  return label;
}

const KINDS = {
  screen: (data) => {
    const element = make("section", "screen");
    element.id = "screen-" + data.key;
    element.setAttribute("role", "tabpanel");
    element.setAttribute("aria-labelledby", "tab-" + data.key);
    return { element, inside: element };
  },
  strip: () => { const element = make("section"); return { element, inside: element }; },
  dialog: (data) => {
    const element = make("section");
    element.setAttribute("role", "dialog");
    const title = make("h2"), away = make("button", "away", "×");
    away.setAttribute("aria-label", t("page.close")); // in sight however long it is: Esc is the emergency stop
    away.onclick = () => press(data);
    element.append(title, away);
    return { element, inside: element, update: (now) => { title.textContent = now.label; element.setAttribute("aria-label", now.label); } };
  },
  folder: (data) => {
    const element = make("details", "folder w");
    element.open = data.expanded ?? true;
    const title = make("summary");
    const inside = make("div", "inside");
    element.append(title, inside);
    return { element, inside, update: (now) => { title.textContent = now.label; } };
  },
  html: () => {
    const element = make("div", "w");
    let shown = null;
    return { element, update: (now) => {
      if (shown === now.content) return;
      const open = [...element.querySelectorAll("details[open]>summary")].map((one) => one.textContent);
      element.innerHTML = shown = now.content ?? ""; // escaped by the server, piece by piece
      for (const title of element.querySelectorAll("details>summary")) if (open.includes(title.textContent)) title.parentElement.open = true;
    } };
  },
  button: (data) => {
    const element = make("div", "w");
    const button = make("button");
    element.append(button);
    button.onclick = () => press(data);
    return { element, update: (now) => {
      button.textContent = now.label;
      const rank = now.rank ?? "main";
      const leads = rank === "main" && button.classList.contains("plain");
      button.className = rank + (now.value ? " pressed" : "");
      button.disabled = now.disabled ?? false;
      button.title = now.hint ?? "";
      if (leads) comeUp(element.closest(".screen"));
    } };
  },
  buttons: (data) => {
    const element = make("div", "w");
    const label = make("span", "label");
    const place = make("div", "buttons");
    place.setAttribute("role", "group");
    element.append(label, place);
    return { element, update: (now) => {
      label.textContent = now.label;
      place.setAttribute("aria-label", now.label);
      element.title = now.hint ?? "";
      place.replaceChildren(...(now.options ?? []).map((option, number) => {
        const button = make("button", number ? "plain" : now.rank ?? "main", option);
        button.onclick = () => press(data, option);
        return button;
      }));
    } };
  },
  choice: (data) => {
    const input = make("select");
    const element = field(data, input);
    let options = "";
    input.onchange = () => press(data, input.value);
    return { element, update: (now) => {
      element.firstChild.textContent = now.label;
      input.setAttribute("aria-label", now.label);
      if (JSON.stringify(now.options) !== options) {
        options = JSON.stringify(now.options);
        input.replaceChildren(...now.options.map((option) => new Option(option, option)));
      }
      input.value = now.value;
    } };
  },
  check: (data) => {
    const input = make("input");
    input.type = "checkbox";
    const element = make("label", "field check");
    input.setAttribute("aria-label", data.label);
    element.append(input, make("span"));
    input.onchange = () => press(data, input.checked);
    return { element, update: (now) => { element.lastChild.textContent = now.label; element.title = now.hint ?? ""; input.checked = now.value ?? false; } };
  },
  number: (data) => {
    const input = make("input");
    input.type = "number";
    const element = field(data, input);
    input.onchange = () => { if (Number.isFinite(input.valueAsNumber)) press(data, input.valueAsNumber); };
    input.onkeydown = (event) => { if (event.key === "Enter") input.blur(); };
    return { element, update: (now) => {
      element.firstChild.textContent = now.label;
      Object.assign(input, { min: now.low ?? "", max: now.high ?? "", step: "any" });
      if (document.activeElement !== input) input.value = now.value;
    } };
  },
  slider: (data) => {
    const input = make("input");
    input.type = "range";
    const output = make("output");
    const element = make("label", "field slide");
    input.setAttribute("aria-label", data.label);
    element.append(make("span"), input, output);
    let waits = null;
    const sent = () => { waits = null; press(data, input.valueAsNumber); };
    input.oninput = () => { output.textContent = input.value; waits ??= setTimeout(sent, 60); };
    return { element, update: (now) => {
      element.firstChild.textContent = now.label;
      Object.assign(input, { min: now.low, max: now.high, step: now.step });
      if (waits === null) input.value = now.value;
      output.textContent = input.value;
    } };
  },
  text: (data) => {
    const input = make("input");
    input.type = "text";
    const element = field(data, input);
    input.onchange = () => press(data, input.value);
    input.onkeydown = (event) => { if (event.key === "Enter") input.blur(); };
    return { element, update: (now) => {
      element.firstChild.textContent = now.label;
      element.title = now.hint ?? "";
      if (document.activeElement !== input) input.value = now.value ?? "";
    } };
  },
  vector: (data) => {
    const place = make("div", "vector");
    const element = field(data, place);
    return { element, update: (now) => {
      element.firstChild.textContent = now.label;
      if (place.children.length !== now.value.length) place.replaceChildren(...now.value.map((_, k) => {
        const input = make("input");
        Object.assign(input, { type: "number", step: "any" });
        input.setAttribute("aria-label", `${now.label} ${k + 1}`);
        input.onchange = () => {
          const values = [...place.children].map((one) => one.valueAsNumber);
          if (values.every(Number.isFinite)) press(data, values);
        };
        return input;
      }));
      now.value.forEach((value, k) => { if (document.activeElement !== place.children[k]) place.children[k].value = value; });
    } };
  },
  upload: (data) => dropzone(data),
  progress: () => {
    const element = make("div", "w");
    const bar = make("progress");
    bar.max = 100;
    bar.setAttribute("aria-label", t("page.busy"));
    element.append(bar);
    return { element, update: (now) => { bar.value = now.value ?? 0; } };
  },
  rows: (data) => {
    const element = make("ol", "rows w");
    return { element, update: (now) => element.replaceChildren(...(now.rows ?? []).map((row) => {
      const line = make("li", row.state ?? "open");
      line.dataset.testid = "row-" + row.key;
      if (row.state === "now") line.setAttribute("aria-current", "step");
      const acts = make("span", "acts");
      for (const [key, label] of row.actions ?? []) {
        const button = make("button", now.value === `${row.key}/${key}` ? "plain pressed" : "plain", label);
        button.setAttribute("aria-label", `${label}: ${row.title}`);
        button.onclick = () => press(data, `${row.key}/${key}`);
        acts.append(button);
      }
      line.append(make("i", "lamp " + (row.light ?? "")), make("span", "title", row.title), acts, make("span", "note", row.note ?? ""));
      return line;
    })) };
  },
};

function place(entry) {
  const parent = home(entry.data);
  if (!parent) return;
  const order = entry.data.order ?? 0;
  const after = [...known.values()].filter((other) => other !== entry && other.element.parentElement === parent && (other.data.order ?? 0) > order)
    .sort((a, b) => (a.data.order ?? 0) - (b.data.order ?? 0))[0];
  const before = after ? after.element : null;
  if (entry.element.parentElement !== parent || entry.element.nextElementSibling !== before) parent.insertBefore(entry.element, before);
}

function draw(data) {
  let entry = known.get(data.id);
  const fresh = !entry;
  if (fresh) {
    entry = KINDS[data.kind](data);
    known.set(data.id, entry);
  }
  const moved = fresh || entry.data.order !== data.order;
  const came = !fresh && entry.element.hidden && data.visible !== false;
  entry.data = data;
  entry.element.hidden = data.visible === false;
  entry.update?.(data);
  if (moved) place(entry);
  if (came && data.kind.startsWith("button") && (data.rank ?? "main") === "main") comeUp(entry.element.closest(".screen"));
}

function tabs() {
  const screens = [...known.values()].filter((entry) => entry.data.kind === "screen");
  if (!screens.length) return;
  // While screens are made anew, in another language, the open one may not be there yet: it stays the one that is wanted.
  const shown = screens.some((entry) => entry.data.key === active) ? active : screens[0].data.key;
  const bar = document.getElementById("tabs");
  const shape = screens.map((entry) => entry.data.key + entry.data.label).join();
  if (bar.dataset.shape !== shape) {
    bar.dataset.shape = shape;
    bar.replaceChildren(...screens.map((entry) => {
      const button = make("button", "", entry.data.label);
      button.id = "tab-" + entry.data.key;
      button.setAttribute("role", "tab");
      button.setAttribute("aria-controls", "screen-" + entry.data.key);
      button.dataset.key = entry.data.key;
      button.onclick = () => openScreen(entry.data.key);
      return button;
    }));
  }
  for (const button of bar.children) button.setAttribute("aria-selected", String(button.dataset.key === shown));
  for (const entry of screens) entry.element.hidden = entry.data.key !== shown;
}

// Which screen is open is said to the server: the scene shows what belongs to it. Where the server opens one there is
// something to do on it; who opens it himself begins to read at its top.
export function openScreen(key, asked = false) {
  active = key;
  say({ t: "choose", what: "screen", value: key });
  sessionStorage.setItem("teachframe.screen", key);
  tabs();
  document.getElementById("work").scrollTop = 0;
  asked ? comeUp(document.getElementById("screen-" + key)) : stay();
}

export function update(message) {
  if (message.whole) {
    say({ t: "choose", what: "screen", value: active });
    for (const entry of known.values()) entry.element.remove();
    known.clear();
  }
  for (const id of message.removed) {
    known.get(id)?.element.remove();
    known.delete(id);
  }
  for (const data of message.widgets) draw(data);
  tabs();
}
