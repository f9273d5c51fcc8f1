// Fills the viewer from the commands above and ties it to caption, labels and timeline.
"use strict";
if (hash.has("bare")) document.body.classList.add("bare");
if (hash.has("menu")) document.body.classList.add("menu"); // meshcat's own

for (const corner of ["top_color", "bottom_color"]) viewer.set_property(["Background"], corner, [1, 1, 1]);
for (const path of [["Grid"], ["Axes"], ["Lights", "PointLightNegativeX"], ["Lights", "PointLightPositiveX"]])
  viewer.set_property(path, "visible", false);

async function unpack() {
  const raw = Uint8Array.from(atob(document.getElementById("commands").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("gzip"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const view = new DataView(bytes.buffer);
  for (let at = 0; at < bytes.length;) {
    const size = view.getUint32(at, true);
    viewer.handle_command_bytearray(bytes.slice(at + 4, at + 4 + size));
    at += 4 + size;
  }
  viewer.scene.traverse((node) => {
    if (node.isLine || (node.material && node.material.transparent)) node.castShadow = false;
  });
  for (const name of ["paths", "forces", "com", "axes", "scale", "normals"])
    viewer.scene_tree.find(["meshcat", name]).object.traverse((node) => { node.castShadow = false; });
  viewer.set_dirty();
}

// What an entry of the legend stands for: nodes of the drawing, or with a colon kinds of labels.
function show(input) {
  for (const path of input.dataset.nodes.split(" ")) {
    if (path.startsWith(":")) hidden[input.checked ? "delete" : "add"](path.slice(1));
    else viewer.set_property(["meshcat", ...path.split("/")], "visible", input.checked);
  }
  viewer.set_dirty();
}

function panels() {
  const caption = document.getElementById("caption");
  const fold = document.getElementById("fold");
  const set = (folded) => {
    caption.classList.toggle("folded", folded);
    fold.textContent = folded ? "\u2630" : "\u2715";
    fold.setAttribute("aria-expanded", String(!folded));
    frame();
  };
  fold.onclick = () => {
    fold.blur();
    set(!caption.classList.contains("folded"));
  };
  set(hash.has("folded") || window.innerWidth <= 700 || window.innerHeight <= 480);
  const joints = jointMaps();
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "l") fold.onclick();
    if (event.key === "j") joints();
    if (event.key === "r") { moved = false; frame(); }
  });
}

// The panel of a motion's joints, if there is one: what folds and unfolds it.
function jointMaps() {
  const maps = document.getElementById("maps");
  if (!maps) return () => {};
  document.getElementById("joints").hidden = false;
  const fold = document.getElementById("foldmaps");
  const set = (folded) => {
    maps.classList.toggle("folded", folded);
    fold.textContent = folded ? "\u25A4" : "\u2715";
    fold.setAttribute("aria-expanded", String(!folded));
    frame();
  };
  fold.onclick = () => {
    fold.blur();
    set(!maps.classList.contains("folded"));
  };
  set(hash.has("folded") || window.innerWidth <= 1000 || window.innerHeight <= 480);
  return fold.onclick;
}

function start() {
  let playing = () => {};
  for (const input of document.querySelectorAll("#caption input")) input.onchange = () => show(input);
  viewer.controls.addEventListener("start", () => { moved = true; });
  window.addEventListener("resize", frame); // after the viewer's own, which was there before
  light();
  panels();
  measureLabels();
  requestAnimationFrame(frame);
  unpack().then(() => {
    for (const input of document.querySelectorAll("#caption input:not(:checked)")) show(input);
    if (settings.duration > 0) playing = player();
    frame();
    (function each() {
      playing();
      follow(viewer.animator.time);
      requestAnimationFrame(each);
    })();
    document.body.dataset.ready = "yes";
  });
}
start();
