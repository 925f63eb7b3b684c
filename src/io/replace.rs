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

/// Answers now what [`replace`] would answer after the work: a file beside the target is made and
/// removed again. A device or a pipe is not opened, since that alone may change or block it.
pub(super) fn require_writable(path: &Path) -> Result<()> {
    match fs::metadata(path) {
        Ok(metadata) if is_stream(&metadata) => return require_stream(path, &metadata),
        _ => {}
    }
    let (target, _) = writable_target(path)?;
    let (file, temporary) = create_beside(&target)?;
    let outcome = require_replaceable(&file, &target);
    drop(file);
    fs::remove_file(&temporary)
        .map_err(|error| of_path(path, "cannot remove a file beside it", &error))?;
    outcome
}

/// Returns true for what is written into rather than replaced.
fn is_stream(metadata: &fs::Metadata) -> bool {
    !metadata.is_file() && !metadata.is_dir()
}

/// Refuses a socket, which cannot be opened as a file.
#[cfg(unix)]
fn require_stream(path: &Path, metadata: &fs::Metadata) -> Result<()> {
    use std::os::unix::fs::FileTypeExt;
    match metadata.file_type().is_socket() {
        true => Err(refused(path, "is a socket, which no file can be written to", NO_SUCH_DEVICE)),
        false => Ok(()),
    }
}

#[cfg(not(unix))]
fn require_stream(_: &Path, _: &fs::Metadata) -> Result<()> {
    Ok(())
}

/// Refuses another user's file in a directory where each user replaces only own files, as in /tmp.
/// `own` is a file there that this process has just made.
#[cfg(unix)]
fn require_replaceable(own: &File, target: &Path) -> Result<()> {
    use std::os::unix::fs::MetadataExt;
    const STICKY: u32 = 0o1000;
    let (own, directory, there) =
        (own.metadata(), fs::metadata(directory_of(target)), fs::metadata(target));
    let (Ok(own), Ok(directory), Ok(there)) = (own, directory, there) else { return Ok(()) };
    let owners = [0, directory.uid(), there.uid()];
    match directory.mode() & STICKY != 0 && !owners.contains(&own.uid()) {
        true => Err(refused(
            target,
            "another user's file, which this user must not replace here",
            NOT_PERMITTED,
        )),
        false => Ok(()),
    }
}

#[cfg(not(unix))]
fn require_replaceable(_: &File, _: &Path) -> Result<()> {
    Ok(())
}

/// Opens what is there to be written into and must not be replaced: a device, a pipe. `None` for
/// files, whether there or not.
pub(super) fn open_stream(path: &Path) -> Result<Option<File>> {
    match fs::metadata(path) {
        Ok(metadata) if is_stream(&metadata) => {
            let opened = OpenOptions::new().write(true).open(path);
            opened.map(Some).map_err(|error| of_path(path, "cannot open", &error))
        }
        _ => Ok(None),
    }
}

/// Returns the files that this process has under temporary names in the directory of `path`, links
/// followed.
pub(super) fn temporary_files(path: &Path) -> Vec<PathBuf> {
    let target = follow_links(path).unwrap_or_else(|_| path.to_path_buf());
    let Ok(entries) = fs::read_dir(directory_of(&target)) else { return Vec::new() };
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

/// The numbers that Unix systems have for what is refused before they are asked: EISDIR, EACCES,
/// EPERM, ENXIO and ELOOP.
const IS_A_DIRECTORY: i32 = 21;
const PERMISSION_DENIED: i32 = 13;
const NOT_PERMITTED: i32 = 1;
const NO_SUCH_DEVICE: i32 = 6;
const TOO_MANY_LINKS: i32 = if cfg!(target_os = "linux") { 40 } else { 62 };

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

/// Returns the path that a chain of symbolic links ends at, whether a file is there or not.
pub(super) fn follow_links(path: &Path) -> Result<PathBuf> {
    /// Largest number of links that are followed: Linux follows as many.
    const MOST_LINKS: u32 = 40;
    let mut target = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&target) else { return Ok(target) };
        target = directory_of(&target).join(next);
    }
    Err(refused(path, "the link leads to a link, and so on without end", TOO_MANY_LINKS))
}

fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Returns true for `a/` and `a/.`, which [`Path`] takes for `a`, and the system for a directory.
fn names_a_directory(path: &Path) -> bool {
    let bytes = path.as_os_str().as_encoded_bytes();
    let is_separator = |byte: &u8| std::path::is_separator(char::from(*byte));
    bytes.strip_suffix(b".").unwrap_or(bytes).last().is_some_and(is_separator)
}

/// Returns the file to write, links followed, and the permissions of the file that is there.
fn writable_target(path: &Path) -> Result<(PathBuf, Option<fs::Permissions>)> {
    if path.file_name().is_none() {
        return Err(refused(path, "the path names no file", IS_A_DIRECTORY));
    }
    let target = follow_links(path)?;
    match fs::metadata(&target) {
        Ok(metadata) if metadata.is_dir() => Err(refused(path, "is a directory", IS_A_DIRECTORY)),
        _ if names_a_directory(&target) => {
            Err(refused(path, "the path names a directory", IS_A_DIRECTORY))
        }
        // A rename would replace it all the same.
        Ok(metadata) if metadata.permissions().readonly() => {
            Err(refused(path, "the file is read-only", PERMISSION_DENIED))
        }
        Ok(metadata) => Ok((target, Some(metadata.permissions()))),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok((target, None)),
        // A name that is too long, say: no rename would get there either.
        Err(error) => Err(of_path(path, "no file can be there", &error)),
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

fn refused(path: &Path, why: &str, code: i32) -> Error {
    Error::new(ErrorKind::Io, format!("{}: {why}", path.display())).with_system_code(Some(code))
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

        /// Returns all files with their contents, by name.
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

    /// Holds that a link that leads nowhere means the file that it will lead to.
    #[cfg(unix)]
    #[test]
    fn links_to_nothing_are_followed() {
        use std::os::unix::fs::symlink;
        let directory = Directory::new("dangling");
        fs::create_dir(directory.join("there")).unwrap();
        let (target, link) = (directory.join("there/a"), directory.join("link"));
        symlink("there/../there/second", &link).unwrap();
        symlink("a", directory.join("there/second")).unwrap();
        require_writable(&link).unwrap();
        let body = |out: &mut dyn Write| {
            assert_eq!(temporary_files(&link).len(), 1);
            new_text(out)
        };
        replace(&[(&link, &body)]).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&target).unwrap(), "new");
        symlink("circle", directory.join("circle")).unwrap();
        let missing = directory.join("nowhere");
        symlink("missing/a", &missing).unwrap();
        for path in [&directory.join("circle"), &missing] {
            assert_eq!(require_writable(path).unwrap_err().kind(), ErrorKind::Io);
            assert_eq!(replace(&[(path, &new_text)]).unwrap_err().kind(), ErrorKind::Io);
        }
    }

    /// Holds that whatever is refused after the work is refused before it, in the same words.
    #[test]
    fn what_cannot_be_written_is_known_before() {
        let directory = Directory::new("before");
        let old = directory.join("old");
        fs::write(&old, "old").unwrap();
        let mut permissions = fs::metadata(&old).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&old, permissions).unwrap();
        let long = "a".repeat(300);
        for name in ["missing/a", "old/a", "old", ".", "new/", "new/.", "..", &long] {
            let path = directory.0.join(name);
            let before = require_writable(&path).unwrap_err();
            let after = replace(&[(&path, &new_text)]).unwrap_err();
            assert_eq!((before.kind(), before.message()), (ErrorKind::Io, after.message()));
        }
        assert_eq!(directory.files(), owned(&[("old", "old")]));
        require_writable(&directory.join("new")).unwrap();
        assert_eq!(directory.files(), owned(&[("old", "old")]));
    }

    /// Directories that take no files, and sockets.
    #[cfg(target_os = "linux")]
    #[test]
    fn places_that_take_no_files_are_known_before() {
        let directory = Directory::new("sockets");
        let socket = directory.join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        for path in [Path::new("/proc/a"), &socket] {
            assert_eq!(require_writable(path).unwrap_err().kind(), ErrorKind::Io, "{path:?}");
        }
        require_writable(Path::new("/dev/null")).unwrap();
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
