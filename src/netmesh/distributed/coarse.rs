//! The coarse mesh, which all processes make alike, and how it is cut.

use super::assembly::{Assembly, First};
use super::bisection::Bisection;
use super::hierarchy::Domains;
use super::maker::Maker;
use super::piece::Piece;
use crate::complex::VertexId;
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{collected, copied, filled};
use crate::mesh::Inputs;
use crate::netmesh::rounds::order::by_locality;
use crate::netmesh::{Mesher, Watch};
use crate::options::{Options, ProgressFn};
use crate::parameters::Parameters;

/// The NETMESH mesh of a sample, with the loose bound that holds while inputs go in.
pub struct Coarse<const D: usize> {
    piece: Piece<D>,
    delaunay: Delaunay<D>,
    /// How many points the sample has, which come first among the vertices.
    sample: usize,
    maker: Maker<D>,
}

impl<const D: usize> Coarse<D> {
    /// The coarse mesh of `sample`, which must be distinct, have the extreme points of all inputs
    /// along every axis, the input nearest to the middle of their box, and that farthest from the
    /// latter. `names`: their numbers among all inputs.
    ///
    /// # Errors
    /// As those of [`crate::Mesh::run`].
    pub fn new(
        sample: &[[f64; D]],
        names: &[u64],
        options: &Options,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Self> {
        let parameters =
            Parameters { inputs_per_partition: usize::MAX / 2, ..Parameters::resolve(D, options)? };
        let inputs = Inputs::new(D, sample.len(), sample.as_flattened(), 0)?;
        let own = Parameters { is_sample: true, ..parameters.clone() };
        let mut mesher = Mesher::<D>::new(&inputs, own, Watch::new(progress))?;
        let mut cavity = Cavity::default();
        mesher.start_netmesh(&mut cavity)?;
        mesher.insert_rounds(&mut cavity)?;
        let names = collected(mesher.order.iter().map(|input| names[input.index()]))?;
        let template = copied(&mesher.state.template)?;
        let Mesher { state, mut watch, .. } = mesher;
        let made = Assembly {
            names,
            domains: Domains::default(),
            outer: Vec::new(),
            encroaching: Vec::new(),
            watched: Vec::new(),
            state,
        };
        let piece = made.into_piece(0)?;
        let maker = Maker { parameters, template };
        // Assembled again, so that ids are those of the piece.
        let pieces = [piece];
        let again = maker.assemble(&pieces, First::Waiting, 0, &mut watch)?;
        let [piece] = pieces;
        let delaunay = again.state.delaunay;
        Ok(Self { piece, delaunay, sample: sample.len(), maker })
    }

    pub fn maker(&self) -> &Maker<D> {
        &self.maker
    }

    /// For each point the simplex that it is in, `u32::MAX` if it is of the sample. That does not
    /// depend on the other points. They are visited in an order of locality, so that walks are
    /// short.
    ///
    /// # Errors
    /// `NonFinite`; `OutOfMemory`; `Cancelled`.
    pub fn locate(
        &self,
        points: &[[f64; D]],
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Vec<u32>> {
        let mut watch = Watch::new(progress);
        let bits = |point: &[f64; D]| point.map(|x| (x + 0.0).to_bits());
        let sample = &self.piece.corners[..self.sample];
        let mut sampled = collected(sample.iter().map(|corner| bits(&corner.point)))?;
        sampled.sort_unstable();
        let mut found = filled(points.len(), u32::MAX)?;
        let mut near = self.delaunay.complex().incident(VertexId::new(0));
        for at in order_of(points, &mut watch)? {
            watch.poll_after(4)?;
            if sampled.binary_search(&bits(&points[at])).is_err() {
                let simplex = self.delaunay.first_simplex_at(near, &points[at])?;
                near = simplex.expect("the outer cage surrounds the inputs");
                found[at] = near.number();
            }
        }
        Ok(found)
    }

    /// Simplex -> its partition.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn partitions(&self, cut: &Bisection<D>) -> Result<Vec<u32>> {
        self.piece.parts(cut)
    }

    /// Partition `partition` as a piece, without inputs that wait ([`Piece::add_inputs`]), and the
    /// ids that its simplices had: `ids[i]` is that of simplex i.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn cut(&self, partition_of: &[u32], partition: u32) -> Result<(Piece<D>, Vec<u32>)> {
        let is_own = collected(partition_of.iter().map(|&of| of == partition))?;
        let mut piece = self.piece.select(&is_own, || Ok(()))?;
        piece.set_outer()?;
        let own = (0..).zip(&is_own).filter(|(_, is_own)| **is_own);
        Ok((piece, collected(own.map(|(simplex, _)| simplex))?))
    }
}

/// The places of `points` in an order of locality.
fn order_of<const D: usize>(points: &[[f64; D]], watch: &mut Watch<'_, '_>) -> Result<Vec<usize>> {
    let is_one = points.windows(2).all(|pair| pair[0] == pair[1]);
    if is_one {
        return Ok(collected(0..points.len())?);
    }
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0)?;
    let order = by_locality::<D>(&inputs, 1, watch)?;
    let mut places = filled(inputs.distinct(), 0u32)?;
    for (place, vertex) in (0..).zip(&order) {
        places[vertex.index()] = place;
    }
    let mut all = collected(0..points.len())?;
    all.sort_unstable_by_key(|&at| places[inputs.vertices()[at] as usize]);
    Ok(all)
}
