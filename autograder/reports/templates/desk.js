"use strict";
document.documentElement.classList.add("scripted");
// Marking by keyboard. Without it the form works as a form.
const form = document.getElementById("form");
if (form) {
  const points = document.getElementById("points");
  const comment = document.getElementById("comment");
  const said = document.getElementById("said");
  const together = document.getElementById("together") || { checked: false };
  const earned = [...document.querySelectorAll(".earned button")];
  const used = [...document.querySelectorAll(".used button")];
  const most = Number(form.dataset.most);
  const state = () => [points.value, comment.value, together.checked].join("\n");
  const press = (button, on) => { button.setAttribute("aria-pressed", String(on)); };
  let stored = state();
  let queue = Promise.resolve(true);
  const send = async () => {
    const now = state();
    const fields = { points: points.value, comment: comment.value, ...(together.checked ? { together: "on" } : {}) };
    if (now === stored) { return true; }
    said.textContent = "storing";
    try {
      const answer = await fetch(form.action, {
        method: "POST",
        headers: { "Accept": "application/json", "Content-Type": "application/x-www-form-urlencoded" },
        body: new URLSearchParams(fields),
      });
      const told = await answer.json();
      if (!told.stored) { said.textContent = told.reason; return false; }
      stored = now;
      said.textContent = fields.points === "" ? "taken back" : "stored";
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
  const set = (value, pressed = []) => {
    points.value = value;
    earned.forEach((button) => press(button, pressed.includes(button)));
    store();
  };
  const toggle = (button) => {
    press(button, button.getAttribute("aria-pressed") !== "true");
    const pressed = earned.filter((one) => one.getAttribute("aria-pressed") === "true");
    const sum = pressed.reduce((all, one) => all + Number(one.dataset.points), 0);
    set(String(Math.min(most, Math.round(sum * 100) / 100)), pressed);
  };
  const reuse = (button) => {
    if (!button || comment.value.includes(button.dataset.comment)) { return; }
    comment.value = [comment.value, button.dataset.comment].filter(Boolean).join("\n");
    if (points.value === "") { said.textContent = "A comment needs points."; } else { store(); }
  };
  let before = { digit: "", time: 0 }; // two digits that follow each other are one number, where there are so many points
  const digit = (key) => {
    const now = Date.now();
    const both = before.digit + key;
    const joined = before.digit !== "" && now - before.time < 1500 && Number(both) <= most;
    before = { digit: joined ? "" : key, time: now };
    set(joined ? both : key);
  };
  let choosing = false; // after v, a digit chooses a comment
  const keys = {
    n: () => go("after"), ArrowRight: () => go("after"),
    p: () => go("before"), ArrowLeft: () => go("before"),
    u: () => go("open"),
    c: () => comment.focus(),
    g: () => { if ("click" in together) { together.click(); } },
    v: () => { choosing = used.length > 0; said.textContent = choosing ? "which comment?" : "no comment was used before"; },
    x: () => { comment.value = ""; set(""); },
    ".": () => set(String(Math.floor(Number(points.value) || 0) + 0.5)),
  };
  for (const button of earned) {
    keys[button.dataset.key] = () => toggle(button);
    button.addEventListener("click", () => toggle(button));
    press(button, points.value !== "" && Number(points.value) === most);
  }
  used.forEach((button) => button.addEventListener("click", () => reuse(button)));
  if ("click" in together) { together.addEventListener("change", () => { if (points.value !== "") { store(); } }); }
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) { return; }
    const typing = event.target === comment || event.target === points;
    if (typing) {
      if (event.key === "Escape") { event.target.blur(); store(); }
      return;
    }
    const chosen = choosing;
    choosing = false;
    if (/^[0-9]$/.test(event.key)) {
      event.preventDefault();
      if (chosen) { said.textContent = ""; reuse(used[Number(event.key) - 1]); } else { digit(event.key); }
    } else if (Object.hasOwn(keys, event.key)) {
      event.preventDefault();
      before = { digit: "", time: 0 };
      keys[event.key]();
    }
  });
  points.addEventListener("change", store);
  comment.addEventListener("change", () => { if (points.value !== "") { store(); } });
  form.addEventListener("submit", (event) => { event.preventDefault(); go("open"); });
}
