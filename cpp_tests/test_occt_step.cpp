// STEP files as OpenCASCADE reads them: valid, one face, its bounds, area, holes, and curves that agree.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <IntCurvesFace_Intersector.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <planish.hpp>
#include <ShapeAnalysis_FreeBounds.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Lin.hxx>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr double millimetres_per_metre = 1000.0;

struct written {
  std::string path;
  planish_step_report report;
};

written write(const Surface &surface, const char *name, std::uint32_t unit, std::uint32_t schema) {
  written file{std::string("occt_") + name + ".step", fresh<planish_step_report>()};
  planish_step_options options;
  CHECK_EQUAL(planish_step_options_init(&options, sizeof options), PLANISH_STATUS_OK);
  options.product = name;
  options.unit = unit;
  options.schema = schema;
  options.out_report = &file.report;
  const planish_status status = planish_surface_write_step(surface.get(), file.path.c_str(), &options);
  if (status != PLANISH_STATUS_OK) std::printf("%s\n", check::last_sentence().c_str());
  CHECK_EQUAL(status, PLANISH_STATUS_OK);
  CHECK(file.report.curve_deviation <= file.report.uncertainty);
  return file;
}

TopoDS_Shape read(const std::string &path) {
  Message::DefaultMessenger()->ChangePrinters().Clear(); // the reader tells statistics
  STEPControl_Reader reader;
  CHECK(reader.ReadFile(path.c_str()) == IFSelect_RetDone);
  CHECK_EQUAL(reader.TransferRoots(), 1);
  return reader.OneShape();
}

int count(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind) {
  int found = 0;
  for (TopExp_Explorer it(shape, kind); it.More(); it.Next()) ++found;
  return found;
}

double area(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties, 1e-6);
  return properties.Mass();
}

// The midpoint rule over the parameters inside the trims.
double own_area(const Surface &surface) {
  constexpr int cells = 1500;
  double domain[4];
  CHECK_EQUAL(planish_surface_domain(surface.get(), domain), PLANISH_STATUS_OK);
  const double du = (domain[1] - domain[0]) / cells, dv = (domain[3] - domain[2]) / cells;
  std::vector<double> uv(2 * cells), rows(9 * cells);
  std::vector<std::uint8_t> flags(cells);
  planish_eval_options options = eval_options();
  options.out_flags = flags.data();
  options.thread_count = 1;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      uv[2 * j] = domain[0] + (i + 0.5) * du;
      uv[2 * j + 1] = domain[2] + (j + 0.5) * dv;
    }
    CHECK_EQUAL(planish_surface_eval_derivatives(surface.get(), uv.data(), cells, 1, &options, rows.data()),
                PLANISH_STATUS_OK);
    for (int j = 0; j < cells; ++j) {
      const double *row = &rows[9 * j];
      const gp_Vec su(row[3], row[4], row[5]), sv(row[6], row[7], row[8]);
      if (!(flags[j] & PLANISH_FLAG_OUTSIDE_TRIMS)) sum += su.Crossed(sv).Magnitude() * du * dv;
    }
  }
  return sum;
}

// Largest distance between the curve of an edge and the image of its p-curve, at 100 parameters of each edge, and
// whether both are over the same parameters.
double curve_deviation(const TopoDS_Face &face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  double worst = 0;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    double from, to, from_2d, to_2d;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, from, to);
    const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, from_2d, to_2d);
    CHECK(!curve.IsNull() && !pcurve.IsNull());
    if (curve.IsNull() || pcurve.IsNull()) continue;
    CHECK_EQUAL(from, from_2d);
    CHECK_EQUAL(to, to_2d);
    for (int k = 0; k < 100; ++k) {
      const double t = from + (to - from) * k / 99.0;
      const gp_Pnt2d uv = pcurve->Value(t);
      worst = std::fmax(worst, curve->Value(t).Distance(surface->Value(uv.X(), uv.Y())));
    }
  }
  return worst;
}

// How often the line along z through (x, y) meets the face.
int hits(const TopoDS_Face &face, double x, double y) {
  IntCurvesFace_Intersector intersector(face, 1e-9);
  intersector.Perform(gp_Lin(gp_Pnt(x, y, -1e6), gp_Dir(0, 0, 1)), 0, 2e6);
  CHECK(intersector.IsDone());
  return intersector.NbPnt();
}

// Edges with a face on one side only: those of one face that are no seam of it.
int free_edges(const TopoDS_Shape &shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  int found = 0;
  for (int k = 1; k <= faces_of_edges.Extent(); ++k) {
    const TopTools_ListOfShape &faces = faces_of_edges(k);
    const TopoDS_Edge edge = TopoDS::Edge(faces_of_edges.FindKey(k));
    const bool is_seam = faces.Extent() > 0 && BRep_Tool::IsClosed(edge, TopoDS::Face(faces.First()));
    // a seam is listed twice with its face, or once
    TopTools_MapOfShape different;
    for (const TopoDS_Shape &face : faces) different.Add(face);
    found += different.Extent() == 1 && !is_seam;
  }
  return found;
}

