# arguments: point.csv, stem of the images, component ("11"), title, name of the strain, unit of stress or ""
import csv

table, stem, component, title, strain_name, unit = sys.argv[1:]
with open(table, encoding="utf-8") as file:
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
column = lambda name: [row[name] for row in rows]
indices = "".join("₀₁₂₃"[int(digit)] for digit in component)
strain, alpha = column("strain_" + component), column("equivalent_plastic_strain")

figure, axes = panels(2 if any(alpha) else 1, title)
stress, von_mises = column("cauchy_" + component), column("von_mises")
name = f"Cauchy stress σ{indices}"
axes[0].plot(strain, stress, label=name)
# Of one stress alone von Mises' is its size.
if any(abs(one - abs(other)) > 1e-6 * max(von_mises) for one, other in zip(von_mises, stress)):
    axes[0].plot(strain, von_mises, label="von Mises stress")
    axes[0].legend()
    name = "stress"
axes[0].set_ylabel(plain(name + (f" / {unit}" if unit else "")))
if any(alpha):
    axes[1].plot(strain, alpha)
    axes[1].set_ylabel("equivalent plastic strain α")
for one in axes:
    one.set_xlabel(f"{strain_name} ε{indices}")
save(figure, stem)
