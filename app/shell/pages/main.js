import * as link from "./link.js";
import * as frame from "./frame.js";
import { drop, keys } from "./hold.js";
import { fetchFile } from "./files.js";
import { begin as hints, hint } from "./hint.js";
import { pads } from "./pad.js";
import { drawnBySoftware } from "./software.js";
import { openScreen, update } from "./panel.js";

const VERSION = 1;
const scene = document.getElementById("scene");
const over = document.getElementById("over");
let wanted = "";

function openScene() {
  scene.onload = () => keys(scene.contentWindow);
  scene.src = "scene/" + (drawnBySoftware() ? "?fixedDpr=0.5" : "");
}

link.hear("hello", (hello) => {
  if (hello.version !== VERSION) { location.reload(); return; }
  frame.greet(hello);
});
link.hear("panel", update);
link.hear("read", (read) => {
  frame.show(read);
  hint(read, frame.t);
  if (read.screen && read.screen !== wanted) {
    openScreen(read.screen, true);
  }
  wanted = read.screen;
});
link.hear("file", fetchFile);
link.hear("open", () => { over.hidden = true; if (!scene.src) openScene(); });
link.hear("close", (event) => {
  drop();
  if (event.code === 4002) { scene.contentWindow?.location.reload(); return; }
  if (event.code !== 4001) frame.alone(frame.t("page.no_link"));
});
link.hear("taken", () => {
  drop();
  document.getElementById("over-said").textContent = frame.t("page.taken");
  over.hidden = false;
});
document.getElementById("over-back").onclick = () => link.open();

const pongs = new Map();
link.hear("pong", (pong) => { const [sent, give] = pongs.get(pong.n); pongs.delete(pong.n); give(performance.now() - sent); });
window.teachframe = { ping: () => new Promise((give) => { const n = Math.random(); pongs.set(n, [performance.now(), give]); link.say({ t: "ping", n }); }) };

frame.begin();
hints();
keys(window);
pads();
link.open();