// Everything that holds for any file; the face, for more.
TopoDS_Face check_file(const Surface &surface, const char *name, std::uint32_t unit, int wires,
                       std::uint32_t schema = PLANISH_STEP_SCHEMA_AP214) {
  const written file = write(surface, name, unit, schema);
  const double scale = unit == PLANISH_UNIT_METRE ? millimetres_per_metre : unit == PLANISH_UNIT_INCH ? 25.4 : 1.0;
  const TopoDS_Shape shape = read(file.path);
  CHECK(!shape.IsNull());
  if (shape.IsNull()) return {};
  CHECK(BRepCheck_Analyzer(shape).IsValid());
  CHECK_EQUAL(count(shape, TopAbs_FACE), 1);
  CHECK_EQUAL(count(shape, TopAbs_WIRE), wires);
  CHECK_EQUAL(static_cast<std::size_t>(wires), file.report.loop_count);
  TopExp_Explorer faces(shape, TopAbs_FACE);
  if (!faces.More()) return {};
  const TopoDS_Face face = TopoDS::Face(faces.Current());
  const double own = own_area(surface) * scale * scale;
  const double found = area(face);
  CHECK_NEAR(found / own, 1.0, 1e-3);
  const double deviation = curve_deviation(face);
  CHECK(deviation <= file.report.uncertainty * scale);
  // the reader's tolerances grow with what it finds wrong
  double tolerance = 0;
  int edges = 0;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    tolerance = std::fmax(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(it.Current())));
    ++edges;
  }
  std::printf("%-10s %d wires, %3d of %3zu edges, area %.6g (own %.6g), deviation %.2e, measured by us %.2e, "
              "uncertainty %.2e, largest edge tolerance %.2e\n",
              name, count(shape, TopAbs_WIRE), edges, file.report.edge_count, found, own, deviation,
              file.report.curve_deviation * scale, file.report.uncertainty * scale, tolerance);
  return face;
}

// A shell of faces that share their inner edges: what is free are the trims, closed.
void check_shell(const Surface &surface, const char *name, std::uint32_t form, int trims) {
  const std::string path = std::string("occt_") + name + ".step";
  planish_step_report report = fresh<planish_step_report>();
  planish_step_options options;
  CHECK_EQUAL(planish_step_options_init(&options, sizeof options), PLANISH_STATUS_OK);
  options.form = form;
  options.out_report = &report;
  CHECK_EQUAL(planish_surface_write_step(surface.get(), path.c_str(), &options), PLANISH_STATUS_OK);
  const TopoDS_Shape shape = read(path);
  CHECK(!shape.IsNull());
  if (shape.IsNull()) return;
  CHECK(BRepCheck_Analyzer(shape).IsValid());
  CHECK_EQUAL(static_cast<std::size_t>(count(shape, TopAbs_FACE)), report.face_count);
  CHECK(report.face_count > 1);

  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  CHECK_EQUAL(static_cast<std::size_t>(faces_of_edges.Extent()), report.edge_count);
  int free_edges = 0;
  for (int k = 1; k <= faces_of_edges.Extent(); ++k) free_edges += faces_of_edges(k).Extent() == 1;
  const ShapeAnalysis_FreeBounds bounds(shape);
  CHECK_EQUAL(count(bounds.GetClosedWires(), TopAbs_WIRE), trims);
  CHECK_EQUAL(count(bounds.GetOpenWires(), TopAbs_WIRE), 0);
  CHECK_EQUAL(count(bounds.GetClosedWires(), TopAbs_EDGE), free_edges);

  const double own = own_area(surface), found = area(shape);
  CHECK_NEAR(found / own, 1.0, 1e-3);
  double deviation = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
    deviation = std::fmax(deviation, curve_deviation(TopoDS::Face(it.Current())));
  }
  CHECK(deviation <= report.uncertainty);
  std::printf("%-10s %zu faces, %d of %zu edges free, area %.6g (own %.6g), deviation %.2e, measured by us %.2e, "
              "uncertainty %.2e\n",
              name, report.face_count, free_edges, report.edge_count, found, own, deviation, report.curve_deviation,
              report.uncertainty);
}

Mesh made(const shapes::arrays &arrays) {
  planish_mesh *out_mesh = nullptr;
  const planish_mesh_options options = mesh_options();
  CHECK_EQUAL(planish_mesh_new(arrays.points.data(), arrays.point_count(), arrays.triangles.data(),
                               arrays.triangle_count(), &options, &out_mesh),
              PLANISH_STATUS_OK);
  Mesh mesh(out_mesh);
  CHECK_EQUAL(planish_mesh_set_parameters(mesh.get(), arrays.uv.data(), arrays.point_count()), PLANISH_STATUS_OK);
  return mesh;
}

