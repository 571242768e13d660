//! The functions over a parameter mesh: everything of a surface that does not depend on its control points.

use super::configuration::{Configuration, Jet, mean_row};
use super::error::D1rcError;
use super::frame::{self, Boundary, Frame};
use super::kernel::{Jets, Kernel, Workspace};
use super::links::{NotSimple, links};
use super::locate::Locator;
use super::paper;
use super::regions::{Regions, Search};
use super::sharp;
use super::simplex::Site;
use super::{D1rcMode, D1rcOptions, SharpRule};
use crate::control::Watch;
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec2;
use std::collections::{BTreeMap, HashMap};

/// Points whose functions sum to less than this share of what is usual are no points of a rational surface.
const LEAST_SUM: f64 = 1e-8;

/// What a space is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The (u,v) of each vertex.
    pub uv: Vec<DVec2>,
    /// The faces.
    pub triangles: Vec<[u32; 3]>,
    /// Degree, mode, rules.
    pub options: D1rcOptions,
    /// Edges by their ends.
    pub sharp_edges: Vec<[u32; 2]>,
    /// Vertices to be interpolated.
    pub corners: Vec<u32>,
}

/// The functions over a parameter mesh.
#[derive(Debug, Clone)]
pub struct Space {
    /// What it is made of.
    pub(crate) recipe: Recipe,
    /// The places of all knots; the first are those of the vertices.
    pub(crate) places: Vec<DVec2>,
    /// The functions that are not zero everywhere on the domain.
    pub(crate) configurations: Vec<Configuration>,
    /// The faces of the domain. An edge of a crease that no other touches is halved, and its faces with it.
    pub(crate) locator: Locator,
    /// By face of the domain, the face of the mesh that it is a part of.
    pub(crate) parents: Vec<u32>,
    /// Where the functions are not zero.
    pub(crate) regions: Regions,
    /// Whether values are divided by the sum of the functions.
    pub(crate) is_rational: bool,
    /// Smallest sum in the domain; 0 for polynomial surfaces.
    least_sum: f64,
    /// The faces of the domain on which a surface is best shown: all, in the mode `Paper` those with inner vertices
    /// only on which there is a surface.
    pub(crate) shown: Vec<u32>,
    /// By vertex: whether its knots are repeated.
    pub(crate) is_clamped: Vec<bool>,
    kernel: Kernel,
}

impl Space {
    /// Checks the parts and computes the functions.
    pub fn new(recipe: Recipe) -> Result<Self, D1rcError> {
        Self::new_watched(recipe, &Watch::default())
    }

    /// The same, for a call that may be cancelled.
    pub fn new_watched(recipe: Recipe, watch: &Watch) -> Result<Self, D1rcError> {
        recipe.options.check()?;
        let vertex_count = recipe.uv.len();
        let plane = plane_mesh(&recipe)?;
        check_fixed(&recipe.corners, vertex_count)?;
        let is_sharp = sharp::flags(&plane, &recipe.sharp_edges)?;
        let parts = match recipe.options.mode {
            D1rcMode::Reproducing => reproducing(&recipe, plane, &is_sharp, watch)?,
            D1rcMode::Paper => printed(&recipe, &plane, &is_sharp),
        };
        let Parts { places, configurations, mesh_places, faces, parents, is_clamped } = parts;
        watch.check()?;
        let locator = Locator::new(mesh_places, faces);
        let all = Regions::new(&configurations, &places, &locator, watch)?;
        // knots beyond the border have functions that are nowhere seen
        let (configurations, regions) = all.without_unseen(configurations);
        let degree = recipe.options.degree;
        if configurations.is_empty() {
            return Err(D1rcError::NoConfiguration { degree });
        }
        let kernel = Kernel::new(degree, &configurations, &places, watch)?;
        let is_rational = recipe.options.mode == D1rcMode::Paper
            || (recipe.options.sharp_rule() == SharpRule::Additive
                && !(recipe.sharp_edges.is_empty() && recipe.corners.is_empty()));
        let mut space = Self {
            recipe,
            places,
            configurations,
            locator,
            parents,
            regions,
            is_rational,
            least_sum: 0.0,
            shown: Vec::new(),
            is_clamped,
            kernel,
        };
        watch.check()?;
        if is_rational {
            space.least_sum = LEAST_SUM * space.usual_sum();
        }
        space.shown = space.shown_faces();
        Ok(space)
    }

