"""The modules without a page: signals, the document, links, units."""

from __future__ import annotations

import base64
import json
import random
import zlib

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.guard import PageGuard
from tests.frontend.views import open_design, run


def test_effects_run_once_per_batch_and_stop(blank: Page) -> None:
    counts = run(
        blank,
        """
        const { signal, computed, effect, batch } = await import("/js/reactive.js");
        const a = signal(1), b = signal(2), sum = computed(() => a.value + b.value), seen = [];
        const stop = effect(() => seen.push(sum.value));
        batch(() => { a.value = 10; b.value = 20; });
        a.value = 10;
        stop();
        a.value = 0;
        return seen;
        """,
    )
    assert counts == [3, 30]


def test_an_effect_forgets_what_it_no_longer_reads(blank: Page) -> None:
    runs = run(
        blank,
        """
        const { signal, effect } = await import("/js/reactive.js");
        const which = signal(true), a = signal(1), b = signal(1);
        let n = 0;
        effect(() => { n++; which.value ? a.value : b.value; });
        which.value = false;
        a.value = 2;
        return n;
        """,
    )
    assert runs == 2


def test_a_drag_is_one_undo_step_with_a_name(blank: Page) -> None:
    result = run(
        blank,
        """
        const s = await import("/js/state.js");
        const { patchDesign } = await import("/js/muscle/document.js");
        for (const load of [510, 520, 530]) s.preview(patchDesign({ load }));
        s.commit("load");
        const steps = s.past.peek().map((step) => step.label), moved = s.doc.peek().design.load;
        s.undo();
        const back = s.doc.peek().design.load;
        s.redo();
        return { steps, moved, back, again: s.doc.peek().design.load, left: s.future.peek().length };
        """,
    )
    assert result == {"steps": ["load"], "moved": 530, "back": 500, "again": 530, "left": 0}


def test_a_new_change_ends_the_redo_branch(blank: Page) -> None:
    left = run(
        blank,
        """
        const s = await import("/js/state.js");
        const { editDesign } = await import("/js/muscle/document.js");
        editDesign({ load: 1 }, "a");
        editDesign({ load: 2 }, "b");
        s.undo();
        editDesign({ load: 3 }, "c");
        return [s.future.peek().length, s.past.peek().map((step) => step.label), s.redo()];
        """,
    )
    assert left == [0, ["a", "c"], None]


def test_a_part_of_the_document_is_registered_with_its_start_and_its_reader(blank: Page) -> None:
    outcome = run(
        blank,
        """
        const s = await import("/js/state.js");
        const read = (raw) => {
          if (raw === undefined) return { size: 1 };
          if (typeof raw.size !== "number") throw new Error("the size of the part is no number");
          return { size: raw.size };
        };
        s.addPart("part", { start: () => ({ size: 1 }), read });
        const wrong = () => s.readDoc({ schema: 1, part: { size: "much" } });
        let message = "";
        try { wrong(); } catch (error) { message = error.message; }
        return [s.doc.peek().part, s.defaultDoc().part, s.readDoc({ schema: 1 }).part,
          s.readDoc({ schema: 1, part: { size: 3, more: 4 } }).part, message];
        """,
    )
    assert outcome == [
        {"size": 1},
        {"size": 1},
        {"size": 1},
        {"size": 3},
        "the size of the part is no number",
    ]


def test_what_is_looked_at_is_no_step(blank: Page) -> None:
    assert not run(
        blank,
        """
        const s = await import("/js/state.js");
        s.look((d) => ({ ...d, view: "catalogue" }));
        return s.past.peek().length;
        """,
    )


READ = """
const { parse, scaleOf } = await import("/js/format.js");
return argument.map(([text, quantity]) => parse(text, scaleOf(quantity, "bar"), quantity));
"""

