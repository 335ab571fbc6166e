"""Force chains in ParaView: File, Load State, this file. Contacts above the mean force as tubes, as thick as their force, all
of them as faint lines. The filter "chains" has the threshold, "radius" the thickness.
"""

from paraview.simple import (Calculator, CellDatatoPointData, ColorBy, ExtractSurface, GetActiveViewOrCreate,
                             GetAnimationScene, OpenDataFile, RenameSource, Render, ResetCamera, SetActiveSource, Show,
                             Threshold, Tube)

CONTACTS = None  # contacts.pvd of the run
MEAN_FORCE = None  # of the contacts that were exported [N]
MEAN_LENGTH = None  # of their branches [m]

view = GetActiveViewOrCreate("RenderView")
contacts = OpenDataFile(CONTACTS)
RenameSource("contacts", contacts)
lines = Show(contacts, view)
lines.Opacity = 0.15
lines.ColorArrayName = [None, ""]
lines.AmbientColor = lines.DiffuseColor = [0.7, 0.7, 0.7]

chains = Threshold(Input=contacts, Scalars=["CELLS", "normal_force"])
chains.ThresholdMethod, chains.UpperThreshold = "Above Upper Threshold", MEAN_FORCE
RenameSource("chains", chains)
radius = Calculator(Input=chains, AttributeType="Cell Data", ResultArrayName="radius",
                    Function=f"sqrt(normal_force/{MEAN_FORCE!r})*{0.06 * MEAN_LENGTH!r}")
RenameSource("radius", radius)
ends = CellDatatoPointData(Input=radius, ProcessAllArrays=1)
tubes = Tube(Input=ExtractSurface(Input=ends), Scalars=["POINTS", "radius"], VaryRadius="By Absolute Scalar",
             NumberofSides=8)
RenameSource("force chains", tubes)
shown = Show(tubes, view)
ColorBy(shown, ("POINTS", "normal_force"))
shown.RescaleTransferFunctionToDataRange(False, True)
shown.SetScalarBarVisibility(view, True)
SetActiveSource(tubes)
ResetCamera(view)
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
shown.RescaleTransferFunctionToDataRange(False, True)
Render(view)
