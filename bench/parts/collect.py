"""Copies the surfaces in packages to one folder, for survey.py.

    collect.py FOLDER PACKAGE...

PACKAGE is a wheel, an archive of sources, or a folder. A file is called as its package, its folder and
itself, joined by underscores. Of files with the same bytes the first is copied, and what lies in the
folder already is not copied again.
"""
import argparse
import hashlib
import tarfile
import zipfile
from itertools import chain, count
from pathlib import Path, PurePosixPath

from survey import SURFACES


def members(package):
    """Yields the path and a function that returns the bytes of each file of a package."""
    if package.is_dir():
        for path in sorted(package.rglob("*")):
            if path.is_file():
                yield path.relative_to(package).as_posix(), path.read_bytes
    elif zipfile.is_zipfile(package):
        with zipfile.ZipFile(package) as archive:
            for name in sorted(archive.namelist()):
                yield name, lambda name=name: archive.read(name)
    else:
        with tarfile.open(package) as archive:
            for member in sorted(archive.getmembers(), key=lambda member: member.name):
                if member.isfile():
                    yield member.name, lambda member=member: archive.extractfile(member).read()


def place_of(folder, package, path):
    """Returns a path in the folder that no file has: with a number where another is called the same."""
    short = package.name.split("-")[0].split("_")[0].split(".")[0]
    name = PurePosixPath("_".join([short, *PurePosixPath(path).parts[-2:]]).replace(" ", "_"))
    names = chain([name], (name.with_stem(f"{name.stem}_{k}") for k in count(2)))
    return next(folder / name for name in names if not (folder / name).exists())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("packages", type=Path, nargs="+")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    seen = {hashlib.sha256(path.read_bytes()).digest() for path in arguments.folder.rglob("*") if path.is_file()}
    for package in arguments.packages:
        for path, read in members(package):
            if PurePosixPath(path).suffix.lower() not in SURFACES:
                continue
            content = read()
            digest = hashlib.sha256(content).digest()
            if digest not in seen:
                seen.add(digest)
                place_of(arguments.folder, package, path).write_bytes(content)


if __name__ == "__main__":
    main()
