#!/usr/bin/python3
"""join_pages_test.py SCRIPT: proves that the book's PDF has an outline by chapters, pages and sections, at the right sheets,
and links that lead where they led: within a page, to another page of the book and into it, to the web; others are gone.
"""
import os
import subprocess
import sys
import tempfile

try:
    from pypdf import PdfReader, PdfWriter
    from pypdf.generic import ArrayObject, DictionaryObject, Fit, FloatObject, NameObject, TextStringObject
except ImportError:
    print("skipped: pypdf is not installed (package python3-pypdf)")
    sys.exit(77)

RECTANGLE = ArrayObject(FloatObject(x) for x in (10, 10, 20, 20))


def link(writer, target):
    """A link of a printed page: "#name" within it, else an address."""
    item = {NameObject("/Type"): NameObject("/Annot"), NameObject("/Subtype"): NameObject("/Link"),
            NameObject("/Rect"): RECTANGLE}
    if target.startswith("#"):
        item[NameObject("/Dest")] = TextStringObject(target[1:])
    else:
        item[NameObject("/A")] = DictionaryObject({NameObject("/S"): NameObject("/URI"),
                                                   NameObject("/URI"): TextStringObject(target)})
    return writer._add_object(DictionaryObject(item))


def part(folder, name, sheets, links):
    """Like what Chromium prints: a section on the last sheet, which is also a named place, and links on the first."""
    writer = PdfWriter()
    for _ in range(sheets):
        writer.add_blank_page(200, 300)
    section = writer.add_outline_item("Section of " + name, sheets - 1, fit=Fit.xyz(0, 250))
    writer.add_outline_item("Subsection of " + name, sheets - 1, section, fit=Fit.xyz(0, 150))
    writer.add_named_destination("place", sheets - 1)
    writer.pages[0][NameObject("/Annots")] = ArrayObject(link(writer, target) for target in links)
    file = os.path.join(folder, name + ".pdf")
    with open(file, "wb") as out:
        writer.write(out)
    return file


def titles(reader, items, depth=0):
    for item in items:
        if isinstance(item, list):
            yield from titles(reader, item, depth + 1)
        else:
            yield depth, item.title, reader.get_destination_page_number(item)


with tempfile.TemporaryDirectory() as folder:
    first = part(folder, "a", 2, ["#place", "file:///site/b.html", "file:///site/b.html#place"])
    second = part(folder, "b", 3, ["file:///site/a.html#none", "https://example.org/x", "file:///site/code_8hpp.html"])
    third = part(folder, "c", 1, [])
    book = os.path.join(folder, "book.pdf")
    subprocess.run([sys.executable, sys.argv[1], book], check=True, text=True,
                   input=f"{first}\ta.html\t1. A &amp; more\n{second}\tb.html\t2. B\n{third}\tc.html\t2. C\n")
    reader = PdfReader(book)
    found = list(titles(reader, reader.outline))
    expected = [(0, "1. A & more", 0), (1, "Section of a", 1), (2, "Subsection of a", 1),
                (0, "2. B", 2), (1, "Section of b", 4), (2, "Subsection of b", 4),
                (1, "C", 5), (2, "Section of c", 5), (3, "Subsection of c", 5)]
    numbers = {page.indirect_reference.idnum: number for number, page in enumerate(reader.pages)}
    leads = []
    for page in reader.pages:
        for annotation in page.get("/Annots", []):
            item = annotation.get_object()
            leads.append(numbers[item["/Dest"][0].idnum] if "/Dest" in item else str(item["/A"]["/URI"]))
    faults = []
    if len(reader.pages) != 6:
        faults.append(f"{len(reader.pages)} sheets, not 6")
    if found != expected:
        faults.append(f"the outline is {found}")
    if leads != [1, 2, 4, 0, "https://example.org/x"]:
        faults.append(f"links lead to {leads}")
print("\n".join(faults) or "an outline of 9 and 5 links, as they should be")
sys.exit(1 if faults else 0)
