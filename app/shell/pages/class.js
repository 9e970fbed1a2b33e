// Pages beside the pendant: what everybody does, kept up to date; the fields of a fault; a trainee's arm, watched.
import { watch } from "./watch.js";

const grid = document.querySelector("[data-live]");
const EVERY = 2000; // milliseconds between two looks

function put(element, text) { if (element && element.textContent !== text) element.textContent = text; }

function show(news) {
  for (const one of news.seats) {
    const row = grid.querySelector(`tr[data-person="${CSS.escape(one.person)}"]`);
    if (!row) continue;
    const state = row.querySelector("[data-field=state]");
    if (!state.classList.contains(one.state)) {
      state.className = "state " + one.state;
      if (one.state === "stuck" || one.state === "stopped")
        put(document.getElementById("announce"), `${row.querySelector("th").textContent.trim()}: ${one.said}`);
    }
    put(state, one.said);
    put(row.querySelector("[data-field=for]"), one.for_);
    put(row.querySelector("[data-field=at]"), one.at);
    put(row.querySelector("[data-field=hint]"), one.hint);
    row.querySelector("[data-field=watch]").hidden = one.state === "away";
  }
  for (const [name, count] of Object.entries(news.counts)) {
    const place = document.querySelector(`[data-count=${name}]`);
    put(place, String(count));
    place.parentElement.classList.toggle("nobody", !count);
  }
}

function problem(words) {
  let line = document.getElementById("cut");
  if (!line && words) {
    line = Object.assign(document.createElement("p"), { id: "cut", className: "said error" });
    line.setAttribute("role", "alert");
    line.dataset.testid = "cut";
    grid.closest("main").prepend(line);
  }
  if (line) { line.hidden = !words; put(line, words); }
}

async function look() {
  if (!document.hidden) {
    try {
      const answer = await fetch(grid.dataset.live, { headers: { Accept: "application/json" } });
      if (answer.status === 404) { problem(grid.dataset.gone); return; }
      if (answer.status === 401) { location.reload(); return; }
      if (answer.ok) { show(await answer.json()); problem(""); } else problem(grid.dataset.cut);
    } catch { problem(grid.dataset.cut); }
  }
  setTimeout(look, EVERY);
}

function faults(place) {
  const wrong = place.querySelector("select[name=wrong]");
  const choose = () => {
    for (const part of place.querySelectorAll("[data-fault]")) part.hidden = !part.dataset.fault.split(" ").includes(wrong.value);
  };
  wrong.onchange = choose;
  choose();
}

if (grid) setTimeout(look, EVERY);
document.querySelectorAll("[data-faults]").forEach(faults);
document.querySelectorAll("[data-words]").forEach(watch);
