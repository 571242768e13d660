// planish_mesh from outside: what goes in comes out, and what must not go in is refused by name.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using shapes::arrays;

static const double nan_ = std::numeric_limits<double>::quiet_NaN();

// The unit square of two triangles.
static const double square_points[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const std::uint32_t square_triangles[6] = {0, 1, 2, 0, 2, 3};

static Mesh make(const std::vector<double> &points, const std::vector<std::uint32_t> &triangles,
                 const planish_mesh_options *options = nullptr) {
  planish_mesh *mesh = nullptr;
  const planish_status status = planish_mesh_new(points.data(), points.size() / 3, triangles.data(),
                                                 triangles.size() / 3, options, &mesh);
  CHECK(status >= 0);
  return Mesh(mesh);
}

static Mesh make(const arrays &all) { return make(all.points, all.triangles); }

static Mesh square() {
  return make(std::vector<double>(square_points, square_points + 12),
              std::vector<std::uint32_t>(square_triangles, square_triangles + 6));
}

static Mesh tetrahedron() { return make({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}); }

// planish_mesh_new refuses the arrays and leaves the handle alone.
static void check_refused(const std::vector<double> &points, const std::vector<std::uint32_t> &triangles,
                          planish_status status, long long index, const char *words,
                          const planish_mesh_options *options = nullptr) {
  planish_mesh *mesh = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_new(points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, options,
                               &mesh),
              status, index, words);
  CHECK(mesh == sentinel<planish_mesh>());
}

TEST(Version, HeaderLibraryAndCargoAgree) {
  CHECK(std::string(planish_version()) == PLANISH_VERSION);
  CHECK(std::string(planish_version()) == EXPECTED_VERSION);
}

TEST(Status, EachHasItsName) {
  CHECK(std::string(planish_status_name(PLANISH_STATUS_OK)) == "PLANISH_STATUS_OK");
  CHECK(std::string(planish_status_name(PLANISH_STATUS_FOLDED_PARAMETERS)) == "PLANISH_STATUS_FOLDED_PARAMETERS");
  CHECK(std::string(planish_status_name(PLANISH_STATUS_INTERNAL)) == "PLANISH_STATUS_INTERNAL");
  for (std::int32_t status = PLANISH_STATUS_INTERNAL; status <= PLANISH_STATUS_NOT_PROVEN; ++status) {
    CHECK(std::string(planish_status_name(status)).rfind("PLANISH_STATUS_", 0) == 0);
  }
  CHECK(std::string(planish_status_name(PLANISH_STATUS_INTERNAL - 1)) == "unknown status");
  CHECK(std::string(planish_status_name(1000)) == "unknown status");
}

TEST(ErrorMessage, IsCutOffAndTerminated) {
  planish_mesh *mesh = nullptr;
  CHECK_FAILS(planish_mesh_new(nullptr, 1, square_triangles, 2, nullptr, &mesh), PLANISH_STATUS_NULL_POINTER, -1,
              "points is NULL");
  const std::size_t length = planish_error_message(nullptr, 0);
  CHECK_EQUAL(length, std::string("points is NULL").size());
  char text[8] = "#######";
  CHECK_EQUAL(planish_error_message(text, 0), length);
  CHECK(text[0] == '#'); // no room, not even for the end
  CHECK_EQUAL(planish_error_message(text, 7), length);
  CHECK(std::string(text) == "points");
  CHECK_EQUAL(planish_error_message(text, 1), length);
  CHECK(text[0] == '\0');
}

TEST(ErrorMessage, BelongsToTheThread) {
  planish_mesh *mesh = nullptr;
  CHECK(planish_mesh_new(nullptr, 1, square_triangles, 2, nullptr, &mesh) == PLANISH_STATUS_NULL_POINTER);
  std::size_t elsewhere = 1;
  std::int64_t index = 0;
  std::thread([&] {
    elsewhere = planish_error_message(nullptr, 0);
    index = planish_error_index();
  }).join();
  CHECK_EQUAL(elsewhere, 0u);
  CHECK_EQUAL(index, -1);
  CHECK(check::last_sentence() == "points is NULL");
}

TEST(MeshNew, KeepsWhatWasGiven) {
  const arrays all = shapes::graph(7, 5, 0.2, 1, true);
  const Mesh mesh = make(all);
  CHECK_EQUAL(planish_mesh_point_count(mesh.get()), all.point_count());
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), all.triangle_count());
  std::vector<double> points(all.points.size());
  std::vector<std::uint32_t> triangles(all.triangles.size());
  CHECK(planish_mesh_copy_points(mesh.get(), points.data(), all.point_count()) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_triangles(mesh.get(), triangles.data(), all.triangle_count()) == PLANISH_STATUS_OK);
  CHECK(points == all.points);
  CHECK(triangles == all.triangles);
}

TEST(MeshNew, KnowsItsTopology) {
  const Mesh annulus = make(shapes::graph(7, 7, 0.0, 1, true));
  CHECK_EQUAL(planish_mesh_loop_count(annulus.get()), 2u);
  CHECK_EQUAL(planish_mesh_component_count(annulus.get()), 1u);
  CHECK_EQUAL(planish_mesh_genus(annulus.get()), 0u);
  CHECK_EQUAL(planish_mesh_euler_characteristic(annulus.get()), 0);
  CHECK_EQUAL(planish_mesh_loop_point_count(annulus.get(), 0), 24u);
  CHECK_EQUAL(planish_mesh_loop_point_count(annulus.get(), 1), 8u);
  CHECK_EQUAL(planish_mesh_loop_point_count(annulus.get(), 2), 0u);

  const Mesh closed = tetrahedron();
  CHECK_EQUAL(planish_mesh_loop_count(closed.get()), 0u);
  CHECK_EQUAL(planish_mesh_edge_count(closed.get()), 6u);
  CHECK_EQUAL(planish_mesh_euler_characteristic(closed.get()), 2);
}

TEST(MeshNew, LoopsRunWithTheSurfaceOnTheirLeft) {
  const Mesh mesh = square();
  std::uint32_t nodes[4];
  CHECK(planish_mesh_copy_loop(mesh.get(), 0, nodes, 4) == PLANISH_STATUS_OK);
  for (int i = 0; i < 4; ++i) CHECK_EQUAL(nodes[(i + 1) % 4], (nodes[i] + 1) % 4);
}

TEST(MeshNew, TakesStridesAndAnIndexBase) {
  const double points[] = {0, 0, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9, 0, 1, 0}; // the last row ends with its z
  const std::uint32_t triangles[] = {1, 2, 3, 0, 0, 1, 3, 4};
  planish_mesh_options options = mesh_options();
  options.point_stride = 4;
  options.triangle_stride = 5;
  options.index_base = 1;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points, 4, triangles, 2, &options, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  double found[12];
  std::uint32_t nodes[6];
  CHECK(planish_mesh_copy_points(mesh.get(), found, 4) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_triangles(mesh.get(), nodes, 2) == PLANISH_STATUS_OK);
  CHECK(std::equal(found, found + 12, square_points));
  CHECK(std::equal(nodes, nodes + 6, square_triangles));
}

