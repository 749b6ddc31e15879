# SPDX-License-Identifier: Apache-2.0
"""survey.gpkg as QGIS itself opens it: every layer finds its style, each style means what docs/interfaces.md promises, and the
map that is drawn shows it (tools/setup.sh readers)."""
import contextlib
import math
import os
import re
import shutil
import sqlite3
import sys
import unittest

import sonarx
from sonarx import OUT, WORK, Case

FOLDER = WORK / "qgis"
# Nobody's own settings and styles, and no display.
os.environ.update(QT_QPA_PLATFORM="offscreen", QGIS_CUSTOM_CONFIG_PATH=str(FOLDER / "profile"), XDG_RUNTIME_DIR=str(FOLDER))
try:
    import numpy
    from qgis.core import (QgsApplication, QgsDataProvider, QgsExpression, QgsExpressionContext,
                           QgsGraduatedSymbolRenderer, QgsMapRendererParallelJob,
                           QgsMapSettings, QgsRenderContext, QgsSimpleFillSymbolLayer, QgsSimpleLineSymbolLayer,
                           QgsSimpleMarkerSymbolLayer, QgsSingleSymbolRenderer, QgsVectorLayer)
    from qgis.PyQt.QtCore import QSize, Qt
    from qgis.PyQt.QtGui import QColor, QImage
except ImportError as missing:
    print(f"skipped: {missing} (python3-qgis and python3-numpy: tools/setup.sh readers)")
    sys.exit(77)

# docs/interfaces.md section 5, the uppermost first: points, lines, small areas, large areas.
LAYERS = ["school_centres", "observation_starts", "vessel_track", "school_outlines", "schools", "observations", "swept"]
WIDTH, HEIGHT = 900, 600


def setUpModule():
    global application
    FOLDER.mkdir(parents=True, exist_ok=True)
    FOLDER.chmod(0o700)
    application = QgsApplication([], False)
    application.initQgis()


def opened(file, name):
    layer = QgsVectorLayer(f"{file}|layername={name}", name, "ogr")
    assert layer.isValid(), name
    return layer


def drawn(layers, extent, file):
    """(What QGIS draws on white as rows of pixels, where a place lies in it); the picture stays to be looked at."""
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setDestinationCrs(layers[0].crs())
    settings.setOutputSize(QSize(WIDTH, HEIGHT))
    settings.setBackgroundColor(QColor("white"))
    settings.setExtent(extent)
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    assert not job.errors(), [e.message for e in job.errors()]
    image = job.renderedImage().convertToFormat(QImage.Format_RGB888)
    image.save(str(FOLDER / file))
    pixels = numpy.frombuffer(image.constBits().asstring(image.sizeInBytes()), numpy.uint8)
    pixels = pixels.reshape(HEIGHT, image.bytesPerLine())[:, :3 * WIDTH].reshape(HEIGHT, WIDTH, 3).astype(int)
    return pixels, settings.mapToPixel()


def over(colour, below=(255, 255, 255)):
    """The colour that a translucent one gives over another."""
    return [colour.alphaF() * c + (1 - colour.alphaF()) * b for c, b in zip(colour.getRgb(), below)]


def drawn_as(layer, feature):
    """Name of the colour that the layer's style gives to a feature; None: it is not drawn."""
    context = QgsRenderContext()
    context.expressionContext().setFields(layer.fields())
    context.expressionContext().setFeature(feature)
    renderer = layer.renderer().clone()
    renderer.startRender(context, layer.fields())
    symbol = renderer.originalSymbolForFeature(feature, context)
    colour = None if symbol is None else symbol.color().name()
    renderer.stopRender(context)
    return colour


def pixels_of(pixels, rgb, tolerance=6):
    """How many pixels have this colour."""
    return int((numpy.abs(pixels - numpy.array(rgb)).max(axis=2) <= tolerance).sum())


def limits_db(label):
    """What the legend says of a class: 'below -65 dB', '-65 to -60 dB', '-35 dB and more'."""
    numbers = [float(n) for n in re.findall(r"-?\d+", label)]
    if label.startswith("below"):
        return -math.inf, numbers[0]
    return (numbers[0], math.inf) if label.endswith("and more") else tuple(numbers)


class Map(Case):
    def setUp(self):
        folder = self.fresh("qgis/map")  # QGIS may write beside a GeoPackage, and no style may lie beside this one
        self.file = folder / "survey.gpkg"
        shutil.copy(OUT / "survey.gpkg", self.file)
        self.layers = {name: opened(self.file, name) for name in LAYERS}
        for name, layer in self.layers.items():
            told, found = layer.loadDefaultStyle()
            self.assertTrue(found, f"{name}: {told}")

