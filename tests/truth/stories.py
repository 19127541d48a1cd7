"""What is told of the cases that serve as data sets to practise on, before and after the seal is opened."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Mystery:
    """A case as it is told.

    Attributes:
        id: of the data set; says nothing of the answer.
        case, seed: which case.
        told: per hidden effect (the unknown one last) its name and what it does.
        text: what is said when the seal is opened.
    """

    id: str
    title: str
    story: str
    case: str
    told: tuple[tuple[str, str], ...]
    text: str
    seed: int = 0


MYSTERIES = (
    Mystery(
        "weaker-than-drawn",
        "Weaker than drawn",
        "A new sample was pulled slowly to and fro on the tensile tester at five pressures. Bore, braid and "
        "angle are those of the drawing, and yet it pulls less than the ideal formula says. At the lowest "
        "pressure it loses a large share of its force, at the highest a few percent.",
        "bladder-yeoh-isobaric",
        (
            (
                "Rubber of the wall",
                "The wall is stretched around and pressed along as the muscle shortens; it pushes back "
                "with a force that depends on the contraction and not on the pressure.",
            ),
        ),
        "The rubber follows a Yeoh law, not the Mooney-Rivlin law of the catalogue; on one sweep the two "
        "look alike, and either explains the measurement down to its noise.",
        seed=1,
    ),
    Mystery(
        "after-the-service",
        "After the service",
        "The tester came back from its yearly service on Monday and this muscle was the first one on it. "
        "Last week the ideal model fitted a sister sample well. Now the curves lie beside the model at "
        "every pressure, and most where they are steep.",
        "length-zero-isobaric",
        (
            (
                "Zero of the length scale",
                "The carriage was put back with its scale shifted: every length is read too long or too "
                "short by the same amount.",
            ),
        ),
        "Nothing is wrong with the muscle. An error that follows the slope of the curves, and so grows with "
        "pressure, is a shift along the length axis; zero the scale before fitting any material.",
        seed=1,
    ),
    Mystery(
        "two-lines-per-pressure",
        "Two lines per pressure",
        "Quasi-static loops at five pressures and two speeds on a muscle from stock. The test engineer "
        "reports that the return curve never meets the forward curve, at any speed, and that the "
        "middle line is off as well.",
        "pair-bladder-coulomb-isobaric",
        (
            (
                "Rubber of the wall",
                "A restoring force over the contraction, the same at every pressure and in both directions.",
            ),
            (
                "Dry friction",
                "A force against the motion that is the same at both speeds; it turns over within a "
                "fraction of a millimetre after each reversal.",
            ),
        ),
        "The middle line of the loops gives the elastic part, their half width the friction. Two speeds "
        "and the same width: no damping.",
        seed=2,
    ),
    Mystery(
        "three-at-once",
        "Three at once",
        "An old muscle from a test rig that was taken apart, measured at five pressures and two speeds "
        "before it is used again. The curves are too low, they do not meet where they should, and they are "
        "loops. How much of that can be told apart from one afternoon on the tester?",
        "triple-bladder-prestress-coulomb-isobaric",
        (
            (
                "Rubber of the wall",
                "A restoring force over the contraction, the same at every pressure.",
            ),
            (
                "A wall that was built in compressed",
                "A nearly constant push along the axis; a force sensor with a wrong zero looks the same.",
            ),
            (
                "Dry friction",
                "A force against the motion, independent of the speed.",
            ),
        ),
        "The constant part may be called prestress or force offset: only a reading of the sensor without the "
        "muscle tells them apart.",
        seed=1,
    ),
    Mystery(
        "much-ado",
        "The complaint",
        "A customer sent this record with the remark that the model is useless: the residual is up to "
        "several newtons and never zero. Loops at five pressures, a decent bench, the data sheet geometry. "
        "What will you answer?",
        "nothing-isobaric",
        (),
        "The ideal model is right down to the noise of the sensors, and an effect added here would fit "
        "noise. To say so is the right answer.",
        seed=1,
    ),
    Mystery(
        "the-dip",
        "The bump at one stroke",
        "A force map over pressure and contraction for a muscle in a clamping device; the rubber of its wall "
        "was identified before and is part of the start model. Around one position of the carriage the force "
        "is off, the same at every pressure. The bench was not moved.",
        "unknown-magnet-map",
        (
            (
                "A latch magnet on the carriage",
                "A pull about 9 % contraction, a few percent wide, that does not depend on the pressure. No "
                "catalogue of muscle effects has it; a term of your own over the contraction describes it.",
            ),
        ),
        "An effect that nobody has catalogued: the honest verdict is that something is missing, where it "
        "acts and how large it is. Looking at the bench finds the magnet.",
        seed=2,
    ),
    Mystery(
        "slow-to-let-go",
        "Slow to let go",
        "A muscle lifts a hanging load; a five-way valve fills and vents it through equal ports, and the "
        "model knows valve, load and damping. The lift looks right, but the load comes down later than it "
        "should, and on the machine nobody has touched the valve for years.",
        "silencer-steps",
        (
            (
                "Clogged silencer",
                "A second throttle behind the valve on the exhaust side, with a small volume between them; "
                "filling is not concerned.",
            ),
        ),
        "Only venting is slow, so whatever works in both directions (flow factor, dead volume, delay) is "
        "out.",
        seed=2,
    ),
    Mystery(
        "the-calm-load",
        "The load that should swing",
        "Pressure and stroke of a hanging load were recorded while the operator played with the valve; the "
        "command was not recorded. With the measured pressure as input the ideal model lets the load swing "
        "after every step for a long time. The real one does not.",
        "drag-driven",
        (
            (
                "Damping of the muscle",
                "A force against the speed, a little less than proportional to it, growing with the pressure "
                "and weaker on lengthening.",
            ),
        ),
        "The catalogue's linear damping comes close; the power 0.8 of the speed and the dependence on "
        "pressure are details that this record shows only weakly.",
        seed=2,
    ),
)
