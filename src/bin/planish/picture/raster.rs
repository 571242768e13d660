//! Shaded pictures of meshes, coloured by a number at each node: a small software rasterizer.
//!
//! Parallel projection, one light beside the viewer, smooth normals, a depth buffer, and four samples a
//! pixel. It needs no display and gives the same pixels everywhere.

use glam::{DMat3, DVec2, DVec3};
use planish::mesh::Mesh;

/// Colours of a scale from its low to its high end, dark blue over green to yellow and red.
const SCALE: [[f64; 3]; 6] = [
    [0.22, 0.30, 0.62],
    [0.12, 0.42, 0.65],
    [0.16, 0.66, 0.55],
    [0.62, 0.80, 0.28],
    [0.98, 0.78, 0.15],
    [0.85, 0.22, 0.12],
];
const BACKGROUND: [f64; 3] = [1.0, 1.0, 1.0];
const PLAIN: [f64; 3] = [0.62, 0.70, 0.78];
const INK: [f64; 3] = [0.15, 0.15, 0.15];

/// How light the dark stripes are against the others.
const DARK: f64 = 0.35;

/// Samples along each side of a pixel.
const OVERSAMPLING: usize = 2;
/// Samples across a dot.
const DOT_SAMPLES: i32 = 7;
/// Lines lie this share of the scene's size in front of what they are drawn on.
const LINE_LIFT: f64 = 2e-3;

/// From where a picture is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct View {
    /// Towards the viewer.
    pub direction: DVec3,
    /// What should point upwards.
    pub up: DVec3,
}

/// From a direction, z upwards, or y when looking along z.
impl From<[f64; 3]> for View {
    fn from(direction: [f64; 3]) -> Self {
        let direction = DVec3::from(direction);
        let is_steep = direction.truncate().length() < 1e-3 * direction.length();
        Self { direction, up: if is_steep { DVec3::Y } else { DVec3::Z } }
    }
}

impl View {
    /// Opposite to the mean normal of an open shape, a little aside so that depth shows; from a corner for a
    /// closed one.
    pub(crate) fn facing(mesh: &Mesh) -> Self {
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
            let area = (b - a).cross(c - a);
            sum += area;
            total += area.length();
        }
        let facing = if sum.length() > 0.1 * total { sum.normalize() } else { DVec3::new(1.0, -1.0, 0.7) };
        let up = if facing.z.abs() < 0.9 * facing.length() { DVec3::Z } else { DVec3::Y };
        let aside = up.cross(facing);
        Self { direction: (facing + 0.35 * aside + 0.25 * up).normalize(), up }
    }

    /// Rows: right, up, towards the viewer.
    fn axes(&self) -> DMat3 {
        let back = self.direction.normalize();
        let right = self.up.cross(back).normalize();
        DMat3::from_cols(right, back.cross(right), back).transpose()
    }
}

/// A picture in the making.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    width: usize,
    height: usize,
    axes: DMat3,
    center: DVec2,
    /// Samples for one model unit.
    zoom: f64,
    lift: f64,
    colors: Vec<[f64; 3]>,
    depths: Vec<f64>,
}

/// Cosine of the angle up to which facets are shaded as one round surface: 40 degrees, as sharp edges are found.
const LEAST_ROUND: f64 = 0.766;

/// Twice the area of each facet, along its normal.
fn facet_normals(mesh: &Mesh) -> Vec<DVec3> {
    let normal = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a)
    };
    mesh.triangles().iter().map(normal).collect()
}

/// The mean normal at a node of the facets around it that go on smoothly from one of them.
fn normal_beside(mesh: &Mesh, facets: &[DVec3], node: u32, facet: DVec3) -> DVec3 {
    let goes_on = |other: &DVec3| other.dot(facet) >= LEAST_ROUND * other.length() * facet.length();
    let around = mesh.outgoing(node).map(|edge| facets[edge.triangle()]);
    around.filter(goes_on).sum::<DVec3>().normalize_or_zero()
}

impl Picture {
    /// Towards the viewer, and a light beside it: what stripes of equal brightness are measured with.
    pub(crate) fn light(&self) -> DVec3 {
        self.axes.transpose() * DVec3::new(-0.35, 0.45, 0.82).normalize()
    }