TEST(MeshNew, WeldsAndSaysSo) {
  // two triangles with nodes of their own along the common edge
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 1e-9, 0, 0, 1, 1, 1e-9, 0, 1, 0};
  planish_mesh_options options = mesh_options();
  options.weld_distance = 1e-6;
  auto repairs = fresh<planish_mesh_repairs>();
  std::uint32_t node_map[6];
  options.out_repairs = &repairs;
  options.out_node_map = node_map;
  planish_mesh *raw = nullptr;
  const std::uint32_t triangles[6] = {0, 1, 2, 3, 4, 5};
  CHECK(planish_mesh_new(points.data(), 6, triangles, 2, &options, &raw) == PLANISH_STATUS_INPUT_REPAIRED);
  const Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_point_count(mesh.get()), 4u);
  CHECK_EQUAL(repairs.welded_node_count, 2u);
  CHECK_EQUAL(repairs.dropped_triangle_count, 0u);
  CHECK_EQUAL(repairs.flipped_triangle_count, 0u);
  CHECK_EQUAL(repairs.missing_end, 0u);
  CHECK(node_map[3] == node_map[0] && node_map[4] == node_map[2] && node_map[5] < 4);
}

TEST(MeshNew, OrientsUnlessToldNotTo) {
  const std::vector<double> points(square_points, square_points + 12);
  const std::vector<std::uint32_t> turned = {0, 1, 2, 0, 3, 2};
  planish_mesh_options options = mesh_options();
  options.repair = PLANISH_MESH_REPAIR_NONE;
  check_refused(points, turned, PLANISH_STATUS_TOPOLOGY, 1, "same direction", &options);
  options.orient = 1; // whatever repair says
  auto repairs = fresh<planish_mesh_repairs>();
  options.out_repairs = &repairs;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points.data(), 4, turned.data(), 2, &options, &raw) == PLANISH_STATUS_INPUT_REPAIRED);
  const Mesh mesh(raw);
  CHECK_EQUAL(repairs.flipped_triangle_count, 1u);
}

TEST(MeshNew, RefusesByName) {
  const std::vector<double> points(square_points, square_points + 12);
  const std::vector<std::uint32_t> triangles(square_triangles, square_triangles + 6);
  planish_mesh_options none = mesh_options();
  none.repair = PLANISH_MESH_REPAIR_NONE;
  check_refused({0, 0, 0, 1, 0, 0, nan_, 1, 0, 0, 1, 0}, triangles, PLANISH_STATUS_NOT_FINITE, 2, "node 2");
  check_refused({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, -HUGE_VAL}, triangles, PLANISH_STATUS_NOT_FINITE, 3, "node 3");
  check_refused(points, {0, 1, 2, 0, 2, 7}, PLANISH_STATUS_INDEX, 1, "refers to node 7");
  check_refused(points, {0, 1, 2, 0, 3, 3}, PLANISH_STATUS_DEGENERATE, 1, "node 3 twice", &none);
  check_refused(points, {0, 1, 2, 2, 0, 1}, PLANISH_STATUS_TOPOLOGY, 1, "same nodes as triangle 0", &none);
  check_refused({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0}, {0, 1, 2, 1, 0, 3, 0, 1, 4}, PLANISH_STATUS_TOPOLOGY, 0,
                "between nodes 0 and 1 has 3 triangles");
}

TEST(MeshNew, RefusesOptionsOutOfRange) {
  planish_mesh *mesh = sentinel<planish_mesh>();
  const auto refuse = [&](const planish_mesh_options &options, planish_status status, const char *words) {
    CHECK_FAILS(planish_mesh_new(square_points, 4, square_triangles, 2, &options, &mesh), status, -1, words);
    CHECK(mesh == sentinel<planish_mesh>());
  };
  planish_mesh_options options = mesh_options();
  options.point_stride = 2;
  refuse(options, PLANISH_STATUS_INVALID_ARGUMENT, "point_stride is 2, it must be 0 or at least 3");
  options = mesh_options();
  options.triangle_stride = 1;
  refuse(options, PLANISH_STATUS_INVALID_ARGUMENT, "triangle_stride is 1");
  options = mesh_options();
  options.weld_distance = -1;
  refuse(options, PLANISH_STATUS_INVALID_ARGUMENT, "weld distance -1");
  options = mesh_options();
  options.orient = 2;
  refuse(options, PLANISH_STATUS_INVALID_ARGUMENT, "orient is 2");
  options = mesh_options();
  options.weld_distance = 100;
  refuse(options, PLANISH_STATUS_DEGENERATE, "over the distance 100");
}

TEST(MeshNew, MendsAndSaysSo) {
  // two triangles that touch in node 2, the second twice, a node that nobody needs, and a triangle of two nodes
  const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 2, 2, 0, nan_, 0, 0};
  const std::uint32_t triangles[] = {0, 1, 2, 2, 3, 4, 3, 4, 2, 0, 1, 1};
  planish_mesh_options options = mesh_options();
  auto repairs = fresh<planish_mesh_repairs>();
  options.out_repairs = &repairs;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points, 6, triangles, 4, &options, &raw) == PLANISH_STATUS_INPUT_REPAIRED);
  const Mesh mesh(raw);
  CHECK_EQUAL(repairs.unused_node_count, 1u);
  CHECK_EQUAL(repairs.split_node_count, 1u);
  CHECK_EQUAL(repairs.duplicate_triangle_count, 1u);
  CHECK_EQUAL(repairs.dropped_triangle_count, 1u);
  CHECK_EQUAL(repairs.parted_edge_count, 0u);
  CHECK_EQUAL(repairs.excluded_triangle_count, 0u);
  std::uint32_t nodes[7], faces[2];
  CHECK(planish_mesh_copy_node_map(mesh.get(), nodes, 7) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_triangle_map(mesh.get(), faces, 2) == PLANISH_STATUS_OK);
  for (std::uint32_t i = 0; i < 6; ++i) CHECK_EQUAL(nodes[i], i);
  CHECK(nodes[6] == 2 && faces[0] == 0 && faces[1] == 1);
}

TEST(MeshNew, RefusesOneByOneWhatIsNotMended) {
  const struct {
    std::uint32_t repair;
    planish_status status;
    const char *words;
  } cases[] = {{PLANISH_MESH_REPAIR_REPEATED_CORNERS, PLANISH_STATUS_DEGENERATE, "'corners'"},
               {PLANISH_MESH_REPAIR_DUPLICATE_TRIANGLES, PLANISH_STATUS_TOPOLOGY, "'copies'"},
               {PLANISH_MESH_REPAIR_UNUSED_NODES, PLANISH_STATUS_TOPOLOGY, "'unused'"},
               {PLANISH_MESH_REPAIR_TOUCHING_NODES, PLANISH_STATUS_TOPOLOGY, "'touching'"},
               {PLANISH_MESH_REPAIR_SHEETS, PLANISH_STATUS_TOPOLOGY, "'sheets'"}};
  const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 2, 2, 0, 9, 0, 0, 0, 0, 1, 0, 0, 2};
  const std::uint32_t triangles[] = {0, 1, 2, 2, 3, 4, 3, 4, 2, 0, 1, 1, 0, 1, 6, 0, 1, 7};
  planish_mesh *mesh = sentinel<planish_mesh>();
  planish_mesh_options options = mesh_options();
  for (const auto &each : cases) {
    options.repair = PLANISH_MESH_REPAIR_ALL - each.repair;
    CHECK(planish_mesh_new(points, 8, triangles, 6, &options, &mesh) == each.status);
    char text[256];
    planish_error_message(text, sizeof text);
    CHECK(std::strstr(text, each.words) != nullptr);
    CHECK(mesh == sentinel<planish_mesh>());
  }
  options.repair = PLANISH_MESH_REPAIR_ALL;
  CHECK(planish_mesh_new(points, 8, triangles, 6, &options, &mesh) == PLANISH_STATUS_INPUT_REPAIRED);
  planish_mesh_free(mesh);
  mesh = sentinel<planish_mesh>();
  options.repair = 2 * PLANISH_MESH_REPAIR_SHEETS;
  CHECK_FAILS(planish_mesh_new(points, 8, triangles, 6, &options, &mesh), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "repair is 128");
}