    /// What it is made of.
    pub fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    /// The functions that are not zero everywhere on the domain.
    pub fn configurations(&self) -> &[Configuration] {
        &self.configurations
    }

    /// The places of all knots; the first are those of the vertices.
    pub fn knots(&self) -> &[DVec2] {
        &self.places
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.recipe.options.degree
    }

    /// Vertices of the control mesh.
    pub fn vertex_count(&self) -> usize {
        self.recipe.uv.len()
    }

    /// The face of the domain that holds a point, and the side from which limits are taken there.
    pub(super) fn find(&self, uv: DVec2) -> Option<(u32, Site)> {
        let found = self.locator.find(uv)?;
        (!self.is_rational || self.sum_at(found) > self.least_sum).then_some(found)
    }

    fn sum_at(&self, (face, site): (u32, Site)) -> f64 {
        let mut sum = 0.0;
        self.each_function(face, &[site], 0, &mut Workspace::default(), |function, jets| {
            sum += self.configurations[function as usize].weight * jets[0][0];
        });
        sum
    }

    /// The median of the sums at the middles of the faces where there are any functions.
    fn usual_sum(&self) -> f64 {
        let middle = |face: u32| self.locator.corners(face).iter().sum::<DVec2>() / 3.0;
        let faces = 0..self.locator.faces().len() as u32;
        let mut sums: Vec<f64> = faces.map(|face| self.sum_at((face, Site::new(middle(face))))).collect_vec();
        sums.retain(|&sum| sum > 0.0);
        sums.sort_unstable_by(f64::total_cmp);
        sums.get(sums.len() / 2).copied().unwrap_or(0.0)
    }

    /// Hands over the functions that may not be zero on a face with their jets at some of its points, up to the
    /// derivatives of `order`. Weights are not in them.
    #[inline(always)]
    pub(super) fn each_function<const L: usize>(
        &self,
        face: u32,
        sites: &[Site; L],
        order: usize,
        workspace: &mut Workspace<L>,
        mut take: impl FnMut(u32, &Jets<L>),
    ) {
        for &function in self.regions.functions(face) {
            if let Some(jets) = self.jets(function, sites, order, workspace) {
                take(function, &jets);
            }
        }
    }

    /// A function at some points, without its weight; None where it is zero at all of them.
    #[inline(always)]
    pub(super) fn jets<const L: usize>(
        &self,
        function: u32,
        sites: &[Site; L],
        order: usize,
        workspace: &mut Workspace<L>,
    ) -> Option<Jets<L>> {
        let configuration = &self.configurations[function as usize];
        self.kernel.jets(function, configuration, &self.places, sites, order, workspace)
    }

    fn shown_faces(&self) -> Vec<u32> {
        let faces = 0..self.locator.faces().len() as u32;
        if self.recipe.options.mode == D1rcMode::Reproducing {
            return faces.collect_vec();
        }
        let mut is_border = memory::filled(false, self.vertex_count());
        self.locator.border_knots().for_each(|knot| is_border[knot as usize] = true);
        let is_inner =
            |face: &u32| self.locator.faces()[*face as usize].iter().all(|&v| !is_border[v as usize]);
        let is_safe = |face: &u32| {
            let corners = self.locator.corners(*face).map(|corner| self.locator.site_in(*face, corner));
            corners.iter().all(|&site| self.sum_at((*face, site)) > self.least_sum)
        };
        faces.filter(is_inner).filter(is_safe).collect_vec()
    }

    /// By function that is not zero at a point: its share, weights and the division included.
    pub fn shares(&self, uv: DVec2) -> Option<Vec<(u32, f64)>> {
        let (face, site) = self.find(uv)?;
        let mut shares = Vec::new();
        let mut sum = 0.0;
        self.each_function(face, &[site], 0, &mut Workspace::default(), |function, jets| {
            let share = self.configurations[function as usize].weight * jets[0][0];
            sum += share;
            if share != 0.0 {
                memory::push(&mut shares, (function, share));
            }
        });
        if self.is_rational {
            shares.iter_mut().for_each(|(_, share)| *share /= sum);
        }
        Some(shares)
    }

