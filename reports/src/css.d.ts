// esbuild's text loader (package.json, "build").
declare module "*.css" {
  const text: string;
  export default text;
}
