"""Asking the server: one request at a time, the newest text wins, answers that are remembered, cancelling."""

from __future__ import annotations

from typing import Any

from playwright.sync_api import Page

from tests.frontend.views import run

# A server that is asked by text: `asked` holds every text sent, `ended` how each came to an end.
SERVER = """
const { Question, Memory } = await import("/js/server/question.js");
const { ApiError } = await import("/js/server/client.js");
const { signal } = await import("/js/reactive.js");
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const asked = [], ended = [], seen = [];
let most = 0, now = 0, broken = false;
const after = (ms) => async (text, stop) => {
  asked.push(text);
  most = Math.max(most, ++now);
  await Promise.race([sleep(ms), new Promise((done) => stop.addEventListener("abort", done))]);
  now--;
  ended.push(stop.aborted ? `${text} aborted` : text);
  if (stop.aborted) throw new DOMException("aborted", "AbortError");
  if (broken) throw new ApiError("refused", { field: "body.load", status: 422 });
  return text.toUpperCase();
};
const until = async (test) => {
  for (let i = 0; i < 500 && !test(); i++) await sleep(10);
};
const state = (q) => [q.stage.peek(), q.answer.peek(), q.error.peek()?.message ?? null, q.stale.peek()];
"""


def ask(page: Page, script: str) -> Any:
    return run(page, SERVER + script)


def test_one_request_at_a_time_and_the_newest_wins(blank: Page) -> None:
    result = ask(
        blank,
        """
        const q = new Question(after(20), { arrived: (answer) => seen.push(answer) });
        for (const text of "abcdefgh") q.ask(text);
        await until(() => q.stage.peek() === "answered");
        return { asked, seen, most, state: state(q) };
        """,
    )
    assert result == {
        "asked": ["a", "h"],
        "seen": ["A", "H"],
        "most": 1,
        "state": ["answered", "H", None, False],
    }


def test_an_out_of_date_request_is_aborted_when_its_time_is_over(blank: Page) -> None:
    result = ask(
        blank,
        """
        const patient = new Question(after(60000), { patience: 30 });
        patient.ask("a");
        patient.ask("b");
        await until(() => asked.length === 2);
        patient.cancel();
        const hasty = new Question(after(60000), { patience: 0 });
        hasty.ask("c");
        hasty.ask("d");
        await until(() => asked.length === 4);
        hasty.cancel();
        await until(() => ended.length === 4);
        return [asked, ended];
        """,
    )
    assert result == [["a", "b", "c", "d"], ["a aborted", "b aborted", "c aborted", "d aborted"]]


def test_the_answer_on_screen_is_not_overwritten_by_one_that_is_out_of_date(blank: Page) -> None:
    result = ask(
        blank,
        """
        const q = new Question(after(60));
        q.ask("a");
        await until(() => q.stage.peek() === "answered");
        q.ask("b");
        q.ask("a");
        const back = state(q);
        await until(() => ended.length === 2);
        return { back, ended, state: state(q) };
        """,
    )
    assert result == {
        "back": ["answered", "A", None, False],
        "ended": ["a", "b aborted"],
        "state": ["answered", "A", None, False],
    }


def test_what_was_asked_before_is_remembered(blank: Page) -> None:
    result = ask(
        blank,
        """
        const q = new Question(after(1), { memory: new Memory(2) });
        for (const text of ["a", "b", "a", "c", "b", "a"]) {
          q.ask(text);
          await until(() => q.stage.peek() === "answered");
          seen.push(q.answer.peek());
        }
        q.ask("a", true);
        const again = q.stage.peek();
        await until(() => q.stage.peek() === "answered");
        return { asked, seen, again };
        """,
    )
    assert result["seen"] == ["A", "B", "A", "C", "B", "A"]
    assert result["asked"] == ["a", "b", "c", "b", "a", "a"], "two answers are kept, those used last"
    assert result["again"] == "asking"


