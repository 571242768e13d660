/* Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.
 *
 * Records have the layout that other languages copy: no implicit padding, fields where they are told to be. */
#include "planish.h"

#include <stddef.h>

#define HOLDS(name, condition) typedef char name[(condition) ? 1 : -1]
#define END(record, field) (offsetof(record, field) + sizeof(((record *)0)->field))
/* `field` lies right behind `before`, so no padding is between them */
#define FOLLOWS(record, before, field) \
  HOLDS(record##_##field##_follows, offsetof(record, field) == END(record, before))
#define FIRST(record) HOLDS(record##_begins_with_its_size, offsetof(record, struct_size) == 0)
#define LAST(record, field) HOLDS(record##_ends_with_##field, sizeof(record) == END(record, field))

HOLDS(status_is_an_int, sizeof(planish_status) == sizeof(int));

FIRST(planish_mesh_options);
FOLLOWS(planish_mesh_options, struct_size, point_stride);
FOLLOWS(planish_mesh_options, point_stride, triangle_stride);
FOLLOWS(planish_mesh_options, triangle_stride, weld_distance);
FOLLOWS(planish_mesh_options, weld_distance, out_repairs);
FOLLOWS(planish_mesh_options, out_repairs, out_node_map);
FOLLOWS(planish_mesh_options, out_node_map, orient);
FOLLOWS(planish_mesh_options, orient, index_base);
LAST(planish_mesh_options, index_base);

FIRST(planish_mesh_repairs);
FOLLOWS(planish_mesh_repairs, struct_size, welded_node_count);
FOLLOWS(planish_mesh_repairs, welded_node_count, dropped_triangle_count);
FOLLOWS(planish_mesh_repairs, dropped_triangle_count, flipped_triangle_count);
FOLLOWS(planish_mesh_repairs, flipped_triangle_count, dropped_parameters);
FOLLOWS(planish_mesh_repairs, dropped_parameters, reserved);
LAST(planish_mesh_repairs, reserved);

FIRST(planish_decimate_options);
FOLLOWS(planish_decimate_options, struct_size, target_count);
FOLLOWS(planish_decimate_options, target_count, sharp_angle);
FOLLOWS(planish_decimate_options, sharp_angle, corner_angle);
FOLLOWS(planish_decimate_options, corner_angle, sharp_edges);
FOLLOWS(planish_decimate_options, sharp_edges, sharp_edge_count);
FOLLOWS(planish_decimate_options, sharp_edge_count, out_sharp_edges);
FOLLOWS(planish_decimate_options, out_sharp_edges, out_sharp_edge_count);
FOLLOWS(planish_decimate_options, out_sharp_edge_count, progress);
FOLLOWS(planish_decimate_options, progress, user);
FOLLOWS(planish_decimate_options, user, cancel);
FOLLOWS(planish_decimate_options, cancel, out_stage);
FOLLOWS(planish_decimate_options, out_stage, keep_map);
FOLLOWS(planish_decimate_options, keep_map, reserved);
LAST(planish_decimate_options, reserved);

FIRST(planish_decimate_report);
FOLLOWS(planish_decimate_report, struct_size, collapse_count);
FOLLOWS(planish_decimate_report, collapse_count, excess_count);
FOLLOWS(planish_decimate_report, excess_count, sharp_edge_count);
FOLLOWS(planish_decimate_report, sharp_edge_count, seconds);
LAST(planish_decimate_report, seconds);

FIRST(planish_parameterize_options);
FOLLOWS(planish_parameterize_options, struct_size, node_weights);
FOLLOWS(planish_parameterize_options, node_weights, progress);
FOLLOWS(planish_parameterize_options, progress, user);
FOLLOWS(planish_parameterize_options, user, cancel);
FOLLOWS(planish_parameterize_options, cancel, out_stage);
FOLLOWS(planish_parameterize_options, out_stage, bulge);
FOLLOWS(planish_parameterize_options, bulge, boundary_slide);
FOLLOWS(planish_parameterize_options, boundary_slide, method);
FOLLOWS(planish_parameterize_options, method, border);
FOLLOWS(planish_parameterize_options, border, corners);
FOLLOWS(planish_parameterize_options, corners, stretch_steps);
FOLLOWS(planish_parameterize_options, stretch_steps, rings);
FOLLOWS(planish_parameterize_options, rings, fill_holes);
FOLLOWS(planish_parameterize_options, fill_holes, unroll);
FOLLOWS(planish_parameterize_options, unroll, thread_count);
FOLLOWS(planish_parameterize_options, thread_count, reserved);
LAST(planish_parameterize_options, reserved);

FIRST(planish_parameterize_report);
FOLLOWS(planish_parameterize_report, struct_size, stretch);
FOLLOWS(planish_parameterize_report, stretch, max_stretch);
FOLLOWS(planish_parameterize_report, max_stretch, area_ratio);
FOLLOWS(planish_parameterize_report, area_ratio, seconds);
FOLLOWS(planish_parameterize_report, seconds, flipped_count);
FOLLOWS(planish_parameterize_report, flipped_count, degenerate_count);
FOLLOWS(planish_parameterize_report, degenerate_count, solve_count);
FOLLOWS(planish_parameterize_report, solve_count, step_count);
FOLLOWS(planish_parameterize_report, step_count, remarks);
FOLLOWS(planish_parameterize_report, remarks, border);
FOLLOWS(planish_parameterize_report, border, border_slid);
LAST(planish_parameterize_report, border_slid);

FIRST(planish_sphere_options);
FOLLOWS(planish_sphere_options, struct_size, progress);
FOLLOWS(planish_sphere_options, progress, user);
FOLLOWS(planish_sphere_options, user, cancel);
FOLLOWS(planish_sphere_options, cancel, out_stage);
FOLLOWS(planish_sphere_options, out_stage, sweeps);
FOLLOWS(planish_sphere_options, sweeps, thread_count);
LAST(planish_sphere_options, thread_count);

FIRST(planish_sphere_report);
FOLLOWS(planish_sphere_report, struct_size, energy);
FOLLOWS(planish_sphere_report, energy, folded_triangles);
FOLLOWS(planish_sphere_report, folded_triangles, clamped_triangles);
FOLLOWS(planish_sphere_report, clamped_triangles, low_area_ratio);
FOLLOWS(planish_sphere_report, low_area_ratio, high_area_ratio);
FOLLOWS(planish_sphere_report, high_area_ratio, seconds);
LAST(planish_sphere_report, seconds);

FIRST(planish_fit_report);
FOLLOWS(planish_fit_report, struct_size, max_error);
FOLLOWS(planish_fit_report, max_error, rms_error);
FOLLOWS(planish_fit_report, rms_error, mean_error);
FOLLOWS(planish_fit_report, mean_error, tolerance);
FOLLOWS(planish_fit_report, tolerance, diagonal);
FOLLOWS(planish_fit_report, diagonal, max_interior_error);
FOLLOWS(planish_fit_report, max_interior_error, facet_sagitta);
FOLLOWS(planish_fit_report, facet_sagitta, max_distance);
FOLLOWS(planish_fit_report, max_distance, smoothing);
FOLLOWS(planish_fit_report, smoothing, stretch);
FOLLOWS(planish_fit_report, stretch, parameterize_seconds);
FOLLOWS(planish_fit_report, parameterize_seconds, seconds);
FOLLOWS(planish_fit_report, seconds, worst_index);
FOLLOWS(planish_fit_report, worst_index, grid_u);
FOLLOWS(planish_fit_report, grid_u, grid_v);
FOLLOWS(planish_fit_report, grid_v, coefficient_count);
FOLLOWS(planish_fit_report, coefficient_count, empty_cell_count);
FOLLOWS(planish_fit_report, empty_cell_count, flipped_count);
FOLLOWS(planish_fit_report, flipped_count, remarks);
FOLLOWS(planish_fit_report, remarks, pass_count);
FOLLOWS(planish_fit_report, pass_count, stop_reason);
FOLLOWS(planish_fit_report, stop_reason, cell_count);
FOLLOWS(planish_fit_report, cell_count, rough_cell_count);
FOLLOWS(planish_fit_report, rough_cell_count, deepest_level);
FOLLOWS(planish_fit_report, deepest_level, reserved);
LAST(planish_fit_report, reserved);

FIRST(planish_eval_options);
FOLLOWS(planish_eval_options, struct_size, uv_stride);
FOLLOWS(planish_eval_options, uv_stride, out_stride);
FOLLOWS(planish_eval_options, out_stride, out_flags);
FOLLOWS(planish_eval_options, out_flags, outside);
FOLLOWS(planish_eval_options, outside, thread_count);
LAST(planish_eval_options, thread_count);

FIRST(planish_patch);
FOLLOWS(planish_patch, struct_size, u_min);
FOLLOWS(planish_patch, u_min, u_max);
FOLLOWS(planish_patch, u_max, v_min);
FOLLOWS(planish_patch, v_min, v_max);
FOLLOWS(planish_patch, v_max, ordinate_count);
FOLLOWS(planish_patch, ordinate_count, ordinate_width);
FOLLOWS(planish_patch, ordinate_width, degree_u);
FOLLOWS(planish_patch, degree_u, degree_v);
FOLLOWS(planish_patch, degree_v, is_rational);
FOLLOWS(planish_patch, is_rational, reserved);
LAST(planish_patch, reserved);

FIRST(planish_convert_options);
FOLLOWS(planish_convert_options, struct_size, max_coefficients);
FOLLOWS(planish_convert_options, max_coefficients, progress);
FOLLOWS(planish_convert_options, progress, user);
FOLLOWS(planish_convert_options, user, cancel);
FOLLOWS(planish_convert_options, cancel, out_stage);
LAST(planish_convert_options, out_stage);

FIRST(planish_tensor_options);
FOLLOWS(planish_tensor_options, struct_size, tolerance);
FOLLOWS(planish_tensor_options, tolerance, smoothing);
FOLLOWS(planish_tensor_options, smoothing, buffer);
FOLLOWS(planish_tensor_options, buffer, parameterize);
FOLLOWS(planish_tensor_options, parameterize, weights);
FOLLOWS(planish_tensor_options, weights, progress);
FOLLOWS(planish_tensor_options, progress, user);
FOLLOWS(planish_tensor_options, user, cancel);
FOLLOWS(planish_tensor_options, cancel, out_stage);
FOLLOWS(planish_tensor_options, out_stage, out_parameters);
FOLLOWS(planish_tensor_options, out_parameters, out_errors);
FOLLOWS(planish_tensor_options, out_errors, max_coefficients);
FOLLOWS(planish_tensor_options, max_coefficients, tolerance_scale);
FOLLOWS(planish_tensor_options, tolerance_scale, method);
FOLLOWS(planish_tensor_options, method, ends);
FOLLOWS(planish_tensor_options, ends, energy);
FOLLOWS(planish_tensor_options, energy, regularize);
FOLLOWS(planish_tensor_options, regularize, max_grid);
FOLLOWS(planish_tensor_options, max_grid, grid_u);
FOLLOWS(planish_tensor_options, grid_u, grid_v);
FOLLOWS(planish_tensor_options, grid_v, correction_sweeps);
FOLLOWS(planish_tensor_options, correction_sweeps, measure_distance);
FOLLOWS(planish_tensor_options, measure_distance, thread_count);
FOLLOWS(planish_tensor_options, thread_count, reserved);
LAST(planish_tensor_options, reserved);

FIRST(planish_field_options);
FOLLOWS(planish_field_options, struct_size, tolerance);
FOLLOWS(planish_field_options, tolerance, smoothing);
FOLLOWS(planish_field_options, smoothing, buffer);
FOLLOWS(planish_field_options, buffer, parameterize);
FOLLOWS(planish_field_options, parameterize, weights);
FOLLOWS(planish_field_options, weights, mask);
FOLLOWS(planish_field_options, mask, sample_values);
FOLLOWS(planish_field_options, sample_values, sample_dim);
FOLLOWS(planish_field_options, sample_dim, progress);
FOLLOWS(planish_field_options, progress, user);
FOLLOWS(planish_field_options, user, cancel);
FOLLOWS(planish_field_options, cancel, out_stage);
FOLLOWS(planish_field_options, out_stage, tolerance_scale);
FOLLOWS(planish_field_options, tolerance_scale, ends);
FOLLOWS(planish_field_options, ends, energy);
FOLLOWS(planish_field_options, energy, grid_u);
FOLLOWS(planish_field_options, grid_u, grid_v);
FOLLOWS(planish_field_options, grid_v, thread_count);
LAST(planish_field_options, thread_count);

FIRST(planish_gradient_options);
FOLLOWS(planish_gradient_options, struct_size, uv_stride);
FOLLOWS(planish_gradient_options, uv_stride, thread_count);
FOLLOWS(planish_gradient_options, thread_count, reserved);
LAST(planish_gradient_options, reserved);

FIRST(planish_transfer_options);
FOLLOWS(planish_transfer_options, struct_size, field);
FOLLOWS(planish_transfer_options, field, max_distance);
FOLLOWS(planish_transfer_options, max_distance, distance_scale);
FOLLOWS(planish_transfer_options, distance_scale, far_rule);
LAST(planish_transfer_options, far_rule);

FIRST(planish_transfer_report);
FOLLOWS(planish_transfer_report, struct_size, max_distance);
FOLLOWS(planish_transfer_report, max_distance, rms_distance);
FOLLOWS(planish_transfer_report, rms_distance, limit);
FOLLOWS(planish_transfer_report, limit, max_shape_error);
FOLLOWS(planish_transfer_report, max_shape_error, rms_shape_error);
FOLLOWS(planish_transfer_report, rms_shape_error, seconds);
FOLLOWS(planish_transfer_report, seconds, farthest_index);
FOLLOWS(planish_transfer_report, farthest_index, far_count);
FOLLOWS(planish_transfer_report, far_count, grid_u);
FOLLOWS(planish_transfer_report, grid_u, grid_v);
FOLLOWS(planish_transfer_report, grid_v, coefficient_count);
FOLLOWS(planish_transfer_report, coefficient_count, remarks);
LAST(planish_transfer_report, remarks);

FIRST(planish_balance_report);
FOLLOWS(planish_balance_report, struct_size, force_given);
FOLLOWS(planish_balance_report, force_given, force_arrived);
FOLLOWS(planish_balance_report, force_arrived, force_error);
FOLLOWS(planish_balance_report, force_error, moment_given);
FOLLOWS(planish_balance_report, moment_given, moment_arrived);
FOLLOWS(planish_balance_report, moment_arrived, moment_error);
FOLLOWS(planish_balance_report, moment_error, moment_bound);
FOLLOWS(planish_balance_report, moment_bound, work_given);
FOLLOWS(planish_balance_report, work_given, work_arrived);
FOLLOWS(planish_balance_report, work_arrived, work_error);
LAST(planish_balance_report, work_error);

FIRST(planish_tessellate_options);
FOLLOWS(planish_tessellate_options, struct_size, chord_tolerance);
FOLLOWS(planish_tessellate_options, chord_tolerance, max_edge_length);
FOLLOWS(planish_tessellate_options, max_edge_length, max_point_count);
FOLLOWS(planish_tessellate_options, max_point_count, progress);
FOLLOWS(planish_tessellate_options, progress, user);
FOLLOWS(planish_tessellate_options, user, cancel);
FOLLOWS(planish_tessellate_options, cancel, out_stage);
FOLLOWS(planish_tessellate_options, out_stage, keep_trims);
FOLLOWS(planish_tessellate_options, keep_trims, reserved);
FOLLOWS(planish_tessellate_options, reserved, out_report);
LAST(planish_tessellate_options, out_report);

FIRST(planish_tessellate_report);
FOLLOWS(planish_tessellate_report, struct_size, smallest_angle);
FOLLOWS(planish_tessellate_report, smallest_angle, chord_error);
LAST(planish_tessellate_report, chord_error);

FIRST(planish_project_options);
FOLLOWS(planish_project_options, struct_size, guesses);
FOLLOWS(planish_project_options, guesses, max_distance);
FOLLOWS(planish_project_options, max_distance, progress);
FOLLOWS(planish_project_options, progress, user);
FOLLOWS(planish_project_options, user, cancel);
FOLLOWS(planish_project_options, cancel, out_stage);
FOLLOWS(planish_project_options, out_stage, keep_trims);
FOLLOWS(planish_project_options, keep_trims, thread_count);
LAST(planish_project_options, thread_count);

FIRST(planish_deviation_options);
FOLLOWS(planish_deviation_options, struct_size, chord_tolerance);
FOLLOWS(planish_deviation_options, chord_tolerance, max_edge_length);
FOLLOWS(planish_deviation_options, max_edge_length, progress);
FOLLOWS(planish_deviation_options, progress, user);
FOLLOWS(planish_deviation_options, user, cancel);
FOLLOWS(planish_deviation_options, cancel, out_stage);
FOLLOWS(planish_deviation_options, out_stage, keep_trims);
FOLLOWS(planish_deviation_options, keep_trims, use_parameters);
FOLLOWS(planish_deviation_options, use_parameters, measure_back);
FOLLOWS(planish_deviation_options, measure_back, thread_count);
LAST(planish_deviation_options, thread_count);

FIRST(planish_deviation_report);
FOLLOWS(planish_deviation_report, struct_size, max_distance);
FOLLOWS(planish_deviation_report, max_distance, rms_distance);
FOLLOWS(planish_deviation_report, rms_distance, mean_distance);
FOLLOWS(planish_deviation_report, mean_distance, max_back_distance);
FOLLOWS(planish_deviation_report, max_back_distance, worst_back_u);
FOLLOWS(planish_deviation_report, worst_back_u, worst_back_v);
FOLLOWS(planish_deviation_report, worst_back_v, worst_index);
FOLLOWS(planish_deviation_report, worst_index, back_count);
LAST(planish_deviation_report, back_count);

FIRST(planish_sample_rows_options);
FOLLOWS(planish_sample_rows_options, struct_size, spacing);
FOLLOWS(planish_sample_rows_options, spacing, begin_index);
FOLLOWS(planish_sample_rows_options, begin_index, end_index);
FOLLOWS(planish_sample_rows_options, end_index, progress);
FOLLOWS(planish_sample_rows_options, progress, user);
FOLLOWS(planish_sample_rows_options, user, cancel);
FOLLOWS(planish_sample_rows_options, cancel, out_stage);
FOLLOWS(planish_sample_rows_options, out_stage, begin);
FOLLOWS(planish_sample_rows_options, begin, end);
LAST(planish_sample_rows_options, end);

FIRST(planish_vtk_options);
FOLLOWS(planish_vtk_options, struct_size, deviation_from);
FOLLOWS(planish_vtk_options, deviation_from, tessellate);
FOLLOWS(planish_vtk_options, tessellate, progress);
FOLLOWS(planish_vtk_options, progress, user);
FOLLOWS(planish_vtk_options, user, cancel);
FOLLOWS(planish_vtk_options, cancel, out_stage);
FOLLOWS(planish_vtk_options, out_stage, thread_count);
FOLLOWS(planish_vtk_options, thread_count, content);
LAST(planish_vtk_options, content);

FIRST(planish_step_report);
FOLLOWS(planish_step_report, struct_size, curve_deviation);
FOLLOWS(planish_step_report, curve_deviation, uncertainty);
FOLLOWS(planish_step_report, uncertainty, diagonal);
FOLLOWS(planish_step_report, diagonal, loop_count);
FOLLOWS(planish_step_report, loop_count, edge_count);
FOLLOWS(planish_step_report, edge_count, face_count);
FOLLOWS(planish_step_report, face_count, pole_count);
LAST(planish_step_report, pole_count);

FIRST(planish_step_options);
FOLLOWS(planish_step_options, struct_size, product);
FOLLOWS(planish_step_options, product, author);
FOLLOWS(planish_step_options, author, organization);
FOLLOWS(planish_step_options, organization, timestamp);
FOLLOWS(planish_step_options, timestamp, out_report);
FOLLOWS(planish_step_options, out_report, progress);
FOLLOWS(planish_step_options, progress, user);
FOLLOWS(planish_step_options, user, cancel);
FOLLOWS(planish_step_options, cancel, out_stage);
FOLLOWS(planish_step_options, out_stage, schema);
FOLLOWS(planish_step_options, schema, unit);
FOLLOWS(planish_step_options, unit, max_coefficients);
FOLLOWS(planish_step_options, max_coefficients, form);
FOLLOWS(planish_step_options, form, level_spread);
FOLLOWS(planish_step_options, level_spread, tolerance);
LAST(planish_step_options, tolerance);

FIRST(planish_report_options);
FOLLOWS(planish_report_options, struct_size, title);
FOLLOWS(planish_report_options, title, unit);
FOLLOWS(planish_report_options, unit, tolerance);
FOLLOWS(planish_report_options, tolerance, progress);
FOLLOWS(planish_report_options, progress, user);
FOLLOWS(planish_report_options, user, cancel);
FOLLOWS(planish_report_options, cancel, out_stage);
FOLLOWS(planish_report_options, out_stage, remarks);
FOLLOWS(planish_report_options, remarks, tolerance_scale);
FOLLOWS(planish_report_options, tolerance_scale, thread_count);
LAST(planish_report_options, thread_count);

FIRST(planish_edge_info);
FOLLOWS(planish_edge_info, struct_size, angle);
FOLLOWS(planish_edge_info, angle, gap);
FOLLOWS(planish_edge_info, gap, face_along);
FOLLOWS(planish_edge_info, face_along, face_against);
FOLLOWS(planish_edge_info, face_against, vertex_start);
FOLLOWS(planish_edge_info, vertex_start, vertex_end);
FOLLOWS(planish_edge_info, vertex_end, is_sharp);
FOLLOWS(planish_edge_info, is_sharp, reserved);
LAST(planish_edge_info, reserved);

FIRST(planish_face_info);
FOLLOWS(planish_face_info, struct_size, origin);
FOLLOWS(planish_face_info, origin, axis);
FOLLOWS(planish_face_info, axis, x_axis);
FOLLOWS(planish_face_info, x_axis, radius);
FOLLOWS(planish_face_info, radius, loop_count);
FOLLOWS(planish_face_info, loop_count, coedge_count);
FOLLOWS(planish_face_info, coedge_count, carrier);
FOLLOWS(planish_face_info, carrier, label);
FOLLOWS(planish_face_info, label, shell);
FOLLOWS(planish_face_info, shell, is_forward);
LAST(planish_face_info, is_forward);

FIRST(planish_shell_info);
FOLLOWS(planish_shell_info, struct_size, face_count);
FOLLOWS(planish_shell_info, face_count, role);
FOLLOWS(planish_shell_info, role, void_in);
LAST(planish_shell_info, void_in);

FIRST(planish_measure_report);
FOLLOWS(planish_measure_report, struct_size, box_min);
FOLLOWS(planish_measure_report, box_min, box_max);
FOLLOWS(planish_measure_report, box_max, area);
FOLLOWS(planish_measure_report, area, volume);
FOLLOWS(planish_measure_report, volume, max_gap);
FOLLOWS(planish_measure_report, max_gap, max_normal_jump);
FOLLOWS(planish_measure_report, max_normal_jump, curve_deviation);
FOLLOWS(planish_measure_report, curve_deviation, diagonal);
FOLLOWS(planish_measure_report, diagonal, free_edge_count);
FOLLOWS(planish_measure_report, free_edge_count, sharp_edge_count);
FOLLOWS(planish_measure_report, sharp_edge_count, pole_count);
FOLLOWS(planish_measure_report, pole_count, loop_count);
FOLLOWS(planish_measure_report, loop_count, euler_characteristic);
LAST(planish_measure_report, euler_characteristic);

FIRST(planish_curve_options);
FOLLOWS(planish_curve_options, struct_size, tolerance);
FOLLOWS(planish_curve_options, tolerance, smoothing);
FOLLOWS(planish_curve_options, smoothing, buffer);
FOLLOWS(planish_curve_options, buffer, weights);
FOLLOWS(planish_curve_options, weights, progress);
FOLLOWS(planish_curve_options, progress, user);
FOLLOWS(planish_curve_options, user, cancel);
FOLLOWS(planish_curve_options, cancel, out_stage);
FOLLOWS(planish_curve_options, out_stage, out_errors);
FOLLOWS(planish_curve_options, out_errors, tolerance_scale);
FOLLOWS(planish_curve_options, tolerance_scale, method);
FOLLOWS(planish_curve_options, method, ends);
FOLLOWS(planish_curve_options, ends, max_grid);
FOLLOWS(planish_curve_options, max_grid, grid);
FOLLOWS(planish_curve_options, grid, thread_count);
LAST(planish_curve_options, thread_count);

FIRST(planish_interpolate_options);
FOLLOWS(planish_interpolate_options, struct_size, end_slopes);
FOLLOWS(planish_interpolate_options, end_slopes, ends);
FOLLOWS(planish_interpolate_options, ends, reserved);
LAST(planish_interpolate_options, reserved);

FIRST(planish_skin_report);
FOLLOWS(planish_skin_report, struct_size, overshoot);
FOLLOWS(planish_skin_report, overshoot, certified_distance);
FOLLOWS(planish_skin_report, certified_distance, v_error);
FOLLOWS(planish_skin_report, v_error, twisted_row);
FOLLOWS(planish_skin_report, twisted_row, curve_count);
FOLLOWS(planish_skin_report, curve_count, least_count);
FOLLOWS(planish_skin_report, least_count, largest_count);
FOLLOWS(planish_skin_report, largest_count, tensor_count);
FOLLOWS(planish_skin_report, tensor_count, strip_count);
FOLLOWS(planish_skin_report, strip_count, common_count);
FOLLOWS(planish_skin_report, common_count, removed_knot_count);
FOLLOWS(planish_skin_report, removed_knot_count, merged_point_count);
FOLLOWS(planish_skin_report, merged_point_count, aligned_row_count);
LAST(planish_skin_report, aligned_row_count);

FIRST(planish_skin_options);
FOLLOWS(planish_skin_options, struct_size, tolerance);
FOLLOWS(planish_skin_options, tolerance, end_slopes);
FOLLOWS(planish_skin_options, end_slopes, begin_tangents);
FOLLOWS(planish_skin_options, begin_tangents, end_tangents);
FOLLOWS(planish_skin_options, end_tangents, progress);
FOLLOWS(planish_skin_options, progress, user);
FOLLOWS(planish_skin_options, user, cancel);
FOLLOWS(planish_skin_options, cancel, out_stage);
FOLLOWS(planish_skin_options, out_stage, out_parameters);
FOLLOWS(planish_skin_options, out_parameters, out_errors);
FOLLOWS(planish_skin_options, out_errors, out_report);
FOLLOWS(planish_skin_options, out_report, dim);
FOLLOWS(planish_skin_options, dim, tolerance_scale);
FOLLOWS(planish_skin_options, tolerance_scale, method);
FOLLOWS(planish_skin_options, method, closed);
FOLLOWS(planish_skin_options, closed, ends);
FOLLOWS(planish_skin_options, ends, closed_v);
FOLLOWS(planish_skin_options, closed_v, v_rule);
FOLLOWS(planish_skin_options, v_rule, align);
FOLLOWS(planish_skin_options, align, approximate_v);
FOLLOWS(planish_skin_options, approximate_v, extra_checks);
FOLLOWS(planish_skin_options, extra_checks, batch);
FOLLOWS(planish_skin_options, batch, removal);
FOLLOWS(planish_skin_options, removal, certify);
FOLLOWS(planish_skin_options, certify, compare);
FOLLOWS(planish_skin_options, compare, thread_count);
LAST(planish_skin_options, thread_count);

FIRST(planish_pht_options);
FOLLOWS(planish_pht_options, struct_size, tolerance);
FOLLOWS(planish_pht_options, tolerance, smoothing);
FOLLOWS(planish_pht_options, smoothing, parameterize);
FOLLOWS(planish_pht_options, parameterize, weights);
FOLLOWS(planish_pht_options, weights, progress);
FOLLOWS(planish_pht_options, progress, user);
FOLLOWS(planish_pht_options, user, cancel);
FOLLOWS(planish_pht_options, cancel, out_stage);
FOLLOWS(planish_pht_options, out_stage, out_parameters);
FOLLOWS(planish_pht_options, out_parameters, out_errors);
FOLLOWS(planish_pht_options, out_errors, max_cells);
FOLLOWS(planish_pht_options, max_cells, tolerance_scale);
FOLLOWS(planish_pht_options, tolerance_scale, estimator);
FOLLOWS(planish_pht_options, estimator, regularize);
FOLLOWS(planish_pht_options, regularize, grid_u);
FOLLOWS(planish_pht_options, grid_u, grid_v);
FOLLOWS(planish_pht_options, grid_v, max_level);
FOLLOWS(planish_pht_options, max_level, min_samples);
FOLLOWS(planish_pht_options, min_samples, grade);
FOLLOWS(planish_pht_options, grade, correction_sweeps);
FOLLOWS(planish_pht_options, correction_sweeps, measure_distance);
FOLLOWS(planish_pht_options, measure_distance, thread_count);
FOLLOWS(planish_pht_options, thread_count, reserved);
LAST(planish_pht_options, reserved);

FIRST(planish_pht_simplify_options);
FOLLOWS(planish_pht_simplify_options, struct_size, progress);
FOLLOWS(planish_pht_simplify_options, progress, user);
FOLLOWS(planish_pht_simplify_options, user, cancel);
FOLLOWS(planish_pht_simplify_options, cancel, out_stage);
LAST(planish_pht_simplify_options, out_stage);

FIRST(planish_pht_convert_options);
FOLLOWS(planish_pht_convert_options, struct_size, tolerance);
FOLLOWS(planish_pht_convert_options, tolerance, max_cells);
FOLLOWS(planish_pht_convert_options, max_cells, progress);
FOLLOWS(planish_pht_convert_options, progress, user);
FOLLOWS(planish_pht_convert_options, user, cancel);
FOLLOWS(planish_pht_convert_options, cancel, out_stage);
FOLLOWS(planish_pht_convert_options, out_stage, max_level);
FOLLOWS(planish_pht_convert_options, max_level, reserved);
LAST(planish_pht_convert_options, reserved);

FIRST(planish_pht_patches_options);
FOLLOWS(planish_pht_patches_options, struct_size, progress);
FOLLOWS(planish_pht_patches_options, progress, user);
FOLLOWS(planish_pht_patches_options, user, cancel);
FOLLOWS(planish_pht_patches_options, cancel, out_stage);
FOLLOWS(planish_pht_patches_options, out_stage, level_spread);
FOLLOWS(planish_pht_patches_options, level_spread, reserved);
LAST(planish_pht_patches_options, reserved);

FIRST(planish_d1rc_options);
FOLLOWS(planish_d1rc_options, struct_size, sharp_edges);
FOLLOWS(planish_d1rc_options, sharp_edges, sharp_edge_count);
FOLLOWS(planish_d1rc_options, sharp_edge_count, corners);
FOLLOWS(planish_d1rc_options, corners, corner_count);
FOLLOWS(planish_d1rc_options, corner_count, sharp_angle);
FOLLOWS(planish_d1rc_options, sharp_angle, sharp_weight);
FOLLOWS(planish_d1rc_options, sharp_weight, parameterize);
FOLLOWS(planish_d1rc_options, parameterize, progress);
FOLLOWS(planish_d1rc_options, progress, user);
FOLLOWS(planish_d1rc_options, user, cancel);
FOLLOWS(planish_d1rc_options, cancel, out_stage);
FOLLOWS(planish_d1rc_options, out_stage, tolerance);
FOLLOWS(planish_d1rc_options, tolerance, smoothing);
FOLLOWS(planish_d1rc_options, smoothing, control_mesh);
FOLLOWS(planish_d1rc_options, control_mesh, weights);
FOLLOWS(planish_d1rc_options, weights, out_parameters);
FOLLOWS(planish_d1rc_options, out_parameters, out_errors);
FOLLOWS(planish_d1rc_options, out_errors, control_count);
FOLLOWS(planish_d1rc_options, control_count, max_control_count);
FOLLOWS(planish_d1rc_options, max_control_count, degree);
FOLLOWS(planish_d1rc_options, degree, mode);
FOLLOWS(planish_d1rc_options, mode, boundary);
FOLLOWS(planish_d1rc_options, boundary, sharp);
FOLLOWS(planish_d1rc_options, sharp, tolerance_scale);
FOLLOWS(planish_d1rc_options, tolerance_scale, correction_sweeps);
FOLLOWS(planish_d1rc_options, correction_sweeps, thread_count);
FOLLOWS(planish_d1rc_options, thread_count, reserved);
LAST(planish_d1rc_options, reserved);
