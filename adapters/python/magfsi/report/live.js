// SPDX-License-Identifier: GPL-2.0-or-later
// The page of a run that goes on: asks the server that it came from (./magfsi watch) for the run
// as it is now, the less often the longer an answer takes. Only there; a report has no server.

async function follow() {
  let known = "", wait = 1000;
  while (true) {
    const began = performance.now();
    try {
      const answer = await fetch(`data.json?known=${encodeURIComponent(known)}`);
      if (answer.status === 200) {
        known = answer.headers.get("ETag") || "";
        const runs = await answer.json(), p = runs[0].progress;
        show(runs);
        if (p) element("outcome").textContent = p;
        element("title").dataset.updates = 1 + Number(element("title").dataset.updates || 0);
        if (runs[0].ended) { element("outcome").textContent += "; this page is complete"; return; }
      } else if (answer.status !== 204) throw new Error(String(answer.status));
    } catch (fault) { element("outcome").textContent = `no answer from magfsi watch (${fault.message}); it may have ended`; }
    wait = Math.min(20000, Math.max(1000, 4 * (performance.now() - began)));
    await new Promise(done => setTimeout(done, wait));
  }
}
if (held.live) follow();