def test_an_error_stays_until_an_answer_and_can_be_tried_again(blank: Page) -> None:
    result = ask(
        blank,
        """
        const q = new Question(after(1));
        const settled = () => until(() => ["answered", "failed"].includes(q.stage.peek()));
        q.ask("a");
        await settled();
        broken = true;
        q.ask("b");
        await settled();
        const failed = state(q);
        q.ask("c");
        const asking = state(q);
        await settled();
        broken = false;
        q.again();
        await settled();
        q.ask(null);
        return { failed, asking, asked, nothing: state(q) };
        """,
    )
    assert result == {
        "failed": ["failed", "A", "refused", True],
        "asking": ["asking", "A", "refused", True],
        "asked": ["a", "b", "c", "c"],
        "nothing": ["idle", None, None, False],
    }


def test_an_answer_that_is_not_kept_goes_with_the_next_request(blank: Page) -> None:
    result = ask(
        blank,
        """
        const q = new Question(after(1), { keeps: false });
        q.ask("a");
        await until(() => q.stage.peek() === "answered");
        q.ask("b");
        return state(q);
        """,
    )
    assert result == ["asking", None, None, True]


def test_following_a_text(blank: Page) -> None:
    """It waits until the text rests, while it is held back it asks nothing, and each text is asked once."""
    result = ask(
        blank,
        """
        const text = signal("a"), shown = signal(false);
        const q = new Question(after(1));
        const stop = q.follow(() => text.value, { delay: 30, active: () => shown.value });
        await sleep(60);
        const held = [...asked], waiting = q.stage.peek();
        shown.value = true;
        for (const next of ["b", "c", "d"]) { text.value = next; await sleep(2); }
        await until(() => q.stage.peek() === "answered");
        shown.value = false;
        shown.value = true;
        await sleep(60);
        const once = [...asked];
        text.value = null;
        const nothing = state(q);
        stop();
        text.value = "e";
        await sleep(60);
        return { held, waiting, once, nothing, asked };
        """,
    )
    assert result == {
        "held": [],
        "waiting": "asking",
        "once": ["d"],
        "nothing": ["idle", None, None, False],
        "asked": ["d"],
    }


def test_what_was_cancelled_is_asked_again_only_when_wanted(blank: Page) -> None:
    result = ask(
        blank,
        """
        const text = signal("a"), shown = signal(true);
        const q = new Question(after(30));
        q.follow(() => text.value, { active: () => shown.value });
        q.cancel();
        const cancelled = state(q);
        shown.value = false;
        shown.value = true;
        await sleep(10);
        const left = [...asked];
        q.again();
        await until(() => q.stage.peek() === "answered");
        return { cancelled, left, asked, state: state(q) };
        """,
    )
    assert result == {
        "cancelled": ["cancelled", None, None, True],
        "left": ["a"],
        "asked": ["a", "a"],
        "state": ["answered", "A", None, False],
    }


def test_messages_belong_to_fields(blank: Page) -> None:
    result = run(
        blank,
        """
        const { ApiError, fieldMessages } = await import("/js/server/client.js");
        const error = new ApiError("must be positive", { field: "body.drive.load.mass", status: 422 });
        const m = fieldMessages(() => error, (path) => path.replace(/^drive\\./, ""));
        const none = fieldMessages(() => null, (path) => path);
        return [m.field(), m.at("load.mass"), m.at("load"), m.within("load"), m.within("loa"), none.field(),
          none.within("load")];
        """,
    )
    words = "Must be positive."
    assert result == ["load.mass", words, None, words, None, None, None]


def test_a_request_that_went_before_a_server_came_back_is_sent_again(blank: Page) -> None:
    """In a network that slept no answer comes to it, and nothing refuses it."""
    result = ask(
        blank,
        """
        const { found, lost } = await import("/js/server/connection.js");
        const wait = window.setTimeout;
        window.setTimeout = (then, ms, ...more) => wait(then, ms === 2000 ? 20 : ms, ...more);
        window.fetch = () => new Promise(() => {});
        const first = [], send = (delay) => (text, stop) =>
          first.includes(text) ? after(0)(text, stop) : (first.push(text), after(delay)(text, stop));
        const short = new Question(send(60000)), long = new Question(send(200), { patience: 0 });
        short.ask("a");
        long.ask("b");
        lost();
        found();
        await until(() => short.stage.peek() === "answered" && long.stage.peek() === "answered");
        window.setTimeout = wait;
        return [asked, ended, short.answer.peek(), long.answer.peek()];
        """,
    )
    assert result == [["a", "b", "a"], ["a aborted", "a", "b"], "A", "B"]
