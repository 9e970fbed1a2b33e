"""All of it: the server, the trainees, the attackers; what came of it."""

from __future__ import annotations

import itertools
import multiprocessing
import os
import threading
import time
from collections import Counter
from pathlib import Path

import numpy as np

from app.people import People
from app.people.keys import server_key
from app.session import Store
from app.session.owners import Owners
from tests.hardening.hostile.asking import PASSWORD, PIN, Asking, log_in
from tests.hardening.hostile.attacks import Known, attacks
from tests.hardening.hostile.working import Trainee
from tests.shell.started import Started

_ADDRESSES = 250


def _attack(known, count, seed, results):
    kinds = attacks(known)
    rng = np.random.default_rng(seed)
    weights = np.array([weight for _, weight in kinds.values()], float)
    names, numbers = list(kinds), {name: itertools.count(seed * 1000) for name in kinds}
    done, let_in, lock = Counter(), Counter(), threading.Lock()
    order = iter(rng.choice(len(names), count, p=weights / weights.sum()))

    def one():
        while True:
            with lock:
                k = next(order, None)
                if k is None:
                    return
                name = names[k]
                n = next(numbers[name])
                address = (
                    f"127.0.1.{1 + int(rng.integers(_ADDRESSES))}" if name != "floods" else "127.0.1.254"
                )
            inside = kinds[name][0](Asking(known.port, address), n)
            with lock:
                done[name] += 1
                let_in[name] += bool(inside)

    threads = [threading.Thread(target=one) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    results.put((dict(done), dict(let_in)))


def _p95(trainees):
    trips = [trip for trainee in trainees for trip in trainee.take()]
    return (
        round(1e3 * float(np.percentile(trips, 95)), 1),
        round(1e3 * float(np.percentile(trips, 50)), 1),
        len(trips),
    )


def run(count: int, trainees: int, folder: Path, quiet: float = 10.0) -> dict:
    """All of it; what is printed."""
    store = Store(folder)
    people = People(store.database)
    people.add("ada", "Ada", "administrator", PASSWORD)
    tom = people.add("tom", "Tom", "trainer", PASSWORD)
    at = people.classes.make("Monday", tom.id)
    other = people.classes.make("Tuesday", tom.id)
    mine = [people.join(at.code, f"Trainee {k}", PIN, f"10.0.0.{k}") for k in range(trainees)]
    eve = people.join(other.code, "Eve", PIN, "10.0.1.1")
    served = Started(folder, "--host", "0.0.0.0")
    try:
        ended = log_in(served.port, eve.login, PIN, "127.0.0.2")
        people.logins.end(ended.partition("=")[2].rpartition(".")[0])
        own = log_in(served.port, eve.login, PIN, "127.0.0.3")
        sitting = [Trainee(served.port, person.login) for person in mine]
        time.sleep(3.0)
        for trainee in sitting:
            trainee.take()
        time.sleep(quiet)
        calm95, calm50, _ = _p95(sitting)
        session = Owners(store.database).latest(mine[0].owner)
        victim = Known(
            served.port, own, ended, mine[0].id, session, at.id, server_key(store.database, "guess").hex()
        )
        spawning = multiprocessing.get_context("spawn")  # a fork would hold the trainees' sockets, too
        results = spawning.Queue()
        begun = time.perf_counter()
        attackers = [spawning.Process(target=_attack, args=(victim, count // 2, s, results)) for s in (1, 2)]
        for attacker in attackers:
            attacker.start()
        done, let_in = Counter(), Counter()
        for _ in attackers:
            one, inside = results.get()
            done.update(one)
            let_in.update(inside)
        seconds = time.perf_counter() - begun
        p95, p50, answers = _p95(sitting)
        lost = sum(trainee.lost for trainee in sitting)
        alive = served.process.poll() is None
        for trainee in sitting:
            trainee.stop()
        return {
            "requests": sum(done.values()),
            "let in": sum(let_in.values()),
            "let in by kind": {k: v for k, v in let_in.items() if v},
            "by kind": dict(done),
            "seconds": round(seconds, 1),
            "trainees": trainees,
            "p95 ms, p50 ms before": [calm95, calm50],
            "p95 ms, p50 ms meanwhile": [p95, p50],
            "answers": answers,
            "pages lost": lost,
            "server alive": alive,
            "load of the machine": os.getloadavg()[0],
        }
    finally:
        served.kill()
