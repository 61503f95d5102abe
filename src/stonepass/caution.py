"""Warnings as data: a code and its values; the sentence is made where a person reads it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["SENTENCES", "Caution", "caution"]

# Every code, and its sentence without the period. Lengths are in inner radii.
SENTENCES = {
    # --- a case
    "wall_beyond_range": (
        "the stone stretches the wall to {stretch:.3g} times its circumference, but the constants "
        "of material '{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "lumen_below_range": (
        "the load shrinks the lumen to {lumen:.3g} times its width, but the constants of material "
        "'{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "ring_buckling": (
        "a confining pressure of {pressure_kPa:.3g} kPa would fold this tube where neither stone "
        "nor urine holds it open (ring buckling at about {buckling_kPa:.2g} kPa), which no "
        "axisymmetric model sees"
    ),
    "shape_deviation": (
        "the stone's shape follows its points to {deviation:.1%} of its radius only: the nearest "
        "smooth convex one is taken"
    ),
    "not_elliptic": (
        "the wall is not stable at R = {R:.3g}, Z = {Z:.3g} (inner radii): a shear band lowers its "
        "energy (stability margin {margin:.2g})"
    ),
    "hoop_compression": (
        "the wall is under hoop compression of {compression:.2g} times its shear modulus at "
        "R = {R:.3g}, Z = {Z:.3g} (inner radii): a real tube may fold, which no axisymmetric model "
        "sees"
    ),
    "microbuckling": (
        "the wall microbuckles at R = {R:.3g}, Z = {Z:.3g} (inner radii, downstream positive), "
        "where its axial fibres are compressed: it is solved with the energy that it has in the "
        "limit of fine buckles"
    ),
    "seated_imbalance": (
        "the axial forces on the tube miss their balance by {imbalance:.1%} of the contact force"
    ),
    "loaded_imbalance": (
        "the axial forces on tube and stone miss their balance by {imbalance:.1%}"
    ),
    "friction_cone": "friction exceeds its coefficient somewhere: Coulomb's law is violated",
    "error_not_estimated": "the error is not estimated: no coarser solve stands beside this one",
    "contact_angle_uncertain": (
        "the contact angle is known to {uncertainty_deg:.2f}° only, because no smooth contact edge "
        "was found"
    ),
    "closure_undecided": (
        "a coarser solve ends otherwise: whether the stone moves before the closure ends is within "
        "the discretisation error"
    ),
    "leak_undecided": (
        "a coarser solve ends otherwise: whether the stone moves before urine passes is within the "
        "discretisation error"
    ),
    "moves_at_contact_angle": (
        "the drive outweighs the resistance as soon as the stone is seated: the paper's closure "
        "starts wider than the narrowed lumen; the critical pressure is taken from the seated "
        "contact angle, and closure_start = 'lumen' is the alternative"
    ),
    "smaller_than_lumen": (
        "the stone is smaller than the unloaded lumen, where the paper's closure would narrow as "
        "the wall opens: it is kept at the stone's radius instead"
    ),
    "long_beam_contact": (
        "half the contact is {decay_lengths:.2g} decay lengths of the beam long, which takes the "
        "stone's push as a point load"
    ),
    "thick_beam": (
        "the wall is {thickness:.2g} inner radii thick and widened by {widening:.2g} of them, "
        "which the beam takes as small"
    ),
    "no_closed_answer": "{outcome} by Eq. 15: {message}",
    # --- surface images
    "single_path": "one path alone: how the friction varies over the surface is not known",
    "uneven_paths": "paths of up to {ratio:.2f} times the length of the shortest are cut",
    "friction_spread_missing": (
        "for some of the choices the slopes are too steep: no spread is given"
    ),
    "paths_too_short": "the paths are too short for some of the orders that the spread is over",
    "baseline_at_path_end": (
        "a baseline is steepest where it ceases to be looked at, near the ends of the paths: it "
        "may be steeper still; choose longer paths"
    ),
    "friction_beyond_range": "the friction coefficient lies above {largest:g}, which no case takes",
    "saturated_greys": (
        "{fraction:.0%} of the pixels have the darkest or brightest grey, where heights are cut off"
    ),
    "isolated_grey": (
        "no grey lies near the darkest or brightest: a scale bar or writing sets the scale of "
        "heights; cut it off with --area"
    ),
    "plain_rows": (
        "{fraction:.0%} of the rows have one grey at half of their pixels or more: a data bar, or "
        "a part that is missing; cut it off with --area"
    ),
    # --- laboratory
    "not_bounded": "the data do not bound {name}",
    "bounded_on_one_side": "the data bound {name} on one side only",
    "interval_by_curvature": (
        "intervals are by the curvature at the best fit: its profile could not be found"
    ),
    "no_interval": "no interval could be found: the fit is flat about its best constants",
    "residuals_grow": (
        "residuals grow with the stress, so that intervals are too narrow: fit with relative "
        "errors (--relative)"
    ),
    "lack_of_fit": (
        "the law misses the data systematically, by {off_kPa:.3g} kPa ({share:.1%} of the largest) "
        "about {at:.3g} times the size at rest: the intervals are too narrow, try another law or a "
        "smaller range"
    ),
    "residuals_correlated": (
        "neighbouring residuals are alike (correlation {alike:.2f}, p = {chance:.1g}): the law "
        "misses the data in waves, or errors go on from point to point, and the intervals are too "
        "narrow"
    ),
    "zero_offset": (
        "the data are met better with a zero offset of {offset_kPa:.3g} kPa in what was measured "
        "(p = {chance:.1g}): subtract what was read without load"
    ),
    "rest_size": (
        "the data are met better if every stretch is {part:+.2%} from what was given "
        "(p = {chance:.1g}), as with slack, a pre-stretch that was not told or a wrong size at "
        "rest: measure the size at rest where the load begins"
    ),
    "slack": (
        "the data are met better if the strip hangs loose up to a stretch of {stretch:.3g} "
        "(p = {chance:.1g}): take its length there as that at rest, and leave the rows before out"
    ),
    "axial_rest_length": (
        "the data are met better if the axial stretch is {part:+.2%} from what was given "
        "(p = {chance:.1g}): give the axial stretch in column axial_stretch"
    ),
    "hysteresis": (
        "loading and unloading differ by up to {share:.1%} of the largest (p = {chance:.1g}), but "
        "an elastic law has one curve for both: fit the loading alone"
    ),
    "runs_differ": (
        "the {runs} runs of the data, cycles or specimens, differ by up to {share:.1%} "
        "(p = {chance:.1g}): fit one at a time, or the last cycle alone"
    ),
    "outlier": (
        "{row} lies {off_kPa:+.3g} kPa off the law, at {observed_kPa:.4g} kPa (p = {chance:.1g}): "
        "check the measurement, or leave it out"
    ),
    "constant_at_bound": (
        "{name} lies at the end of what the law allows, {value}, so that it has no interval: the "
        "data ask for a simpler law"
    ),
    "soft_fit": (
        "the shear modulus is {modulus_Pa:.3g} Pa, softer than any wall: was the {measured} given "
        "in MPa instead of kPa"
    ),
    "beyond_sd": (
        "series and model do not agree: at friction {friction:.3g} residuals are {typical:.2g} "
        "standard deviations, up to {largest:.2g}, so that no number below describes this series"
    ),
    "beyond_repeats": (
        "series and model do not agree: the model misses the means of repeated points by "
        "{off_kPa:.2g} kPa, which scatter by {scatter_kPa:.2g} kPa only"
    ),
    "stiffness_excluded": (
        "the series excludes this wall's stiffness: it asks for {stiffness:.3g} times that, with "
        "friction {jointly:.3g}, so that friction {friction:.3g}, found with the wall's own "
        "stiffness, does not hold; measure the wall"
    ),
    "jointly_at_end": (
        "with the stiffness unknown, {name} ends where the search ends, at {value:.3g}"
    ),
    "soft_law": (
        "the shear modulus of material '{material}' is {modulus_Pa:.3g} Pa, softer than any wall: "
        "are its constants in kPa? They have to be in Pa, 1 kPa = 1000 Pa"
    ),
    "loose_points": (
        "{count} of {points} stones are no larger than the lumen and say nothing of friction"
    ),
    "unanswered_points": "{count} of {points} points have no answer and are left out",
    "unanswered_at_fit": (
        "{count} points have no answer at the friction that fits and were left out of the fit"
    ),
    "no_friction_fits": (
        "no friction makes this wall meet the series: the one that is nearest lies at the end of "
        "what the model answers"
    ),
    "too_few_for_stiffness": "{points} points are too few to tell stiffness from friction",
    "jointly_not_bounded": "the series does not bound {name} when stiffness is fitted too",
    "jointly_bounded_on_one_side": (
        "the series does not bound {name} on one side when stiffness is fitted too"
    ),
    # --- assessments
    "friction_assumed": (
        "friction is taken from 0.05 to 0.5: nobody has measured it between a stone and a "
        "ureter; wet tissue lies far below the paper's 0.5, which is estimated from a dry "
        "crystal's slopes"
    ),
    "stiffness_assumed": (
        "the wall's stiffness is taken to be 1 ± 0.3 times the material's: how much people "
        "differ is not published"
    ),
    "diameters_without_load": (
        "diameters of the ureter are taken as those without load, but imaging shows them under it"
    ),
    "samples_beyond_range": (
        "in {fraction:.0%} of the samples the stone stretches the wall beyond {highest:g} times "
        "its circumference, but the constants of material '{material}' were used up to "
        "{highest:g} only"
    ),
    "samples_loose": (
        "in {fraction:.0%} of the samples the stone is no larger than the lumen; one that "
        "obstructs is held, so these say that the sizes are known too badly, or that something "
        "else holds it"
    ),
    "samples_censored": (
        "in {fraction:.0%} of the samples only a lower bound of the critical pressure is known: "
        "the stone is larger, or the friction higher, than the model answers"
    ),
    "dilation_beyond_range": (
        "in {fraction:.0%} of the samples the dilated segment is wider than {highest:g} times "
        "the ureter, but the constants of material '{material}' were used up to {highest:g} only: "
        "the present pressure is extrapolated, and a wall that has crept makes it too high"
    ),
    "dilation_none": (
        "in {fraction:.0%} of the samples the dilated segment is no wider than the ureter; its "
        "transmural pressure counts as 0"
    ),
    "inputs_contradict": (
        "in {fraction} of the samples the present pressure exceeds the critical one although the "
        "stone is there: these inputs contradict one another, or what holds the stone is not in "
        "the model"
    ),
    "impossible_walls": (
        "{fraction:.0%} of the draws describe no possible wall and were left out: the diameters "
        "are known too badly, and what is left is narrower than they say"
    ),
    "surface_error": "the response surface is off by up to {error:.0%}",
    # --- surface images, continued
    "gaps_bridged": (
        "{fraction:.1%} of the heights along the paths are missing; straight lines bridge the "
        "gaps, of up to {length_um:.3g} µm: instruments miss steep flanks first, so that the "
        "friction coefficient may be too low"
    ),
    "paths_moved": (
        "{moved} of {paths} paths are moved to the nearest rows whose missing heights can be "
        "bridged"
    ),
    "tilted": (
        "the surface is tilted by {tilt_deg:.1f}° against the picture: with its least-squares "
        "plane subtracted (--level) the friction coefficient is {levelled:.3f}"
    ),
}


@dataclass(frozen=True)
class Caution:
    """A warning that belongs to a result.

    Attributes
    ----------
    code : str
        One of `SENTENCES`; it stays the same when the sentence is reworded.
    values : tuple of (str, value)
        The numbers and names that the sentence contains.
    """

    code: str
    values: tuple[tuple[str, Any], ...] = ()

    def __str__(self) -> str:
        """The sentence, without a period."""
        return SENTENCES[self.code].format(**dict(self.values))


def caution(code: str, **values: Any) -> Caution:
    """Make a caution; a code without a sentence, or with other values than it says, is a fault."""
    made = Caution(code, tuple(values.items()))
    str(made)
    return made