    /// One function at a point of the domain, by definition; weights and divisions are not in it.
    pub fn function_jet(&self, function: usize, uv: DVec2, order: usize) -> Option<Jet> {
        let (_, site) = self.locator.find(uv)?;
        Some(self.configurations[function].jet(&site, &self.places, order))
    }
}

/// What the two modes make.
struct Parts {
    places: Vec<DVec2>,
    configurations: Vec<Configuration>,
    /// The faces of the domain.
    mesh_places: Vec<DVec2>,
    faces: Vec<[u32; 3]>,
    parents: Vec<u32>,
    is_clamped: Vec<bool>,
}

/// The parameter mesh, one disk of positive faces.
fn plane_mesh(recipe: &Recipe) -> Result<Mesh, D1rcError> {
    let flat = |uv: &DVec2| uv.extend(0.0);
    let disk = |reason| D1rcError::NotDisk { reason };
    if let Some(index) = recipe.uv.iter().position(|uv| !uv.is_finite()) {
        return Err(D1rcError::NotFinite { index });
    }
    let mesh = Mesh::new(recipe.uv.iter().map(flat).collect_vec(), recipe.triangles.clone())
        .map_err(|_| disk("its faces are no mesh"))?;
    match () {
        _ if mesh.component_count() != 1 => return Err(disk("it has several pieces")),
        _ if mesh.loops().is_empty() => return Err(disk("it is closed")),
        _ if !mesh.pinched_nodes().is_empty() => return Err(disk("it touches itself in a vertex")),
        _ if !mesh.is_disk() => return Err(disk("it has a handle")),
        _ => {}
    }
    for (face, triangle) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = triangle.map(|vertex| recipe.uv[vertex as usize]);
        match orientation(a, b, c) {
            Orientation::Positive => {}
            Orientation::Zero => return Err(D1rcError::NoArea { face }),
            Orientation::Negative => return Err(D1rcError::Folded { face }),
        }
    }
    Ok(mesh)
}

fn check_fixed(corners: &[u32], count: usize) -> Result<(), D1rcError> {
    match corners.iter().position(|&vertex| vertex as usize >= count) {
        Some(index) => Err(D1rcError::NoSuchVertex { what: "corner", index, vertex: corners[index], count }),
        None => Ok(()),
    }
}

fn printed(recipe: &Recipe, mesh: &Mesh, is_sharp: &[bool]) -> Parts {
    let plane = paper::Plane {
        mesh,
        degree: recipe.options.degree,
        is_sharp,
        fixed: &recipe.corners,
        keeps_sectors: recipe.options.sharp_rule() == SharpRule::Sector,
        sharp_weight: recipe.options.sharp_weight,
    };
    let mut places = recipe.uv.clone();
    let mut configurations = plane.smooth();
    memory::extend(&mut configurations, plane.special(&mut places));
    Parts {
        places,
        configurations,
        mesh_places: recipe.uv.clone(),
        faces: recipe.triangles.clone(),
        parents: (0..recipe.triangles.len() as u32).collect_vec(),
        is_clamped: memory::filled(false, recipe.uv.len()),
    }
}

