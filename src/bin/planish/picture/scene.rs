//! Pictures of surfaces in space: shaded or coloured by deviation, with knot lines, trims and control net; or of
//! their parameter planes.

use super::raster::{Picture, View};
use glam::{DVec2, DVec3};
use planish::control::Pool;
use planish::error::Error;
use planish::export::vtk::on_surface;
use planish::mesh::Mesh;
use planish::model::{FaceId, Model};
use planish::query::deviation::{DeviationOptions, deviation};
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::surface::Surface;

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
    /// Whether the parameter plane is drawn instead of the surface, stretched to a square, without control net.
    pub plane: bool,
    /// Whether knot lines are drawn, or the edges of a T-mesh.
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
            plane: false,
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
    let scene = Scene { surface, is_plane: options.plane };
    let (mesh, distances) = scene.shape(options.deviation_from, pool)?;
    let front = || if options.plane { View::from([0.0, 0.0, 1.0]) } else { View::facing(&mesh) };
    let view = options.view.unwrap_or_else(front);
    let mut picture = Picture::new(options.width, options.height, &view, &mesh);
    let range = (0.0, distances.iter().flatten().copied().fold(0.0, f64::max));
    picture.draw_mesh(&mesh, distances.as_deref(), range);
    if options.knot_lines {
        surface.knot_lines().into_iter().for_each(|[from, to]| scene.draw_side(from, to, &mut picture));
    }
    if options.trims {
        scene.draw_trims(&mut picture);
    }
    if options.control_net && !options.plane {
        draw_control_net(surface, &mut picture);
    }
    if distances.is_some() {
        picture.draw_scale("deviation", range);
    }
    Ok(picture)
}

/// Draws a model: its faces, or a mesh moved on to it; its edges where knot lines are asked for, free ones where trims
/// are.
pub fn render_model(model: &Model, options: &RenderOptions, pool: &Pool) -> Result<Picture, Error> {
    let tessellation = model.tessellate(&TessellateOptions::default())?;
    let (mesh, distances) = match options.deviation_from {
        None => (tessellation.mesh.clone(), None),
        Some(mesh) => {
            let report = model.deviation(mesh, &DeviationOptions::default(), pool)?;
            let feet = report.faces.iter().zip(&report.uv);
            let place = |(face, &uv): (&Option<FaceId>, &DVec2)| {
                face.map_or(DVec3::ZERO, |face| model.carrier(face).points(&[uv])[0])
            };
            let moved = Mesh::new(feet.map(place).collect(), mesh.triangles().to_vec())?;
            (moved, Some(report.nodes.each))
        }
    };
    let view = options.view.unwrap_or_else(|| View::facing(&mesh));
    let mut picture = Picture::new(options.width, options.height, &view, &mesh);
    let range = (0.0, distances.iter().flatten().copied().fold(0.0, f64::max));
    picture.draw_mesh(&mesh, distances.as_deref(), range);
    for (edge, nodes) in model.edge_ids().zip(&tessellation.edges) {
        let line: Vec<DVec3> = nodes.iter().map(|&node| tessellation.mesh.points()[node as usize]).collect();
        if options.knot_lines {
            picture.draw_line(&line, KNOT_INK);
        }
        if options.trims && model.is_free(edge) {
            picture.draw_line(&line, TRIM_INK);
        }
    }
    if distances.is_some() {
        picture.draw_scale("deviation", range);
    }
    Ok(picture)
}

/// A surface where it lies, or its parameter plane.
struct Scene<'a> {
    surface: &'a dyn Surface,
    is_plane: bool,
}

impl Scene<'_> {
    /// The triangles to draw, and the distances at their nodes.
    fn shape(&self, deviation_from: Option<&Mesh>, pool: &Pool) -> Result<(Mesh, Option<Vec<f64>>), Error> {
        let (mesh, distances) = match deviation_from {
            None => (tessellate(self.surface, &TessellateOptions::default())?.mesh, None),
            Some(mesh) => {
                let report = deviation(self.surface, mesh, &DeviationOptions::default(), pool)?;
                (on_surface(self.surface, mesh, &report.uv)?, Some(report.nodes.each))
            }
        };
        match mesh.parameters() {
            Some(uv) if self.is_plane => {
                Ok((Mesh::new(self.places(uv), mesh.triangles().to_vec())?, distances))
            }
            _ => Ok((mesh, distances)),
        }
    }

    /// Where parameters are drawn.
    fn places(&self, uv: &[DVec2]) -> Vec<DVec3> {
        if self.is_plane {
            let domain = self.surface.domain();
            return uv.iter().map(|&uv| ((uv - domain.min) / domain.size()).extend(0.0)).collect();
        }
        let mut rows = vec![0.0; 3 * uv.len()];
        self.surface.eval_rows(uv, 0, &mut rows);
        rows.chunks_exact(3).map(DVec3::from_slice).collect()
    }

    /// The part of a straight line between parameters that lies inside the trims.
    fn draw_side(&self, from: DVec2, to: DVec2, picture: &mut Picture) {
        let uv: Vec<DVec2> = (0..=PIECES).map(|k| from.lerp(to, k as f64 / PIECES as f64)).collect();
        let points = self.places(&uv);
        let trims = &self.surface.region().trims;
        for (uv, points) in uv.windows(2).zip(points.windows(2)) {
            if trims.contains(uv[0].midpoint(uv[1])) {
                picture.draw_line(points, KNOT_INK);
            }
        }
    }

    fn draw_trims(&self, picture: &mut Picture) {
        for (from, to) in self.surface.region().trims.segments() {
            picture.draw_line(&self.places(&[from, from.midpoint(to), to]), TRIM_INK);
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use planish::Control;
    use planish::fit::tensor::{Knots, TensorOptions, fit_mesh};
    use planish::samples;

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
        let uniform = TensorOptions::default().with_knots(Knots::Uniform); // many lines
        let surface = fit_mesh(&mesh, &uniform, &mut control).unwrap().surface;
        let small = RenderOptions { width: 400, height: 300, ..RenderOptions::default() };
        let draw = |options: &RenderOptions| render(&surface, options, control.pool()).unwrap();
        let plain = draw(&small);
        for (options, ink) in [
            (RenderOptions { trims: true, ..small }, TRIM_INK),
            (RenderOptions { control_net: true, ..small }, NET_INK),
            (RenderOptions { knot_lines: true, ..small }, KNOT_INK),
            (RenderOptions { plane: true, knot_lines: true, ..small }, KNOT_INK),
        ] {
            assert!(count(&draw(&options), ink) > count(&plain, ink) + 100, "{options:?}");
        }
        // the scale's red end is nowhere in a plain picture
        let red = [0.85, 0.22, 0.12];
        let colored = draw(&RenderOptions { deviation_from: Some(&mesh), ..small });
        assert!(count(&colored, red) > 50 && count(&plain, red) == 0);
    }
}
