//! The entities of a file: header, product, units, surface, edges, face.

use super::net::Net;
use super::part21::{Id, Part21, Real, Text, list};
use super::{Schema, StepError, StepOptions, StepReport, Unit};
use crate::control::Watch;
use crate::curve::Curve;
use crate::memory::{self, CollectVec};
use crate::model::{Arc, Carrier, EdgeCurve, EdgeId, Face, Frame, Model, Role, Shell};
use glam::DVec3;

/// The whole file.
pub(super) fn file(
    model: &Model,
    report: &StepReport,
    options: &StepOptions,
    watch: &Watch,
) -> Result<String, StepError> {
    let mut out = Part21::default();
    let definition = product(&mut out, options);
    let context = context(&mut out, options.unit, report.uncertainty);
    let placement = axes(&mut out, DVec3::ZERO, DVec3::Z, DVec3::X);
    let faces = faces(&mut out, model, watch)?;
    let items = items(&mut out, model, &faces);
    let name = Text(options.product);
    let kind = match model.shells().iter().all(|shell| shell.role == Role::Open) {
        true => "MANIFOLD_SURFACE_SHAPE_REPRESENTATION",
        false if model.shells().iter().any(|shell| shell.role == Role::Open) => "SHAPE_REPRESENTATION",
        false => "ADVANCED_BREP_SHAPE_REPRESENTATION",
    };
    let items = list([placement].into_iter().chain(items));
    let shape = out.add(format!("{kind}({name},{items},{context})"));
    out.add(format!("SHAPE_DEFINITION_REPRESENTATION({definition},{shape})"));
    Ok(out.finish(&header(model, options)))
}

/// The solids, and all open shells together.
fn items(out: &mut Part21, model: &Model, faces: &[Id]) -> Vec<Id> {
    let shell_of = |out: &mut Part21, kind: &str, shell: &Shell| {
        let faces = list(shell.faces.iter().map(|face| faces[face.index()]));
        out.add(format!("{kind}('',{faces})"))
    };
    let (mut items, mut open) = (Vec::new(), Vec::new());
    for (id, shell) in model.shell_ids().zip(model.shells()) {
        match shell.role {
            Role::Open => open.push(shell_of(out, "OPEN_SHELL", shell)),
            Role::VoidIn(_) => {}
            Role::Solid => {
                let outer = shell_of(out, "CLOSED_SHELL", shell);
                let mut voids = Vec::new();
                for void in model.shells().iter().filter(|void| void.role == Role::VoidIn(id)) {
                    let inner = shell_of(out, "CLOSED_SHELL", void);
                    memory::push(&mut voids, out.add(format!("ORIENTED_CLOSED_SHELL('',*,{inner},.T.)")));
                }
                items.push(match voids.is_empty() {
                    true => out.add(format!("MANIFOLD_SOLID_BREP('',{outer})")),
                    false => out.add(format!("BREP_WITH_VOIDS('',{outer},{})", list(voids))),
                });
            }
        }
    }
    if !open.is_empty() {
        memory::push(&mut items, out.add(format!("SHELL_BASED_SURFACE_MODEL('',{})", list(open))));
    }
    items
}

fn header(model: &Model, options: &StepOptions) -> [String; 3] {
    let is_open = model.shells().iter().all(|shell| shell.role == Role::Open);
    let has_splines = model.surfaces().iter().any(|surface| surface.spline().is_some());
    let content = match (is_open, has_splines) {
        (true, true) => "trimmed spline surface",
        (false, true) => "solid of spline surfaces",
        (true, false) => "shell of planes and cylinders",
        (false, false) => "solid of planes and cylinders",
    };
    let schema = match options.schema {
        Schema::Ap214 => "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
        Schema::Ap242 => "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }",
    };
    let program = concat!("planish ", env!("CARGO_PKG_VERSION"));
    [
        format!("FILE_DESCRIPTION(({}),'2;1')", Text(content)),
        format!(
            "FILE_NAME({},{},({}),({}),{},{},'')",
            Text(options.product),
            Text(options.timestamp),
            Text(options.author),
            Text(options.organization),
            Text(program),
            Text(program)
        ),
        format!("FILE_SCHEMA(({}))", Text(schema)),
    ]
}

/// The product that the shape is of; its `PRODUCT_DEFINITION_SHAPE`.
fn product(out: &mut Part21, options: &StepOptions) -> Id {
    let (application, protocol, year) = match options.schema {
        Schema::Ap214 => ("core data for automotive mechanical design processes", "automotive_design", 2000),
        Schema::Ap242 => {
            ("managed model based 3d engineering", "ap242_managed_model_based_3d_engineering", 2020)
        }
    };
    let name = Text(options.product);
    let application = out.add(format!("APPLICATION_CONTEXT({})", Text(application)));
    out.add(format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard',{},{year},{application})",
        Text(protocol)
    ));
    let context = out.add(format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let product = out.add(format!("PRODUCT({name},{name},'',({context}))"));
    out.add(format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
    let formation = out.add(format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
    let stage = out.add(format!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
    let definition = out.add(format!("PRODUCT_DEFINITION('design','',{formation},{stage})"));
    out.add(format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"))
}

/// Units and uncertainty of the shape.
fn context(out: &mut Part21, unit: Unit, uncertainty: f64) -> Id {
    let length = length_unit(out, unit);
    let angle = out.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid_angle = out.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let uncertainty = out.add(format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{length},'distance_accuracy_value',\
         'largest distance between the curves of an edge')",
        Real(uncertainty)
    ));
    out.add(format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT({})REPRESENTATION_CONTEXT('','3D'))",
        list([length, angle, solid_angle])
    ))
}

