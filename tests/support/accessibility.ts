/** What axe finds wrong with a page, where it is serious or critical. */
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

/** "rule: elements" of each serious or critical violation. */
export async function seriousViolations(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter((v) => v.impact === "serious" || v.impact === "critical")
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(" ")).join(", ")}`);
}