    /// An empty picture that shows all of `mesh`.
    pub(crate) fn new(width: usize, height: usize, view: &View, mesh: &Mesh) -> Self {
        let axes = view.axes();
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &node in mesh.triangles().as_flattened() {
            let p = mesh.points()[node as usize];
            let seen = axes * p;
            (min, max) = (min.min(seen), max.max(seen));
        }
        let size = (max - min).max(DVec3::splat(f64::MIN_POSITIVE));
        let (across, down) = (width * OVERSAMPLING, height * OVERSAMPLING);
        // a tenth of the height is left to the scale
        let zoom = (0.92 * across as f64 / size.x).min(0.80 * down as f64 / size.y);
        let center = ((min + max) / 2.0).truncate() - DVec2::new(0.0, 0.05 * down as f64 / zoom);
        Self {
            width: across,
            height: down,
            axes,
            center,
            zoom,
            lift: LINE_LIFT * (max - min).length(),
            colors: vec![BACKGROUND; across * down],
            depths: vec![f64::NEG_INFINITY; across * down],
        }
    }

    /// Draws a mesh; `values` at the nodes, from `range.0` to `range.1`, choose the colours.
    pub(crate) fn draw_mesh(&mut self, mesh: &Mesh, values: Option<&[f64]>, range: (f64, f64)) {
        let span = (range.1 - range.0).max(f64::MIN_POSITIVE);
        let share = |node: usize| values.map_or(f64::NAN, |values| (values[node] - range.0) / span);
        self.draw_triangles(mesh, share, shade);
    }

    /// Draws a mesh in stripes, one for each unit of a number at the nodes.
    pub(crate) fn draw_stripes(&mut self, mesh: &Mesh, values: &[f64]) {
        let stripe = |normal, value: f64| {
            let light = shade(normal, f64::NAN);
            if value.rem_euclid(1.0) < 0.5 { light } else { light.map(|c| DARK * c) }
        };
        self.draw_triangles(mesh, |node| values[node], stripe);
    }

    fn draw_triangles(
        &mut self,
        mesh: &Mesh,
        value: impl Fn(usize) -> f64,
        color: impl Fn(DVec3, f64) -> [f64; 3],
    ) {
        let facets = facet_normals(mesh);
        for (triangle, facet) in mesh.triangles().iter().zip(&facets) {
            let corners = triangle.map(|node| {
                let normal = normal_beside(mesh, &facets, node, *facet);
                let node = node as usize;
                (self.project(mesh.points()[node]), self.axes * normal, value(node))
            });
            self.fill(corners, &color);
        }
    }

