#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Seconds from SIGINT to the end of roslaunch with a large map, while an autosave runs.

The nodes load MAP and replay RECORDING with an autosave every second; SIGINT comes after a delay that differs from run
to run. The last line is one JSON object. Needs a build with ROS whose devel space is sourced.
Usage: shutdown_time.py MAP.ot RECORDING [RUNS]
"""
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 300
FILE_CLOCK_S = 0.02  # stamps of files are those of the kernel's last tick
SEED = 13


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def call(service, request):
    """The answer of a service, or None while it is not there."""
    done = subprocess.run(["rosservice", "call", service, request], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          universal_newlines=True)
    return done.stdout if done.returncode == 0 else None


def wait_for(what, check, launch):
    end = time.monotonic() + PATIENCE_S
    while True:
        value = check()
        if value:
            return value
        if launch.poll() is not None or time.monotonic() > end:
            sys.exit("shutdown_time.py: " + what + " did not come")
        time.sleep(0.2)


def measure(map_file, recording, delay_s):
    """One run; seconds from SIGINT to exit, rooms at that time, bytes of the map that was saved."""
    with tempfile.TemporaryDirectory() as work:
        os.makedirs(os.path.join(work, "large"))
        shutil.copy(map_file, os.path.join(work, "large", "map.ot"))
        port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://127.0.0.1:{}".format(port)
        os.environ["ROS_HOSTNAME"] = "127.0.0.1"
        with open(os.path.join(work, "launch.log"), "w") as log:
            launch = subprocess.Popen(
                ["roslaunch", "-p", str(port), "--skip-log-check", "occusg", "replay.launch", "rviz:=false", "rate:=1",
                 "loop:=true", "sequence:=" + recording, "save_folder:=" + work, "save_on_exit:=true",
                 "autosave_period_s:=1"],
                stdout=log, stderr=subprocess.STDOUT)
            try:
                wait_for("the map", lambda: "success: True" in (call("/occusg/mapping/load", "name: large") or ""), launch)
                rooms = wait_for("a hundred rooms", enough_rooms, launch)
                time.sleep(delay_s)
                interrupted = time.time()
                start = time.monotonic()
                launch.send_signal(signal.SIGINT)
                launch.wait(timeout=PATIENCE_S)
                seconds = time.monotonic() - start
            finally:
                if launch.poll() is None:
                    launch.kill()
                    launch.wait()
        last = os.path.join(work, "last")
        for name in ("map.ot", "rooms.json"):
            if not is_saved_since(interrupted, os.path.join(last, name)):
                with open(os.path.join(work, "launch.log"), errors="replace") as log:
                    sys.stderr.writelines(log.readlines()[-20:])
                sys.exit("shutdown_time.py: {} was not saved after SIGINT, {:.2f} s to exit".format(name, seconds))
        return {"seconds": round(seconds, 2), "rooms": rooms,
                "map_mib": round(os.path.getsize(os.path.join(last, "map.ot")) / 2**20, 1)}


def is_saved_since(stamp_s, path):
    """Whether the last save wrote the file: one that an autosave left is older than SIGINT."""
    return os.path.exists(path) and os.path.getmtime(path) >= stamp_s - FILE_CLOCK_S


def enough_rooms():
    answer = call("/occusg/list_rooms", "min_area: 0.0")
    count = answer.count("\n    number:") if answer else 0
    return count if count >= 100 else 0


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__.strip().splitlines()[-1])
    runs = int(sys.argv[3]) if len(sys.argv) == 4 else 5
    random.seed(SEED)
    results = []
    for _ in range(runs):
        results.append(measure(sys.argv[1], os.path.abspath(sys.argv[2]), random.uniform(0.0, 4.0)))
        print(results[-1], file=sys.stderr)
    print(json.dumps({"seed": SEED, "worst_s": max(run["seconds"] for run in results), "runs": results}))


if __name__ == "__main__":
    main()
