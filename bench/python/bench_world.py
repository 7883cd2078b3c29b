#!/usr/bin/env python3
"""Measures talus world stage by stage: triangles a second, bytes a triangle, and the largest memory of each process; the bake in shards against one
in memory; how evenly the tiles' times spread over 64 and 1024 ranks; and a walk over each baked world while its tiles come and go under a budget of
64 MiB, less where all of it would fit.

  bench_world.py --talus COMMAND --folder FOLDER [--walk bench_world_walk] [--walk-metres 20000] [--millions 1 10] [--bake-millions 1]
                 [--compare-millions 10] [--threads N] [--json FILE]

Each stage is a process of its own, so that its peak is its own. FOLDER must be empty or new; about 200 bytes a triangle are written there, and
left. Sizes beyond --bake-millions are planned, and not baked; those beyond --compare-millions not baked in memory.
"""
import argparse
import json
import os
import shutil
import struct
import subprocess
import sys
import time


def run(words):
    """The command's JSON, its seconds of wall clock and of processor time, and its peak in MB."""
    began = time.monotonic()
    process = subprocess.Popen(words + ["--json"], stdout=subprocess.PIPE)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(words)}: exit code {process.returncode}")
    return json.loads(text), time.monotonic() - began, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


TRIANGLE = struct.Struct("<12fH")  # of a binary STL: normal, corners, attributes


def moved(triangles, x, y, z):
    """Those of a binary STL, moved."""
    out = bytearray()
    for t in TRIANGLE.iter_unpack(triangles):
        out += TRIANGLE.pack(*t[:3], t[3] + x, t[4] + y, t[5] + z, t[6] + x, t[7] + y, t[8] + z, t[9] + x, t[10] + y, t[11] + z, t[12])
    return out


def merge_parts(folder, path):
    """The world's binary STL files as one, each in its place, for a bake that takes one file."""
    with open(os.path.join(folder, "world.json"), encoding="utf-8") as file:
        inputs = json.load(file)["inputs"]
    count = 0
    with open(path, "wb") as whole:
        whole.write(bytes(84))
        for part in inputs:
            with open(os.path.join(folder, part["file"]), "rb") as file:
                count += struct.unpack_from("<I", file.read(84), 80)[0]
                whole.write(moved(file.read(), *part["translate"]))
        whole.seek(80)
        whole.write(struct.pack("<I", count))


def size_of(folder):
    return sum(os.path.getsize(os.path.join(root, name)) for root, _, names in os.walk(folder) for name in names)


def measure(options, millions):
    world = os.path.join(options.folder, f"world_{millions}")
    job = os.path.join(options.folder, f"job_{millions}")
    threads = ["--threads", str(options.threads)]
    stages = [("sample", [options.talus, "sample", "world", "--triangles", str(int(millions * 1e6)), "-o", world]),
              ("plan", [options.talus, "world", "plan", world, "-o", job] + threads),
              ("plan again", [options.talus, "world", "plan", world, "-o", job] + threads)]
    if millions <= options.bake_millions:
        stages += [("bake", [options.talus, "world", "bake", job] + threads),
                   ("bake again", [options.talus, "world", "bake", job] + threads),
                   ("merge", [options.talus, "world", "merge", job, "-o", job + ".talus"]),
                   ("check", [options.talus, "world", "check", job + ".talus"])]
    if millions <= min(options.bake_millions, options.compare_millions):
        stages.append(("in memory", [options.talus, "bake", world + ".stl", "--no-soup", "--tile-size", "128", "-o", world + ".talus"] + threads))
    triangles, rows, processor_of = 0, [], {}
    for name, words in stages:
        if name == "in memory":
            merge_parts(world, world + ".stl")
        answer, wall, processor, peak = run(words)
        processor_of[name] = processor
        triangles = answer.get("triangles", 0) if name == "sample" else triangles
        row = {"millions": millions, "stage": name, "seconds": wall, "processor_seconds": processor,
               "triangles_per_second": triangles / wall, "peak_mb": peak}
        remark = ""
        if name == "plan":
            row["bytes_per_triangle"] = answer["store_bytes"] / answer["triangles"]
            remark = f"{row['bytes_per_triangle']:7.1f} bytes a triangle, in the store"
        elif name == "bake":
            row["tiles"] = answer["baked"]
            row["tiles_per_second"] = answer["baked"] / wall
            row["bytes_per_triangle"] = size_of(job) / triangles
            remark = f"{row['tiles_per_second']:7.0f} tiles/s{row['bytes_per_triangle']:7.1f} bytes a triangle, with the tiles"
        elif name == "in memory":
            row["times_as_fast"] = processor / sum(processor_of[stage] for stage in ("plan", "bake", "merge"))
            remark = f"  in shards {row['times_as_fast']:.2f} times as fast, by processor time from files to file"
        rows.append(row)
        print(f"{triangles / 1e6:8.2f} M  {name:<11}{wall:9.2f} s {processor:9.2f} s of processor"
              f"{triangles / wall / 1e6:9.2f} M triangles/s{peak:8.0f} MB{remark}", flush=True)
    if millions <= options.bake_millions:
        rows += [replay(options, job, millions, ranks) for ranks in (64, 1024)]
        if options.walk:
            rows.append(walk(options, job, millions))
    return rows


def walk(options, job, millions):
    """What frames take that stream a world, and whether all paths of the walk are those of the world in memory whole."""
    found = run([options.walk, job + ".talus", "--metres", str(options.walk_metres), "--budget", str(min(64, 10 * millions))])[0]
    print(f"{'':10}  walked {found['metres'] / 1000:.0f} km, {found['frames']} frames: {found['frame_us_median']:.1f} us of each (99.99%: "
          f"{found['frame_us_9999']:.0f} us; {found['frames_over_1ms']} over 1 ms), {found['reads_by_frames']} reads by frames; {found['paths']} paths, "
          f"{found['proven']} proven, {found['open']} answers open, {found['wrong']} wrong; {found['peak_bytes'] / 1e6:.0f} of "
          f"{found['whole_bytes'] / 1e6:.0f} MB", flush=True)
    return {"millions": millions, "stage": "walk", **found}


def replay(options, job, millions, ranks):
    """How well the measured times of the tiles spread over so many ranks."""
    found = run([options.talus, "world", "status", job, "--ranks", str(ranks)])[0]["replay"]
    print(f"{'':10}  {ranks} ranks: idle {100 * found['idle_dealt']:.1f}% under mpirun, {100 * found['idle_shards']:.1f}% in shards; in the grid's order "
          f"{100 * found['idle_dealt_in_grid_order']:.1f}%, in equal blocks of it {100 * found['idle_blocks_of_grid']:.1f}%", flush=True)
    return {"millions": millions, "stage": "replay", **found}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--talus", required=True)
    parser.add_argument("--folder", required=True)
    parser.add_argument("--walk")
    parser.add_argument("--walk-metres", type=float, default=20000)
    parser.add_argument("--millions", type=float, nargs="+", default=[1, 10])
    parser.add_argument("--bake-millions", type=float, default=1)
    parser.add_argument("--compare-millions", type=float, default=10)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--json")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    if os.listdir(options.folder):
        sys.exit(f"{options.folder} is not empty")
    rows = [row for millions in options.millions for row in measure(options, millions)]
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


main()
