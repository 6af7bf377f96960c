"""A stiffness model of one's own, a formula, is judged: from which load on is it accurate enough?"""

import numpy as np
from matplotlib.figure import Figure

from validation import judge, stiffness_model


@stiffness_model("interface in series")
def series(load, side, modulus, roughness):
    """The rough interface, whose stiffness grows as the load, in series with the flat punch [N/m]."""
    return 1 / (0.49 * roughness.rms / load + 1 / (1.1523 * modulus * side))


if __name__ == "__main__":  # `mdr-validation judge own_model.py` does not come here
    judgement = judge(series, "10 %")
    print(judgement.summary())

    numbers = [n for n in judgement.numbers if n.quantity == "mean stiffness" and n.where["H"] == 0.7]
    force, deviation, error = np.array([(n.where["Fbar"], n.difference, n.error) for n in numbers]).T
    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    axes.errorbar(force, 100 * deviation, 100 * error, marker="o", capsize=2, label="H = 0.7")
    axes.axhspan(-10, 10, alpha=0.2)
    axes.set(xscale="log", xlabel="F / (E* h L)", ylabel="relative deviation from boundary elements [%]")
    axes.legend()
    figure.savefig("own_model.png")

    ranges = [r for r in judgement.ranges if r.quantity == "mean stiffness" and r.where == {"H": 0.7}]
    assert ranges[-1].verdict == "within tolerance" and ranges[-1].stop > 9
    assert 0.2 < ranges[-1].start < 0.5  # light loads are carried by summits, whatever the rms height
    assert deviation[0] < -0.8