Surface fitted(const shapes::arrays &arrays) {
  const Mesh mesh = made(arrays);
  planish_surface *out = nullptr;
  CHECK(planish_tensor_fit(mesh.get(), nullptr, &out, nullptr) >= 0);
  return Surface(out);
}

std::vector<double> circle(double u, double v, double radius, int count) {
  std::vector<double> uv;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * k / count;
    uv.insert(uv.end(), {u + radius * std::cos(angle), v + radius * std::sin(angle)});
  }
  return uv;
}

// A polygon with points on its sides.
std::vector<double> polygon(const std::vector<double> &corners) {
  constexpr int points_a_side = 24;
  std::vector<double> uv;
  for (std::size_t k = 0; k < corners.size(); k += 2) {
    const std::size_t next = (k + 2) % corners.size();
    for (int i = 0; i < points_a_side; ++i) {
      const double share = static_cast<double>(i) / points_a_side;
      for (std::size_t c : {0, 1}) uv.push_back((1 - share) * corners[k + c] + share * corners[next + c]);
    }
  }
  return uv;
}

void set_trims(const Surface &surface, const std::vector<std::vector<double>> &loops) {
  std::vector<double> uv;
  std::vector<std::size_t> counts;
  for (const std::vector<double> &loop : loops) {
    uv.insert(uv.end(), loop.begin(), loop.end());
    counts.push_back(loop.size() / 2);
  }
  CHECK_EQUAL(planish_surface_set_trims(surface.get(), uv.data(), counts.data(), counts.size()), PLANISH_STATUS_OK);
}

// The part of a torus between four angles, exact, of radii 3 and 1. Every arc is less than half a turn.
Surface torus(double ring_from, double ring_to, double tube_from, double tube_to) {
  const double knots[6] = {0, 0, 0, 1, 1, 1};
  struct arc {
    double x[3], y[3], w[3];
    arc(double from, double to) {
      const double half = (to - from) / 2, middle = (from + to) / 2, c = std::cos(half);
      const double angles[3] = {from, middle, to};
      for (int k = 0; k < 3; ++k) {
        const double r = k == 1 ? 1 / c : 1;
        x[k] = r * std::cos(angles[k]), y[k] = r * std::sin(angles[k]), w[k] = k == 1 ? c : 1;
      }
    }
  };
  const arc ring(ring_from, ring_to), tube(tube_from, tube_to);
  std::vector<double> points, weights;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double radius = 3 + tube.x[j];
      points.insert(points.end(), {radius * ring.x[i], radius * ring.y[i], tube.y[j]});
      weights.push_back(ring.w[i] * tube.w[j]);
    }
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tensor_new(3, 2, 2, knots, 6, knots, 6, points.data(), weights.data(), &out), PLANISH_STATUS_OK);
  return Surface(out);
}

} // namespace

TEST(OcctStep, FittedPanelWithHoles) {
  const Surface panel = fitted(shapes::graph(41, 41, 0.25, 7, true));
  // a hole of the data in the middle, and two drawn ones
  std::vector<std::vector<double>> loops;
  for (std::size_t k = 0; k < planish_surface_trim_count(panel.get()); ++k) {
    loops.emplace_back(2 * planish_surface_trim_point_count(panel.get(), k));
    CHECK_EQUAL(planish_surface_copy_trim(panel.get(), k, loops.back().data(), loops.back().size() / 2),
                PLANISH_STATUS_OK);
  }
  CHECK_EQUAL(loops.size(), std::size_t{2});
  loops.push_back(circle(0.2, 0.2, 0.08, 60));
  loops.push_back(polygon(circle(0.8, 0.75, 0.05, 5)));
  set_trims(panel, loops);
  for (const std::uint32_t unit : {PLANISH_UNIT_MILLIMETRE, PLANISH_UNIT_METRE, PLANISH_UNIT_INCH}) {
    const double scale = unit == PLANISH_UNIT_METRE ? millimetres_per_metre : unit == PLANISH_UNIT_INCH ? 25.4 : 1.0;
    const char *names[] = {"panel_mm", "panel_m", "panel_inch"};
    const TopoDS_Face face = check_file(panel, names[unit], unit, 4);
    for (const auto &[x, y] : {std::pair(0.5, 0.5), std::pair(0.2, 0.2), std::pair(0.8, 0.75)}) {
      CHECK_EQUAL(hits(face, scale * x, scale * y), 0);
    }
    for (const auto &[x, y] : {std::pair(0.5, 0.2), std::pair(0.2, 0.31), std::pair(0.8, 0.65)}) {
      CHECK_EQUAL(hits(face, scale * x, scale * y), 1);
    }
    CHECK_EQUAL(hits(face, scale * 1.05, scale * 0.5), 0);
  }
}

