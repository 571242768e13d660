//! Records that are shorter, longer or wrong.

use super::*;
use serde_json::Value;

/// A caller's record with room for more fields.
#[repr(C)]
#[derive(Clone, Copy)]
struct Longer<T> {
    record: T,
    rest: [u8; 16],
}

fn eval_with(options: *const planish_eval_options) -> (planish_status, [f64; 3]) {
    let surface = SurfaceHandle::saddle();
    let mut out: [f64; 3] = canary();
    let uv = [0.5, 0.5];
    // SAFETY: one point.
    let status = unsafe { planish_surface_eval(surface.0, uv.as_ptr(), 1, options, (&raw mut out).cast()) };
    (status, out)
}

#[test]
fn init_fills_as_far_as_the_size_goes() {
    let known = size_of::<planish_eval_options>();
    for size in [8, 16, known - 8, known, known + 8, known + 16] {
        let mut longer: Longer<planish_eval_options> = canary();
        // SAFETY: `size` bytes.
        ok(unsafe { planish_eval_options_init((&raw mut longer).cast(), size) });
        // SAFETY: plain bytes.
        let bytes: [u8; 56] = unsafe { std::mem::transmute(longer) };
        assert_eq!(bytes[..8], size.to_ne_bytes());
        let zeros = [0; 56];
        assert_eq!(bytes[8..size], zeros[8..size], "all defaults of this record are 0");
        assert!(bytes[size..].iter().all(|&byte| byte == CANARY), "beyond {size}");
    }
}

#[test]
fn init_refuses_sizes_that_are_none() {
    let mut record: planish_eval_options = canary();
    for size in [0, 1, 7, 12, 4096, usize::MAX] {
        // SAFETY: refused before a byte is written.
        let status = unsafe { planish_eval_options_init(&mut record, size) };
        let words: [&str; 2] = ["planish_eval_options", &size.to_string()];
        refused(status, planish_status::InvalidArgument, -1, &words);
        assert_untouched(&record);
    }
}

#[test]
fn every_init_refuses_null() {
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_mesh_options_init(null_mut(), 56), "options");
        null_refused(planish_parameterize_options_init(null_mut(), 96), "options");
        null_refused(planish_decimate_options_init(null_mut(), 88), "options");
        null_refused(planish_model_options_init(null_mut(), 152), "options");
        null_refused(planish_sphere_options_init(null_mut(), 32), "options");
        null_refused(planish_eval_options_init(null_mut(), 40), "options");
        null_refused(planish_tensor_options_init(null_mut(), 136), "options");
        null_refused(planish_skin_options_init(null_mut(), 144), "options");
        null_refused(planish_pht_options_init(null_mut(), 128), "options");
        null_refused(planish_pht_convert_options_init(null_mut(), 32), "options");
        null_refused(planish_field_options_init(null_mut(), 112), "options");
        null_refused(planish_transfer_options_init(null_mut(), 32), "options");
    }
}

/// The bits that a default of `planish.api.json` stands for in a field of some type.
fn bits(api: &Value, default: &str, of: &str) -> u64 {
    let named = |name: &str| {
        let enumerators = api["enumerations"].as_array().into_iter().flatten();
        let enumerators = enumerators.flat_map(|enumeration| enumeration["enumerators"].as_array()).flatten();
        let all = enumerators.chain(api["constants"].as_array().into_iter().flatten());
        all.into_iter().find(|each| each["name"] == name).and_then(|each| each["value"].as_u64())
    };
    let number = |text: &str| match text {
        "infinity" => f64::INFINITY,
        "pi" => std::f64::consts::PI,
        _ => text.parse().unwrap_or_else(|_| panic!("{text} is no number")),
    };
    match default {
        "NULL" => 0,
        _ if default.starts_with("PLANISH_") => {
            named(default).unwrap_or_else(|| panic!("{default} is unknown"))
        }
        _ if of == "double" => default.split(" / ").map(number).reduce(|a, b| a / b).unwrap().to_bits(),
        _ => default.parse().unwrap_or_else(|_| panic!("{default} is no default of {of}")),
    }
}

