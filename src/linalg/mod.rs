//! Banded and sparse systems: sprs holds and multiplies, faer factors.
