"""Runs the code of a page: run_page.py PAGE. Needs the standard library alone, besides what the page
imports.
"""

import doctest
import os
import pathlib
import sys
import tempfile


def run(page: pathlib.Path) -> doctest.TestResults:
    """In the current directory."""
    # Fences are no part of what the code prints.
    lines = page.read_text().split("\n")
    text = "\n".join("" if line.startswith("```") else line for line in lines)
    test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    return doctest.DocTestRunner().run(test)


if __name__ == "__main__":
    page = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        failed, attempted = run(page)
    print(f"{page.name}: {attempted} examples, {failed} failed")
    sys.exit(failed > 0 or attempted < 10)
