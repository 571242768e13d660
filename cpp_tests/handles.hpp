// Owners of the handles of planish.h, and options and reports in one expression.
#ifndef PLANISH_HANDLES_HPP
#define PLANISH_HANDLES_HPP

#include <planish.h>

#include <memory>

struct Free {
  void operator()(planish_mesh *mesh) const { planish_mesh_free(mesh); }
  void operator()(planish_surface *surface) const { planish_surface_free(surface); }
  void operator()(planish_curve *curve) const { planish_curve_free(curve); }
  void operator()(planish_model *model) const { planish_model_free(model); }
  void operator()(planish_layout *layout) const { planish_layout_free(layout); }
};
using Mesh = std::unique_ptr<planish_mesh, Free>;
using Surface = std::unique_ptr<planish_surface, Free>;
using Curve = std::unique_ptr<planish_curve, Free>;
using Model = std::unique_ptr<planish_model, Free>;
using Layout = std::unique_ptr<planish_layout, Free>;

inline planish_mesh_options mesh_options() {
  planish_mesh_options options;
  planish_mesh_options_init(&options, sizeof options);
  return options;
}

inline planish_parameterize_options parameterize_options() {
  planish_parameterize_options options;
  planish_parameterize_options_init(&options, sizeof options);
  return options;
}

inline planish_tensor_options tensor_options() {
  planish_tensor_options options;
  planish_tensor_options_init(&options, sizeof options);
  return options;
}

inline planish_curve_options curve_options() {
  planish_curve_options options;
  planish_curve_options_init(&options, sizeof options);
  return options;
}

inline planish_skin_options skin_options() {
  planish_skin_options options;
  planish_skin_options_init(&options, sizeof options);
  return options;
}

inline planish_pht_options pht_options() {
  planish_pht_options options;
  planish_pht_options_init(&options, sizeof options);
  return options;
}

inline planish_eval_options eval_options() {
  planish_eval_options options;
  planish_eval_options_init(&options, sizeof options);
  return options;
}

// A report to be filled: every byte but those of its size is a sentinel.
template <class Report>
Report fresh() {
  Report report;
  unsigned char *bytes = reinterpret_cast<unsigned char *>(&report);
  for (std::size_t i = 0; i < sizeof report; ++i) bytes[i] = 0xa5;
  report.struct_size = sizeof report;
  return report;
}

// A handle that was never made: calls that fail must leave it there.
template <class Handle>
Handle *sentinel() {
  return reinterpret_cast<Handle *>(0xa5a5a5a0);
}

#endif
