/**
 * A Chromium for the browser tests: STEPWRIGHT_CHROMIUM, Playwright's own, the system's; else Playwright's installer, else, as
 * root on Debian, the system package; else one line that says what to install.
 */
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { chromium } from "@playwright/test";

const SYSTEM = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

function onPath(name) {
  const found = spawnSync("sh", ["-c", `command -v ${name}`], { encoding: "utf8" });
  return found.status === 0 ? found.stdout.trim() : null;
}

/** Path of a Chromium that is there, or undefined for Playwright's own. */
export function chromiumPath() {
  const named = process.env.STEPWRIGHT_CHROMIUM;
  if (named) return named;
  if (existsSync(chromium.executablePath())) return undefined;
  for (const name of SYSTEM) {
    const path = onPath(name);
    if (path) return path;
  }
  return undefined;
}

export function chromiumFlags() {
  const flags = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
  ];
  if (process.getuid?.() === 0) flags.push("--no-sandbox");
  return flags;
}

/** Makes sure that there is one. @returns false after saying what to install. */
export function ensureChromium() {
  if (chromiumPath() || existsSync(chromium.executablePath())) return true;
  console.error("No Chromium was found; trying Playwright's installer.");
  if (
    spawnSync("npx", ["playwright", "install", "chromium"], { stdio: "inherit", timeout: 240_000 }).status ===
      0 &&
    existsSync(chromium.executablePath())
  )
    return true;
  if (process.getuid?.() === 0 && existsSync("/etc/debian_version")) {
    console.error("Installing the system's chromium with apt-get, as root.");
    try {
      execFileSync("apt-get", ["update"], { stdio: "inherit" });
      execFileSync("apt-get", ["install", "-y", "chromium"], { stdio: "inherit" });
      return chromiumPath() !== undefined;
    } catch (error) {
      console.error(String(error));
    }
  }
  console.error(
    "Browser tests need Chromium: install it (for example `apt install chromium`), or name one in STEPWRIGHT_CHROMIUM.",
  );
  return false;
}
