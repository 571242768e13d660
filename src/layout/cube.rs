//! The cube as a layout, and places on it by central projection.

use super::{Layout, Place};
use glam::{DVec2, DVec3};

/// A face of the cube [-1,1]^3: the place (u,v) is at `normal + (2u - 1) along_u + (2v - 1) along_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubeFace {
    /// Outwards: `along_u` cross `along_v`.
    pub normal: DVec3,
    /// Direction of u.
    pub along_u: DVec3,
    /// Direction of v.
    pub along_v: DVec3,
}

/// The faces -x, x, -y, y, -z, z.
pub const CUBE_FACES: [CubeFace; 6] = [
    face(DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z),
    face(DVec3::X, DVec3::Y, DVec3::Z),
    face(DVec3::NEG_Y, DVec3::Z, DVec3::NEG_X),
    face(DVec3::Y, DVec3::Z, DVec3::X),
    face(DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y),
    face(DVec3::Z, DVec3::X, DVec3::Y),
];

const fn face(normal: DVec3, along_u: DVec3, along_v: DVec3) -> CubeFace {
    CubeFace { normal, along_u, along_v }
}

impl CubeFace {
    /// The place on the cube.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.normal + (2.0 * uv.x - 1.0) * self.along_u + (2.0 * uv.y - 1.0) * self.along_v
    }
}

/// The six faces; a corner has the number 4, 2, 1 for positive x, y, z added up.
pub(super) fn layout() -> Layout {
    let number = |p: DVec3| 4 * u32::from(p.x > 0.0) + 2 * u32::from(p.y > 0.0) + u32::from(p.z > 0.0);
    let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let quads = CUBE_FACES.map(|face| corners.map(|uv| number(face.point(uv))));
    Layout::new(&quads).expect("the faces of a cube make a layout")
}

/// Where the ray from the middle of the cube in this direction leaves it. The direction is not zero.
pub fn cube_place(direction: DVec3) -> Place {
    let size = direction.abs();
    let axis = if size.x >= size.y.max(size.z) {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let quad = 2 * axis + usize::from(direction[axis] > 0.0);
    let (face, on_cube) = (CUBE_FACES[quad], direction / size[axis]);
    let uv = 0.5 * (DVec2::new(on_cube.dot(face.along_u), on_cube.dot(face.along_v)) + DVec2::ONE);
    Place { quad: quad as u32, uv: uv.clamp(DVec2::ZERO, DVec2::ONE) }
}