fn reproducing(recipe: &Recipe, mesh: Mesh, is_sharp: &[bool], watch: &Watch) -> Result<Parts, D1rcError> {
    let options = &recipe.options;
    let is_additive = options.sharp_rule() == SharpRule::Additive;
    let none = memory::filled(false, is_sharp.len());
    let split = Halved::new(recipe, mesh, if is_additive { &none } else { is_sharp })?;
    let mut is_fixed = memory::filled(false, split.places.len());
    if !is_additive {
        recipe.corners.iter().for_each(|&corner| is_fixed[corner as usize] = true);
    }
    let plane = frame::Plane {
        mesh: &split.mesh,
        places: &split.places,
        rows: &split.rows,
        cut: &split.cut,
        is_fixed: &is_fixed,
    };
    let frame = Frame::new(&plane, options.boundary, options.degree)?;
    watch.check()?;
    let links = links(&frame.link_places, &frame.triangles, options.degree, watch)?
        .map_err(|NotSimple { knot }| not_simple(recipe, &frame, knot))?;
    let mut places = frame.places;
    let mut configurations = memory::with_capacity(links.closed.len());
    for link in links.closed {
        // clones have fallen back on their vertices
        let mut edges = link.edges;
        edges.retain(|edge| places[edge[0] as usize] != places[edge[1] as usize]);
        let row = mean_row(link.knots.iter().map(|&knot| frame.rows[knot as usize].as_slice()));
        let configuration = Configuration { knots: link.knots, edges, weight: 1.0, row };
        if !is_flat(&configuration, &places) {
            memory::push(&mut configurations, configuration);
        }
    }
    if is_additive {
        let keeps_sectors = false;
        let plane = paper::Plane {
            mesh: &split.mesh,
            degree: options.degree,
            is_sharp,
            fixed: &recipe.corners,
            keeps_sectors,
            sharp_weight: options.sharp_weight,
        };
        memory::extend(&mut configurations, plane.special(&mut places));
    }
    let mut is_clamped = frame.is_clamped;
    is_clamped.truncate(recipe.uv.len());
    let mut parts = Parts {
        configurations,
        faces: memory::copied(split.mesh.triangles()),
        parents: split.parents,
        mesh_places: split.places,
        is_clamped,
        places,
    };
    if options.boundary == Boundary::Open {
        keep_complete_faces(&mut parts, &links.lost);
        if parts.faces.is_empty() {
            return Err(D1rcError::NoConfiguration { degree: options.degree });
        }
    }
    Ok(parts)
}

/// Keeps the faces that no element without functions touches: there the functions sum to one.
fn keep_complete_faces(parts: &mut Parts, lost: &[Vec<u32>]) {
    let locator = Locator::new(parts.mesh_places.clone(), parts.faces.clone());
    let mut keeps = memory::filled(true, parts.faces.len());
    let mut search = Search::new(&locator);
    let mut under = Vec::new();
    for knots in lost {
        let knots = knots.iter().map(|&knot| parts.places[knot as usize]).collect_vec();
        search.faces_under(knots, &mut under);
        under.drain(..).for_each(|face| keeps[face as usize] = false);
    }
    let kept = |face: &usize| keeps[*face];
    parts.parents = (0..keeps.len()).filter(kept).map(|face| parts.parents[face]).collect_vec();
    parts.faces = (0..keeps.len()).filter(kept).map(|face| parts.faces[face]).collect_vec();
}

fn not_simple(recipe: &Recipe, frame: &Frame, knot: u32) -> D1rcError {
    let origin = frame.origins[knot as usize] as usize;
    // the middle of a lonely crease stands for one of its ends
    let vertex = if origin < recipe.uv.len() { origin } else { frame.rows[origin][0].0 as usize };
    D1rcError::NotSimple { vertex }
}

/// Whether all knots of a function lie on one line.
fn is_flat(configuration: &Configuration, places: &[DVec2]) -> bool {
    let knots: Vec<DVec2> = configuration.all_knots().map(|knot| places[knot as usize]).collect_vec();
    let Some(other) = knots.iter().find(|&&knot| knot != knots[0]) else { return true };
    knots.iter().all(|&knot| orientation(knots[0], *other, knot) == Orientation::Zero)
}

/// The parameter mesh with lonely crease edges halved, for the cut to open.
struct Halved {
    mesh: Mesh,
    places: Vec<DVec2>,
    rows: Vec<Vec<(u32, f64)>>,
    cut: Vec<bool>,
    parents: Vec<u32>,
}

impl Halved {
    fn new(recipe: &Recipe, mesh: Mesh, is_sharp: &[bool]) -> Result<Self, D1rcError> {
        let mut halved = Self {
            places: memory::copied(&recipe.uv),
            rows: (0..recipe.uv.len() as u32).map(|vertex| vec![(vertex, 1.0)]).collect_vec(),
            cut: memory::copied(is_sharp),
            parents: (0..recipe.triangles.len() as u32).collect_vec(),
            mesh,
        };
        let lonely = sharp::lonely_edges(&halved.mesh, is_sharp);
        if !lonely.is_empty() {
            halved.halve(&lonely)?;
        }
        Ok(halved)
    }

