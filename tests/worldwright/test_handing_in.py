"""A film drawn elsewhere: taken in if it is one, shown as the author's, listed by the stamp, and never asked for."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from worldwright import report
from worldwright.cli import main
from worldwright.gallery import pages, worlds
from worldwright.handing_in import take
from worldwright.model.errors import GateError
from worldwright.model.evidence import handed_in
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.report import media
from worldwright.stamp import small_form, versions
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]


def film(path: Path, codec: str = "libx264", frames: int = 12, size: tuple[int, int] = (64, 48)) -> Path:
    """A little film whose pictures get brighter."""
    import av

    with av.open(str(path), "w") as made:
        stream = made.add_stream(codec, rate=12)
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"
        for shade in np.linspace(0, 255, frames).astype(np.uint8):
            picture = av.VideoFrame.from_ndarray(np.full((size[1], size[0], 3), shade, np.uint8), format="rgb24")
            made.mux(stream.encode(picture))
        made.mux(stream.encode())
    return path


@pytest.mark.parametrize(("name", "codec"), [("a.mp4", "libx264"), ("b.webm", "libvpx-vp9"), ("c.mov", "libx264")])
def test_a_film_is_taken_in_and_takes_the_place_of_the_one_before(
    planned: Path, copy: Copy, tmp_path: Path, name: str, codec: str
) -> None:
    run = Run(copy(planned))
    (run.folder / "handed_in.mov").write_bytes(b"the one before")
    told = take(run, film(tmp_path / name, codec))
    assert told.size == (64, 48) and told.seconds == pytest.approx(1.0, abs=0.1)
    assert handed_in.of(run.folder) == told
    assert [path.name for path in run.folder.glob("handed_in.*")] == [f"handed_in{Path(name).suffix}"]


def no_film(path: Path) -> Path:
    path.write_bytes(b"not a film" * 1000)
    return path


def other_files(path: Path) -> Path:
    """What a player would take for a list of files to show."""
    path.write_text("#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n/etc/hostname\n#EXT-X-ENDLIST\n")
    return path


def huge(path: Path) -> Path:
    with path.open("wb") as file:
        file.truncate(3 << 30)
    return path


def undecodable(path: Path) -> Path:
    """A film whose pictures are in a form that nobody here has heard of."""
    path.write_bytes(film(path.with_name("real.mp4")).read_bytes().replace(b"avc1", b"zzz9"))
    return path


def pipe(path: Path) -> Path:
    os.mkfifo(path)
    return path


def folder(path: Path) -> Path:
    path.mkdir()
    return path


def cut_off(path: Path) -> Path:
    path.write_bytes(film(path.with_name("real.mp4")).read_bytes()[:600])
    return path


def sound(path: Path) -> Path:
    import av

    with av.open(str(path), "w") as made:
        stream = made.add_stream("aac", rate=44100)
        frame = av.AudioFrame.from_ndarray(np.zeros((1, 1024), np.float32), format="fltp", layout="mono")
        frame.sample_rate = 44100
        made.mux(stream.encode(frame))
        made.mux(stream.encode())
    return path


BAD = {
    no_film: "no film", other_files: "no film", huge: "3221 MB", undecodable: "cannot be read here", pipe: "plain file", folder: "plain file",
    cut_off: "no film", sound: "no film",
}  # fmt: skip


@pytest.mark.parametrize("make", BAD, ids=lambda make: make.__name__)
def test_what_is_no_film_is_refused_with_its_cause(planned: Path, copy: Copy, tmp_path: Path, make: Callable) -> None:
    run = copy(planned)
    done = CliRunner().invoke(main, ["hand-in", str(run), str(make(tmp_path / "it.mp4"))])
    assert done.exit_code == 2, done.output
    assert BAD[make] in done.output and "next: hand in a film" in done.output
    assert not list(run.glob("handed_in.*"))


def test_a_persons_own_file_may_be_a_link_and_what_lies_in_the_run_may_not(
    planned: Path, copy: Copy, tmp_path: Path
) -> None:
    run, real = Run(copy(planned)), film(tmp_path / "real.mp4")
    (tmp_path / "link.mp4").symlink_to(real)
    (tmp_path / "again.mp4").hardlink_to(real)
    for name in ("link.mp4", "again.mp4"):
        assert take(run, tmp_path / name).sha256 == sha256_file(real)
    (run.folder / "handed_in.mp4").unlink()
    (run.folder / "handed_in.mp4").symlink_to(real)
    with pytest.raises(handed_in.HandedInError, match="a link"):
        handed_in.of(run.folder)


def test_another_ending_and_a_file_that_is_not_there(planned: Path, tmp_path: Path) -> None:
    with pytest.raises(handed_in.HandedInError, match=r"ending \.mp4"):
        take(Run(planned), no_film(tmp_path / "it.avi"))
    with pytest.raises(handed_in.HandedInError, match="No such file"):
        take(Run(planned), tmp_path / "nowhere.mp4")


@pytest.fixture(scope="module")
def listed(reviewed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An accepted run with a handed-in film."""
    target = tmp_path_factory.mktemp("listed") / reviewed.name
    shutil.copytree(reviewed, target)
    take(Run(target), film(tmp_path_factory.mktemp("films") / "mine.mp4"))
    assert stamp.accept(str(target), timeout_s=60).ok
    return target


