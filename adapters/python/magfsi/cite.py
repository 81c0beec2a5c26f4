# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi cite: magfsi and the paper whose model it computes, as BibTeX."""
import argparse
import sys

import yaml

from magfsi import runs


def bibtex(kind, key, fields):
    return "\n".join([f"@{kind}{{{key},", *(f"  {name} = {{{value}}}," for name, value in fields.items()
                                            if value), "}"])


def names(authors):
    """A name in one piece is no person's: a second pair of braces keeps it whole."""
    return " and ".join(f"{a['family-names']}, {a['given-names']}" if "family-names" in a
                        else f"{{{a['name']}}}" for a in authors)


def entries(cited):
    """Of CITATION.cff, the work itself first (citation-file-format.github.io)."""
    yield bibtex("software", "magfsi", {
        "author": names(cited["authors"]), "title": f"{cited['title']}: {cited['abstract'].rstrip('.')}",
        "version": cited["version"], "url": cited.get("repository-code")})
    for paper in cited["references"]:
        yield bibtex("article", f"{paper['authors'][0]['family-names'].lower()}{paper['year']}", {
            "author": names(paper["authors"]), "title": paper["title"], "journal": paper["journal"],
            "volume": paper["volume"], "year": paper["year"],
            "pages": f"{paper['start']}--{paper['end']}", "doi": paper["doi"]})


def main():
    argparse.ArgumentParser(prog="magfsi cite", description=__doc__).parse_args()
    print("\n\n".join(entries(yaml.safe_load((runs.ROOT / "CITATION.cff").read_text()))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
