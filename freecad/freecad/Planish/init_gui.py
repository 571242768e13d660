"""Tells FreeCAD of the workbench. FreeCAD runs this file when its window starts."""

import os

import FreeCADGui

from freecad.Planish import DIRECTORY, icon, translate


class PlanishWorkbench(FreeCADGui.Workbench):
    """Smooth surfaces and solids from meshes and sections."""

    MenuText = "Planish"
    ToolTip = translate("Smooth surfaces and solids from meshes and sections, within a tolerance")
    Icon = icon("planish")

    def Initialize(self):
        from freecad.Planish import commands

        names = commands.register()
        self.appendToolbar("Planish", names)
        self.appendMenu("&Planish", names)

    def ContextMenu(self, recipient):
        self.appendContextMenu("Planish", ["Planish_FitSurface", "Planish_SolidFromMesh", "Planish_Deviation"])

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addLanguagePath(os.path.join(DIRECTORY, "resources", "translations"))
FreeCADGui.addPreferencePage(os.path.join(DIRECTORY, "resources", "preferences.ui"), "Planish")
FreeCADGui.addWorkbench(PlanishWorkbench())
