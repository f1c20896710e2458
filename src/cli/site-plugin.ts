/** What the built site carries beside its code: a content security policy, and the notices of what it is made with. */
import type { Plugin } from "vite";
import { notices, runtimePackages, unnoticed } from "./notices.ts";

/**
 * Scripts, styles and workers of the site alone; no eval, no inline script or style element. Style attributes stay allowed: the parts
 * set widths and colours with them. Captures may be fetched from their public homes over https.
 */
const POLICY = [
  "default-src 'self'",
  "script-src 'self'",
  "style-src 'self'",
  "style-src-attr 'unsafe-inline'",
  "img-src 'self' data: blob:",
  "font-src 'self' data:",
  "worker-src 'self'",
  "connect-src 'self' https: blob: data:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

/** In built pages only: the development server needs inline styles. */
export function siteSafety(): Plugin {
  return {
    name: "stepwright-site",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler: (html) => ({
        // Pages without an origin may load style sheets of a host without CORS headers, as long as they do not ask for them.
        html: html.replaceAll('rel="stylesheet" crossorigin', 'rel="stylesheet"'),
        tags: [
          {
            tag: "meta",
            attrs: { "http-equiv": "Content-Security-Policy", content: POLICY },
            injectTo: "head-prepend",
          },
        ],
      }),
    },
    generateBundle() {
      this.emitFile({
        type: "asset",
        fileName: "THIRD-PARTY-NOTICES.txt",
        source: notices(runtimePackages(process.cwd())),
      });
    },
  };
}

/** A build that takes in a package without a notice fails: for the pages, and for the workers, which are bundles of their own. */
export function noticeAll(): Plugin {
  return {
    name: "stepwright-notices",
    apply: "build",
    generateBundle() {
      const strangers = unnoticed(this.getModuleIds(), runtimePackages(process.cwd()));
      if (strangers.length > 0)
        this.error(
          `${strangers.join(", ")}: built in, but not among the packages of package.json's sitePackages.`,
        );
    },
  };
}