TEST(OcctStep, RationalTorusPiece) {
  const Surface piece = torus(0.1, 1.4, -0.6, 1.2);
  const TopoDS_Face face = check_file(piece, "torus", PLANISH_UNIT_MILLIMETRE, 1);
  CHECK_NEAR(area(face), 1.3 * (3 * 1.8 + std::sin(1.2) - std::sin(-0.6)), 1e-5);
  set_trims(piece, {polygon({0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.9, 0.1}), circle(0.5, 0.5, 0.2, 90),
                    polygon(circle(0.8, 0.8, 0.05, 4))});
  check_file(piece, "torus_trim", PLANISH_UNIT_MILLIMETRE, 3);
}

TEST(OcctStep, UntrimmedPatchWithOpenKnots) {
  // a uniform knot vector: other programs want it clamped
  const double knots[10] = {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6};
  std::vector<double> points;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) points.insert(points.end(), {10.0 * i, 10.0 * j, 8 * std::sin(i) * std::cos(0.5 * j)});
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tensor_new(3, 3, 3, knots, 10, knots, 10, points.data(), nullptr, &out), PLANISH_STATUS_OK);
  const Surface patch(out);
  const TopoDS_Face face = check_file(patch, "patch", PLANISH_UNIT_MILLIMETRE, 1);
  CHECK_EQUAL(hits(face, 25, 25), 1);
  CHECK_EQUAL(count(face, TopAbs_EDGE), 4);
}

// Two halves of a shell, of which the second takes over the side of the first with its tangent planes: they are sewn
// without a gap, one file has both as a shell, and no inner edge is free.
template <class Fit, class Options>
void check_halves(Fit fit, Options options, const char *name) {
  std::vector<planish::point2> uv;
  for (int i = 0; i < 1600; ++i) uv.push_back({i / 40 / 39.0, i % 40 / 39.0});
  const auto half = [&](double from) {
    std::vector<double> values;
    for (const auto &[u, v] : uv) {
      const double x = from + u;
      values.insert(values.end(), {100 * x, 100 * v + 10 * x * v, 30 * std::sin(1.7 * x) * (1 + v) + 20 * std::cos(3 * v)});
    }
    return values;
  };
  options.tolerance = 1e-4;
  const planish::fitted first = fit(uv, half(0), 3, options);
  options.neighbour_u_low = first.surface.get();
  const planish::fitted second = fit(uv, half(1), 3, options);
  CHECK_EQUAL(second.status, PLANISH_STATUS_OK);
  CHECK(second.report.max_side_error <= 1e-12 * second.report.diagonal && second.report.max_side_angle <= 1e-10);

  const std::string path = std::string("occt_halves_") + name + ".step";
  BRepBuilderAPI_Sewing sewing(1e-9 * second.report.diagonal);
  for (const planish::surface *surface : {&first.surface, &second.surface}) {
    surface->write_step(path);
    sewing.Add(read(path));
  }
  sewing.Perform();
  CHECK_EQUAL(count(sewing.SewedShape(), TopAbs_SHELL), 1);
  CHECK_EQUAL(free_edges(sewing.SewedShape()), 6);
  CHECK(BRepCheck_Analyzer(sewing.SewedShape()).IsValid());

  if (first.surface.kind() != PLANISH_KIND_TENSOR) return;
  const planish::smoothed_model both = planish::model_smooth_from_patches({&first.surface, &second.surface});
  both.model.write_step(path);
  const TopoDS_Shape shell = read(path);
  CHECK_EQUAL(count(shell, TopAbs_SHELL), 1);
  CHECK_EQUAL(count(shell, TopAbs_FACE), 2);
  CHECK_EQUAL(free_edges(shell), 6);
  CHECK(BRepCheck_Analyzer(shell).IsValid());
}

TEST(OcctStep, HalvesOfAShellShareTheirEdge) {
  auto tensor = planish::defaults<planish_tensor_options>();
  tensor.buffer = 0; // the side is where the data end
  const auto tensor_fit = [](const auto &...given) { return planish::tensor_fit_points(given...); };
  check_halves(tensor_fit, tensor, "adaptive");
  tensor.knots = PLANISH_KNOTS_UNIFORM;
  check_halves(tensor_fit, tensor, "uniform");
  const auto pht_fit = [](const auto &...given) { return planish::pht_fit_points(given...); };
  check_halves(pht_fit, planish::defaults<planish_pht_options>(), "pht");
}

