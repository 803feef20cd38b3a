#!/usr/bin/env python3
"""machines.py [RUNS...]: how many measuring machines so many runs a day need, so that 95 of 100 begin within a minute.

Simulates some days. Runs are asked for at random, eight hours a day 2.2 times as often as on average, and measured in the
order in which they came, each by the first free machine. A run takes a lognormal time (71 s on average, as after a budget of
a minute, but cut at 600 s, which leaves 70) and 1.6 s around it. First the simulation is compared with Erlang's formula for the waits of an even
stream of exponential runs (A. K. Erlang, Elektroteknikeren 13:5, 1917), and ends with 1 if they differ.
"""

import heapq
import math
import random
import sys
from collections.abc import Callable

HOUR = 3600.0
# Ten days, or fewer of many runs.
DAYS, RUNS = 10, 300_000
WAIT, SHARE = 60.0, 0.95
MEAN, LONGEST, AROUND = 71.0, 600.0, 1.6
BUSY = range(9, 17)


def often(second: float) -> float:
    """How often runs are asked for at this time, by the average."""
    return 2.2 if second // HOUR % 24 in BUSY else 0.4


def arrivals(a_day: float, days: int, rate: Callable[[float], float], most: float, chance: random.Random) -> list[float]:
    """When runs are asked for, by thinning an even stream of the highest rate."""
    now, found, per_second = 0.0, [], a_day / (24 * HOUR)
    while (now := now + chance.expovariate(per_second * most)) < days * 24 * HOUR:
        if chance.random() * most < rate(now):
            found.append(now)
    return found


def run_time(chance: random.Random) -> float:
    return min(chance.lognormvariate(math.log(MEAN) - 0.5, 1.0), LONGEST) + AROUND


def waits(asked: list[float], takes: list[float], machines: int) -> list[float]:
    """How long each run waits for a machine."""
    free, found = [0.0] * machines, []
    for when, time in zip(asked, takes, strict=True):
        begins = max(when, heapq.heappop(free))
        found.append(begins - when)
        heapq.heappush(free, begins + time)
    return found


def in_time(found: list[float]) -> float:
    """Share of the runs that wait less than a minute."""
    return sum(wait < WAIT for wait in found) / len(found)


def enough(asked: list[float], takes: list[float]) -> int:
    """The smallest number of machines with which enough runs begin in time."""
    low, high = 0, 1
    while in_time(waits(asked, takes, high)) < SHARE:
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if in_time(waits(asked, takes, middle)) >= SHARE else (middle, high)
    return high


def check(chance: random.Random) -> None:
    """Ten machines, so many exponential runs of a minute that eight and a half of them are busy."""
    machines, busy, minute = 10, 8.5, 60.0
    asked = arrivals(busy * 24 * HOUR / minute, 40, lambda _: 1.0, 1.0, chance)
    found = waits(asked, [chance.expovariate(1 / minute) for _ in asked], machines)
    blocked = 1.0
    for number in range(1, machines + 1):
        blocked = busy * blocked / (number + busy * blocked)
    waiting = blocked / (1 - busy / machines * (1 - blocked))
    expected = 1 - waiting * math.exp(-(machines - busy) * WAIT / minute)
    if abs(in_time(found) - expected) > 0.01:
        sys.exit(f"machines: {in_time(found):.3f} begin within a minute, by Erlang's formula {expected:.3f}")


def main() -> None:
    chance = random.Random(1)
    check(chance)
    print("runs a day  machines  begin within a minute  busy")
    for a_day in map(int, sys.argv[1:] or ["1000", "3000", "10000", "30000", "100000"]):
        days = min(DAYS, max(1, RUNS // a_day))
        asked = arrivals(a_day, days, often, 2.2, chance)
        takes = [run_time(chance) for _ in asked]
        machines = enough(asked, takes)
        busy = sum(takes) / (machines * days * 24 * HOUR)
        print(f"{a_day:10}  {machines:8}  {in_time(waits(asked, takes, machines)):21.1%}  {busy:4.0%}")


main()
