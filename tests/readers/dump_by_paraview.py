"""usage: pvpython dump_by_paraview.py SERIES.pvd FOLDER: what ParaView finds, FOLDER/NUMBER.npz for each time of the series; of
stresses also what its calculator makes of their named components, von Mises' stress."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from dump_by_vtk import found_in
from paraview import servermanager
from paraview.simple import Calculator, PVDReader
from render_mises import MISES
from vtkmodules.util.numpy_support import vtk_to_numpy

series = PVDReader(FileName=sys.argv[1])
series.UpdatePipelineInformation()
for number, t in enumerate(series.TimestepValues):
    series.UpdatePipeline(t)
    found = found_in(servermanager.Fetch(series))
    found["timestep"] = t
    if "cell:cauchy_stress" in found:
        mises = Calculator(Input=series, AttributeType="Cell Data", ResultArrayName="mises", Function=MISES)
        mises.UpdatePipeline(t)
        found["mises"] = vtk_to_numpy(servermanager.Fetch(mises).GetCellData().GetArray("mises"))
    np.savez(Path(sys.argv[2]) / f"{number}.npz", **found)
