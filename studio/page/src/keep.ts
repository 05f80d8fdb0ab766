// Gives a text to whoever is at the page, as a file among the downloads.
export function keep(text: string, name: string): void {
  const address = URL.createObjectURL(new Blob([text], {type: "text/plain"}));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  URL.revokeObjectURL(address);
}