class Styles(Map):
    def part(self, name):
        """The one part of the one symbol of a layer that is drawn the same everywhere."""
        renderer = self.layers[name].renderer()
        self.assertIsInstance(renderer, QgsSingleSymbolRenderer, name)
        self.assertEqual((renderer.symbol().symbolLayerCount(), renderer.symbol().opacity()), (1, 1.0), name)
        return renderer.symbol().symbolLayer(0)

    def test_no_layer_is_left_out(self):
        whole = QgsVectorLayer(str(self.file), "all", "ogr")
        sublayers = [s.split(QgsDataProvider.sublayerSeparator())[1] for s in whole.dataProvider().subLayers()]
        self.assertEqual(sorted(sublayers), sorted(LAYERS))

    def test_a_style_is_found_only_where_there_is_one(self):
        file = self.file.with_name("without.gpkg")
        shutil.copy(OUT / "survey.gpkg", file)
        with contextlib.closing(sqlite3.connect(file)) as map_, map_:
            map_.execute("DELETE FROM layer_styles WHERE f_table_name = 'swept'")
        self.assertFalse(opened(file, "swept").loadDefaultStyle()[1])
        self.assertTrue(opened(file, "schools").loadDefaultStyle()[1])

    def test_track_and_outlines_are_lines(self):
        track = self.part("vessel_track")
        self.assertIsInstance(track, QgsSimpleLineSymbolLayer)
        self.assertEqual((track.penStyle(), track.color().alpha()), (Qt.SolidLine, 255))
        self.assertGreater(track.width(), 0)
        for name in ("school_outlines", "observations"):
            outline = self.part(name)
            self.assertIsInstance(outline, QgsSimpleFillSymbolLayer, name)
            self.assertTrue(outline.brushStyle() == Qt.NoBrush or outline.fillColor().alpha() == 0, f"{name} is filled")
            self.assertEqual(outline.strokeStyle(), Qt.SolidLine, name)
            self.assertGreater(outline.strokeWidth(), 0, name)
            self.assertGreater(outline.strokeColor().alphaF(), 0.5, name)

    def test_starts_are_markers(self):
        start = self.part("observation_starts")
        self.assertIsInstance(start, QgsSimpleMarkerSymbolLayer)
        self.assertEqual(start.color().alpha(), 255)
        self.assertGreater(start.size(), 0)

    def test_areas_are_tints(self):
        classes = self.layers["schools"].renderer().ranges()  # kept: their symbols go with them
        for tint in [self.part("swept"), *(c.symbol().symbolLayer(0) for c in classes)]:
            self.assertEqual(tint.brushStyle(), Qt.SolidPattern)
            self.assertTrue(0 < tint.fillColor().alphaF() < 1, tint.fillColor().getRgb())

    def test_schools_have_the_class_of_their_mean_sv(self):
        for name, table in (("schools", "schools.csv"), ("school_centres", "school_pings.csv")):
            layer, renderer = self.layers[name], self.layers[name].renderer()
            self.assertIsInstance(renderer, QgsGraduatedSymbolRenderer, name)
            self.assertIn("sv_mean_db", QgsExpression(renderer.classAttribute()).referencedColumns())
            ranges = [r for r in renderer.ranges() if r.label() != "unknown"]
            self.assertEqual([r.lowerValue() for r in ranges[1:]], [r.upperValue() for r in ranges[:-1]], "no gaps")
            self.assertTrue(all(r.renderState() for r in ranges))
            luminance = [numpy.dot((0.2126, 0.7152, 0.0722), r.symbol().color().getRgb()[:3]) for r in ranges]
            self.assertEqual(luminance, sorted(set(luminance)), "the louder the brighter")
            of_table = [float(row["sv_mean_db"]) for row in sonarx.read_csv(OUT / table)]
            for feature in layer.getFeatures():
                self.assertIsNotNone(drawn_as(layer, feature), "a school that is not drawn")
            of_map = [feature["sv_mean_db"] for feature in layer.getFeatures()]
            self.assertEqual(sorted(of_map), sorted(of_table))
            labels = {r.symbol().color().name(): r.label() for r in ranges}
            for sv in of_table:
                label = labels[renderer.symbolForValue(sv).color().name()]
                low, high = limits_db(label)
                self.assertTrue(low <= sv <= high, f"{sv} dB is called {label}")

    def test_a_school_of_unknown_sv_is_drawn_too_and_has_no_class_of_sv(self):
        for name in ("schools", "school_centres"):
            layer, renderer = self.layers[name], self.layers[name].renderer()
            feature = next(layer.getFeatures())
            feature["sv_mean_db"] = None
            colour = drawn_as(layer, feature)
            self.assertIsNotNone(colour, f"{name}: nothing is drawn")
            self.assertEqual([r.label() for r in renderer.ranges() if r.symbol().color().name() == colour], ["unknown"])

    def test_schools_bear_their_number_in_the_survey(self):
        layer = self.layers["schools"]
        self.assertTrue(layer.labelsEnabled())
        settings = layer.labeling().settings()
        label = settings.getLabelExpression()
        context = QgsExpressionContext()
        numbers = set()
        for feature in layer.getFeatures():
            context.setFeature(feature)
            self.assertEqual(label.evaluate(context), str(feature["survey_school"]))
            numbers.add(feature["survey_school"])
        self.assertEqual(numbers, set(range(1, len(numbers) + 1)))
        feature["survey_school"] = 0  # not merged yet
        context.setFeature(feature)
        self.assertEqual(label.evaluate(context), "")
        for name in set(LAYERS) - {"schools"}:
            self.assertFalse(self.layers[name].labelsEnabled(), name)


