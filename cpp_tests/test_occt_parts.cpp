// A triangulation becomes the body that it came from: OpenCASCADE's bodies are meshed with the number of the face on each
// triangle, fitted, written as STEP and read back.
#include "check.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <planish.hpp>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

namespace {

struct tessellated {
  planish::mesh mesh;
  std::vector<std::uint32_t> labels; // the face under each triangle, from 1
};

tessellated tessellate(const TopoDS_Shape &body, double deflection) {
  BRepMesh_IncrementalMesh(body, deflection, false, 0.3);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(body, TopAbs_FACE, faces);
  std::vector<double> points;
  std::vector<std::uint32_t> triangles, labels;
  for (int number = 1; number <= faces.Extent(); ++number) {
    const TopoDS_Face face = TopoDS::Face(faces(number));
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    CHECK(!mesh.IsNull());
    const std::uint32_t first = static_cast<std::uint32_t>(points.size() / 3);
    for (int k = 1; k <= mesh->NbNodes(); ++k) {
      const gp_Pnt p = mesh->Node(k).Transformed(location.Transformation());
      points.insert(points.end(), {p.X(), p.Y(), p.Z()});
    }
    for (int k = 1; k <= mesh->NbTriangles(); ++k) {
      int a, b, c;
      mesh->Triangle(k).Get(a, b, c);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
      for (const int node : {a, b, c}) triangles.push_back(first + static_cast<std::uint32_t>(node) - 1);
      labels.push_back(static_cast<std::uint32_t>(number));
    }
  }
  auto options = planish::defaults<planish_mesh_options>();
  options.weld_distance = 1e-7;
  planish_mesh *made = nullptr;
  CHECK(planish_mesh_new(points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, &options, &made) >= 0);
  return {planish::mesh(made), labels};
}

double volume(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties, 1e-9);
  return properties.Mass();
}

double area(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties, 1e-9);
  return properties.Mass();
}

std::size_t count(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(shape, kind, parts);
  return static_cast<std::size_t>(parts.Extent());
}

void check_body(const char *name, const TopoDS_Shape &body, double deflection) {
  tessellated given = tessellate(body, deflection);
  auto options = planish::defaults<planish_model_options>();
  options.thread_count = 1;
  options.labels = given.labels.data();
  options.label_count = given.labels.size();
  const planish::fitted_model fit = planish::model_fit(given.mesh, options);
  CHECK_EQUAL(fit.status, PLANISH_STATUS_OK);
  CHECK_EQUAL(fit.report.exact_face_count, count(body, TopAbs_FACE));
  CHECK_EQUAL(fit.report.patch_count, std::size_t{0});
  const std::string path = std::string("occt_part_") + name + ".step";
  fit.model.write_step(path.c_str());
  Message::DefaultMessenger()->ChangePrinters().Clear(); // the reader tells statistics
  STEPControl_Reader reader;
  CHECK(reader.ReadFile(path.c_str()) == IFSelect_RetDone);
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  CHECK(!shape.IsNull());
  if (shape.IsNull()) return;
  CHECK(BRepCheck_Analyzer(shape).IsValid());
  CHECK_EQUAL(count(shape, TopAbs_SOLID), std::size_t{1});
  CHECK_EQUAL(count(shape, TopAbs_FACE), count(body, TopAbs_FACE));
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edges);
  double tolerance = 0;
  for (int k = 1; k <= faces_of_edges.Extent(); ++k) {
    CHECK_EQUAL(faces_of_edges(k).Extent(), 2); // a seam has its face twice
    tolerance = std::fmax(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(faces_of_edges.FindKey(k))));
  }
  CHECK(tolerance <= 1e-7 * std::fmax(1.0, fit.report.diagonal));
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next()) {
    const GeomAbs_SurfaceType type = BRepAdaptor_Surface(TopoDS::Face(it.Current())).GetType();
    CHECK(type == GeomAbs_Plane || type == GeomAbs_Cylinder);
  }
  CHECK_NEAR(volume(shape) / volume(body), 1.0, 1e-6);
  CHECK_NEAR(area(shape) / area(body), 1.0, 1e-6);
  // from a face to its label and back: each label is one face
  std::set<std::uint32_t> labels;
  for (std::size_t face = 0; face < fit.model.face_count(); ++face) labels.insert(fit.model.face_info(face).label);
  CHECK_EQUAL(labels.size(), fit.model.face_count());
  std::printf("%s: %zu triangles, %zu faces, volume %.12g of %.12g, edge tolerance %.1e, %.3f s\n", name,
              given.labels.size(), fit.model.face_count(), volume(shape), volume(body), tolerance, fit.report.seconds);
}

TopoDS_Shape drilled(const TopoDS_Shape &body, const gp_Pnt &at, const gp_Dir &along, double radius) {
  return BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeCylinder(gp_Ax2(at, along), radius, 1000).Shape()).Shape();
}

} // namespace

TEST(OcctParts, ABlockWithAHole) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 30, 20, 10).Shape();
  check_body("hole", drilled(block, gp_Pnt(12, 9, -100), gp_Dir(0, 0, 1), 5), 0.05);
}

TEST(OcctParts, ABracketWithTwoHoles) {
  TopoDS_Shape body = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 40, 20, 30).Shape(),
                                      BRepPrimAPI_MakeBox(gp_Pnt(5, -1, 5), 40, 22, 30).Shape())
                          .Shape();
  body = drilled(body, gp_Pnt(25, 10, -100), gp_Dir(0, 0, 1), 4);
  check_body("bracket", drilled(body, gp_Pnt(-100, 10, 18), gp_Dir(1, 0, 0), 3), 0.05);
}

TEST(OcctParts, AFlangeWithSixHoles) {
  TopoDS_Shape body = BRepPrimAPI_MakeCylinder(20, 5).Shape();
  for (int k = 0; k < 6; ++k) {
    const double angle = k * M_PI / 3;
    body = drilled(body, gp_Pnt(14 * std::cos(angle), 14 * std::sin(angle), -100), gp_Dir(0, 0, 1), 2);
  }
  check_body("flange", drilled(body, gp_Pnt(0, 0, -100), gp_Dir(0, 0, 1), 7), 0.05);
}

TEST(OcctParts, ABlockWithRoundUprights) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 30, 20, 10).Shape();
  BRepFilletAPI_MakeFillet fillet(block);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(block, TopAbs_EDGE, edges);
  for (int k = 1; k <= edges.Extent(); ++k) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(k));
    double from, to;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, from, to);
    if (std::abs(curve->Value(from).Z() - curve->Value(to).Z()) > 5) fillet.Add(4, edge);
  }
  check_body("rounded", fillet.Shape(), 0.05);
}

TEST(OcctParts, LabelsThatAreTooFewOrAnAngleOutOfRangeAreRefused) {
  const tessellated given = tessellate(BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 3, 2, 1).Shape(), 0.1);
  auto options = planish::defaults<planish_model_options>();
  options.labels = given.labels.data();
  options.label_count = given.labels.size() - 1;
  planish_model *model = nullptr;
  CHECK_EQUAL(planish_model_fit(given.mesh.get(), &options, &model, nullptr), PLANISH_STATUS_INVALID_ARGUMENT);
  options.label_count = given.labels.size();
  options.label_angle = 4;
  CHECK_EQUAL(planish_model_fit(given.mesh.get(), &options, &model, nullptr), PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(model == nullptr);
}

int main() { return check::run(); }
