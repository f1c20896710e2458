// Pages without an origin (sandboxed frames, files opened from a disk) may not load modules: this brings the same code as a classic script.
if (self.origin === "null") {
  const here = document.currentScript;
  const script = document.createElement("script");
  script.src = new URL("stepwright.js", here.src).href;
  document.head.append(script);
}
