/** Numbers as the lessons write them: a true minus, as many places as are worth reading. */
export const fixed = (v: number, places: number): string => {
  const text = v.toFixed(places);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "\u2212");
};
