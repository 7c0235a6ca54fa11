"""Decks, tables and fields: what is written is read back."""
import tempfile
import tomllib
import unittest
import zlib
from pathlib import Path

import numpy as np

from studies.common.decks import overlaid, read_deck, write_deck
from studies.common.fields import frame_path, read_frame, sample_on_grid
from studies.common.results import find_number, observed_order, read_summary, read_table


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class TestDecks(InFolder):
    DECK = {"title": 'a "quoted" one', "mesh": {"size": [0.1, 1e-07], "curved": True},
            "material": [{"density": 1000.0, "axes": {"angle": "0.2*sin(x/5)"}}, {"density": 1.0}],
            "output": {"probes": [{"name": "p0", "at": [5.0, 0.0]}, {"name": "p1", "at": [0.0, 5.0]}]}}

    def test_Deck_WrittenAndRead_IsTheSame(self):
        write_deck(self.DECK, self.folder / "case.toml", "two\nlines")
        self.assertEqual(read_deck(self.folder / "case.toml"), self.DECK)

    def test_Overlay_NestedTable_ChangesOneKey(self):
        changed = overlaid(self.DECK, {"material": {"axes": {"angle": 0.5}}, "mesh": {"size": [1.0, 1.0]}})
        self.assertEqual(changed["material"], [{"density": 1000.0, "axes": {"angle": 0.5}}, {"density": 1.0}])
        self.assertEqual(changed["mesh"], {"size": [1.0, 1.0], "curved": True})
        self.assertEqual(self.DECK["mesh"]["size"], [0.1, 1e-07])

    def test_Writer_UnknownType_IsRefused(self):
        with self.assertRaises(TypeError):
            write_deck({"a": None}, self.folder / "case.toml")

    def test_StudyDecks_AllOfThem_AreToml(self):
        for path in Path(__file__).parents[2].glob("*/*.toml"):
            with self.subTest(path=path), open(path, "rb") as file:
                tomllib.load(file)


class TestResults(InFolder):
    def test_Table_HeadingsWithUnits_AreSplit(self):
        (self.folder / "probes.csv").write_text("t [s],p0.v_r [m/s],count\n0,1.5,2\n0.5,-1e-300,3\n")
        table = read_table(self.folder / "probes.csv")
        np.testing.assert_array_equal(table["p0.v_r"], [1.5, -1e-300])
        self.assertEqual(table.units, {"t": "s", "p0.v_r": "m/s", "count": ""})
        with self.assertRaisesRegex(KeyError, "no column 'p1'"):
            table["p1"]

    def test_Summary_OfAFailedRun_IsRefused(self):
        (self.folder / "summary.json").write_text('{"status": "failed", "message": "element 7 inverted"}')
        with self.assertRaisesRegex(ValueError, "element 7 inverted"):
            read_summary(self.folder)

    def test_Number_InAnyGroup_IsFoundOnce(self):
        summary = {"energies": {"balance_error": 1e-5}, "dt": 2}
        self.assertEqual(find_number(summary, "balance_error"), 1e-5)
        with self.assertRaises(KeyError):
            find_number(summary, "absent")


class TestOrders(unittest.TestCase):
    def test_ObservedOrder_OfAPowerLaw_IsItsExponent(self):
        self.assertAlmostEqual(observed_order([100, 50, 25], [3 * h**1.5 for h in (100, 50, 25)]), 1.5)


class TestFields(InFolder):
    POINTS = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])
    TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])

    def write_frame(self):
        """A .vtu as VTK writes it by default: UInt32 header, blocks of 32768 bytes (here 32), zlib."""
        data = b""
        offsets = []
        for array in (self.POINTS[:, :2] @ [1, 10], self.POINTS, self.TRIANGLES.ravel().astype("<i8"),
                      np.array([3, 6], "<i8"), np.array([5, 5], "u1")):
            raw, block = np.ascontiguousarray(array).tobytes(), 32
            blocks = [zlib.compress(raw[i : i + block]) for i in range(0, len(raw), block)]
            offsets.append(len(data))
            sizes = [len(blocks), block, len(raw) % block] + [len(b) for b in blocks]
            data += np.array(sizes, "<u4").tobytes() + b"".join(blocks)
        def entry(name, kind, offset, n=1):
            return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{n}" format="appended" offset="{offset}"/>'
        head = ('<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt32" '
                'compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="2">'
                f'<PointData>{entry("speed", "Float64", offsets[0])}</PointData><CellData></CellData>'
                f'<Points>{entry("Points", "Float64", offsets[1], 3)}</Points>'
                f'<Cells>{entry("connectivity", "Int64", offsets[2])}{entry("offsets", "Int64", offsets[3])}'
                f'{entry("types", "UInt8", offsets[4])}</Cells></Piece></UnstructuredGrid>'
                '<AppendedData encoding="raw">_')
        (self.folder / "fields_000000.vtu").write_bytes(head.encode() + data + b"</AppendedData></VTKFile>")
        (self.folder / "fields.pvd").write_text('<VTKFile type="Collection"><Collection>'
                                                '<DataSet timestep="0.5" file="fields_000000.vtu"/></Collection></VTKFile>')

    def test_Frame_CompressedInBlocks_IsReadBack(self):
        self.write_frame()
        frame = read_frame(frame_path(self.folder, 0.5, 1e-9))
        np.testing.assert_array_equal(frame.points, self.POINTS[:, :2])
        np.testing.assert_array_equal(frame.triangles, self.TRIANGLES)
        np.testing.assert_array_equal(frame.point_data["speed"], [0, 2, 12, 10])

    def test_Frame_NoneAtThatTime_IsAnError(self):
        self.write_frame()
        with self.assertRaisesRegex(ValueError, "nearest"):
            frame_path(self.folder, 0.7, 1e-3)

    def test_Sample_LinearField_IsExactAndNanOutside(self):
        x, y = np.linspace(0, 4, 17), np.linspace(0, 1, 5)
        values = self.POINTS[:, :2] @ [1, 10]
        grid = sample_on_grid(self.POINTS[:, :2], self.TRIANGLES, values, x, y)
        X, Y = np.meshgrid(x, y)
        inside = X <= 2
        np.testing.assert_allclose(grid[inside], (X + 10 * Y)[inside], atol=1e-12)
        self.assertTrue(np.all(np.isnan(grid[~inside])))


if __name__ == "__main__":
    unittest.main()
