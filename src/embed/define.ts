/** Registers `<stepwright-scene>`; does nothing where there are no elements. */
import { StepwrightScene } from "./element.ts";

/** Defines the element under `name`, once. */
export function defineElement(name = "stepwright-scene"): void {
  if (typeof customElements !== "undefined" && !customElements.get(name))
    customElements.define(name, StepwrightScene);
}
