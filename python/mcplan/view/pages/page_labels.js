// Texts at points of the drawing, and the small axes in the caption; both follow the camera.
"use strict";
const AXES = ["#c8102e", "#1a8f3c", "#1f5fd1"];
const hidden = new Set(); // kinds of labels that the legend has switched off
const tags = settings.labels.map(({ text, places, kind, colour }) => {
  const node = document.createElement("span");
  node.textContent = text;
  node.title = text;
  node.className = `tag ${kind}`;
  node.style.color = colour;
  document.getElementById("labels").append(node);
  return { node, kind, places: places.map(up), width: 0, height: 0 };
});
// Who comes first is placed first.
const RANK = { scale: 0, axis: 1, start: 2, goal: 2, surface: 3 };
tags.sort((a, b) => RANK[a.kind] - RANK[b.kind]);

function measureLabels() {
  for (const tag of tags) [tag.width, tag.height] = [tag.node.offsetWidth, tag.node.offsetHeight];
}

function onScreen(point) {
  const p = point.clone().project(viewer.camera);
  return Math.abs(p.z) > 1 ? null : [0.5 * (1 + p.x) * window.innerWidth, 0.5 * (1 - p.y) * window.innerHeight];
}

// Rectangles around the parts of robots: what names keep away from.
function robots() {
  const found = [];
  for (const path of [["robot"], ["stances"]]) {
    viewer.scene_tree.find(["meshcat", ...path]).object.traverse((node) => {
      if (!node.isMesh) return;
      if (!node.geometry.boundingBox) node.geometry.computeBoundingBox();
      const { min, max } = node.geometry.boundingBox;
      const rect = [Infinity, Infinity, -Infinity, -Infinity];
      for (let i = 0; i < 8; i++) {
        const corner = new THREE.Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
        const at = onScreen(corner.applyMatrix4(node.matrixWorld));
        if (!at) return;
        rect[0] = Math.min(rect[0], at[0]);
        rect[1] = Math.min(rect[1], at[1]);
        rect[2] = Math.max(rect[2], at[0]);
        rect[3] = Math.max(rect[3], at[1]);
      }
      found.push(rect);
    });
  }
  return found;
}

const meet = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

function placeLabels() {
  const shown = tags.filter((tag) => !hidden.has(tag.kind));
  for (const tag of tags) if (hidden.has(tag.kind)) tag.node.style.visibility = "hidden";
  if (!shown.length) return;
  const taken = [];
  for (const panel of document.querySelectorAll(".panel")) {
    const { left, top, right, bottom } = panel.getBoundingClientRect();
    taken.push([left, top, right, bottom]);
  }
  const bodies = robots();
  for (const tag of shown) {
    const firm = tag.kind === "axis" || tag.kind === "scale"; // stands where it stands
    let rect = null;
    for (const place of tag.places) {
      const at = onScreen(place);
      if (!at) continue;
      const below = tag.kind === "surface" || tag.kind === "scale" ? 3 : -0.5 * tag.height;
      const tried = [at[0] - 0.5 * tag.width, at[1] + below, at[0] + 0.5 * tag.width, at[1] + below + tag.height];
      const inside = tried[0] > 0 && tried[1] > 0 && tried[2] < window.innerWidth && tried[3] < window.innerHeight;
      const free = !taken.some((r) => meet(r, tried)) && (firm || !bodies.some((r) => meet(r, tried)));
      if (inside && free) {
        rect = tried;
        break;
      }
    }
    tag.node.style.visibility = rect ? "visible" : "hidden";
    if (!rect) continue;
    taken.push(rect);
    tag.node.style.transform = `translate(${rect[0].toFixed(1)}px, ${rect[1].toFixed(1)}px)`;
  }
}

function turnGizmo() {
  const inverse = viewer.camera.quaternion.clone().invert();
  const axes = settings.axes.map((name, i) => {
    const d = up([+(i === 0), +(i === 1), +(i === 2)]).applyQuaternion(inverse);
    return { name, colour: AXES[i], x: 23 + 15 * d.x, y: 23 - 15 * d.y, tx: 23 + 20 * d.x, ty: 23 - 20 * d.y, depth: d.z };
  });
  axes.sort((a, b) => a.depth - b.depth); // the farthest first
  const gizmo = document.getElementById("gizmo");
  gizmo.innerHTML = axes.filter((a) => a.name).map((a) =>
    `<line x1="23" y1="23" x2="${a.x.toFixed(1)}" y2="${a.y.toFixed(1)}" stroke="${a.colour}" stroke-width="2"/>` +
    (Math.hypot(a.x - 23, a.y - 23) < 5 ? "" : `<text x="${a.tx.toFixed(1)}" y="${a.ty.toFixed(1)}" fill="${a.colour}">${a.name}</text>`)).join(""); // one that points at the reader has no room for its name
}

let last = "";
function follow(time) {
  const camera = viewer.camera;
  const now = [...camera.matrixWorld.elements, ...camera.projectionMatrix.elements, time, [...hidden]].join();
  if (now === last) return;
  last = now;
  turnGizmo();
  placeLabels();
}
