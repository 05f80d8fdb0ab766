/* Opens an address in the person's browser, as xdg-open chooses it. */
#ifndef TARTAN_STUDIO_SERVER_BROWSER_H
#define TARTAN_STUDIO_SERVER_BROWSER_H

/* Does not wait for it. If no browser opens, a note on standard error says so, now or when that is known. */
void tn_browser_open(const char *address);

#endif