TEST(OcctStep, PoleOfASphere) {
  const double knots[6] = {0, 0, 0, 1, 1, 1}, w = std::sqrt(0.5);
  const double xs[3] = {1, 1, 0}, ys[3] = {0, 1, 1}, ws[3] = {1, w, 1};
  std::vector<double> points, weights;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      points.insert(points.end(), {xs[j] * xs[i], xs[j] * ys[i], ys[j]});
      weights.push_back(ws[i] * ws[j]);
    }
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tensor_new(3, 2, 2, knots, 6, knots, 6, points.data(), weights.data(), &out), PLANISH_STATUS_OK);
  const TopoDS_Face face = check_file(Surface(out), "pole", PLANISH_UNIT_MILLIMETRE, 1);
  CHECK_NEAR(area(face), M_PI / 2, 1e-6);
}

TEST(OcctStep, ReadsTheNewerSchema) {
  const Surface piece = torus(0.1, 1.4, -0.6, 1.2);
  set_trims(piece, {polygon({0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.9, 0.1}), circle(0.5, 0.5, 0.2, 90)});
  check_file(piece, "torus_242", PLANISH_UNIT_MILLIMETRE, 2, PLANISH_STEP_SCHEMA_AP242);
}

// A whole turn: the sides at the seam lie on each other in space.
TEST(OcctStep, TubeWithASeam) {
  const double knots[12] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, ends[4] = {0, 0, 1, 1}, w = std::sqrt(0.5);
  const double xs[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, ys[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  std::vector<double> points, weights;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 2; ++j) {
      points.insert(points.end(), {xs[i], ys[i], 3.0 * j});
      weights.push_back(i % 2 == 1 ? w : 1);
    }
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tensor_new(3, 2, 1, knots, 12, ends, 4, points.data(), weights.data(), &out), PLANISH_STATUS_OK);
  const TopoDS_Face face = check_file(Surface(out), "tube", PLANISH_UNIT_MILLIMETRE, 1);
  CHECK_NEAR(area(face), 6 * M_PI, 1e-5);
  CHECK_EQUAL(free_edges(face), 2);
}

