use super::*;

/// A tube of uneven triangles round the z axis, open at both ends, or closed by a node at the upper one.
fn tube(is_capped: bool) -> Mesh {
    let (around, along) = (40_u32, 30_u32);
    let mut points = Vec::new();
    for j in 0..=along {
        for k in 0..around {
            let (z, angle) =
                (f64::from(j) / 10.0, (f64::from(k) + 0.3 * f64::from(j)) / 40.0 * std::f64::consts::TAU);
            let radius = 1.0 + 0.2 * (2.0 * z).sin();
            points.push(DVec3::new(radius * angle.cos(), radius * angle.sin(), z));
        }
    }
    let node = |j: u32, k: u32| j * around + k % around;
    let mut triangles = Vec::new();
    for (j, k) in (0..along).flat_map(|j| (0..around).map(move |k| (j, k))) {
        triangles.push([node(j, k), node(j, k + 1), node(j + 1, k + 1)]);
        triangles.push([node(j, k), node(j + 1, k + 1), node(j + 1, k)]);
    }
    if is_capped {
        points.push(DVec3::new(0.0, 0.0, 3.3));
        triangles.extend((0..around).map(|k| [node(along, k), node(along, k + 1), points.len() as u32 - 1]));
    }
    Mesh::new(points, triangles).unwrap()
}

fn sample(mesh: &Mesh, begin: Source, end: Source, row_count: usize) -> Result<SampledRows, SampleRowsError> {
    let options = SampleRowsOptions { begin, end, row_count, spacing: 0.0 };
    sample_rows(mesh, &options, &mut Control::new(1))
}

fn rows(sampled: &SampledRows) -> Vec<&[DVec3]> {
    let mut rest = &sampled.points[..];
    sampled.counts.iter().map(|&count| rest.split_off(..count).unwrap()).collect()
}

#[test]
fn rows_of_a_tube_go_round_it_in_order() {
    for is_capped in [false, true] {
        let mesh = tube(is_capped);
        // the loop whose nodes come first is the lower one
        let lower = mesh.loops().iter().position(|nodes| nodes.contains(&0)).unwrap();
        let end =
            if is_capped { Source::Node(mesh.points().len() as u32 - 1) } else { Source::Loop(1 - lower) };
        let sampled = sample(&mesh, Source::Loop(lower), end, 12).unwrap();
        let rows = rows(&sampled);
        assert_eq!(rows.len(), 12);
        let mut height = 0.0;
        let mut before: Option<DVec3> = None;
        for row in rows {
            let mean = row.iter().sum::<DVec3>() / row.len() as f64;
            assert!(mean.z > height, "rows rise");
            height = mean.z;
            // round the axis once, the same way: the area seen from above has one sign
            let area: f64 = row.iter().zip(row.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b).z).sum();
            assert!(area.abs() > 1e-3);
            assert!(before.is_none_or(|before| before.x * row[0].x + before.y * row[0].y > 0.0), "one seam");
            before = Some(row[0]);
            let steps: Vec<f64> = row.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
            let longest = steps.iter().copied().fold(0.0, f64::max);
            assert!(longest <= 1.01 * (steps.iter().sum::<f64>() / steps.len() as f64) + 0.02, "even");
        }
    }
}

#[test]
fn what_gives_no_rows_is_refused_by_name() {
    let mesh = tube(false);
    let first = Source::Loop(0);
    let refuse = |begin, end, rows| sample(&mesh, begin, end, rows).unwrap_err();
    assert!(matches!(refuse(first, Source::Loop(2), 3), SampleRowsError::NoSuch { index: 2, count: 2, .. }));
    assert!(matches!(refuse(first, Source::Node(9999), 3), SampleRowsError::NoSuch { index: 9999, .. }));
    let shared = mesh.loops()[0][5];
    assert_eq!(refuse(first, Source::Node(shared), 3), SampleRowsError::SameSource { node: shared });
    assert!(matches!(refuse(first, Source::Loop(1), 0), SampleRowsError::Option { option: "row_count", .. }));
    // between two nodes of an open tube levels end at its loops
    let error = refuse(Source::Node(410), Source::Node(430), 4);
    assert!(matches!(error, SampleRowsError::Curves { row: 0.., .. }), "{error}");
    assert_eq!(error.kind(), crate::failure::ErrorKind::Topology);
}
