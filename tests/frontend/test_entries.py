"""A wrong rest length in a file: the page asks about it before it names effects, and takes the answer."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.comparing import choose, diagnosed, file, measured, use
from tests.frontend.diagnoses import remember
from tests.frontend.views import open_compare


def wrong() -> str:
    """A measurement with a prestress, whose muscle of 300 mm is said to have 345 mm."""
    return measured(1, points=20, c10=0.0, friction=0.0).replace(
        "nominal_length: 300 mm", "nominal_length: 345 mm"
    )


def test_a_wrong_rest_length_is_asked_about_and_used_in_one_click(page: Page) -> None:
    open_compare(page)
    remember(page)
    choose(page, file("sweeps.csv", wrong()))
    use(page)
    diagnosed(page, 180_000)
    asked = page.locator("#entry-questions")
    expect(asked).to_be_visible()
    expect(page.locator(".strip")).to_have_attribute("data-state", "context")
    expect(page.locator("#next-what")).to_have_text("Settle the rest length first")
    expect(page.locator(".found-missing")).to_have_count(0)  # no effect is ranked
    assert violations(page) == []
    first = asked.locator(".entry-doubt").first
    expect(first).to_have_attribute("data-hypothesis", "rest_length")
    expect(first).to_contain_text(re.compile(r"Rest length (299|300)[.\d]* mm instead of 345 mm"))
    with page.expect_request("**/api/diagnoses") as sent:
        first.get_by_role("button", name=re.compile("^Use (299|300)")).click()
    said = sent.value.post_data_json["measurements"][0]["experiment"]["rest_length"]
    assert said["origin"] == "suggested"
    diagnosed(page, 180_000)
    expect(asked).to_have_count(0)
    expect(page.locator(".found-missing > li")).not_to_have_count(0)
    # It is a step of the case, and the strip says who said the length.
    expect(page.locator(".path-table")).to_contain_text("Rest length 300 mm")
    expect(page.locator(".strip [data-fact='rest_length']")).to_contain_text("you agreed")
    page.get_by_role("button", name="Undo").first.click()
    expect(page.locator("#entry-questions")).to_be_visible(timeout=180_000)
    with page.expect_request("**/api/diagnoses") as kept:
        first.get_by_role("button", name=re.compile("is right$")).click()
    assert kept.value.post_data_json["keep"] == ["rest_length"]


def test_an_entry_that_explains_as_much_as_an_effect_is_said_where_effects_are_ranked(page: Page) -> None:
    """Forces that are 9 % too small are a braid that is 5 % thinner: nobody is asked, but it is said."""
    open_compare(page)
    rows = [row.split(",") for row in measured(1, points=20, c10=0.0, friction=0.0).splitlines()]
    place = next(row for row in rows if len(row) > 2).index("force [N]")
    for row in rows:
        if len(row) > 2 and row[place] != "force [N]":
            row[place] = f"{0.91 * float(row[place]):.4f}"
    choose(page, file("weak.csv", "\n".join(",".join(row) for row in rows) + "\n"))
    use(page)
    diagnosed(page, 180_000)
    expect(page.locator("#entry-questions")).to_have_count(0)
    line = page.locator(".context-line")
    expect(line).to_contain_text(re.compile(r"Or an entry is wrong: .*Braid diameter [\d.]+ mm instead of"))
    expect(line).not_to_contain_text("No entry is in doubt")