// Closed rows: both sides of the seam are one edge, and the first and the last row alone are free.
TEST(OcctStep, ClosedSkinHasNoFreeEdgeAlongItsSeam) {
  std::vector<double> points;
  const std::vector<std::size_t> counts = {24, 31, 18, 40};
  for (std::size_t j = 0; j < counts.size(); ++j) {
    const double z = static_cast<double>(j);
    for (std::size_t k = 0; k < counts[j]; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(counts[j]);
      const double radius = 2 + 0.3 * std::sin(z) + 0.1 * std::cos(3 * angle);
      points.insert(points.end(), {radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  planish_skin_options options;
  CHECK_EQUAL(planish_skin_options_init(&options, sizeof options), PLANISH_STATUS_OK);
  options.closed = 1;
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tspline_skin(points.data(), counts.data(), counts.size(), &options, &out, nullptr),
              PLANISH_STATUS_OK);
  const Surface skin(out);
  CHECK_EQUAL(free_edges(check_file(skin, "closed", PLANISH_UNIT_MILLIMETRE, 1)), 2);
  planish_step_options step;
  CHECK_EQUAL(planish_step_options_init(&step, sizeof step), PLANISH_STATUS_OK);
  step.form = PLANISH_STEP_FORM_STRIPS;
  CHECK_EQUAL(planish_surface_write_step(skin.get(), "occt_closed_strips.step", &step), PLANISH_STATUS_OK);
  const TopoDS_Shape strips = read("occt_closed_strips.step");
  CHECK(BRepCheck_Analyzer(strips).IsValid());
  CHECK_EQUAL(count(strips, TopAbs_FACE), 3);
  CHECK_EQUAL(free_edges(strips), 2);
}

// Sections of a bent, tapered trough: one face for all, or one for each pair of rows, of one area.
TEST(OcctStep, TSplineWholeAndInStrips) {
  std::vector<double> points;
  const std::vector<std::size_t> counts = {21, 34, 15, 27, 40};
  for (std::size_t j = 0; j < counts.size(); ++j) {
    const double x = static_cast<double>(j);
    for (std::size_t k = 0; k < counts[j]; ++k) {
      const double angle = M_PI * static_cast<double>(k) / static_cast<double>(counts[j] - 1);
      const double radius = 2 - 0.2 * x + 0.1 * std::sin(5 * angle);
      points.insert(points.end(), {x, radius * std::cos(angle), 0.1 * x * x - radius * std::sin(angle)});
    }
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tspline_skin(points.data(), counts.data(), counts.size(), nullptr, &out, nullptr),
              PLANISH_STATUS_OK);
  const Surface skin(out);
  check_file(skin, "tspline", PLANISH_UNIT_MILLIMETRE, 1);
  check_shell(skin, "strips", PLANISH_STEP_FORM_STRIPS, 1);
  double domain[4];
  CHECK_EQUAL(planish_surface_domain(skin.get(), domain), PLANISH_STATUS_OK);
  const double u = (domain[0] + domain[1]) / 2, v = (domain[2] + domain[3]) / 2;
  const double width = domain[1] - domain[0], height = domain[3] - domain[2];
  const auto box = [&](double share) {
    const double a = share * width, b = share * height;
    return polygon({u - a, v - b, u + a, v - b, u + a, v + b, u - a, v + b});
  };
  set_trims(skin, {box(0.45), circle(u, v, 0.2 * std::fmin(width, height), 60)});
  check_shell(skin, "strips", PLANISH_STEP_FORM_STRIPS, 2);
}

double ridge(double u, double v) { return shapes::wave(u, v) + 0.05 * std::tanh(30 * (u + 0.4 * v - 0.6)); }

// Faces of unlike size side by side, with the trims of the mesh and with others.
TEST(OcctStep, PhtSplineAsAShell) {
  const Mesh mesh = made(shapes::graph(60, 60, 0.2, 7, true, ridge));
  planish_pht_options options;
  CHECK_EQUAL(planish_pht_options_init(&options, sizeof options), PLANISH_STATUS_OK);
  options.tolerance = 2e-4;
  planish_surface *out = nullptr;
  CHECK(planish_pht_fit(mesh.get(), &options, &out, nullptr) >= 0);
  const Surface pht(out);
  check_shell(pht, "pht", PLANISH_STEP_FORM_PATCHES, 2);
  set_trims(pht, {circle(0.5, 0.5, 0.499, 200), circle(0.375, 0.6, 0.1, 30), circle(0.625, 0.5, 1e-3, 12)});
  check_shell(pht, "pht_trims", PLANISH_STEP_FORM_PATCHES, 3);
  set_trims(pht, {});
  check_shell(pht, "pht_whole", PLANISH_STEP_FORM_PATCHES, 1);
}

// Knots as OpenCASCADE takes them: each once, and how often.
struct knot_table {
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger counts;

  static std::size_t different(const std::vector<double> &all) {
    std::size_t count = 1;
    for (std::size_t k = 1; k < all.size(); ++k) count += all[k] != all[k - 1];
    return count;
  }

  explicit knot_table(const std::vector<double> &all)
      : knots(1, static_cast<int>(different(all))), counts(1, static_cast<int>(different(all))) {
    counts.Init(0);
    int at = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k == 0 || all[k] != all[k - 1]) knots.SetValue(++at, all[k]);
      counts.SetValue(at, counts.Value(at) + 1);
    }
  }
};

Handle(Geom_BSplineCurve) curve_of(const planish::curve &curve) {
  const std::vector<double> points = curve.control_points();
  TColgp_Array1OfPnt poles(1, static_cast<int>(curve.control_point_count()));
  for (int k = 0; k < poles.Length(); ++k) {
    poles.SetValue(k + 1, gp_Pnt(points[3 * k], points[3 * k + 1], points[3 * k + 2]));
  }
  const knot_table table(curve.knots());
  return new Geom_BSplineCurve(poles, table.knots, table.counts, static_cast<int>(curve.degree()));
}

Handle(Geom2d_BSplineCurve) pcurve_of(const planish::curve &curve) {
  const std::vector<double> points = curve.control_points();
  TColgp_Array1OfPnt2d poles(1, static_cast<int>(curve.control_point_count()));
  for (int k = 0; k < poles.Length(); ++k) poles.SetValue(k + 1, gp_Pnt2d(points[2 * k], points[2 * k + 1]));
  const knot_table table(curve.knots());
  return new Geom2d_BSplineCurve(poles, table.knots, table.counts, static_cast<int>(curve.degree()));
}

Handle(Geom_BSplineSurface) surface_of(const planish_surface *surface) {
  const auto knots = [&](std::uint32_t axis) {
    std::vector<double> all(planish_tensor_knot_count(surface, axis));
    CHECK_EQUAL(planish_tensor_copy_knots(surface, axis, all.data(), all.size()), PLANISH_STATUS_OK);
    return all;
  };
  const std::size_t count_u = planish_tensor_control_point_count(surface, PLANISH_AXIS_U);
  const std::size_t count_v = planish_tensor_control_point_count(surface, PLANISH_AXIS_V);
  std::vector<double> points(3 * count_u * count_v);
  CHECK_EQUAL(planish_tensor_copy_control_points(surface, points.data(), count_u * count_v),
              PLANISH_STATUS_OK);
  TColgp_Array2OfPnt poles(1, static_cast<int>(count_u), 1, static_cast<int>(count_v));
  for (std::size_t i = 0; i < count_u; ++i) {
    for (std::size_t j = 0; j < count_v; ++j) {
      const double *p = &points[3 * (i * count_v + j)];
      poles.SetValue(static_cast<int>(i + 1), static_cast<int>(j + 1), gp_Pnt(p[0], p[1], p[2]));
    }
  }
  const knot_table u(knots(PLANISH_AXIS_U)), v(knots(PLANISH_AXIS_V));
  return new Geom_BSplineSurface(poles, u.knots, v.knots, u.counts, v.counts,
                                 static_cast<int>(planish_tensor_degree(surface, PLANISH_AXIS_U)),
                                 static_cast<int>(planish_tensor_degree(surface, PLANISH_AXIS_V)));
}

// A shell of a model's arrays alone: vertices, edges with their p-curves, wires, faces.
TopoDS_Shape rebuilt(const planish::model &model) {
  BRep_Builder builder;
  std::vector<TopoDS_Vertex> vertices;
  for (const planish::point3 &p : model.vertices()) {
    vertices.push_back(BRepBuilderAPI_MakeVertex(gp_Pnt(p[0], p[1], p[2])).Vertex());
  }
  std::vector<TopoDS_Edge> edges;
  for (std::size_t k = 0; k < model.edge_count(); ++k) {
    const planish_edge_info info = model.edge_info(k);
    edges.push_back(
        BRepBuilderAPI_MakeEdge(curve_of(model.edge(k)), vertices[info.vertex_start], vertices[info.vertex_end]).Edge());
  }
  TopoDS_Compound all;
  builder.MakeCompound(all);
  const double tolerance = model.measure().curve_deviation + 1e-7;
  for (std::size_t k = 0; k < model.face_count(); ++k) {
    const Handle(Geom_BSplineSurface) surface = surface_of(model.face(k).get());
    TopoDS_Face face;
    builder.MakeFace(face, surface, tolerance);
    std::size_t place = 0;
    for (const auto &loop : model.loops(k)) {
      TopoDS_Wire wire;
      builder.MakeWire(wire);
      for (const auto &coedge : loop) {
        TopoDS_Edge edge = edges[coedge.edge];
        builder.UpdateEdge(edge, pcurve_of(model.pcurve(k, place++)), face, tolerance);
        builder.Add(wire, coedge.is_forward ? edge : TopoDS::Edge(edge.Reversed()));
      }
      wire.Closed(true);
      builder.Add(face, wire);
    }
    builder.Add(all, face);
  }
  return all;
}

// A kernel needs no file: the model's arrays are enough.
TEST(OcctModel, IsRebuiltFromArrays) {
  const Mesh mesh = made(shapes::graph(60, 60, 0.2, 7, true, ridge));
  planish_surface *tensor = nullptr, *pht = nullptr;
  CHECK(planish_tensor_fit(mesh.get(), nullptr, &tensor, nullptr) >= 0);
  CHECK(planish_pht_fit(mesh.get(), nullptr, &pht, nullptr) >= 0);
  const Surface surfaces[2] = {Surface(tensor), Surface(pht)};
  for (const Surface &surface : surfaces) {
    planish_model *out = nullptr;
    CHECK_EQUAL(planish_model_from_surface(surface.get(), &out), PLANISH_STATUS_OK);
    const planish::model model(out);
    const TopoDS_Shape shape = rebuilt(model);
    CHECK(BRepCheck_Analyzer(shape).IsValid());
    CHECK_EQUAL(static_cast<std::size_t>(count(shape, TopAbs_FACE)), model.face_count());
    model.write_step("occt_model.step");
    const TopoDS_Shape by_file = read("occt_model.step");
    const double found = area(shape), through = area(by_file), own = model.measure().area;
    CHECK_NEAR(found / through, 1.0, 1e-9);
    CHECK_NEAR(found / own, 1.0, 1e-5);
    std::printf("%zu faces, %zu edges rebuilt: area %.12g, through a file %.12g, own %.12g\n", model.face_count(),
                model.edge_count(), found, through, own);
  }
}

// A torus of radii 2 and 0.7, its triangles counterclockwise seen from outside; with bumps.
planish::mesh torus_mesh(int around, int across, double bumps) {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * M_PI * i / around, b = 2 * M_PI * j / across;
      const double tube = 0.7 * (1 + bumps * std::sin(3 * a) * std::cos(2 * b)), ring = 2 + tube * std::cos(b);
      points.insert(points.end(), {ring * std::cos(a), ring * std::sin(a), tube * std::sin(b)});
      const auto node = [&](int k, int l) {
        return static_cast<std::uint32_t>((i + k) % around * across + (j + l) % across);
      };
      triangles.insert(triangles.end(), {node(0, 0), node(1, 0), node(1, 1), node(0, 0), node(1, 1), node(0, 1)});
    }
  }
  planish_mesh *made = nullptr;
  CHECK_EQUAL(planish_mesh_new(points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, nullptr, &made),
              PLANISH_STATUS_OK);
  return planish::mesh(made);
}