    /// Draws a line through places in space.
    pub(crate) fn draw_line(&mut self, points: &[DVec3], color: [f64; 3]) {
        for pair in points.windows(2) {
            let (a, b) = (self.project(pair[0]), self.project(pair[1]));
            let steps = (b - a).truncate().abs().max_element().ceil().max(1.0);
            for k in 0..=steps as usize {
                let p = a + (b - a) * (k as f64 / steps);
                for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                    self.set(p.x + dx, p.y + dy, p.z + self.lift, color);
                }
            }
        }
    }

    /// Draws a dot at a place in space.
    pub(crate) fn draw_dot(&mut self, place: DVec3, color: [f64; 3]) {
        let center = self.project(place);
        let reach = DOT_SAMPLES / 2;
        for dx in -reach..=reach {
            for dy in -reach..=reach {
                self.set(
                    center.x + f64::from(dx),
                    center.y + f64::from(dy),
                    center.z + 1.5 * self.lift,
                    color,
                );
            }
        }
    }

    /// Draws the scale of colours with its ends and a title below the picture.
    pub(crate) fn draw_scale(&mut self, title: &str, range: (f64, f64)) {
        let glyph = OVERSAMPLING * 2;
        let (left, right) = (self.width / 8, self.width * 7 / 8);
        let top = self.height - 18 * glyph;
        for x in left..right {
            let color = scale_color((x - left) as f64 / (right - left) as f64);
            for y in top..top + 6 * glyph {
                self.colors[y * self.width + x] = color;
            }
        }
        let line = top + 8 * glyph;
        let ends = [format!("{:.1e}", range.0), format!("{:.1e}", range.1)];
        self.text(&ends[0], left, line, glyph);
        self.text(&ends[1], right.saturating_sub(text_width(&ends[1], glyph)), line, glyph);
        self.text(title, (left + right).saturating_sub(text_width(title, glyph)) / 2, line, glyph);
    }

    /// Width, height and the pixels as RGB bytes, row by row from the top.
    pub(crate) fn finish(&self) -> (u32, u32, Vec<u8>) {
        let (width, height) = (self.width / OVERSAMPLING, self.height / OVERSAMPLING);
        let mut bytes = Vec::with_capacity(3 * width * height);
        for y in 0..height {
            for x in 0..width {
                for k in 0..3 {
                    let mut sum = 0.0;
                    for dy in 0..OVERSAMPLING {
                        for dx in 0..OVERSAMPLING {
                            let sample = (y * OVERSAMPLING + dy) * self.width + x * OVERSAMPLING + dx;
                            sum += self.colors[sample][k];
                        }
                    }
                    let mean = sum / (OVERSAMPLING * OVERSAMPLING) as f64;
                    bytes.push((255.0 * mean.clamp(0.0, 1.0)).round() as u8);
                }
            }
        }
        (width as u32, height as u32, bytes)
    }

    /// Samples to the right and down, and nearness to the viewer in model units.
    fn project(&self, p: DVec3) -> DVec3 {
        let seen = self.axes * p;
        let flat = (seen.truncate() - self.center) * self.zoom;
        DVec3::new(self.width as f64 / 2.0 + flat.x, self.height as f64 / 2.0 - flat.y, seen.z)
    }

    fn fill(&mut self, [a, b, c]: [(DVec3, DVec3, f64); 3], color: impl Fn(DVec3, f64) -> [f64; 3]) {
        let corner = |p: DVec3| p.truncate();
        let area = (corner(b.0) - corner(a.0)).perp_dot(corner(c.0) - corner(a.0));
        if area == 0.0 {
            return;
        }
        let min = a.0.min(b.0).min(c.0).max(DVec3::ZERO);
        let max = a.0.max(b.0).max(c.0);
        let last = |limit: usize, x: f64| (x.ceil().max(0.0) as usize).min(limit - 1);
        for y in min.y as usize..=last(self.height, max.y) {
            for x in min.x as usize..=last(self.width, max.x) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |q: DVec3, r: DVec3| (corner(q) - p).perp_dot(corner(r) - p) / area;
                let shares = [share(b.0, c.0), share(c.0, a.0), share(a.0, b.0)];
                if shares.iter().all(|&s| s >= 0.0) {
                    let [i, j, k] = shares;
                    let normal = i * a.1 + j * b.1 + k * c.1;
                    let color = color(normal, i * a.2 + j * b.2 + k * c.2);
                    self.set(p.x, p.y, i * a.0.z + j * b.0.z + k * c.0.z, color);
                }
            }
        }
    }

    fn set(&mut self, x: f64, y: f64, depth: f64, color: [f64; 3]) {
        if x < 0.0 || y < 0.0 || x >= self.width as f64 || y >= self.height as f64 {
            return;
        }
        let sample = y as usize * self.width + x as usize;
        if depth > self.depths[sample] {
            self.depths[sample] = depth;
            self.colors[sample] = color;
        }
    }

    fn text(&mut self, text: &str, left: usize, top: usize, size: usize) {
        for (k, letter) in text.chars().enumerate() {
            let rows = glyph(letter.to_ascii_lowercase());
            for (row, bits) in rows.iter().enumerate() {
                for column in 0..3 {
                    if bits & (4 >> column) != 0 {
                        self.block(left + (4 * k + column) * size, top + row * size, size);
                    }
                }
            }
        }
    }

    fn block(&mut self, left: usize, top: usize, size: usize) {
        for y in top..(top + size).min(self.height) {
            for x in left..(left + size).min(self.width) {
                self.colors[y * self.width + x] = INK;
            }
        }
    }
}

/// Colour of a share of the scale, shaded by a normal; both sides of a surface look alike. NaN is plain.
fn shade(normal: DVec3, share: f64) -> [f64; 3] {
    let light = DVec3::new(-0.35, 0.45, 0.82);
    let facing = if normal.z < 0.0 { -normal } else { normal };
    let brightness = 0.5 + 0.5 * facing.normalize_or_zero().dot(light.normalize()).max(0.0);
    let color = if share.is_nan() { PLAIN } else { scale_color(share) };
    color.map(|c| c * brightness)
}

