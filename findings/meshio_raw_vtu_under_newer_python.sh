#!/usr/bin/env bash
# meshio of Debian 13 (5.3.5) under its Python (3.13.5-2+deb13u5): meshio.read of a .vtu with its data appended raw.
#
# A good guess: what meshio has read for years (raw appended data, the smallest kind of .vtu, which VTK, ParaView and simulation codes
# write) it reads on today's stable Debian, whose package is the newest release of meshio; neither file nor meshio has changed.
#
# What happens: meshio.read raises binascii.Error from within the first array of any such file: "Incorrect padding", or a complaint
# about the number of characters. meshio encodes each array in base64 and joins the texts to one, padding in the midst of it, then
# decodes from where an array begins to the end of everything. Under Python 3.11 base64.b64decode ends at the first padding and passes
# over the rest. Debian's 3.13.5, with its security updates up to 2026, goes on behind the padding and refuses the whole. It strikes
# arrays whose bytes, with their header of 8 (or 4), are no multiple of three: points are 24 n + 8 (or 24 n + 4) bytes, so every file.
# The same arrays as base64 within each element (format="binary") are read. Debian's update of meshio of 2026-09 only skips the test of
# its own that fails since (python-meshio 7.0.0-really-5.3.5-6+deb13u1, #1134307).
#
# Whom it hurts: scripts that read results by meshio, on the day the system is updated; codes whose tests read their .vtu by meshio and
# blame their writer; any program that decodes base64 joined from padded pieces. Write format="binary" for such readers, or read by VTK.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mirror=$(apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(COMPONENT)|$(REPO_URI)' | sed -n 's/^Debian|Debian|main|//p' | head -n 1)
mkdir -p state/lists/partial cache/archives/partial
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror trixie main" >sources.list
apt_of_trixie() {
    apt-get -q -o Dir::Etc::SourceList="$PWD/sources.list" -o Dir::Etc::SourceParts=- -o Dir::State::Lists="$PWD/state/lists" \
        -o Dir::Cache="$PWD/cache" -o APT::Sandbox::User=root "$@" >/dev/null 2>&1
}
apt_of_trixie update || { echo "the lists of Debian 13 cannot be fetched"; exit 1; }
for package in libc6=2.41-12+deb13u5 python3.13-minimal=3.13.5-2+deb13u5 libpython3.13-minimal=3.13.5-2+deb13u5 \
    libpython3.13-stdlib=3.13.5-2+deb13u5 libexpat1=2.9.0-1~deb13u1 zlib1g=1:1.3.dfsg+really1.3.1-1+deb13u1 liblzma5=5.8.1-1+deb13u2 \
    libbz2-1.0=1.0.8-6 libffi8=3.4.8-2 libssl3t64=3.5.9-1~deb13u1 libgcc-s1=14.2.0-19 libstdc++6=14.2.0-19 libblas3=3.12.1-6 \
    liblapack3=3.12.1-6 libgfortran5=14.2.0-19 libquadmath0=14.2.0-19 python3-numpy=1:2.2.4+ds-1 \
    python3-meshio=7.0.0-really-5.3.5-6+deb13u1 python3-rich=13.9.4-1 python3-pygments=2.18.0+dfsg-2+deb13u1 \
    python3-markdown-it=3.0.0-3 python3-mdurl=0.1.2-1; do
    apt_of_trixie download "$package" || { echo "$package cannot be fetched: this is not Debian 13 as it was then"; exit 1; }
done
for file in *.deb; do dpkg -x "$file" root; done
libraries=$(find "$PWD/root/usr/lib" -name 'lib*.so*' -printf '%h\n' | sort -u | paste -sd :)

cat >read.py <<'PYTHON'
import base64
import struct
import sys

sys.path.insert(0, sys.argv[1])
import meshio

# One triangle: (attributes, bytes) of points, connectivity, offsets, types.
ARRAYS = [('type="Float64" NumberOfComponents="3"', struct.pack("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)),
          ('type="Int64" Name="connectivity"', struct.pack("<3q", 0, 1, 2)),
          ('type="Int64" Name="offsets"', struct.pack("<q", 3)),
          ('type="UInt8" Name="types"', b"\x05")]


def write(path, raw):
    elements, appended = [], b""
    for attributes, values in ARRAYS:
        block = struct.pack("<Q", len(values)) + values
        if raw:
            elements.append(f'<DataArray {attributes} format="appended" offset="{len(appended)}"/>')
            appended += block
        else:
            elements.append(f'<DataArray {attributes} format="binary">{base64.b64encode(block).decode()}</DataArray>')
    points, *cells = elements
    text = ('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>'
            f'<Piece NumberOfPoints="3" NumberOfCells="1"><Points>{points}</Points><Cells>{"".join(cells)}</Cells></Piece>'
            "</UnstructuredGrid>\n").encode()
    if raw:
        text += b'<AppendedData encoding="raw">\n_' + appended + b"\n</AppendedData>\n"
    with open(path, "wb") as file:
        file.write(text + b"</VTKFile>\n")


def outcome(action):
    try:
        return str(action())
    except Exception as error:
        return f"{type(error).__module__}.{type(error).__name__}: {error}"


found = [sys.version.split()[0], meshio.__version__]
for raw in (False, True):
    write("one.vtu", raw)
    found.append(outcome(lambda: f"{len(meshio.read('one.vtu').points)} points"))
found.append(outcome(lambda: base64.b64decode("QUE=QUJD")))
for what, value in zip(("Python", "meshio", "base64 in elements", "raw, appended", "b64decode of 'QUE=QUJD'"), found):
    print(f"{what:24}", value)
refused = found[3].startswith("binascii.Error: ") and found[4] == "binascii.Error: Incorrect padding"
sys.exit(found[:3] != ["3.13.5", "5.3.5", "3 points"] or not refused)
PYTHON

loader=$(find root/usr/lib -name 'ld-linux-x86-64.so.2' | head -n 1)
if PYTHONHOME=$PWD/root/usr "$loader" --library-path "$libraries" root/usr/bin/python3.13 read.py \
    "$PWD/root/usr/lib/python3/dist-packages"; then
    echo "as described"
else
    echo "NOT as described"
    exit 1
fi
