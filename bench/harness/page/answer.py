# SPDX-License-Identifier: MIT
"""The paragraph that the page opens with: what each part says in a sentence or two, in numbers."""
import html

from harness.measure.numbers import number

BACKENDS = {"c": "plain C", "cuda": "CUDA", "opencl": "OpenCL"}


def figure(name, value, words=None):
    """A number of the sentence, which says by its name what it is."""
    words = words or (number(value, 3) if value else "0")
    return f"<strong data-figure=\"{html.escape(name)}\" data-value=\"{value!r}\">{html.escape(words)}</strong>"


def milliseconds(name, value):
    return figure(name, value, f"{number(value, 3)} ms" if value < 1000 else f"{number(value / 1000, 3)} s")


def runnable(result):
    return [device for device in result["devices"] if device["reason"] is None]


def paragraph(parts, results):
    said = [sentence for part in sorted(parts.values(), key=lambda part: part.lead) if part.answer
            for sentence in part.answer(results)]
    return f"<p class=\"answer\">{' '.join(said)}</p>"
