/** What the tests use of gltf-validator, which has no types of its own. */
declare module "gltf-validator" {
  export interface Report {
    issues: {
      numErrors: number;
      messages: { code: string; message: string; severity: number; pointer?: string }[];
    };
  }
  const validator: { validateBytes(data: Uint8Array): Promise<Report> };
  export default validator;
}
