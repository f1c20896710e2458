/**
 * Lessons are written as plain pages of text. The build, and the development server, put in what all share: fonts and style, the bar, the
 * contents, links to the lessons before and after, and formulas as MathML.
 */
import type { Plugin } from "vite";
import { LESSONS } from "../lessons/list.ts";
import { codePages } from "./code-pages.ts";
import { withFormulas } from "./math-markup.ts";

const CODE = "../code/";

const HEAD = `<meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <link rel="icon" href="/favicon.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="/src/lessons/lesson.css" />
    <script src="../offline/boot.js"></script>
    <script type="module" src="/src/lessons/main.ts"></script>`;

const MARK = `<svg class="mark" viewBox="0 0 20 20" aria-hidden="true"><path d="M5.500 7c1.800 0 2.600 1.700 2.400 4-.1 1.400-.8 2.300-2.400 2.300S3.200 12.400 3.100 11C2.900 8.700 3.700 7 5.500 7zM3.700 15h3.600c0 1.700-.5 2.800-1.800 2.800S3.700 16.700 3.700 15z"/><path opacity=".45" d="M14.500 2c1.800 0 2.600 1.700 2.400 4-.1 1.400-.8 2.300-2.400 2.300S12.200 7.400 12.100 6c-.2-2.300.6-4 2.400-4zM12.700 10h3.600c0 1.700-.5 2.800-1.800 2.800s-1.800-1.100-1.800-2.800z"/></svg>`;

/** "When a foot is down" as it is linked to. */
const text = (html: string): string => html.replace(/<[^>]+>/g, "").trim();

function bar(code: readonly string[]): string {
  const links = code
    .map((folder) => `<li><a href="${CODE}${folder}/index.html"><code>${folder}</code></a></li>`)
    .join("");
  const menu =
    code.length > 0 ? `<details class="menu"><summary>Code</summary><ul>${links}</ul></details>` : "";
  const tools =
    code.length > 0
      ? '<button type="button" data-act="print">Print</button><button type="button" data-act="zip">Save offline</button>'
      : "";
  return `<header class="bar">
      <a class="brand" href="./index.html">${MARK}<b>Stepwright</b> <span>Lessons</span></a>
      <div class="tools">${tools}${menu}<a class="button" href="../index.html">Open the editor</a></div>
    </header>`;
}

function contents(html: string, number: number): string {
  const heads = [...html.matchAll(/<h2 id="([^"]+)">([\s\S]*?)<\/h2>/g)];
  const items = heads.map(([, id, title]) => `<li><a href="#${id}">${text(title)}</a></li>`).join("");
  return `<nav class="contents" aria-label="This lesson"><p>Lesson ${number}</p><ol>${items}</ol></nav>`;
}

function foot(index: number): string {
  const before = LESSONS[index - 1];
  const after = LESSONS[index + 1];
  const link = (way: string, l: (typeof LESSONS)[number] | undefined): string =>
    l ? `<a href="./${l.name}.html"><span>${way}</span>${l.title}</a>` : "<span></span>";
  return `<nav class="onwards" aria-label="Other lessons">${link("Before", before)}${link("Next", after)}</nav>`;
}

function index(): string {
  return `<ol class="lessons">${LESSONS.map((l, i) => `<li><a href="./${l.name}.html"><span class="number">${i + 1}</span><span class="what"><b>${l.title}</b><span>${l.about}</span><cite>${l.paper}</cite></span></a></li>`).join("")}</ol>`;
}

/** A lesson's page as it is served. @throws Error for a formula that cannot be read. */
export function lessonPage(html: string, name: string): string {
  const at = LESSONS.findIndex((l) => l.name === name);
  return withFormulas(html)
    .replace("<!-- head -->", HEAD)
    .replace("<!-- bar -->", bar(LESSONS[at]?.code ?? []))
    .replace("<!-- contents -->", contents(html, at + 1))
    .replace("<!-- onwards -->", foot(at))
    .replace("<!-- lessons -->", index());
}

export function lessonPages(): Plugin {
  return {
    name: "stepwright-lessons",
    configureServer(server) {
      server.middlewares.use("/code/", (request, response, next) => {
        const address = (request.url ?? "/").split(/[?#]/)[0].replace(/^\//, "");
        const text = codePages(process.cwd()).get(address);
        if (text === undefined) return next();
        response.setHeader("Content-Type", address.endsWith(".css") ? "text/css" : "text/html");
        response.end(text);
      });
    },
    generateBundle() {
      for (const [name, source] of codePages(process.cwd()))
        this.emitFile({ type: "asset", fileName: `code/${name}`, source });
    },
    transformIndexHtml: {
      order: "pre",
      handler(html, context) {
        const found = /\/lessons\/([^/]+)\.html$/.exec(context.path);
        return found ? lessonPage(html, found[1]) : html;
      },
    },
  };
}
