// Finds headings while one types. The pages need it for nothing else.
"use strict";
const top_ = document.currentScript.dataset.top;
const input = document.getElementById("find");
const found = document.getElementById("found");
const contents = document.getElementById("contents");
let loading = null;

// Every word has to be in the heading or the page's name; those whose heading has them all come first.
function matching(words) {
  const fits = (text) => words.every((word) => text.includes(word));
  const hits = tartanHeadings.filter(([, , heading, page]) => fits((heading + " " + page).toLowerCase()));
  return [...hits.filter((hit) => fits(hit[2].toLowerCase())), ...hits.filter((hit) => !fits(hit[2].toLowerCase()))].slice(0, 40);
}

function show() {
  const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
  found.replaceChildren();
  contents.hidden = words.length > 0;
  for (const [page, anchor, heading, title] of words.length ? matching(words) : []) {
    const link = document.createElement("a");
    link.href = top_ + "/" + page + (anchor ? "#" + anchor : "");
    link.append(heading);
    if (title !== heading) {
      const under = document.createElement("small");
      under.append(title);
      link.append(under);
    }
    const item = document.createElement("li");
    item.append(link);
    found.append(item);
  }
  if (words.length && !found.childElementCount) found.append(Object.assign(document.createElement("li"), {textContent: "no heading has that"}));
}

document.querySelector(".find").hidden = false;
// A script, not a fetch: pages may be read as files.
function load() {
  return (loading ??= new Promise((done) => {
    const script = document.createElement("script");
    script.src = top_ + "/headings.js";
    script.onload = done;
    document.head.append(script);
  }));
}

input.addEventListener("input", () => load().then(show));
