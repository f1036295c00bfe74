#!/bin/sh
# meshio cannot read a VTK XML file whose FieldData holds a string, which VTK itself writes and Slicer looks for.
#
# A .vtu, .vtp or .vti may carry arrays of type "String" in FieldData (VTK writes them as the character codes, each string
# ended by 0); 3D Slicer reads the frame of a mesh from one that is called SPACE. meshio 5.0.0 (python3-meshio 7.0.0-3 of
# Debian 12) knows numeric types only and gives up on the whole file, points and cells too: meshio.read prints
#   Illegal data type 'String'.
# and ends the program that called it (SystemExit 1) instead of raising an error. The same file without the string is read,
# and VTK 9.1 reads both. Whoever writes .vtu for both must say the frame elsewhere, for instance in a comment of the XML.
# Fails if meshio reads the file, or says something else. Needs apt-get download, python3-numpy.
set -eu
version=7.0.0-3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get download -q "python3-meshio=$version" python3-rich >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
mkdir root
for deb in ./*.deb; do dpkg -x "$deb" root; done
cat >write.py <<'PY'
import sys
text = '<DataArray type="String" Name="SPACE" NumberOfTuples="1" format="ascii">76 80 83 0</DataArray>' if sys.argv[1] == "string" else ""
print(f'''<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><FieldData>{text}</FieldData><Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>''')
PY
cat >read.py <<'PY'
import sys
sys.path.insert(0, "root/usr/lib/python3/dist-packages")
import meshio
try:
    m = meshio.read(sys.argv[1])
    print("read", meshio.__version__, m.points.shape)
except SystemExit as e:
    print("ended the program with", e.code)
except Exception as e:
    print(type(e).__name__, e)
PY
for kind in none string; do
    /usr/bin/python3 write.py $kind >$kind.vtu
    /usr/bin/python3 read.py $kind.vtu >$kind.txt 2>&1 || true
    echo "$kind: $(cat $kind.txt)"
done
grep -q '^read .*(4, 3)' none.txt || { echo "the file without a string is not read"; exit 1; }
grep -q "Illegal data type 'String'" string.txt || { echo "meshio says something else now"; exit 1; }
echo "as found: meshio $version gives up on a file with a string in FieldData"