// A fitted solid as OpenCASCADE reads it: valid, without a free edge, with the curves and the volume that we have.
void check_solid(const planish::fitted_model &fit, const char *path) {
  fit.model.write_step(path);
  const TopoDS_Shape shape = read(path);
  CHECK(!shape.IsNull());
  if (shape.IsNull()) return;
  CHECK(BRepCheck_Analyzer(shape).IsValid());
  CHECK_EQUAL(count(shape, TopAbs_SOLID), 1);
  CHECK_EQUAL(static_cast<std::size_t>(count(shape, TopAbs_FACE)), fit.model.face_count());
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  CHECK_EQUAL(static_cast<std::size_t>(faces_of_edges.Extent()), fit.model.edge_count());
  double tolerance = 0;
  for (int k = 1; k <= faces_of_edges.Extent(); ++k) {
    CHECK_EQUAL(faces_of_edges(k).Extent(), 2);
    tolerance = std::fmax(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(faces_of_edges.FindKey(k))));
  }
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, 1e-7); // adaptively: a few points a face are off by 4e-5
  CHECK_NEAR(properties.Mass() / fit.report.volume, 1.0, 1e-6);
  CHECK_NEAR(properties.Mass() / fit.report.mesh_volume, 1.0, 1e-2); // flat facets cut off some of a round shape
  CHECK(tolerance <= 2e-7 * fit.report.diagonal);
  std::printf("solid: %zu faces, volume %.9g (own %.9g, mesh %.9g), largest edge tolerance %.2e\n",
              fit.model.face_count(), properties.Mass(), fit.report.volume, fit.report.mesh_volume, tolerance);
}

