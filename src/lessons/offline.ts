/** The embed page and the lessons in one classic script, for pages that may not load modules: each starts only on its own page. */
import "../embed/frame.ts";
import "./main.ts";
