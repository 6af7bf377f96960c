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
    judgement = judge(half, "20 %")
    print(judgement.summary())

    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    for name in ("mean stiffness", "deviation of the stiffness"):
        numbers = [n for n in judgement.numbers if n.quantity == name and n.where["H"] == 0.7]
        force, deviation, error = np.array([(n.where["Fbar"], n.difference, n.error) for n in numbers]).T
        axes.errorbar(force, 100 * deviation, 100 * error, marker="o", capsize=2, label=name)
    axes.axhspan(-20, 20, alpha=0.2)
    axes.set(
        xscale="log", xlabel="F / (E* h L)", ylabel="relative deviation from boundary elements [%]", ylim=(-100, 100)
    )
    axes.legend()
    figure.savefig("own_draws.png")

    heavy = [n for n in judgement.numbers if n.quantity == "mean stiffness" and float(n.where["Fbar"]) > 0.09]
    means = [number.verdict for number in heavy]  # short waves matter to the lightest contacts alone
    assert "within tolerance" in means and "outside tolerance" not in means
    deviations = [n.verdict for n in judgement.numbers if n.quantity == "deviation of the stiffness"]
    assert "outside tolerance" in deviations