def test_the_stamp_lists_it_and_it_is_no_evidence(listed: Path) -> None:
    statement = Statement.model_validate_json((listed / "accepted" / "stamp.json").read_bytes())
    told = statement.predicate.handed_in
    assert told and told.sha256 == sha256_file(listed / "handed_in.mp4") == statement.digest_of("handed_in.mp4")
    assert told.sha256 not in {digest.sha256 for digest in statement.predicate.evidence.values()}
    assert "handed_in.mp4" not in statement.predicate.source.materials
    verdict = stamp.verify(str(listed))
    assert verdict.ok, verdict.text()


def test_the_small_form_does_without_it_and_is_proved_all_the_same(listed: Path, tmp_path: Path) -> None:
    target = tmp_path / listed.name
    assert "handed_in.mp4" not in small_form.write(Run(listed), target)
    verdict = stamp.verify(str(target))
    assert verdict.ok, verdict.text()
    shutil.copy(listed / "handed_in.mp4", target)
    assert stamp.verify(str(target)).ok
    film(target / "handed_in.mp4", frames=24)
    assert not stamp.verify(str(target)).ok


def test_a_small_form_that_lists_none_may_have_one_beside_it(accepted: Path, tmp_path: Path) -> None:
    target = tmp_path / accepted.name
    small_form.write(Run(accepted), target)
    take(Run(target), film(tmp_path / "mine.mp4", frames=24))
    verdict = stamp.verify(str(target))
    assert verdict.ok, verdict.text()


def test_another_film_than_the_listed_one_takes_no_acceptance_away_and_is_listed_by_the_next(
    listed: Path, copy: Copy, tmp_path: Path
) -> None:
    run = copy(listed)
    (run / "handed_in.mp4").unlink()
    assert stamp.status(str(run)).state == "accepted"
    take(Run(run), film(tmp_path / "another.mp4", frames=24))
    status = stamp.status(str(run))
    assert status.state == "accepted" and "handed in since is listed" in status.text()
    assert stamp.accept(str(run), timeout_s=60).ok
    assert "handed in since" not in stamp.status(str(run)).text()
    told = Statement.model_validate_json((run / "accepted" / "stamp.json").read_bytes()).predicate.handed_in
    assert told and told.sha256 == sha256_file(run / "handed_in.mp4")


def test_a_stamp_says_nothing_of_a_film_where_none_was_handed_in(accepted: Path) -> None:
    assert b"handed_in" not in (accepted / "accepted" / "stamp.json").read_bytes()


def test_a_version_in_small_form_comes_back_without_its_film(listed: Path, tmp_path: Path) -> None:
    target = tmp_path / listed.name
    small_form.write(Run(listed), target)
    (version,) = versions.known(Run(target))
    assert "handed_in.mp4" not in versions._made_of(Run(target), version)


def test_what_is_no_film_is_not_accepted(reviewed: Path, copy: Copy) -> None:
    run = copy(reviewed)
    no_film(run / "handed_in.mp4")
    with pytest.raises((handed_in.HandedInError, GateError), match="no film"):
        stamp.accept(str(run), timeout_s=60)
    assert not (run / "accepted").exists()
    no_film(run / "handed_in.webm")
    with pytest.raises((handed_in.HandedInError, GateError), match="two films"):
        stamp.accept(str(run), timeout_s=60)


def test_the_report_shows_it_as_the_authors(listed: Path, copy: Copy) -> None:
    run = copy(listed)
    page = report.write(Run(run)).read_text(encoding="utf-8")
    assert 'class="handed"' in page and "it is no evidence" in page and sha256_file(run / "handed_in.mp4") in page
    assert "data:video/mp4" in page and '<a href="handed_in' not in page
    no_film(run / "handed_in.mp4")
    page = report.write(Run(run)).read_text(encoding="utf-8")
    assert (
        "data:video/mp4" in page and "handed-in film: the file is no film" in page
    )  # the listed one lies in accepted/


def test_the_report_links_a_film_that_it_does_not_show(
    listed: Path, copy: Copy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Run(copy(listed))
    take(run, film(tmp_path / "c.mov"))
    page = report.write(run).read_text(encoding="utf-8")
    assert (
        "handed_in.mov in the run is none that its stamp lists: left out" in page and 'href="handed_in.mov"' not in page
    )
    shutil.rmtree(run.accepted)
    page = report.write(run).read_text(encoding="utf-8")
    assert '<a href="handed_in.mov">' in page and "too large for this page, or" in page
    take(run, film(tmp_path / "b.webm", "libvpx-vp9"))
    assert "data:video/webm" in report.write(run).read_text(encoding="utf-8")
    monkeypatch.setattr(media, "BUDGET", 100)
    assert '<a href="handed_in.webm">' in report.write(run).read_text(encoding="utf-8")


def test_the_gallery_shows_it_as_the_authors(listed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    worlds.BUILT.mkdir(parents=True)
    shutil.copytree(listed, worlds.BUILT / listed.name)
    page = pages.write_index([listed.name]).read_text(encoding="utf-8")
    assert f'<video src="{listed.name}/handed_in.mp4"' in page and "handed in: no evidence" in page
