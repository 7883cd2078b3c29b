#!/usr/bin/env python3
"""Measures talus world stage by stage: triangles a second, bytes a triangle, and the largest memory of each process.

  bench_world.py --talus COMMAND --folder FOLDER [--millions 1 10] [--bake-millions 1] [--threads N] [--json FILE]

Each stage is a process of its own, so that its peak is its own. FOLDER must be empty or new; about 200 bytes a triangle are written there, and
left. Sizes beyond --bake-millions are planned, and not baked.
"""
import argparse
import json
import os
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
                   ("merge", [options.talus, "world", "merge", job, "-o", job + ".talus"])]
    triangles, rows = 0, []
    for name, words in stages:
        answer, wall, processor, peak = run(words)
        triangles = answer.get("triangles", 0) if name == "sample" else triangles
        row = {"millions": millions, "stage": name, "seconds": wall, "processor_seconds": processor,
               "triangles_per_second": triangles / wall, "peak_mb": peak}
        if name == "plan":
            row["bytes_per_triangle"] = answer["store_bytes"] / answer["triangles"]
        rows.append(row)
        print(f"{triangles / 1e6:8.2f} M  {name:<11}{wall:9.2f} s {processor:9.2f} s of processor"
              f"{triangles / wall / 1e6:9.2f} M triangles/s{peak:8.0f} MB"
              + (f"{row['bytes_per_triangle']:7.1f} bytes a triangle" if name == "plan" else ""), flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--talus", required=True)
    parser.add_argument("--folder", required=True)
    parser.add_argument("--millions", type=float, nargs="+", default=[1, 10])
    parser.add_argument("--bake-millions", type=float, default=1)
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
