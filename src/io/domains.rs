//! The hierarchy of domains as JSON.

use super::{allocation_failed, json};
use crate::memory::Lists;
use crate::mesh::{NONE, Triangulation};
use std::io::{self, Write};

/// Writes a line for each domain.
pub(super) fn write(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let domains = &triangulation.domains;
    let children = Lists::of_pairs(domains.len(), || {
        domains.iter().enumerate().map(|(index, domain)| (domain.parent, index as u32))
    });
    let cages = Lists::of_pairs(domains.len(), || {
        triangulation.cage_of.iter().enumerate().map(|(vertex, &cage)| (cage, vertex as u32))
    });
    let (children, cages) =
        (children.map_err(allocation_failed)?, cages.map_err(allocation_failed)?);
    let dim = triangulation.dim;
    write!(out, r#"{{"format":"netmesh domains","version":1,"dim":{dim},"domains":"#)?;
    json::lines(out, domains.iter().enumerate(), |out, (index, domain)| {
        write!(out, r#"{{"domain":{index},"parent":"#)?;
        json::id(out, domain.parent)?;
        out.write_all(br#","center":"#)?;
        json::id(out, domain.center)?;
        out.write_all(br#","point":"#)?;
        match domain.center {
            NONE => out.write_all(b"null")?,
            center => json::point(out, triangulation.point(center))?,
        }
        out.write_all(br#","radius":"#)?;
        json::number(out, domain.radius)?;
        out.write_all(br#","cage":"#)?;
        json::list(out, cages.of(index), |out, vertex| write!(out, "{vertex}"))?;
        out.write_all(br#","children":"#)?;
        json::list(out, children.of(index), |out, child| write!(out, "{child}"))?;
        out.write_all(b"}")
    })?;
    out.write_all(b"}\n")
}

#[cfg(test)]
mod tests {
    use super::super::{Format, samples, write};
    use super::NONE;
    use crate::mesh::{Domain, Mesh};

    fn text(mesh: &Mesh) -> String {
        let mut text = Vec::new();
        write(mesh, Format::DomainsJson, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn each_domain_has_its_centre_its_cage_and_its_children() {
        let square = samples::square();
        let mut triangulation = square.triangulation().unwrap().clone();
        triangulation.domains = vec![
            Domain { center: 2, parent: NONE, radius: 2.5 },
            Domain { center: 1, parent: 0, radius: 1e-300 },
            Domain { center: 0, parent: 0, radius: f64::INFINITY },
        ];
        triangulation.cage_of = vec![1, NONE, 0, 1];
        let mesh = Mesh::from_parts(square.inputs().clone(), triangulation);
        let expected = "{\"format\":\"netmesh domains\",\"version\":1,\"dim\":2,\"domains\":[\n\
            {\"domain\":0,\"parent\":null,\"center\":2,\"point\":[1,1],\"radius\":2.5,\
             \"cage\":[2],\"children\":[1,2]},\n\
            {\"domain\":1,\"parent\":0,\"center\":1,\"point\":[1,0],\"radius\":1e-300,\
             \"cage\":[0,3],\"children\":[]},\n\
            {\"domain\":2,\"parent\":0,\"center\":0,\"point\":[0,0],\"radius\":null,\
             \"cage\":[],\"children\":[]}]}\n";
        assert_eq!(text(&mesh), expected);
    }

    /// A part may have a domain without its centre.
    #[test]
    fn a_centre_that_is_not_there_is_null() {
        let square = samples::square();
        let mut triangulation = square.triangulation().unwrap().clone();
        triangulation.domains = vec![Domain { center: NONE, parent: NONE, radius: 2.5 }];
        let mesh = Mesh::from_parts(square.inputs().clone(), triangulation);
        assert!(text(&mesh).contains(r#""center":null,"point":null,"radius":2.5"#));
    }

    #[test]
    fn a_mesh_without_domains_has_an_empty_list() {
        let expected = "{\"format\":\"netmesh domains\",\"version\":1,\"dim\":4,\"domains\":[]}\n";
        assert_eq!(text(&samples::mesh(4)), expected);
    }
}
