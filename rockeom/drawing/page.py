"""Pieces of HTML pages: figures, tables, lists, and a page that needs no other file.

Names and sentences may be the user's: they are data, and escaped.
"""

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape

from matplotlib.figure import Figure


def image(figure: Figure, words: str, kind: str = "svg", dpi: float = 72) -> str:
    """A figure as a file within the page, so that no names in it meet others.

    words : for those who do not see it. kind : "svg" of lines, "png" of many points.
    """
    kept = io.BytesIO()
    figure.savefig(kept, format=kind, dpi=dpi)
    data = base64.b64encode(kept.getvalue()).decode()
    media = "svg+xml" if kind == "svg" else kind
    return f'<img alt="{escape(words)}" src="data:image/{media};base64,{data}">'


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], style: str = "") -> str:
    """A table of texts; style : of each cell."""
    of_cell = f' style="{style}"' if style else ""
    head = "".join(f"<th{of_cell}>{escape(word)}</th>" for word in heads)
    body = "".join(
        f"<tr>{''.join(f'<td{of_cell}>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def bullets(sentences: Iterable[str]) -> str:
    """A list of sentences."""
    return f"<ul>{''.join(f'<li>{escape(sentence)}</li>' for sentence in sentences)}</ul>"


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Names and values."""
    items = (f"<div><dt>{escape(name)}</dt><dd>{escape(value)}</dd></div>" for name, value in pairs)
    return f"<dl>{''.join(items)}</dl>"


def wide(content: str) -> str:
    """Content that may be wider than a small screen, and scrolls there by itself."""
    return f'<div class="wide">{content}</div>'


def whole(title: str, body: str) -> str:
    """A page with its style."""
    return _WHOLE.format(title=escape(title), body=body)


_WHOLE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>
body {{ font: 14px/1.45 system-ui, sans-serif; max-width: 52rem; margin: 2rem auto; padding: 0 1rem;
  color: #222 }}
h1 {{ font-size: 1.5rem }} h2 {{ font-size: 1.1rem; margin-top: 1.6rem }} img {{ width: 100% }}
dl {{ display: grid; gap: 0.1rem 1.5rem;
  grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)) }}
dl > div {{ display: flex; justify-content: space-between; gap: 1rem }}
dt {{ color: #666 }} dd {{ margin: 0; text-align: right }}
.wide {{ overflow-x: auto }}
table {{ border-collapse: collapse; font-size: 0.85rem; width: 100% }}
th, td {{ text-align: right; padding: 0.15rem 0.4rem; border-bottom: 1px solid #ddd }}
td {{ white-space: nowrap }}
th:first-child, td:first-child {{ text-align: left; white-space: normal }}
.verdict {{ font-size: 1.15rem; border-left: 4px solid #0072B2; padding-left: 0.8rem }}
.question {{ border-left: 4px solid #D55E00; padding-left: 0.8rem }}
@media print {{ body {{ font-size: 10px; margin: 0 }} }}
</style></head><body>
<h1>{title}</h1>
{body}
</body></html>
"""
