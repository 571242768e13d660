# SPDX-License-Identifier: MIT OR Apache-2.0
# Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.
"""What planish.h declares, for ctypes: constants, enumerations, records and functions."""

from __future__ import annotations

from ctypes import (CFUNCTYPE, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t, c_uint8, c_uint32, c_uint64,
                    c_void_p, sizeof)

VERSION = "0.2.0"
UNLIMITED = 4294967295
NONE = 4294967295

#: The words of each enumeration and their values.
ENUMERATIONS = {
    "planish_status": {
        "ok": 0,
        "tolerance_not_met": 1,
        "stagnated": 2,
        "points_outside": 3,
        "input_repaired": 4,
        "folded_parameters": 5,
        "not_proven": 6,
        "null_pointer": -1,
        "invalid_argument": -2,
        "not_finite": -3,
        "index": -4,
        "topology": -5,
        "degenerate": -6,
        "outside": -7,
        "singular": -8,
        "wrong_kind": -9,
        "buffer_too_small": -10,
        "too_large": -11,
        "file": -12,
        "format": -13,
        "version": -14,
        "cancelled": -15,
        "out_of_memory": -16,
        "internal": -17,
    },
    "planish_stage": {
        "prepare": 0,
        "parameterize": 1,
        "coarsen": 2,
        "layout": 3,
        "fit": 4,
        "project": 5,
        "tessellate": 6,
        "convert": 7,
        "write": 8,
    },
    "planish_mesh_repair": {
        "safe": 0,
        "none": 1,
        "unused_nodes": 2,
        "repeated_corners": 4,
        "duplicate_triangles": 8,
        "touching_nodes": 16,
        "orientation": 32,
        "sheets": 64,
        "all": 126,
    },
    "planish_mesh_components": {
        "all": 0,
        "largest": 1,
        "one": 2,
    },
    "planish_mesh_format": {
        "auto": 0,
        "off": 1,
        "obj": 2,
        "ply": 3,
        "stl": 4,
    },
    "planish_map_method": {
        "mean_value": 0,
        "harmonic": 1,
    },
    "planish_border": {
        "auto": 0,
        "circle": 1,
        "square_by_turns": 2,
        "square_by_arc": 3,
        "corners": 4,
        "kept": 5,
        "free": 6,
    },
    "planish_layout_kind": {
        "auto": 0,
        "cube": 1,
        "complex": 2,
    },
    "planish_remark": {
        "tolerance_not_met": 1,
        "stagnated": 2,
        "folded_parameters": 4,
        "parameterized": 8,
        "regularized": 16,
        "tolerance_raised": 32,
        "empty_cells": 64,
        "rough_between_nodes": 128,
        "segmentation_advised": 256,
        "plate_energy_used": 512,
        "self_intersecting": 1024,
        "merged_points": 1048576,
        "twisted_rows": 2097152,
        "clustered_rows": 4194304,
        "mean_steps": 8388608,
        "holes_filled": 65536,
        "zero_area_triangles": 131072,
    },
    "planish_stop_reason": {
        "tolerance_met": 0,
        "fixed_grid": 1,
        "limit": 2,
        "data_exhausted": 3,
        "stagnated": 4,
    },
    "planish_kind": {
        "none": 0,
        "tensor": 1,
        "tspline": 2,
        "pht": 3,
        "d1rc": 4,
    },
    "planish_outside": {
        "fail": 0,
        "flag": 1,
        "extrapolate": 2,
    },
    "planish_flag": {
        "outside_domain": 1,
        "outside_trims": 2,
        "in_buffer": 4,
        "no_normal": 8,
        "not_proven": 16,
    },
    "planish_symmetry": {
        "none": 0,
        "about": 1,
        "found": 2,
    },
    "planish_tolerance_scale": {
        "relative": 0,
        "absolute": 1,
    },
    "planish_missing": {
        "refused": 0,
        "skipped": 1,
    },
    "planish_knots": {
        "adaptive": 0,
        "uniform": 1,
    },
    "planish_tensor_method": {
        "least_squares": 0,
        "ferguson": 1,
    },
    "planish_ends": {
        "natural": 0,
        "free": 1,
    },
    "planish_energy": {
        "beam": 0,
        "plate": 1,
    },
    "planish_regularize": {
        "auto": 0,
        "never": 1,
        "always": 2,
    },
    "planish_axis": {
        "u": 0,
        "v": 1,
    },
    "planish_far_rule": {
        "refuse": 0,
        "keep": 1,
    },
    "planish_row_source": {
        "loop": 0,
        "node": 1,
    },
    "planish_fairness": {
        "thin_plate": 0,
        "curvature_variation": 1,
    },
    "planish_kept_border": {
        "none": 0,
        "position": 1,
        "tangent": 2,
    },
    "planish_fair_limit": {
        "noise": 0,
        "tolerance": 1,
    },
    "planish_vtk_content": {
        "triangles": 0,
        "patches": 1,
        "control_net": 2,
    },
    "planish_step_schema": {
        "ap214": 0,
        "ap242": 1,
    },
    "planish_unit": {
        "millimetre": 0,
        "metre": 1,
        "inch": 2,
    },
    "planish_step_form": {
        "tensor": 0,
        "strips": 1,
        "patches": 2,
    },
    "planish_carrier": {
        "spline": 0,
        "plane": 1,
        "cylinder": 2,
    },
    "planish_shell_role": {
        "open": 0,
        "solid": 1,
        "void": 2,
    },
    "planish_edge_shape": {
        "spline": 0,
        "line": 1,
        "circle": 2,
        "ellipse": 3,
    },
    "planish_model_family": {
        "auto": 0,
        "chart": 1,
        "patches": 2,
    },
    "planish_model_layout": {
        "auto": 0,
        "cube": 1,
        "complex": 2,
    },
    "planish_skin_method": {
        "control_curves": 0,
        "common_knots": 1,
    },
    "planish_section_ends": {
        "auto": 0,
        "parabolic": 1,
        "natural": 2,
        "slopes": 3,
        "periodic": 4,
    },
    "planish_v_rule": {
        "endpoints": 0,
        "mean": 1,
    },
    "planish_v_slopes": {
        "smooth": 0,
        "monotone": 1,
    },
    "planish_pht_estimator": {
        "global": 0,
        "local_quadratic": 1,
        "local_cubic": 2,
    },
    "planish_coarsening": {
        "auto": 0,
        "on": 1,
        "off": 2,
    },
    "planish_border_side": {
        "low_u": 0,
        "high_u": 1,
        "low_v": 2,
        "high_v": 3,
    },
    "planish_pht_basis": {
        "canonical": 0,
        "support_sized": 1,
    },
    "planish_d1rc_mode": {
        "reproducing": 0,
        "paper": 1,
    },
    "planish_d1rc_boundary": {
        "phantom": 0,
        "clamped": 1,
        "open": 2,
    },
    "planish_d1rc_sharp": {
        "automatic": 0,
        "cut": 1,
        "sector": 2,
        "additive": 3,
    },
}

planish_progress = CFUNCTYPE(c_int32, c_double, c_double, c_void_p)


class planish_mesh_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("point_stride", c_size_t),
        ("triangle_stride", c_size_t),
        ("weld_distance", c_double),
        ("out_repairs", c_void_p),
        ("out_node_map", c_void_p),
        ("orient", c_uint32),
        ("index_base", c_uint32),
        ("face_sizes", c_void_p),
        ("max_memory", c_uint64),
        ("repair", c_uint32),
        ("components", c_uint32),
        ("component", c_uint32),
        ("format", c_uint32),
        ("corner_count", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "components": "planish_mesh_components",
        "format": "planish_mesh_format",
    }
    bits = {
        "repair": "planish_mesh_repair",
    }
    elements = {
        "out_node_map": c_uint32,
        "face_sizes": c_uint32,
    }
    arrays = {
        "out_node_map": ("nodes",),
        "face_sizes": ("faces",),
    }


