"""Workflow step: all figures of the study."""
import json
from pathlib import Path

from studies.integrators import figures, figures_of_steps
from studies.integrators.analysis import read_comparison

summary = json.loads(Path("summary.json").read_text())
compared = {path.parent.name: read_comparison(path.parent) for path in sorted(Path("comparisons").glob("*/compare.json"))}
steps, waves = (json.loads(Path(f"measured/{name}.json").read_text()) for name in ("steps", "waves"))
out = Path("figures")
out.mkdir(exist_ok=True)
figures.precision(compared, out / "precision.png")
figures.orders(summary, out / "orders.png")
figures.stiff(compared, out / "stiff.png")
figures.flutter(summary, out / "flutter.png")
figures.events(compared, summary, out / "events.png")
figures.energy(compared, out / "energy.png")
figures_of_steps.dispersion(steps, out / "dispersion.png")
figures_of_steps.stability(steps, out / "stability.png")
figures_of_steps.wave_directions(waves, out / "wave_directions.png")
figures_of_steps.wave_lengths(waves, out / "wave_lengths.png")
