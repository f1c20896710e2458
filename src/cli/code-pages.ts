/** The code that lessons point to, as pages of the site: a list a folder, a page a file, a line number a line. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { LESSONS } from "../lessons/list.ts";

const safe = (s: string): string => s.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

const page = (title: string, depth: number, body: string): string => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<meta name="color-scheme" content="light dark" />
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self'" />
<title>${safe(title)}</title>
<link rel="stylesheet" href="${"../".repeat(depth)}code.css" />
</head>
<body>
${body}
</body>
</html>
`;

const STYLE = `body { margin: 24px auto; max-width: 1000px; padding: 0 24px; font: 13px/20px system-ui, sans-serif; color: #16191d; background: #fbfbfa; }
h1 { font: 600 15px/20px ui-monospace, monospace; } a { color: inherit; }
pre { font: 12px/18px ui-monospace, monospace; counter-reset: line; white-space: pre-wrap; tab-size: 2; }
pre span { counter-increment: line; display: block; padding-left: 48px; position: relative; }
pre span::before { content: counter(line); position: absolute; left: 0; width: 32px; text-align: right; color: #666d76; }
pre span:target { background: #ededea; } li { margin: 4px 0; } li span { color: #666d76; }
@media (prefers-color-scheme: dark) { body { color: #f2f1ed; background: #1d2025; } pre span:target { background: #30353c; } pre span::before, li span { color: #959ca5; } }
`;

/** First sentence of a file's doc comment. */
function about(source: string): string {
  const comment = /^\/\*\*([\s\S]*?)\*\//.exec(source)?.[1] ?? "";
  const text = comment
    .replace(/^\s*\* ?/gm, "")
    .replace(/\s+/g, " ")
    .trim();
  return /^(.*?[.:])(\s|$)/.exec(text)?.[1] ?? text;
}

/** Every page: its address under `code/` and its text. Folders that do not exist are left out. */
export function codePages(root: string): Map<string, string> {
  const out = new Map<string, string>([["code.css", STYLE]]);
  for (const folder of new Set(LESSONS.flatMap((l) => l.code))) {
    if (!existsSync(join(root, folder))) continue;
    const depth = folder.split("/").length;
    const files = readdirSync(join(root, folder)).filter((f) => f.endsWith(".ts"));
    const items = files.map((file) => {
      const source = readFileSync(join(root, folder, file), "utf8");
      const lines = source.replace(/\n$/, "").split("\n");
      const body = lines.map((l, i) => `<span id="L${i + 1}">${safe(l) || " "}</span>`).join("");
      const back = `<p><a href="./index.html">${safe(folder)}</a></p>`;
      out.set(
        `${folder}/${file}.html`,
        page(`${folder}/${file}`, depth, `${back}<h1>${safe(`${folder}/${file}`)}</h1><pre>${body}</pre>`),
      );
      return `<li><a href="./${file}.html"><code>${safe(file)}</code></a> <span>${safe(about(source))}</span></li>`;
    });
    out.set(
      `${folder}/index.html`,
      page(folder, depth, `<h1>${safe(folder)}</h1><ul>${items.join("\n")}</ul>`),
    );
  }
  return out;
}
