"""Workflow step: speed at one time for the four orientations, as the paper's Figures 6, 8, 11 and 12."""
import numpy as np

from studies.borehole.cases import CAVITY_RADIUS, PROBE_RADIUS, SNAPSHOT_TIME, TURN
from studies.borehole.figures import TITLES, case_of_file, materials_title
from studies.common import style

HALF_WIDTH = 9.0  # m

data = {case_of_file(path): np.load(path) for path in snakemake.input.runs}  # noqa: F821
axis = next(iter(data.values()))["axis"]
speeds = {case: np.hypot(*np.moveaxis(fields["velocity"], -1, 0)) for case, fields in data.items()}
in_order = sorted(speeds, key=lambda case: list(TITLES).index(case.axes))
# One scale for the four. The overshoot behind the front would claim its upper end: cut where one point in 500 is above.
top = max(float(np.nanpercentile(speed, 99.8)) for speed in speeds.values())

figure, panels = style.plt.subplots(2, 2, figsize=(style.FULL_WIDTH, 6.6), sharex=True, sharey=True)
for letter, panel, case in zip("abcd", panels.flat, in_order):
    image = panel.imshow(speeds[case], origin="lower", extent=[axis[0], axis[-1]] * 2, vmin=0, vmax=top,
                         cmap=style.SPEED_MAP)
    style.plan_view(panel, HALF_WIDTH)
    panel.add_patch(style.plt.Circle((0, 0), CAVITY_RADIUS, color="white", zorder=2))
    turn = TURN[case.axes]
    if case.material == "isotropic" or case.axes in ("horizontal", "turned"):
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        front = case.stiffness.front(SNAPSHOT_TIME, CAVITY_RADIUS) @ rotation.T
        panel.plot(*front.T, color="white", linestyle=(0, (4, 3)), linewidth=0.9)
    panel.plot(PROBE_RADIUS * np.cos(turn), PROBE_RADIUS * np.sin(turn), "o", color="black", markeredgecolor="white",
               markersize=4)
    style.panel_label(panel, f"{letter}) {TITLES[case.axes]}")
for panel in panels[0]:
    panel.set_xlabel("")
for panel in panels[:, 1]:
    panel.set_ylabel("")
figure.colorbar(image, ax=panels, label="speed [m/s]", shrink=0.7, extend="max")
figure.suptitle(f"{materials_title(in_order[0])}, t = {1e3 * SNAPSHOT_TIME:g} ms; dashed: exact front, dot: probe",
                fontsize=9)
style.save(figure, snakemake.output[0])  # noqa: F821
