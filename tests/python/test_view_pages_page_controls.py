"""Pages in a browser: keys, buttons and speeds, panels that cover nothing, names that stay names."""

import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.view import show, show_scene
from mcplan.view.pages.snapshot import find_browser

pytest.importorskip("meshcat")
pytestmark = pytest.mark.skipif(find_browser() is None, reason="needs Chromium")

#: What is asked of a page once it is drawn: the script's last value, as JSON in the title.
ASK = """<script>
(function wait() {
  if (!document.body.dataset.ready) return setTimeout(wait, 50);
  setTimeout(() => { document.title = "answer:" + JSON.stringify((() => { %s })()); }, 300);
})();
const key = (key, more) => document.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, ...more }));
const time = () => viewer.animator.time;
const box = (node) => { const r = node.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; };
</script></body>"""


def ask(page, script, size=(1280, 860), fragment="t=0"):
    """What a script says inside of a page."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "page.html"
        html = page.html()
        file.write_text(html[: html.rindex("</body>")] + ASK % script + "</html>", encoding="utf-8")
        command = [find_browser(), "--headless=new", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=6000"]
        command += [f"--window-size={size[0]},{size[1]}", f"--user-data-dir={folder}/profile", "--dump-dom"]
        found = subprocess.run(
            [*command, f"{file.as_uri()}#{fragment}"], capture_output=True, text=True, timeout=120, check=True
        ).stdout
        shutil.rmtree(f"{folder}/profile", ignore_errors=True)
    return json.loads(re.search(r"<title>answer:(.*?)</title>", found, re.DOTALL)[1].replace("&lt;", "<"))


@pytest.fixture(scope="module")
def plan():
    return by_hand.walk(by_hand.stairs(), by_hand.humanoid())


@pytest.fixture(scope="module")
def page(plan):
    return show(plan)


def test_keys_step_by_frames_and_phases_and_change_the_speed(plan, page):
    said = ask(
        page,
        """
        const said = [];
        for (const [name, more] of [["ArrowRight"], ["ArrowRight"], ["ArrowLeft"], ["ArrowRight", { shiftKey: true }],
             ["ArrowDown"], ["ArrowUp"], ["End"], ["ArrowRight"], ["Home"], ["ArrowLeft"]]) {
          key(name, more);
          said.push(time());
        }
        const speeds = [];
        for (const name of "----+++++") {
          key(name);
          speeds.push(viewer.animator.mixer.timeScale);
        }
        key(" "); const plays = viewer.animator.playing; key(" "); const rests = viewer.animator.playing;
        document.getElementById("after").click(); said.push(time());
        return { said, speeds, plays, rests };
        """,
    )
    knots, end = plan.knot_times(), plan.duration()
    expected = [1 / 30, 2 / 30, 1 / 30, knots[1], knots[2], knots[1], end, end, 0.0, 0.0, knots[1]]
    assert said["said"] == pytest.approx(expected, abs=1e-4)
    assert said["speeds"] == [0.5, 0.25, 0.1, 0.1, 0.25, 0.5, 1, 2, 2]
    assert (said["plays"], said["rests"]) == (True, False)


DRAWN = """
    const seen = points.map(onScreen);
    const [x, y] = [0, 1].map((i) => seen.map((p) => p[i]));
    const parts = robots();
    return {
      drawn: [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)],
      robot: [0, 1, 2, 3].map((i) => Math[i < 2 ? "min" : "max"](...parts.map((r) => r[i]))),
      caption: box(document.getElementById("caption")), timeline: box(document.getElementById("timeline")),
      folded: document.getElementById("caption").classList.contains("folded"), width: innerWidth,
      wide: document.documentElement.scrollWidth,
      buttons: [...document.querySelectorAll("#controls button")].map(box),
      texts: [...document.querySelectorAll("#axis span")].filter((s) => getComputedStyle(s).display !== "none").map(box),
    };