class planish_mesh_repairs(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("welded_node_count", c_size_t),
        ("dropped_triangle_count", c_size_t),
        ("flipped_triangle_count", c_size_t),
        ("dropped_parameters", c_uint32),
        ("missing_end", c_uint32),
        ("unused_node_count", c_size_t),
        ("split_node_count", c_size_t),
        ("duplicate_triangle_count", c_size_t),
        ("parted_edge_count", c_size_t),
        ("excluded_triangle_count", c_size_t),
    ]


class planish_mesh_write_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("format", c_uint32),
        ("text", c_uint32),
    ]
    choices = {
        "format": "planish_mesh_format",
    }


class planish_decimate_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("target_count", c_size_t),
        ("sharp_angle", c_double),
        ("corner_angle", c_double),
        ("sharp_edges", c_void_p),
        ("sharp_edge_count", c_size_t),
        ("out_sharp_edges", c_void_p),
        ("out_sharp_edge_count", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("keep_map", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "sharp_edges": c_uint32,
        "out_sharp_edges": c_uint32,
        "out_stage": c_uint32,
    }
    arrays = {
        "sharp_edges": ("sharp_edge_count", "2",),
        "out_sharp_edges": ("out_sharp_edge_count", "2",),
        "out_stage": ("1",),
    }


class planish_decimate_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("collapse_count", c_size_t),
        ("excess_count", c_size_t),
        ("sharp_edge_count", c_size_t),
        ("seconds", c_double),
    ]


class planish_parameterize_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("node_weights", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("bulge", c_double),
        ("boundary_slide", c_double),
        ("method", c_uint32),
        ("border", c_uint32),
        ("corners", c_uint32 * 4),
        ("stretch_steps", c_uint32),
        ("rings", c_uint32),
        ("fill_holes", c_uint32),
        ("unroll", c_uint32),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "method": "planish_map_method",
        "border": "planish_border",
    }
    elements = {
        "node_weights": c_double,
        "out_stage": c_uint32,
    }
    arrays = {
        "node_weights": ("nodes",),
        "out_stage": ("1",),
    }


class planish_parameterize_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("stretch", c_double),
        ("max_stretch", c_double),
        ("area_ratio", c_double),
        ("seconds", c_double),
        ("flipped_count", c_size_t),
        ("degenerate_count", c_size_t),
        ("solve_count", c_size_t),
        ("step_count", c_size_t),
        ("remarks", c_uint64),
        ("border", c_uint32),
        ("border_slid", c_uint32),
    ]
    choices = {
        "border": "planish_border",
    }
    bits = {
        "remarks": "planish_remark",
    }


class planish_sphere_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("sweeps", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_sphere_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("energy", c_double),
        ("folded_triangles", c_size_t),
        ("clamped_triangles", c_size_t),
        ("low_area_ratio", c_double),
        ("high_area_ratio", c_double),
        ("seconds", c_double),
    ]


class planish_feature_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sharp_angle", c_double),
        ("weak_angle", c_double),
        ("corner_angle", c_double),
        ("least_length", c_double),
        ("sharp_edges", c_void_p),
        ("sharp_edge_count", c_size_t),
        ("labels", c_void_p),
        ("out_is_corner", c_void_p),
        ("out_report", c_void_p),
        ("filter_noise", c_uint32),
        ("reserved", c_uint32),
    ]
    elements = {
        "sharp_edges": c_uint32,
        "labels": c_uint32,
        "out_is_corner": c_uint8,
    }
    arrays = {
        "sharp_edges": ("sharp_edge_count", "2",),
        "labels": ("mesh_triangle_count",),
        "out_is_corner": ("mesh_point_count",),
    }


class planish_feature_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("edge_count", c_size_t),
        ("border_edge_count", c_size_t),
        ("chain_count", c_size_t),
        ("closed_chain_count", c_size_t),
        ("corner_count", c_size_t),
        ("prolonged_edge_count", c_size_t),
        ("dropped_edge_count", c_size_t),
        ("noise", c_double),
    ]


class planish_layout_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("edges", c_void_p),
    ]
    elements = {
        "edges": c_uint32,
    }
    arrays = {
        "edges": ("quad_count", "4",),
    }


