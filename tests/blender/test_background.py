"""Work on a thread: progress, cancelling, errors."""

from __future__ import annotations

import os
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from pdtheory.blender.background import Job
from pdtheory.errors import Cancelled, InputError


def test_result_and_progress():
    go = threading.Event()

    def work(report):
        report(0.5, "half")
        go.wait(5)
        return 42

    job = Job(work)
    job.start()
    while job.text != "half":
        time.sleep(0.001)
    assert not job.done
    assert job.fraction == 0.5
    go.set()
    assert job.wait(5)
    assert job.result() == 42


def test_cancelling_stops_at_the_next_report():
    def work(report):
        for i in range(10_000):
            report(i / 10_000, "")
            time.sleep(0.001)

    job = Job(work)
    job.start()
    job.cancel()
    assert job.wait(5)
    with pytest.raises(Cancelled):
        job.result()


def test_a_result_that_comes_after_cancelling_is_dropped():
    go = threading.Event()
    job = Job(lambda report: go.wait(5))
    job.start()
    job.cancel()
    go.set()
    job.wait(5)
    with pytest.raises(Cancelled):
        job.result()


def test_errors_come_out_where_the_result_would():
    def work(report):
        raise InputError("no.")

    job = Job(work)
    job.start()
    job.wait(5)
    with pytest.raises(InputError, match="no"):
        job.result()


def test_run_here_does_it_at_once():
    assert Job(lambda report: 7).run_here() == 7


@pytest.mark.skipif(sys.platform != "linux", reason="priorities of threads are Linux's")
def test_work_and_its_threads_give_way_to_the_window():
    def priority():
        return os.getpriority(os.PRIO_PROCESS, threading.get_native_id())

    def work(report):
        with ThreadPoolExecutor(1) as pool:
            return priority(), pool.submit(priority).result()

    before = priority()
    job = Job(work)
    job.start()
    assert job.wait(5)
    assert min(job.result()) > min(before, 18)
    assert priority() == before
