#!/usr/bin/env python3
"""Turns the Bright Star Catalogue into the tables that are compiled into the flight software.

Input:  bsc5.dat, the Yale Bright Star Catalogue, 5th revised edition (Hoffleit & Warren 1991, CDS V/50:
        https://cdsarc.cds.unistra.fr/ftp/V/50/), fixed width, 9110 lines of which 9096 are stars.
Output: components/catalogue/bright_stars_table.inc        positions, motions, magnitudes; brightest first
        components/catalogue/star_designations_table.inc   Flamsteed and Bayer designations; by HR number
        sim/star_colours_table.inc                         B - V, for the simulator; by HR number

Run from the top of the tree:
    python3 ground/catalogue/generate_bright_stars.py bsc5.dat          writes the tables
    python3 ground/catalogue/generate_bright_stars.py --check bsc5.dat  compares them with what stands there

All numbers are kept as the catalogue prints them (tenths of a second, arcseconds, milliarcseconds per year,
hundredths of a magnitude), so the tables are exact and the same on every machine. The CRC-32 written at
the end is over the rows in the form that bright_stars.cpp checks (16 bytes a row, little-endian).
"""

import argparse
import pathlib
import struct
import sys
import zlib

STARS = 9096
TOP = pathlib.Path(__file__).resolve().parents[2]
STAR_TABLE = TOP / "components/catalogue/bright_stars_table.inc"
NAME_TABLE = TOP / "components/catalogue/star_designations_table.inc"
COLOUR_TABLE = TOP / "sim/star_colours_table.inc"


def scaled(field, decimals):
    """The decimal number in `field` times 10**decimals, exactly; an empty field is zero."""
    text = field.strip()
    if not text:
        return 0
    sign = -1 if text.startswith("-") else 1
    whole, _, fraction = text.lstrip("+-").partition(".")
    if len(fraction) > decimals:
        raise ValueError(f"expected at most {decimals} decimals, found {field!r}")
    return sign * int((whole or "0") + fraction.ljust(decimals, "0"))


def read_stars(path):
    """Rows (hr, magnitude, right ascension, declination, two proper motions, designation, B - V or None) of the stars."""
    stars = []
    for number, line in enumerate(path.read_text(encoding="latin1").splitlines(), 1):
        line = line.ljust(197)
        if not line[75:90].strip():
            continue  # a nova or a cluster, kept in the catalogue for its number only
        try:
            hr = int(line[0:4])
            magnitude = scaled(line[102:107], 2)
            seconds = (int(line[75:77]) * 60 + int(line[77:79])) * 600 + scaled(line[79:83], 1)
            arcseconds = (int(line[84:86]) * 60 + int(line[86:88])) * 60 + int(line[88:90])
            if line[83] == "-":
                arcseconds = -arcseconds
            stars.append((hr, magnitude, seconds, arcseconds, scaled(line[148:154], 3),
                          scaled(line[154:160], 3), line[4:14],
                          scaled(line[109:114], 2) if line[109:114].strip() else None))
        except ValueError as error:
            sys.exit(f"{path}:{number}: expected a star of the Bright Star Catalogue, found {error}")
    if len(stars) != STARS:
        sys.exit(f"{path}: expected {STARS} stars, found {len(stars)}")
    return stars


def star_table(stars):
    rows = sorted((row[:6] for row in stars), key=lambda row: (row[1], row[0]))
    checksum = zlib.crc32(b"".join(struct.pack("<HhiiHH", hr, mag, ra, dec, pra & 0xFFFF, pdec & 0xFFFF)
                                   for hr, mag, ra, dec, pra, pdec in rows))
    lines = ["// Made by ground/catalogue/generate_bright_stars.py from the Bright Star Catalogue, 5th revised edition",
             "// (Hoffleit & Warren 1991, CDS V/50). HR, V [0.01 mag], right ascension [0.1 s], declination [\"],",
             "// proper motion in right ascension times cos of declination and in declination [0.001\"/yr]; J2000.0."]
    lines += ["BRIGHT_STAR(%d, %d, %d, %d, %d, %d)" % row for row in rows]
    lines.append("BRIGHT_STAR_CHECKSUM(0x%08xu)" % checksum)
    return "\n".join(lines) + "\n"


def designation_table(stars):
    lines = ["// Made by ground/catalogue/generate_bright_stars.py: HR number; Flamsteed number, Bayer letter with its",
             "// index, constellation, as bytes 5-14 of the Bright Star Catalogue print them. Stars without are left out."]
    for hr, designation in sorted((row[0], row[6]) for row in stars):
        if designation.strip():
            lines.append('STAR_DESIGNATION(%d, "%s")' % (hr, designation))
    return "\n".join(lines) + "\n"


def colour_table(stars):
    lines = ["// Made by ground/catalogue/generate_bright_stars.py: HR number; B - V [0.01 mag], as bytes 110-114 of the Bright",
             "// Star Catalogue print it. Stars without are left out."]
    lines += ["STAR_COLOUR(%d, %d)" % (row[0], row[7]) for row in sorted(stars, key=lambda row: row[0])
              if row[7] is not None]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("catalogue", type=pathlib.Path, help="bsc5.dat")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where a table differs")
    arguments = parser.parse_args()
    try:
        stars = read_stars(arguments.catalogue)
    except OSError as error:
        sys.exit(f"{arguments.catalogue}: expected a readable file, found {error.strerror}")
    same = True
    for path, text in ((STAR_TABLE, star_table(stars)), (NAME_TABLE, designation_table(stars)),
                       (COLOUR_TABLE, colour_table(stars))):
        if arguments.check:
            matches = path.exists() and path.read_text() == text
            same = same and matches
            print(f"{path.relative_to(TOP)}: {'as generated' if matches else 'DIFFERS'}")
        else:
            path.write_text(text)
            print(f"{path.relative_to(TOP)}: {text.count(chr(10))} lines")
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