class planish_mesh_layout_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("kind", c_uint32),
        ("patches", c_uint32),
        ("sweeps", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "kind": "planish_layout_kind",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_mesh_layout_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("energy", c_double),
        ("first_energy", c_double),
        ("folded_node_count", c_size_t),
        ("spread_node_count", c_size_t),
        ("doublet_count", c_size_t),
        ("split_count", c_size_t),
        ("seconds", c_double),
        ("kind", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "kind": "planish_layout_kind",
    }


class planish_fit_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_error", c_double),
        ("rms_error", c_double),
        ("mean_error", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("max_interior_error", c_double),
        ("facet_sagitta", c_double),
        ("max_distance", c_double),
        ("smoothing", c_double),
        ("stretch", c_double),
        ("parameterize_seconds", c_double),
        ("seconds", c_double),
        ("worst_index", c_size_t),
        ("grid_u", c_size_t),
        ("grid_v", c_size_t),
        ("coefficient_count", c_size_t),
        ("empty_cell_count", c_size_t),
        ("flipped_count", c_size_t),
        ("remarks", c_uint64),
        ("pass_count", c_uint32),
        ("stop_reason", c_uint32),
        ("cell_count", c_size_t),
        ("rough_cell_count", c_size_t),
        ("deepest_level", c_uint32),
        ("reserved", c_uint32),
        ("max_fixed_error", c_double),
        ("max_tolerance_share", c_double),
        ("left_out_count", c_size_t),
        ("mirror_distance", c_double),
        ("max_side_error", c_double),
        ("max_side_angle", c_double),
        ("refined_coefficient_count", c_size_t),
    ]
    choices = {
        "stop_reason": "planish_stop_reason",
    }
    bits = {
        "remarks": "planish_remark",
    }


class planish_eval_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("uv_stride", c_size_t),
        ("out_stride", c_size_t),
        ("out_flags", c_void_p),
        ("outside", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "outside": "planish_outside",
    }
    bits = {
        "out_flags": "planish_flag",
    }
    elements = {
        "out_flags": c_uint8,
    }
    arrays = {
        "out_flags": ("points",),
    }


class planish_trim_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("tolerance_scale", c_uint32),
        ("add", c_uint32),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_trim_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_vertex_distance", c_double),
        ("rms_vertex_distance", c_double),
        ("max_distance_between", c_double),
        ("rms_distance_between", c_double),
        ("worst_parameter", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("seconds", c_double),
        ("worst_curve", c_size_t),
        ("vertex_count", c_size_t),
        ("unproven_count", c_size_t),
    ]


class planish_patch(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("u_min", c_double),
        ("u_max", c_double),
        ("v_min", c_double),
        ("v_max", c_double),
        ("ordinate_count", c_size_t),
        ("ordinate_width", c_size_t),
        ("degree_u", c_uint32),
        ("degree_v", c_uint32),
        ("is_rational", c_uint32),
        ("reserved", c_uint32),
    ]


class planish_convert_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_coefficients", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_tensor_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("buffer", c_double),
        ("parameterize", c_void_p),
        ("weights", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("out_parameters", c_void_p),
        ("out_errors", c_void_p),
        ("max_coefficients", c_size_t),
        ("tolerance_scale", c_uint32),
        ("method", c_uint32),
        ("ends", c_uint32),
        ("energy", c_uint32),
        ("regularize", c_uint32),
        ("max_grid", c_uint32),
        ("grid_u", c_uint32),
        ("grid_v", c_uint32),
        ("correction_sweeps", c_uint32),
        ("measure_distance", c_uint32),
        ("thread_count", c_uint32),
        ("knots", c_uint32),
        ("missing", c_uint32),
        ("symmetry", c_uint32),
        ("tolerances", c_void_p),
        ("fixed", c_void_p),
        ("out_left_out", c_void_p),
        ("outlier_share", c_double),
        ("outlier_scale", c_double),
        ("fixed_count", c_size_t),
        ("plane", c_void_p),
        ("out_plane", c_void_p),
        ("curve_u_low", c_void_p),
        ("curve_u_high", c_void_p),
        ("curve_v_low", c_void_p),
        ("curve_v_high", c_void_p),
        ("neighbour_u_low", c_void_p),
        ("neighbour_u_high", c_void_p),
        ("neighbour_v_low", c_void_p),
        ("neighbour_v_high", c_void_p),
        ("period_u", c_double),
        ("period_v", c_double),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "method": "planish_tensor_method",
        "ends": "planish_ends",
        "energy": "planish_energy",
        "regularize": "planish_regularize",
        "knots": "planish_knots",
        "missing": "planish_missing",
        "symmetry": "planish_symmetry",
    }
    elements = {
        "weights": c_double,
        "out_stage": c_uint32,
        "out_parameters": c_double,
        "out_errors": c_double,
        "tolerances": c_double,
        "fixed": c_uint32,
        "out_left_out": c_uint8,
        "plane": c_double,
        "out_plane": c_double,
    }
    arrays = {
        "weights": ("data",),
        "out_stage": ("1",),
        "out_parameters": ("data", "2",),
        "out_errors": ("data",),
        "tolerances": ("data",),
        "fixed": ("fixed_count",),
        "out_left_out": ("data",),
        "plane": ("6",),
        "out_plane": ("6",),
    }


class planish_field_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("buffer", c_double),
        ("parameterize", c_void_p),
        ("weights", c_void_p),
        ("mask", c_void_p),
        ("sample_values", c_void_p),
        ("sample_dim", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("tolerance_scale", c_uint32),
        ("ends", c_uint32),
        ("energy", c_uint32),
        ("grid_u", c_uint32),
        ("grid_v", c_uint32),
        ("thread_count", c_uint32),
        ("missing", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "ends": "planish_ends",
        "energy": "planish_energy",
        "missing": "planish_missing",
    }
    elements = {
        "weights": c_double,
        "mask": c_uint8,
        "sample_values": c_double,
        "out_stage": c_uint32,
    }
    arrays = {
        "weights": ("nodes",),
        "mask": ("nodes",),
        "sample_values": ("nodes", "sample_dim",),
        "out_stage": ("1",),
    }


class planish_gradient_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("uv_stride", c_size_t),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]


class planish_smooth_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("tolerance", c_double),
        ("join_tolerance", c_double),
        ("smoothing", c_double),
        ("max_cells", c_size_t),
        ("tolerance_scale", c_uint32),
        ("max_rounds", c_uint32),
        ("level_spread", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_smooth_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_deviation", c_double),
        ("rms_deviation", c_double),
        ("mean_deviation", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("given_gap", c_double),
        ("given_normal_jump", c_double),
        ("gap", c_double),
        ("normal_jump", c_double),
        ("volume", c_double),
        ("seconds", c_double),
        ("worst_patch", c_size_t),
        ("joined_count", c_size_t),
        ("free_count", c_size_t),
        ("piece_count", c_size_t),
        ("coefficient_count", c_size_t),
        ("cell_count", c_size_t),
        ("remarks", c_uint64),
        ("pass_count", c_uint32),
        ("stop_reason", c_uint32),
    ]
    choices = {
        "stop_reason": "planish_stop_reason",
    }
    bits = {
        "remarks": "planish_remark",
    }


class planish_transfer_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("field", c_void_p),
        ("max_distance", c_double),
        ("distance_scale", c_uint32),
        ("far_rule", c_uint32),
    ]
    choices = {
        "distance_scale": "planish_tolerance_scale",
        "far_rule": "planish_far_rule",
    }


class planish_transfer_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_distance", c_double),
        ("rms_distance", c_double),
        ("limit", c_double),
        ("max_shape_error", c_double),
        ("rms_shape_error", c_double),
        ("seconds", c_double),
        ("farthest_index", c_size_t),
        ("far_count", c_size_t),
        ("grid_u", c_size_t),
        ("grid_v", c_size_t),
        ("coefficient_count", c_size_t),
        ("remarks", c_uint64),
    ]
    bits = {
        "remarks": "planish_remark",
    }


class planish_balance_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("force_given", c_double * 3),
        ("force_arrived", c_double * 3),
        ("force_error", c_double),
        ("moment_given", c_double * 3),
        ("moment_arrived", c_double * 3),
        ("moment_error", c_double),
        ("moment_bound", c_double),
        ("work_given", c_double),
        ("work_arrived", c_double),
        ("work_error", c_double),
    ]


class planish_tessellate_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("chord_tolerance", c_double),
        ("max_edge_length", c_double),
        ("max_point_count", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("keep_trims", c_uint32),
        ("thread_count", c_uint32),
        ("out_report", c_void_p),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_tessellate_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("smallest_angle", c_double),
        ("chord_error", c_double),
    ]


class planish_project_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("guesses", c_void_p),
        ("max_distance", c_double),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("keep_trims", c_uint32),
        ("thread_count", c_uint32),
        ("out_flags", c_void_p),
    ]
    choices = {
        "out_stage": "planish_stage",
        "out_flags": "planish_flag",
    }
    elements = {
        "guesses": c_double,
        "out_stage": c_uint32,
        "out_flags": c_uint8,
    }
    arrays = {
        "guesses": ("points", "2",),
        "out_stage": ("1",),
        "out_flags": ("points",),
    }


class planish_deviation_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("chord_tolerance", c_double),
        ("max_edge_length", c_double),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("keep_trims", c_uint32),
        ("use_parameters", c_uint32),
        ("measure_back", c_uint32),
        ("thread_count", c_uint32),
        ("out_signed", c_void_p),
        ("out_uv", c_void_p),
        ("out_faces", c_void_p),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
        "out_signed": c_double,
        "out_uv": c_double,
        "out_faces": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
        "out_signed": ("mesh_point_count",),
        "out_uv": ("mesh_point_count", "2",),
        "out_faces": ("mesh_point_count",),
    }


class planish_deviation_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_distance", c_double),
        ("rms_distance", c_double),
        ("mean_distance", c_double),
        ("max_back_distance", c_double),
        ("worst_back_u", c_double),
        ("worst_back_v", c_double),
        ("worst_index", c_size_t),
        ("back_count", c_size_t),
        ("unproven_count", c_size_t),
        ("median_distance", c_double),
        ("distance_95", c_double),
        ("distance_99", c_double),
    ]


