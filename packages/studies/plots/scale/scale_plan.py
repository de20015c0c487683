# Draws plan.csv: how elements, contact work and memory spread over the ranks. Arguments: plan.csv, stem of the images, title.
import csv

table, stem, title = sys.argv[1:]
with open(table, newline="") as file:
    rows = list(csv.DictReader(file))

SHOWN = [("elements", "elements"), ("slave_work", "overlaps integrated"), ("memory_mib", "memory / MiB")]
figure, axes = plt.subplots(1, len(SHOWN), figsize=(6.3, 2.5), layout="constrained")
figure.suptitle(plain(title), fontsize=10)
for axis, (name, label), colour in zip(axes, SHOWN, COLOURS):
    values = sorted(float(row[name]) for row in rows)
    mean = sum(values) / len(values)
    axis.fill_between(range(len(values)), values, step="mid", color=colour, alpha=0.3, linewidth=0)
    axis.step(range(len(values)), values, where="mid", color=colour, linestyle="-")
    axis.axhline(mean, color="#000000", linewidth=0.8, linestyle="--")
    axis.set_ylim(0, 1.15 * max(max(values), 1e-300))
    axis.set_xlabel("ranks in ascending order")
    axis.set_title(label + (f": max/mean {max(values) / mean:.2f}" if mean > 0 else ""), fontsize=8)
save(figure, stem)
