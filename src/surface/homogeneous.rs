//! Derivatives of rational surfaces from those of their homogeneous form.

/// From derivatives of (w S, w) to those of S: Leibniz' rule solved for the highest derivative of S.
pub(super) fn divide(homogeneous: &[f64], dim: usize, max_derivative: usize, out: &mut [f64]) {
    let width = dim + 1;
    let h = |row: usize, k: usize| homogeneous[row * width + k];
    let weight = |row: usize| h(row, dim);
    let inverse = 1.0 / weight(0);
    for k in 0..dim {
        let s = h(0, k) * inverse;
        out[k] = s;
        if max_derivative >= 1 {
            let su = (h(1, k) - weight(1) * s) * inverse;
            let sv = (h(2, k) - weight(2) * s) * inverse;
            (out[dim + k], out[2 * dim + k]) = (su, sv);
            if max_derivative >= 2 {
                out[3 * dim + k] = (h(3, k) - 2.0 * weight(1) * su - weight(3) * s) * inverse;
                out[4 * dim + k] = (h(4, k) - weight(1) * sv - weight(2) * su - weight(4) * s) * inverse;
                out[5 * dim + k] = (h(5, k) - 2.0 * weight(2) * sv - weight(5) * s) * inverse;
            }
        }
    }
}