    /// One edge after the other, that of the first half-edge first: faces of two lonely edges are halved twice.
    fn halve(&mut self, lonely: &[HalfEdge]) -> Result<(), D1rcError> {
        let mut sharp = self.sharp_pairs();
        let mut triangles = memory::copied(self.mesh.triangles());
        let mut left = Lonely::new(&self.mesh, lonely);
        while let Some([edge, twin]) = left.take_first() {
            let [a, b] = [edge.origin(&triangles), edge.target(&triangles)];
            let middle = self.places.len() as u32;
            let place = (self.places[a as usize] + self.places[b as usize]) / 2.0;
            memory::push(&mut self.places, place);
            let row = mean_row([a, b].map(|end| self.rows[end as usize].as_slice()).into_iter());
            memory::push(&mut self.rows, row);
            for half in [edge, twin] {
                let face = half.triangle();
                let [from, to, opposite] = [half, half.next(), half.previous()].map(|h| h.origin(&triangles));
                left.move_side([half.next(), HalfEdge::new(triangles.len(), 1)]);
                left.move_side([half.previous(), HalfEdge::new(face, 2)]);
                triangles[face] = [from, middle, opposite];
                memory::push(&mut triangles, [middle, to, opposite]);
                let parent = self.parents[face];
                memory::push(&mut self.parents, parent);
            }
            memory::extend(&mut sharp, [[a, middle], [b, middle]]);
        }
        let points = self.places.iter().map(|uv| uv.extend(0.0)).collect_vec();
        let old = std::mem::replace(
            &mut self.mesh,
            Mesh::new(points, triangles)
                .map_err(|_| D1rcError::NotDisk { reason: "an edge is too short" })?,
        );
        let ends = |half: &HalfEdge| [half.origin(old.triangles()), half.target(old.triangles())];
        let mut halved = lonely.iter().map(ends).collect_vec();
        halved.sort_unstable();
        sharp.retain(|pair| halved.binary_search(pair).is_err());
        self.cut = sharp::flags(&self.mesh, &sharp)?;
        Ok(())
    }

    fn sharp_pairs(&self) -> Vec<[u32; 2]> {
        let half_edges = (0..self.cut.len()).filter(|&h| self.cut[h]).map(|h| HalfEdge::new(h / 3, h % 3));
        let ends = half_edges.map(|h| [h.origin(self.mesh.triangles()), h.target(self.mesh.triangles())]);
        ends.filter(|[a, b]| a < b).collect_vec()
    }
}

/// Lonely edges that are not yet halved, where they are now.
struct Lonely {
    /// By the half-edge from the smaller vertex, the other one.
    twins: BTreeMap<usize, HalfEdge>,
    /// By that other one, the first.
    firsts: HashMap<usize, HalfEdge>,
}

impl Lonely {
    /// From the half-edges that leave the smaller vertices.
    fn new(mesh: &Mesh, edges: &[HalfEdge]) -> Self {
        let pairs = || edges.iter().filter_map(|&edge| Some((edge, mesh.topology().twin(edge)?)));
        Self {
            twins: pairs().map(|(edge, twin)| (edge.index(), twin)).collect(),
            firsts: pairs().map(|(edge, twin)| (twin.index(), edge)).collect(),
        }
    }

    fn take_first(&mut self) -> Option<[HalfEdge; 2]> {
        let (edge, twin) = self.twins.pop_first()?;
        self.firsts.remove(&twin.index());
        Some([HalfEdge::new(edge / 3, edge % 3), twin])
    }

    /// A half-edge is another one now.
    fn move_side(&mut self, [old, new]: [HalfEdge; 2]) {
        if let Some(twin) = self.twins.remove(&old.index()) {
            self.twins.insert(new.index(), twin);
            self.firsts.insert(twin.index(), new);
        } else if let Some(first) = self.firsts.remove(&old.index()) {
            self.firsts.insert(new.index(), first);
            self.twins.insert(first.index(), new);
        }
    }
}
