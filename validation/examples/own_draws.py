"""A stiffness model of one's own that draws: its mean and deviation are taken from realisations, with their errors."""

import numpy as np
from matplotlib.figure import Figure

import mdr
from validation import judge, stiffness_model


@stiffness_model("springs on half as many waves")
def half(load, side, modulus, roughness, rng):
    """Springs on one profile of Geike's spectrum whose shorter half of the waves is left out [N/m]."""

    def spectrum(q):
        return np.where(q < roughness.q_max / 2, roughness.c1d(q), 0.0)

    profile = mdr.rough_profile(spectrum, length=side, points=512, rng=rng, rms=roughness.rms)
    return mdr.load_curve(profile, length=side, modulus=modulus).at_force(load).stiffness


if __name__ == "__main__":
    found = judge(half, "20 %")
    print(found.summary())

    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    for name in ("mean stiffness", "deviation of the stiffness"):
        points = [p for p in found.verdicts if p.quantity == name and p.where["H"] == 0.7]
        force, apart, error = np.array([(p.where["Fbar"], p.difference, p.error) for p in points]).T
        axes.errorbar(force, 100 * apart, 100 * error, marker="o", capsize=2, label=name)
    axes.axhspan(-20, 20, alpha=0.2)
    axes.set(xscale="log", xlabel="F / (E* h L)", ylabel="off boundary elements [%]", ylim=(-100, 100))
    axes.legend()
    figure.savefig("own_draws.png")

    means = [p.verdict for p in found.verdicts if p.quantity == "mean stiffness" and float(p.where["Fbar"]) > 0.09]
    assert "agree" in means and "differ" not in means  # short waves matter to the lightest contacts alone
    assert any(p.verdict == "differ" for p in found.verdicts if p.quantity == "deviation of the stiffness")
