#!/bin/sh
# dcm2niix turns the air around a head into metal when a CT keeps signed numbers in fewer bits than its words have.
#
# A slice may store signed numbers (PixelRepresentation 1) in 12 to 15 bits of a 16-bit word. DICOM (PS3.5, 8.1.1) puts the
# sign into the high bit of those that are stored; what a writer leaves in the bits above is of no account, and most repeat
# the sign there, so that the words are plain 16-bit integers. dcm2niix 1.0.20220720 (1.0.20220720-1+deb12u1 of Debian 12)
# reads air at -1000 HU as
#   12 bits, sign repeated above    3096    the right word is damaged: the upper four bits are cleared, whatever the sign
#   12 bits, zeros above            3096
#   13 bits, sign repeated above   -1000
#   13 bits, zeros above            7192
#   14 bits, zeros above           15384
# without a word, while tissue above 0 HU stays right; dicomtonifti (vtk-dicom 0.8.14) reads -1000 in all five. Fat and
# airways become denser than enamel, so that a threshold for bone takes the air. Upstream repaired 12 bits in 2023.
# Whoever reads through it must look for air in the result, or at BitsStored and PixelRepresentation before.
# Fails if a number differs. Needs Debian 12's packages (apt-get) and python3.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir -p debs/partial root
apt-get install -y -q -d --reinstall --no-install-recommends -o Debug::NoLocking=1 -o Dir::Cache::archives="$work/debs" \
    dcm2niix=1.0.20220720-1+deb12u1 vtk-dicom-tools=0.8.14-3.1 >apt.log 2>&1 || { cat apt.log; echo "the packages cannot be had"; exit 1; }
for deb in debs/*.deb; do dpkg -x "$deb" root; done
lib=$work/root/usr/lib/x86_64-linux-gnu
cat >ct.py <<'PY'
import os, struct, sys
folder, bits, extended = sys.argv[1], int(sys.argv[2]), sys.argv[3] == "sign"
def element(tag, vr, value):
    if isinstance(value, str):
        value = value.encode()
    if isinstance(value, int):
        value = struct.pack("<H", value)
    value += (b"\0" if vr == "UI" else b" ") * (len(value) % 2)
    long = struct.pack("<HI", 0, len(value)) if vr in ("OW", "OB") else struct.pack("<H", len(value))
    return struct.pack("<HH", tag >> 16, tag & 0xffff) + vr.encode() + long + value
os.mkdir(folder)
word = lambda hu: hu & (0xffff if extended else (1 << bits) - 1)
row = [word(700 if 4 <= x < 12 else -1000) for x in range(16)]
for k in range(4):
    uid, ct = "1.2.3.4.%d" % (k + 1), "1.2.840.10008.5.1.4.1.1.2"
    meta = b"".join((element(0x00020001, "OB", b"\0\1"), element(0x00020002, "UI", ct), element(0x00020003, "UI", uid),
                     element(0x00020010, "UI", "1.2.840.10008.1.2.1"), element(0x00020012, "UI", "1.2.3")))
    body = b"".join(element(*e) for e in (
        (0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL"), (0x00080016, "UI", ct), (0x00080018, "UI", uid),
        (0x00080020, "DA", "20200101"), (0x00080030, "TM", "120000"), (0x00080060, "CS", "CT"), (0x00080070, "LO", "Maker"),
        (0x00100010, "PN", "Head"), (0x00100020, "LO", "1"), (0x00180050, "DS", "1"), (0x00185100, "CS", "HFS"),
        (0x0020000d, "UI", "1.2.3.1"), (0x0020000e, "UI", "1.2.3.2"), (0x00200010, "SH", "1"), (0x00200011, "IS", "1"),
        (0x00200013, "IS", str(k + 1)), (0x00200032, "DS", "0\\0\\%d" % k), (0x00200037, "DS", "1\\0\\0\\0\\1\\0"),
        (0x00200052, "UI", "1.2.3.3"), (0x00280002, "US", 1), (0x00280004, "CS", "MONOCHROME2"), (0x00280010, "US", 16),
        (0x00280011, "US", 16), (0x00280030, "DS", "1\\1"), (0x00280100, "US", 16), (0x00280101, "US", bits),
        (0x00280102, "US", bits - 1), (0x00280103, "US", 1), (0x00281052, "DS", "0"), (0x00281053, "DS", "1"),
        (0x7fe00010, "OW", struct.pack("<16H", *row) * 16)))
    with open("%s/%d.dcm" % (folder, k), "wb") as f:
        f.write(b"\0" * 128 + b"DICM" + element(0x00020000, "UL", struct.pack("<I", len(meta))) + meta + body)
PY
cat >air.py <<'PY'
import struct, sys
data = open(sys.argv[1], "rb").read()
kind, offset = struct.unpack_from("<h", data, 70)[0], int(struct.unpack_from("<f", data, 108)[0])
slope, intercept = struct.unpack_from("<ff", data, 112)
values = struct.unpack_from("<1024" + {4: "h", 512: "H", 8: "i", 16: "f"}[kind], data, offset)
print(*sorted({int(v * (slope or 1) + intercept) for v in values}))
PY
wrong=0
for case in "12 sign 700 3096" "12 zero 700 3096" "13 sign -1000 700" "13 zero 700 7192" "14 zero 700 15384"; do
    set -- $case
    python3 ct.py "$1$2" "$1" "$2"
    root/usr/bin/dcm2niix -b n -z n -f "one_$1$2" -o . "$1$2" >"$1$2.log" || { cat "$1$2.log"; exit 1; }
    LD_LIBRARY_PATH=$lib root/usr/bin/dicomtonifti -o "other_$1$2.nii" "$1$2" >"$1$2.log" 2>&1 || { cat "$1$2.log"; exit 1; }
    one=$(python3 air.py "one_$1$2.nii") other=$(python3 air.py "other_$1$2.nii")
    echo "$1 bits, $2 above: dcm2niix has the values $one, dicomtonifti $other"
    [ "$one" = "$3 $4" ] && [ "$other" = "-1000 700" ] || wrong=1
done
[ $wrong = 0 ] || { echo "not as found"; exit 1; }
echo "as found: dcm2niix loses the sign"
