"""Unpacks a source distribution: unpack.py ARCHIVE DIRECTORY.

Files that have not changed stay as they are, with their times, so that cargo need not build them
again; what the archive does not have is removed.
"""

import pathlib
import sys
import tarfile


def unpack(archive: pathlib.Path, directory: pathlib.Path) -> None:
    kept = set()
    with tarfile.open(archive) as files:
        for member in files:
            if not member.isfile():
                raise SystemExit(f"{archive}: {member.name} is not a plain file")
            # Without the directory that all of it is in.
            path = directory.joinpath(*pathlib.PurePosixPath(member.name).parts[1:])
            content = files.extractfile(member).read()
            kept.add(path)
            if not path.is_file() or path.read_bytes() != content:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
    for path in directory.rglob("*"):
        if path.is_file() and path not in kept:
            path.unlink()


unpack(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
