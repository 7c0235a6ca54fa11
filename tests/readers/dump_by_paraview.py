"""usage: pvpython dump_by_paraview.py SERIES.pvd FOLDER: what ParaView finds, FOLDER/NUMBER.npz for each time of the series; of
stresses also what its filter says of von Mises' (ParaView calls the filter Yield Criteria)."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from dump_by_vtk import found_in
from paraview import servermanager
from paraview.simple import PVDReader, YieldCriteria
from vtkmodules.util.numpy_support import vtk_to_numpy

series = PVDReader(FileName=sys.argv[1])
series.UpdatePipelineInformation()
for number, t in enumerate(series.TimestepValues):
    series.UpdatePipeline(t)
    found = found_in(servermanager.Fetch(series))
    found["timestep"] = t
    if "cell:cauchy_stress" in found:
        criteria = YieldCriteria(Input=series, InputArray=["CELLS", "cauchy_stress"])
        criteria.UpdatePipeline(t)
        data = servermanager.Fetch(criteria).GetCellData()
        names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
        mises = next(name for name in names if "Mises" in name)
        found["mises"] = vtk_to_numpy(data.GetArray(mises))
    np.savez(Path(sys.argv[2]) / f"{number}.npz", **found)
