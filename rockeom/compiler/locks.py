"""Locks in processes that fork."""

import os
import threading


def lock_held_by_forks() -> threading.RLock:
    """A lock that a fork waits for, and that is free in the child.

    A child has the thread alone that forked it: what another thread held, nobody there would
    release. Reentrant, so that a thread that holds it can fork.
    """
    lock = threading.RLock()
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(
            before=lock.acquire, after_in_parent=lock.release, after_in_child=lock.release
        )
    return lock
