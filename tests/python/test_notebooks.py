"""How notebooks show plans and results."""

from __future__ import annotations

import base64
import re

import pytest

import mcplan as mp


@pytest.mark.parametrize("kind", ["ddp", "sip"])
def test_a_notebook_shows_the_picture_and_the_report(kind):
    pytest.importorskip("matplotlib")
    result = mp.plan("flat") if kind == "ddp" else mp.sip.plan("cartwheel", minimise="none")
    text = result._repr_html_()
    assert str(result.report).splitlines()[0] in text
    found = re.search(r'src="data:image/png;base64,([^"]+)"', text)
    assert found and base64.b64decode(found[1]).startswith(b"\x89PNG") and len(found[1]) > 10_000
    assert result.plan._repr_html_() in text


def test_what_cannot_be_drawn_is_named():
    assert mp.Plan()._repr_html_().startswith("<pre>&lt;Plan of")


def test_without_matplotlib_it_says_what_to_install(monkeypatch):
    def missing(*_):
        raise mp.MissingExtra("mcplan.view.picture needs matplotlib: pip install 'mcplan[view]'")

    monkeypatch.setattr("mcplan.showing.save_picture", missing)
    text = mp.Plan()._repr_html_()
    assert "pip install" in text and "<img" not in text
