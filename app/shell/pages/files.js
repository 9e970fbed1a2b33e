// Files to the server and from it.
import { t } from "./frame.js";

async function walk(entry, folder, found) {
  if (entry.isFile) {
    const file = await new Promise((give, fail) => entry.file(give, fail));
    found.push([file, folder]);
    return;
  }
  const reader = entry.createReader();
  for (;;) {
    const batch = await new Promise((give, fail) => reader.readEntries(give, fail));
    if (!batch.length) return;
    for (const one of batch) await walk(one, folder ? `${folder}/${entry.name}` : entry.name, found);
  }
}

async function dropped(event) {
  const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  const found = [];
  for (const entry of entries) await walk(entry, "", found);
  return found.length ? found : [...event.dataTransfer.files].map((file) => [file, ""]);
}

async function send(data, files, told) {
  const drop = crypto.getRandomValues(new Uint32Array(4)).reduce((text, part) => text + part.toString(36), "d");
  for (const [number, [file, folder]] of files.entries()) {
    told(t("page.sending", { name: file.name }));
    const asked = new URLSearchParams({ name: file.name, folder, last: number === files.length - 1 ? "1" : "0" });
    const answer = await fetch(`upload/${data.id}/${drop}?${asked}`, { method: "PUT", body: file });
    if (!answer.ok) { told(t("page.too_large")); return; }
  }
  told("");
}

export function dropzone(data) {
  const element = document.createElement("div");
  element.className = "w drop";
  const title = document.createElement("b");
  const said = document.createElement("span");
  said.className = "hint";
  const pair = document.createElement("div");
  pair.className = "pair";
  element.append(title, pair, said);
  const told = (words) => { said.textContent = words || data.hint || ""; };
  const chooser = (label, folder) => {
    const input = document.createElement("input");
    Object.assign(input, { type: "file", hidden: true, accept: folder ? "" : data.accept ?? "", multiple: Boolean(data.several) });
    if (folder) input.webkitdirectory = true;
    input.setAttribute("aria-label", data.label);
    input.onchange = () => {
      const files = [...input.files].map((file) => [file, file.webkitRelativePath.split("/").slice(0, -1).join("/")]);
      if (files.length) send(data, files, told);
      input.value = "";
    };
    const button = document.createElement("button");
    button.className = "plain";
    button.textContent = label;
    button.setAttribute("aria-label", `${data.label}: ${label}`);
    button.onclick = () => input.click();
    pair.append(button, input);
  };
  chooser(t("page.drop"), false);
  if (data.several) chooser(t("page.drop_folder"), true);
  element.ondragover = (event) => { event.preventDefault(); element.classList.add("over"); };
  element.ondragleave = () => element.classList.remove("over");
  element.ondrop = async (event) => {
    event.preventDefault();
    element.classList.remove("over");
    const files = await dropped(event);
    if (files.length) send(data, data.several ? files : files.slice(0, 1), told);
  };
  return { element, update: (now) => { title.textContent = now.label; if (!said.textContent) told(""); } };
}

export function fetchFile(message) {
  const link = document.createElement("a");
  link.href = "download/" + message.token;
  link.download = message.name;
  document.body.append(link);
  link.click();
  link.remove();
}
