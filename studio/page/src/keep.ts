// Gives a text, or bytes, to whoever is at the page, as a file among the downloads.
export function keep(content: BlobPart, name: string): void {
  const address = URL.createObjectURL(new Blob([content], {type: typeof content === "string" ? "text/plain" : "application/octet-stream"}));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  URL.revokeObjectURL(address);
}
