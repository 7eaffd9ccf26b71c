#!/usr/bin/python3
"""One PDF of many: with an outline by pages and sections, and links that stay inside.

Run   join_pages.py BOOK.pdf < LIST     each line of LIST: a PDF that Chromium printed, the HTML file that it shows, its title

Pages of one chapter have titles that begin with its number, "2. Roots"; the later ones stand below the first.
"""
import html
import os
import re
import sys
from urllib.parse import unquote, urlsplit

from pypdf import PdfReader, PdfWriter
from pypdf.generic import ArrayObject, DictionaryObject, FloatObject, NameObject, TextStringObject
from pypdf.generic import Fit


def place_of(reader, destination):
    """The sheet within the part and the height on it; None for what leads nowhere."""
    sheet = reader.get_destination_page_number(destination)
    return None if sheet is None or sheet < 0 else (sheet, destination.get("/Top"))


def take_links(reader):
    """Takes all links off the part's sheets: (sheet, rectangle, address). One within the part is "#name"."""
    links = []
    for number, sheet in enumerate(reader.pages):
        for annotation in sheet.pop("/Annots", []):
            link = annotation.get_object()
            if link.get("/Subtype") != "/Link":
                continue
            if "/Dest" in link:
                links.append((number, link["/Rect"], "#" + str(link["/Dest"]).lstrip("/")))
            elif "/URI" in link.get("/A", {}):
                links.append((number, link["/Rect"], str(link["/A"]["/URI"])))
    return links


class Book:
    def __init__(self):
        self.writer = PdfWriter()
        self.first = {}  # HTML file -> its first sheet in the book, from 0
        self.places = {}  # HTML file -> {name: (sheet within it, height)}
        self.links = []  # (sheet, rectangle, HTML file, address)
        self.chapters = {}  # "2. " -> the outline's item of that chapter's first page

    def add(self, pdf, file, title):
        reader = PdfReader(pdf)
        first = self.first[file] = len(self.writer.pages)
        self.places[file] = {name.lstrip("/"): place_of(reader, destination)
                             for name, destination in reader.named_destinations.items()}
        self.links += [(first + sheet, rectangle, file, address) for sheet, rectangle, address in take_links(reader)]
        outline = reader.outline
        for sheet in reader.pages:
            self.writer.add_page(sheet)
        number = re.match(r"\d+\. ", title)
        chapter = number and self.chapters.get(number[0])
        item = self.writer.add_outline_item(title[number.end():] if chapter else title, first, chapter)
        if number:
            self.chapters.setdefault(number[0], item)
        self.add_outline(reader, outline, first, item)

    def add_outline(self, reader, items, first, parent):
        last = parent
        for item in items:
            if isinstance(item, list):
                self.add_outline(reader, item, first, last)
            elif (place := place_of(reader, item)) is not None:
                sheet, height = place
                last = self.writer.add_outline_item(item.title, first + sheet, parent, fit=Fit.xyz(0, height))

    def target(self, file, address):
        """Where a link leads: into the book, to the web, or, as one to the code's pages, nowhere."""
        parts = urlsplit(address)
        if parts.scheme in ("http", "https"):
            return {NameObject("/A"): DictionaryObject({NameObject("/S"): NameObject("/URI"),
                                                        NameObject("/URI"): TextStringObject(address)})}
        file = os.path.basename(unquote(parts.path)) or file
        if file not in self.first:
            return None
        sheet, height = self.places[file].get(unquote(parts.fragment)) or (0, None)
        page = self.writer.pages[self.first[file] + sheet]
        top = FloatObject(height if height is not None else page.mediabox.top)
        return {NameObject("/Dest"): ArrayObject([page.indirect_reference, NameObject("/XYZ"), FloatObject(0), top,
                                                  FloatObject(0)])}

    def add_links(self):
        for sheet, rectangle, file, address in self.links:
            target = self.target(file, address)
            if target is None:
                continue
            page = self.writer.pages[sheet]
            border = ArrayObject([FloatObject(0)] * 3)
            link = DictionaryObject({NameObject("/Type"): NameObject("/Annot"), NameObject("/Subtype"): NameObject("/Link"),
                                     NameObject("/Rect"): ArrayObject(FloatObject(x) for x in rectangle),
                                     NameObject("/Border"): border, **target})
            page.setdefault(NameObject("/Annots"), ArrayObject()).append(self.writer._add_object(link))


def main():
    book = Book()
    for line in sys.stdin:
        pdf, file, title = line.rstrip("\n").split("\t")
        book.add(pdf, file, html.unescape(title))
    book.add_links()
    book.writer.page_mode = "/UseOutlines"
    book.writer.add_metadata({"/Title": "Splitting Space"})
    with open(sys.argv[1], "wb") as out:
        book.writer.write(out)


main()
