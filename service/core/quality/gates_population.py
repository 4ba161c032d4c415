"""The part of the identity gate that knows the SKU's other cameras: is this one of them, and of no other SKU?

From fifty units on a camera is compared with the population of its SKU revision, and with those of other SKUs
of the same lens and image size. Until then, and as the outermost bounds for ever, the start limits hold
(`gates_identity`): a population that drifts cannot widen beyond them. Two SKUs whose populations overlap
cannot be told apart by any picture, and then that is said. Not here: how a population is kept (`population`).
"""

from service.core.quality.evidence import Evidence, Expectation
from service.core.quality.gates import Measurement, check_limit, report_value
from service.core.quality.population import (
    NEEDED_UNITS,
    Distance,
    Population,
    distance_limit,
    expected_advantage,
    population_distance,
)
from service.core.quality.reasons import Reason
from service.core.vision.camera import parameter_names

GATE = "identity"


def measure_population(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements against populations; none where no population is kept."""
    expectation = evidence.expectation
    if expectation is None or expectation.population_units is None:
        return ()
    if expectation.population is None:
        return (_still_growing(expectation.population_units),)
    own = _distance(evidence, expectation.population)
    return (
        _own(evidence, own, expectation.population),
        *_others(evidence, own, expectation, expectation.population),
    )


def _distance(evidence: Evidence, population: Population) -> Distance:
    return population_distance(population, evidence.result.intrinsics.vector, evidence.result.covariance)


def _still_growing(units: int) -> Measurement:
    return report_value(
        GATE,
        "population_units",
        float(units),
        unit="units",
        advice=f"{units} of {NEEDED_UNITS} cameras of this SKU revision are known; until all are, its start "
        "limits hold.",
        facts={"count": units, "of": NEEDED_UNITS},
    )


def _own(evidence: Evidence, own: Distance, population: Population) -> Measurement:
    limit = distance_limit(evidence.limits.population_distance, own.dof)
    name = parameter_names(evidence.result.intrinsics.lens)[own.farthest]
    return check_limit(
        GATE,
        "population_distance",
        own.squared,
        "<=",
        limit,
        share=evidence.limits.share("population_distance"),
        good=f"This camera is like the {population.units} others of its SKU.",
        bad=f"This camera is unlike the {population.units} others of its SKU: {name} is "
        f"{own.farthest_sd:+.1f} standard deviations off, more than any other parameter.",
        remedy="Check that the camera is of this SKU and its lens sits right. If its parts have changed, add "
        "a revision of the SKU: its population starts anew.",
        facts={
            "units": population.units,
            "dof": own.dof,
            "parameter": name,
            "deviations": round(own.farthest_sd, 1),
        },
    )


def _others(
    evidence: Evidence, own: Distance, expectation: Expectation, population: Population
) -> tuple[Measurement, ...]:
    """Compare with the likeliest of the other SKUs; value: how much likelier, as −2 ln of the likelihoods."""
    others = expectation.other_populations
    advantages = {
        code: own.unlikeliness - _distance(evidence, one).unlikeliness for code, one in others.items()
    }
    if not advantages:
        return ()
    likeliest = max(advantages, key=lambda code: advantages[code])
    limit = evidence.limits.other_population
    apart = expected_advantage(population, others[likeliest], evidence.result.covariance)
    is_twin = apart < limit
    good = "The declared SKU explains this camera best."
    if is_twin:
        good = f"Cameras of SKU '{likeliest}' are so much like these that no picture tells them apart."
    return (
        check_limit(
            GATE,
            "other_population",
            advantages[likeliest],
            "<=",
            limit,
            share=1.0 if is_twin else evidence.limits.share("other_population"),
            good=good,
            bad=f"This camera is far likelier to be one of SKU '{likeliest}'.",
            remedy="Check which camera is built in, and open the run for its SKU.",
            reason=Reason.OTHER_POPULATION_TWIN if is_twin else Reason.OTHER_POPULATION,
            facts={"sku": likeliest},
        ),
    )
