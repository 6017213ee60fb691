// Elements in one line. Text is only ever set as text.

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  className = "",
  text = "",
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (className !== "") made.className = className;
  if (text !== "") made.textContent = text;
  return made;
}

// Text that stays the same costs nothing: setting it would have the page laid out anew.
export function setText(node: Element, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

// How the page says in words that there is nothing to draw.
export function missingNote(sentence: string): HTMLElement {
  return element("p", "missing", sentence);
}
