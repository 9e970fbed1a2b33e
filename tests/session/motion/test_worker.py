import threading
import time

import pytest

from app.session.motion.worker import _MOVING, TOGETHER_HZ, Worker


@pytest.fixture
def worker():
    failed = []

    def around(job):
        try:
            job()
        except Exception as error:
            failed.append(error)

    worker = Worker("test", around)
    worker.failed = failed
    yield worker
    worker.stop()


def held(worker):
    """A job that keeps the worker busy until it is let go, so that the queue fills."""
    gate, begun = threading.Event(), threading.Event()

    def wait():
        begun.set()
        gate.wait(5.0)

    worker.post(wait)
    begun.wait(5.0)
    return gate


def test_clicks_are_done_in_order_and_none_is_lost(worker):
    gate, done = held(worker), []
    for number in range(50):
        worker.post(lambda number=number: done.append(number))
    gate.set()
    assert worker.idle()
    assert done == list(range(50))


def test_of_poses_that_wait_only_the_newest_is_shown(worker):
    gate, done = held(worker), []
    for number in range(20):
        worker.latest("drag", lambda number=number: done.append(number))
        worker.latest("slider", lambda number=number: done.append(-number))
    gate.set()
    assert worker.idle()
    assert sorted(done) == [-19, 19]


def test_a_pose_after_a_click_is_not_shown_before_it(worker):
    gate, done = held(worker), []
    worker.latest("drag", lambda: done.append("pose 1"))
    worker.post(lambda: done.append("record"))
    worker.latest("drag", lambda: done.append("pose 2"))
    gate.set()
    assert worker.idle()
    assert done == ["pose 1", "record", "pose 2"]


def test_a_job_that_fails_ends_neither_the_worker_nor_the_jobs_after_it(worker):
    done = []
    worker.post(lambda: 1 / 0)
    worker.post(lambda: done.append("after"))
    assert worker.idle()
    assert done == ["after"] and isinstance(worker.failed[0], ZeroDivisionError)


def test_a_motion_runs_beside_the_queue_and_can_be_halted(worker):
    ticks = []

    def endless():
        while True:
            ticks.append(1)
            yield

    worker.post(lambda: worker.animate("move", endless()))
    while len(ticks) < 3:
        pass
    assert worker.running("move")
    worker.post(lambda: worker.halt("move"))
    assert worker.idle()
    assert not worker.running("move")


def test_a_motion_that_fails_is_forgotten_and_told(worker):
    def failing():
        yield
        raise RuntimeError("in the middle")

    worker.post(lambda: worker.animate("move", failing()))
    assert worker.idle()
    assert "in the middle" in str(worker.failed[0])


def test_of_motions_that_fail_at_one_tick_each_is_told_and_the_others_go_on(worker):
    ticks = []

    def fails(words):
        yield
        raise ValueError(words)

    def runs():
        while True:
            ticks.append(1)
            yield

    def begin():
        for name, steps in (("one", fails("one")), ("other", fails("other")), ("runs", runs())):
            worker.animate(name, steps)

    worker.post(begin)
    until = time.monotonic() + 5.0
    while (len(worker.failed) < 2 or len(ticks) < 5) and time.monotonic() < until:
        time.sleep(0.01)
    assert sorted(map(str, worker.failed)) == ["one", "other"]
    assert worker.running("runs") and not worker.running("one") and not worker.running("other")


def test_a_new_motion_replaces_the_one_before(worker):
    done = []

    def motion(name, count):
        for _ in range(count):
            yield
        done.append(name)

    worker.post(lambda: worker.animate("move", motion("first", 10_000)))
    worker.post(lambda: worker.animate("move", motion("second", 2)))
    assert worker.idle()
    assert done == ["second"]


def test_a_stopped_worker_does_nothing_any_more(worker):
    gate, done = held(worker), []
    worker.post(lambda: done.append("late"))
    threading.Timer(0.05, gate.set).start()
    worker.stop()
    assert done == []


def test_what_waits_for_its_time_is_done_once_and_given_up_for_a_newer_one(worker):
    done = []
    worker.later("settle", 0.05, lambda: done.append("old"))
    worker.later("settle", 0.1, lambda: done.append("new"))
    worker.later("numbers", 0.02, lambda: done.append("numbers"))
    assert worker.waits("settle") and not worker.waits("nothing") and done == []
    assert worker.idle()
    assert done == ["numbers", "new"] and not worker.waits("settle")


def test_what_waits_can_be_given_up(worker):
    done = []
    worker.later("settle", 0.05, lambda: done.append("settled"))
    worker.halt("settle")
    assert worker.idle() and not done


def test_many_that_move_at_once_share_the_ticks_of_their_process():
    ticks = []

    def goes_on():
        while True:
            ticks.append(time.monotonic())
            yield

    workers = [Worker(f"arm-{k}", lambda job: job()) for k in range(40)]
    try:
        for worker in workers:
            worker.post(lambda worker=worker: worker.animate("jog", goes_on()))
        time.sleep(0.5)  # all of them move
        begun, before = time.monotonic(), len(ticks)
        time.sleep(1.0)
        a_second = (len(ticks) - before) / (time.monotonic() - begun)
        assert 0 < a_second <= 1.1 * TOGETHER_HZ  # forty at their own pace would be 1,200
        for worker in workers[1:]:
            worker.stop()
        before = len(ticks)
        time.sleep(0.5)
        assert len(ticks) > before  # the one that is left goes on
        workers[0].halt()
        assert not _MOVING.intersection(workers)  # what stands takes no share
    finally:
        for worker in workers:
            worker.stop()