TEST(MeshNew, TakesOneComponent) {
  const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 6, 1, 0};
  const std::uint32_t triangles[] = {4, 5, 6, 0, 1, 2, 0, 2, 3};
  planish_mesh_options options = mesh_options();
  auto repairs = fresh<planish_mesh_repairs>();
  options.out_repairs = &repairs;
  options.components = PLANISH_MESH_COMPONENTS_LARGEST;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points, 7, triangles, 3, &options, &raw) == PLANISH_STATUS_OK);
  Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 2u);
  CHECK_EQUAL(planish_mesh_point_count(mesh.get()), 7u);
  CHECK_EQUAL(repairs.excluded_triangle_count, 1u);
  options.components = PLANISH_MESH_COMPONENTS_ONE;
  CHECK(planish_mesh_new(points, 7, triangles, 3, &options, &raw) == PLANISH_STATUS_OK);
  mesh.reset(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 1u);
  raw = sentinel<planish_mesh>();
  options.component = 2;
  CHECK_FAILS(planish_mesh_new(points, 7, triangles, 3, &options, &raw), PLANISH_STATUS_INDEX, 2, "no component 2");
  options.components = 3;
  CHECK_FAILS(planish_mesh_new(points, 7, triangles, 3, &options, &raw), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "components is 3");
}

TEST(MeshNew, TakesQuadsAndPolygons) {
  const std::uint32_t quad[] = {0, 1, 2, 3};
  planish_mesh_options options = mesh_options();
  options.corner_count = 4;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(square_points, 4, quad, 1, &options, &raw) == PLANISH_STATUS_OK);
  Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 2u);
  std::uint32_t faces[2];
  CHECK(planish_mesh_copy_triangle_map(mesh.get(), faces, 2) == PLANISH_STATUS_OK);
  CHECK(faces[0] == 0 && faces[1] == 0);

  const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0.5, 0};
  const std::uint32_t corners[] = {1, 2, 3, 4, 2, 5, 3}, sizes[] = {4, 3};
  options = mesh_options();
  options.face_sizes = sizes;
  options.index_base = 1;
  CHECK(planish_mesh_new(points, 5, corners, 2, &options, &raw) == PLANISH_STATUS_OK);
  mesh.reset(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 3u);

  raw = sentinel<planish_mesh>();
  const std::uint32_t small[] = {4, 2};
  options.face_sizes = small;
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT;
  CHECK_FAILS(planish_mesh_new(points, 5, corners, 2, &options, &raw), invalid, -1, "face 1 has 2 corners");
  options.face_sizes = sizes;
  options.triangle_stride = 4;
  CHECK_FAILS(planish_mesh_new(points, 5, corners, 2, &options, &raw), invalid, -1, "triangle_stride is 4");
  options = mesh_options();
  options.corner_count = 2;
  CHECK_FAILS(planish_mesh_new(points, 5, corners, 2, &options, &raw), invalid, -1, "2 corners");
  options.corner_count = 4;
  const std::uint32_t far[] = {0, 1, 2, 9};
  CHECK_FAILS(planish_mesh_new(points, 5, far, 1, &options, &raw), PLANISH_STATUS_INDEX, 0, "node 9");
  CHECK(raw == sentinel<planish_mesh>());
}

TEST(MeshNew, RefusesNullAndNothing) {
  planish_mesh *mesh = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_new(nullptr, 4, square_triangles, 2, nullptr, &mesh), PLANISH_STATUS_NULL_POINTER, -1,
              "points is NULL");
  CHECK_FAILS(planish_mesh_new(square_points, 4, nullptr, 2, nullptr, &mesh), PLANISH_STATUS_NULL_POINTER, -1,
              "triangles is NULL");
  CHECK_FAILS(planish_mesh_new(square_points, 4, square_triangles, 2, nullptr, nullptr), PLANISH_STATUS_NULL_POINTER,
              -1, "out_mesh is NULL");
  CHECK_FAILS(planish_mesh_new(nullptr, 0, square_triangles, 2, nullptr, &mesh), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "no points");
  CHECK_FAILS(planish_mesh_new(square_points, 4, nullptr, 0, nullptr, &mesh), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "no triangles");
  CHECK_FAILS(planish_mesh_new(square_points, SIZE_MAX / 2, square_triangles, 2, nullptr, &mesh),
              PLANISH_STATUS_TOO_LARGE, -1, "more than memory can address");
  CHECK(mesh == sentinel<planish_mesh>());
}

TEST(MeshOptions, OlderAndNewerRecords) {
  // an older program's record ends before the fields that it does not know
  planish_mesh_options options = mesh_options();
  options.struct_size = offsetof(planish_mesh_options, weld_distance);
  options.weld_distance = -1; // not part of it
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(square_points, 4, square_triangles, 2, &options, &raw) == PLANISH_STATUS_OK);
  Mesh mesh(raw);

  // a newer program's record is longer: fine as long as it asks for nothing new
  struct {
    planish_mesh_options known;
    double later;
  } newer;
  CHECK(planish_mesh_options_init(&newer.known, sizeof newer) == PLANISH_STATUS_OK);
  CHECK_EQUAL(newer.known.struct_size, sizeof newer);
  CHECK(newer.later == 0);
  raw = nullptr;
  CHECK(planish_mesh_new(square_points, 4, square_triangles, 2, &newer.known, &raw) == PLANISH_STATUS_OK);
  mesh.reset(raw);
  newer.later = 1;
  raw = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_new(square_points, 4, square_triangles, 2, &newer.known, &raw), PLANISH_STATUS_VERSION, -1,
              "planish_mesh_options");
  CHECK(raw == sentinel<planish_mesh>());

  options.struct_size = 0; // never set
  CHECK_FAILS(planish_mesh_new(square_points, 4, square_triangles, 2, &options, &raw),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "struct_size");
}

TEST(MeshOptions, InitRefusesNullAndNoSize) {
  planish_mesh_options options = mesh_options();
  CHECK_FAILS(planish_mesh_options_init(nullptr, sizeof options), PLANISH_STATUS_NULL_POINTER, -1, "options is NULL");
  const check::untouched before(options);
  CHECK_FAILS(planish_mesh_options_init(&options, 0), PLANISH_STATUS_INVALID_ARGUMENT, -1, "struct_size");
  CHECK_FAILS(planish_mesh_options_init(&options, 13), PLANISH_STATUS_INVALID_ARGUMENT, -1, "struct_size");
  CHECK(before.holds());
}

