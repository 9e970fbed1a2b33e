// Words and figures on a page, written only where they have changed.
export function put(element, text) { if (element.textContent !== text) element.textContent = text; }

export function pairs(place, values) {
  if (place.children.length !== values.length)
    place.replaceChildren(...values.map(() => {
      const line = document.createElement("div");
      line.append(document.createElement("dt"), document.createElement("dd"));
      return line;
    }));
  values.forEach(([name, value], row) => {
    put(place.children[row].children[0], name);
    put(place.children[row].children[1], value);
  });
}
