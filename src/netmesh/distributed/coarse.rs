//! The coarse mesh, which all processes make alike, and how it is cut.

use crate::complex::VertexId;
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::Inputs;
use crate::netmesh::distributed::assembly::{Assembly, First};
use crate::netmesh::distributed::bisection::Bisection;
use crate::netmesh::distributed::hierarchy::Domains;
use crate::netmesh::distributed::maker::Maker;
use crate::netmesh::distributed::piece::Piece;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::order::by_locality;
use crate::netmesh::state::watch::Watch;
use crate::options::{Options, ProgressFn};
use crate::parameters::Parameters;

/// Places of points in the coarse mesh.
pub struct Located {
    /// Point -> a simplex that it is in; `u32::MAX` if it is at a vertex.
    pub simplices: Vec<u32>,
    /// The points at vertices that are not of the sample, each with the vertex. On lattices there
    /// are some.
    pub at_steiner_points: Vec<(usize, u32)>,
}

/// The NETMESH mesh of a sample, with the loose bound that holds while inputs go in.
pub struct Coarse<const D: usize> {
    piece: Piece<D>,
    delaunay: Delaunay<D>,
    /// Number of vertices that are of the sample. They come first.
    pub(super) sample: usize,
    maker: Maker<D>,
}

impl<const D: usize> Coarse<D> {
    /// Makes the coarse mesh of `sample`, which must be distinct, have the extreme points of all
    /// inputs along every axis, the input nearest to the middle of their box, and that farthest
    /// from the latter. `names`: their numbers among all inputs. Clusters of at most `small` points
    /// have one vertex.
    ///
    /// # Errors
    /// Fails as [`crate::Mesh::run`] does.
    pub fn new(
        sample: &[[f64; D]],
        names: &[u64],
        small: usize,
        options: &Options,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Self> {
        let parameters =
            Parameters { inputs_per_partition: None, ..Parameters::resolve(D, options)? };
        let mut mesher = mesh(sample, &parameters, Watch::new(progress))?;
        let mut names = collected(mesher.order.iter().map(|input| names[input.index()]))?;
        if let Some(left) = mesher.state.thinned(small)? {
            let points =
                collected(left.iter().map(|&vertex| *mesher.state.delaunay.point(vertex)))?;
            let own = collected(left.iter().map(|&vertex| names[vertex.index()]))?;
            let Mesher { state, watch, .. } = mesher;
            drop(state);
            mesher = mesh(&points, &parameters, watch)?;
            names = collected(mesher.order.iter().map(|input| own[input.index()]))?;
        }
        let sample = names.len();
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
        Ok(Self { piece, delaunay, sample, maker })
    }

    pub fn maker(&self) -> &Maker<D> {
        &self.maker
    }

    /// Locates `points` in the coarse mesh. The place of one does not depend on the others. They
    /// are visited in an order of locality, so that walks are short.
    ///
    /// # Errors
    /// `NonFinite`; `OutOfMemory`; `Cancelled`.
    pub fn locate(
        &self,
        points: &[[f64; D]],
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Located> {
        let mut watch = Watch::new(progress);
        let mut found =
            Located { simplices: filled(points.len(), u32::MAX)?, at_steiner_points: Vec::new() };
        let mut near = self.delaunay.complex().incident(VertexId::new(0));
        for at in order_of(points, &mut watch)? {
            watch.poll_after(4)?;
            let simplex = self.delaunay.first_simplex_at(near, &points[at])?;
            near = simplex.expect("the outer cage surrounds the inputs");
            let mut vertices = self.delaunay.complex().vertices(near).iter();
            let is_here = |vertex: &&VertexId| {
                vertex.is_valid() && *self.delaunay.point(**vertex) == points[at]
            };
            match vertices.find(is_here) {
                None => found.simplices[at] = near.number(),
                Some(vertex) if vertex.index() < self.sample => {}
                Some(vertex) => found.at_steiner_points.try_push((at, vertex.number()))?,
            }
        }
        Ok(found)
    }

    /// Makes Steiner points, by [`Located::at_steiner_points`], the inputs of the given names, as
    /// if they had yielded to them. Each vertex is there once.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn yield_to(&mut self, inputs: &[(u32, u64)]) -> Result<()> {
        let mut renamed = with_capacity(inputs.len())?;
        for &(vertex, name) in inputs {
            let named = &mut self.piece.vertices[vertex as usize];
            renamed.push((std::mem::replace(&mut named.name, name), name));
        }
        renamed.sort_unstable();
        let domains = self.piece.domains.iter_mut();
        for name in domains.flat_map(|domain| domain.cage.iter_mut().chain([&mut domain.center])) {
            if let Ok(at) = renamed.binary_search_by_key(name, |&(old, _)| old) {
                *name = renamed[at].1;
            }
        }
        Ok(())
    }

    /// Returns the partition of every simplex.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn partitions(&self, cut: &Bisection<D>) -> Result<Vec<u32>> {
        self.piece.parts(cut)
    }

    /// Extracts partition `partition` as a piece, without inputs that wait ([`Piece::add_inputs`]),
    /// and the ids that its simplices had: `ids[i]` is that of simplex i.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn extract(&self, partition_of: &[u32], partition: u32) -> Result<(Piece<D>, Vec<u32>)> {
        let is_selected = collected(partition_of.iter().map(|&of| of == partition))?;
        let mut piece = self.piece.select(&is_selected, || Ok(()))?;
        piece.set_outer()?;
        let own = (0..).zip(&is_selected).filter(|(_, is_selected)| **is_selected);
        Ok((piece, collected(own.map(|(simplex, _)| simplex))?))
    }
}

/// Makes the mesh of distinct `points`, with the loose bound.
pub(super) fn mesh<'a, 'b, const D: usize>(
    points: &[[f64; D]],
    parameters: &Parameters,
    watch: Watch<'a, 'b>,
) -> Result<Mesher<'a, 'b, D>> {
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0)?;
    let own = Parameters { is_sample: true, ..parameters.clone() };
    let mut mesher = Mesher::new(&inputs, own, watch)?;
    let mut cavity = Cavity::default();
    mesher.start_netmesh(&mut cavity)?;
    mesher.insert_rounds(&mut cavity)?;
    Ok(mesher)
}

/// Returns the places of `points` in an order of locality.
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
