"""A quantity, configurations, a clock and runs of commands that are made up."""

import dataclasses
import json
import os
from concurrent.futures import Future
from contextlib import nullcontext

import numpy as np

import validation.__main__ as command
from validation.benchmarks import timing
from validation.benchmarks.timing import FINISHED, Configuration, TimedProblem
from validation.benchmarks.work_precision.pareto import Point
from validation.benchmarks.work_precision.problem import mean_of
from validation.report.contents import TIMED
from validation.simulation.method import Resolution, Result, Solve

MEAN = mean_of("mean", "k")


def k(values):
    return {"k": np.array(values, dtype=float)}


def point(line, off, seconds, **settings):
    settings = {"status": FINISHED, "band": 0.001, "unit": "%", "parameter": "# cells", "value": 8.0, **settings}
    quartiles = 0.9 * seconds, seconds, 1.2 * seconds
    return Point(scene="scene", quantity="force", method=line, error=off, seconds=quartiles, **settings)


@dataclasses.dataclass(frozen=True)
class Acting:
    """For a test: what it does, by name."""

    name: str = "right"

    def prepare(self, scene, resolution):
        if self.name == "refuses":
            raise ValueError("springs must be more, got 3")
        if self.name == "dies at once":
            os._exit(1)

        def run():
            if self.name == "dies":
                os._exit(1)
            if self.name == "raises":
                raise RuntimeError("lost its way")
            return 2.0

        return lambda realisation: Solve(run, lambda found: Result({"k": np.array(found + realisation)}, 10.0))


@dataclasses.dataclass(frozen=True)
class Made:
    """For a test: a problem of such configurations."""

    tried: tuple[Configuration, ...]
    name = "made"
    quantities = (MEAN,)
    scene, served = None, ()

    def configurations(self):
        return self.tried

    def reference(self):
        return k([2.0])

    def pairs(self):
        return ()


def named(act, worker=timing.OURS, **settings):
    name = "right" if act == "again" else act
    known = {"method": Acting(name), "scene": None, "resolution": Resolution(), "parameter": "#", "value": 1.0}
    return Configuration(label=act, worker=worker, **known, **settings)


def timed_problem(*tried, slow=1.0, enough=0.0):
    return TimedProblem(problem=Made(tried), slow=slow, enough=enough)


class Inline:
    """A process that is this one."""

    def submit(self, function, *arguments):
        done = Future()
        done.set_result(function(*arguments))
        return done


def use_a_clock_of_its_own(monkeypatch):
    monkeypatch.setattr(timing, "isolated_process", lambda: nullcontext(Inline()))
    monkeypatch.setattr(timing, "timed", lambda function: (function(), 0.01))


def run_command(case, result, out, monkeypatch):
    """What the command of a timed case writes of a result, whose times are kept apart."""
    entry = dataclasses.replace(case, quick=result.case, run=lambda settings, engine: result)
    monkeypatch.setitem(TIMED, case.name, entry)
    assert command.main([case.name, "--out", str(out)]) == command.Exit.MET
    assert json.loads((out / "results.json").read_text(encoding="utf-8"))["cases"] == {}
    return json.loads((out / f"{case.name}.json").read_text(encoding="utf-8"))["cases"][case.name]
