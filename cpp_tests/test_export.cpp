// Files and buffers from outside: what is saved comes back to the bit, damage is refused, VTK files are whole.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

static Surface surface_with_everything() {
  const double knots[6] = {0, 0, 0, 1, 1, 1}, ends[4] = {0, 0, 1, 1};
  const double points[18] = {2, 0, 0, 2, 0, 3, 2, 2, 0, 2, 2, 3, 0, 2, 0, 0, 2, 3};
  const double weights[6] = {1, 1, 0.7, 0.7, 1, 1}, trim[6] = {0, 0, 1, 0, 0.5, 1};
  const std::size_t three = 3;
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(3, 2, 1, knots, 6, ends, 4, points, weights, &surface) == PLANISH_STATUS_OK);
  CHECK(planish_surface_set_trims(surface, trim, &three, 1) == PLANISH_STATUS_OK);
  return Surface(surface);
}

static std::vector<std::uint8_t> save(const planish_surface *surface) {
  std::vector<std::uint8_t> bytes(planish_surface_save_size(surface));
  CHECK(planish_surface_save(surface, bytes.data(), bytes.size()) == PLANISH_STATUS_OK);
  return bytes;
}

static std::string content(const char *path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

static planish_vtk_options vtk_options() {
  planish_vtk_options options;
  CHECK(planish_vtk_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  return options;
}

TEST(Save, ComesBackToTheBit) {
  const Surface surface = surface_with_everything();
  const std::vector<std::uint8_t> bytes = save(surface.get());
  planish_surface *raw = nullptr;
  CHECK(planish_surface_load(bytes.data(), bytes.size(), &raw) == PLANISH_STATUS_OK);
  const Surface loaded(raw);
  CHECK(save(loaded.get()) == bytes);
  CHECK_EQUAL(planish_surface_trim_count(loaded.get()), 1u);
  CHECK_EQUAL(planish_tensor_has_weights(loaded.get()), 1u);

  const char *path = "test_export.planish";
  CHECK(planish_surface_save_file(surface.get(), path) == PLANISH_STATUS_OK);
  raw = nullptr;
  CHECK(planish_surface_load_file(path, &raw) == PLANISH_STATUS_OK);
  const Surface from_file(raw);
  CHECK(save(from_file.get()) == bytes);
  std::remove(path);
}

TEST(Save, RefusesByName) {
  const Surface surface = surface_with_everything();
  std::vector<std::uint8_t> bytes(planish_surface_save_size(surface.get()), 0xa5);
  const check::untouched before(bytes);
  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_EQUAL(planish_surface_save_size(nullptr), 0u);
  CHECK_FAILS(planish_surface_save(surface.get(), bytes.data(), bytes.size() - 1), PLANISH_STATUS_BUFFER_TOO_SMALL, -1,
              "needed");
  CHECK_FAILS(planish_surface_save(surface.get(), nullptr, 0), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "room for 0");
  CHECK_FAILS(planish_surface_save(nullptr, bytes.data(), bytes.size()), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_save(surface.get(), nullptr, bytes.size()), null, -1, "buffer is NULL");
  CHECK_FAILS(planish_surface_save_file(nullptr, "x.planish"), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_save_file(surface.get(), nullptr), null, -1, "path is NULL");
  CHECK_FAILS(planish_surface_save_file(surface.get(), "no/such/folder/x.planish"), PLANISH_STATUS_FILE, -1,
              "no/such/folder/x.planish");
  CHECK(before.holds());
}

TEST(Load, RefusesDamage) {
  const std::vector<std::uint8_t> bytes = save(surface_with_everything().get());
  planish_surface *surface = sentinel<planish_surface>();
  const auto null = PLANISH_STATUS_NULL_POINTER, format = PLANISH_STATUS_FORMAT;
  for (std::size_t k = 0; k < bytes.size(); ++k) { // any byte, and any length
    std::vector<std::uint8_t> damaged = bytes;
    damaged[k] ^= 0x10;
    const planish_status status = planish_surface_load(damaged.data(), damaged.size(), &surface);
    CHECK(status == PLANISH_STATUS_FORMAT || status == PLANISH_STATUS_VERSION);
    CHECK(planish_surface_load(bytes.data(), k, &surface) == PLANISH_STATUS_FORMAT);
  }
  CHECK(planish_surface_load(nullptr, 0, &surface) == format);
  CHECK_FAILS(planish_surface_load(nullptr, bytes.size(), &surface), null, -1, "buffer is NULL");
  CHECK_FAILS(planish_surface_load(bytes.data(), bytes.size(), nullptr), null, -1, "out_surface is NULL");
  CHECK_FAILS(planish_surface_load_file("no/such/file.planish", &surface), PLANISH_STATUS_FILE, -1, "no/such/file");
  CHECK_FAILS(planish_surface_load_file(nullptr, &surface), null, -1, "path is NULL");
  CHECK_FAILS(planish_surface_load_file("x.planish", nullptr), null, -1, "out_surface is NULL");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(Vtk, WritesATessellationOrADeviation) {
  const Surface surface = surface_with_everything();
  const char *path = "test_export.vtu";
  CHECK(planish_surface_write_vtk(surface.get(), path, nullptr) == PLANISH_STATUS_OK);
  std::string text = content(path);
  CHECK(text.find("<VTKFile") != std::string::npos && text.find("\"uv\"") != std::string::npos);
  CHECK(text.find("</VTKFile>") != std::string::npos);
  CHECK(text.find("\"deviation\"") == std::string::npos);

  const shapes::arrays all = shapes::graph(5, 5, 0.1, 61);
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(all.points.data(), all.point_count(), all.triangles.data(), all.triangle_count(), nullptr,
                         &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  planish_vtk_options options = vtk_options();
  options.deviation_from = mesh.get();
  CHECK(planish_surface_write_vtk(surface.get(), path, &options) == PLANISH_STATUS_OK);
  text = content(path);
  CHECK(text.find("\"deviation\"") != std::string::npos);
  CHECK(text.find("NumberOfPoints=\"25\"") != std::string::npos);

  options = vtk_options();
  for (const auto &[what, array] : {std::pair(PLANISH_VTK_CONTENT_CONTROL_NET, "\"connectivity\""),
                                    std::pair(PLANISH_VTK_CONTENT_PATCHES, "\"HigherOrderDegrees\"")}) {
    options.content = what;
    CHECK(planish_surface_write_vtk(surface.get(), path, &options) == PLANISH_STATUS_OK);
    text = content(path);
    CHECK(text.find(array) != std::string::npos);
  }

  // a failure leaves the file as it was
  planish_tessellate_options tessellate;
  CHECK(planish_tessellate_options_init(&tessellate, sizeof tessellate) == PLANISH_STATUS_OK);
  tessellate.chord_tolerance = -1;
  options = vtk_options();
  options.tessellate = &tessellate;
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_surface_write_vtk(surface.get(), path, &options), invalid, -1, "chord_tolerance is -1");
  options = vtk_options();
  options.content = 3;
  CHECK_FAILS(planish_surface_write_vtk(surface.get(), path, &options), invalid, -1, "content is 3");
  CHECK_FAILS(planish_surface_write_vtk(nullptr, path, nullptr), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_write_vtk(surface.get(), nullptr, nullptr), null, -1, "path is NULL");
  CHECK_FAILS(planish_surface_write_vtk(surface.get(), "no/such/folder/x.vtu", nullptr), PLANISH_STATUS_FILE, -1,
              "no/such/folder/x.vtu");
  CHECK_FAILS(planish_vtk_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(content(path) == text);
  std::remove(path);
}

TEST(Report, IsOnePageThatNeedsNothing) {
  const double points[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0.125, 0, 1, 0};
  const std::uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points, 4, triangles, 2, nullptr, &raw) == PLANISH_STATUS_OK);
  const Mesh mesh(raw);
  const double knots[4] = {0, 0, 1, 1}, corners[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  planish_surface *flat = nullptr;
  CHECK(planish_tensor_new(3, 1, 1, knots, 4, knots, 4, corners, nullptr, &flat) == PLANISH_STATUS_OK);
  const Surface surface(flat);
  planish_report_options options;
  CHECK(planish_report_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.title = "Roof <b>";
  options.unit = "m";
  options.tolerance = 0.25;
  options.tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE;
  options.remarks = PLANISH_REMARK_ROUGH_BETWEEN_NODES;
  const char *path = "test_export.html";
  CHECK(planish_surface_write_report(surface.get(), mesh.get(), path, &options) == PLANISH_STATUS_OK);
  const std::string text = content(path);
  for (const char *part : {"Roof &lt;b&gt;", "Tolerance met: 0.1250 m of 0.2500 m", "Between the nodes", "</html>"})
    CHECK(text.find(part) != std::string::npos);
  CHECK(text.find("http") == std::string::npos);

  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_surface_write_report(nullptr, mesh.get(), path, nullptr), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_write_report(surface.get(), nullptr, path, nullptr), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_surface_write_report(surface.get(), mesh.get(), nullptr, nullptr), null, -1, "path is NULL");
  options.tolerance = -1;
  CHECK_FAILS(planish_surface_write_report(surface.get(), mesh.get(), path, &options), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "tolerance is -1");
  CHECK_FAILS(planish_surface_write_report(surface.get(), mesh.get(), "no/such/folder/x.html", nullptr),
              PLANISH_STATUS_FILE, -1, "no/such/folder/x.html");
  CHECK_FAILS(planish_report_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(content(path) == text);
  std::remove(path);
}

int main() { return check::run(); }
