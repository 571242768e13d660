//! Bicubic surfaces on uniform grids from tessellations.

mod grid;
mod normal_equations;
