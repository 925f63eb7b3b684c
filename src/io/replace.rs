//! Files that appear complete or not at all: written under another name in the same directory,
//! synchronised, then renamed.

use super::Buffered;
use super::io_error;
use crate::error::{Error, ErrorKind, Result};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes one file's content.
pub(super) type Body<'a> = &'a dyn Fn(&mut dyn Write) -> io::Result<()>;

/// Writes files that belong together: all are complete before the first one takes its place.
pub(super) fn replace(files: &[(&Path, Body<'_>)]) -> Result<()> {
    let mut staged = Vec::new();
    for (path, body) in files {
        staged.push(Staged::write(path, *body)?);
    }
    staged.into_iter().try_for_each(Staged::take_place)
}

/// Opens what is there to be written into and must not be replaced: a device, a pipe. `None` for
/// files, whether there or not.
pub(super) fn open_stream(path: &Path) -> Result<Option<File>> {
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() && !metadata.is_dir() => {
            let opened = OpenOptions::new().write(true).open(path);
            opened.map(Some).map_err(|error| of_path(path, "cannot open", &error))
        }
        _ => Ok(None),
    }
}

/// What this process has under temporary names in the directory of `path`, links followed.
pub(super) fn temporary_files(path: &Path) -> Vec<PathBuf> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let directory = match target.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let Ok(entries) = fs::read_dir(directory) else { return Vec::new() };
    let prefix = temporary_prefix();
    let is_temporary = |name: &str| name.starts_with(&prefix) && name.ends_with(SUFFIX);
    entries
        .filter_map(|entry| entry.ok())
        .filter(|entry| entry.file_name().to_str().is_some_and(is_temporary))
        .map(|entry| entry.path())
        .collect()
}

fn temporary_prefix() -> String {
    format!(".netmesh-{}-", std::process::id())
}

const SUFFIX: &str = ".tmp";

/// The system's numbers of what is refused before the system is asked: EISDIR and EACCES of every
/// Unix.
const IS_A_DIRECTORY: i32 = 21;
const PERMISSION_DENIED: i32 = 13;

/// A complete file under a temporary name, which is removed unless the file takes its place.
struct Staged {
    temporary: PathBuf,
    target: PathBuf,
    /// The temporary name is free again, and may be another thread's by now.
    renamed: bool,
}

impl Staged {
    fn write(path: &Path, body: Body<'_>) -> Result<Self> {
        let (target, permissions) = writable_target(path)?;
        let (file, temporary) = create_beside(&target)?;
        let staged = Self { temporary, target, renamed: false };
        let written = fill(file, permissions, body);
        written.map_err(|error| of_path(path, "cannot write", &error))?;
        Ok(staged)
    }