TYPED = [
    ("30 cm", "length", 0.3),
    ("300", "length", 0.3),
    ("11.811 in", "length", 0.29999940),
    ("6 bar", "pressure", 6e5),
    ("0.6MPa", "pressure", 6e5),
    ("87 psi", "pressure", 599843.88),
    ("1,5 bar", "pressure", 1.5e5),
    ("25°", "angle", 0.43633231),
    ("25 deg", "angle", 0.43633231),
    ("0.436 rad", "angle", 0.436),
    ("68 °F", "temperature", 293.15),
    ("20 degC", "temperature", 293.15),
    ("−5", "force", -5.0),
    ("0.47 MPa", "modulus", 4.7e5),
    ("25 %", "ratio", 0.25),
    ("15 ml", "volume", 1.5e-5),
    ("3 bar(g)", "pressure", 3e5),
    ("30 psig", "pressure", 206842.72),
]


def test_typed_units(blank: Page) -> None:
    got = run(blank, READ, [[text, quantity] for text, quantity, _ in TYPED])
    for (text, _, si), answer in zip(TYPED, got, strict=True):
        assert answer.get("value") == pytest.approx(si, rel=1e-6), (text, answer)


COUNTED = """
const { parse, scaleOf } = await import("/js/format.js");
const scale = scaleOf("pressure", "bar");
return argument.map(([text, counted]) => parse(text, scale, "pressure", "1", counted).value);
"""


def test_pressures_that_say_what_they_are_counted_from(blank: Page) -> None:
    gauge = {"reference": "gauge", "ambient": 9.5e4}
    absolute = {"reference": "absolute"}
    cases = [("3 bar(a)", gauge, 2.05e5), ("3 bar", gauge, 3e5), ("43.5113 psia", gauge, 2.05e5)]
    cases += [("0.95 bar(a)", absolute, 9.5e4), ("0 barg", absolute, 101325), ("0.3 MPa(g)", gauge, 3e5)]
    got = run(blank, COUNTED, [[text, counted] for text, counted, _ in cases])
    assert got == pytest.approx([si for _, _, si in cases], rel=1e-6)


REFUSED = [
    ("abc", "length", "not a number"),
    ("", "length", "Enter a number"),
    ("3 bar", "length", "measures a pressure"),
    ("3 furlong", "length", "not known"),
    ("1e9x", "force", "not known"),
    ("3 bar(a)", "pressure", "absolute pressure"),
    ("3 mPa", "pressure", "not known"),
    ("3 constructor", "length", "not known"),
]


def test_refused_entries_say_what_would_be_right(blank: Page) -> None:
    got = run(blank, READ, [[text, quantity] for text, quantity, _ in REFUSED])
    for (text, _, words), answer in zip(REFUSED, got, strict=True):
        assert words in answer.get("error", ""), (text, answer)


def test_shown_values_survive_being_read_back(blank: Page) -> None:
    worst = run(
        blank,
        """
        const { parse, scaleOf, number, toShown, SCALES } = await import("/js/format.js");
        let worst = 0;
        for (const quantity of Object.keys(SCALES)) for (const system of ["si", "bar", "us"]) {
          const s = scaleOf(quantity, system);
          for (const si of [0.3, 1, 293.15, 1234.5]) {
            const text = number(toShown(si, s), 12), got = parse(`${text} ${s.unit}`, s, quantity);
            if ("error" in got) throw new Error(`${text} ${s.unit}: ${got.error}`);
            worst = Math.max(worst, Math.abs(got.value / si - 1));
          }
        }
        return worst;
        """,
    )
    assert worst < 2e-3


def test_numbers_have_sensible_digits(blank: Page) -> None:
    texts = run(
        blank,
        """
        const { number, brief, aligned } = await import("/js/format.js");
        return [number(0.1 + 0.2, 4), number(-0.00001, 2), number(1548.4521, 1), number(NaN, 2), brief(0.004),
          brief(15.79), aligned([-0.004, 4.26, 15.8, null])];
        """,
    )
    assert texts == ["0.3", "0", "1548.5", "–", "0.004", "15.8", ["0.0", "4.3", "15.8", "–"]]


# ---- links

PARTS = [
    "/js/muscle/document.js",
    *(f"/js/views/{view}/index.js" for view in ("sizing", "transient", "compare", "catalogue", "studies")),
]


def packed(text: str) -> str:
    """A link made by hand: raw deflate, base64url."""
    squeeze = zlib.compressobj(wbits=-15)
    raw = squeeze.compress(text.encode()) + squeeze.flush()
    return "#v1." + base64.urlsafe_b64encode(raw).decode().rstrip("=")


