"""The table and the page of a campaign say what its rows say, whatever stands in them."""

import csv
import json
import re

import pyarrow.parquet
import pytest

from worldwright.campaign import campaign_table, conducting, one_world, wall
from worldwright.campaign.campaign_file import Campaign
from worldwright.campaign.campaign_store import Base, Begun, Store
from worldwright.campaign.world_row import Cause, Margin, Row

EVIL = '</script><b onclick="x">&'


@pytest.fixture
def store(tmp_path):
    """A campaign that is begun, without a plan behind it."""
    begun = Begun(campaign=Campaign(name="walls", plans=tuple("abcde")), bases=(Base(source="a"),))
    (tmp_path / "campaign.json").write_text(begun.model_dump_json(by_alias=True))
    return Store(tmp_path)


def row(number, **more):
    return Row(**{"world": f"{number:016x}", "number": number, "outcome": "held", **more})


def margins(*found):
    return tuple(Margin(objective=0, name="falls", status="holds", margin=m, measured=m, unit="m") for m in found)


def test_the_table_holds_every_row_and_loads(store):
    store.keep(
        row(0, values={"masses.ball": 0.1}, margins=margins(0.2, -0.1), minutes={"physics": 0.5}, prompt='a, "b"\nc')
    )
    store.keep(
        row(1, outcome="failed", cause=Cause(kind="WL101", step="lint", said=EVIL), interventions=("force on ball",))
    )
    paths = wall.write(store)
    assert [path.name for path in paths] == ["table.parquet", "table.csv", "index.html"]
    table = campaign_table.read(store.folder).sort_by("number").to_pylist()
    assert table[0]["vary.masses.ball"] == 0.1 and table[1]["vary.masses.ball"] is None
    assert table[0]["margin"] == table[0]["margin.0.falls.2"] == -0.1 and table[0]["margin.0.falls"] == 0.2
    assert (
        table[1]["cause"] == "WL101" and table[1]["cause_said"] == EVIL and table[1]["interventions"] == "force on ball"
    )
    with (store.folder / "table.csv").open(newline="") as stream:
        read = sorted(csv.DictReader(stream), key=lambda cells: cells["number"])
    assert read[0]["prompt"] == 'a, "b"\nc' and float(read[0]["minutes.physics"]) == 0.5
    assert pyarrow.parquet.read_schema(store.folder / "table.parquet").names == list(read[0])


@pytest.mark.parametrize(("harness", "words"), [("codex", {"trust": True}), ("opencode", {}), ("claude_code", {})])
def test_the_page_and_the_standing_say_what_an_authors_figures_leave_out(store, harness, words):
    author = {"harness": harness, **words}
    begun = store.begun
    campaign = Campaign(name="walls", prompts=("a ball",), author=author)
    (store.folder / "campaign.json").write_text(
        begun.model_copy(update={"campaign": campaign}).model_dump_json(by_alias=True)
    )
    store.keep(row(0, author=harness, tokens_read=1500, tokens_written=34, usd=0.25))
    wall.write(store)
    page, now = (store.folder / "index.html").read_text(), conducting.standing(store).text()
    for said in (page, now):
        assert "1,534 tokens, 0.25 US dollars" in said
        assert ("main thread only" in said) == (harness != "claude_code")


def test_the_page_groups_failures_draws_margins_and_links_reports(store):
    store.keep(
        row(
            0,
            margins=margins(0.5),
            report="worlds/00/x/report.html",
            poster="worlds/00/x/p.webp",
            film="worlds/00/x/f.mp4",
        )
    )
    for number in (1, 2):
        store.keep(
            row(
                number,
                outcome="failed",
                cause=Cause(kind="WL101", step="lint", said=f"{EVIL} {number}", next_move="mend"),
            )
        )
    store.keep(row(3, outcome="refuted", margins=margins(-0.5), cause=Cause(kind="refuted", step="expect", said="no")))
    page = wall.write(store)[-1].read_text()
    assert "4 of 5 worlds" in page
    assert page.index("<b>2</b> × WL101") < page.index("<b>1</b> × refuted")
    assert EVIL not in page and page.count("</script>") == 2
    tiles = json.loads(re.search(r'id="rows">(.*?)</script>', page, re.DOTALL)[1])
    assert tiles[0] == {
        "n": 0,
        "w": f"{0:016x}",
        "o": "held",
        "m": 0.5,
        "p": "worlds/00/x/p.webp",
        "f": "worlds/00/x/f.mp4",
        "r": "worlds/00/x/report.html",
    }
    assert [tile["n"] for tile in tiles] == [0, 1, 2, 3]
    assert "0.falls: -0.5 to 0.5 m," in " ".join(page.split()) and "1 of 2 below 0" in page
    assert 'x1="50.00"' in page, "where 0 lies is drawn"


