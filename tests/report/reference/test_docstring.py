"""Docstrings as HTML: what is text stays text, sections become lists."""

from __future__ import annotations

from mckibben.report.reference.docstring import rendered


def anchors(name: str) -> str | None:
    return {"Model.force": "Model.force", "force": "Model.force"}.get(name)


def test_markup_in_a_docstring_is_text() -> None:
    page = rendered("A <script>alert(1)</script> & `<b>` and ``a < b``.", anchors)
    assert page == (
        "<p>A &lt;script&gt;alert(1)&lt;/script&gt; &amp; <code>&lt;b&gt;</code> "
        "and <code>a &lt; b</code>.</p>"
    )


def test_a_name_with_an_entry_is_a_link() -> None:
    assert rendered("See `force`, not ``force`` or `mass`.", anchors) == (
        '<p>See <a href="#Model.force"><code>force</code></a>, not <code>force</code> or '
        "<code>mass</code>.</p>"
    )


def test_arguments_are_a_list_with_their_whole_text() -> None:
    page = rendered(
        """First line.

        Args:
            pressure: gauge pressure, or
                a text.
            length, turns: of one thread.

        Raises:
            Problem: it cannot be.

        >>> 1 + 1
        2
        """,
        anchors,
    )
    assert page.index("First line.") < page.index("Args") < page.index("Raises") < page.index("&gt;&gt;&gt;")
    assert "<dt><code>pressure</code></dt><dd>gauge pressure, or a text.</dd>" in page
    assert "<dt><code>length, turns</code></dt><dd>of one thread.</dd>" in page
    assert "<dt><code>Problem</code></dt><dd>it cannot be.</dd>" in page
    assert "&gt;&gt;&gt; 1 + 1\n2</pre>" in page


def test_a_section_in_prose_is_prose() -> None:
    page = rendered("Text.\n\nReturns:\n    The tension: as an array.\n    Of floats.", anchors)
    assert "<p>The tension: as an array. Of floats.</p>" in page
