# SPDX-License-Identifier: MIT
"""The five charts that the page begins with, each of which answers one question.

A chart is a module with ROOM, TITLE, QUESTION and ABSENT (what is missing where it could not be drawn), and with
is_there(results), drawn(results, pyplot), figures(results) and advice(results), which is a pair: the words that its
parts have in common, and [(what to do, figures in brackets or "")]."""
from . import layouts, patterns, precision, sparsity, stability

CHARTS = (sparsity, patterns, layouts, precision, stability)