class Picture(Map):
    """The first observation only: the second lies kilometres away, and its schools would be dots."""

    def setUp(self):
        super().setUp()
        swept = next(self.layers["swept"].getFeatures()).geometry()
        self.extent = swept.boundingBox()
        self.extent.scale(1.1)
        self.tint = over(self.layers["swept"].renderer().symbol().color())
        self.track = self.layers["vessel_track"].renderer().symbol().color().getRgb()[:3]
        self.schools = [f for f in self.layers["schools"].getFeatures() if f.geometry().intersects(swept)]
        self.assertGreaterEqual(len(self.schools), 2)

    def drawn(self, names, file):
        return drawn([self.layers[n] for n in names], self.extent, file)

    def test_all_layers_together(self):
        pixels, _ = self.drawn(LAYERS, "survey.png")
        self.assertGreater(pixels_of(pixels, (255, 255, 255)), 0.1 * WIDTH * HEIGHT, "around the swept area")
        self.assertGreater(pixels_of(pixels, self.tint, 2), 0.1 * WIDTH * HEIGHT, "the swept area")
        self.assertGreater(pixels_of(pixels, self.track), 50, "track and start")
        for school in self.schools:
            self.assertGreater(pixels_of(pixels, over(self.colour(school), self.tint)), 50, f"{school['sv_mean_db']} dB")

    def colour(self, school):
        symbol = self.layers["schools"].renderer().symbolForValue(school["sv_mean_db"])
        return symbol.symbolLayer(0).fillColor()

    def test_each_school_has_the_colour_of_its_own_sv(self):
        self.layers["schools"].setLabelsEnabled(False)  # whose letters lie over the middle
        pixels, to_pixel = self.drawn(["schools"], "schools.png")
        for school in self.schools:
            place = to_pixel.transform(school.geometry().poleOfInaccessibility(1e-7)[0].asPoint())
            seen = pixels[int(place.y()), int(place.x())]
            self.assertLessEqual(numpy.abs(seen - over(self.colour(school))).max(), 2, f"{school['sv_mean_db']} dB: {seen}")

    def test_schools_are_seen_through_the_swept_area(self):
        """Even where somebody draws it above them."""
        pixels, _ = self.drawn(["swept", "schools"], "swept-above.png")
        swept = self.layers["swept"].renderer().symbol().color()
        for school in self.schools:
            through = over(swept, over(self.colour(school)))
            self.assertGreater(max(abs(a - b) for a, b in zip(through, self.tint)), 40)
            self.assertGreater(pixels_of(pixels, through), 50, f"{school['sv_mean_db']} dB")

    def test_each_outline_is_seen_above_the_schools(self):
        without, _ = self.drawn(["schools", "swept"], "without-outlines.png")
        with_, to_pixel = self.drawn(["school_outlines", "schools", "swept"], "outlines.png")
        darker = (without - with_).max(axis=2) > 30
        outlines = [f for f in self.layers["school_outlines"].getFeatures() if f.geometry().intersects(self.extent)]
        for outline in outlines:
            along = [to_pixel.transform(v.x(), v.y()) for v in outline.geometry().vertices()]
            hit = [darker[int(p.y()) - 1:int(p.y()) + 2, int(p.x()) - 1:int(p.x()) + 2].any() for p in along]
            self.assertGreater(numpy.mean(hit), 0.9, f"ping {outline['ping_index']}")


if __name__ == "__main__":
    try:
        sonarx.main()
    except SystemExit as ended:
        sys.stdout.flush()
        os._exit(int(ended.code))  # where a failed test still holds a layer, QGIS would not survive its own end
