/** XML as far as test cases need it: elements and their text. */

export interface XmlNode {
  name: string;
  text: string;
  children: XmlNode[];
  line: number;
}

/** What is wrong with a case: file, line, and one sentence. */
export class CaseError extends Error {
  override name = "CaseError";
}

/**
 * Elements and text of an XML document; attributes, comments and processing instructions are passed over.
 *
 * @throws CaseError for what is not well formed; document types and entities of one's own are refused.
 */
export function parseXml(text: string, file: string): XmlNode {
  const root: XmlNode = { name: "", text: "", children: [], line: 1 };
  const stack: XmlNode[] = [root];
  let at = 0;
  let line = 1;
  const fail = (what: string): never => {
    throw new CaseError(`${file}, line ${line}: ${what}`);
  };
  const moveTo = (to: number): void => {
    for (let i = at; i < to; i++) if (text.charCodeAt(i) === 10) line++;
    at = to;
  };
  while (at < text.length) {
    const open = text.indexOf("<", at);
    const chunk = text.slice(at, open < 0 ? text.length : open);
    if (/&(?!(lt|gt|amp|quot|apos|#\d+);)/.test(chunk)) fail("an entity that is not known.");
    stack[stack.length - 1].text += chunk;
    if (open < 0) {
      moveTo(text.length);
      break;
    }
    moveTo(open);
    const skip = (start: string, end: string): boolean => {
      if (!text.startsWith(start, at)) return false;
      const stop = text.indexOf(end, at + start.length);
      if (stop < 0) fail(`${start} is not closed.`);
      moveTo(stop + end.length);
      return true;
    };
    if (skip("<!--", "-->") || skip("<?", "?>")) continue;
    if (text.startsWith("<!", at)) fail("document types and entities are not read.");
    const close = text.indexOf(">", at);
    if (close < 0) fail("a tag is not closed.");
    const inside = text.slice(at + 1, close);
    if (inside.startsWith("/")) {
      const node = stack.pop() as XmlNode;
      const name = localName(inside.slice(1));
      if (stack.length === 0 || node.name !== name)
        fail(`</${name.slice(0, 30)}> closes <${node.name.slice(0, 30)}>.`);
    } else {
      const name = localName(inside.replace(/\/$/, ""));
      if (!/^[A-Za-z_][\w.-]*$/.test(name)) fail("a tag without a name.");
      const node: XmlNode = { name, text: "", children: [], line };
      stack[stack.length - 1].children.push(node);
      if (!inside.endsWith("/")) stack.push(node);
      if (stack.length > 100) fail("elements are nested too deep.");
    }
    moveTo(close + 1);
  }
  if (stack.length > 1) fail(`<${stack[stack.length - 1].name}> is not closed.`);
  const first = root.children[0];
  if (!first) fail("no element was found.");
  return first;
}

const localName = (tag: string): string => (tag.trim().split(/\s/)[0] ?? "").replace(/^.*:/, "");
