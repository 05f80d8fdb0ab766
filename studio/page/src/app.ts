// The page that `tartan studio` serves. Its token comes in the address, behind #, and is taken out of it at once; it is
// kept for this window, so that it can be loaded again.
import {Studio} from "./studio";
import {SocketTransport} from "./transport";

const TOKEN = /^#([0-9a-f]{32})$/;

function takeToken(): string | null {
  const token = TOKEN.exec(location.hash)?.[1] ?? null;
  if (token) {
    sessionStorage.setItem("tartan.token", token);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return token;
}

const token = takeToken() ?? sessionStorage.getItem("tartan.token") ?? "";
const transport = new SocketTransport(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`, token);
new Studio(transport);
transport.open();

window.addEventListener("hashchange", () => {
  const renewed = takeToken();
  if (renewed) transport.renew(renewed);
});
