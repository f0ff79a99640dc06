#!/usr/bin/env python3
"""The thesis's cuts through MeshLib and through lancet, in one run, for the ratio.

    pip install meshlib
    cargo build --release
    python3 benches/peer_meshlib.py [--lancet target/release/lancet] [--recordings recordings/wound] [--repeat 20]

The same cut means: the same mesh, the same two points of the surface, the same plane. lancet says what they are: `replay --json` has the
line and the eye's plane follows from its points; the mesh comes from `replay --until 0 --export-mesh`, before anything is cut.

What is timed of MeshLib: its plane section from point to point (trackSection, FC), its cutMesh along it (MC), and the tree for the next
pick, which it builds anew after every change. Of lancet: FC and MC, in which its own hierarchy is brought up to date as well. MeshLib
carves no incision, so CI has no counterpart. lancet's input is 64-bit and decided by exact signs, MeshLib's is 32-bit.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    from meshlib import mrmeshpy as mm
except ImportError:
    sys.exit("MeshLib is not installed, so there is no peer to compare with: pip install meshlib")


def lancet(binary, recording, repeat, folder):
    """The line of the first applied cut, microseconds of its FC and MC, and the mesh before it."""
    report, mesh = folder / "report.json", folder / "mesh.obj"
    call = [binary, "replay", recording]
    subprocess.run(call + ["--until", "0", "--export-mesh", mesh], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(call + ["--repeat", str(repeat), "--json", report], check=True, stdout=subprocess.DEVNULL)
    events = json.loads(report.read_text())["events"]
    cut = next(e for e in events if e.get("cut") and e["outcome"] == "applied")
    us = {stage["id"]: stage["us"] for stage in cut["stages"]}
    line = next(o["line"]["points"] for o in cut["overlays"] if "line" in o)
    return line, us, mesh


def nearest(mesh, point):
    """A point of the surface as MeshLib names it."""
    return mm.findProjection(mm.Vector3f(*point), mm.MeshPart(mesh)).mtp


def timed(run):
    begin = time.perf_counter()
    value = run()
    return value, (time.perf_counter() - begin) * 1e6


def off_line(line):
    """A third point of the plane, as far from the straight way between the line's ends as they are apart."""
    a, b = line[0], line[-1]
    d = [y - x for x, y in zip(a, b)]
    square = sum(x * x for x in d)

    def away(p):
        t = sum((y - x) * z for x, y, z in zip(a, p, d)) / square
        return [y - x - t * z for x, y, z in zip(a, p, d)]

    most = max((away(p) for p in line[1:-1]), key=lambda v: sum(x * x for x in v))
    scale = (square / sum(x * x for x in most)) ** 0.5
    return [x + scale * v for x, v in zip(a, most)]


def peer(whole, line):
    """Microseconds of MeshLib's section, its cut and its next tree; None where it has no section from point to point."""
    mesh = mm.Mesh(whole)
    mesh.getAABBTree()
    start, end = nearest(mesh, line[0]), nearest(mesh, line[-1])
    beyond = mm.Vector3f(*off_line(line))
    for ccw in (True, False):
        try:
            section, section_us = timed(lambda: mm.trackSection(mm.MeshPart(mesh), start, end, beyond, ccw))
        except (RuntimeError, ValueError):
            continue
        # The other way round the body is not the same cut.
        if len(section) <= 2 * len(line):
            break
    else:
        return None
    contour = mm.convertSurfacePathWithEndsToMeshContour(mesh, start, section, end)
    contours = mm.std_vector_OneMeshContour()
    contours.append(contour)
    before = mesh.topology.numValidFaces()
    _, cut_us = timed(lambda: mm.cutMesh(mesh, contours))
    _, tree_us = timed(mesh.getAABBTree)
    return section_us, cut_us, tree_us, len(section), mesh.topology.numValidFaces() - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lancet", default="target/release/lancet")
    parser.add_argument("--recordings", type=Path, default=Path("recordings/wound"))
    parser.add_argument("--repeat", type=int, default=20)
    typed = parser.parse_args()
    recordings = sorted(typed.recordings.glob("thesis-*.lancet"))
    if not recordings:
        sys.exit(f"there is no thesis-*.lancet in {typed.recordings}")
    print(f"{'microseconds':24} {'lancet':>8} {'MeshLib':>8} {'+ tree':>8} {'ratio':>6} {'+ tree':>7}")
    ratios = []
    for recording in recordings:
        with tempfile.TemporaryDirectory() as folder:
            line, us, mesh = lancet(typed.lancet, recording, typed.repeat, Path(folder))
            whole = mm.loadMesh(str(mesh))
        runs = [peer(whole, line) for _ in range(typed.repeat)]
        if None in runs:
            print(f"{recording.stem:24} MeshLib finds no section between the two points")
            continue
        ours = us["FC"] + us["MC"]
        theirs = statistics.median(section + cut for section, cut, *_ in runs)
        ready = statistics.median(section + cut + tree for section, cut, tree, *_ in runs)
        ratios.append((theirs / ours, ready / ours))
        print(f"{recording.stem:24} {ours:8.1f} {theirs:8.1f} {ready:8.1f} {theirs / ours:6.1f} {ready / ours:7.1f}")
    if ratios:
        cut, ready = (statistics.median(column) for column in zip(*ratios))
        print(f"{'median':24} {'':8} {'':8} {'':8} {cut:6.1f} {ready:7.1f}")


if __name__ == "__main__":
    main()
