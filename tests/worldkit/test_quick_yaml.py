"""What is read quickly is what is read slowly, and what is no plain data is refused."""

from pathlib import Path

import pytest
import yaml

from worldkit import quick_yaml

ASSETS = sorted((Path(__file__).parents[2] / "catalog").glob("*/asset.yaml"))


@pytest.mark.parametrize("path", ASSETS, ids=lambda path: path.parent.name)
def test_an_asset_reads_the_same(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert quick_yaml.read(text) == yaml.safe_load(text)


@pytest.mark.parametrize("text", ["a: [1, 2\nb: 3", "\tx: 1", "a: b: c", "!!python/name:os.system ''", "- \x00"])
def test_what_is_no_plain_data_is_refused(text: str) -> None:
    with pytest.raises(yaml.YAMLError):
        quick_yaml.read(text)


@pytest.mark.parametrize("text", ["[", "{a: ", "- "])
def test_what_lies_too_deep_is_an_error_and_no_end(text: str) -> None:
    with pytest.raises(RecursionError):
        quick_yaml.read(text * 100_000)
