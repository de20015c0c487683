# What pages consist of: one HTML file that needs no other.
import base64
import html
import io
import os

import numpy as np

STYLE = """
:root { color-scheme: light }
body { font: 16px/1.5 Georgia, 'Times New Roman', serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #111; background: #fff }
h1, h2, table, figcaption { font-family: system-ui, sans-serif }
h2 { margin-top: 2.5rem; border-bottom: 1px solid #ccc }
figure { margin: 1.5rem 0; text-align: center; break-inside: avoid }
img { max-width: 100% }
figcaption { font-size: .85rem; color: #333 }
table { border-collapse: collapse; margin: 1.5rem auto; font-size: .85rem; break-inside: avoid }
caption { font-weight: 600; padding: .3rem }
th, td { padding: .2rem .6rem; text-align: right; border-bottom: 1px solid #ddd }
thead th { border-bottom: 2px solid #333 }
tbody th { text-align: left; font-weight: 400 }
code, pre { font-size: .8rem }
pre { white-space: pre-wrap; background: #f4f4f4; padding: .5rem }
.failed { border-left: 4px solid #D55E00; padding-left: 1rem }
"""


def escaped(text):
    return html.escape(str(text), quote=False)


def number(value):
    return "–" if value is None or not np.isfinite(value) else f"{value:.6g}"


def paragraph(*sentences):
    return "<p>" + " ".join(sentences) + "</p>"


def html_table(head, rows, caption):
    """Cells are HTML; the first of each row is its head."""
    heads = "".join(f'<th scope="col">{one}</th>' for one in head)
    lines = ["<table>", f"<caption>{caption}</caption>", f"<thead><tr>{heads}</tr></thead>", "<tbody>"]
    for first, *rest in rows:
        lines.append(f'<tr><th scope="row">{first}</th>' + "".join(f"<td>{one}</td>" for one in rest) + "</tr>")
    return "\n".join(lines + ["</tbody>", "</table>"])


def svg(figure):
    """The figure as text, which closes it."""
    image = io.BytesIO()
    figure.savefig(image, format="svg", metadata={"Date": None})
    plt.close(figure)
    return image.getvalue()


def html_image(image, title, caption):
    """An SVG as part of the page."""
    data = base64.b64encode(image).decode()
    alternative = html.escape(f"{title}: {caption}")
    return (f'<figure><img src="data:image/svg+xml;base64,{data}" alt="{alternative}">'
            f"<figcaption><b>{escaped(title)}.</b> {escaped(caption)}</figcaption></figure>")


def html_figure(figure, title, caption):
    """The figure as part of the page."""
    return html_image(svg(figure), title, caption)


def html_page(title, parts):
    """The page, of parts that are HTML."""
    return "\n".join(["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">',
                      f"<title>{escaped(title)}</title><style>{STYLE}</style></head><body>", f"<h1>{escaped(title)}</h1>", *parts, "</body></html>"])


def write_page(path, text):
    """At once: whoever finds it finds all of it."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