    fn take_place(mut self) -> Result<()> {
        fs::rename(&self.temporary, &self.target)
            .map_err(|error| of_path(&self.target, "cannot replace", &error))?;
        self.renamed = true;
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if !self.renamed {
            // An error is already on its way.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

/// Where to write, links followed, and the permissions of the file that is there.
fn writable_target(path: &Path) -> Result<(PathBuf, Option<fs::Permissions>)> {
    let refused = |why: &str, code: i32| {
        let message = format!("{}: {why}", path.display());
        Error::new(ErrorKind::Io, message).with_system_code(Some(code))
    };
    if path.file_name().is_none() {
        return Err(refused("the path names no file", IS_A_DIRECTORY));
    }
    let is_link = fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_symlink());
    let target = match is_link {
        true => fs::canonicalize(path).map_err(|e| of_path(path, "cannot follow the link", &e))?,
        false => path.to_path_buf(),
    };
    match fs::metadata(&target) {
        Ok(metadata) if metadata.is_dir() => Err(refused("is a directory", IS_A_DIRECTORY)),
        // A rename would replace it all the same.
        Ok(metadata) if metadata.permissions().readonly() => {
            Err(refused("the file is read-only", PERMISSION_DENIED))
        }
        Ok(metadata) => Ok((target, Some(metadata.permissions()))),
        Err(_) => Ok((target, None)),
    }
}

/// Creates a file that was not there before, in the directory of `target`.
fn create_beside(target: &Path) -> Result<(File, PathBuf)> {
    const ATTEMPTS: u32 = 10_000;
    let mut attempt = 0;
    loop {
        // Not made from the target's name, which may already be as long as names can be.
        let name = format!("{}{attempt}{SUFFIX}", temporary_prefix());
        let temporary = target.with_file_name(name);
        match OpenOptions::new().write(true).create_new(true).open(&temporary) {
            Ok(file) => return Ok((file, temporary)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && attempt < ATTEMPTS => {
                attempt += 1;
            }
            Err(error) => return Err(of_path(target, "cannot create a file beside it", &error)),
        }
    }
}

/// Writes through to the disk: a rename must not overtake its data.
fn fill(file: File, permissions: Option<fs::Permissions>, body: Body<'_>) -> io::Result<()> {
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    let mut buffered = Buffered::new(1 << 16, file).map_err(|_| io::ErrorKind::OutOfMemory)?;
    body(&mut buffered)?;
    buffered.flush()?;
    buffered.into_inner().sync_all()
}

fn of_path(path: &Path, what: &str, error: &io::Error) -> Error {
    io_error(&format!("{}: {what}", path.display()), error)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An empty directory that is removed at the end of the test.
    struct Directory(PathBuf);

    impl Directory {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("netmesh-{}-{name}", std::process::id()));
            fs::create_dir(&path).unwrap();
            Self(path)
        }

        fn join(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        /// All files with their contents, by name.
        fn files(&self) -> Vec<(String, String)> {
            let mut files: Vec<_> = fs::read_dir(&self.0)
                .unwrap()
                .map(|entry| entry.unwrap())
                .filter(|entry| entry.path().is_file())
                .map(|entry| {
                    let name = entry.file_name().into_string().unwrap();
                    (name, fs::read_to_string(entry.path()).unwrap())
                })
                .collect();
            files.sort();
            files
        }
    }

    impl Drop for Directory {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn owned(files: &[(&str, &str)]) -> Vec<(String, String)> {
        files.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect()
    }

    fn new_text(out: &mut dyn Write) -> io::Result<()> {
        out.write_all(b"new")
    }

    /// Fails when some of its data has reached the file.
    fn failing(out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&[b'x'; 1 << 17])?;
        Err(io::Error::other("the disk is full"))
    }

    #[test]
    fn replaces_and_leaves_nothing_beside() {
        let directory = Directory::new("replaces");
        fs::write(directory.join("a"), "old").unwrap();
        let (a, b) = (directory.join("a"), directory.join("b"));
        replace(&[(&a, &new_text), (&b, &new_text)]).unwrap();
        assert_eq!(directory.files(), owned(&[("a", "new"), ("b", "new")]));
    }

    #[test]
    fn a_failure_leaves_every_file_as_it_was() {
        let directory = Directory::new("failure");
        fs::write(directory.join("a"), "old").unwrap();
        let (a, b) = (directory.join("a"), directory.join("b"));
        // The second of a pair fails: the first, already complete, does not take its place.
        let error = replace(&[(&a, &new_text), (&b, &failing)]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        assert!(error.message().ends_with("b: cannot write: the disk is full"), "{error}");
        assert_eq!(directory.files(), owned(&[("a", "old")]));
        replace(&[(&a, &failing)]).unwrap_err();
        assert_eq!(directory.files(), owned(&[("a", "old")]));
    }

    #[test]
    fn a_file_in_the_making_is_under_another_name() {
        let directory = Directory::new("making");
        let a = directory.join("a");
        fs::write(&a, "old").unwrap();
        let body = |out: &mut dyn Write| {
            assert_eq!(fs::read_to_string(&a).unwrap(), "old");
            assert_eq!(directory.files().len(), 2);
            let temporary = temporary_files(&a);
            assert_eq!(temporary.len(), 1);
            assert!(temporary[0].is_file() && temporary[0] != a, "{temporary:?}");
            new_text(out)
        };
        replace(&[(&a, &body)]).unwrap();
        assert!(temporary_files(&a).is_empty());
        assert_eq!(directory.files(), owned(&[("a", "new")]));
    }

    #[test]
    fn other_files_of_the_temporary_name_are_left_alone() {
        let directory = Directory::new("others");
        let other = format!(".netmesh-{}-0.tmp", std::process::id());
        fs::write(directory.join(&other), "other").unwrap();
        replace(&[(&directory.join("a"), &new_text)]).unwrap();
        assert_eq!(directory.files(), owned(&[(&other, "other"), ("a", "new")]));
    }

    #[test]
    fn refuses_directories_and_missing_directories() {
        let directory = Directory::new("directories");
        fs::create_dir(directory.join("d")).unwrap();
        let (a, d) = (directory.join("a"), directory.join("d"));
        for path in [&d, &directory.join("missing").join("a"), Path::new("/"), Path::new("")] {
            let error = replace(&[(&a, &new_text), (path, &new_text)]).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Io, "{path:?}");
            assert!(directory.files().is_empty(), "{path:?}");
        }
    }

    #[test]
    fn refuses_a_read_only_file() {
        let directory = Directory::new("read-only");
        let a = directory.join("a");
        fs::write(&a, "old").unwrap();
        let mut permissions = fs::metadata(&a).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&a, permissions).unwrap();
        let error = replace(&[(&a, &new_text)]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        assert!(error.message().contains("read-only"), "{error}");
        assert_eq!(directory.files(), owned(&[("a", "old")]));
    }

    #[cfg(unix)]
    #[test]
    fn follows_links_and_keeps_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let directory = Directory::new("links");
        let (a, link) = (directory.join("a"), directory.join("link"));
        fs::write(&a, "old").unwrap();
        fs::set_permissions(&a, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&a, &link).unwrap();
        replace(&[(&link, &new_text)]).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&a).unwrap(), "new");
        assert_eq!(fs::metadata(&a).unwrap().permissions().mode() & 0o777, 0o640);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_are_streams_and_files_are_not() {
        let directory = Directory::new("devices");
        assert!(open_stream(Path::new("/dev/null")).unwrap().is_some());
        assert!(open_stream(&directory.0).unwrap().is_none());
        assert!(open_stream(&directory.join("missing")).unwrap().is_none());
        let mut full = open_stream(Path::new("/dev/full")).unwrap().unwrap();
        let mesh = super::super::samples::square();
        let error = super::super::write(&mesh, super::super::Format::Vtu, &mut full).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
    }
}
