export const GUARDS: readonly {
  name: string;
  file: string;
  guard: string;
  without: string;
  tests: string;
  test: string;
}[];
