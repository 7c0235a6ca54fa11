"""usage: python3 dump_by_vtk.py FOLDER FRAME.vtu...: what VTK's own reader finds, FOLDER/NUMBER.npz for each frame."""
import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray


def found_in(grid):
    """Arrays of a vtkUnstructuredGrid by name: KIND:NAME with units and names of components beside them."""
    cells = grid.GetCells()
    found = {"points": vtk_to_numpy(grid.GetPoints().GetData()) if grid.GetNumberOfPoints() else np.empty((0, 3)),
             "connectivity": vtk_to_numpy(cells.GetConnectivityArray()),
             "time": grid.GetFieldData().GetArray("TimeValue").GetValue(0)}
    for kind, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            name = array.GetName()
            found[f"{kind}:{name}"] = vtk_to_numpy(array)
            found[f"unit:{name}"] = array.GetInformation().Get(vtkDataArray.UNITS_LABEL()) or ""
            if array.HasAComponentName():
                found[f"names:{name}"] = " ".join(array.GetComponentName(k) or "" for k in
                                                  range(array.GetNumberOfComponents()))
    return found


if __name__ == "__main__":
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    for number, path in enumerate(sys.argv[2:]):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        if reader.GetErrorCode() != 0:
            sys.exit(f"{path}: error {reader.GetErrorCode()} of VTK")
        np.savez(Path(sys.argv[1]) / f"{number}.npz", **found_in(reader.GetOutput()))