"""


def apart(a, b):
    return a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


@pytest.mark.parametrize("size", [(1280, 860), (500, 980), (980, 500)])
def test_panels_cover_neither_the_drawing_nor_the_robot(page, size):
    said = ask(page, DRAWN, size)
    drawn = said["drawn"]
    assert apart(drawn, said["caption"]) and apart(drawn, said["timeline"])
    assert apart(said["robot"], said["caption"]) and apart(said["robot"], said["timeline"])
    assert drawn[0] >= 0 and drawn[1] >= 0 and drawn[2] <= said["width"] + 1e-6
    small = size[0] <= 700 or size[1] - 150 <= 480
    assert said["folded"] == small
    assert said["wide"] <= said["width"]  # nothing to scroll to
    if small:
        assert min(b[2] - b[0] for b in said["buttons"]) >= 34  # wide enough for a thumb
    texts = sorted(said["texts"])
    assert all(a[2] <= b[0] for a, b in zip(texts[:-1], texts[1:], strict=True))


def test_a_legend_opened_on_a_phone_leaves_the_drawing_in_view(page):
    said = ask(page, 'document.getElementById("fold").click();' + DRAWN, (500, 980))
    assert not said["folded"]
    assert apart(said["drawn"], said["caption"]) and apart(said["drawn"], said["timeline"])


def test_pages_tell_phones_how_wide_they_are(page):
    assert '<meta name="viewport" content="width=device-width' in page.html()


SHOWN = """
    placeLabels();
    const shown = tags.filter((t) => t.node.style.visibility === "visible");
    return { shown: shown.map((t) => [t.kind, t.node.textContent, box(t.node)]), robot: robots(),
             panels: [...document.querySelectorAll(".panel")].map(box), gizmo: document.getElementById("gizmo").textContent };
"""


def test_scenes_show_names_axes_scale_start_and_goal_clear_of_the_robot():
    scene = mp.load_scene("gap_with_rail")
    said = ask(show_scene(scene, mp.load_robot("humanoid44")), SHOWN)
    texts = {(kind, text) for kind, text, _ in said["shown"]}
    assert texts >= {("surface", s.name) for s in scene.surfaces}
    assert texts >= {("start", "start"), ("goal", "goal"), ("scale", "1 m"), ("axis", "x"), ("axis", "z")}
    assert set(said["gizmo"]) >= {"x", "z"}
    rects = [rect for _, _, rect in said["shown"]]
    for i, rect in enumerate(rects):
        assert all(apart(rect, other) for other in rects[:i] + said["panels"])
    for kind, _, rect in said["shown"]:
        if kind in ("surface", "start", "goal"):
            assert all(apart(rect, part) for part in said["robot"])


def test_the_scale_bar_is_as_long_as_it_says():
    from page_contents import commands_of, floats

    commands = commands_of(show_scene(mp.load_scene("stairs"), mp.load_robot("humanoid44")).html())
    (bar,) = [c for c in commands if c.get("path") == "/meshcat/scale"]
    corners = floats(bar["object"]["geometries"][0]["data"]["attributes"]["position"]["array"]).reshape(-1, 3)
    far = max(np.linalg.norm(corners - corner, axis=1).max() for corner in corners)
    assert far == pytest.approx(1.0, rel=0.02)


def test_normals_are_outward():
    from page_contents import commands_of, floats

    scene = mp.load_scene("chimney")
    commands = commands_of(show_scene(scene).html())
    (arrows,) = [c for c in commands if c.get("path") == "/meshcat/normals"]
    corners = floats(arrows["object"]["geometries"][0]["data"]["attributes"]["position"]["array"]).reshape(-1, 3)
    each = corners.reshape(len(scene.surfaces), -1, 3)
    for surface, points in zip(scene.surfaces, each, strict=True):
        outline = np.asarray(surface.vertices_W)
        normal = np.cross(outline[1] - outline[0], outline[2] - outline[1])
        reach = (points - outline[0]) @ (normal / np.linalg.norm(normal))
        assert reach.max() > 0.05 and reach.min() > -0.02


HOSTILE = "</script><img src=x onerror=document.title='owned'> $title \u202e\u0645\u0631\u062d\u0628\u0627 '\"&/ a b"


def test_hostile_names_are_shown_and_do_nothing():
    scene = by_hand.stairs()
    robot = by_hand.humanoid()
    plan = by_hand.walk(scene, robot)
    scene, robot = plan.scene, plan.robot
    scene.name = scene.surfaces[0].name = HOSTILE
    robot.name = robot.end_effectors[0].name = HOSTILE
    page = show(plan, scene, robot)
    assert "<img src=x" not in page.html()
    said = ask(
        page,
        """
        hidden.clear(); placeLabels();
        const label = [...document.querySelectorAll("#caption label")].find((l) => l.textContent.includes("onerror"));
        const input = label.querySelector("input");
        const nodes = input.dataset.nodes.split(" ").map((p) => viewer.scene_tree.find(["meshcat", ...p.split("/")]).object);
        const filled = nodes.map((n) => { let k = 0; n.traverse((m) => { k += m.isMesh ? 1 : 0; }); return k; });
        input.click();
        return { filled, seen: nodes.map((n) => n.visible), images: document.images.length,
                 label: tags.map((t) => t.node.textContent).filter((t) => t.includes("onerror")) };
        """,
    )
    assert said["images"] == 0
    assert min(said["filled"]) >= 1 and not any(said["seen"])  # the legend finds what the name names
    assert len(said["label"]) == 1
