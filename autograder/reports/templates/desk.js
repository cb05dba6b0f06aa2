"use strict";
// Marking by keyboard. Without it the form works as a form.
const form = document.getElementById("form");
if (form) {
  const points = document.getElementById("points");
  const comment = document.getElementById("comment");
  const said = document.getElementById("said");
  let stored = points.value + "\n" + comment.value;
  let queue = Promise.resolve(true);
  const send = async () => {
    const now = points.value + "\n" + comment.value;
    if (now === stored) { return true; }
    said.textContent = "storing";
    try {
      const answer = await fetch(form.action, {
        method: "POST",
        headers: { "Accept": "application/json", "Content-Type": "application/x-www-form-urlencoded" },
        body: new URLSearchParams({ points: points.value, comment: comment.value }),
      });
      const told = await answer.json();
      if (!told.stored) { said.textContent = told.reason; return false; }
      stored = now;
      said.textContent = points.value === "" ? "taken back" : "stored";
      document.getElementById("waiting").textContent = told.waiting;
      return true;
    } catch {
      said.textContent = "NOT stored: the desk does not answer; is it still running?";
      return false;
    }
  };
  const store = () => { queue = queue.then(send); return queue; };
  const go = async (id) => {
    if (points.value === "" && comment.value !== "") { said.textContent = "A comment needs points."; return; }
    if (await store()) { location.assign(document.getElementById(id).href); }
  };
  const keys = {
    n: () => go("after"), ArrowRight: () => go("after"),
    p: () => go("before"), ArrowLeft: () => go("before"),
    u: () => go("open"),
    c: () => comment.focus(),
    x: () => { points.value = ""; comment.value = ""; store(); },
    ".": () => { points.value = String(Math.floor(Number(points.value) || 0) + 0.5); store(); },
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) { return; }
    const typing = event.target === comment || event.target === points;
    if (typing) {
      if (event.key === "Escape") { event.target.blur(); store(); }
      return;
    }
    if (/^[0-9]$/.test(event.key)) {
      event.preventDefault();
      points.value = event.key;
      store();
    } else if (Object.hasOwn(keys, event.key)) {
      event.preventDefault();
      keys[event.key]();
    }
  });
  points.addEventListener("change", store);
  comment.addEventListener("change", () => { if (points.value !== "") { store(); } });
  form.addEventListener("submit", (event) => { event.preventDefault(); go("open"); });
}