def test_a_link_holds_the_whole_document(blank: Page) -> None:
    same = run(
        blank,
        """
        const { toHash, fromHash } = await import("/js/link.js");
        for (const part of argument) await import(part);
        const { defaultDoc } = await import("/js/state.js");
        const doc = defaultDoc();
        doc.units = "us";
        doc.design.muscle = { preset: null, form: "thread", values: { thread_length: 0.33, turns: 2.2 } };
        doc.design.effects = { anything: { value: 1.5 } };
        const hash = await toHash(doc);
        return [hash.startsWith("#v1."), JSON.stringify(await fromHash(hash)) === JSON.stringify(doc)];
        """,
        PARTS,
    )
    assert same == [True, True]


WRONG_DOCUMENTS = [
    "null",
    "[]",
    '"text"',
    "{}",
    '{"schema": 2}',
    '{"schema": 1}',
    '{"schema": 1, "design": []}',
    '{"schema": 1, "design": {"pressures": []}}',
    '{"schema": 1, "design": {"pressures": ["6 bar"]}}',
    '{"schema": 1, "design": {"load": null}}',
    '{"schema": 1, "design": {"muscle": {"preset": 5}}}',
    '{"schema": 1, "design": {"muscle": {"preset": null, "form": "cube", "values": {}}}}',
    '{"schema": 1, "design": {"effects": {"x": {"y": "z"}}}}',
    '{"schema": 1, "design": {"constructor": 1}}',
    '{"schema": 1, "design": {"__proto__": {"load": 3}, "unknown": 3}}',
]


def test_wrong_documents_are_refused_in_words(blank: Page) -> None:
    messages = run(
        blank,
        """
        const { fromHash } = await import("/js/link.js");
        await import("/js/muscle/document.js");
        return Promise.all(argument.map((hash) => fromHash(hash).then(() => "", (error) => error.message)));
        """,
        [packed(text) for text in WRONG_DOCUMENTS],
    )
    silent = [text for text, message in zip(WRONG_DOCUMENTS, messages, strict=True) if len(message) < 10]
    assert silent == []


def test_damaged_links_never_break_the_reader(blank: Page) -> None:
    good = packed(json.dumps({"schema": 1, "design": {"load": 400}}))
    chance = random.Random(7)
    letters = "ABCabc019-_#%.é"
    links = ["#v1.", "#v1.!!!!", "#v2.abc", "#", "#main", "#v1." + "A" * 70000, good + "A", good[:-3]]
    for _ in range(300):
        text = list(good)
        for _ in range(chance.randint(1, 4)):
            text[chance.randrange(4, len(text))] = chance.choice(letters)
        links.append("".join(text[: chance.randint(5, len(text))]))
    outcomes = run(
        blank,
        """
        const { fromHash } = await import("/js/link.js");
        await import("/js/muscle/document.js");
        const outcome = (hash) => fromHash(hash).then(
          (doc) => doc === null || Array.isArray(doc.design.pressures) ? "read" : "broken",
          (error) => error instanceof Error && error.message.length > 10 ? "refused" : "mute");
        return Promise.all(argument.map(outcome));
        """,
        links,
    )
    assert set(outcomes) <= {"read", "refused"}
    assert outcomes.count("refused") > 250


@pytest.mark.parametrize(
    "link", ["#v1.damaged", packed('{"schema": 1, "design": {"load": "much"}}'), "#nonsense"]
)
def test_a_damaged_link_opens_the_example_and_says_why(page: Page, link: str) -> None:
    open_design(page, link)
    expect(page.locator(".status")).to_contain_text("The link cannot be read")
    expect(page.locator("#preset")).to_have_value("DMSP-20")


def test_a_link_to_a_preset_that_is_gone_says_so(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("status of")
    document = {
        "muscle": {"preset": "GONE-7", "form": "braid", "values": {}},
        "effects": {},
        "reference": None,
    }
    page.goto("/" + packed(json.dumps({"schema": 1, "design": document})))
    expect(page.locator(".notice")).to_contain_text("GONE-7")
    expect(page.locator("#preset")).to_be_visible()
