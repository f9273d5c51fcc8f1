// Fills the meshcat viewer from the commands above, frames the scene, and ties the timeline to meshcat's animator.
"use strict";
const settings = JSON.parse(document.getElementById("settings").textContent);
const viewer = new MeshCat.Viewer(document.getElementById("pane"));
const THREE = MeshCat.THREE;
const hash = new Map(location.hash.slice(1).split("&").map((part) => part.split("=")));
if (hash.has("bare")) document.body.classList.add("bare");

for (const corner of ["top_color", "bottom_color"]) viewer.set_property(["Background"], corner, [1, 1, 1]);
for (const path of [["Grid"], ["Axes"], ["Lights", "PointLightNegativeX"], ["Lights", "PointLightPositiveX"]])
  viewer.set_property(path, "visible", false);

// World coordinates are z up, three.js' are y up.
const up = ([x, y, z]) => new THREE.Vector3(x, z, -y);
const points = settings.points.map(up);
const box = new THREE.Box3().setFromPoints(points);
const centre = box.getCenter(new THREE.Vector3());
const radius = 0.5 * box.getSize(new THREE.Vector3()).length();

function light() {
  viewer.set_property(["Lights", "AmbientLight", "<object>"], "intensity", 0.62);
  viewer.set_property(["Lights", "FillLight", "<object>"], "intensity", 0.16);
  const sun = new THREE.DirectionalLight(0xffffff, 0.42);
  const from = up(settings.sun).normalize().multiplyScalar(3 * radius).add(centre);
  const world = (v) => new THREE.Vector3(v.x, -v.z, v.y);  // lights hang in the scene's frame
  sun.position.copy(world(from));
  sun.target.position.copy(world(centre));
  sun.castShadow = true;
  sun.shadow.mapSize.set(4096, 4096);
  Object.assign(sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 6 * radius });
  sun.shadow.bias = -0.0006;
  sun.shadow.radius = 3;
  viewer.scene.add(sun, sun.target);
}

// The nearest camera along the given direction that sees every point, clear of caption and timeline.
function frame() {
  const camera = viewer.camera;
  camera.fov = 24;
  const back = up(settings.direction).normalize();
  const right = new THREE.Vector3(0, 1, 0).cross(back).normalize();
  const above = back.clone().cross(right);
  const tangent = Math.tan((camera.fov * Math.PI) / 360);
  const aspect = window.innerWidth / window.innerHeight;
  const bar = document.getElementById("timeline");
  const low = 1 - (2 * ((bar ? bar.offsetHeight : 0) + 24)) / window.innerHeight;  // share of the half height left below
  const rise = 0.5 * (1 - low);
  let distance = 0;
  for (const p of points) {
    const d = p.clone().sub(centre);
    const near = d.dot(back);
    distance = Math.max(distance, Math.abs(d.dot(right)) / (0.94 * tangent * aspect) + near,
                        Math.abs(d.dot(above)) / (0.94 * tangent * (1 - rise)) + near);
  }
  const target = centre.clone().addScaledVector(above, -rise * distance * tangent);
  camera.position.copy(target).addScaledVector(back, distance);
  viewer.controls.target.copy(target);
  viewer.controls.update();
  viewer.set_dirty();
}

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
  for (const name of ["paths", "forces", "com"]) viewer.scene_tree.find(["meshcat", name]).object.traverse((node) => { node.castShadow = false; });
  viewer.set_dirty();
}

function run() {
  const animator = viewer.animator;
  const play = document.getElementById("play");
  const tracks = document.getElementById("tracks");
  const cursor = document.getElementById("cursor");
  const seek = (t) => { animator.pause(); animator.seek(t); animator.display_progress(t); };
  const toggle = () => (animator.playing ? animator.pause() : animator.play());
  play.onclick = toggle;
  document.addEventListener("keydown", (event) => { if (event.key === " ") { event.preventDefault(); toggle(); } });
  const scrub = (event) => {
    const bounds = tracks.getBoundingClientRect();
    seek(settings.duration * Math.min(1, Math.max(0, (event.clientX - bounds.left) / bounds.width)));
  };
  tracks.onpointerdown = (event) => { tracks.setPointerCapture(event.pointerId); scrub(event); };
  tracks.onpointermove = (event) => { if (event.buttons) scrub(event); };
  if (hash.has("t")) seek(Number(hash.get("t")));
  (function show() {
    cursor.style.left = `${(100 * animator.time) / settings.duration}%`;
    play.innerHTML = `<b>${animator.playing ? "&#10074;&#10074;" : "&#9654;"}</b> ${animator.time.toFixed(2)} / ${settings.duration.toFixed(2)} s`;
    requestAnimationFrame(show);
  })();
}

for (const input of document.querySelectorAll("#caption input"))
  input.onchange = () => {
    for (const path of input.dataset.nodes.split(" ")) viewer.set_property(["meshcat", ...path.split("/")], "visible", input.checked);
    viewer.set_dirty();
  };
window.addEventListener("resize", frame);
light();
frame();
requestAnimationFrame(frame);
unpack().then(() => { if (settings.duration > 0) run(); document.body.dataset.ready = "yes"; });
