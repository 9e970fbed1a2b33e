// The socket to the server: one at a time, made anew when it breaks.
const listeners = new Map();
let socket = null;
let over = false;

export function hear(kind, listener) { listeners.set(kind, listener); }

export function say(message) {
  if (socket && socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

export function linked() { return Boolean(socket && socket.readyState === WebSocket.OPEN); }

function tell(kind, message) { listeners.get(kind)?.(message); }

export function open() {
  over = false;
  const address = new URL("words", location.href).href.replace(/^http/, "ws");
  const mine = socket = new WebSocket(address);
  mine.onopen = () => tell("open");
  mine.onmessage = (event) => { const message = JSON.parse(event.data); tell(message.t, message); };
  mine.onclose = (event) => {
    if (mine !== socket) return;
    tell("close", event);
    if (event.code === 4001) { over = true; return; }
    if (event.code === 4401) { location.reload(); return; }
    setTimeout(() => { if (!over) open(); }, event.code === 4002 ? 20 : 500);
  };
}
