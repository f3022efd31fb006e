#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every package that the build, the nodes, the tests and the documented commands use is named in scripts/packages, and not
only pulled in by another one.

Usage: package_lists_test.py ROOT
"""
import pathlib
import re
import shutil
import subprocess
import sys

# Commands of the documents and scripts that come from packages.
COMMANDS = ("roslaunch", "rosrun", "rosservice", "rostopic", "rosnode", "rosparam", "rosmsg", "rosbag", "rviz", "rostest",
            "xvfb-run", "convert", "cmake", "ninja", "git", "chromium")


def listed(folder, *names):
    """The packages of these lists."""
    packages = set()
    for name in names:
        for line in (folder / f"{name}.txt").read_text().splitlines():
            if line and not line.startswith("#"):
                packages.add(line.split("|")[0].strip())
    return packages


def owner(path):
    """The Debian package a file belongs to; empty for a file of no package."""
    result = subprocess.run(["dpkg", "-S", str(path)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                            check=False)
    return result.stdout.split(":")[0] if result.returncode == 0 else ""


def python_modules(root):
    """Top-level modules that the Python files of the tests and scripts import."""
    modules = set()
    for path in [*root.glob("tests/**/*.py"), *root.glob("scripts/**/*.py")]:
        for match in re.finditer(r"^(?:import|from) ([a-z_0-9]+)", path.read_text(), re.MULTILINE):
            modules.add(match.group(1))
    return modules


def main():
    root = pathlib.Path(sys.argv[1])
    folder = root / "scripts" / "packages"
    debian = listed(folder, "core", "ros-debian", "tests", "tests-ros-debian")
    noetic = listed(folder, "core", "ros-noetic", "tests", "tests-ros-noetic")
    faults = []
    setup = (root / "occusg_ros" / "catkin_setup.cmake").read_text()
    needs = re.findall(r"^set\(debian_(\w+) ([\w-]+)\)$", setup, re.MULTILINE)
    if len(needs) < 15:
        faults.append("occusg_ros/catkin_setup.cmake: its names of Debian packages are not found")
    for name, package in needs:
        ubuntu = "ros-noetic-" + name.replace("_", "-")
        for wanted, packages in ((package, debian), (ubuntu, noetic)):
            if wanted not in packages:
                faults.append(f"{wanted}, which provides {name}, is in no list of scripts/packages")
    for module in sorted(python_modules(root)):
        places = [place for place in (f"/usr/lib/python3/dist-packages/{module}",
                                      f"/usr/lib/python3/dist-packages/{module}.py") if pathlib.Path(place).exists()]
        package = owner(places[0]) if places else ""
        if package and package not in debian:
            faults.append(f"{package}, which provides the Python module {module}, is in no list of scripts/packages")
    for command in COMMANDS:
        place = shutil.which(command, path="/usr/bin:/bin")
        package = owner(pathlib.Path(place).resolve()) or owner(place) if place else ""
        # imagemagick and rosbag hide behind alternatives and metapackages.
        if place and package and package not in debian and not any(package.startswith(own) for own in debian):
            faults.append(f"{package}, which provides {command}, is in no list of scripts/packages")
    for fault in faults:
        print("FAILED: " + fault)
    print(f"{len(needs)} ROS packages looked at, {len(faults)} missing in the lists")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
