"""Markdown and source code as safe HTML: no raw HTML, no pictures from elsewhere, colours by class."""

from markupsafe import Markup


def markdown(text: str) -> Markup:
    """A plan or a prompt as HTML; fenced blocks are coloured, HTML in it is shown as text."""
    from markdown_it import MarkdownIt

    renderer = MarkdownIt("commonmark", {"html": False, "highlight": _fence}).enable("table").disable("image")
    return Markup(renderer.render(text))


def code(source: str, language: str = "python") -> Markup:
    """Source as coloured lines, each with an anchor and its number."""
    lines = _coloured(source, language).split("\n")
    while lines and not lines[-1]:
        lines.pop()
    numbered = (f'<span class="line" id="L{i}"><i>{i}</i>{line}\n</span>' for i, line in enumerate(lines, 1))
    return Markup(f'<pre class="code numbered"><code>{"".join(numbered)}</code></pre>')


def _fence(source: str, language: str, _attributes: str) -> str:
    return _coloured(source, language or "text")


def _coloured(source: str, language: str) -> str:
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name
    from pygments.util import ClassNotFound

    try:
        lexer = get_lexer_by_name(language, stripnl=False)
    except ClassNotFound:
        lexer = get_lexer_by_name("text", stripnl=False)
    return str(highlight(source, lexer, HtmlFormatter(nowrap=True)))
