"use strict";
const settings = JSON.parse(document.getElementById("settings").textContent);
const hash = new Map(location.hash.slice(1).split("&").map((part) => part.split("=")));
const pane = document.getElementById("pane");
const failed = (why) => {
  const text = document.createElement("p");
  text.className = "failed";
  text.textContent = `This page cannot be drawn here: ${why}.`;
  pane.replaceChildren(text);
};
if (typeof DecompressionStream === "undefined") failed("the browser is older than 2023");
window.addEventListener("error", (event) => {
  if (!document.body.dataset.ready) failed(/webgl/i.test(event.message) ? "WebGL is missing or switched off" : event.message);
});
const viewer = new MeshCat.Viewer(pane);
const THREE = MeshCat.THREE;
