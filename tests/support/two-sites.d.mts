export interface Site {
  origin: string;
  port: number;
  stop(): Promise<void>;
}
export function serve(
  folder: string,
  base: string,
  pages?: Record<string, { html: string; policy: string }>,
  headers?: Record<string, string>,
): Promise<Site>;
