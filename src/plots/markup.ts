/** Texts of others in markup: names of files, tasks and styles. */

/** A text as markup shows it, in elements and in quoted attributes. Plots are strings of markup: whatever text they are given goes through here. */
export const safe = (text: string): string => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