class planish_sample_rows_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("spacing", c_double),
        ("begin_index", c_size_t),
        ("end_index", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("begin", c_uint32),
        ("end", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "begin": "planish_row_source",
        "end": "planish_row_source",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_fair_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("tolerance_scale", c_uint32),
        ("energy", c_uint32),
        ("border", c_uint32),
        ("limit", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "energy": "planish_fairness",
        "border": "planish_kept_border",
        "limit": "planish_fair_limit",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_fair_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("energy_before", c_double),
        ("energy_after", c_double),
        ("max_deviation", c_double),
        ("rms_deviation", c_double),
        ("max_movement", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("smoothing", c_double),
        ("seconds", c_double),
        ("pass_count", c_size_t),
    ]


class planish_vtk_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("deviation_from", c_void_p),
        ("tessellate", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("thread_count", c_uint32),
        ("content", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "content": "planish_vtk_content",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_step_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("curve_deviation", c_double),
        ("uncertainty", c_double),
        ("diagonal", c_double),
        ("loop_count", c_size_t),
        ("edge_count", c_size_t),
        ("face_count", c_size_t),
        ("pole_count", c_size_t),
    ]


class planish_step_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("product", c_char_p),
        ("author", c_char_p),
        ("organization", c_char_p),
        ("timestamp", c_char_p),
        ("out_report", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("schema", c_uint32),
        ("unit", c_uint32),
        ("max_coefficients", c_size_t),
        ("form", c_uint32),
        ("level_spread", c_uint32),
        ("tolerance", c_double),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "schema": "planish_step_schema",
        "unit": "planish_unit",
        "form": "planish_step_form",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_report_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("title", c_char_p),
        ("unit", c_char_p),
        ("tolerance", c_double),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("remarks", c_uint64),
        ("tolerance_scale", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
    }
    bits = {
        "remarks": "planish_remark",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_edge_info(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("angle", c_double),
        ("gap", c_double),
        ("face_along", c_uint32),
        ("face_against", c_uint32),
        ("vertex_start", c_uint32),
        ("vertex_end", c_uint32),
        ("is_sharp", c_uint32),
        ("shape", c_uint32),
        ("origin", c_double * 3),
        ("axis", c_double * 3),
        ("x_axis", c_double * 3),
        ("radii", c_double * 2),
    ]
    choices = {
        "shape": "planish_edge_shape",
    }


class planish_face_info(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("origin", c_double * 3),
        ("axis", c_double * 3),
        ("x_axis", c_double * 3),
        ("radius", c_double),
        ("loop_count", c_size_t),
        ("coedge_count", c_size_t),
        ("carrier", c_uint32),
        ("label", c_uint32),
        ("shell", c_uint32),
        ("is_forward", c_uint32),
        ("max_error", c_double),
        ("rms_error", c_double),
        ("node_count", c_size_t),
    ]
    choices = {
        "carrier": "planish_carrier",
    }


class planish_shell_info(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("face_count", c_size_t),
        ("role", c_uint32),
        ("void_in", c_uint32),
    ]
    choices = {
        "role": "planish_shell_role",
    }


class planish_measure_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("box_min", c_double * 3),
        ("box_max", c_double * 3),
        ("area", c_double),
        ("volume", c_double),
        ("max_gap", c_double),
        ("max_normal_jump", c_double),
        ("curve_deviation", c_double),
        ("diagonal", c_double),
        ("free_edge_count", c_size_t),
        ("sharp_edge_count", c_size_t),
        ("pole_count", c_size_t),
        ("loop_count", c_size_t),
        ("euler_characteristic", c_int64),
    ]


class planish_model_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("out_faces", c_void_p),
        ("out_uv", c_void_p),
        ("out_errors", c_void_p),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("max_cells", c_size_t),
        ("min_samples", c_size_t),
        ("patches", c_size_t),
        ("tolerance_scale", c_uint32),
        ("family", c_uint32),
        ("layout", c_uint32),
        ("start_level", c_uint32),
        ("max_level", c_uint32),
        ("grade", c_uint32),
        ("foot_steps", c_uint32),
        ("guard", c_uint32),
        ("max_rounds", c_uint32),
        ("sweeps", c_uint32),
        ("level_spread", c_uint32),
        ("thread_count", c_uint32),
        ("sharp_angle", c_double),
        ("labels", c_void_p),
        ("label_count", c_size_t),
        ("exact", c_uint32),
        ("smooth", c_uint32),
        ("label_angle", c_double),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "family": "planish_model_family",
        "layout": "planish_model_layout",
    }
    elements = {
        "out_stage": c_uint32,
        "out_faces": c_uint32,
        "out_uv": c_double,
        "out_errors": c_double,
        "labels": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
        "out_faces": ("mesh_point_count",),
        "out_uv": ("mesh_point_count", "2",),
        "out_errors": ("mesh_point_count",),
        "labels": ("label_count",),
    }


class planish_model_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("max_error", c_double),
        ("rms_error", c_double),
        ("mean_error", c_double),
        ("tolerance", c_double),
        ("diagonal", c_double),
        ("max_interior_error", c_double),
        ("facet_sagitta", c_double),
        ("max_back_distance", c_double),
        ("normal_jump", c_double),
        ("gap", c_double),
        ("volume", c_double),
        ("mesh_volume", c_double),
        ("map_energy", c_double),
        ("map_seconds", c_double),
        ("fit_seconds", c_double),
        ("seconds", c_double),
        ("worst_node", c_size_t),
        ("component_count", c_size_t),
        ("void_count", c_size_t),
        ("turned_count", c_size_t),
        ("genus", c_size_t),
        ("patch_count", c_size_t),
        ("coefficient_count", c_size_t),
        ("free_count", c_size_t),
        ("cell_count", c_size_t),
        ("fold_count", c_size_t),
        ("dropped_count", c_size_t),
        ("remarks", c_uint64),
        ("deepest_level", c_uint32),
        ("pass_count", c_uint32),
        ("stop_reason", c_uint32),
        ("is_chart", c_uint32),
        ("mesh_crossing_count", c_size_t),
        ("crossing_count", c_size_t),
        ("exact_face_count", c_size_t),
        ("rounded_count", c_size_t),
    ]
    choices = {
        "stop_reason": "planish_stop_reason",
    }
    bits = {
        "remarks": "planish_remark",
    }


class planish_curve_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("buffer", c_double),
        ("weights", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("out_errors", c_void_p),
        ("tolerance_scale", c_uint32),
        ("method", c_uint32),
        ("ends", c_uint32),
        ("max_grid", c_uint32),
        ("grid", c_uint32),
        ("thread_count", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "method": "planish_tensor_method",
        "ends": "planish_ends",
    }
    elements = {
        "weights": c_double,
        "out_stage": c_uint32,
        "out_errors": c_double,
    }
    arrays = {
        "weights": ("data",),
        "out_stage": ("1",),
        "out_errors": ("data",),
    }


class planish_interpolate_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("end_slopes", c_void_p),
        ("ends", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "ends": "planish_section_ends",
    }
    elements = {
        "end_slopes": c_double,
    }
    arrays = {
        "end_slopes": ("2", "dim",),
    }


class planish_skin_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("overshoot", c_double),
        ("certified_distance", c_double),
        ("v_error", c_double),
        ("twisted_row", c_int64),
        ("curve_count", c_size_t),
        ("least_count", c_size_t),
        ("largest_count", c_size_t),
        ("tensor_count", c_size_t),
        ("strip_count", c_size_t),
        ("common_count", c_size_t),
        ("removed_knot_count", c_size_t),
        ("merged_point_count", c_size_t),
        ("aligned_row_count", c_size_t),
    ]


class planish_skin_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("end_slopes", c_void_p),
        ("begin_tangents", c_void_p),
        ("end_tangents", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("out_parameters", c_void_p),
        ("out_errors", c_void_p),
        ("out_report", c_void_p),
        ("dim", c_size_t),
        ("tolerance_scale", c_uint32),
        ("method", c_uint32),
        ("closed", c_uint32),
        ("ends", c_uint32),
        ("closed_v", c_uint32),
        ("v_rule", c_uint32),
        ("align", c_uint32),
        ("approximate_v", c_uint32),
        ("extra_checks", c_uint32),
        ("batch", c_uint32),
        ("removal", c_uint32),
        ("certify", c_uint32),
        ("compare", c_uint32),
        ("thread_count", c_uint32),
        ("v_slopes", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "method": "planish_skin_method",
        "ends": "planish_section_ends",
        "v_rule": "planish_v_rule",
        "v_slopes": "planish_v_slopes",
    }
    elements = {
        "end_slopes": c_double,
        "begin_tangents": c_double,
        "end_tangents": c_double,
        "out_stage": c_uint32,
        "out_parameters": c_double,
        "out_errors": c_double,
    }
    arrays = {
        "end_slopes": ("rows", "2", "dim",),
        "begin_tangents": ("*", "dim",),
        "end_tangents": ("*", "dim",),
        "out_stage": ("1",),
        "out_parameters": ("data", "2",),
        "out_errors": ("data",),
    }


class planish_pht_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("parameterize", c_void_p),
        ("weights", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("out_parameters", c_void_p),
        ("out_errors", c_void_p),
        ("max_cells", c_size_t),
        ("tolerance_scale", c_uint32),
        ("estimator", c_uint32),
        ("regularize", c_uint32),
        ("grid_u", c_uint32),
        ("grid_v", c_uint32),
        ("max_level", c_uint32),
        ("min_samples", c_uint32),
        ("grade", c_uint32),
        ("correction_sweeps", c_uint32),
        ("measure_distance", c_uint32),
        ("thread_count", c_uint32),
        ("symmetry", c_uint32),
        ("missing", c_uint32),
        ("reserved_end", c_uint32),
        ("tolerances", c_void_p),
        ("fixed", c_void_p),
        ("out_left_out", c_void_p),
        ("outlier_share", c_double),
        ("outlier_scale", c_double),
        ("fixed_count", c_size_t),
        ("plane", c_void_p),
        ("out_plane", c_void_p),
        ("curve_u_low", c_void_p),
        ("curve_u_high", c_void_p),
        ("curve_v_low", c_void_p),
        ("curve_v_high", c_void_p),
        ("neighbour_u_low", c_void_p),
        ("neighbour_u_high", c_void_p),
        ("neighbour_v_low", c_void_p),
        ("neighbour_v_high", c_void_p),
        ("continuity", c_uint32),
        ("coarsening", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "tolerance_scale": "planish_tolerance_scale",
        "estimator": "planish_pht_estimator",
        "regularize": "planish_regularize",
        "symmetry": "planish_symmetry",
        "missing": "planish_missing",
        "coarsening": "planish_coarsening",
    }
    elements = {
        "weights": c_double,
        "out_stage": c_uint32,
        "out_parameters": c_double,
        "out_errors": c_double,
        "tolerances": c_double,
        "fixed": c_uint32,
        "out_left_out": c_uint8,
        "plane": c_double,
        "out_plane": c_double,
    }
    arrays = {
        "weights": ("data",),
        "out_stage": ("1",),
        "out_parameters": ("data", "2",),
        "out_errors": ("data",),
        "tolerances": ("data",),
        "fixed": ("fixed_count",),
        "out_left_out": ("data",),
        "plane": ("6",),
        "out_plane": ("6",),
    }


class planish_pht_simplify_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_pht_convert_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("tolerance", c_double),
        ("max_cells", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("max_level", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_pht_patches_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("level_spread", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
    }
    elements = {
        "out_stage": c_uint32,
    }
    arrays = {
        "out_stage": ("1",),
    }


class planish_d1rc_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sharp_edges", c_void_p),
        ("sharp_edge_count", c_size_t),
        ("corners", c_void_p),
        ("corner_count", c_size_t),
        ("sharp_angle", c_double),
        ("sharp_weight", c_double),
        ("parameterize", c_void_p),
        ("progress", planish_progress),
        ("user", c_void_p),
        ("cancel", c_void_p),
        ("out_stage", c_void_p),
        ("tolerance", c_double),
        ("smoothing", c_double),
        ("control_mesh", c_void_p),
        ("weights", c_void_p),
        ("out_parameters", c_void_p),
        ("out_errors", c_void_p),
        ("control_count", c_size_t),
        ("max_control_count", c_size_t),
        ("degree", c_uint32),
        ("mode", c_uint32),
        ("boundary", c_uint32),
        ("sharp", c_uint32),
        ("tolerance_scale", c_uint32),
        ("correction_sweeps", c_uint32),
        ("thread_count", c_uint32),
        ("reserved", c_uint32),
    ]
    choices = {
        "out_stage": "planish_stage",
        "mode": "planish_d1rc_mode",
        "boundary": "planish_d1rc_boundary",
        "sharp": "planish_d1rc_sharp",
        "tolerance_scale": "planish_tolerance_scale",
    }
    elements = {
        "sharp_edges": c_uint32,
        "corners": c_uint32,
        "out_stage": c_uint32,
        "weights": c_double,
        "out_parameters": c_double,
        "out_errors": c_double,
    }
    arrays = {
        "sharp_edges": ("sharp_edge_count", "2",),
        "corners": ("corner_count",),
        "out_stage": ("1",),
        "weights": ("nodes",),
        "out_parameters": ("nodes", "2",),
        "out_errors": ("nodes",),
    }


#: Bytes of each record.
SIZES = {
    planish_mesh_options: 96,
    planish_mesh_repairs: 80,
    planish_mesh_write_options: 16,
    planish_decimate_options: 104,
    planish_decimate_report: 40,
    planish_parameterize_options: 112,
    planish_parameterize_report: 88,
    planish_sphere_options: 48,
    planish_sphere_report: 56,
    planish_feature_options: 88,
    planish_feature_report: 72,
    planish_layout_options: 16,
    planish_mesh_layout_options: 56,
    planish_mesh_layout_report: 72,
    planish_fit_report: 248,
    planish_eval_options: 40,
    planish_trim_options: 64,
    planish_trim_report: 96,
    planish_patch: 72,
    planish_convert_options: 48,
    planish_tensor_options: 304,
    planish_field_options: 136,
    planish_gradient_options: 24,
    planish_smooth_options: 88,
    planish_smooth_report: 160,
    planish_transfer_options: 32,
    planish_transfer_report: 104,
    planish_balance_report: 152,
    planish_tessellate_options: 80,
    planish_tessellate_report: 24,
    planish_project_options: 72,
    planish_deviation_options: 96,
    planish_deviation_report: 104,
    planish_sample_rows_options: 72,
    planish_fair_options: 64,
    planish_fair_report: 88,
    planish_vtk_options: 64,
    planish_step_report: 64,
    planish_step_options: 120,
    planish_report_options: 80,
    planish_edge_info: 136,
    planish_face_info: 144,
    planish_shell_info: 24,
    planish_measure_report: 144,
    planish_model_options: 192,
    planish_model_report: 280,
    planish_curve_options: 104,
    planish_interpolate_options: 24,
    planish_skin_report: 112,
    planish_skin_options: 168,
    planish_pht_options: 288,
    planish_pht_simplify_options: 40,
    planish_pht_convert_options: 64,
    planish_pht_patches_options: 48,
    planish_d1rc_options: 192,
}
if sizeof(c_void_p) == 8:
    for _record, _size in SIZES.items():
        assert sizeof(_record) == _size, _record.__name__

#: The types of each function's result and arguments.
FUNCTIONS = {
    "planish_version": (c_char_p,),
    "planish_check_version": (c_int32, c_uint32, c_uint32),
    "planish_status_name": (c_char_p, c_int32),
    "planish_error_message": (c_size_t, c_void_p, c_size_t),
    "planish_error_index": (c_int64,),
    "planish_mesh_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_new": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_mesh_clone": (c_int32, c_void_p, c_void_p),
    "planish_mesh_free": (None, c_void_p),
    "planish_mesh_point_count": (c_size_t, c_void_p),
    "planish_mesh_triangle_count": (c_size_t, c_void_p),
    "planish_mesh_edge_count": (c_size_t, c_void_p),
    "planish_mesh_component_count": (c_size_t, c_void_p),
    "planish_mesh_genus": (c_size_t, c_void_p),
    "planish_mesh_euler_characteristic": (c_int64, c_void_p),
    "planish_mesh_loop_count": (c_size_t, c_void_p),
    "planish_mesh_loop_point_count": (c_size_t, c_void_p, c_size_t),
    "planish_mesh_copy_points": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_copy_triangles": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_copy_node_map": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_copy_triangle_map": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_set_points": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_copy_loop": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t),
    "planish_mesh_field_count": (c_size_t, c_void_p),
    "planish_mesh_field_name": (c_size_t, c_void_p, c_size_t, c_void_p, c_size_t),
    "planish_mesh_copy_field": (c_int32, c_void_p, c_char_p, c_void_p, c_size_t),
    "planish_mesh_set_field": (c_int32, c_void_p, c_char_p, c_void_p, c_size_t),
    "planish_mesh_remove_field": (c_int32, c_void_p, c_char_p),
    "planish_mesh_has_parameters": (c_uint32, c_void_p),
    "planish_mesh_set_parameters": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_copy_parameters": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_remove_triangles": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_mesh_cut_along": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_mesh_split_components": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_mesh_shortest_path": (c_int32, c_void_p, c_uint32, c_uint32, c_void_p, c_size_t, c_void_p),
    "planish_mesh_write_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_read": (c_int32, c_char_p, c_void_p, c_void_p),
    "planish_mesh_read_buffer": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_mesh_write": (c_int32, c_void_p, c_char_p, c_void_p),
    "planish_decimate_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_decimate": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_parameterize_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_parameterize": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_sphere_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_map_to_sphere": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_feature_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_find_features": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_mesh_label_parts": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_layout_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_layout_options_init": (c_int32, c_void_p, c_size_t),
    "planish_layout_new": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_layout_cube": (c_int32, c_void_p),
    "planish_layout_of_mesh": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_layout_free": (None, c_void_p),
    "planish_layout_quad_count": (c_size_t, c_void_p),
    "planish_layout_vertex_count": (c_size_t, c_void_p),
    "planish_layout_edge_count": (c_size_t, c_void_p),
    "planish_layout_node_count": (c_size_t, c_void_p),
    "planish_layout_copy_corners": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_layout_copy_edges": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_layout_copy_valences": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_layout_copy_node_map": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t),
    "planish_surface_kind": (c_uint32, c_void_p),
    "planish_surface_dim": (c_size_t, c_void_p),
    "planish_surface_coefficient_count": (c_size_t, c_void_p),
    "planish_surface_domain": (c_int32, c_void_p, c_void_p),
    "planish_surface_data_box": (c_int32, c_void_p, c_void_p),
    "planish_surface_clone": (c_int32, c_void_p, c_void_p),
    "planish_surface_free": (None, c_void_p),
    "planish_eval_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_eval": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_surface_eval_derivatives": (c_int32, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p, c_void_p),
    "planish_surface_eval_grid": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_surface_normals": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_surface_curvatures": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_surface_trim_count": (c_size_t, c_void_p),
    "planish_surface_trim_point_count": (c_size_t, c_void_p, c_size_t),
    "planish_surface_copy_trim": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t),
    "planish_surface_set_trims": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t),
    "planish_trim_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_trim_by_curves": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_surface_patch_count": (c_size_t, c_void_p),
    "planish_surface_patch_at": (c_size_t, c_void_p, c_double, c_double),
    "planish_surface_copy_patch": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p, c_size_t),
    "planish_convert_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_to_tensor": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_tensor_options_init": (c_int32, c_void_p, c_size_t),
    "planish_tensor_fit": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_tensor_fit_points": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_tensor_fit_field": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_tensor_new": (c_int32, c_size_t, c_uint32, c_uint32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_tensor_degree": (c_uint32, c_void_p, c_uint32),
    "planish_tensor_knot_count": (c_size_t, c_void_p, c_uint32),
    "planish_tensor_control_point_count": (c_size_t, c_void_p, c_uint32),
    "planish_tensor_copy_knots": (c_int32, c_void_p, c_uint32, c_void_p, c_size_t),
    "planish_tensor_copy_control_points": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_tensor_has_weights": (c_uint32, c_void_p),
    "planish_tensor_copy_weights": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_tensor_insert_knots": (c_int32, c_void_p, c_uint32, c_void_p, c_size_t),
    "planish_tensor_elevate_degree": (c_int32, c_void_p, c_uint32, c_uint32),
    "planish_tensor_reverse": (c_int32, c_void_p, c_uint32),
    "planish_tensor_split": (c_int32, c_void_p, c_uint32, c_double, c_void_p, c_void_p),
    "planish_field_options_init": (c_int32, c_void_p, c_size_t),
    "planish_field_fitter_new": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_field_fitter_new_points": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_field_fitter_new_model": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_field_fitter_free": (None, c_void_p),
    "planish_field_fitter_point_count": (c_size_t, c_void_p),
    "planish_field_fitter_grid": (c_int32, c_void_p, c_void_p),
    "planish_field_fitter_copy_parameters": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_field_fitter_fit": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p),
    "planish_field_fitter_fit_model": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p),
    "planish_field_fitter_update": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_size_t),
    "planish_tensor_combine": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_gradient_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_field_gradient": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_smooth_options_init": (c_int32, c_void_p, c_size_t),
    "planish_model_smooth_from_patches": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_transfer_options_init": (c_int32, c_void_p, c_size_t),
    "planish_transfer_new": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_transfer_new_model": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_transfer_free": (None, c_void_p),
    "planish_transfer_source_count": (c_size_t, c_void_p),
    "planish_transfer_target_count": (c_size_t, c_void_p),
    "planish_transfer_copy_parameters": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_transfer_copy_distances": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_transfer_apply": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p),
    "planish_transfer_apply_transpose": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p),
    "planish_transfer_balance": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_tessellate_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_tessellate": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_project_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_project": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_deviation_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_deviation": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_mesh_project": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_sample_rows_options_init": (c_int32, c_void_p, c_size_t),
    "planish_mesh_sample_rows": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "planish_surface_box": (c_int32, c_void_p, c_void_p),
    "planish_surface_area": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_surface_is_closed": (c_uint32, c_void_p, c_uint32),
    "planish_fair_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_fair": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_surface_name": (c_size_t, c_void_p, c_void_p, c_size_t),
    "planish_surface_set_name": (c_int32, c_void_p, c_char_p),
    "planish_surface_unit": (c_uint32, c_void_p),
    "planish_surface_set_unit": (c_int32, c_void_p, c_uint32),
    "planish_vtk_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_write_vtk": (c_int32, c_void_p, c_char_p, c_void_p),
    "planish_surface_save_size": (c_size_t, c_void_p),
    "planish_surface_save": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_surface_load": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_surface_save_file": (c_int32, c_void_p, c_char_p),
    "planish_surface_load_file": (c_int32, c_char_p, c_void_p),
    "planish_step_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_write_step": (c_int32, c_void_p, c_char_p, c_void_p),
    "planish_report_options_init": (c_int32, c_void_p, c_size_t),
    "planish_surface_write_report": (c_int32, c_void_p, c_void_p, c_char_p, c_void_p),
    "planish_model_write_report": (c_int32, c_void_p, c_void_p, c_char_p, c_void_p),
    "planish_model_from_surface": (c_int32, c_void_p, c_void_p),
    "planish_model_clone": (c_int32, c_void_p, c_void_p),
    "planish_model_free": (None, c_void_p),
    "planish_model_dim": (c_size_t, c_void_p),
    "planish_model_face_count": (c_size_t, c_void_p),
    "planish_model_edge_count": (c_size_t, c_void_p),
    "planish_model_vertex_count": (c_size_t, c_void_p),
    "planish_model_shell_count": (c_size_t, c_void_p),
    "planish_model_loop_count": (c_size_t, c_void_p, c_size_t),
    "planish_model_coedge_count": (c_size_t, c_void_p, c_size_t),
    "planish_model_face_info": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_model_copy_face": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_model_copy_edge": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_model_copy_loops": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p, c_size_t),
    "planish_model_copy_pcurve": (c_int32, c_void_p, c_size_t, c_size_t, c_void_p),
    "planish_model_copy_vertices": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_model_node_count": (c_size_t, c_void_p),
    "planish_model_locate_nodes": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t),
    "planish_model_copy_shell": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p, c_size_t),
    "planish_model_measure": (c_int32, c_void_p, c_void_p),
    "planish_model_write_step": (c_int32, c_void_p, c_char_p, c_void_p),
    "planish_model_write_step_memory": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_model_save_size": (c_size_t, c_void_p),
    "planish_model_save": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_model_load": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_model_save_file": (c_int32, c_void_p, c_char_p),
    "planish_model_load_file": (c_int32, c_char_p, c_void_p),
    "planish_model_options_init": (c_int32, c_void_p, c_size_t),
    "planish_model_fit": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_model_eval": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p, c_void_p),
    "planish_model_field_gradient": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_model_normals": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_model_curvatures": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_model_project": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_model_deviation": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_model_tessellate": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_model_write_vtk": (c_int32, c_void_p, c_char_p, c_void_p),
    "planish_curve_options_init": (c_int32, c_void_p, c_size_t),
    "planish_curve_fit": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_curve_new": (c_int32, c_size_t, c_uint32, c_void_p, c_size_t, c_void_p, c_void_p),
    "planish_interpolate_options_init": (c_int32, c_void_p, c_size_t),
    "planish_curve_interpolate": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p),
    "planish_curve_dim": (c_size_t, c_void_p),
    "planish_curve_degree": (c_uint32, c_void_p),
    "planish_curve_knot_count": (c_size_t, c_void_p),
    "planish_curve_control_point_count": (c_size_t, c_void_p),
    "planish_curve_copy_knots": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_curve_copy_control_points": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_curve_domain": (c_int32, c_void_p, c_void_p),
    "planish_curve_eval": (c_int32, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p, c_void_p),
    "planish_curve_clone": (c_int32, c_void_p, c_void_p),
    "planish_curve_free": (None, c_void_p),
    "planish_curve_length": (c_double, c_void_p),
    "planish_curve_arc_lengths": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_curve_project": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_curve_save_size": (c_size_t, c_void_p),
    "planish_curve_save": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_curve_load": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_curve_save_file": (c_int32, c_void_p, c_char_p),
    "planish_curve_load_file": (c_int32, c_char_p, c_void_p),
    "planish_skin_options_init": (c_int32, c_void_p, c_size_t),
    "planish_tspline_skin": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_tspline_skin_curves": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_tspline_new": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "planish_tspline_curve_count": (c_size_t, c_void_p),
    "planish_tspline_clone_curve": (c_int32, c_void_p, c_size_t, c_void_p),
    "planish_tspline_knot_count": (c_size_t, c_void_p),
    "planish_tspline_copy_knots": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_tspline_insert_knot_u": (c_int32, c_void_p, c_size_t, c_double),
    "planish_tspline_insert_knot_v": (c_int32, c_void_p, c_double),
    "planish_tspline_remove_knot_u": (c_int32, c_void_p, c_size_t, c_size_t, c_double, c_void_p),
    "planish_pht_options_init": (c_int32, c_void_p, c_size_t),
    "planish_pht_fit": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
    "planish_pht_fit_points": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_pht_fit_field": (c_int32, c_void_p, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "planish_pht_new": (c_int32, c_size_t, c_uint32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "planish_pht_split": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_pht_merge": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_pht_simplify_options_init": (c_int32, c_void_p, c_size_t),
    "planish_pht_simplify": (c_int32, c_void_p, c_double, c_void_p, c_void_p),
    "planish_pht_refine_region": (c_int32, c_void_p, c_void_p, c_uint32, c_size_t),
    "planish_pht_convert_options_init": (c_int32, c_void_p, c_size_t),
    "planish_pht_from_surface": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_pht_patches_options_init": (c_int32, c_void_p, c_size_t),
    "planish_pht_to_tensor_patches": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_pht_stitch": (c_int32, c_void_p, c_uint32, c_void_p, c_uint32, c_uint32),
    "planish_pht_cell_count": (c_size_t, c_void_p),
    "planish_pht_vertex_count": (c_size_t, c_void_p),
    "planish_pht_hanging_count": (c_size_t, c_void_p),
    "planish_pht_width": (c_size_t, c_void_p),
    "planish_pht_copy_cells": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_pht_copy_vertices": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_pht_copy_hanging": (c_int32, c_void_p, c_void_p, c_void_p, c_size_t),
    "planish_pht_copy_neighbours": (c_int32, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "planish_pht_copy_data": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_pht_set_data": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_pht_copy_control_points": (c_int32, c_void_p, c_uint32, c_void_p, c_size_t),
    "planish_pht_set_control_points": (c_int32, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p),
    "planish_pht_copy_extraction": (c_int32, c_void_p, c_size_t, c_uint32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_pht_cell_at": (c_size_t, c_void_p, c_double, c_double),
    "planish_d1rc_options_init": (c_int32, c_void_p, c_size_t),
    "planish_d1rc_new": (c_int32, c_void_p, c_void_p, c_void_p),
    "planish_d1rc_degree": (c_uint32, c_void_p),
    "planish_d1rc_set_sharp_edges": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t),
    "planish_d1rc_copy_sharp_edges": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_copy_control_points": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_d1rc_set_control_points": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_edge_continuity": (c_int32, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_copy_influence": (c_int32, c_void_p, c_uint32, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_blending_values": (c_int32, c_void_p, c_uint32, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_knot_count": (c_size_t, c_void_p),
    "planish_d1rc_copy_knots": (c_int32, c_void_p, c_void_p, c_size_t),
    "planish_d1rc_configuration_count": (c_size_t, c_void_p),
    "planish_d1rc_copy_configuration": (c_int32, c_void_p, c_size_t, c_void_p, c_void_p, c_size_t, c_void_p),
    "planish_d1rc_fit": (c_int32, c_void_p, c_void_p, c_void_p, c_void_p),
}

#: Arguments that stand for an enumerator: function, argument, enumeration.
CHOICES = {
    ("planish_surface_kind", "return"): "planish_kind",
    ("planish_tensor_degree", "axis"): "planish_axis",
    ("planish_tensor_knot_count", "axis"): "planish_axis",
    ("planish_tensor_control_point_count", "axis"): "planish_axis",
    ("planish_tensor_copy_knots", "axis"): "planish_axis",
    ("planish_tensor_insert_knots", "axis"): "planish_axis",
    ("planish_tensor_elevate_degree", "axis"): "planish_axis",
    ("planish_tensor_reverse", "axis"): "planish_axis",
    ("planish_tensor_split", "axis"): "planish_axis",
    ("planish_surface_is_closed", "axis"): "planish_axis",
    ("planish_surface_unit", "return"): "planish_unit",
    ("planish_surface_set_unit", "unit"): "planish_unit",
    ("planish_pht_stitch", "first_side"): "planish_border_side",
    ("planish_pht_stitch", "second_side"): "planish_border_side",
    ("planish_pht_copy_control_points", "basis"): "planish_pht_basis",
    ("planish_pht_set_control_points", "basis"): "planish_pht_basis",
    ("planish_pht_copy_extraction", "basis"): "planish_pht_basis",
}

#: Arrays that are not of doubles: function, argument, what they are made of.
ELEMENTS = {
    ("planish_mesh_new", "triangles"): c_uint32,
    ("planish_mesh_copy_triangles", "out_triangles"): c_uint32,
    ("planish_mesh_copy_node_map", "out_nodes"): c_uint32,
    ("planish_mesh_copy_triangle_map", "out_triangles"): c_uint32,
    ("planish_mesh_copy_loop", "out_nodes"): c_uint32,
    ("planish_mesh_remove_triangles", "triangles"): c_uint32,
    ("planish_mesh_cut_along", "nodes"): c_uint32,
    ("planish_mesh_shortest_path", "out_nodes"): c_uint32,
    ("planish_mesh_shortest_path", "out_count"): c_size_t,
    ("planish_mesh_find_features", "out_edges"): c_uint32,
    ("planish_mesh_find_features", "out_count"): c_size_t,
    ("planish_mesh_label_parts", "labels"): c_uint32,
    ("planish_mesh_label_parts", "out_labels"): c_uint32,
    ("planish_mesh_label_parts", "out_triangle_counts"): c_size_t,
    ("planish_mesh_label_parts", "out_piece_counts"): c_size_t,
    ("planish_mesh_label_parts", "out_handle_counts"): c_size_t,
    ("planish_mesh_label_parts", "out_count"): c_size_t,
    ("planish_layout_new", "corners"): c_uint32,
    ("planish_layout_copy_corners", "out_corners"): c_uint32,
    ("planish_layout_copy_edges", "out_edges"): c_uint32,
    ("planish_layout_copy_valences", "out_valences"): c_uint32,
    ("planish_layout_copy_node_map", "out_quads"): c_uint32,
    ("planish_surface_set_trims", "point_counts"): c_size_t,
    ("planish_surface_trim_by_curves", "curve_counts"): c_size_t,
    ("planish_field_fitter_grid", "out_grid"): c_size_t,
    ("planish_mesh_project", "out_triangles"): c_uint32,
    ("planish_mesh_sample_rows", "out_row_counts"): c_size_t,
    ("planish_mesh_sample_rows", "out_point_count"): c_size_t,
    ("planish_model_copy_loops", "out_sizes"): c_size_t,
    ("planish_model_copy_loops", "out_edges"): c_uint32,
    ("planish_model_copy_loops", "out_forward"): c_uint8,
    ("planish_model_locate_nodes", "out_faces"): c_uint32,
    ("planish_model_copy_shell", "out_faces"): c_uint32,
    ("planish_model_write_step_memory", "out_size"): c_size_t,
    ("planish_model_eval", "faces"): c_uint32,
    ("planish_model_field_gradient", "faces"): c_uint32,
    ("planish_model_normals", "faces"): c_uint32,
    ("planish_model_curvatures", "faces"): c_uint32,
    ("planish_model_project", "out_faces"): c_uint32,
    ("planish_tspline_skin", "row_counts"): c_size_t,
    ("planish_pht_new", "cells"): c_uint32,
    ("planish_pht_split", "cells"): c_uint32,
    ("planish_pht_merge", "cells"): c_uint32,
    ("planish_pht_to_tensor_patches", "out_count"): c_size_t,
    ("planish_pht_copy_cells", "out_cells"): c_uint32,
    ("planish_pht_copy_hanging", "out_hosts"): c_uint32,
    ("planish_pht_copy_neighbours", "out_cells"): c_uint32,
    ("planish_pht_copy_neighbours", "out_count"): c_size_t,
    ("planish_pht_set_data", "vertices"): c_uint32,
    ("planish_pht_set_control_points", "vertices"): c_uint32,
    ("planish_pht_copy_extraction", "out_vertices"): c_uint32,
    ("planish_pht_copy_extraction", "out_count"): c_size_t,
    ("planish_d1rc_set_sharp_edges", "sharp_edges"): c_uint32,
    ("planish_d1rc_set_sharp_edges", "corners"): c_uint32,
    ("planish_d1rc_copy_sharp_edges", "out_edges"): c_uint32,
    ("planish_d1rc_copy_sharp_edges", "out_count"): c_size_t,
    ("planish_d1rc_set_control_points", "vertices"): c_uint32,
    ("planish_d1rc_edge_continuity", "edges"): c_uint32,
    ("planish_d1rc_edge_continuity", "out_orders"): c_uint32,
    ("planish_d1rc_copy_influence", "out_faces"): c_uint32,
    ("planish_d1rc_copy_influence", "out_count"): c_size_t,
    ("planish_d1rc_copy_configuration", "out_knots"): c_uint32,
    ("planish_d1rc_copy_configuration", "out_edges"): c_uint32,
    ("planish_d1rc_copy_configuration", "out_count"): c_size_t,
}


class ReportFields:
    """The attributes of all reports, for type checkers; a report has those of its record."""

    aligned_row_count: int
    area: float
    area_ratio: float
    back_count: int
    border: str
    border_edge_count: int
    border_slid: int
    box_max: tuple[float, ...]
    box_min: tuple[float, ...]
    cell_count: int
    certified_distance: float
    chain_count: int
    chord_error: float
    clamped_triangles: int
    closed_chain_count: int
    coefficient_count: int
    collapse_count: int
    common_count: int
    component_count: int
    corner_count: int
    crossing_count: int
    curve_count: int
    curve_deviation: float
    deepest_level: int
    degenerate_count: int
    diagonal: float
    distance_95: float
    distance_99: float
    doublet_count: int
    dropped_count: int
    dropped_edge_count: int
    dropped_parameters: int
    dropped_triangle_count: int
    duplicate_triangle_count: int
    edge_count: int
    empty_cell_count: int
    energy: float
    energy_after: float
    energy_before: float
    euler_characteristic: int
    exact_face_count: int
    excess_count: int
    excluded_triangle_count: int
    face_count: int
    facet_sagitta: float
    far_count: int
    farthest_index: int
    first_energy: float
    fit_seconds: float
    flipped_count: int
    flipped_triangle_count: int
    fold_count: int
    folded_node_count: int
    folded_triangles: int
    force_arrived: tuple[float, ...]
    force_error: float
    force_given: tuple[float, ...]
    free_count: int
    free_edge_count: int
    gap: float
    genus: int
    given_gap: float
    given_normal_jump: float
    grid_u: int
    grid_v: int
    high_area_ratio: float
    is_chart: int
    joined_count: int
    kind: str
    largest_count: int
    least_count: int
    left_out_count: int
    limit: float
    loop_count: int
    low_area_ratio: float
    map_energy: float
    map_seconds: float
    max_back_distance: float
    max_deviation: float
    max_distance: float
    max_distance_between: float
    max_error: float
    max_fixed_error: float
    max_gap: float
    max_interior_error: float
    max_movement: float
    max_normal_jump: float
    max_shape_error: float
    max_side_angle: float
    max_side_error: float
    max_stretch: float
    max_tolerance_share: float
    max_vertex_distance: float
    mean_deviation: float
    mean_distance: float
    mean_error: float
    median_distance: float
    merged_point_count: int
    mesh_crossing_count: int
    mesh_volume: float
    mirror_distance: float
    missing_end: int
    moment_arrived: tuple[float, ...]
    moment_bound: float
    moment_error: float
    moment_given: tuple[float, ...]
    noise: float
    normal_jump: float
    overshoot: float
    parameterize_seconds: float
    parted_edge_count: int
    pass_count: int
    patch_count: int
    piece_count: int
    pole_count: int
    prolonged_edge_count: int
    refined_coefficient_count: int
    remarks: frozenset[str]
    removed_knot_count: int
    rms_deviation: float
    rms_distance: float
    rms_distance_between: float
    rms_error: float
    rms_shape_error: float
    rms_vertex_distance: float
    rough_cell_count: int
    rounded_count: int
    seconds: float
    sharp_edge_count: int
    smallest_angle: float
    smoothing: float
    solve_count: int
    split_count: int
    split_node_count: int
    spread_node_count: int
    step_count: int
    stop_reason: str
    stretch: float
    strip_count: int
    tensor_count: int
    tolerance: float
    turned_count: int
    twisted_row: int
    uncertainty: float
    unproven_count: int
    unused_node_count: int
    v_error: float
    vertex_count: int
    void_count: int
    volume: float
    welded_node_count: int
    work_arrived: float
    work_error: float
    work_given: float
    worst_back_u: float
    worst_back_v: float
    worst_curve: int
    worst_index: int
    worst_node: int
    worst_parameter: float
    worst_patch: int


def declare(library) -> None:
    """Tells a loaded library the types of its functions' arguments and results."""
    for name, (result, *arguments) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
