// Timeline, buttons and keys, tied to meshcat's animator.
"use strict";
const SPEEDS = [0.1, 0.25, 0.5, 1, 2];

function player() {
  const animator = viewer.animator;
  const [play, tracks, cursor, speed] = ["play", "tracks", "cursor", "speed"].map((id) => document.getElementById(id));
  const [clock, phase] = ["clock", "phase"].map((id) => document.getElementById(id));
  const nows = document.querySelectorAll(".now"); // cursors of maps
  const end = settings.duration;
  const seek = (t) => {
    animator.pause();
    // At its very end an animation that repeats is at its start again.
    const at = Math.min(Math.max(t, 0), end * (1 - 1e-6));
    animator.seek(at);
    animator.display_progress(at);
  };
  const toggle = () => (animator.playing ? animator.pause() : animator.play());
  const frames = (n) => seek(Math.round(animator.time * settings.rate + n) / settings.rate);
  const phases = (n) => {
    const t = animator.time;
    const beyond = settings.knots.filter((k) => (n > 0 ? k > t + 1e-3 : k < t - 1e-3));
    seek(beyond.length ? beyond[n > 0 ? 0 : beyond.length - 1] : n > 0 ? end : 0);
  };
  const pace = (value) => {
    animator.mixer.timeScale = value;
    speed.value = String(value);
  };
  const faster = (n) => pace(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, SPEEDS.indexOf(Number(speed.value)) + n))]);
  const keys = {
    " ": toggle,
    ArrowRight: (event) => (event.shiftKey ? phases(1) : frames(1)),
    ArrowLeft: (event) => (event.shiftKey ? phases(-1) : frames(-1)),
    ArrowDown: () => phases(1),
    ArrowUp: () => phases(-1),
    Home: () => seek(0),
    End: () => seek(end),
    "+": () => faster(1),
    "-": () => faster(-1),
  };
  document.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key](event);
  });
  const bind = (id, action) => {
    document.getElementById(id).onclick = (event) => {
      event.currentTarget.blur(); // else the space bar would press it again
      action();
    };
  };
  bind("play", toggle);
  bind("before", () => phases(-1));
  bind("after", () => phases(1));
  speed.onchange = () => {
    pace(Number(speed.value));
    speed.blur();
  };
  const scrub = (event) => {
    const box = tracks.getBoundingClientRect();
    seek((end * (event.clientX - box.left)) / box.width);
  };
  tracks.onpointerdown = (event) => {
    tracks.setPointerCapture(event.pointerId);
    scrub(event);
  };
  tracks.onpointermove = (event) => {
    if (event.buttons) scrub(event);
  };
  if (hash.has("speed")) pace(Number(hash.get("speed")));
  if (hash.has("t")) seek(Number(hash.get("t")));
  return () => {
    const t = animator.time;
    const number = settings.knots.filter((k) => k <= t + 1e-9).length;
    const count = settings.knots.length - 1;
    cursor.style.left = `${(100 * t) / end}%`;
    for (const now of nows) now.style.left = cursor.style.left;
    play.textContent = animator.playing ? "\u275A\u275A" : "\u25B6\uFE0E";
    clock.textContent = `${t.toFixed(2)} / ${end.toFixed(2)} s`;
    phase.textContent = count > 0 ? `phase ${Math.min(Math.max(number, 1), count)} of ${count}` : "";
  };
}
