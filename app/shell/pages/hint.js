// A trainer's hint in the message line: it stays until it is put away; and the word that somebody watches.
import { say } from "./link.js";

const $ = (id) => document.getElementById(id);
let shown = 0;

export function hint(read, t) {
  $("watched").hidden = !read.watched;
  if (read.hint !== shown) {
    shown = read.hint;
    $("hint").hidden = !shown;
    $("hint-said").textContent = read.hinted;
    if (shown) say({ t: "hint", id: shown });
  }
  $("hint-more").textContent = read.hints > 1 ? t("page.hint_more", { count: read.hints - 1 }) : "";
}

export function begin() {
  $("hint-away").onclick = () => { if (shown) say({ t: "hint", id: shown, away: true }); };
}
