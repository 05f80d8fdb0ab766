declare module "tartan:words" {
  const words: Record<string, Record<string, string>>;
  export default words;
}