def test_the_film_of_a_world_is_the_accepted_one_of_its_author(store):
    folder, evidence = store.world("ab" * 8), store.world("ab" * 8) / "evidence/key"
    assert one_world._film(store, folder, evidence) == ""
    for place, name in ((evidence, "film"), (folder / "accepted", "above"), (folder / "accepted", "film")):
        film = place / f"video/{name}.mp4"
        film.parent.mkdir(parents=True, exist_ok=True)
        film.touch()
        assert store.folder / one_world._film(store, folder, evidence) == film
    film.unlink()
    film.symlink_to("gone.mp4")
    assert one_world._film(store, folder, evidence).endswith("accepted/video/above.mp4"), "a link to nothing is no film"


def test_two_may_write_the_table_at_once_and_none_leaves_a_draft(tmp_path):
    def interrupted():
        yield row(0)
        campaign_table.write([row(7)], [], tmp_path)
        yield row(1)

    campaign_table.write(interrupted(), [], tmp_path)
    assert campaign_table.read(tmp_path)["number"].to_pylist() == [0, 1]

    def damaged():
        yield row(2)
        raise OSError("the disk is gone")

    with pytest.raises(OSError, match="gone"):
        campaign_table.write(damaged(), [], tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["table.csv", "table.parquet"]
    assert campaign_table.read(tmp_path)["number"].to_pylist() == [0, 1]


def test_table_page_and_whoever_looks_have_the_worlds_by_number(store, monkeypatch):
    monkeypatch.setattr(wall, "MOST_SHOWN", 2)
    for number in range(5):
        store.keep(row(number, world=f"{9 - number:02x}{0:014x}"))
    seen = []
    page = wall.write(store, lambda row: seen.append(row.number))[-1].read_text()
    assert seen == campaign_table.read(store.folder)["number"].to_pylist() == [0, 1, 2, 3, 4]
    tiles = json.loads(re.search(r'id="rows">(.*?)</script>', page, re.DOTALL)[1])
    assert [tile["n"] for tile in tiles] == [0, 1]


def test_rows_are_listed_a_folder_at_a_time(store):
    for world in ("00" * 8, "11" * 8):
        store.keep(row(0, world=world))
    rows = store.rows()
    assert next(rows).world == "00" * 8
    store.keep(row(1, world="11" + "00" * 7))
    assert [row.number for row in rows] == [1, 0], "the second folder was not looked into before the first was read"


def test_a_campaign_of_which_nothing_is_done_has_a_page(store):
    page = wall.write(store)[-1].read_text()
    assert "0 of 5 worlds" in page and campaign_table.read(store.folder).num_rows == 0


def test_a_histogram_counts_every_value_once():
    found = wall.histogram("x", [-1.0, -0.5, 0.0, 1.0])
    assert sum(found.counts) == found.total == 4 and found.counts[0] == found.counts[-1] == 1 and found.fails == 2
    assert found.zero == 0.5
    alone = wall.histogram("x", [2.0] * 5)
    assert max(alone.counts) == 5 and alone.zero is None and alone.low < 2 < alone.high
    assert all(0 <= x < 1 and 0 <= height <= 1 for x, height, _ in alone.bars)


def test_a_number_that_is_none_stands_nowhere(store):
    store.keep(row(0, margins=(Margin(objective=0, name="falls", status="unknown"),)))
    page = wall.write(store)[-1].read_text()
    assert "Margins" not in page


def test_a_page_shows_the_first_of_very_many(store, monkeypatch):
    monkeypatch.setattr(wall, "MOST_SHOWN", 2)
    for number in range(4):
        store.keep(row(number))
    page = wall.write(store)[-1].read_text()
    assert "The table has all 4; here are 2" in page
