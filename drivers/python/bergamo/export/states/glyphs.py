"""Grains in ParaView by glyphs: File, Load State, this file. Each point of glyphs.vtp is drawn as the superquadric of its
exponents from shapes.vtm, stretched by its half-axes and turned by its quaternion.
"""

from paraview.simple import (ColorBy, GetActiveViewOrCreate, OpenDataFile, RenameSource, Render, ResetCamera,
                             SetActiveSource, Show)

POINTS = None  # glyphs.vtp
SHAPES = None  # shapes.vtm

view = GetActiveViewOrCreate("RenderView")
shapes = OpenDataFile(SHAPES)
RenameSource("shapes", shapes)
grains = OpenDataFile(POINTS)
RenameSource("grains", grains)
shown = Show(grains, view)
shown.SetRepresentationType("3D Glyphs")
glyph = shown.SMProxy.GetProperty("GlyphType")  # whose list has no sources of the pipeline
glyph.SetInputConnection(0, shapes.SMProxy, 0)
shown.SMProxy.UpdateVTKObjects()
shown.UseGlyphTable = 1
shown.UseCompositeGlyphTable = 1
shown.GlyphTableIndexArray = "shape"
shown.Scaling = 1
shown.ScaleMode = "Vector Components"
shown.SelectScaleArray = "half_axes"
shown.ScaleFactor = 1.0
shown.Orient = 1
shown.OrientationMode = "Quaternion"
shown.SelectOrientationVectors = "quaternion"
ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
SetActiveSource(grains)
ResetCamera(view)
Render(view)
