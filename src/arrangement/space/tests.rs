//! Arrangements in space.

use super::*;
