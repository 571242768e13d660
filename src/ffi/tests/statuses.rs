use super::super::guard::guard;
use super::*;
use std::ffi::CStr;
use std::process::Command;

const ALL: [planish_status; 24] = [
    planish_status::Ok,
    planish_status::ToleranceNotMet,
    planish_status::Stagnated,
    planish_status::PointsOutside,
    planish_status::InputRepaired,
    planish_status::FoldedParameters,
    planish_status::NotProven,
    planish_status::NullPointer,
    planish_status::InvalidArgument,
    planish_status::NotFinite,
    planish_status::Index,
    planish_status::Topology,
    planish_status::Degenerate,
    planish_status::Outside,
    planish_status::Singular,
    planish_status::WrongKind,
    planish_status::BufferTooSmall,
    planish_status::TooLarge,
    planish_status::File,
    planish_status::Format,
    planish_status::Version,
    planish_status::Cancelled,
    planish_status::OutOfMemory,
    planish_status::Internal,
];

fn name(status: i32) -> &'static str {
    // SAFETY: a static text.
    unsafe { CStr::from_ptr(planish_status_name(status)) }.to_str().unwrap()
}

#[test]
fn every_status_has_its_number_and_name() {
    for (k, status) in (0..).zip(ALL) {
        assert_eq!(status as i32, if k < 7 { k } else { 6 - k });
        let variant = format!("{status:?}");
        let words = variant.chars().flat_map(|c| {
            let gap = if c.is_uppercase() { Some('_') } else { None };
            gap.into_iter().chain([c.to_ascii_uppercase()])
        });
        assert_eq!(name(status as i32), format!("PLANISH_STATUS{}", words.collect::<String>()));
    }
    assert_eq!(name(7), "unknown status");
    assert_eq!(name(-18), "unknown status");
    assert_eq!(name(i32::MIN), "unknown status");
}

#[test]
fn version_is_that_of_the_package() {
    // SAFETY: a static text.
    let version = unsafe { CStr::from_ptr(planish_version()) };
    assert_eq!(version.to_str(), Ok(env!("CARGO_PKG_VERSION")));
}

#[test]
fn messages_are_cut_and_terminated() {
    // SAFETY: NULL is refused.
    null_refused(unsafe { planish_mesh_copy_points(null(), null_mut(), 0) }, "mesh");
    let whole = "mesh is NULL";
    for size in 1..20 {
        let mut text = [CANARY; 20];
        // SAFETY: at most 20 bytes.
        let len = unsafe { planish_error_message(text.as_mut_ptr().cast(), size) };
        let kept = whole.len().min(size - 1);
        assert_eq!(len, whole.len());
        assert_eq!(&text[..kept], &whole.as_bytes()[..kept]);
        assert_eq!(text[kept], 0);
        assert!(text[kept + 1..].iter().all(|&byte| byte == CANARY));
    }
    // SAFETY: NULL only asks.
    assert_eq!(unsafe { planish_error_message(null_mut(), 5) }, whole.len());
}

#[test]
fn messages_keep_whole_letters() {
    let path = c("/nowhere/\u{e9}\u{e9}.off");
    let mut out = canary();
    // SAFETY: a terminated text.
    refused(
        unsafe { planish_mesh_read(path.as_ptr(), null(), &mut out) },
        planish_status::File,
        -1,
        &["\u{e9}"],
    );
    assert_untouched(&out);
    let whole = message();
    for size in 1..=whole.len() + 1 {
        let mut text = vec![CANARY; size];
        // SAFETY: `size` bytes.
        unsafe { planish_error_message(text.as_mut_ptr().cast(), size) };
        let text = CStr::from_bytes_until_nul(&text).unwrap().to_str().expect("cut between letters");
        assert!(whole.starts_with(text) && text.len() + 2 >= size.min(whole.len()));
    }
}

#[test]
fn messages_and_indices_are_those_of_the_thread() {
    // SAFETY: NULL is refused.
    null_refused(unsafe { planish_mesh_copy_points(null(), null_mut(), 0) }, "mesh");
    let others = (0..4_u32).map(|k| {
        std::thread::spawn(move || {
            assert_eq!(message(), "");
            assert_eq!(planish_error_index(), -1);
            let sheet = Sheet::new(3);
            let mesh = sheet.mesh();
            for _ in 0..100 {
                let mut node = 0;
                let mut count = 0;
                // SAFETY: one element.
                let status =
                    unsafe { planish_mesh_shortest_path(mesh.0, 0, 9 + k, &mut node, 1, &mut count) };
                refused(status, planish_status::Index, 9 + i64::from(k), &[&format!("node {}", 9 + k)]);
            }
        })
    });
    others.collect::<Vec<_>>().into_iter().for_each(|thread| thread.join().unwrap());
    assert_eq!(message(), "mesh is NULL");
}

#[test]
fn successes_leave_the_message() {
    // SAFETY: NULL is refused.
    null_refused(unsafe { planish_mesh_copy_points(null(), null_mut(), 0) }, "mesh");
    Sheet::new(3).mesh();
    assert_eq!(message(), "mesh is NULL");
}

#[test]
fn panics_become_internal_errors() {
    let status = guard(|| -> Result<(), _> { panic!("deliberate {}", 7) });
    refused(status, planish_status::Internal, -1, &["internal error", "deliberate 7"]);
    let status = guard(|| -> Result<(), _> { std::panic::panic_any(7) });
    refused(status, planish_status::Internal, -1, &["internal error", "without a message"]);
}

#[test]
fn payloads_that_panic_when_dropped_stay_inside() {
    struct Bomb;
    impl Drop for Bomb {
        fn drop(&mut self) {
            panic!("dropped");
        }
    }
    let status = guard(|| -> Result<(), _> { std::panic::panic_any(Bomb) });
    refused(status, planish_status::Internal, -1, &["without a message"]);
}

/// Panics in all places; run by the test below in a process of its own.
#[test]
#[ignore = "panics on purpose and writes to stderr: panics_inside_are_silent_and_others_are_not runs it and reads that"]
fn panics_everywhere() {
    assert_eq!(guard(|| -> Result<(), _> { panic!("in the guard") }), planish_status::Internal);
    let nested = guard(|| {
        assert_eq!(guard(|| -> Result<(), _> { panic!("in the inner guard") }), planish_status::Internal);
        if planish_error_index() == -1 {
            panic!("after the inner guard")
        }
        Ok(())
    });
    assert_eq!(nested, planish_status::Internal);
    let pool = crate::control::Pool::new(2);
    let worker = guard(|| -> Result<(), _> { pool.run(|| panic!("on a worker")) });
    assert_eq!(worker, planish_status::Internal);
    assert!(message().contains("on a worker"));
    assert!(std::panic::catch_unwind(|| panic!("outside of all")).is_err());
}

#[test]
fn panics_inside_are_silent_and_others_are_not() {
    let program = std::env::current_exe().unwrap();
    let arguments = ["--exact", "ffi::tests::statuses::panics_everywhere", "--ignored", "--nocapture"];
    let output = Command::new(program).args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("1 passed"));
    assert!(text.contains("outside of all"), "{text}");
    for silent in ["in the guard", "in the inner guard", "after the inner guard", "on a worker"] {
        assert!(!text.contains(silent), "{text}");
    }
}
