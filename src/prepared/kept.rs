//! Arrays of a selection that getters have made and not handed out yet.

use crate::arrays::{Arrays, Group, Part, Selection};
use crate::error::Result;
use std::sync::Mutex;

/// Arrays of one group and one selection. Callers ask for the size of an array and then for the
/// array, and for the arrays of a group in turn: the first of these calls makes them all.
#[derive(Default)]
pub(super) struct Kept(Mutex<Option<Made>>);

struct Made {
    selection: Selection,
    group: Group,
    arrays: Arrays,
}

impl Kept {
    /// Calls `act` with the array that `array` picks from a group. Afterwards that array is dropped
    /// if `act` answers true, and kept if not; the other arrays of its group are kept until another
    /// group or selection is asked for.
    pub fn with<'a, T>(
        &self,
        (selection, group): (&Selection, Group),
        part: impl FnOnce() -> Result<Part<'a>>,
        array: impl Fn(&mut Arrays) -> &mut Option<Vec<T>>,
        act: impl FnOnce(&[T]) -> Result<bool>,
    ) -> Result<()> {
        let mut kept = self.take();
        let has_selection = |made: &mut Made| {
            made.selection == *selection && made.group == group && array(&mut made.arrays).is_some()
        };
        let mut made = match kept.take_if(has_selection) {
            Some(made) => made,
            None => {
                drop(kept);
                Made { selection: *selection, group, arrays: part()?.group(group)? }
            }
        };
        let wanted = array(&mut made.arrays);
        let done = act(wanted.as_deref().unwrap_or_default());
        if let Ok(true) = done {
            *wanted = None;
        }
        if !made.arrays.is_empty() {
            self.put(made);
        }
        done.map(|_| ())
    }

    /// Takes the kept arrays out. While one call uses them, others find nothing and make their own,
    /// so that no call waits for another one. If two reach for them in the same moment, one finds
    /// nothing, too.
    fn take(&self) -> Option<Made> {
        self.0.try_lock().ok()?.take()
    }

    fn put(&self, made: Made) {
        // Dropped after the lock is given back.
        let _before = self.0.try_lock().ok().and_then(|mut kept| kept.replace(made));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrays::tests::{delaunay, meshed};
    use crate::error::{Error, ErrorKind};
    use crate::numerics::testing::{Family, Random, points};
    use std::cell::Cell;

    type Pick = fn(&mut Arrays) -> &mut Option<Vec<u32>>;
    const IDS: Pick = |of| &mut of.ids;
    const SIMPLICES: Pick = |of| &mut of.simplices;

    #[test]
    fn a_group_is_made_once_and_each_array_kept_until_it_is_handed_out() {
        let points = points::<3>(Family::Uniform, 30, &mut Random(5));
        let mesh = meshed(&points, &delaunay()).unwrap();
        let (facets, hull) = (mesh.facets().unwrap(), mesh.hull().unwrap());
        let (kept, made, all) = (Kept::default(), Cell::new(0), Selection::default());
        let part = || {
            made.set(made.get() + 1);
            mesh.whole()
        };
        let ask = |selection: &Selection, group, array, is_handed_out| {
            let mut found = Vec::new();
            let act = |ids: &[u32]| {
                found = ids.to_vec();
                Ok(is_handed_out)
            };
            kept.with((selection, group), part, array, act).unwrap();
            (found, made.get())
        };
        let of_facets = |array, is_handed_out| ask(&all, Group::Facets, array, is_handed_out);
        assert_eq!(of_facets(IDS, false), (facets.vertices.clone(), 1));
        assert_eq!(of_facets(IDS, true), (facets.vertices.clone(), 1));
        assert_eq!(of_facets(SIMPLICES, false), (facets.simplices.clone(), 1));
        let refused = kept.with((&all, Group::Facets), part, SIMPLICES, |_| {
            Err(Error::new(ErrorKind::Capacity, "too small"))
        });
        assert_eq!(refused.unwrap_err().kind(), ErrorKind::Capacity);
        assert_eq!(of_facets(SIMPLICES, true), (facets.simplices.clone(), 1));
        assert!(kept.0.try_lock().unwrap().is_none(), "all has been handed out");
        assert_eq!(of_facets(SIMPLICES, true), (facets.simplices.clone(), 2));
        assert_eq!(of_facets(SIMPLICES, false), (facets.simplices.clone(), 3));
        assert_eq!(ask(&all, Group::Hull, IDS, false), (hull.vertices.clone(), 4));
        assert_eq!(of_facets(IDS, false), (facets.vertices.clone(), 5));
        let across = Selection { across: true, ..all };
        assert_eq!(ask(&across, Group::Facets, IDS, false).1, 6);
        // While one call uses what is kept, another one makes its own.
        let nested = kept.with((&across, Group::Facets), part, IDS, |ids| {
            assert_eq!(ask(&across, Group::Facets, IDS, true), (ids.to_vec(), 7));
            Ok(false)
        });
        assert!(nested.is_ok());
    }

    #[test]
    fn threads_that_ask_for_different_arrays_get_the_right_ones() {
        let points = points::<3>(Family::Uniform, 60, &mut Random(5));
        let mesh = meshed(&points, &delaunay()).unwrap();
        let groups = [Group::Facets, Group::Hull, Group::Edges, Group::VertexNeighbors];
        let kept = Kept::default();
        let ask = |thread: usize| {
            for round in 0..200 {
                let group = groups[(thread + round / 3) % groups.len()];
                let expected = mesh.whole().unwrap().group(group).unwrap().ids;
                let act = |ids: &[u32]| {
                    assert_eq!(Some(ids), expected.as_deref());
                    Ok(round % 2 == 0)
                };
                let all = Selection::default();
                kept.with((&all, group), || mesh.whole(), IDS, act).unwrap();
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|at| _ = scope.spawn(move || ask(at))));
    }
}
