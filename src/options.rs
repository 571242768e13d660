//! What records of options have in common: for every field a method that changes it alone.

/// Methods of an options record, one for each field: `with_x field: type`.
macro_rules! with_fields {
    ($($with:ident $field:ident: $type:ty),+ $(,)?) => {$(
        #[doc = concat!("The same with another [`", stringify!($field), "`](Self::", stringify!($field), ").")]
        #[must_use]
        pub const fn $with(self, $field: $type) -> Self {
            Self { $field, ..self }
        }
    )+};
}

pub(crate) use with_fields;
