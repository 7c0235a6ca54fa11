#!/usr/bin/env bash
# meshio of Debian 12 (package 7.0.0-3, which calls itself 5.0.0): meshio.read of a .vtu that holds a text in its field data.
#
# A good guess: field data of a .vtu may hold texts (vtkStringArray, in the file a DataArray of type "String" of character codes), a
# title or units, say; VTK and ParaView write and read them. A reader that does not know them leaves them out, or raises an error of its
# own (meshio.ReadError), which a script that goes through many files catches with `except Exception` or `except meshio.ReadError`.
#
# What happens: meshio.read tries its formats, prints the reason with "Couldn't read file ... as vtu" and calls sys.exit(1). SystemExit is
# no Exception: it passes by both, and the whole program ends, exit status 1, without a traceback. The same file without the text is read.
# VTK 9.1 reads both. The number of the package and that of the module differ, so that neither tells what the other's manual is of.
#
# Whom it hurts: who puts units or a title into a .vtu, and whose users read it by meshio; who reads files of others in a loop, in a
# notebook or behind a server, where one file ends all the rest. To be safe, catch SystemExit beside Exception.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for package in python3-meshio=7.0.0-3 python3-rich=13.3.1-1 python3-numpy=1:1.24.2-1+deb12u1 python3-pygments=2.14.0+dfsg-1 \
    python3-commonmark=0.9.1-4 python3-typing-extensions=4.4.0-1 python3-lxml=4.9.2-1+deb12u1 libblas3=3.11.0-2 liblapack3=3.11.0-2 \
    libgfortran5=12.2.0-14+deb12u1 libquadmath0=12.2.0-14+deb12u1; do
    apt-get download -q "$package" >/dev/null 2>&1 || { echo "$package cannot be fetched: this is not Debian 12 as it was then"; exit 1; }
done
for file in *.deb; do dpkg -x "$file" root; done
libraries=$(find "$PWD/root/usr/lib" -name 'lib*.so*' -printf '%h\n' | sort -u | paste -sd :)

cat >read.py <<'PYTHON'
import pathlib
import sys

sys.path.insert(0, sys.argv[1])
import meshio

VTU = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">0.5</DataArray>
{text}
</FieldData><Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
"""
TITLE = '<DataArray type="String" Name="title" NumberOfTuples="1" format="ascii">116 101 115 116 0</DataArray>'


def read(text):
    pathlib.Path("one.vtu").write_text(VTU.format(text=text))
    try:
        try:
            return f"{len(meshio.read('one.vtu').points)} points"
        except Exception as error:
            return f"caught {type(error).__name__}"
    except SystemExit as end:
        return f"SystemExit({end.code}) passed by `except Exception`"


print("meshio.__version__ ", meshio.__version__)
without, with_text = read(""), read(TITLE)
print("without a text     ", without)
print("with a title       ", with_text)
found = (meshio.__version__, without, with_text)
sys.exit(found != ("5.0.0", "3 points", "SystemExit(1) passed by `except Exception`"))
PYTHON

if LD_LIBRARY_PATH=$libraries /usr/bin/python3 -I read.py "$PWD/root/usr/lib/python3/dist-packages"; then
    echo "as described"
else
    echo "NOT as described"
    exit 1
fi
