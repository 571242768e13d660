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
use planish::surface::{Domain, Surface, normal};

/// What a picture shows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RenderOptions<'a> {
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
    /// Whether the surface is striped by equal brightness instead of coloured.
    pub isophotes: bool,
    /// Whether curvature stands on lines of the surface as combs.
    pub combs: bool,
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
            isophotes: false,
            combs: false,
            control_net: false,
        }
    }
}

const KNOT_INK: [f64; 3] = [0.25, 0.30, 0.38];
const TRIM_INK: [f64; 3] = [0.80, 0.10, 0.10];
/// Stripes for each unit of the cosine.
const STRIPES: f64 = 24.0;
/// Longest side of a triangle under stripes, as a share of the shape's size.
const FINE: f64 = 4e-3;
const COMB_INK: [f64; 3] = [0.20, 0.25, 0.60];
/// Lines of combs in each direction, the teeth of one, and the length of the longest tooth.
const COMB_LINES: usize = 3;
const COMB_TEETH: usize = 240;
const COMB_SHARE: f64 = 0.12;
const NET_INK: [f64; 3] = [0.10, 0.35, 0.15];

/// Pieces of the side of a patch: fine enough that what sticks out of a trim is hardly seen.
const PIECES: usize = 32;

/// Draws the part of a surface inside its trims.
pub(crate) fn render(surface: &dyn Surface, options: &RenderOptions, pool: &Pool) -> Result<Picture, Error> {
    let scene = Scene { surface, is_plane: options.plane };
    let (mesh, distances) = scene.shape(options, pool)?;
    let front = || if options.plane { View::from([0.0, 0.0, 1.0]) } else { View::facing(&mesh) };
    let view = options.view.unwrap_or_else(front);
    let mut picture = Picture::new(options.width, options.height, &view, &mesh);
    let range = (0.0, distances.iter().flatten().copied().fold(0.0, f64::max));
    match options.isophotes {
        true => picture.draw_stripes(&mesh, &scene.brightness(&mesh, picture.light())),
        false => picture.draw_mesh(&mesh, distances.as_deref(), range),
    }
    if options.combs && !options.plane {
        scene.draw_combs(&mesh, &mut picture);
    }
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
pub(crate) fn render_model(model: &Model, options: &RenderOptions, pool: &Pool) -> Result<Picture, Error> {
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

/// Draws the facets of a mesh; their edges where knot lines are asked for, the border where trims are.
pub(crate) fn render_mesh(mesh: &Mesh, options: &RenderOptions) -> Picture {
    let view = options.view.unwrap_or_else(|| View::facing(mesh));
    let mut picture = Picture::new(options.width, options.height, &view, mesh);
    picture.draw_mesh(mesh, None, (0.0, 0.0));
    let place = |node: u32| mesh.points()[node as usize];
    if options.knot_lines {
        for &[a, b, c] in mesh.triangles() {
            picture.draw_line(&[place(a), place(b), place(c), place(a)], KNOT_INK);
        }
    }
    if options.trims {
        mesh.boundary_edges().for_each(|edge| picture.draw_line(&edge.map(place), TRIM_INK));
    }
    picture
}

/// A surface where it lies, or its parameter plane.
struct Scene<'a> {
    surface: &'a dyn Surface,
    is_plane: bool,
}

impl Scene<'_> {
    /// The triangles to draw, and the distances at their nodes.
    fn shape(&self, options: &RenderOptions, pool: &Pool) -> Result<(Mesh, Option<Vec<f64>>), Error> {
        let (mesh, distances) = match options.deviation_from {
            None => {
                let plain = tessellate(self.surface, &TessellateOptions::default())?.mesh;
                let max_edge_length = if options.isophotes { FINE * plain.diagonal() } else { 0.0 };
                let fine = TessellateOptions { max_edge_length, ..TessellateOptions::default() };
                (if options.isophotes { tessellate(self.surface, &fine)?.mesh } else { plain }, None)
            }
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

    /// Stripes of equal brightness under a light: the cosine of the angle to it, in stripes.
    fn brightness(&self, mesh: &Mesh, light: DVec3) -> Vec<f64> {
        let derivatives = self.derivatives(mesh.parameters().unwrap_or_default());
        let stripe = |row: &[DVec3; 6]| STRIPES * normal(row[1], row[2]).dot(light);
        derivatives.iter().map(stripe).map(|x| if x.is_nan() { 0.0 } else { x }).collect()
    }

    fn derivatives(&self, uv: &[DVec2]) -> Vec<[DVec3; 6]> {
        let mut rows = vec![0.0; 18 * uv.len()];
        self.surface.eval_rows(uv, 2, &mut rows);
        let row = |row: &[f64]| std::array::from_fn(|k| DVec3::from_slice(&row[3 * k..]));
        rows.chunks_exact(18).map(row).collect()
    }

    /// Stands normal curvatures on lines of constant u and v; the longest tooth is a fixed share of the shape's size.
    fn draw_combs(&self, mesh: &Mesh, picture: &mut Picture) {
        let Domain { min, max } = self.surface.region().data_box.unwrap_or(self.surface.domain());
        let lines = (1..=COMB_LINES).flat_map(|k| {
            let share = k as f64 / (COMB_LINES + 1) as f64;
            [0, 1].map(|axis| {
                let place = |t: f64| if axis == 0 { DVec2::new(t, share) } else { DVec2::new(share, t) };
                let at = |j: usize| min + (max - min) * place(j as f64 / COMB_TEETH as f64);
                (axis, (0..=COMB_TEETH).map(at).collect::<Vec<DVec2>>())
            })
        });
        let trims = &self.surface.region().trims;
        let combs: Vec<Vec<Option<(DVec3, DVec3)>>> = lines
            .map(|(axis, uv)| {
                let tooth = |(&uv, [s, su, sv, suu, _, svv]): (&DVec2, [DVec3; 6])| {
                    let (along, bend) = if axis == 0 { (su, suu) } else { (sv, svv) };
                    let normal = normal(su, sv);
                    let tooth = bend.dot(normal) / along.length_squared() * normal;
                    (trims.contains(uv) && tooth.is_finite()).then_some((s, tooth))
                };
                uv.iter().zip(self.derivatives(&uv)).map(tooth).collect()
            })
            .collect();
        let longest = combs.iter().flatten().flatten().map(|(_, tooth)| tooth.length()).fold(0.0, f64::max);
        let scale = COMB_SHARE * mesh.diagonal() / longest.max(f64::MIN_POSITIVE);
        for comb in &combs {
            for (k, (foot, tooth)) in
                comb.iter().enumerate().filter_map(|(k, tooth)| tooth.map(|tooth| (k, tooth)))
            {
                picture.draw_line(&[foot, foot + scale * tooth], COMB_INK);
                if let Some(Some((next, after))) = comb.get(k + 1) {
                    picture.draw_line(&[foot + scale * tooth, *next + scale * *after], TRIM_INK);
                }
            }
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
    use planish::fit::report::Tolerance;
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
        let fine = Tolerance { value: 1e-5, ..Tolerance::default() };
        let uniform = TensorOptions::default().with_knots(Knots::Uniform).with_tolerance(fine); // many lines
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
