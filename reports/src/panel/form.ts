// Fields with their labels.
import { element } from "../dom";

export function button(text: string, act: () => void, className = ""): HTMLButtonElement {
  const made = element("button", className, text);
  made.type = "button";
  made.addEventListener("click", act);
  return made;
}

export function labelled<T extends HTMLElement>(label: string, field: T): HTMLLabelElement {
  const made = element("label", "field");
  made.append(element("span", "", label), field);
  return made;
}

export function checkbox(label: string): { row: HTMLLabelElement; box: HTMLInputElement } {
  const row = element("label", "field check");
  const box = element("input");
  box.type = "checkbox";
  row.append(box, element("span", "", label));
  return { row, box };
}

export function select(options: [value: string, text: string][]): HTMLSelectElement {
  const made = element("select");
  setOptions(made, options);
  return made;
}

export function setOptions(field: HTMLSelectElement, options: [value: string, text: string][]): void {
  field.replaceChildren(
    ...options.map(([value, text]) => {
      const option = element("option", "", text);
      option.value = value;
      return option;
    }),
  );
}

export function textField(value = ""): HTMLInputElement {
  const made = element("input");
  made.type = "text";
  made.value = value;
  made.autocomplete = "off";
  made.spellcheck = false;
  return made;
}