TEST(MeshRepairs, AreFilledAsFarAsTheirSizeGoes) {
  planish_mesh_options options = mesh_options();
  auto repairs = fresh<planish_mesh_repairs>();
  repairs.struct_size = offsetof(planish_mesh_repairs, dropped_triangle_count);
  const auto beyond = repairs.dropped_triangle_count;
  options.out_repairs = &repairs;
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(square_points, 4, square_triangles, 2, &options, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  CHECK_EQUAL(repairs.welded_node_count, 0u);
  CHECK_EQUAL(repairs.dropped_triangle_count, beyond);
}

// A file that goes away with its test.
class scratch {
 public:
  scratch(const char *name, const std::string &content) : path_(std::string("test_mesh_") + name) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~scratch() { std::remove(path_.c_str()); }
  const char *path() const { return path_.c_str(); }

 private:
  std::string path_;
};

TEST(MeshRead, TakesTextureCoordinatesAsParameters) {
  const scratch file("square.obj",
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 0.25\nvt 0 0.25\n"
                     "f 1/1 2/2 3/3 4/4\n");
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_read(file.path(), nullptr, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 2u);
  CHECK_EQUAL(planish_mesh_has_parameters(mesh.get()), 1u);
  double uv[8];
  CHECK(planish_mesh_copy_parameters(mesh.get(), uv, 4) == PLANISH_STATUS_OK);
  CHECK(uv[4] == 0.5 && uv[5] == 0.25);
}

TEST(MeshRead, KeepsTheFieldsOfPly) {
  const scratch file("field.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "property double pressure\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0 1.5\n1 0 0 2.5\n0 1 0 -3\n3 0 1 2\n");
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_read(file.path(), nullptr, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_field_count(mesh.get()), 1u);
  char name[16];
  CHECK_EQUAL(planish_mesh_field_name(mesh.get(), 0, name, sizeof name), 8u);
  CHECK(std::string(name) == "pressure");
  double values[3];
  CHECK(planish_mesh_copy_field(mesh.get(), "pressure", values, 3) == PLANISH_STATUS_OK);
  CHECK(values[0] == 1.5 && values[1] == 2.5 && values[2] == -3);
}

TEST(MeshRead, RefusesByName) {
  planish_mesh *mesh = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_read("no/such/file.off", nullptr, &mesh), PLANISH_STATUS_FILE, -1, "no/such/file.off");
  const scratch cut("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n");
  CHECK_FAILS(planish_mesh_read(cut.path(), nullptr, &mesh), PLANISH_STATUS_FORMAT, 4, "line 5");
  const scratch alien("alien.txt", "nothing of the kind\n");
  CHECK_FAILS(planish_mesh_read(alien.path(), nullptr, &mesh), PLANISH_STATUS_FORMAT, -1, "none of OFF");
  CHECK_FAILS(planish_mesh_read(nullptr, nullptr, &mesh), PLANISH_STATUS_NULL_POINTER, -1, "path is NULL");
  CHECK_FAILS(planish_mesh_read(cut.path(), nullptr, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_mesh is NULL");
#ifndef _WIN32
  CHECK_FAILS(planish_mesh_read("\xff.off", nullptr, &mesh), PLANISH_STATUS_FILE, -1, "cannot read"); // any bytes
#endif
  CHECK_FAILS(planish_mesh_read("/dev/zero", nullptr, &mesh), PLANISH_STATUS_FILE, -1, "/dev/zero");
  planish_mesh_options small = mesh_options();
  small.max_memory = 10;
  CHECK_FAILS(planish_mesh_read(cut.path(), &small, &mesh), PLANISH_STATUS_TOO_LARGE, -1, "more than the 10 bytes");
  const scratch cloud("cloud.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
  CHECK_FAILS(planish_mesh_read(cloud.path(), nullptr, &mesh), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "3 points but no triangles");
  planish_mesh_options options = mesh_options();
  std::uint32_t node_map = 7;
  options.out_node_map = &node_map;
  CHECK_FAILS(planish_mesh_read(cut.path(), &options, &mesh), PLANISH_STATUS_INVALID_ARGUMENT, -1, "out_node_map");
  CHECK_EQUAL(node_map, 7u);
  CHECK(mesh == sentinel<planish_mesh>());
}

TEST(MeshReadBuffer, TakesWhatTheContentSays) {
  const std::string text = "OFF 4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_read_buffer(text.data(), text.size(), nullptr, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(mesh.get()), 2u);
  raw = sentinel<planish_mesh>();
  planish_mesh_options options = mesh_options();
  options.format = PLANISH_MESH_FORMAT_PLY;
  CHECK_FAILS(planish_mesh_read_buffer(text.data(), text.size(), &options, &raw), PLANISH_STATUS_FORMAT, 0, "'ply'");
  options.format = 5;
  CHECK_FAILS(planish_mesh_read_buffer(text.data(), text.size(), &options, &raw), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "format is 5");
  CHECK_FAILS(planish_mesh_read_buffer("what", 4, nullptr, &raw), PLANISH_STATUS_FORMAT, -1, "none of OFF");
  CHECK_FAILS(planish_mesh_read_buffer(nullptr, 4, nullptr, &raw), PLANISH_STATUS_NULL_POINTER, -1, "buffer is NULL");
  CHECK_FAILS(planish_mesh_read_buffer(nullptr, 0, nullptr, &raw), PLANISH_STATUS_FORMAT, -1, "none of OFF");
  CHECK_FAILS(planish_mesh_read_buffer(text.data(), text.size(), nullptr, nullptr), PLANISH_STATUS_NULL_POINTER, -1,
              "out_mesh is NULL");
  CHECK(raw == sentinel<planish_mesh>());
}

TEST(MeshWrite, ReadsBack) {
  const Mesh mesh = square();
  const double field[4] = {0.1, nan_, 3, 4}, uv[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  CHECK(planish_mesh_set_field(mesh.get(), "p", field, 4) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_set_parameters(mesh.get(), uv, 4) == PLANISH_STATUS_OK);
  for (const char *name : {"written.off", "written.obj", "written.ply", "written.stl"}) {
    const scratch file(name, "old");
    for (std::uint32_t text = 0; text < 2; ++text) {
      planish_mesh_write_options options;
      CHECK(planish_mesh_write_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
      options.text = text;
      CHECK(planish_mesh_write(mesh.get(), file.path(), &options) == PLANISH_STATUS_OK);
      planish_mesh *raw = nullptr;
      CHECK(planish_mesh_read(file.path(), nullptr, &raw) >= 0);
      const Mesh read(raw);
      CHECK_EQUAL(planish_mesh_triangle_count(read.get()), 2u);
      CHECK_EQUAL(planish_mesh_point_count(read.get()), 4u);
      const bool is_stl = std::strstr(name, "stl") != nullptr, is_ply = std::strstr(name, "ply") != nullptr;
      CHECK_EQUAL(planish_mesh_has_parameters(read.get()), is_stl ? 0u : 1u);
      CHECK_EQUAL(planish_mesh_field_count(read.get()), is_ply ? 1u : 0u);
    }
  }
  CHECK_FAILS(planish_mesh_write(mesh.get(), "what.xyz", nullptr), PLANISH_STATUS_INVALID_ARGUMENT, -1, "what.xyz");
  CHECK_FAILS(planish_mesh_write(mesh.get(), "no/such/folder/a.off", nullptr), PLANISH_STATUS_FILE, -1, "no/such");
  CHECK_FAILS(planish_mesh_write(nullptr, "a.off", nullptr), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_write(mesh.get(), nullptr, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "path is NULL");
  planish_mesh_write_options options;
  CHECK_FAILS(planish_mesh_write_options_init(nullptr, sizeof options), PLANISH_STATUS_NULL_POINTER, -1, "options");
  CHECK(planish_mesh_write_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.text = 2;
  CHECK_FAILS(planish_mesh_write(mesh.get(), "a.off", &options), PLANISH_STATUS_INVALID_ARGUMENT, -1, "text is 2");
}

TEST(MeshSetPoints, MovesTheNodes) {
  const Mesh mesh = square();
  const double moved[12] = {0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5};
  CHECK(planish_mesh_set_points(mesh.get(), moved, 4) == PLANISH_STATUS_OK);
  double found[12];
  CHECK(planish_mesh_copy_points(mesh.get(), found, 4) == PLANISH_STATUS_OK);
  CHECK(std::equal(found, found + 12, moved));
  const double bad[12] = {0, 0, 0, nan_};
  CHECK_FAILS(planish_mesh_set_points(mesh.get(), bad, 4), PLANISH_STATUS_NOT_FINITE, 1, "node 1");
  CHECK_FAILS(planish_mesh_set_points(mesh.get(), moved, 3), PLANISH_STATUS_INVALID_ARGUMENT, -1, "3 points");
  CHECK_FAILS(planish_mesh_set_points(mesh.get(), nullptr, 4), PLANISH_STATUS_NULL_POINTER, -1, "points is NULL");
  CHECK_FAILS(planish_mesh_set_points(nullptr, moved, 4), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
}

TEST(MeshMaps, RefuseShortBuffersAndNull) {
  const Mesh mesh = square();
  std::uint32_t numbers[4];
  const auto too_small = PLANISH_STATUS_BUFFER_TOO_SMALL, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_mesh_copy_node_map(mesh.get(), numbers, 3), too_small, -1, "4 are needed");
  CHECK_FAILS(planish_mesh_copy_node_map(mesh.get(), nullptr, 4), null, -1, "out_nodes is NULL");
  CHECK_FAILS(planish_mesh_copy_node_map(nullptr, numbers, 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_triangle_map(mesh.get(), numbers, 1), too_small, -1, "2 are needed");
  CHECK_FAILS(planish_mesh_copy_triangle_map(mesh.get(), nullptr, 2), null, -1, "out_triangles is NULL");
  CHECK_FAILS(planish_mesh_copy_triangle_map(nullptr, numbers, 2), null, -1, "mesh is NULL");
}

TEST(MeshRemoveField, RemovesIt) {
  const Mesh mesh = square();
  const double values[4] = {1, 2, 3, 4};
  CHECK(planish_mesh_set_field(mesh.get(), "p", values, 4) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_remove_field(mesh.get(), "p") == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_mesh_field_count(mesh.get()), 0u);
  CHECK_FAILS(planish_mesh_remove_field(mesh.get(), "p"), PLANISH_STATUS_INVALID_ARGUMENT, -1, "no field 'p'");
  CHECK_FAILS(planish_mesh_remove_field(mesh.get(), nullptr), PLANISH_STATUS_NULL_POINTER, -1, "name is NULL");
  CHECK_FAILS(planish_mesh_remove_field(nullptr, "p"), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
}

TEST(MeshClone, IsDeep) {
  Mesh mesh = square();
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_clone(mesh.get(), &raw) == PLANISH_STATUS_OK);
  const Mesh copy(raw);
  const double uv[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  CHECK(planish_mesh_set_parameters(mesh.get(), uv, 4) == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_mesh_has_parameters(copy.get()), 0u);
  mesh.reset();
  CHECK_EQUAL(planish_mesh_point_count(copy.get()), 4u);
  raw = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_clone(nullptr, &raw), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK(raw == sentinel<planish_mesh>());
  CHECK_FAILS(planish_mesh_clone(copy.get(), nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_mesh is NULL");
}

TEST(MeshFree, AcceptsNull) { planish_mesh_free(nullptr); }

TEST(MeshQueries, AnswerZeroForNull) {
  CHECK_EQUAL(planish_mesh_point_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_triangle_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_edge_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_component_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_genus(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_euler_characteristic(nullptr), 0);
  CHECK_EQUAL(planish_mesh_loop_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_loop_point_count(nullptr, 0), 0u);
  CHECK_EQUAL(planish_mesh_field_count(nullptr), 0u);
  CHECK_EQUAL(planish_mesh_field_name(nullptr, 0, nullptr, 0), 0u);
  CHECK_EQUAL(planish_mesh_has_parameters(nullptr), 0u);
}

TEST(MeshCopy, RefusesShortBuffersAndNull) {
  const Mesh mesh = square();
  std::vector<double> numbers(12, -1.0);
  std::vector<std::uint32_t> nodes(6, 99);
  const check::untouched numbers_before(numbers), nodes_before(nodes);
  const auto too_small = PLANISH_STATUS_BUFFER_TOO_SMALL;
  CHECK_FAILS(planish_mesh_copy_points(mesh.get(), numbers.data(), 3), too_small, -1, "room for 3, 4 are needed");
  CHECK_FAILS(planish_mesh_copy_points(mesh.get(), nullptr, 0), too_small, -1, "room for 0, 4 are needed");
  CHECK_FAILS(planish_mesh_copy_triangles(mesh.get(), nodes.data(), 1), too_small, -1, "room for 1, 2 are needed");
  CHECK_FAILS(planish_mesh_copy_loop(mesh.get(), 0, nodes.data(), 3), too_small, -1, "room for 3, 4 are needed");
  CHECK_FAILS(planish_mesh_copy_loop(mesh.get(), 1, nodes.data(), 6), PLANISH_STATUS_INDEX, 1, "loop 1");

  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_mesh_copy_points(nullptr, numbers.data(), 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_points(mesh.get(), nullptr, 4), null, -1, "out_points is NULL");
  CHECK_FAILS(planish_mesh_copy_triangles(nullptr, nodes.data(), 2), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_triangles(mesh.get(), nullptr, 2), null, -1, "out_triangles is NULL");
  CHECK_FAILS(planish_mesh_copy_loop(nullptr, 0, nodes.data(), 6), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_loop(mesh.get(), 0, nullptr, 6), null, -1, "out_nodes is NULL");
  CHECK(numbers_before.holds());
  CHECK(nodes_before.holds());
}

TEST(MeshField, GoesInAndOut) {
  const Mesh mesh = square();
  const double values[4] = {1, nan_, 3, 4};
  double found[4] = {0, 0, 0, 0};
  CHECK(planish_mesh_set_field(mesh.get(), "p", values, 4) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_field(mesh.get(), "p", found, 4) == PLANISH_STATUS_OK);
  CHECK(std::memcmp(found, values, sizeof values) == 0);

  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const check::untouched before(found, sizeof found);
  CHECK_FAILS(planish_mesh_copy_field(mesh.get(), "q", found, 4), invalid, -1, "no field 'q'");
  CHECK_FAILS(planish_mesh_copy_field(mesh.get(), "p", found, 3), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "4 are needed");
  CHECK_FAILS(planish_mesh_copy_field(nullptr, "p", found, 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_field(mesh.get(), nullptr, found, 4), null, -1, "name is NULL");
  CHECK_FAILS(planish_mesh_copy_field(mesh.get(), "p", nullptr, 4), null, -1, "out_values is NULL");
  CHECK_FAILS(planish_mesh_copy_field(mesh.get(), "\xc3", found, 4), invalid, 0, "not UTF-8");
  CHECK_FAILS(planish_mesh_set_field(nullptr, "p", values, 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_set_field(mesh.get(), nullptr, values, 4), null, -1, "name is NULL");
  CHECK_FAILS(planish_mesh_set_field(mesh.get(), "p", nullptr, 4), null, -1, "values is NULL");
  CHECK_FAILS(planish_mesh_set_field(mesh.get(), "p", values, 0), invalid, -1, "0 values of the field 'p'");
  CHECK_FAILS(planish_mesh_set_field(mesh.get(), "p", values, 3), invalid, -1, "3 values of the field 'p'");
  CHECK(before.holds());
  CHECK_EQUAL(planish_mesh_field_name(mesh.get(), 1, nullptr, 0), 0u);
}

TEST(MeshParameters, GoInAndOut) {
  const Mesh mesh = square();
  const double uv[8] = {0, 0, 2, 0, 2, 1, 0, 1};
  double found[8] = {0};
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_mesh_copy_parameters(mesh.get(), found, 4), invalid, -1, "no parameters");
  CHECK(planish_mesh_set_parameters(mesh.get(), uv, 4) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_parameters(mesh.get(), found, 4) == PLANISH_STATUS_OK);
  CHECK(std::memcmp(found, uv, sizeof uv) == 0);

  const double bad[8] = {0, 0, 2, 0, 2, HUGE_VAL, 0, 1};
  CHECK_FAILS(planish_mesh_set_parameters(mesh.get(), bad, 4), PLANISH_STATUS_NOT_FINITE, 2, "node 2");
  CHECK_FAILS(planish_mesh_set_parameters(mesh.get(), uv, 3), invalid, -1, "3 parameter pairs");
  CHECK_FAILS(planish_mesh_set_parameters(mesh.get(), uv, 0), invalid, -1, "0 parameter pairs");
  CHECK_FAILS(planish_mesh_set_parameters(nullptr, uv, 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_set_parameters(mesh.get(), nullptr, 4), null, -1, "uv is NULL");
  CHECK_FAILS(planish_mesh_copy_parameters(nullptr, found, 4), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_copy_parameters(mesh.get(), nullptr, 4), null, -1, "out_uv is NULL");
  CHECK_FAILS(planish_mesh_copy_parameters(mesh.get(), found, 3), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "4 are needed");
  CHECK(planish_mesh_copy_parameters(mesh.get(), found, 4) == PLANISH_STATUS_OK);
  CHECK(std::memcmp(found, uv, sizeof uv) == 0); // failures changed nothing
}

TEST(MeshParameterize, ReproducesPlanesWithTheirBoundaryKept) {
  arrays all = shapes::graph(13, 9, 0.3, 5, true, [](double u, double v) { return 0.5 * u - 0.25 * v; });
  const Mesh mesh = make(all);
  std::vector<double> start = all.uv;
  CHECK(planish_mesh_set_parameters(mesh.get(), start.data(), all.point_count()) == PLANISH_STATUS_OK);
  planish_parameterize_options options = parameterize_options();
  options.border = PLANISH_BORDER_KEPT;
  options.stretch_steps = 0;
  auto report = fresh<planish_parameterize_report>();
  CHECK(planish_mesh_parameterize(mesh.get(), &options, &report) == PLANISH_STATUS_OK);
  std::vector<double> uv(all.uv.size());
  CHECK(planish_mesh_copy_parameters(mesh.get(), uv.data(), all.point_count()) == PLANISH_STATUS_OK);
  for (std::size_t k = 0; k < uv.size(); ++k) CHECK_NEAR(uv[k], all.uv[k], 1e-13);
  CHECK_EQUAL(report.struct_size, sizeof report);
  CHECK_EQUAL(report.flipped_count + report.degenerate_count, 0u);
  CHECK_EQUAL(report.border, static_cast<std::uint32_t>(PLANISH_BORDER_KEPT));
  CHECK(report.stretch >= 1.0 && report.seconds >= 0.0);
}

TEST(MeshParameterize, CountsFolds) {
  // kept parameters whose middle square is turned inside out by a boundary that crosses itself
  const Mesh mesh = square();
  const double uv[8] = {0, 0, 1, 0, 0, 1, 1, 1};
  CHECK(planish_mesh_set_parameters(mesh.get(), uv, 4) == PLANISH_STATUS_OK);
  planish_parameterize_options options = parameterize_options();
  options.border = PLANISH_BORDER_KEPT;
  auto report = fresh<planish_parameterize_report>();
  CHECK(planish_mesh_parameterize(mesh.get(), &options, &report) == PLANISH_STATUS_FOLDED_PARAMETERS);
  CHECK_EQUAL(report.flipped_count, 1u);
  CHECK((report.remarks & PLANISH_REMARK_FOLDED_PARAMETERS) != 0);
}

TEST(MeshParameterize, RefusesByName) {
  const arrays all = shapes::graph(6, 6, 0.0, 1);
  const Mesh mesh = make(all);
  auto report = fresh<planish_parameterize_report>();
  const check::untouched before(report);
  const auto refuse = [&](planish_mesh *mesh, const planish_parameterize_options &options, planish_status status,
                          long long index, const char *words) {
    CHECK_FAILS(planish_mesh_parameterize(mesh, &options, &report), status, index, words);
    CHECK(before.holds());
    CHECK_EQUAL(planish_mesh_has_parameters(mesh), 0u);
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT;
  planish_parameterize_options options = parameterize_options();
  options.method = 2;
  refuse(mesh.get(), options, invalid, -1, "method is 2");
  options = parameterize_options();
  options.border = 7;
  refuse(mesh.get(), options, invalid, -1, "border is 7");
  options = parameterize_options();
  options.border = PLANISH_BORDER_KEPT;
  refuse(mesh.get(), options, invalid, -1, "no given parameters");
  options = parameterize_options();
  options.border = PLANISH_BORDER_CORNERS; // node 0 four times
  refuse(mesh.get(), options, invalid, 0, "corner node 0");
  options = parameterize_options();
  options.bulge = 0.6;
  refuse(mesh.get(), options, invalid, -1, "bulge is 0.6");
  options = parameterize_options();
  options.boundary_slide = nan_;
  refuse(mesh.get(), options, invalid, -1, "boundary_slide");
  options = parameterize_options();
  options.fill_holes = 2;
  refuse(mesh.get(), options, invalid, -1, "fill_holes is 2");
  options = parameterize_options();
  options.unroll = 2;
  refuse(mesh.get(), options, invalid, -1, "unroll is 2");
  options = parameterize_options();
  options.reserved = 1;
  refuse(mesh.get(), options, PLANISH_STATUS_VERSION, -1, "planish_parameterize_options");
  options = parameterize_options();
  options.thread_count = 2000;
  refuse(mesh.get(), options, invalid, -1, "thread_count is 2000");
  std::vector<double> weights(all.point_count(), 1.0);
  weights[7] = 0.0;
  options = parameterize_options();
  options.node_weights = weights.data();
  refuse(mesh.get(), options, invalid, 7, "node weight 7");

  options = parameterize_options();
  const Mesh closed = tetrahedron();
  refuse(closed.get(), options, PLANISH_STATUS_TOPOLOGY, -1, "closed");
  const Mesh apart = make({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0}, {0, 1, 2, 3, 4, 5});
  refuse(apart.get(), options, PLANISH_STATUS_TOPOLOGY, -1, "2 components");
  const Mesh unused = make({nan_, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {1, 2, 3, 1, 3, 4});
  CHECK(planish_mesh_parameterize(unused.get(), nullptr, nullptr) >= 0); // node 0 is passed over
  double uv[10];
  CHECK(planish_mesh_copy_parameters(unused.get(), uv, 5) == PLANISH_STATUS_OK);
  CHECK(uv[0] == uv[2] && uv[1] == uv[3]); // and gets the parameters of a node that has a place
  const Mesh flat = make({0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2});
  refuse(flat.get(), options, PLANISH_STATUS_DEGENERATE, -1, "zero area");
  CHECK_FAILS(planish_mesh_parameterize(nullptr, nullptr, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK_FAILS(planish_parameterize_options_init(nullptr, sizeof options), PLANISH_STATUS_NULL_POINTER, -1, "options");
}

TEST(MeshParameterize, CanBeCancelled) {
  const Mesh mesh = make(shapes::graph(20, 20, 0.2, 3));
  planish_parameterize_options options = parameterize_options();
  int calls = 0;
  options.user = &calls;
  options.progress = [](double fraction, double, void *user) -> std::int32_t {
    CHECK(fraction >= 0.0 && fraction <= 1.0);
    return ++*static_cast<int *>(user) == 2;
  };
  auto report = fresh<planish_parameterize_report>();
  const check::untouched before(report);
  CHECK_FAILS(planish_mesh_parameterize(mesh.get(), &options, &report), PLANISH_STATUS_CANCELLED, -1, "cancelled");
  CHECK_EQUAL(calls, 2);
  CHECK(before.holds());
  CHECK_EQUAL(planish_mesh_has_parameters(mesh.get()), 0u);
}

TEST(MeshParameterize, DoesNotDependOnThreads) {
  const arrays all = shapes::graph(60, 50, 0.25, 8, true);
  std::vector<std::vector<double>> found;
  for (std::uint32_t threads : {1u, 2u, 5u}) {
    const Mesh mesh = make(all);
    planish_parameterize_options options = parameterize_options();
    options.thread_count = threads;
    CHECK(planish_mesh_parameterize(mesh.get(), &options, nullptr) == PLANISH_STATUS_OK);
    std::vector<double> uv(all.uv.size());
    CHECK(planish_mesh_copy_parameters(mesh.get(), uv.data(), all.point_count()) == PLANISH_STATUS_OK);
    found.push_back(uv);
  }
  CHECK(std::memcmp(found[0].data(), found[1].data(), found[0].size() * sizeof(double)) == 0);
  CHECK(std::memcmp(found[0].data(), found[2].data(), found[0].size() * sizeof(double)) == 0);
}

TEST(MeshCut, RemovesTriangles) {
  const Mesh mesh = square();
  const std::uint32_t gone[] = {1, 2};
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_remove_triangles(mesh.get(), gone, 1, &raw) == PLANISH_STATUS_OK);
  const Mesh rest(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(rest.get()), 1u);
  CHECK_EQUAL(planish_mesh_point_count(rest.get()), 3u);
  raw = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_remove_triangles(mesh.get(), gone, 2, &raw), PLANISH_STATUS_INDEX, 2, "no triangle 2");
  CHECK_FAILS(planish_mesh_remove_triangles(nullptr, gone, 1, &raw), PLANISH_STATUS_NULL_POINTER, -1, "mesh");
  CHECK_FAILS(planish_mesh_remove_triangles(mesh.get(), nullptr, 1, &raw), PLANISH_STATUS_NULL_POINTER, -1, "triangles");
  CHECK_FAILS(planish_mesh_remove_triangles(mesh.get(), gone, 1, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_mesh");
  CHECK(raw == sentinel<planish_mesh>());
  CHECK(planish_mesh_remove_triangles(mesh.get(), nullptr, 0, &raw) == PLANISH_STATUS_OK);
  const Mesh all(raw);
  CHECK_EQUAL(planish_mesh_triangle_count(all.get()), 2u);
}

TEST(MeshCut, OpensAlongThePathThatItFinds) {
  const Mesh closed = tetrahedron();
  std::uint32_t path[4];
  std::size_t count = 0;
  CHECK(planish_mesh_shortest_path(closed.get(), 0, 1, nullptr, 0, &count) == PLANISH_STATUS_OK);
  CHECK_EQUAL(count, 2u);
  CHECK(planish_mesh_shortest_path(closed.get(), 0, 1, nullptr, 4, &count) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_shortest_path(closed.get(), 0, 1, path, 4, &count) == PLANISH_STATUS_OK);
  CHECK(path[0] == 0 && path[1] == 1);
  const std::uint32_t opening[] = {0, 1, 2};
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_cut_along(closed.get(), opening, 3, &raw) == PLANISH_STATUS_OK);
  const Mesh open(raw);
  CHECK_EQUAL(planish_mesh_loop_count(open.get()), 1u);
  CHECK_EQUAL(planish_mesh_euler_characteristic(open.get()), 1);

  raw = sentinel<planish_mesh>();
  const std::uint32_t alien[] = {0, 9};
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), alien, 2, &raw), PLANISH_STATUS_INDEX, 9, "no node 9");
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), opening, 1, &raw), PLANISH_STATUS_INVALID_ARGUMENT, -1, "has 1");
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), nullptr, 0, &raw), PLANISH_STATUS_INVALID_ARGUMENT, -1, "has 0");
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), opening, 2, &raw), PLANISH_STATUS_TOPOLOGY, 0, "opens nothing");
  CHECK_FAILS(planish_mesh_cut_along(nullptr, opening, 3, &raw), PLANISH_STATUS_NULL_POINTER, -1, "mesh");
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), nullptr, 3, &raw), PLANISH_STATUS_NULL_POINTER, -1, "nodes");
  CHECK_FAILS(planish_mesh_cut_along(closed.get(), opening, 3, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_mesh");
  CHECK(raw == sentinel<planish_mesh>());

  count = 77;
  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_mesh_shortest_path(closed.get(), 0, 4, path, 4, &count), PLANISH_STATUS_INDEX, 4, "no node 4");
  CHECK_FAILS(planish_mesh_shortest_path(closed.get(), 0, 1, path, 1, &count), PLANISH_STATUS_BUFFER_TOO_SMALL, -1,
              "2 are needed");
  CHECK_FAILS(planish_mesh_shortest_path(closed.get(), 0, 1, path, 0, &count), PLANISH_STATUS_BUFFER_TOO_SMALL, -1,
              "2 are needed");
  CHECK_FAILS(planish_mesh_shortest_path(nullptr, 0, 1, path, 4, &count), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_shortest_path(closed.get(), 0, 1, path, 4, nullptr), null, -1, "out_count is NULL");
  CHECK_EQUAL(count, 77u);
}

TEST(MeshDecimate, KeepsParametersFieldsAndTopology) {
  const arrays all = shapes::graph(25, 20, 0.2, 3);
  const Mesh mesh = make(all);
  std::vector<double> numbers(500);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
  CHECK(planish_mesh_set_parameters(mesh.get(), all.uv.data(), 500) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_set_field(mesh.get(), "node", numbers.data(), 500) == PLANISH_STATUS_OK);
  planish_decimate_options options;
  CHECK(planish_decimate_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.target_count = 80;
  planish_mesh *raw = nullptr;
  auto report = fresh<planish_decimate_report>();
  CHECK(planish_mesh_decimate(mesh.get(), &options, &raw, &report) == PLANISH_STATUS_OK);
  const Mesh coarse(raw);
  CHECK_EQUAL(planish_mesh_point_count(coarse.get()), 80u);
  CHECK_EQUAL(report.collapse_count, 420u);
  CHECK_EQUAL(report.excess_count, 0u);
  CHECK_EQUAL(report.sharp_edge_count, 0u);
  CHECK_EQUAL(planish_mesh_euler_characteristic(coarse.get()), 1);
  double kept[80], uv[160];
  CHECK(planish_mesh_copy_field(coarse.get(), "node", kept, 80) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_parameters(coarse.get(), uv, 80) == PLANISH_STATUS_OK);
  for (std::size_t i = 0; i < 80; ++i) CHECK(uv[2 * i] == all.uv[2 * static_cast<std::size_t>(kept[i])]);

  raw = sentinel<planish_mesh>();
  report = fresh<planish_decimate_report>();
  const auto null = PLANISH_STATUS_NULL_POINTER, invalid = PLANISH_STATUS_INVALID_ARGUMENT;
  const auto refuse = [&](const planish_decimate_options &given, planish_status status, int index, const char *word) {
    CHECK_FAILS(planish_mesh_decimate(mesh.get(), &given, &raw, &report), status, index, word);
  };
  planish_decimate_options bad = options;
  bad.target_count = 2;
  refuse(bad, invalid, -1, "target_count is 2");
  bad = options;
  bad.sharp_angle = -1;
  refuse(bad, invalid, -1, "sharp_angle is -1");
  bad = options;
  bad.keep_map = 2;
  refuse(bad, invalid, -1, "keep_map is 2");
  bad = options;
  bad.reserved = 1;
  refuse(bad, PLANISH_STATUS_VERSION, -1, "reserved");
  const std::uint32_t *corners = all.triangles.data();
  const std::uint32_t edges[] = {corners[0], corners[1], corners[1], corners[2], 0, 500};
  bad = options;
  bad.sharp_edge_count = 3;
  refuse(bad, null, -1, "sharp_edges is NULL");
  bad.sharp_edges = edges;
  refuse(bad, PLANISH_STATUS_INDEX, 2, "node 500");
  std::uint32_t room[2] = {7, 7};
  bad.sharp_edge_count = 2;
  bad.out_sharp_edges = room;
  refuse(bad, PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "out_sharp_edges has room for 0");
  CHECK(room[0] == 7 && room[1] == 7);
  CHECK_FAILS(planish_mesh_decimate(nullptr, &options, &raw, &report), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_decimate(mesh.get(), &options, nullptr, &report), null, -1, "out_mesh is NULL");
  CHECK_FAILS(planish_decimate_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(raw == sentinel<planish_mesh>());
}

TEST(MeshSphere, MapsAnOctahedron) {
  const Mesh mesh = make({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                         {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5});
  planish_sphere_options options;
  CHECK(planish_sphere_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  CHECK_EQUAL(options.sweeps, 10u);
  options.thread_count = 2;
  double points[18];
  auto report = fresh<planish_sphere_report>();
  CHECK(planish_mesh_map_to_sphere(mesh.get(), &options, points, 6, &report) == PLANISH_STATUS_OK);
  CHECK_EQUAL(report.folded_triangles, 0u);
  CHECK(report.energy >= 4 && report.energy < 13); // 12 for the regular octahedron
  for (int i = 0; i < 6; ++i) {
    const double *p = points + 3 * i;
    CHECK(std::abs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1) < 1e-14);
  }
  double canaries[18];
  std::fill(canaries, canaries + 18, 7.0);
  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_mesh_map_to_sphere(nullptr, &options, canaries, 6, nullptr), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_map_to_sphere(mesh.get(), &options, nullptr, 6, nullptr), null, -1, "out_points is NULL");
  CHECK_FAILS(planish_mesh_map_to_sphere(mesh.get(), &options, canaries, 5, nullptr), PLANISH_STATUS_BUFFER_TOO_SMALL,
              -1, "6 are needed");
  CHECK_FAILS(planish_sphere_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  const Mesh open = make(shapes::graph(6, 6, 0.2, 1));
  CHECK_FAILS(planish_mesh_map_to_sphere(open.get(), nullptr, canaries, 18, nullptr), PLANISH_STATUS_BUFFER_TOO_SMALL, -1,
              "36 are needed");
  std::vector<double> room(108, 7.0);
  CHECK_FAILS(planish_mesh_map_to_sphere(open.get(), nullptr, room.data(), 36, nullptr), PLANISH_STATUS_TOPOLOGY, 0,
              "boundary");
  CHECK(std::all_of(canaries, canaries + 18, [](double x) { return x == 7; }));
  CHECK(std::all_of(room.begin(), room.end(), [](double x) { return x == 7; }));
}

TEST(MeshCut, SplitsComponents) {
  const Mesh mesh = make({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0}, {0, 1, 2, 3, 4, 5});
  planish_mesh *raw[2] = {nullptr, nullptr};
  CHECK(planish_mesh_split_components(mesh.get(), raw, 2) == PLANISH_STATUS_OK);
  const Mesh first(raw[0]), second(raw[1]);
  double x = 0, points[9];
  CHECK(planish_mesh_copy_points(second.get(), points, 3) == PLANISH_STATUS_OK);
  x = points[0];
  CHECK(x == 5);
  raw[0] = raw[1] = sentinel<planish_mesh>();
  CHECK_FAILS(planish_mesh_split_components(mesh.get(), raw, 1), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "2 are needed");
  CHECK_FAILS(planish_mesh_split_components(nullptr, raw, 2), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK_FAILS(planish_mesh_split_components(mesh.get(), nullptr, 2), PLANISH_STATUS_NULL_POINTER, -1, "out_meshes");
  CHECK(raw[0] == sentinel<planish_mesh>() && raw[1] == sentinel<planish_mesh>());
  std::size_t count = 77;
  CHECK_FAILS(planish_mesh_shortest_path(mesh.get(), 0, 3, nullptr, 0, &count), PLANISH_STATUS_TOPOLOGY, 0, "joins");
}

TEST(Mesh, ServesManyThreadsAtOnce) {
  const arrays all = shapes::graph(30, 30, 0.2, 4);
  const Mesh mesh = make(all);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < 50; ++round) {
        std::vector<double> points(all.points.size());
        const auto status = planish_mesh_copy_points(mesh.get(), points.data(), all.point_count());
        const auto failed = planish_mesh_copy_loop(mesh.get(), t + 1, nullptr, 0);
        wrong[t] += status != PLANISH_STATUS_OK || points != all.points || failed != PLANISH_STATUS_INDEX ||
                    planish_error_index() != static_cast<std::int64_t>(t + 1);
      }
    });
  }
  for (auto &thread : threads) thread.join();
  for (int count : wrong) CHECK_EQUAL(count, 0);
}

int main() { return check::run(); }
