# Parts of pages: one HTML file that needs no other.
import base64
import html
import io
import os
import shlex
import textwrap

import numpy as np

STYLE = """
:root { color-scheme: light }
* { box-sizing: border-box }
body { font: 16px/1.5 Georgia, 'Times New Roman', serif; max-width: 64rem; margin: 1.5rem auto; padding: 0 .75rem; color: #111; background: #fff;
  overflow-wrap: break-word }
h1, h2, table, figcaption, summary, .answer { font-family: system-ui, sans-serif }
h1 { font-size: 1.6rem; line-height: 1.2 }
h2 { margin-top: 2.5rem; border-bottom: 1px solid #ccc }
.answer { background: #eef4f9; border-left: 4px solid #0072B2; padding: .5rem 1rem }
.answer li { margin: .3rem 0 }
.figures { display: flex; flex-wrap: wrap; gap: 1rem 2rem; justify-content: center; align-items: flex-start }
figure { flex: 0 1 30rem; margin: 1rem 0; text-align: center; break-inside: avoid; min-width: 0 }
.alone figure { max-width: 34rem; margin: 1rem auto }
img { width: 100%; height: auto }
figcaption { font-size: .9rem; color: #333 }
.box { overflow-x: auto; margin: 0 0 1.5rem }
table { border-collapse: collapse; font-size: .9rem }
.caption { font-family: system-ui, sans-serif; font-size: .9rem; font-weight: 600; margin: 1.5rem 0 .3rem }
th, td { padding: .2rem .6rem; text-align: right; border-bottom: 1px solid #ddd; vertical-align: top }
th { text-align: right }
tbody th { text-align: left; font-weight: 400; min-width: 8rem }
td { white-space: nowrap }
td.text { white-space: normal; min-width: 7rem }
th:first-child, th.text, td.text { text-align: left }
thead th { border-bottom: 2px solid #333; vertical-align: bottom }
code, pre { font-size: .9rem }
pre { background: #f4f4f4; padding: .5rem; overflow-x: auto }
pre.said { white-space: pre-wrap; overflow-wrap: anywhere }
summary { cursor: pointer; margin: 1rem 0 }
.failed { border-left: 4px solid #D55E00; padding-left: 1rem; margin: 1rem 0 }
.expected { border-left: 4px solid #999; padding-left: 1rem; margin: 1rem 0 }
"""

# Figures are shown 4.2 inches wide on a phone: letters of 12 points are then 14 pixels high.
WIDTH, LETTERS = 4.2, 12
plt.rcParams.update({"font.size": LETTERS, "axes.titlesize": LETTERS, "axes.labelsize": LETTERS, "legend.fontsize": LETTERS, "savefig.bbox": None})


def panels(count, title):
    """So many panels, one below the other."""
    figure, axes = plt.subplots(count, 1, figsize=(WIDTH, 0.4 + 3.4 * count), squeeze=False, layout="constrained")
    figure.suptitle(plain(title), fontsize=LETTERS)
    return figure, list(axes[:, 0])


def one_panel(title, height=3.6):
    title = textwrap.fill(title, 40)
    above = 0.15 + 0.22 * (title.count("\n") + 1)
    figure, axes = plt.subplots(figsize=(WIDTH, height))
    axes.set_title(plain(title))
    figure.subplots_adjust(left=0.85 / WIDTH, right=1 - 0.15 / WIDTH, top=1 - above / height, bottom=0.6 / height)
    return figure, axes


