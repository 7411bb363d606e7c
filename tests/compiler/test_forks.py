"""A process that forks while another of its threads compiles."""

import os
import subprocess
import sys

import pytest

PROGRAM = """
import os, sys, threading, time
import rockeom as rk
from rockeom.integrator import program

block = rk.RigidBlock(half_width=0.1, half_height=0.4)
motion = rk.GroundMotion.single_sine(3.0, 0.5, 1.0)
began, loaded = threading.Event(), program.Loaded

def slow(*code, **how):
    began.set()
    time.sleep(0.5)
    return loaded(*code, **how)

program.Loaded = slow
thread = threading.Thread(target=rk.simulate, args=(block, motion))
thread.start()
began.wait()
child = os.fork()
if child == 0:
    os._exit(0 if str(rk.simulate(block, motion).outcome) else 1)
ended = time.monotonic() + 10
while (found := os.waitpid(child, os.WNOHANG)) == (0, 0) and time.monotonic() < ended:
    time.sleep(0.02)
if found == (0, 0):
    os.kill(child, 9)
    os.waitpid(child, 0)
thread.join()
sys.exit(f"the child: {found}" if found != (child, 0) else 0)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks")
def test_a_child_that_is_forked_while_a_thread_compiles_simulates():
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM],
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
