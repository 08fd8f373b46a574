# SPDX-License-Identifier: MIT
"""Medians with their spread, the rule of noise, and how figures are written."""
import math
import statistics


class Spread(float):
    """A median, or a ratio of two, that knows the lowest and the highest it may be taken for."""

    def __new__(cls, median, low, high):
        made = super().__new__(cls, median)
        made.low, made.high = low, high
        return made


def power(n):
    """10000 -> 1e4, 400000 -> 4e5, 64 -> 64."""
    digits = str(n)
    return f"{digits[0]}e{len(digits) - 1}" if n >= 10000 and not digits[1:].strip("0") else digits


def figure_of(value):
    """Three digits."""
    if value == 0:
        return "0"
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def short_power(value):
    """0.01, but 1e-4"""
    return f"{value:g}" if value >= .001 else f"{value:.0e}".replace("e-0", "e-")


def limits(value):
    """(lowest, highest); twice the value if it is exact."""
    return (value.low, value.high) if isinstance(value, Spread) else (value, value)


def quotient(a, b):
    """Of the medians; from the lowest a by the highest b to the highest a by the lowest b."""
    if not a or not b:
        return None
    (a_low, a_high), (b_low, b_high) = limits(a), limits(b)
    return Spread(a / b, a_low / b_high, a_high / b_low)


def middle(values):
    """The median, and between which of the values it lies at 93 % or more, whatever their distribution; of fewer than
    FEWEST the lowest and the highest."""
    values = sorted(values)
    count = len(values)
    k, below = 0, 2.0 / 2**count  # the chance that the median lies outside of values[k] .. values[-1 - k]
    while k + 1 < count // 2 and below + 2.0 * math.comb(count, k + 1) / 2**count <= .07:
        k += 1
        below += 2.0 * math.comb(count, k) / 2**count
    return Spread(statistics.median(values), values[k], values[-1 - k])


FEWEST = 5  # values, with which the interval of middle() holds the median at 93 %; of 3 it does at 75 %


def scaled(value, factor):
    """The Spread of what is proportional."""
    return Spread(value * factor, *(x * factor for x in limits(value)))


def apart(a, b):
    """The rule of noise, of all sentences and comparisons: two medians differ if the intervals in which they lie do
    not overlap."""
    (a_low, a_high), (b_low, b_high) = limits(a), limits(b)
    return a_high < b_low or b_high < a_low


def as_good(values):
    """Of {name: cost} those names that are within noise of the least, the least first."""
    found = sorted((value, name) for name, value in values.items() if value)
    return [name for value, name in found if not apart(value, found[0][0])]


def runs_of_choice(places, values_at, weights_at=lambda place: {}):
    """[(name, [places])]: what to choose along an axis, changed only where it is worse than the best beyond noise.

    values_at(place): {name: cost}; of those within noise of the best the one of the least weight is taken, if it has
    one, else the best."""
    runs = []
    for place in places:
        good = as_good(values_at(place))
        weights = weights_at(place)
        if good and runs and runs[-1][0] in good:
            runs[-1][1].append(place)
        elif good:
            runs.append((min(good, key=lambda name: weights.get(name, math.inf)), [place]))
    return runs


def spans_text(runs, at, label=str, place=str):
    """dense up to T/N = 8, flat from 64 on"""
    parts = []
    for k, (name, places) in enumerate(runs):
        first, last = place(places[0]), place(places[-1])
        if len(runs) == 1:
            span = "everywhere" if len(places) > 1 else f"at {at}{first}"
        elif k == 0:
            span = f"at {at}{first}" if first == last else f"up to {at}{last}"
        elif k == len(runs) - 1:
            span = f"from {first} on" if first != last else f"at {first}"
        else:
            span = f"at {first}" if first == last else f"from {first} to {last}"
        parts.append(f"{label(name)} {span}")
    return listed(parts)


def listed(words):
    """a, b and c"""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
