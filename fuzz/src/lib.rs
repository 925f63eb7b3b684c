//! Properties that hold for any input, as functions of bytes: each panics if one does not hold. The
//! fuzz targets call them with the inputs of libFuzzer; the library's own tests
//! (`tests/properties`) include this file and call them with the corpus and with the inputs of
//! proptest.

pub mod bytes;
pub mod c_api;
pub mod facets;
pub mod families;
pub mod features;
pub mod mesh;
pub mod near_incidence;
pub mod oracle;
pub mod outlines;
pub mod poly;
pub mod readers;
pub mod segments;
pub mod settings;
pub mod signs;
pub mod slivers;
pub mod triangulations;
