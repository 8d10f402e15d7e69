#!/usr/bin/env python3
"""Makes the simulator's table of stars to V 7 that the Bright Star Catalogue leaves out.

Input:  unnamedstars.dat of KStars (Debian package kstars-data): stars of the Tycho and Hipparcos catalogues (ESA 1997)
        to VT 8, binary; and bsc5.dat, the Bright Star Catalogue (see generate_bright_stars.py).
Output: sim/faint_stars_table.inc, brightest first.

Run from the top of the tree:
    python3 ground/catalogue/generate_faint_stars.py unnamedstars.dat bsc5.dat

KStars' file: a text of 124 bytes; 'SK', version, the number of fields and 16 bytes on each; the number of index
entries and 12 bytes on each; 5 bytes; then records of 32 bytes, little-endian: right ascension [1e-6 h], declination
[1e-5 degrees], proper motions [0.1 mas/yr], parallax, HD number, VT and BT - VT [0.01 mag], spectral class, flags.
V = VT - 0.090 (BT - VT) and B - V = 0.850 (BT - VT) (ESA 1997, vol. 1, eq. 1.3.20). A star is left out where the Bright
Star Catalogue has its HD number, or a star within a minute of arc, which is then its double.
"""

import argparse
import math
import pathlib
import struct
import sys

FAINTEST = 7.0
TOP = pathlib.Path(__file__).resolve().parents[2]
TABLE = TOP / "sim/faint_stars_table.inc"


def read_kstars(path):
    data = path.read_bytes()
    if len(data) < 129 or data[124:126] != b"SK":
        sys.exit(f"{path}: expected a star file of KStars, found another")
    fields = struct.unpack_from("<H", data, 127)[0]
    at = 129 + 16 * fields
    at += 4 + 12 * struct.unpack_from("<I", data, at)[0] + 5
    if (len(data) - at) % 32:
        sys.exit(f"{path}: expected records of 32 bytes, found {len(data) - at} bytes of them")
    for ra, dec, pm_ra, pm_dec, _, hd, vt, bt_vt, _, _ in struct.iter_unpack("<6i2h2s2s", data[at:]):
        yield {"ra": ra * 15e-6, "dec": dec * 1e-5, "pm_ra": pm_ra / 10, "pm_dec": pm_dec / 10, "hd": hd,
               "v": (vt - 0.090 * bt_vt) / 100, "b_v": 0.850 * bt_vt / 100}


def read_bright(path):
    """HD numbers and places [degrees] of the Bright Star Catalogue."""
    numbers, places = set(), []
    for line in path.read_text(encoding="latin1").splitlines():
        line = line.ljust(197)
        if not line[75:90].strip():
            continue
        if line[25:31].strip():
            numbers.add(int(line[25:31]))
        dec = int(line[84:86]) + int(line[86:88]) / 60 + int(line[88:90]) / 3600
        places.append((15 * (int(line[75:77]) + int(line[77:79]) / 60 + float(line[79:83]) / 3600),
                       -dec if line[83] == "-" else dec))
    return numbers, places


def left_out(stars, numbers, places):
    near = 1 / 60
    by_zone = {}
    for place in places:
        by_zone.setdefault(round(place[1]), []).append(place)
    for star in stars:
        if star["v"] > FAINTEST or star["hd"] in numbers:
            continue
        zone = round(star["dec"])
        if any(math.hypot(((star["ra"] - ra + 180) % 360 - 180) * math.cos(math.radians(dec)), star["dec"] - dec) < near
               for z in (zone - 1, zone, zone + 1) for ra, dec in by_zone.get(z, [])):
            continue
        yield star


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kstars", type=pathlib.Path, help="unnamedstars.dat")
    parser.add_argument("bright", type=pathlib.Path, help="bsc5.dat")
    arguments = parser.parse_args()
    rows = sorted({(round(100 * s["v"]), round(s["ra"] * 24000), round(s["dec"] * 36000), round(s["pm_ra"]),
                   round(s["pm_dec"]), round(100 * s["b_v"]))
                  for s in left_out(read_kstars(arguments.kstars), *read_bright(arguments.bright))})  # fast ones stand in it more than once
    lines = ["// Made by ground/catalogue/generate_faint_stars.py: stars of the Tycho catalogue (ESA 1997) to V 7 that the Bright",
             "// Star Catalogue leaves out. V [0.01 mag], right ascension [0.01 s], declination [0.1\"], proper motion in right",
             "// ascension times cos of declination and in declination [0.001\"/yr], B - V [0.01 mag]; J2000.0."]
    lines += ["FAINT_STAR(%d, %d, %d, %d, %d, %d)" % row for row in rows]
    TABLE.write_text("\n".join(lines) + "\n")
    print(f"{TABLE.relative_to(TOP)}: {len(rows)} stars, V {rows[0][0] / 100} to {rows[-1][0] / 100}")


if __name__ == "__main__":
    main()