fn length_unit(out: &mut Part21, unit: Unit) -> Id {
    if unit == Unit::Metre {
        return out.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))");
    }
    let millimetre = out.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    if unit == Unit::Millimetre {
        return millimetre;
    }
    let length = out.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    let inch = out.add(format!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),{millimetre})"));
    out.add(format!("(CONVERSION_BASED_UNIT('INCH',{inch})LENGTH_UNIT()NAMED_UNIT({length}))"))
}

fn axes(out: &mut Part21, origin: DVec3, z: DVec3, x: DVec3) -> Id {
    let origin = point(out, &origin.to_array());
    let [z, x] = [z, x].map(|axis| direction(out, axis));
    out.add(format!("AXIS2_PLACEMENT_3D('',{origin},{z},{x})"))
}

fn direction(out: &mut Part21, along: DVec3) -> Id {
    out.add(format!("DIRECTION('',{})", list(along.to_array().map(Real))))
}

fn point(out: &mut Part21, coordinates: &[f64]) -> Id {
    out.add(format!("CARTESIAN_POINT('',{})", list(coordinates.iter().map(|&x| Real(x)))))
}

/// The different knots, and how often each occurs.
fn with_multiplicities(knots: &[f64]) -> (String, String) {
    let runs = || knots.chunk_by(|a, b| a == b);
    (list(runs().map(<[f64]>::len)), list(runs().map(|run| Real(run[0]))))
}

fn carrier(out: &mut Part21, carrier: &Carrier, watch: &Watch) -> Result<Id, StepError> {
    let placed = |out: &mut Part21, frame: &Frame| axes(out, frame.origin(), frame.z(), frame.x());
    Ok(match carrier {
        Carrier::Spline(spline) => surface(out, &Net::new(spline)?, watch)?,
        Carrier::Plane(plane) => {
            let axes = placed(out, &plane.0);
            out.add(format!("PLANE('',{axes})"))
        }
        Carrier::Cylinder(cylinder) => {
            let axes = placed(out, cylinder.frame());
            out.add(format!("CYLINDRICAL_SURFACE('',{axes},{})", Real(cylinder.radius())))
        }
    })
}

fn surface(out: &mut Part21, net: &Net, watch: &Watch) -> Result<Id, StepError> {
    let line = net.knots[1].len() - net.degree[1] - 1;
    let mut ids: Vec<Id> = memory::with_capacity(net.points.len());
    for (number, p) in net.points.iter().enumerate() {
        watch.check_at(number)?;
        ids.push(point(out, &p.to_array()));
    }
    let points = list(ids.chunks_exact(line).map(list));
    let [u, v] = net.degree;
    let [(count_u, knots_u), (count_v, knots_v)] = [0, 1].map(|axis| with_multiplicities(&net.knots[axis]));
    let spline = format!("{u},{v},{points},.UNSPECIFIED.,.F.,.F.,.F.");
    let knots = format!("{count_u},{count_v},{knots_u},{knots_v},.UNSPECIFIED.");
    let Some(weights) = &net.weights else {
        return Ok(out.add(format!("B_SPLINE_SURFACE_WITH_KNOTS('',{spline},{knots})")));
    };
    let weights = list(weights.chunks_exact(line).map(|line| list(line.iter().map(|&w| Real(w)))));
    Ok(out.add(format!(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE({spline})B_SPLINE_SURFACE_WITH_KNOTS({knots})\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({weights})REPRESENTATION_ITEM('')SURFACE())"
    )))
}

/// Surfaces, vertices and edges once each, then the faces that refer to them.
fn faces(out: &mut Part21, model: &Model, watch: &Watch) -> Result<Vec<Id>, StepError> {
    let plane = out.add(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()\
         REPRESENTATION_CONTEXT('','parameters'))",
    );
    let surfaces = model.surfaces().iter().map(|surface| carrier(out, surface, watch)).try_collect_vec()?;
    watch.check()?;
    let vertices: Vec<Id> = model.vertices().iter().map(|&place| vertex(out, place)).collect_vec();
    let shared = Shared { plane, surfaces: &surfaces, vertices: &vertices };
    let mut edges: Vec<Id> = memory::with_capacity(model.edges().len());
    for (number, id) in model.edge_ids().enumerate() {
        watch.check_at(16 * number)?;
        edges.push(edge(out, model, id, shared));
    }
    Ok(model.faces().iter().map(|of| face(out, surfaces[of.surface.index()], &edges, of)).collect_vec())
}

