//! Pictures of surfaces in space: shaded or coloured by deviation, with knot lines, trims and control net.

use super::picture::{Picture, View};
use super::vtk::on_surface;
use crate::control::Pool;
use crate::error::Error;
use crate::mesh::Mesh;
use crate::query::deviation::{DeviationOptions, deviation};
use crate::query::tessellate::{TessellateOptions, tessellate};
use crate::surface::Surface;
use glam::{DVec2, DVec3};

/// What a picture shows.
#[derive(Debug, Clone, Copy)]
pub struct RenderOptions<'a> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// From where; None looks at the front of the shape, a little from aside.
    pub view: Option<View>,
    /// A mesh to compare with: its triangles are drawn on the surface, coloured by the distance of their nodes.
    pub deviation_from: Option<&'a Mesh>,
    /// Whether the borders of the patches are drawn: knot lines, or the edges of a T-mesh.
    pub knot_lines: bool,
    /// Whether the trims are drawn.
    pub trims: bool,
    /// Whether the control points and the lines between them are drawn.
    pub control_net: bool,
}

impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self {
            width: 1200,
            height: 900,
            view: None,
            deviation_from: None,
            knot_lines: false,
            trims: false,
            control_net: false,
        }
    }
}

const KNOT_INK: [f64; 3] = [0.25, 0.30, 0.38];
const TRIM_INK: [f64; 3] = [0.80, 0.10, 0.10];
const NET_INK: [f64; 3] = [0.10, 0.35, 0.15];

/// Pieces of the side of a patch: fine enough that what sticks out of a trim is hardly seen.
const PIECES: usize = 32;

/// Draws the part of a surface inside its trims.
pub fn render(surface: &dyn Surface, options: &RenderOptions, pool: &Pool) -> Result<Picture, Error> {
    let (mesh, distances) = shape(surface, options.deviation_from, pool)?;
    let view = options.view.unwrap_or_else(|| View::facing(&mesh));
    let mut picture = Picture::new(options.width, options.height, &view, &mesh);
    let range = (0.0, distances.iter().flatten().copied().fold(0.0, f64::max));
    picture.draw_mesh(&mesh, distances.as_deref(), range);
    if options.knot_lines {
        draw_knot_lines(surface, &mut picture);
    }
    if options.trims {
        draw_trims(surface, &mut picture);
    }
    if options.control_net {
        draw_control_net(surface, &mut picture);
    }
    if distances.is_some() {
        picture.draw_scale("deviation", range);
    }
    Ok(picture)
}

/// The triangles to draw, and the distances at their nodes.
fn shape(
    surface: &dyn Surface,
    deviation_from: Option<&Mesh>,
    pool: &Pool,
) -> Result<(Mesh, Option<Vec<f64>>), Error> {
    let Some(mesh) = deviation_from else {
        return Ok((tessellate(surface, &TessellateOptions::default())?.mesh, None));
    };
    let report = deviation(surface, mesh, &DeviationOptions::default(), pool)?;
    Ok((on_surface(surface, mesh, &report.uv)?, Some(report.nodes.each)))
}

/// The lower sides of all patches, and the upper ones at the end of the domain.
fn draw_knot_lines(surface: &dyn Surface, picture: &mut Picture) {
    let Some(patches) = surface.patches() else {
        return draw_faces(surface, picture);
    };
    let end = surface.domain().max;
    for index in 0..patches.patch_count() {
        let part = patches.patch(index).domain;
        let (lower_right, upper_left) =
            (DVec2::new(part.max.x, part.min.y), DVec2::new(part.min.x, part.max.y));
        draw_side(surface, part.min, lower_right, picture);
        draw_side(surface, part.min, upper_left, picture);
        if part.max.x == end.x {
            draw_side(surface, lower_right, part.max, picture);
        }
        if part.max.y == end.y {
            draw_side(surface, upper_left, part.max, picture);
        }
    }
}

/// The sides of the faces over which a surface without patches is made.
fn draw_faces(surface: &dyn Surface, picture: &mut Picture) {
    let Some(faces) = surface.faces() else {
        return;
    };
    let ends = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
    let mut sides: Vec<[u32; 2]> = faces.triangles().into_iter().flat_map(ends).collect();
    sides.sort_unstable();
    sides.dedup();
    for side in sides {
        let [from, to] = side.map(|corner| faces.places()[corner as usize]);
        draw_side(surface, from, to, picture);
    }
}

/// The part of a straight line between parameters that lies inside the trims.
fn draw_side(surface: &dyn Surface, from: DVec2, to: DVec2, picture: &mut Picture) {
    let uv: Vec<DVec2> = (0..=PIECES).map(|k| from.lerp(to, k as f64 / PIECES as f64)).collect();
    let points = places(surface, &uv);
    let trims = &surface.region().trims;
    for (uv, points) in uv.windows(2).zip(points.windows(2)) {
        if trims.contains(uv[0].midpoint(uv[1])) {
            picture.draw_line(points, KNOT_INK);
        }
    }
}

fn draw_trims(surface: &dyn Surface, picture: &mut Picture) {
    for (from, to) in surface.region().trims.segments() {
        picture.draw_line(&places(surface, &[from, from.midpoint(to), to]), TRIM_INK);
    }
}

fn draw_control_net(surface: &dyn Surface, picture: &mut Picture) {
    let Some(net) = surface.control_net() else {
        return;
    };
    for line in &net.lines {
        let points: Vec<DVec3> = line.iter().map(|&point| net.points[point as usize]).collect();
        picture.draw_line(&points, NET_INK);
    }
    net.points.iter().for_each(|&point| picture.draw_dot(point, NET_INK));
}

fn places(surface: &dyn Surface, uv: &[DVec2]) -> Vec<DVec3> {
    let mut rows = vec![0.0; 3 * uv.len()];
    surface.eval_rows(uv, 0, &mut rows);
    rows.chunks_exact(3).map(DVec3::from_slice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Control;
    use crate::fit::tessellation::{TensorOptions, fit_mesh};
    use crate::samples;

    /// How many pixels are nearly of a colour.
    fn count(picture: &Picture, ink: [f64; 3]) -> usize {
        let (_, _, pixels) = picture.finish();
        let near = |pixel: &[u8]| (0..3).all(|k| (f64::from(pixel[k]) - 255.0 * ink[k]).abs() < 30.0);
        pixels.chunks_exact(3).filter(|pixel| near(pixel)).count()
    }

    #[test]
    fn each_part_is_drawn_when_asked_for_and_only_then() {
        let mesh = samples::fuselage_panel(1).unwrap();
        let mut control = Control::new(1);
        let surface = fit_mesh(&mesh, &TensorOptions::default(), &mut control).unwrap().surface;
        let small = RenderOptions { width: 400, height: 300, ..RenderOptions::default() };
        let draw = |options: &RenderOptions| render(&surface, options, control.pool()).unwrap();
        let plain = draw(&small);
        for (options, ink) in [
            (RenderOptions { trims: true, ..small }, TRIM_INK),
            (RenderOptions { control_net: true, ..small }, NET_INK),
            (RenderOptions { knot_lines: true, ..small }, KNOT_INK),
        ] {
            assert!(count(&draw(&options), ink) > count(&plain, ink) + 100, "{options:?}");
        }
        // the scale's red end is nowhere in a plain picture
        let red = [0.85, 0.22, 0.12];
        let colored = draw(&RenderOptions { deviation_from: Some(&mesh), ..small });
        assert!(count(&colored, red) > 50 && count(&plain, red) == 0);
    }
}
