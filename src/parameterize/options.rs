//! What can be chosen about a map.

use super::ParameterizeError;
use crate::options::with_fields;

/// Which weights an interior node gives its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Mean value coordinates: always positive, so no triangle flips over a convex border.
    #[default]
    MeanValue,
    /// Cotangents: the conformal map of a flat sheet. Obtuse angles make weights negative, and
    /// triangles may then flip (three on a mannequin's head); the report
    /// counts them.
    Harmonic,
}

/// Where the longest boundary loop goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Border {
    /// The one of circle, square by turns and square by arc with the least L2 stretch.
    #[default]
    Auto,
    /// The circle inscribed in the unit square, spaced by chord length.
    Circle,
    /// The unit square with corners at the four sharpest turns of the loop.
    SquareByTurns,
    /// The unit square with corners at each quarter of the loop's length.
    SquareByArc,
    /// The unit square with these nodes of the loop at (0,0), (1,0), (1,1), (0,1), in loop order.
    Corners([u32; 4]),
    /// No border at all: unrolled so that lengths are kept best. Refused if that folds or overlaps itself. As the
    /// answer of [`Border::Auto`] also the border of a height field seen from above.
    Free,
    /// All boundary nodes, those of holes too, keep the parameters given with the mesh.
    Kept,
}

/// How a mesh gets its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterizeOptions {
    /// Weights of the first map. Default: mean value.
    pub method: Method,
    /// Where the border goes. Default: auto.
    pub border: Border,
    /// Most stretch steps after the first map: 0 for none, `usize::MAX` until it stops improving.
    /// Default: until it stops improving.
    pub stretch_steps: usize,
    /// Sweeps that smooth the logarithm of the stretch before each step. Default 0.
    pub rings: usize,
    /// Outward bulge of a square's sides, in sides: keeps triangles between nodes of one side open.
    /// Default: [`ParameterizeOptions::DEFAULT_BULGE`]; at most 0.5.
    pub bulge: f64,
    /// Whether holes are closed by fans of triangles while the map is computed. Default: yes;
    /// without them a hole becomes a convex polygon and nodes with two neighbours collapse.
    pub fill_holes: bool,
    /// How far border nodes slide with the stretch, 0 (default) to 1. With [`Border::Auto`] a sliding
    /// circle is then one more candidate beside the three that do not slide.
    pub boundary_slide: f64,
    /// With [`Border::Auto`]: whether the best map is also unrolled with a free border, and that map taken if
    /// it neither folds nor overlaps itself and stretches less; and whether a height field that does not unroll
    /// gets the coordinates of its plane. Default: yes for tensor surfaces.
    pub unroll: bool,
}

impl Default for ParameterizeOptions {
    fn default() -> Self {
        Self::TENSOR
    }
}

impl ParameterizeOptions {
    /// Sagitta of a bulged side. Less than 1e-3 leaves ears so thin that the fit sees folds; more
    /// than 0.1 wastes domain outside the data.
    pub const DEFAULT_BULGE: f64 = 0.02;

    /// For tensor surfaces: least stretch, since their cells cannot adapt.
    pub const TENSOR: Self = Self {
        method: Method::MeanValue,
        border: Border::Auto,
        stretch_steps: usize::MAX,
        rings: 0,
        bulge: Self::DEFAULT_BULGE,
        fill_holes: true,
        boundary_slide: 0.0,
        unroll: true,
    };

    /// For PHT surfaces: one smoothed step, since quadtrees absorb scale but not anisotropy.
    pub const PHT: Self = Self { stretch_steps: 1, rings: 30, unroll: false, ..Self::TENSOR };

    /// The mean value map alone.
    pub const MEAN_VALUE: Self = Self { stretch_steps: 0, unroll: false, ..Self::TENSOR };

    /// The harmonic map alone.
    pub const HARMONIC: Self = Self { method: Method::Harmonic, ..Self::MEAN_VALUE };

    with_fields! {
        with_method method: Method,
        with_border border: Border,
        with_stretch_steps stretch_steps: usize,
        with_rings rings: usize,
        with_bulge bulge: f64,
        with_fill_holes fill_holes: bool,
        with_boundary_slide boundary_slide: f64,
        with_unroll unroll: bool,
    }

    pub(super) fn check(&self) -> Result<(), ParameterizeError> {
        let ranged =
            [("bulge", self.bulge, 0.5, "0 to 0.5"), ("boundary_slide", self.boundary_slide, 1.0, "0 to 1")];
        match ranged.iter().find(|(_, value, limit, _)| !(0.0..=*limit).contains(value)) {
            Some(&(name, value, _, allowed)) => Err(ParameterizeError::Option { name, value, allowed }),
            None => Ok(()),
        }
    }
}
