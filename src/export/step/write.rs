//! The entities of a file: header, product, units, surface, edges, face.

use super::net::Net;
use super::part21::{Id, Part21, Real, Text, list};
use super::shell::{Edge, Face, Shell};
use super::{Schema, StepOptions, StepReport, Unit};
use crate::curve::Curve;
use glam::DVec3;

/// The whole file.
pub(super) fn file(nets: &[Net], shell: &Shell, report: &StepReport, options: &StepOptions) -> String {
    let mut out = Part21::default();
    let definition = product(&mut out, options);
    let context = context(&mut out, options.unit, report.uncertainty);
    let placement = placement(&mut out);
    let faces = faces(&mut out, nets, shell);
    let shell = out.add(format!("OPEN_SHELL('',{})", list(faces)));
    let model = out.add(format!("SHELL_BASED_SURFACE_MODEL('',({shell}))"));
    let name = Text(options.product);
    let items = list([placement, model]);
    let shape = out.add(format!("MANIFOLD_SURFACE_SHAPE_REPRESENTATION({name},{items},{context})"));
    out.add(format!("SHAPE_DEFINITION_REPRESENTATION({definition},{shape})"));
    out.finish(&header(options))
}

fn header(options: &StepOptions) -> [String; 3] {
    let schema = match options.schema {
        Schema::Ap214 => "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
        Schema::Ap242 => "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }",
    };
    let program = concat!("planish ", env!("CARGO_PKG_VERSION"));
    [
        "FILE_DESCRIPTION(('trimmed spline surface'),'2;1')".to_owned(),
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

fn placement(out: &mut Part21) -> Id {
    let origin = point(out, &[0.0; 3]);
    let [z, x] = ["0.,0.,1.", "1.,0.,0."].map(|axis| out.add(format!("DIRECTION('',({axis}))")));
    out.add(format!("AXIS2_PLACEMENT_3D('',{origin},{z},{x})"))
}

fn point(out: &mut Part21, coordinates: &[f64]) -> Id {
    out.add(format!("CARTESIAN_POINT('',{})", list(coordinates.iter().map(|&x| Real(x)))))
}

/// The different knots, and how often each occurs.
fn with_multiplicities(knots: &[f64]) -> (String, String) {
    let runs = || knots.chunk_by(|a, b| a == b);
    (list(runs().map(<[f64]>::len)), list(runs().map(|run| Real(run[0]))))
}

fn surface(out: &mut Part21, net: &Net) -> Id {
    let line = net.knots[1].len() - net.degree[1] - 1;
    let ids: Vec<Id> = net.points.iter().map(|p| point(out, &p.to_array())).collect();
    let points = list(ids.chunks_exact(line).map(list));
    let [u, v] = net.degree;
    let [(count_u, knots_u), (count_v, knots_v)] = [0, 1].map(|axis| with_multiplicities(&net.knots[axis]));
    let spline = format!("{u},{v},{points},.UNSPECIFIED.,.F.,.F.,.F.");
    let knots = format!("{count_u},{count_v},{knots_u},{knots_v},.UNSPECIFIED.");
    let Some(weights) = &net.weights else {
        return out.add(format!("B_SPLINE_SURFACE_WITH_KNOTS('',{spline},{knots})"));
    };
    let weights = list(weights.chunks_exact(line).map(|line| list(line.iter().map(|&w| Real(w)))));
    out.add(format!(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE({spline})B_SPLINE_SURFACE_WITH_KNOTS({knots})\
         GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE({weights})REPRESENTATION_ITEM('')SURFACE())"
    ))
}

/// Surfaces, vertices and edges once each, then the faces that refer to them.
fn faces(out: &mut Part21, nets: &[Net], shell: &Shell) -> Vec<Id> {
    let plane = out.add(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()\
         REPRESENTATION_CONTEXT('','parameters'))",
    );
    let mut surfaces = vec![None; nets.len()];
    for face in &shell.faces {
        surfaces[face.surface].get_or_insert_with(|| surface(out, &nets[face.surface]));
    }
    let vertices: Vec<Id> = shell.vertices.iter().map(|&p| vertex(out, p)).collect();
    let mut edges = Vec::with_capacity(shell.edges.len());
    for shared in &shell.edges {
        let beside: Vec<Id> = shared.surfaces.iter().filter_map(|&k| surfaces[k]).collect();
        edges.push(edge(out, &beside, plane, &vertices, shared));
    }
    let face_on = |face: &Face| Some(self::face(out, surfaces[face.surface]?, &edges, face));
    shell.faces.iter().filter_map(face_on).collect()
}

fn face(out: &mut Part21, surface: Id, edges: &[Id], face: &Face) -> Id {
    let mut bounds = Vec::with_capacity(face.bounds.len());
    for (index, sides) in face.bounds.iter().enumerate() {
        let oriented = sides.iter().map(|side| {
            let sense = if side.is_forward { 'T' } else { 'F' };
            out.add(format!("ORIENTED_EDGE('',*,*,{},.{sense}.)", edges[side.edge]))
        });
        let oriented: Vec<Id> = oriented.collect();
        let edge_loop = out.add(format!("EDGE_LOOP('',{})", list(oriented)));
        let kind = if index == 0 { "FACE_OUTER_BOUND" } else { "FACE_BOUND" };
        bounds.push(out.add(format!("{kind}('',{edge_loop},.T.)")));
    }
    out.add(format!("ADVANCED_FACE('',{},{surface},.T.)", list(bounds)))
}

fn vertex(out: &mut Part21, p: DVec3) -> Id {
    let point = point(out, &p.to_array());
    out.add(format!("VERTEX_POINT('',{point})"))
}

/// An edge with its curve in space and its p-curve on the surfaces beside it, which share their parameters.
fn edge(out: &mut Part21, surfaces: &[Id], plane: Id, vertices: &[Id], edge: &Edge) -> Id {
    let in_space = curve(out, &edge.image.curve);
    let in_plane = curve(out, &edge.image.pcurve);
    let definition = out.add(format!("DEFINITIONAL_REPRESENTATION('',({in_plane}),{plane})"));
    let pcurves = surfaces.iter().map(|surface| out.add(format!("PCURVE('',{surface},{definition})")));
    let pcurves = list(pcurves.collect::<Vec<_>>());
    let all = out.add(format!("SURFACE_CURVE('',{in_space},{pcurves},.PCURVE_S1.)"));
    out.add(format!("EDGE_CURVE('',{},{},{all},.T.)", vertices[edge.start], vertices[edge.end]))
}

fn curve(out: &mut Part21, curve: &Curve) -> Id {
    let points = curve.control_points().chunks_exact(curve.dim());
    let ids: Vec<Id> = points.map(|p| point(out, p)).collect();
    let (counts, knots) = with_multiplicities(curve.knots().knots());
    out.add(format!(
        "B_SPLINE_CURVE_WITH_KNOTS('',{},{},.UNSPECIFIED.,.F.,.F.,{counts},{knots},.UNSPECIFIED.)",
        curve.knots().degree(),
        list(ids)
    ))
}
