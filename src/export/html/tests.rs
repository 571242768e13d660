use super::*;
use crate::samples;

fn page<'a>(mesh: &'a Mesh, distances: &'a [f64], title: &'a str) -> Page<'a> {
    Page {
        title,
        unit: "mm",
        mesh,
        distances,
        places: &|node| format!("place {node}"),
        tolerance: 0.5,
        facts: &[],
        remarks: &[],
        surface: Some(mesh),
        net: None,
    }
}

#[test]
fn what_users_write_is_shown_and_not_run() {
    let mesh = samples::curved_notch(1).unwrap();
    let distances = vec![0.0; mesh.points().len()];
    let text = text(&page(&mesh, &distances, "</script><b>'\"&@DATA@")).unwrap();
    assert!(text.contains("&lt;/script&gt;&lt;b&gt;&#39;&quot;&amp;@DATA@"));
    assert_eq!(text.matches("</script>").count(), 2, "the data and the program");
    assert_eq!(json_text("</script>\"\\\n"), "\"\\u003c/script>\\u0022\\u005c\\u000a\"");
}

#[test]
fn nothing_comes_from_outside_and_the_size_is_small() {
    let mesh = samples::curved_notch(1).unwrap();
    let nodes = mesh.points().len();
    let text = text(&page(&mesh, &vec![0.1; nodes], "part")).unwrap();
    assert!(!text.contains("http://") && !text.contains("https://") && !text.contains("src="));
    // 6 + 4 bytes a node, 6 a triangle (12 beyond 65,535 nodes), twice for the surface, 4/3 for base 64
    let triangles = mesh.triangles().len();
    let most = PAGE.len() + 12_000 + (nodes * 16 + triangles * 24) * 4 / 3;
    assert!(text.len() <= most, "{} bytes for {nodes} nodes, at most {most}", text.len());
}

#[test]
fn shares_come_back_within_a_step() {
    let mesh = samples::curved_notch(1).unwrap();
    let frame = Frame::of(&mesh);
    let bytes = STANDARD.decode(frame.shares(mesh.points())).unwrap();
    let step = frame.half / LARGEST;
    for (point, share) in mesh.points().iter().zip(bytes.chunks_exact(6)) {
        let back = DVec3::from_array(
            [0, 1, 2].map(|i| f64::from(i16::from_le_bytes([share[2 * i], share[2 * i + 1]]))),
        );
        let difference = (frame.centre + back * step - *point).abs().max_element();
        assert!(difference <= 0.5 * step * (1.0 + 1e-9), "{difference} of {step}");
    }
}

#[test]
fn statistics_of_known_numbers() {
    let distances: Vec<f64> =
        (1..=100).map(|k| if k % 2 == 0 { f64::from(k) } else { -f64::from(k) }).collect();
    let found = Statistics::of(&distances, 90.0);
    assert_eq!((found.largest_outside, found.largest_inside), (100.0, -99.0));
    assert_eq!(found.percentiles, [50.0, 95.0, 99.0]);
    assert_eq!((found.share_within, found.mean), (0.90, 0.5));
    // the sum of the squares of 1 to n is n (n + 1) (2 n + 1) / 6
    assert!((found.rms - (101.0 * 201.0 / 6.0_f64).sqrt()).abs() <= 4.0 * f64::EPSILON * 100.0);
    let none = Statistics::of(&[], 1.0);
    assert_eq!((none.rms, none.percentiles, none.share_within), (0.0, [0.0; 3], 0.0));
}

#[test]
fn a_number_for_each_node_is_needed() {
    let mesh = samples::curved_notch(1).unwrap();
    let error = text(&page(&mesh, &[0.0], "part")).unwrap_err();
    assert!(matches!(error, ExportError::Count { count: 1, .. }));
}
