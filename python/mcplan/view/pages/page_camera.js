// Where the drawing is seen from: as near as all of it fits into what caption and timeline leave of the window.
"use strict";
// World coordinates are z up, three.js' are y up.
const up = ([x, y, z]) => new THREE.Vector3(x, z, -y);
const points = settings.points.map(up);
const bounds = new THREE.Box3().setFromPoints(points);
const centre = bounds.getCenter(new THREE.Vector3());
const radius = 0.5 * bounds.getSize(new THREE.Vector3()).length();
let moved = false; // by the user: then the window's size no longer turns the view back

// Parts of the window that neither panel covers, [left, top, right, bottom] in pixels: beside the caption and below it.
function rooms() {
  const [h, gap] = [window.innerHeight, 12]; // a line of text reaches so far beyond its point
  const maps = document.getElementById("maps");
  const w = maps ? maps.getBoundingClientRect().left : window.innerWidth;
  const bar = document.getElementById("timeline");
  const low = bar ? bar.getBoundingClientRect().top : h;
  const panel = document.getElementById("caption").getBoundingClientRect();
  const found = [[panel.right + gap, gap, w - gap, low - 2 * gap], [gap, panel.bottom + gap, w - gap, low - 2 * gap]];
  const wide = found.filter(([l, t, r, b]) => r - l > 60 && b - t > 60);
  return wide.length ? wide : [[gap, gap, w - gap, Math.max(low, 80) - gap]];
}

// Distance from the middle of the points, and how far beside it, for a camera whose axis meets the middle of a room.
function fitted([left, top, right, bottom], [toRight, above, back], tangent) {
  const half = [((right - left) / window.innerHeight) * tangent, ((bottom - top) / window.innerHeight) * tangent];
  const seen = points.map((p) => p.clone().sub(centre)).map((d) => [d.dot(toRight), d.dot(above), d.dot(back)]);
  const nearest = seen.reduce((most, p) => Math.max(most, p[2]), -Infinity);
  const shifts = (distance) => [0, 1].map((i) => {
    let [low, high] = [-Infinity, Infinity];
    for (const p of seen) {
      low = Math.max(low, p[i] - half[i] * (distance - p[2]));
      high = Math.min(high, p[i] + half[i] * (distance - p[2]));
    }
    return low <= high ? 0.5 * (low + high) : NaN;
  });
  const fits = (distance) => shifts(distance).every((s) => !Number.isNaN(s));
  let [near, far] = [nearest, nearest + radius];
  while (!fits(far) && far < 1e6 * radius) far = nearest + 2 * (far - nearest);
  for (let i = 0; i < 40; i++) {
    const middle = 0.5 * (near + far);
    if (fits(middle)) far = middle;
    else near = middle;
  }
  return { distance: far, shift: shifts(far), room: [left, top, right, bottom] };
}

function frame() {
  const camera = viewer.camera;
  camera.fov = 24;
  const back = up(settings.direction).normalize();
  const toRight = new THREE.Vector3(0, 1, 0).cross(back).normalize();
  const above = back.clone().cross(toRight);
  const tangent = Math.tan((camera.fov * Math.PI) / 360);
  const best = rooms().map((room) => fitted(room, [toRight, above, back], tangent)).reduce((a, b) => (b.distance < a.distance ? b : a));
  const [left, top, right, bottom] = best.room;
  const [w, h] = [window.innerWidth, window.innerHeight];
  camera.aspect = w / h;
  camera.setViewOffset(w, h, 0.5 * (w - left - right), 0.5 * (h - top - bottom), w, h);
  if (!moved) {
    const target = centre.clone().addScaledVector(toRight, best.shift[0]).addScaledVector(above, best.shift[1]);
    camera.position.copy(target).addScaledVector(back, best.distance);
    viewer.controls.target.copy(target);
    camera.near = 0.004 * best.distance; // both by the drawing's size: robots may be millimetres or metres tall
    camera.far = 20 * (best.distance + radius);
  }
  camera.updateProjectionMatrix();
  viewer.controls.update();
  viewer.set_dirty();
}

function light() {
  viewer.set_property(["Lights", "AmbientLight", "<object>"], "intensity", 0.62);
  viewer.set_property(["Lights", "FillLight", "<object>"], "intensity", 0.16);
  const sun = new THREE.DirectionalLight(0xffffff, 0.42);
  const from = up(settings.sun).normalize().multiplyScalar(3 * radius).add(centre);
  const world = (v) => new THREE.Vector3(v.x, -v.z, v.y); // lights hang in the scene's frame
  sun.position.copy(world(from));
  sun.target.position.copy(world(centre));
  sun.castShadow = true;
  sun.shadow.mapSize.set(4096, 4096);
  const near = radius;
  Object.assign(sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near, far: 6 * radius });
  sun.shadow.bias = -0.0006;
  sun.shadow.radius = 3;
  viewer.scene.add(sun, sun.target);
}