TEST(OcctModel, ClosedMeshesBecomeSolids) {
  for (const double bumps : {0.0, 0.2}) {
    const planish::mesh mesh = torus_mesh(96, 48, bumps);
    auto options = planish::defaults<planish_model_options>();
    options.thread_count = 2;
    const planish::fitted_model fit = planish::model_fit(mesh, options);
    CHECK_EQUAL(fit.status, PLANISH_STATUS_OK);
    CHECK(fit.report.max_error <= fit.report.tolerance);
    CHECK_EQUAL(fit.report.genus, std::size_t{1});
    CHECK(fit.report.normal_jump <= 1e-10);
    check_solid(fit, "occt_solid.step");
  }
}

// A wall of radius and height 1 on a flat foot, with half a ball on it, as rings of points round the z axis.
planish::mesh dome_mesh(int around) {
  std::vector<double> radii{0.5}, heights{0.0};
  for (int k = 0; k <= 8; ++k) radii.push_back(1.0), heights.push_back(k / 8.0);
  for (int k = 1; k < 12; ++k) {
    radii.push_back(std::cos(k * M_PI / 24));
    heights.push_back(1 + std::sin(k * M_PI / 24));
  }
  const int rings = static_cast<int>(radii.size());
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  const auto node = [&](int ring, int k) { return static_cast<std::uint32_t>(ring * around + k % around); };
  const auto foot = static_cast<std::uint32_t>(rings * around), top = foot + 1;
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      const double a = 2 * M_PI * k / around;
      points.insert(points.end(), {radii[ring] * std::cos(a), radii[ring] * std::sin(a), heights[ring]});
      if (ring == 0) triangles.insert(triangles.end(), {node(0, k + 1), node(0, k), foot});
      if (ring + 1 == rings) {
        triangles.insert(triangles.end(), {node(ring, k), node(ring, k + 1), top});
      } else {
        triangles.insert(triangles.end(), {node(ring, k), node(ring, k + 1), node(ring + 1, k + 1)});
        triangles.insert(triangles.end(), {node(ring, k), node(ring + 1, k + 1), node(ring + 1, k)});
      }
    }
  }
  points.insert(points.end(), {0, 0, 0, 0, 0, 2});
  planish_mesh *made = nullptr;
  CHECK_EQUAL(planish_mesh_new(points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, nullptr, &made),
              PLANISH_STATUS_OK);
  return planish::mesh(made);
}

TEST(OcctModel, PartsKeepTheirSharpEdges) {
  const planish::mesh mesh = dome_mesh(60);
  auto options = planish::defaults<planish_model_options>();
  options.thread_count = 2;
  const planish::fitted_model fit = planish::model_fit(mesh, options);
  CHECK_EQUAL(fit.status, PLANISH_STATUS_OK);
  CHECK(fit.report.max_error <= fit.report.tolerance);
  CHECK(fit.report.normal_jump <= 1e-10);
  // the foot is a plane, which no patch counts
  CHECK(fit.model.face_count() > fit.report.patch_count);
  CHECK(fit.model.measure().sharp_edge_count >= std::size_t{3});
  CHECK_NEAR(fit.report.volume / (M_PI * 5 / 3), 1.0, 5e-4);
  check_solid(fit, "occt_dome.step");
}

int main() { return check::run(); }
