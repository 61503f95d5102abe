"""Warnings as data: a code and its values; the sentence is made where a person reads it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["SENTENCES", "Caution", "caution"]

# Every code with its sentence, without the period. Lengths are in inner radii.
SENTENCES = {
    # --- a case
    "wall_beyond_range": (
        "the stone stretches the wall to {stretch:.3g} times its circumference, but the constants "
        "of material '{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "lumen_below_range": (
        "the load narrows the lumen to {lumen:.3g} times its unloaded diameter, but the constants "
        "of material '{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "ring_buckling": (
        "the confining pressure of {pressure_kPa:.3g} kPa exceeds the ring buckling pressure of "
        "the empty tube, about {buckling_kPa:.2g} kPa: where neither stone nor urine supports it, "
        "the tube would collapse, which an axisymmetric model cannot represent"
    ),
    "shape_deviation": (
        "the computed shape of the stone, the nearest smooth convex one, deviates from the given "
        "points by up to {deviation:.1%} of the stone's radius"
    ),
    "not_elliptic": (
        "the wall is not stable at R = {R:.3g}, Z = {Z:.3g} (inner radii): a shear band lowers its "
        "energy (stability margin {margin:.2g}), so the solution may depend on the mesh; compare "
        "the answer with that of another accuracy before you rely on it"
    ),
    "hoop_compression": (
        "the wall is under a hoop compression of {compression:.2g} times its shear modulus at "
        "R = {R:.3g}, Z = {Z:.3g} (inner radii): a real tube may fold there, which an axisymmetric "
        "model cannot represent"
    ),
    "microbuckling": (
        "the axial fibres of the wall are compressed and buckle on a fine scale at R = {R:.3g}, "
        "Z = {Z:.3g} (inner radii, downstream positive), which makes the stability margin "
        "negative; the model accounts for this by the relaxed energy of the wall, so the critical "
        "pressure can be trusted as far as the material law can"
    ),
    "seated_imbalance": (
        "the axial forces on the tube are out of balance by {imbalance:.1%} of the contact force"
    ),
    "loaded_imbalance": (
        "the axial forces on tube and stone are out of balance by {imbalance:.1%}"
    ),
    "friction_cone": (
        "the friction stress exceeds the friction coefficient times the contact pressure at some "
        "place, which violates Coulomb's law"
    ),
    "error_not_estimated": (
        "the discretisation error is not estimated, since there is no solution on a coarser mesh"
    ),
    "contact_angle_uncertain": (
        "the contact angle has an uncertainty of {uncertainty_deg:.2f}°, because the solver found "
        "no smooth contact edge"
    ),
    "closure_undecided": (
        "a coarser mesh gives another outcome: the discretisation error is too large to decide "
        "whether the stone moves before the closure ends"
    ),
    "leak_undecided": (
        "a coarser mesh gives another outcome: the discretisation error is too large to decide "
        "whether the stone moves before urine passes it"
    ),
    "moves_at_contact_angle": (
        "the drive exceeds the resistance already at the seated contact angle, because the paper's "
        "closure starts at the unloaded inner radius, which is wider than the narrowed lumen; the "
        "critical pressure is computed at the seated contact angle, and closure_start = 'lumen' "
        "would start the closure at the narrowed lumen instead"
    ),
    "smaller_than_lumen": (
        "the stone is smaller than the unloaded lumen, so the radius of the paper's closure would "
        "decrease while the wall opens; the closure keeps the radius of the stone instead, so that "
        "P_ucr is the pressure that opens the tube to the width of the stone, whatever the "
        "friction is: a closure that starts at the lumen, or the model 'direct', includes it"
    ),
    "long_beam_contact": (
        "half the contact length is {decay_lengths:.2g} decay lengths of the beam, but the beam "
        "model takes the force of the stone as a point load"
    ),
    "thick_beam": (
        "the wall is {thickness:.2g} inner radii thick and is widened by {widening:.2g} inner "
        "radii, but the beam model assumes that both are small"
    ),
    "no_closed_answer": "the closure of Eq. 15 has the outcome {outcome}: {message}",
    # --- surface images
    "single_path": (
        "there is only one profile, so the variation of the friction over the surface is unknown"
    ),
    "uneven_paths": (
        "the longest profile has {ratio:.2f} times the length of the shortest; all are cut to the "
        "shortest length"
    ),
    "friction_spread_missing": (
        "no spread is given, since some of the varied analysis choices make the slopes too steep "
        "for a friction coefficient"
    ),
    "paths_too_short": (
        "the profiles are too short for some of the baseline orders over which the spread is taken"
    ),
    "baseline_at_path_end": (
        "the steepest slope of a baseline lies at the limit of the range in which it is sought, "
        "near the ends of the profiles, and the baseline may be steeper beyond it: choose longer "
        "profiles"
    ),
    "friction_beyond_range": (
        "the friction coefficient exceeds {largest:g}, the largest that the models accept"
    ),
    "saturated_greys": (
        "{fraction:.0%} of the pixels have the darkest or brightest grey, where heights are cut off"
    ),
    "isolated_grey": (
        "the darkest or the brightest grey is far from all other greys, so a scale bar or a label "
        "probably sets the scale of the heights; exclude it with --area"
    ),
    "plain_rows": (
        "{fraction:.0%} of the rows have the same grey in at least half of their pixels, so they "
        "are probably a data bar or a missing part of the image; exclude them with --area"
    ),
    "plain_border": (
        "the outermost rows or columns have one single grey and end abruptly, so they are probably "
        "a border; exclude them with {option}"
    ),
    "drawn_bar": (
        "the pixels left, top, right, bottom = {place} are a filled rectangle of the darkest or "
        "brightest grey, like a scale bar that is drawn into the picture: leave it out with "
        "--area, and choose paths that avoid it"
    ),
    # --- laboratory
    "not_bounded": (
        "the data do not determine {name}: its confidence interval is open on both sides"
    ),
    "bounded_on_one_side": "the confidence interval of {name} is open on one side",
    "ambiguous_fit": (
        "other constants of the law, {constants}, describe the data as well, but another solid: "
        "use another kind of test to tell them apart"
    ),
    "residuals_grow": (
        "the residuals grow with the stress, so the confidence intervals are too narrow: fit with "
        "relative errors (--relative)"
    ),
    "lack_of_fit": (
        "the law deviates from the data systematically, by {off_kPa:.3g} kPa ({share:.1%} of the "
        "largest value) at about {at:.3g} times the size at rest, so the confidence intervals are "
        "too narrow: try another law or a smaller range"
    ),
    "residuals_correlated": (
        "neighbouring residuals are correlated (correlation {alike:.2f}, p = {chance:.1g}), either "
        "because the law deviates from the data systematically or because the errors of "
        "measurement are correlated; the confidence intervals are too narrow"
    ),
    "zero_offset": (
        "a zero offset of {offset_kPa:.3g} kPa in the measured values improves the fit "
        "(p = {chance:.1g}): subtract the reading without load"
    ),
    "rest_size": (
        "stretches that differ by {part:+.2%} from the given ones improve the fit "
        "(p = {chance:.1g}), which points to slack, to a pre-stretch or to a wrong size at rest: "
        "measure the size at rest where the load begins"
    ),
    "slack": (
        "the fit improves if the strip carries no load up to a stretch of {stretch:.3g} "
        "(p = {chance:.1g}): use the length at that stretch as the length at rest, and leave out "
        "the rows before it"
    ),
    "axial_rest_length": (
        "an axial stretch that differs by {part:+.2%} from the given one improves the fit "
        "(p = {chance:.1g}): give the axial stretch in the column axial_stretch"
    ),
    "hysteresis": (
        "loading and unloading differ by up to {share:.1%} of the largest value "
        "(p = {chance:.1g}), but an elastic law has one curve for both: fit the loading alone"
    ),
    "runs_differ": (
        "the {runs} runs of the data (cycles or specimens) differ by up to {share:.1%} "
        "(p = {chance:.1g}): fit one of them at a time, or the last cycle alone"
    ),
    "outlier": (
        "{row} is an outlier: its residual is {off_kPa:+.3g} kPa at a measured value of "
        "{observed_kPa:.4g} kPa (p = {chance:.1g}); check this measurement, or leave it out"
    ),
    "constant_at_bound": (
        "the best fit of {name} is the bound that the law sets, {value}, so it has no confidence "
        "interval: try a law with fewer constants"
    ),
    "soft_fit": (
        "the fitted shear modulus is {modulus_Pa:.3g} Pa, which is softer than any ureter: check "
        "whether the {measured} was given in MPa instead of kPa"
    ),
    "stiff_fit": (
        "the fitted Young's modulus at rest is {modulus_MPa:.3g} MPa, which is stiffer than any "
        "soft tissue or rubber (the hardest rubber has about 45 MPa): check whether the {measured} "
        "was given in Pa instead of kPa"
    ),
    "beyond_sd": (
        "series and model disagree: with friction {friction:.3g} the typical residual is "
        "{typical:.2g} standard deviations and the largest {largest:.2g}, so the fitted numbers "
        "do not describe this series"
    ),
    "beyond_repeats": (
        "series and model disagree: the model deviates from the means of repeated points by "
        "{off_kPa:.2g} kPa, while repeated points scatter by only {scatter_kPa:.2g} kPa"
    ),
    "stiffness_excluded": (
        "the series does not agree with the stiffness of this material: the best fit has "
        "{stiffness:.3g} times that stiffness and friction {jointly:.3g}, so the friction "
        "{friction:.3g}, which was fitted with the material's own stiffness, cannot be used; "
        "measure the wall"
    ),
    "jointly_at_end": (
        "if stiffness is fitted too, the best fit of {name} is an end of the search range, "
        "{value:.3g}"
    ),
    "soft_law": (
        "the shear modulus of material '{material}' is {modulus_Pa:.3g} Pa, which is softer than "
        "any ureter: check whether its constants were given in kPa; they have to be in Pa "
        "(1 kPa = 1000 Pa)"
    ),
    "varies_along": (
        "material '{material}' varies along the tube (its energy depends on place.Z): the far "
        "field, the closure and the check of stability use its properties at Z = 0"
    ),
    "loose_points": (
        "{count} of {points} stones are no larger than the lumen and contain no information about "
        "the friction"
    ),
    "unanswered_points": "{count} of {points} points have no answer and are left out",
    "unanswered_at_fit": (
        "{count} points have no answer at the fitted friction and were left out of the fit"
    ),
    "no_friction_fits": (
        "no friction coefficient makes the model agree with the series: the best one is an end of "
        "the range that the model can answer"
    ),
    "too_few_for_stiffness": (
        "{points} points are too few to determine friction and stiffness together"
    ),
    "jointly_not_bounded": (
        "if stiffness is fitted too, the confidence interval of {name} is open on both sides"
    ),
    "jointly_bounded_on_one_side": (
        "if stiffness is fitted too, the confidence interval of {name} is open on one side"
    ),
    # --- assessments
    "friction_assumed": (
        "the friction coefficient is assumed to lie between 0.05 and 0.5: no measurement between a "
        "stone and a ureter is known; measured values of wet tissue are far below the 0.5 of the "
        "paper, which was estimated from the slopes of a dry crystal"
    ),
    "stiffness_assumed": (
        "the stiffness of the wall is assumed to be 1 ± 0.3 times that of the material: no "
        "published value of its variation between people is known"
    ),
    "diameters_without_load": (
        "the diameters of the ureter are used as those of the unloaded ureter, but images show the "
        "loaded ureter"
    ),
    "samples_beyond_range": (
        "in {fraction:.0%} of the samples the stone stretches the wall to more than {highest:g} "
        "times its circumference, but the constants of material '{material}' were used up to "
        "{highest:g} only"
    ),
    "samples_loose": (
        "in {fraction:.0%} of the samples the stone is no larger than the lumen and would not be "
        "held, although a stone that obstructs is held: the diameters are too uncertain, or "
        "something that is not in the model holds the stone"
    ),
    "samples_censored": (
        "in {fraction:.0%} of the samples only a lower bound of the critical pressure is known, "
        "because the stone or the friction is larger than the model can answer"
    ),
    "dilation_beyond_range": (
        "in {fraction:.0%} of the samples the dilated segment is more than {highest:g} times as "
        "wide as the ureter, but the constants of material '{material}' were used up to "
        "{highest:g} only: the present pressure is extrapolated, and it is too high if the wall "
        "has crept"
    ),
    "dilation_none": (
        "in {fraction:.0%} of the samples the dilated segment is no wider than the ureter, so its "
        "transmural pressure is taken as 0"
    ),
    "inputs_contradict": (
        "in {fraction} of the samples the present pressure exceeds the critical pressure, yet the "
        "stone has not moved: these inputs contradict one another, or something that is not in the "
        "model holds the stone"
    ),
    "impossible_walls": (
        "{fraction:.0%} of the random draws describe an impossible wall and were left out, because "
        "the diameters are too uncertain; the remaining samples vary less than the measurements do"
    ),
    "surface_error": (
        "the critical pressures of the samples are interpolated with errors of up to {error:.0%}"
    ),
    # --- sensitivity
    "cases_refused": (
        "{fraction:.1%} of the samples describe no case that can be solved and count as cases "
        "without an answer; the most frequent reason: {reason}"
    ),
    "cases_outside": (
        "{fraction:.1%} of the samples lie outside the range of the surrogate or of the sweep, so "
        "that their outcome is not known"
    ),
    "groups_dropped": (
        "{dropped} of {groups} groups of samples are left out of the sensitivity of {response}, "
        "which is unknown in a case of each of these groups; the stated sensitivity is that of the "
        "other groups"
    ),
    "groups_too_few": (
        "there is no sensitivity of {response}, which is unknown in a case of {dropped} of "
        "{groups} groups of samples"
    ),
    "bounds_in_rank": (
        "in {fraction:.1%} of the samples the critical pressure does not exist, and the rank uses "
        "a lower bound in its place"
    ),
    "indices_wide": (
        "the total indices of {response} are known to ± {width:.2f} only: use more samples"
    ),
    # --- surface images, continued
    "lost_points": (
        "lost points or spikes of the height map ({count} at {heights}) are treated as missing "
        "heights, because they are far from all heights around them"
    ),
    "gaps_bridged": (
        "{fraction:.1%} of the heights along the profiles are missing and were filled by straight "
        "lines of up to {length_um:.3g} µm; instruments lose steep slopes first, so the friction "
        "coefficient may be too low"
    ),
    "paths_moved": (
        "{moved} of {paths} profiles were moved to the nearest rows with few enough missing heights"
    ),
    "tilted": (
        "the surface is tilted by {tilt_deg:.2g}° in the image; with its least-squares plane "
        "subtracted (--level) the friction coefficient is {levelled:.3g}"
    ),
}


@dataclass(frozen=True)
class Caution:
    """A warning that belongs to a result.

    Attributes
    ----------
    code : str
        A key of `SENTENCES`; it stays the same when the sentence is reworded.
    values : tuple of (str, value)
        Numbers and names that are inserted into the sentence.
    """

    code: str
    values: tuple[tuple[str, Any], ...] = ()

    def __str__(self) -> str:
        """Return the sentence, without a period."""
        return SENTENCES[self.code].format(**dict(self.values))


def caution(code: str, **values: Any) -> Caution:
    """Return a caution.

    Raises
    ------
    KeyError
        The code has no sentence, or its sentence contains a value that is not given.
    """
    made = Caution(code, tuple(values.items()))
    str(made)
    return made
