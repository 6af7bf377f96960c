"""A stiffness model of one's own, a formula, is judged: from which load on is it enough?"""

import numpy as np
from matplotlib.figure import Figure

from validation import judge, stiffness_model


@stiffness_model("interface in series")
def series(load, side, modulus, roughness):
    """The rough interface, whose stiffness grows as the load, in series with the flat punch [N/m]."""
    return 1 / (0.49 * roughness.rms / load + 1 / (1.1523 * modulus * side))


if __name__ == "__main__":  # `mdr-validation judge own_model.py` does not come here
    found = judge(series, "10 %")
    print(found.summary())

    points = [p for p in found.verdicts if p.quantity == "mean stiffness" and p.where["H"] == 0.7]
    force, apart, error = np.array([(p.where["Fbar"], p.difference, p.error) for p in points]).T
    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    axes.errorbar(force, 100 * apart, 100 * error, marker="o", capsize=2, label="H = 0.7")
    axes.axhspan(-10, 10, alpha=0.2)
    axes.set(xscale="log", xlabel="F / (E* h L)", ylabel="stiffness off boundary elements [%]")
    axes.legend()
    figure.savefig("own_model.png")

    (enough,) = [r for r in found.enough if r.quantity == "mean stiffness" and r.where == {"H": 0.7} and r.stop > 9]
    assert enough.verdict == "agree"
    assert 0.2 < enough.start < 0.5  # light loads are carried by summits, whatever the rms height
    assert apart[0] < -0.8
