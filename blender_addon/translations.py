# SPDX-License-Identifier: GPL-3.0-or-later
"""Translations of the interface: Blender looks up every label of the extension here."""

import bpy

_GERMAN = {
    "Principal Directions": "Hauptrichtungen",
    "Compute Directions": "Richtungen berechnen",
    "Propose Radius": "Radius vorschlagen",
    "Neighbourhood": "Nachbarschaft",
    "Neighbours": "Nachbarn",
    "Show Neighbourhood": "Nachbarschaft zeigen",
    "Show Exact Directions": "Exakte Richtungen zeigen",
    "Show Strength": "Stärke zeigen",
    "Copy Wavejets Row": "Wavejets-Zeile kopieren",
    "Polar Plot": "Polardiagramm",
    "Plot as Image": "Als Bild zeichnen",
    "Export Directions": "Richtungen exportieren",
    "Import Directions": "Richtungen importieren",
    "Orders": "Ordnungen",
    "Degree": "Grad",
    "With Modifiers": "Mit Modifikatoren",
}

#: One table for each locale; the keys are the English labels in the code.
TABLES = {"de_DE": {("*", english): german for english, german in _GERMAN.items()}}


def register():
    bpy.app.translations.register(__package__, TABLES)


def unregister():
    bpy.app.translations.unregister(__package__)