/// What edges refer to.
#[derive(Clone, Copy)]
struct Shared<'a> {
    /// The context of p-curves.
    plane: Id,
    surfaces: &'a [Id],
    vertices: &'a [Id],
}

fn face(out: &mut Part21, surface: Id, edges: &[Id], face: &Face) -> Id {
    let mut bounds = memory::with_capacity(face.bounds.len());
    for (index, coedges) in face.bounds.iter().enumerate() {
        let oriented = coedges.iter().map(|coedge| {
            let sense = if coedge.is_forward { 'T' } else { 'F' };
            out.add(format!("ORIENTED_EDGE('',*,*,{},.{sense}.)", edges[coedge.edge.index()]))
        });
        let oriented: Vec<Id> = oriented.collect_vec();
        let edge_loop = out.add(format!("EDGE_LOOP('',{})", list(oriented)));
        let kind = if index == 0 { "FACE_OUTER_BOUND" } else { "FACE_BOUND" };
        memory::push(&mut bounds, out.add(format!("{kind}('',{edge_loop},.T.)")));
    }
    let sense = if face.is_forward { 'T' } else { 'F' };
    out.add(format!("ADVANCED_FACE('',{},{surface},.{sense}.)", list(bounds)))
}

fn vertex(out: &mut Part21, p: DVec3) -> Id {
    let point = point(out, &p.to_array());
    out.add(format!("VERTEX_POINT('',{point})"))
}

/// An edge with its curve in space and its p-curves on the surfaces beside it, which share their parameters. Faces
/// with equal p-curves, such as those of one cut surface, share one.
fn edge(out: &mut Part21, model: &Model, id: EdgeId, shared: Shared) -> Id {
    let edge = model.edge(id);
    let in_space = match &edge.curve {
        EdgeCurve::Spline(spline) => curve(out, spline),
        EdgeCurve::Arc(arc) => conic(out, arc),
    };
    let mut definitions: Vec<(&Curve, Id)> = Vec::new();
    let mut pcurves = Vec::new();
    let mut surfaces = Vec::new();
    for at in model.uses(id) {
        let Some(pcurve) = &model.coedge(at).pcurve else { continue };
        let known = definitions.iter().find(|(other, _)| *other == pcurve).map(|&(_, id)| id);
        let definition = known.unwrap_or_else(|| {
            let in_plane = curve(out, pcurve);
            out.add(format!("DEFINITIONAL_REPRESENTATION('',({in_plane}),{})", shared.plane))
        });
        memory::push(&mut definitions, (pcurve, definition));
        memory::push(&mut surfaces, (model.face(at.face).surface, definition));
    }
    for &(surface, definition) in &surfaces {
        memory::push(
            &mut pcurves,
            out.add(format!("PCURVE('',{},{definition})", shared.surfaces[surface.index()])),
        );
    }
    let all = match surfaces[..] {
        [] => in_space,
        [(a, _), (b, _)] if a == b => {
            out.add(format!("SEAM_CURVE('',{in_space},{},.PCURVE_S1.)", list(pcurves)))
        }
        _ => out.add(format!("SURFACE_CURVE('',{in_space},{},.PCURVE_S1.)", list(pcurves))),
    };
    let [start, end] = edge.vertices.map(|vertex| shared.vertices[vertex.index()]);
    out.add(format!("EDGE_CURVE('',{start},{end},{all},.T.)"))
}

fn curve(out: &mut Part21, curve: &Curve) -> Id {
    if let (3, &[a, b]) = (curve.dim(), curve.control_points().as_chunks::<3>().0) {
        return line(out, curve, [a, b].map(DVec3::from));
    }
    let points = curve.control_points().chunks_exact(curve.dim());
    let ids: Vec<Id> = points.map(|p| point(out, p)).collect_vec();
    let (counts, knots) = with_multiplicities(curve.knots().knots());
    out.add(format!(
        "B_SPLINE_CURVE_WITH_KNOTS('',{},{},.UNSPECIFIED.,.F.,.F.,{counts},{knots},.UNSPECIFIED.)",
        curve.knots().degree(),
        list(ids)
    ))
}

/// The whole circle or ellipse of an arc, over the same parameters.
fn conic(out: &mut Part21, arc: &Arc) -> Id {
    let (frame, [a, b]) = (arc.frame(), arc.radii());
    let axes = axes(out, frame.origin(), frame.z(), frame.x());
    match arc.is_circle() {
        true => out.add(format!("CIRCLE('',{axes},{})", Real(a))),
        false => out.add(format!("ELLIPSE('',{axes},{},{})", Real(a), Real(b))),
    }
}

/// A straight edge, over the parameters of its curve.
fn line(out: &mut Part21, curve: &Curve, [start, end]: [DVec3; 2]) -> Id {
    let (from, to) = curve.knots().domain();
    let speed = (end - start) / (to - from);
    let origin = point(out, &(start - from * speed).to_array());
    let along = direction(out, speed.normalize_or(DVec3::X));
    let vector = out.add(format!("VECTOR('',{along},{})", Real(speed.length())));
    out.add(format!("LINE('',{origin},{vector})"))
}