fn scale_color(share: f64) -> [f64; 3] {
    let place = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let k = (place as usize).min(SCALE.len() - 2);
    let t = place - k as f64;
    std::array::from_fn(|c| SCALE[k][c] * (1.0 - t) + SCALE[k + 1][c] * t)
}

fn text_width(text: &str, size: usize) -> usize {
    4 * text.chars().count() * size
}

/// Five rows of three bits.
fn glyph(letter: char) -> [u8; 5] {
    match letter {
        '0' => [7, 5, 5, 5, 7],
        '1' => [2, 6, 2, 2, 7],
        '2' => [7, 1, 7, 4, 7],
        '3' => [7, 1, 7, 1, 7],
        '4' => [5, 5, 7, 1, 1],
        '5' => [7, 4, 7, 1, 7],
        '6' => [7, 4, 7, 5, 7],
        '7' => [7, 1, 2, 2, 2],
        '8' => [7, 5, 7, 5, 7],
        '9' => [7, 5, 7, 1, 7],
        'a' => [2, 5, 7, 5, 5],
        'b' => [6, 5, 6, 5, 6],
        'c' => [3, 4, 4, 4, 3],
        'd' => [6, 5, 5, 5, 6],
        'e' => [7, 4, 6, 4, 7],
        'f' => [7, 4, 6, 4, 4],
        'g' => [3, 4, 5, 5, 3],
        'h' => [5, 5, 7, 5, 5],
        'i' => [7, 2, 2, 2, 7],
        'j' => [1, 1, 1, 5, 2],
        'k' => [5, 5, 6, 5, 5],
        'l' => [4, 4, 4, 4, 7],
        'm' => [5, 7, 7, 5, 5],
        'n' => [6, 5, 5, 5, 5],
        'o' => [2, 5, 5, 5, 2],
        'p' => [6, 5, 6, 4, 4],
        'q' => [2, 5, 5, 6, 3],
        'r' => [6, 5, 6, 5, 5],
        's' => [3, 4, 2, 1, 6],
        't' => [7, 2, 2, 2, 2],
        'u' => [5, 5, 5, 5, 7],
        'v' => [5, 5, 5, 5, 2],
        'w' => [5, 5, 7, 7, 5],
        'x' => [5, 5, 2, 5, 5],
        'y' => [5, 5, 2, 2, 2],
        'z' => [7, 1, 2, 4, 7],
        '.' => [0, 0, 0, 0, 2],
        ',' => [0, 0, 0, 2, 4],
        '-' => [0, 0, 7, 0, 0],
        '+' => [0, 2, 7, 2, 0],
        '%' => [5, 1, 2, 4, 5],
        '/' => [1, 1, 2, 4, 4],
        '(' => [1, 2, 2, 2, 1],
        ')' => [4, 2, 2, 2, 4],
        _ => [0; 5],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_show_the_background_and_the_rest_the_shape() {
        let mesh = planish::samples::sphere_with_holes(2000, 1).unwrap();
        let view = View { direction: DVec3::Z, up: DVec3::Y };
        let mut picture = Picture::new(300, 300, &view, &mesh);
        picture.draw_mesh(&mesh, None, (0.0, 1.0));
        let (width, _, pixels) = picture.finish();
        let color = |uv: (f64, f64)| {
            let (u, v) = uv;
            let d = 1.0 + u * u + v * v;
            let p = picture.project(DVec3::new(2.0 * u, 2.0 * v, 2.0 - d) / d) / OVERSAMPLING as f64;
            let at = 3 * (p.y as usize * width as usize + p.x as usize);
            [pixels[at], pixels[at + 1], pixels[at + 2]]
        };
        for hole in [(-0.35, 0.2), (0.3, -0.25), (0.25, 0.4)] {
            assert_eq!(color(hole), [255; 3], "{hole:?}");
        }
        for place in [(0.0, 0.0), (0.7, 0.1), (-0.3, -0.6)] {
            assert_ne!(color(place), [255; 3], "{place:?}");
        }
    }
}
