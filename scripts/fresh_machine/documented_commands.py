#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of README.md and docs/ros.md word for word; fails when one of them does.

Commands are the lines of README's sh blocks and, in both files, code that starts with roslaunch, rosrun, rosservice
or rostopic. Words in capitals stand for the user's own files and are replaced by those of the demo. The screen is a
virtual one. Usage, from the top of the project: documented_commands.py [--list]
"""
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import time

TOOLS = ("roslaunch", "rosrun", "rosservice", "rostopic")
WORK = "out/documented"
# What the words of the documents stand for; later ones may use what earlier commands wrote.
STANDS_FOR = {
    "RECORDING": "examples/apartment",
    "FOLDER": "examples/apartment",
    "BAG": "out.bag",
    "FILE": "out.bag",
    "OUT": WORK + "/out",
    "OUT2": WORK + "/out2",
    "NAME": "documented",
    "map.yaml": "out/demo/free_space.yaml",
    "plan.png": WORK + "/plan.png",
}
# Run before this program, or done for each command here.
ALREADY_RUN = re.compile(r"scripts/(demo|test)\.sh$|\. devel/setup\.bash$")
ROOMS_OF_DEMO = 9


def documented():
    """The commands in the order of the documents, without comments."""
    commands = []
    for path in ("README.md", "docs/ros.md"):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for match in re.finditer(r"```(\w*)\n(.*?)```|^ {4}(\S[^\n]*)$|`([^`]+)`", text, re.DOTALL | re.MULTILINE):
            language, block, indented, inline = match.groups()
            if block is not None:
                lines = block.replace("\\\n", " ").splitlines() if language == "sh" else []
            else:
                lines = [line for line in [" ".join((indented or inline).split())]
                         if line.startswith(TOOLS) and len(line.split()) > 1]
            commands += [re.sub(r"\s+#\s.*$", "", line).strip() for line in lines]
    return list(dict.fromkeys(command for command in commands if command and not ALREADY_RUN.search(command)))


def for_this_machine(command):
    """The command with the demo's files; refuses a word in capitals that stands for nothing known."""
    words = []
    for word in command.split():
        name, equals, value = word.rpartition(":=")
        value = STANDS_FOR.get(value, value)
        if re.fullmatch(r"[A-Z][A-Z0-9_]+", value) or "..." in value:
            raise SystemExit(f"documented_commands.py: '{command}': what does {value} stand for?")
        words.append(name + equals + value)
    return " ".join(words)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def start(command, log, port):
    """Starts a command with a ROS master of its own at `port`."""
    environment = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_HOSTNAME="127.0.0.1",
                       LIBGL_ALWAYS_SOFTWARE="1", QT_QPA_PLATFORM="xcb")
    # rosrun and rostopic need a master that runs; roslaunch starts one.
    run = "" if command.startswith(". ") else "exec "
    return subprocess.Popen(["bash", "-c", f". devel/setup.bash && {run}{command}"], env=environment, stdout=log,
                            stderr=subprocess.STDOUT, start_new_session=True)


def interrupt(process):
    """Ctrl-C; returns the exit code."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(60)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return 1
    return process.returncode


# How every program with Debian 11's rospy ends on Ctrl-C: its Python no longer has what rospy calls.
ROSPY_OF_DEBIAN_11 = "'Thread' object has no attribute 'isAlive'"


class Failure(Exception):
    """A command that did not do what its document says."""


def tail(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return "".join(file.readlines()[-30:])


def run_to_the_end(command, port, timeout_s, log_path):
    """Runs a command that must end with 0, or, for one that goes on, be alive at the end of the time."""
    with open(log_path, "w", encoding="utf-8") as log:
        process = start(command, log, port)
        try:
            code = process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            code = 0 if interrupt(process) in (0, 130, -2) or ROSPY_OF_DEBIAN_11 in tail(log_path) else 1
    if code != 0:
        raise Failure(f"ended with {code}:\n{tail(log_path)}")
    return tail(log_path)


def wait_for(condition, timeout_s, process, log_path, what):
    end = time.monotonic() + timeout_s
    while not condition():
        if process.poll() is not None:
            raise Failure(f"ended before {what}:\n{tail(log_path)}")
        if time.monotonic() > end:
            raise Failure(f"no {what} within {timeout_s} s:\n{tail(log_path)}")
        time.sleep(1)


def asked(command, port):
    """The output of a short ROS command."""
    environment = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_HOSTNAME="127.0.0.1")
    result = subprocess.run(["bash", "-c", f". devel/setup.bash && timeout 10 {command}"], env=environment, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return result.stdout


def rooms(port):
    return len(re.findall(r"^\s*-?\s*id:", asked('rosservice call /occusg/list_rooms "min_area: 0.0"', port), re.MULTILINE))


def launch(command, log_path, while_up=()):
    """Starts a launch file, waits until its nodes are there (the demo: until its rooms are), and stops it."""
    port = free_port()
    is_demo = "demo.launch" in command
    with open(log_path, "w", encoding="utf-8") as log:
        process = start(command, log, port)
        try:
            if is_demo:
                wait_for(lambda: rooms(port) >= ROOMS_OF_DEMO, 300, process, log_path, f"{ROOMS_OF_DEMO} rooms")
            else:
                expected = asked("roslaunch --nodes " + command.split(" ", 1)[1], port).split()
                wait_for(lambda: set(expected) <= set(asked("rosnode list", port).split()), 60, process, log_path,
                         "nodes " + " ".join(expected))
            for other in while_up:
                print(f"     meanwhile: {other}", flush=True)
                if not run_to_the_end(for_this_machine(other), port, 20, log_path + ".other").strip():
                    raise Failure(f"'{other}' prints nothing")
        finally:
            code = interrupt(process)
    with open(log_path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    if "has died" in text or code not in (0, 130, -2):
        raise Failure(f"a node died, or roslaunch ended with {code}:\n{tail(log_path)}")


def virtual_screen():
    """Starts an X server without a screen and makes it the display of all commands."""
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x800x24", "+extension", "GLX"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True, text=True)
    os.environ["DISPLAY"] = ":" + server.stdout.readline().strip()
    return server


def main():
    commands = documented()
    if sys.argv[1:] == ["--list"]:
        print("\n".join(commands))
        return 0
    os.makedirs(WORK, exist_ok=True)
    subprocess.run(["convert", "out/demo/free_space.pgm", WORK + "/plan.png"], check=True)
    screen = virtual_screen()
    asking = [command for command in commands if command.startswith(("rosservice", "rostopic"))]
    failures = 0
    core = None
    for number, command in enumerate(c for c in commands if c not in asking):
        log_path = f"{WORK}/{number}.log"
        print(f"  $ {command}", flush=True)
        try:
            if command.startswith("roslaunch") and not command.split()[1].startswith("-"):
                launch(for_this_machine(command), log_path, asking if "demo.launch" in command else ())
            else:
                port = free_port()
                if command.startswith("rosrun"):
                    core = start(f"roscore -p {port}", subprocess.DEVNULL, port)
                    wait_for(lambda: asked("rosnode list", port), 30, core, os.devnull, "master")
                run_to_the_end(for_this_machine(command), port, 20 if command.startswith("rosrun") else 1800, log_path)
        except Failure as failure:
            failures += 1
            print(f"documented_commands.py: '{command}' {failure}", file=sys.stderr, flush=True)
        if core is not None:
            interrupt(core)
            core = None
    screen.terminate()
    print(f"{len(commands)} documented commands, {failures} failed.")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
