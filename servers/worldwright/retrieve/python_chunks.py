"""Python modules by their definitions: the module's words, each function, each class and its methods' signatures.

Read with `ast`, never imported.
"""

import ast
from collections.abc import Iterator

from .chunk import MAX_CHARACTERS, Chunk
from .rule_chunks import parse

Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


def chunks(text: str, name: str, source: bool = False) -> Iterator[Chunk]:
    """Cut a module.

    Args:
        text: the module.
        name: its dotted name, for titles.
        source: show the code of every function (examples, repositories), not only its signature and words.
    """
    tree = parse(text)
    if tree is None:
        return
    lines = text.splitlines()
    if doc := ast.get_docstring(tree):
        yield Chunk(name.rsplit(".", 1)[-1], name, 1, tree.body[0].end_lineno or 1, doc, (name,))
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            yield from _class(node, lines, name, source)
        elif isinstance(node, Definition):
            yield from _function(node, lines, name, node.name, source)


def _class(node: ast.ClassDef, lines: list[str], module: str, source: bool) -> Iterator[Chunk]:
    methods = [n for n in node.body if isinstance(n, ast.FunctionDef) and not n.name.startswith("_")]
    head = f"class {node.name}: {ast.get_docstring(node) or ''}\nmethods: {', '.join(m.name for m in methods)}"
    if not node.name.startswith("_"):
        first = methods[0].lineno - 1 if methods else node.end_lineno or node.lineno
        yield Chunk(node.name, f"{module} > {node.name}", node.lineno, max(node.lineno, first), head, (node.name,))
        for method in methods:
            yield from _function(method, lines, f"{module} > {node.name}", f"{node.name}.{method.name}", source)


def _function(
    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef, lines: list[str], title: str, name: str, source: bool
) -> Iterator[Chunk]:
    doc = ast.get_docstring(node)
    if name.startswith("_") or (doc is None and not source):
        return
    first, last = node.lineno, node.end_lineno or node.lineno
    if source:
        shown = "\n".join(lines[first - 1 : last])[:MAX_CHARACTERS]
    else:
        body = node.body[0]
        signature = " ".join(line.strip() for line in lines[first - 1 : body.lineno - 1]) or lines[first - 1]
        shown = f"{signature}\n{doc}"  # what is searched; a citation of it opens the whole function
    yield Chunk(name, f"{title} > {name}", first, last, shown, (name, name.rsplit(".", 1)[-1]))