def legend_below(axes, columns=1):
    """Below the one panel of its figure, which grows by it."""
    handles, labels = axes.get_legend_handles_labels()
    if not handles:
        return
    labels = [textwrap.fill(label, 40 // columns) for label in labels]
    below = 0.24 * np.ceil(sum(label.count("\n") + 1 for label in labels) / columns) + 0.1
    figure, (width, height) = axes.figure, axes.figure.get_size_inches()
    above, under = height * (1 - figure.subplotpars.top), height * figure.subplotpars.bottom
    height += below
    figure.set_size_inches(width, height)
    figure.subplots_adjust(top=1 - above / height, bottom=(under + below) / height)
    figure.legend(handles, labels, loc="upper left", bbox_to_anchor=(0, below / height), ncols=columns, handlelength=2.2, columnspacing=1.0, labelspacing=0.3,
                  borderpad=0, borderaxespad=0.2)


def escaped(text):
    return html.escape(str(text), quote=False)


def known(value):
    return value is not None and np.isfinite(value)


def number(value, digits=5):
    """Of a result; what is next to nothing has two digits, as more of them are noise."""
    if not known(value):
        return "–"
    return f"{value:.1e}" if 0 < abs(value) < 1e-6 else f"{value:.{digits}g}"


def paragraph(*sentences):
    return "<p>" + " ".join(sentences) + "</p>"


def items(lines):
    return "<ul>" + "".join(f"<li>{line}</li>" for line in lines) + "</ul>" if lines else ""


def details(summary, *parts):
    return "\n".join([f"<details><summary>{summary}</summary>", *parts, "</details>"])


def html_table(head, rows, caption, text=()):
    """Cells are HTML; the first of each row is its head. text: numbers of columns that hold no numbers."""
    kind = lambda i: ' class="text"' if i in text else ""
    heads = "".join(f'<th scope="col"{kind(i)}>{one}</th>' for i, one in enumerate(head))
    lines = [f'<p class="caption">{caption}</p>', '<div class="box"><table>', f"<thead><tr>{heads}</tr></thead>", "<tbody>"]
    for first, *rest in rows:
        lines.append(f'<tr><th scope="row">{first}</th>' + "".join(f"<td{kind(i)}>{one}</td>" for i, one in enumerate(rest, 1)) + "</tr>")
    return "\n".join(lines + ["</tbody>", "</table></div>"])


def in_words(cells):
    return any(cell.strip("0123456789.e+-– ") for cell in cells)


def told_once(columns):
    """Of columns (head, cells) those to show, and (head, cell) of those that say the same in every row. Of columns of the same words the first stays,
    and of all columns the first."""
    shown, same = [], []
    for head, cells in columns:
        if in_words(cells) and any(list(map(str.lower, cells)) == list(map(str.lower, others)) for _, others in shown):
            continue
        if shown and len(cells) > 1 and len(set(cells)) == 1:
            same.append((head, cells[0]))
        else:
            shown.append((head, cells))
    return shown, same


def column_table(columns, caption, text=()):
    """A table of columns (head, cells). What is the same in all rows is told in the caption. text: heads of columns that hold no numbers."""
    shown, same = told_once(columns)
    known_once = [f"{head} {cell}" for head, cell in same if cell != "–"]
    if known_once:
        caption += ". The same in all rows: " + ", ".join(known_once)
    heads = [head for head, _ in shown]
    return html_table(heads, list(zip(*[cells for _, cells in shown])), caption, [i for i, head in enumerate(heads) if head in text])


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


def figures(images):
    """Side by side where there is room."""
    return f'<div class="{"figures" if len(images) > 1 else "alone"}">' + "\n".join(images) + "</div>" if images else ""


def command(launcher, scene, settings, ranks, output, peer="none", penalty=""):
    """A run by itself, as it is typed in a shell. launcher: its words; none: mpirun for more than one rank."""
    words = launcher or (["mpirun", "-n", "{ranks}"] if ranks > 1 else [])
    words = [word.replace("{ranks}", str(ranks)) for word in words] if peer == "none" else []
    words += ["mortise", "run", scene] if peer == "none" else ["mortise", "peer", scene, "--by", peer]
    words += ["--penalty", penalty] if peer != "none" and penalty else []
    for setting in settings:
        words += ["--set", setting]
    return shlex.join(words + ["-o", output])


def html_commands(program, directory, commands):
    """commands: of what, and the command, for a shell in the directory."""
    path = f'cd {shlex.quote(os.path.abspath(directory))} && export PATH={shlex.quote(os.path.dirname(program))}:"$PATH"'
    lines = [line for name, one in commands for line in (f"<p>{escaped(name)}</p>", f"<pre>{escaped(one)}</pre>")]
    return details("Commands of single runs", paragraph("A shell needs this line once:"), f"<pre>{escaped(path)}</pre>",
                   paragraph("Then each of the following is a run by itself, with its results in <code>again</code>."), *lines)


def html_page(title, parts):
    """The page, of parts that are HTML."""
    return "\n".join(["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">',
                      '<meta name="viewport" content="width=device-width, initial-scale=1">',
                      f"<title>{escaped(title)}</title><style>{STYLE}</style></head><body>", f"<h1>{escaped(title)}</h1>", *parts, "</body></html>"])


def write_page(path, text):
    """At once: whoever finds it finds all of it."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
