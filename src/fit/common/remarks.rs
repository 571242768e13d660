//! Things worth knowing about a fit, as bits and in words.

/// Things worth knowing about a fit; several may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Remarks(pub u64);

impl Remarks {
    /// The surface misses the tolerance.
    pub const TOLERANCE_NOT_MET: Self = Self(1);
    /// The fit ended because refinement no longer lowered the error.
    pub const STAGNATED: Self = Self(1 << 1);
    /// Some parameter triangles are reversed or flat: the surface may fold there.
    pub const FOLDED_PARAMETERS: Self = Self(1 << 2);
    /// The mesh had no parameters and was parameterized first.
    pub const PARAMETERIZED: Self = Self(1 << 3);
    /// Given parameters were uneven and have been regularized.
    pub const REGULARIZED: Self = Self(1 << 4);
    /// The tolerance was below what double precision can keep and was raised.
    pub const TOLERANCE_RAISED: Self = Self(1 << 5);
    /// Some cells hold no data; the surface is extrapolated there.
    pub const EMPTY_CELLS: Self = Self(1 << 6);
    /// Between the nodes the surface departs from the facets by more than the tolerance and what the facets explain.
    pub const ROUGH_BETWEEN_NODES: Self = Self(1 << 7);
    /// The map is so compressed that one patch is the wrong tool: cut the mesh into charts, or use a
    /// PHT-spline.
    pub const SEGMENTATION_ADVISED: Self = Self(1 << 8);
    /// The data do not determine the beam energy's null space; the plate energy was used instead.
    pub const PLATE_ENERGY_USED: Self = Self(1 << 9);
    /// Triangles of the mesh or of the finished model cross each other.
    pub const SELF_INTERSECTING: Self = Self(1 << 10);

    /// Points that lay on the one before them in their row have been merged with it.
    pub const MERGED_POINTS: Self = Self(1 << 20);
    /// A row looks reversed or shifted against the one before it.
    pub const TWISTED_ROWS: Self = Self(1 << 21);
    /// Some rows are much nearer to one another than to the next: control curves overshoot.
    pub const CLUSTERED_ROWS: Self = Self(1 << 22);
    /// The end points of rows lie too near to those of the next to say how far apart rows are; mean distances do.
    pub const MEAN_STEPS: Self = Self(1 << 23);

    /// Adds `other` when `holds`.
    pub fn add_if(&mut self, holds: bool, other: Self) {
        if holds {
            self.0 |= other.0;
        }
    }

    /// Takes `other` out.
    pub fn remove(&mut self, other: Self) {
        self.0 &= !other.0;
    }

    /// Whether all bits of `other` hold.
    pub fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// What holds in words, the gravest first; of rows nothing, for those remarks have numbers of their own to tell.
    pub fn words(self) -> impl Iterator<Item = &'static RemarkWords> {
        WORDS.iter().filter(move |words| self.has(words.remark))
    }
}

/// A remark in words: parts of sentences, lower case and without a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RemarkWords {
    /// Which one.
    pub remark: Remarks,
    /// What holds.
    pub what: &'static str,
    /// What to do about it.
    pub advice: &'static str,
}

const WORDS: [RemarkWords; 11] = [
    RemarkWords {
        remark: Remarks::TOLERANCE_NOT_MET,
        what: "the tolerance is missed",
        advice: "allow more control points, take another family, or loosen it if the worst place is noise",
    },
    RemarkWords {
        remark: Remarks::STAGNATED,
        what: "refining no longer helped",
        advice: "look at the data, which contradict each other at this scale: noise, a sharp edge, or doubled layers",
    },
    RemarkWords {
        remark: Remarks::ROUGH_BETWEEN_NODES,
        what: "between the nodes the surface leaves the facets by more than the tolerance",
        advice: "where it swings smooth more, at sharp edges take a model or a family that keeps them",
    },
    RemarkWords {
        remark: Remarks::FOLDED_PARAMETERS,
        what: "the map folds, and the surface may overlap itself",
        advice: "let the library make the parameters, or fit a model of several patches",
    },
    RemarkWords {
        remark: Remarks::SEGMENTATION_ADVISED,
        what: "one chart stretches this shape too much",
        advice: "fit a model of several patches, or cut the mesh",
    },
    RemarkWords {
        remark: Remarks::SELF_INTERSECTING,
        what: "triangles of the mesh or of the model cross",
        advice: "repair the mesh there, or tighten the tolerance, below half of the thinnest wall at least",
    },
    RemarkWords {
        remark: Remarks::EMPTY_CELLS,
        what: "some cells inside the boundary hold no nodes",
        advice: "fill holes of the mesh",
    },
    RemarkWords {
        remark: Remarks::TOLERANCE_RAISED,
        what: "the tolerance was below rounding and has been raised",
        advice: "ask for a looser one",
    },
    RemarkWords {
        remark: Remarks::PARAMETERIZED,
        what: "the mesh had no parameters and was parameterized",
        advice: "nothing needs to be done",
    },
    RemarkWords {
        remark: Remarks::REGULARIZED,
        what: "the given parameters were uneven and have been regularized",
        advice: "nothing needs to be done",
    },
    RemarkWords {
        remark: Remarks::PLATE_ENERGY_USED,
        what: "the plate energy was used, as the beam energy leaves the data free",
        advice: "nothing needs to be done",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remarks_are_told_once_each_and_only_if_they_hold() {
        for (at, words) in WORDS.iter().enumerate() {
            assert_eq!(words.remark.0.count_ones(), 1, "{words:?}");
            assert_eq!(words.remark.words().collect::<Vec<_>>(), [&WORDS[at]]);
        }
        assert_eq!(Remarks::default().words().count(), 0);
        assert_eq!(Remarks(u64::MAX).words().count(), WORDS.len());
    }
}
