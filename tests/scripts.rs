//! What scripts/test says of a run that does not come to its end.
#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Runs the script with `section` in place of all it does, and stops it with a signal after a while.
fn run(name: &str, section: &str, signal: Option<&str>) -> Output {
    let script = include_str!("../scripts/test");
    let (head, _) = script.split_once("section \"setup\"").expect("the first section");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).join("scripts");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("paths"), include_str!("../scripts/paths")).unwrap();
    let path = folder.join("test");
    std::fs::write(&path, format!("{head}\nsection \"work\"\n{section}\nhas_finished=yes\n")).unwrap();
    // nohup, and a shell in the background, have signals ignored, which nobody below them can take back
    let mut bash = Command::new("env");
    let child = bash
        .args(["--default-signal", "bash"])
        .arg(&path)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    if let Some(signal) = signal {
        sleep(Duration::from_millis(500));
        let killed = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(killed.unwrap().success());
    }
    child.wait_with_output().unwrap()
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_run_that_is_stopped_has_not_passed() {
    for signal in ["TERM", "HUP"] {
        let stopped = run(signal, "sleep 2", Some(signal));
        let said = text(&stopped);
        assert!(!stopped.status.success() && !said.contains("all tests passed"), "{signal}: {said}");
        assert!(said.contains(&format!("tests FAILED in: work, stopped by {signal}")), "{signal}: {said}");
    }
}

#[test]
fn a_run_says_what_failed_and_what_was_skipped() {
    let failed = run("failed", "false", None);
    assert!(!failed.status.success() && text(&failed).contains("tests FAILED in: work"), "{failed:?}");
    // one test without two files is one test
    let skips = ["one without a.ply", "one without b.ply", "two without a.ply"]
        .map(|skip| format!("echo 'SKIPPED: {skip} of ../shared/data' >>\"$PLANISH_SKIPPED\""));
    let passed = run("passed", &skips.join("\n"), None);
    assert!(passed.status.success() && text(&passed).contains("all tests passed"), "{passed:?}");
    assert!(text(&passed).contains("planish: 2 tests skipped"), "{passed:?}");
}
