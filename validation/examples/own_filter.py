"""A contact filter of one's own is judged: for which waves and lateral structures is it accurate enough?"""

import numpy as np
from matplotlib.figure import Figure

from validation import contact_filter, judge


@contact_filter("first order")
def first_order(k_x, a_x):
    """A filter of the line alone, which falls by 20 dB a decade and knows nothing of what lies across [-]."""
    return 1 / np.hypot(1, k_x * a_x / 2)


if __name__ == "__main__":  # `mdr-validation judge own_filter.py` does not come here
    judgement = judge(first_order, "1 dB")
    print(judgement.summary())

    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    for across, label in ((0.0, "ridges"), ("isotropic", "isotropic ground")):
        where = {"wheel": "50 kN, 920 mm", "alpha": across}
        numbers = [n for n in judgement.numbers if n.quantity == "contact filter" and where.items() <= n.where.items()]
        wave, deviation, error = np.array([(n.where["wavelength [mm]"], n.difference, n.error) for n in numbers]).T
        axes.errorbar(wave, deviation, error, marker="o", capsize=2, label=label)
    axes.axhspan(-1, 1, alpha=0.2)
    axes.set(xscale="log", xlabel="wavelength [mm]", ylabel="A3 relative to boundary elements [dB]")
    axes.legend()
    figure.savefig("own_filter.png")

    (long,) = [r for r in judgement.ranges if r.where == {"wheel": "50 kN, 920 mm", "alpha": 0.0} and r.stop > 40]
    assert long.verdict == "within tolerance" and long.start > 25  # long waves, laterally uniform roughness
    assert deviation.max() > 2  # isotropic roughness: a filter of the line leaves the lateral structure out
