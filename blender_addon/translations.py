# SPDX-License-Identifier: GPL-3.0-or-later
"""Translations of the interface: Blender looks up every name and tip of the extension here."""

import bpy

from pdtheory.drawing.glyphs import ORDERS

#: For words that Blender itself translates, and differently from what is meant here.
CONTEXT = "Principal Directions"

#: Where Blender looks: names and tips, names of operators, and what asks for our own words.
_CONTEXTS = ("*", "Operator", CONTEXT)

_GERMAN = {
    # The panels and what they do.
    "Directions": "Richtungen",
    "Principal Directions": "Hauptrichtungen",
    "Result": "Ergebnis",
    "Drawing": "Zeichnung",
    "Selected Point": "Gewählter Punkt",
    "Polar Plot": "Polardiagramm",
    "Directions Presets": "Vorgaben für Richtungen",
    "Select an object": "Ein Objekt auswählen",
    "Outline in View": "Umriss in Ansicht",
    "Add Directions Preset": "Vorgabe für Richtungen hinzufügen",
    "Cancel": "Abbrechen",
    "Compute Directions": "Richtungen berechnen",
    "Propose Radius": "Radius vorschlagen",
    "Show Neighbourhood": "Nachbarschaft zeigen",
    "Show Exact Directions": "Exakte Richtungen zeigen",
    "Show Strength": "Stärke zeigen",
    "Copy Wavejets Row": "Wavejets-Zeile kopieren",
    "Plot as Image": "Als Bild zeichnen",
    "Export Directions": "Richtungen exportieren",
    "Import Directions": "Richtungen importieren",
    "Principal Directions (.npz)": "Hauptrichtungen (.npz)",
    "Principal Directions (.npz, .ply, .vtp, .csv)": "Hauptrichtungen (.npz, .ply, .vtp, .csv)",
    # Settings.
    "Points": "Punkte",
    "Vertices": "Eckpunkte",
    "Vertex": "Eckpunkt",
    "Samples": "Proben",
    "Seed": "Startwert",
    "With Modifiers": "Mit Modifikatoren",
    "Neighbourhood": "Nachbarschaft",
    "Neighbours": "Nachbarn",
    "Radius": "Radius",
    "Degree": "Grad",
    "Orders": "Ordnungen",
    "Norm": "Norm",
    "Least Squares": "Kleinste Quadrate",
    "Least Deviations": "Kleinste Abweichungen",
    "Threads": "Threads",
    "Resolution": "Auflösung",
    "Colour": "Farbe",
    "File": "Datei",
    # How it is drawn.
    "Style": "Stil",
    "Length": "Länge",
    "By Strength": "Nach Stärke",
    "Width": "Breite",
    "Taper": "Verjüngung",
    "Lift": "Höhe",
    "Follow Surface": "Fläche folgen",
    "Spacing": "Abstand",
    "One Order Per Point": "Ordnungen reihum",
    "Maxima": "Maxima",
    "Minima": "Minima",
    "Inflections": "Wendestellen",
    "Least Strength": "Mindeststärke",
    "Largest Uncertainty": "Höchste Unsicherheit",
    "None": "Keine",
    "Order": "Ordnung",
    **{f"Order {order}": f"Ordnung {order}" for order in ORDERS},
    # The table of a point.
    "Kind": "Art",
    "Angle (°)": "Winkel (°)",
    "Eigenvalue": "Eigenwert",
    # Tips.
    "Compute the principal directions of the active object": (
        "Die Hauptrichtungen des aktiven Objekts berechnen"
    ),
    "Stop the computation (Esc)": "Die Berechnung abbrechen (Esc)",
    "Propose a radius that holds enough points for the degree, from the spacing of the points": (
        "Aus dem Abstand der Punkte einen Radius vorschlagen, der genug für den Grad fasst"
    ),
    "Work out the exact directions at some points and measure how far the estimated ones are": (
        "Die exakten Richtungen an einigen Punkten bestimmen und messen, wie weit die geschätzten "
        "davon abweichen"
    ),
    "Cover the materials of the surface with one that shows how strong the directions are": (
        "Die Materialien der Fläche mit einem überdecken, das die Stärke der Richtungen zeigt"
    ),
    "Copy the Wavejets coefficients of the active vertex to the clipboard": (
        "Die Wavejets-Koeffizienten des aktiven Eckpunkts in die Zwischenablage kopieren"
    ),
    "Show the neighbourhood of the active vertex as a ball, or hide it again": (
        "Die Nachbarschaft des aktiven Eckpunkts als Kugel zeigen oder wieder verbergen"
    ),
    "Draw the polar plot of the active vertex into an image, to look at closely and to save": (
        "Das Polardiagramm des aktiven Eckpunkts in ein Bild zeichnen, zum Betrachten und Speichern"
    ),
    "Write the directions of the active object: NPZ (all of it), PLY, VTP or CSV": (
        "Die Richtungen des aktiven Objekts schreiben: NPZ (vollständig), PLY, VTP oder CSV"
    ),
    "Show a direction field (NPZ) that was computed on the same object elsewhere": (
        "Ein Richtungsfeld (NPZ) zeigen, das anderswo auf demselben Objekt berechnet wurde"
    ),
    "Add or remove a preset of the settings": (
        "Eine Vorgabe der Einstellungen hinzufügen oder entfernen"
    ),
    "What the directions are computed on": "Woran die Richtungen berechnet werden",
    "Compute at the vertices of the object": "An den Eckpunkten des Objekts berechnen",
    "Spread points over the surface and compute at them": (
        "Punkte über die Fläche verteilen und an ihnen berechnen"
    ),
    "Number of points spread over the surface": "Anzahl der über die Fläche verteilten Punkte",
    "Seed of the samples": "Startwert der Proben",
    "Compute on the object as it is shown, with modifiers and shape keys": (
        "Auf dem Objekt berechnen, wie es gezeigt wird, mit Modifikatoren und Shape-Keys"
    ),
    "How the size of the neighbourhood of a point is chosen": (
        "Wie die Größe der Nachbarschaft eines Punkts gewählt wird"
    ),
    "So many nearest points": "So viele nächste Punkte",
    "All points within a distance": "Alle Punkte bis zu einer Entfernung",
    "Number of nearest points, the point itself among them": (
        "Anzahl der nächsten Punkte, der Punkt selbst eingeschlossen"
    ),
    "Radius of the neighbourhood": "Radius der Nachbarschaft",
    "Degree of the fitted polynomial; it limits the orders and amplifies noise": (
        "Grad des angepassten Polynoms; er begrenzt die Ordnungen und verstärkt Rauschen"
    ),
    "Orders of the directions": "Ordnungen der Richtungen",
    "Norm of the residuals of the fit": "Norm der Residuen der Anpassung",
    "Fast; for clean surfaces": "Schnell; für saubere Flächen",
    "Withstands outliers; several times slower": "Verträgt Ausreißer; um ein Mehrfaches langsamer",
    "Vertex whose directions are listed": "Eckpunkt, dessen Richtungen aufgeführt werden",
    "Order whose strength is shown": "Ordnung, deren Stärke gezeigt wird",
    "The materials that the object had before": "Die Materialien, die das Objekt vorher hatte",
    "Colour of the strokes, in the viewport and in pictures": (
        "Farbe der Striche, in der Ansicht und in Bildern"
    ),
    "Cells along a side, or from the centre to the rim": (
        "Zellen entlang einer Seite oder von der Mitte zum Rand"
    ),
    "Threads that compute; 0 leaves one core to the window, but takes at least two": (
        "Threads, die rechnen; 0 lässt dem Fenster einen Kern, nimmt aber mindestens zwei"
    ),
}

#: One table for each locale; the keys are contexts and the English texts in the code.
TABLES = {
    "de_DE": {
        (context, english): german for english, german in _GERMAN.items() for context in _CONTEXTS
    }
}


def register():
    bpy.app.translations.register(__package__, TABLES)


def unregister():
    bpy.app.translations.unregister(__package__)
