// A trainee's arm, watched: his figures come, nothing goes.
import { drawnBySoftware } from "./software.js";
import { pairs, put } from "./text.js";

const $ = (id) => document.getElementById(id);

function show(read) {
  const state = $("state");
  put(state, read.state);
  state.className = "pill " + read.how;
  put($("facts-line"), [read.robot, read.tool, read.override + "\u00a0%"].join(" · "));
  pairs($("axes"), read.axes.map((axis) => [axis.name, axis.value]));
  put($("of"), read.of);
  pairs($("pose"), read.pose);
  put($("points"), read.points);
  put($("touch"), read.touch);
  put($("message"), read.message);
}

export function watch(place) {
  const scene = $("scene");
  const begin = () => {
    const socket = new WebSocket(location.origin.replace(/^http/, "ws") + place.dataset.words);
    socket.onopen = () => { scene.src = scene.dataset.src + (drawnBySoftware() ? "?fixedDpr=0.5" : ""); };
    socket.onmessage = (event) => show(JSON.parse(event.data));
    socket.onclose = (event) => {
      if (event.code === 4401) { location.reload(); return; }
      put($("state"), "–");
      $("state").className = "pill";
      put($("message"), place.dataset.away);
      setTimeout(begin, 2000);
    };
  };
  begin();
}
