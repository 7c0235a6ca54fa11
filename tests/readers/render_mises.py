"""Draws von Mises' stress of one frame of a run with ParaView, on the shape as it is.

usage: pvpython render_mises.py RUN_FOLDER PICTURE.png [TIME]     TIME in s, default: of the last frame
"""
import sys
from pathlib import Path

from paraview.simple import (Calculator, ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar, PVDReader, Render,
                             SaveScreenshot, Show, WarpByVector)

# The filter Yield Criteria of newer ParaViews does the same; Debian 12's 5.11 has it not.
XX, YY, ZZ, XY, YZ, XZ = (f"cauchy_stress_{name}" for name in ("XX", "YY", "ZZ", "XY", "YZ", "XZ"))
MISES = f"sqrt(0.5*(({XX}-{YY})^2+({YY}-{ZZ})^2+({ZZ}-{XX})^2)+3*({XY}^2+{YZ}^2+{XZ}^2))"


def render(folder, picture, time=None):
    series = PVDReader(FileName=str(Path(folder) / "fields.pvd"))
    series.UpdatePipelineInformation()
    times = list(series.TimestepValues)
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 900]
    view.ViewTime = times[-1] if time is None else min(times, key=lambda t: abs(t - time))
    mises = Calculator(Input=series, AttributeType="Cell Data", ResultArrayName="mises", Function=MISES)
    shape = WarpByVector(Input=mises, Vectors=["POINTS", "displacement"])
    shown = Show(shape, view)
    ColorBy(shown, ("CELLS", "mises"))
    shown.RescaleTransferFunctionToDataRange()
    shown.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(GetColorTransferFunction("mises"), view)
    bar.Title, bar.ComponentTitle = f"von Mises stress, Pa, at t = {view.ViewTime:.4g} s", ""
    view.ResetCamera()
    Render(view)
    SaveScreenshot(str(picture), view)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    render(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) == 4 else None)
