"""`worldwright asset page FOLDER`, `make catalog`: one page with every asset and every offer, its picture, size, licence and creator."""

from html import escape
from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.files import write_atomic

from ..expose import Positional
from ..model.frozen import Frozen
from ..model.storage import writing
from . import libraries

MOST_PICTURE = 4 << 20
STYLE = """body{font:15px/1.4 system-ui,sans-serif;margin:1.5rem;color:#222;background:#fafafa}
input{font:inherit;padding:.4rem;width:min(30rem,90%)}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(11rem,1fr));gap:.8rem;margin-top:1rem}
article{background:#fff;border:1px solid #ddd;border-radius:6px;padding:.6rem;overflow-wrap:anywhere}
img{width:100%;height:9rem;object-fit:contain}h2{font-size:1rem;margin:.3rem 0}p{margin:.1rem 0;font-size:.85rem;color:#555}
.offer{border-style:dashed}"""
SEARCH = """document.querySelector('input').addEventListener('input', event => {
  const words = event.target.value.toLowerCase().split(/\\s+/).filter(Boolean);
  for (const card of document.querySelectorAll('article'))
    card.hidden = !words.every(word => card.textContent.toLowerCase().includes(word));
});"""


class CatalogPage(Frozen):
    """Where the page lies, and how much it shows."""

    page: str
    assets: int
    offers: int

    def text(self) -> str:
        """One line."""
        return f"{self.page}: {self.assets} assets, {self.offers} offers of packaged libraries"


def page(
    folder: Annotated[Path, Field(description="Where index.html and its pictures go."), Positional()] = Path(
        "runs/catalog"
    ),
) -> CatalogPage:
    """Write a page to browse all assets and what packaged libraries offer; chosen offers come before the others."""
    from worldkit import assets

    held = sorted(assets.entries(), key=lambda asset: (asset.category, asset.key))
    offers = sorted(
        (offer for key, offer in libraries.offers().items() if key not in {asset.key for asset in held}),
        key=lambda offer: (not offer.chosen, offer.name.lower(), offer.key),
    )
    cards = []
    with writing("the page", folder):
        for asset in held:
            shown = asset.thumbnail.read_bytes() if asset.thumbnail.is_file() else b""
            size = asset.extents()
            facts = [
                f"{_size(size)} m, {asset.mass_at():.3g} kg", asset.description, f"{asset.licence}{_by(asset.creator)}",
            ]  # fmt: skip
            cards.append(_card(folder, asset.key, asset.key, facts, shown, ""))
        for offer in offers:
            icon = libraries.SEAM.find(offer.library).icon(offer.key)
            facts = [
                f"{_size(offer.extents)} m",
                offer.words,
                f"{offer.licence}{_by(offer.creator)}",
                f"worldwright asset add {offer.key}",
            ]
            cards.append(_card(folder, offer.key, offer.name, facts, icon, ' class="offer"'))
        head = f"<!doctype html><html lang='en'><meta charset='utf-8'><title>Assets</title><style>{STYLE}</style>"
        told = f"<h1>{len(held)} assets, {len(offers)} offers</h1><input type='search' placeholder='Search'><main>"
        write_atomic(folder / "index.html", "\n".join([head, told, *cards, f"</main><script>{SEARCH}</script></html>"]))
    return CatalogPage(page=str(folder / "index.html"), assets=len(held), offers=len(offers))


def _card(folder: Path, key: str, name: str, facts: list[str], picture: bytes, mark: str) -> str:
    shown = ""
    if picture.startswith(b"\x89PNG") and len(picture) <= MOST_PICTURE:
        write_atomic(folder / "pictures" / f"{key}.png", picture)
        shown = f"<img loading='lazy' alt='' src='pictures/{key}.png'>"
    rows = "".join(f"<p>{escape(fact)}</p>" for fact in facts if fact)
    return f"<article{mark}>{shown}<h2>{escape(name)}</h2>{rows}</article>"


def _size(extents: tuple[float, float, float]) -> str:
    return " x ".join(f"{side:.3g}" for side in extents)


def _by(creator: str) -> str:
    return f", by {creator}" if creator else ""
