//! Why a call failed, as the thread remembers it.

use super::planish_status;
use crate::Error;
use crate::failure::Classify;

/// Why a call failed: its status, its sentence, and the index of the offender.
#[derive(Debug)]
pub(super) struct Failure {
    pub status: planish_status,
    pub sentence: String,
    pub index: Option<usize>,
}

impl<E> From<E> for Failure
where
    Error: From<E>,
{
    fn from(error: E) -> Self {
        let error = Error::from(error);
        Self { status: error.kind().into(), sentence: error.to_string(), index: error.index() }
    }
}
