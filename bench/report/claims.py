# SPDX-License-Identifier: MIT
"""What must hold: each claim of the project, with what was measured."""
import statistics

from .page import folded, markdown_row, table
from .spread import figure_of, limits

HOLDS, FAILS, NOISY, NO_TARGET, NOT_MEASURED = "holds", "fails", "noisy", "no target", "not measured"
MARKS = {HOLDS: "✓ holds", FAILS: "✗ fails", NO_TARGET: "–", NOT_MEASURED: NOT_MEASURED}


class Claim:
    """One line of the table. A claim over several points holds where it holds at each of them."""

    def __init__(self, text, target, unit="x", at_least=True):
        self.text, self.target, self.unit, self.at_least = text, target, unit, at_least
        self.values = []  # (value, portable value or None, where)

    def add(self, value, where, portable=None):
        if value is not None:
            self.values.append((value, portable, where))
        return self

    def worst(self):
        return self.worst_of(self.values)

    def worst_of(self, values):
        return (min if self.at_least else max)(values, key=lambda v: v[0])

    def verdict_at(self, value):
        """The repetitions tell nothing where the target lies between the lowest and the highest ratio."""
        target = self.target * (.995 if self.at_least else 1.005)  # as it is printed
        holding = [x >= target if self.at_least else x <= target for x in limits(value)]
        return HOLDS if all(holding) else NOISY if any(holding) else FAILS

    def verdict(self):
        if not self.values:
            return NOT_MEASURED
        if self.target is None:
            return NO_TARGET
        found = {self.verdict_at(v[0]) for v in self.values}
        return next(verdict for verdict in (FAILS, NOISY, HOLDS) if verdict in found)

    def target_text(self):
        if self.target is None:
            return "none"
        return f"{'at least' if self.at_least else 'at most'} {self.target:g}{self.unit}"

    def mark(self):
        verdict = self.verdict()
        if verdict != NOISY:
            return MARKS[verdict]
        low, high = limits(self.worst_of(v for v in self.values if self.verdict_at(v[0]) == NOISY)[0])
        return f"too noisy to tell ({figure_of(low)}–{figure_of(high)}{self.unit})"

    def cells(self):
        """(claim, target, median, worst, where, portable worst, mark)"""
        if not self.values:
            return self.text, self.target_text(), "", "", "", "", self.mark()
        worst = self.worst()
        portables = [v[1] for v in self.values if v[1]]
        portable = (min if self.at_least else max)(portables) if portables else None
        middle = statistics.median(v[0] for v in self.values)
        where = worst[2] + (f" (of {len(self.values)})" if len(self.values) > 1 else "")
        return (self.text, self.target_text(), figure_of(middle) + self.unit, figure_of(worst[0]) + self.unit, where,
                figure_of(portable) + self.unit if portable else "", self.mark())


CLAIM_HEAD = ("Claim", "Target", "Median", "Worst", "Where", "Portable, worst", "")


def claim_section(claims, note):
    verdicts = [claim.verdict() for claim in claims]
    rows, unmeasured = [], []
    for claim, verdict in zip(claims, verdicts):
        if verdict == NOT_MEASURED:
            unmeasured.append((claim.text, claim.target_text()))
        else:
            *cells, mark = claim.cells()
            rows.append([*cells, f'<td class="{verdict}">{mark}</td>' if verdict in (HOLDS, FAILS, NOISY) else mark])
    failing = [row for row, verdict in zip(rows, (v for v in verdicts if v != NOT_MEASURED)) if verdict == FAILS]
    held, failed, noisy = (verdicts.count(verdict) for verdict in (HOLDS, FAILS, NOISY))
    return (f'<h2 id="claims">What must hold</h2><p>{held} of {held + failed} claims that this run can judge hold' +
            (f"; too noisy to tell: {noisy} more, whose target lies between the lowest and the highest ratio that the "
             "repetitions allow, which stand in brackets" if noisy else "") +
            f". A claim holds where it holds at the worst of its points. {note}</p>" +
            (f"<p>Those that do not:</p>{table(CLAIM_HEAD, failing)}" if failing else "") +
            folded(f"All claims that were measured: {len(rows)}", table(CLAIM_HEAD, rows)) +
            (folded(f"Claims not measured in this run: {len(unmeasured)}", table(CLAIM_HEAD[:2], unmeasured))
             if unmeasured else ""))


def markdown_claims(claims):
    """The lines of a table, after an empty one."""
    return ["", markdown_row([h or "verdict" for h in CLAIM_HEAD]), "|" + "---|" * len(CLAIM_HEAD),
            *(markdown_row(claim.cells()) for claim in claims)]