/// Compares a record's defaults with those that `planish.api.json`, and so the header, tells. Every record with an
/// `_init` is tested so by its declaration.
pub(crate) fn defaults_are_told<T: Record>() {
    let api: Value = serde_json::from_str(include_str!("../../../bindings/planish.api.json")).unwrap();
    let defaults = T::default();
    // SAFETY: a record has no padding.
    let bytes = unsafe { std::slice::from_raw_parts((&raw const defaults).cast::<u8>(), size_of::<T>()) };
    let records = api["records"].as_array().unwrap();
    let record = records.iter().find(|record| record["name"] == T::NAME).unwrap();
    assert_eq!(record["size"], bytes.len());
    let fields = record["fields"].as_array().unwrap();
    let ends =
        fields[1..].iter().map(|field| field["offset"].as_u64().unwrap() as usize).chain([bytes.len()]);
    for (field, end) in fields.iter().zip(ends).skip(1) {
        let offset = field["offset"].as_u64().unwrap() as usize;
        let told = bits(&api, field["default"].as_str().unwrap_or("0"), field["type"].as_str().unwrap());
        let mut found = [0; 8];
        // an array of numbers has zeros only
        let width = (end - offset).min(8);
        found[..width].copy_from_slice(&bytes[offset..offset + width]);
        assert_eq!(u64::from_le_bytes(found), told, "{}", field["name"]);
    }
}

#[test]
fn shorter_options_have_defaults_for_the_rest() {
    // uv_stride is known, out_stride lies beyond the record and would be refused if it were read
    let older = planish_eval_options { struct_size: 16, uv_stride: 2, out_stride: 1, ..record() };
    assert_eq!(eval_with(&older), (planish_status::Ok, [0.5, 0.5, 0.25]));
    let whole = planish_eval_options { struct_size: 40, ..older };
    let (status, out) = eval_with(&whole);
    refused(status, planish_status::InvalidArgument, -1, &["out_stride is 1", "at least 3"]);
    assert_untouched(&out);
}

#[test]
fn longer_options_must_end_with_zeros() {
    let mut newer = Longer { record: record::<planish_eval_options>(), rest: [0; 16] };
    newer.record.struct_size = size_of_val(&newer);
    assert_eq!(eval_with((&raw const newer).cast()).0, planish_status::Ok);
    newer.rest[15] = 1;
    let (status, out) = eval_with((&raw const newer).cast());
    refused(status, planish_status::Version, -1, &["planish_eval_options", "56 bytes", "knows 40"]);
    assert_untouched(&out);
}

#[test]
fn options_without_a_size_are_refused() {
    for size in [0, 4, 41, 4096, usize::MAX / 2] {
        let (status, out) = eval_with(&planish_eval_options { struct_size: size, ..record() });
        refused(status, planish_status::InvalidArgument, -1, &["struct_size", &size.to_string()]);
        assert_untouched(&out);
    }
}

#[test]
fn reserved_fields_must_be_zero() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let newer = planish_pht_options { reserved_end: 3, ..record() };
    let mut out = canary();
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_pht_fit(mesh.0, &newer, &mut out, null_mut()) };
    refused(status, planish_status::Version, -1, &["reserved", "3"]);
    assert_untouched(&out);
}

#[test]
fn reports_are_filled_as_far_as_the_size_goes() {
    let sheet = Sheet::new(9);
    let mesh = sheet.mesh_with_parameters();
    let fit = |report: *mut planish_fit_report| {
        let mut out = null_mut();
        // SAFETY: handles and records of this test.
        let status = unsafe { planish_tensor_fit(mesh.0, null(), &mut out, report) };
        let surface = SurfaceHandle(out);
        assert_eq!(surface.0.is_null(), (status as i32) < 0);
        status
    };
    let known = size_of::<planish_fit_report>();
    let mut whole: planish_fit_report = record();
    assert!(fit(&mut whole) as i32 >= 0);
    for size in [8, 24, known, known + 16] {
        let mut longer: Longer<planish_fit_report> = canary();
        longer.record.struct_size = size;
        assert!(fit((&raw mut longer).cast()) as i32 >= 0);
        assert_eq!(longer.record.struct_size, size);
        // SAFETY: plain bytes.
        let bytes: [u8; 264] = unsafe { std::mem::transmute(longer) };
        assert!(bytes[size..].iter().all(|&byte| byte == CANARY), "beyond {size}");
        if size > known {
            assert_eq!(bytes[known..size], [0; 16]);
        }
        if size >= 24 {
            assert_eq!(longer.record.max_error, whole.max_error);
            assert_eq!(longer.record.rms_error, whole.rms_error);
        }
    }
    let mut unset: planish_fit_report = canary();
    unset.struct_size = 0;
    refused(fit(&mut unset), planish_status::InvalidArgument, -1, &["planish_fit_report", "is 0"]);
    assert_eq!(unset.struct_size, 0);
    unset.struct_size = canary();
    assert_untouched(&unset);
}
