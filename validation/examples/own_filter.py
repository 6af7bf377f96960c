"""A contact filter of one's own is judged: over which waves, and over what lies across, is it enough?"""

import numpy as np
from matplotlib.figure import Figure

from validation import contact_filter, judge


@contact_filter("first order")
def first_order(k_x, a_x):
    """A filter of the line alone, which falls by 20 dB a decade and knows nothing of what lies across [-]."""
    return 1 / np.hypot(1, k_x * a_x / 2)


if __name__ == "__main__":  # `mdr-validation judge own_filter.py` does not come here
    found = judge(first_order, "1 dB")
    print(found.summary())

    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    for across, label in ((0.0, "ridges"), ("isotropic", "isotropic ground")):
        where = {"wheel": "50 kN, 920 mm", "alpha": across}
        points = [p for p in found.verdicts if p.quantity == "contact filter" and where.items() <= p.where.items()]
        wave, apart, error = np.array([(p.where["wavelength [mm]"], p.difference, p.error) for p in points]).T
        axes.errorbar(wave, apart, error, marker="o", capsize=2, label=label)
    axes.axhspan(-1, 1, alpha=0.2)
    axes.set(xscale="log", xlabel="wavelength [mm]", ylabel="A3 off boundary elements [dB]")
    axes.legend()
    figure.savefig("own_filter.png")

    (enough,) = [r for r in found.enough if r.where == {"wheel": "50 kN, 920 mm", "alpha": 0.0} and r.stop > 40]
    assert enough.verdict == "agree" and enough.start > 25  # long waves, over ridges
    assert apart.max() > 2  # isotropic ground: what lies across is left out
