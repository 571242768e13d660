//! What STEP files hold and say: what all commands that write one have in common.

use crate::{Failure, Given};
use clap::{Args, ValueEnum};
use planish::export::step::{StepOptions, Unit};
use planish::fit::conversion::ConversionOptions;
use planish::model::{Form, FormOptions};
use planish::query::tessellate::TessellateOptions;
use planish::surface::Label;

#[derive(Debug, Args)]
pub(crate) struct StepArguments {
    /// What one model unit is, for STEP files; millimetres if neither this nor a saved surface says so.
    #[arg(long, value_enum)]
    unit: Option<UnitName>,
    /// What STEP files hold of a PHT-spline or T-spline.
    #[arg(long, value_enum, default_value_t = FormName::Tensor)]
    step_form: FormName,
    /// Most levels that cells in one face of --step-form patches differ by: more gives fewer faces.
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub level_spread: u32,
    /// Name of the product in STEP files; that of the surface, or of the file that is read, if it is left out.
    #[arg(long, value_name = "NAME")]
    product: Option<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum UnitName {
    Mm,
    M,
    Inch,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum FormName {
    /// One face over the lines of all cells.
    Tensor,
    /// A shell of faces that share edges, each over cells of nearly equal size: far fewer control points.
    Patches,
}

/// How shapes are written: what STEP files hold of a surface and say beside the shape, and how fine triangles are.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Step<'a> {
    pub conversion: ConversionOptions,
    pub text: StepOptions<'a>,
    pub triangles: TessellateOptions,
}

impl StepArguments {
    /// Their names.
    const OPTIONS: [&str; 4] = ["unit", "product", "step-form", "level-spread"];

    /// Refuses them where no STEP file is written.
    pub(crate) fn check_used(given: &Given, writes_step: bool) -> Result<(), Failure> {
        let why = "is not used: no STEP file is written";
        Self::OPTIONS.iter().try_for_each(|option| given.refuse(option, writes_step, why))
    }

    pub(crate) fn is_patches(&self) -> bool {
        self.step_form == FormName::Patches
    }

    /// What was asked for; what was not comes from the label, then from the name of the file that was read.
    pub(crate) fn step<'a>(&'a self, label: &'a Label, stem: &'a str) -> Step<'a> {
        let named = if label.name.is_empty() { stem } else { &label.name };
        let text = StepOptions {
            unit: match self.unit {
                Some(UnitName::Mm) => Unit::Millimetre,
                Some(UnitName::M) => Unit::Metre,
                Some(UnitName::Inch) => Unit::Inch,
                None => label.unit,
            },
            product: self.product.as_deref().unwrap_or(named),
            ..StepOptions::default()
        };
        let form = FormOptions {
            form: if self.is_patches() { Form::Patches } else { Form::Tensor },
            level_spread: self.level_spread,
            ..FormOptions::default()
        };
        let conversion = ConversionOptions { form, ..ConversionOptions::default() };
        Step { text, conversion, triangles: TessellateOptions::default() }
    }
}
