//! `planish topics`: what does not belong to one option.

use crate::{Failure, Outcome, output};
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(crate) struct TopicsArguments {
    /// The subject; all of them if it is left out.
    #[arg(value_enum)]
    topic: Option<Topic>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// How close a surface comes, and how to choose it.
    Tolerance,
    /// Which kind of surface for which data.
    Families,
    /// What can be read and written, by the ends of names.
    Files,
    /// Lengths, angles and what STEP files say of them.
    Units,
    /// What is mended in meshes, and how to refuse it.
    Repair,
    /// What the lines of a report mean.
    Report,
    /// What the exit code says to scripts.
    ExitCodes,
}

impl Topic {
    fn text(self) -> &'static str {
        match self {
            Self::Tolerance => {
                "\
TOLERANCE
The largest distance allowed between a node of the mesh and its place on the surface. It is a fraction of the
diagonal of the mesh's box (default 1e-3: a millimetre on a metre), or in model units with --absolute.
A scan: twice its noise. A part: what manufacture asks for. Ten times smaller takes about twice the control points along
each direction of a smooth shape. Where it cannot be met the best surface is written all the same, and the exit code is 2.
  planish fit part.stl --tolerance 0.05 --absolute --out part.step
"
            }
            Self::Families => {
                "\
FAMILIES
auto    a model for a closed mesh; for one with a boundary a tensor surface if it meets the tolerance, else a model if
        that does better
model   patches that meet smoothly, exact planes and cylinders, sharp edges: solids of closed meshes, shells of others
tensor  one grid of knots: what every CAD system edits; smooth plates, terrain, fields
pht     cells as small as the shape asks, place by place: detail in few places
d1rc    a triangular control mesh with sharp edges: --sharp-angle 30
Rows of points become one surface by planish skin, a coarse control mesh by planish d1rc.
"
            }
            Self::Files => {
                "\
FILES
Read:    .off .obj .ply .stl, text or binary, also with .gz; .planish (what was saved)
Written: .planish     the surface or model itself, to the bit
         .step .stp   trimmed faces, shells and solids (AP214)
         .vtu         for ParaView
         .obj .off .ply .stl .glb    triangles
         .png .html   a picture, a report
Every file is written beside its place and renamed: one that was there survives every failure.
  planish convert part.planish part.step part.glb --unit m
"
            }
            Self::Units => {
                "\
UNITS
Planish has none: lengths are those of the input, angles on the command line are degrees. STEP files have to say what one
model unit is: millimetres, unless --unit m or --unit inch says otherwise or the saved surface does.
"
            }
            Self::Repair => {
                "\
REPAIR
Mended by default and told in the report: unused nodes, copies of triangles, triangles without area, nodes where the
surface touches itself, orientation. By request: --weld DISTANCE joins nodes, --repair sheets parts edges of three and
more triangles, --component largest takes one of several parts. --no-repair refuses every fault.
  planish info part.stl
"
            }
            Self::Report => {
                "\
REPORT
max error      the largest distance at the nodes: what the tolerance bounds
between nodes  the same at centres and edges of triangles; a part of it is the facets' own: a flat facet of a round shape
               is off by its sagitta, which the report tells beside it
result         met, or why not: limit reached, more coefficients than data, refinement no longer helps
remark         what is worth knowing, one line each
--json prints all of it for programs; --report part.html shows it in space; --picture part.png draws it.
"
            }
            Self::ExitCodes => {
                "\
EXIT CODES
0  done, and the tolerance met at the nodes and between them
2  done and written, but the tolerance not met
1  any error: one line on standard error says what and where; names and options are looked at before any work, and a file
   that cannot be written leaves those written before it
"
            }
        }
    }
}

pub(crate) fn run(arguments: &TopicsArguments) -> Result<Outcome, Failure> {
    let all = Topic::value_variants().iter().filter(|topic| arguments.topic.is_none_or(|one| one == **topic));
    let texts: Vec<&str> = all.map(|topic| topic.text()).collect();
    output::print(texts.join("\n"))?;
    Ok(Outcome::Done)
}
