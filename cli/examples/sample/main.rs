//! Prints the points of `samples/knot_3d.xyz`:
//! `cargo run --package netmesh-cli --example sample > samples/knot_3d.xyz`

mod knot;

fn main() {
    print!("{}", knot::text());
}
